// The kinematics of a robot once more, joint by joint and by Eigen alone.
#pragma once

#include "chasles/robot/robot.h"
#include "tests/support/turn_to.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace chasles::test {

/// The pose of each link in the frame of the root, joint by joint.
class PlainKinematics {
public:
    PlainKinematics(const Robot& robot, const Configuration& values) : robot_(robot), values_(values) {}

    [[nodiscard]] Eigen::Isometry3d pose(const std::string& link) const {
        for (const JointDescription& joint : robot_.description().joints)
            if (joint.child == link)
                return pose(joint.parent) * joint.origin.isometry() * moved(joint);
        return Eigen::Isometry3d::Identity();
    }

private:
    [[nodiscard]] double value(const std::string& variable) const {
        return values_[Eigen::Index(robot_.variable(variable))];
    }
    [[nodiscard]] double value(const JointDescription& joint) const {
        if (!joint.mimic)
            return value(joint.name);
        const auto& joints = robot_.description().joints;
        const auto other = std::ranges::find(joints, joint.mimic->joint, &JointDescription::name);
        return joint.mimic->multiplier * value(*other) + joint.mimic->offset;
    }
    [[nodiscard]] Eigen::Isometry3d moved(const JointDescription& joint) const {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        const Eigen::Vector3d axis = joint.axis.normalized();
        switch (joint.type) {
        case JointType::fixed:
            break;
        case JointType::prismatic:
            pose.translation() = value(joint) * axis;
            break;
        case JointType::planar: {
            const Eigen::Quaterniond plane = turn_to(Eigen::Vector3d::UnitZ(), axis);
            pose.translation() = plane * Eigen::Vector3d(value(joint.name + "/x"), value(joint.name + "/y"), 0);
            pose.rotate(Eigen::AngleAxisd(value(joint.name + "/theta"), axis));
            break;
        }
        case JointType::floating: {
            const auto part = [&](const char* suffix) { return value(joint.name + suffix); };
            pose.translation() = Eigen::Vector3d(part("/trans_x"), part("/trans_y"), part("/trans_z"));
            pose.rotate(
                Eigen::Quaterniond(part("/rot_w"), part("/rot_x"), part("/rot_y"), part("/rot_z")).normalized());
            break;
        }
        default:
            pose.rotate(Eigen::AngleAxisd(value(joint), axis));
        }
        return pose;
    }

    const Robot& robot_;
    const Configuration& values_;
};

} // namespace chasles::test
