// Nodes with children: Group, and Switch, which can hide them.
#pragma once

#include "scenegraph/Node.h"

#include <cstddef>
#include <vector>

namespace penumbra {

/// An ordered list of children, none of them null.
class Group : public Node {
public:
    using Node::Node;
    void accept(Visitor& visitor) const override;

    const std::vector<NodePtr>& children() const { return children_; }
    bool has(const NodePtr& child) const;
    void add(NodePtr child);
    /// Before the child that has this place now; at the end if there is none.
    void insert(std::size_t place, NodePtr child);
    /// Removes the first occurrence of `child`; returns whether it was there.
    bool remove(const NodePtr& child);

private:
    std::vector<NodePtr> children_;
};

/// A group that is shown or hidden as a whole; hidden things neither block nor send nor receive.
class Switch : public Group {
public:
    using Group::Group;
    void accept(Visitor& visitor) const override;

    bool visible() const { return visible_; }
    void setVisible(bool visible);

private:
    bool visible_ = true;
};

} // namespace penumbra
