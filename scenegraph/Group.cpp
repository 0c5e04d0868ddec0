#include "scenegraph/Group.h"

#include "scenegraph/Visitor.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

void Group::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

bool Group::has(const NodePtr& child) const {
    return std::find(children_.begin(), children_.end(), child) != children_.end();
}

void Group::add(NodePtr child) {
    assert(child && child.get() != this);
    children_.push_back(std::move(child));
    touch();
}

void Group::insert(std::size_t place, NodePtr child) {
    assert(child && child.get() != this);
    place = std::min(place, children_.size());
    children_.insert(children_.begin() + std::ptrdiff_t(place), std::move(child));
    touch();
}

bool Group::remove(const NodePtr& child) {
    const auto found = std::find(children_.begin(), children_.end(), child);
    if (found == children_.end()) return false;
    children_.erase(found);
    touch();
    return true;
}

void Switch::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

void Switch::setVisible(bool visible) {
    if (visible == visible_) return;
    visible_ = visible;
    touch();
}

} // namespace penumbra
