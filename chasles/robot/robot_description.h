// The parts of a robot: links with collision shapes, joints, and pairs of links that are not tested. They come
// from URDF and SRDF files by chasles/robot/urdf_reader.h, or written by hand.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace chasles {

enum class JointType : std::uint8_t {
    fixed,
    revolute,
    continuous, ///< a revolute joint without limits: see RobotVariable::is_continuous
    prismatic,
    planar,   ///< in the plane orthogonal to the axis: two translations, then a turn
    floating, ///< a translation and a quaternion
};

/// A joint that follows a leader. Its value is multiplier * (value of the leader) + offset.
struct MimicDescription {
    std::string joint;
    double multiplier = 1;
    double offset = 0;
};

/// A joint between two links. Its frame is that of the child link at the value 0.
struct JointDescription {
    std::string name;
    JointType type = JointType::fixed;
    std::string parent = {}; ///< name of a link
    std::string child = {};  ///< likewise
    Pose origin = {};        ///< of the joint's frame in the frame of the parent link
    /// In the joint's frame, of any non-zero length: of the turn or slide; for planar joints the normal of the plane.
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
    double lower = -std::numeric_limits<double>::infinity(); ///< limit of revolute joints (radians) and prismatic ones
    double upper = std::numeric_limits<double>::infinity();
    std::optional<MimicDescription> mimic = {};
};

/// A shape of a link.
struct CollisionDescription {
    Polyhedron shape;
    Pose origin = {}; ///< of the shape in the frame of the link
    /// The shape encloses a sphere, a cylinder, a capsule or something without extent, and has no point farther than
    /// this from it; 0 for a mesh or a box.
    double deviation = 0;
};

struct LinkDescription {
    std::string name;
    std::vector<CollisionDescription> collisions = {}; ///< each is a body of its own; they may overlap
};

/// Two links that are not tested against each other, or that are in spite of an earlier entry.
struct LinkPairDescription {
    std::string first;
    std::string second;
    std::string reason = {}; ///< of the file: "Adjacent", "Never", "Default", ...
};

/// Named joints and links that belong together, as SRDF files define them.
struct GroupDescription {
    std::string name;
    std::vector<std::string> joints = {}; ///< all of them, also those of chains, links and subgroups
    std::vector<std::string> links = {};  ///< likewise
};

/// A named state of a group.
struct StateDescription {
    struct Value {
        std::string joint;
        std::vector<double> values; ///< one a variable of the joint
    };
    std::string name;
    std::string group;
    std::vector<Value> values = {};
};

/// A tree of links. Its root is the link that is no joint's child.
struct RobotDescription {
    std::string name;
    std::vector<LinkDescription> links = {};
    std::vector<JointDescription> joints = {};
    std::vector<LinkPairDescription> disabled_pairs = {}; ///< besides links that a joint connects
    std::vector<LinkPairDescription> enabled_pairs = {};  ///< these count more than disabled_pairs
    std::vector<GroupDescription> groups = {};
    std::vector<StateDescription> states = {};
    std::vector<std::string> warnings = {}; ///< what files say that has no effect, one line each
};

} // namespace chasles
