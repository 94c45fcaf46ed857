// The data of a page of a robot that moves along a path up to its first contact.
#pragma once

#include "view/sampled_track.h"
#include "view/scene_record.h"

#include <functional>
#include <span>

namespace chasles::view {

/// An answer, and what it is about.
struct RobotPathAnswer {
    const JointPath& path;
    const RobotAnswer& found;
    std::span<const Handover> handovers = {};
};

/// The shapes of the robot with its parts, and the scene. The slider has the stamps of the path up to the contact.
/// `scene` may be null. `progress` gets the number of segments that are done.
SceneRecord robot_record(const chasles::Robot& robot, const chasles::Scene* scene, const RobotPathAnswer& answer,
                         const std::function<void(std::size_t)>& progress = {});

} // namespace chasles::view
