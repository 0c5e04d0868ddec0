// A scene in which one object is moved there and back.
#pragma once

#include "base/LightRequest.h"
#include "scenegraph/Objects.h"
#include "scenegraph/Scene.h"
#include "scenegraph/Transform.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <string>

namespace penumbra {

/// What is moved, and between which poses: those of a layer's animation at two time codes.
struct Move {
    const char* name;    ///< for people: scene/object
    const char* layer;   ///< file in scenes/, without its ending
    const char* object;  ///< path of its transform
    double home, there;  ///< time codes
    glm::dvec3 shift{0}; ///< added to the pose at `there`, in the parent's frame [m]
};

/// The moves that are measured: some decimetres and a turn, as a person would make them.
inline constexpr Move kMoves[] = {
    {"office/seat", "office-seat", "/World/Seat", 14, 18},              // 0.41 m, 11 degrees
    {"office/lamp", "office-lamp", "/World/DeskLamp", 1, 20},           // 0.25 m, 52 degrees
    {"office/ceiling", "office-ceiling", "/World/CeilingLamp2", 1, 12}, // 0.43 m
    {"gallery/sculpture", "gallery-walk", "/World/PiercedCube", 1, 30}, // 0.38 m
    {"gallery/spot", "gallery-walk", "/World/Spot2", 20, 33},           // 0.61 m, 28 degrees
    {"gallery/ceiling", "gallery", "/World/CeilingLamp1", 1, 1, {0.3, 0.3, 0}},
};

/// Walls and a door: what was fixed once. A hall of the gallery is floor, walls and ceiling.
inline constexpr Move kWalls[] = {
    {"office/room", "office", "/World/Room", 1, 1, {0.05, 0, 0}},
    {"office/door", "office", "/World/Door", 1, 1, {-0.3, 0.2, 0}},
    {"gallery/hall", "gallery", "/World/HallB", 1, 1, {0.05, 0, 0}},
    {"gallery/doorway", "gallery", "/World/Doorway2", 1, 1, {0.05, 0.3, 0}},
};

/// The scene of a Move. Everything else is as at the move's first time code.
class MovedScene {
public:
    /// \param copies of the scene, side by side and in up to four storeys, half a metre apart: one
    ///               building. The object of the first one moves.
    explicit MovedScene(const Move& move, int copies = 1);

    enum class Pose { home, there };
    void put(Pose place) { object_->setMatrix(poses_[std::size_t(place)]); }
    /// On the way from home (0) to there (1), turned as at home.
    void putBetween(double share) {
        glm::dmat4 pose = poses_[0];
        pose[3] = glm::mix(pose[3], poses_[1][3], share);
        object_->setMatrix(pose);
    }

    const Scene& scene() const { return *scene_; }
    const LightRequest& asked() const { return asked_; } ///< by the file
    PlacedScene placed() const { return placeScene(*scene_); }

private:
    std::shared_ptr<Scene> scene_;
    LightRequest asked_;
    std::shared_ptr<Transform> object_;
    std::array<glm::dmat4, 2> poses_;
};

} // namespace penumbra
