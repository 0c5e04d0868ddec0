#include "radiosity/SeenWork.h"

#include "radiosity/LocalShare.h"
#include "radiosity/Shaft.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace penumbra {

SeenWork::SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light)
    : patches_(patches), rays_(rays), light_(light), places_(patches),
      order_(std::make_shared<ImportanceOrder>(
          places_.placeOf(), [this](std::uint32_t place) { return look(place); },
          [this](std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values) {
              lookClosely(block, which, values);
          })) {}

void SeenWork::follow(std::span<const ObjectId> objects) {
    const Bounds before = places_.boundsOf(objects);
    places_.follow(objects);
    if (!from_) return;
    if (from_->eye()) forgetSights(objects, before, places_.boundsOf(objects));
    order_->attend(order_->attention());
}

/// Of the objects themselves, and of all that they may have hidden or may hide now.
void SeenWork::forgetSights(std::span<const ObjectId> objects, const Bounds& before,
                            const Bounds& now) {
    const Bounds eye{glm::vec3(*from_->eye()), glm::vec3(*from_->eye())};
    // Beside a thing that stands on them, vertices are lit an element farther out: see Contact.h.
    const Bounds from = grown(before, patches_.elementSize), to = grown(now, patches_.elementSize);
    const auto moved = [&](ObjectId object) {
        return std::find(objects.begin(), objects.end(), object) != objects.end();
    };
    const auto stale = [&](const Bounds& box) {
        return shaftMeets(box, eye, from) || shaftMeets(box, eye, to);
    };
    const std::uint32_t firstPrivate = patches_.firstPrivate / PatchSet::kBlock;
    std::erase_if(sights_, [&](const auto& item) {
        return item.first >= firstPrivate || // are handed out anew
               moved(patches_.vertexBlockObject[item.first]);
    });
    for (auto& [block, sight] : sights_) {
        if (!stale(sight.box)) continue;
        for (std::uint64_t left = sight.asked; left != 0; left &= left - 1) {
            const auto r = std::size_t(std::countr_zero(left));
            const glm::vec3 p = patches_.vertices[block * PatchSet::kBlock + r].receiver.position;
            const std::uint64_t bit = std::uint64_t(1) << r;
            const Bounds point{p, p};
            if (from.contains(p) || to.contains(p) ||
                ((sight.seen & bit) && shaftMeets(point, eye, to)) ||
                ((sight.behindMovable & bit) && shaftMeets(point, eye, from)))
                sight.asked &= ~bit; // what stays hides what it hid
        }
        sight.seen &= sight.asked;
        sight.behindMovable &= sight.asked;
    }
    std::erase_if(placePixels_, [&](const auto& item) {
        return moved(places_.objectOf(item.first)) || stale(places_.known(item.first).box);
    });
}

void SeenWork::attend(const Attention& attention, double ambient) {
    ambient_ = ambient;
    if (from_ != attention.viewpoint) {
        sights_.clear();
        values_.clear();
        placePixels_.clear();
        from_ = attention.viewpoint;
    }
    Attention now = attention;
    if (!(now.adaptation > 0)) now.adaptation = adaptationTo(now.viewpoint);
    order_->attend(now);
}

WorkPlace SeenWork::placeNow(std::uint32_t index) const {
    WorkPlace place = places_.at(index, light_.vertices());
    place.luminance += place.reflectance * float(ambient_ * std::numbers::inv_pi);
    return place;
}

/// Geometric mean over what is in the picture, as if nothing were in front of it.
double SeenWork::adaptationTo(const Viewpoint& viewpoint) const {
    double sum = 0, pixels = 0;
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
        const WorkPlace& known = places_.known(p);
        if (viewpoint.regionOf(known.box) != Viewpoint::Region::picture) continue;
        const double shown = viewpoint.pixelsOf(known.box, known.normal, known.area);
        if (!(shown > 0)) continue;
        sum += shown * std::log(std::max(1e-4, double(placeNow(p).luminance)));
        pixels += shown;
    }
    return pixels > 0 ? std::exp(sum / pixels) : 1e-4;
}

void SeenWork::lookClosely(std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values) {
    Values& known = values_[block];
    if (known.view != order_->view()) known.known = 0, known.view = order_->view();
    if (const std::uint64_t open = which & ~known.known; open != 0) evaluate(block, open, known);
    std::copy(known.of.begin(), known.of.end(), values.begin());
}

