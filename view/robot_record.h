// The data of a page of a robot that moves along a path up to its first contact.
#pragma once

#include "view/scene_record.h"

namespace chasles::view {

/// The shapes of the robot with its parts, and the scene. The slider has the stamps of the path up to the contact.
/// `scene` may be null.
SceneRecord robot_record(const chasles::Robot& robot, const chasles::Scene* scene, const JointPath& path,
                         const RobotAnswer& answer);

} // namespace chasles::view