void SeenWork::evaluate(std::uint32_t block, std::uint64_t which, Values& values) {
    const Attention& attention = order_->attention();
    const bool looks = attention.factors.occlusion && attention.viewpoint.eye();
    const Sight sight = looks ? sightOf(block, which) : Sight();
    const std::size_t first = std::size_t(block) * PatchSet::kBlock;
    std::array<Receiver, PatchSet::kBlock> receivers;
    for (std::size_t r = 0; r < receivers.size(); ++r)
        receivers[r] = patches_.vertices[first + r].receiver;
    const LocalShare share(receivers);
    values.known |= which;
    for (; which != 0; which &= which - 1) {
        const auto r = std::size_t(std::countr_zero(which));
        WorkPlace place = places_.atVertex(first + r, light_.vertices()[first + r]);
        place.luminance += place.reflectance * float(ambient_ * std::numbers::inv_pi);
        std::optional<float> pixels;
        if (looks) { // what is drawn around a hidden vertex may be seen
            const float seen =
                0.5f * float(sight.seen >> r & 1) + 0.5f * share.at(r, sight.asked, sight.seen);
            pixels =
                seen * float(attention.viewpoint.pixelsOf(place.box, place.normal, place.area));
        }
        values.of[r] = place.box.empty() ? PlaceValue() : placeValue(place, attention, pixels);
    }
}

/// What is known of a block once some of its vertices were asked for.
const SeenWork::Sight& SeenWork::sightOf(std::uint32_t block, std::uint64_t which) {
    Sight& sight = sights_[block];
    which &= ~sight.asked;
    sight.asked |= which;
    ask(block, which, sight);
    for (; which != 0; which &= which - 1) {
        const auto r = std::size_t(std::countr_zero(which));
        sight.box.add(
            patches_.vertices[std::size_t(block) * PatchSet::kBlock + r].receiver.position);
    }
    return sight;
}

/// Finds which of some vertices of a block face the eye, are in the picture, and not hidden.
void SeenWork::ask(std::uint32_t block, std::uint64_t which, Sight& sight) {
    const glm::vec3 eye(*order_->attention().viewpoint.eye());
    ShadowRays rays;
    std::array<std::uint32_t, ShadowRays::kMost> of{};
    int count = 0;
    const auto trace = [&] {
        if (count == 0) return;
        rays_.occluded(rays);
        rayCount_ += std::uint64_t(count);
        for (int i = 0; i < count; ++i) {
            const std::uint64_t bit = std::uint64_t(1) << of[std::size_t(i)];
            if (rays.blocker[i] == ObjectId::kNone)
                sight.seen |= bit;
            else if (patches_.objects[rays.blocker[i]].movable)
                sight.behindMovable |= bit;
        }
        rays.used = 0;
        count = 0;
    };
    for (; which != 0; which &= which - 1) {
        const auto r = std::uint32_t(std::countr_zero(which));
        const Receiver& receiver =
            patches_.vertices[std::size_t(block) * PatchSet::kBlock + r].receiver;
        const Bounds point{receiver.position, receiver.position};
        if (glm::dot(eye - receiver.position, receiver.normal) <= 0) continue; // also padding
        if (order_->attention().viewpoint.regionOf(point) != Viewpoint::Region::picture) continue;
        of[std::size_t(count)] = r;
        rays.set(count++, receiver.position, eye);
        if (count == ShadowRays::kMost) trace();
    }
    trace();
}

ImportanceOrder::Sight SeenWork::look(std::uint32_t index) {
    const Attention& attention = order_->attention();
    const Viewpoint& viewpoint = attention.viewpoint;
    ImportanceOrder::Sight sight{placeNow(index), {}};
    const WorkPlace& place = sight.place;
    if (!attention.factors.occlusion || !viewpoint.eye() ||
        viewpoint.regionOf(place.box) != Viewpoint::Region::picture)
        return sight;
    const auto [known, fresh] = placePixels_.try_emplace(index, 0.0f);
    if (fresh) known->second = pixelsSeen(index);
    sight.seen = known->second;
    return sight;
}

/// How many pixels an average block of a place covers, by vertices spread over it.
float SeenWork::pixelsSeen(std::uint32_t place) {
    const Viewpoint& viewpoint = order_->attention().viewpoint;
    const std::vector<std::size_t> vertices = places_.spread(place);
    float pixels = 0;
    for (const std::size_t v : vertices) {
        const std::uint64_t bit = std::uint64_t(1) << v % PatchSet::kBlock;
        if (!(sightOf(std::uint32_t(v / PatchSet::kBlock), bit).seen & bit)) continue;
        const Receiver& receiver = patches_.vertices[v].receiver;
        pixels += float(viewpoint.pixelsOf({receiver.position, receiver.position}, receiver.normal,
                                           places_.known(place).area));
    }
    return vertices.empty() ? 0 : pixels / float(vertices.size());
}

} // namespace penumbra
