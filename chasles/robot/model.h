// A robot made ready for questions: rigid groups of links, the joints between them, and the bodies that they carry.
// Source: docs/derivations/29-robots.md, "Rigid groups".
#pragma once

#include "chasles/motion/chain_frame.h"
#include "chasles/robot/robot.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace chasles::robot {

/// An elementary joint whose value is multiplier * (a variable) + offset.
struct JointStep {
    motion::FixedAxis axis;
    std::size_t variable = 0;
    double multiplier = 1;
    double offset = 0;
    bool turns = true;

    /// Whether the joint is where it was after each whole turn of its variable.
    [[nodiscard]] bool repeats_after_a_turn() const;
};

/// Links that no joint moves against each other, and how they move against their parent.
struct RigidGroup {
    std::size_t parent = 0;                ///< of smaller index; the root is its own parent
    motion::FixedPose origin;              ///< of the joint in the frame of the parent
    std::vector<JointStep> steps;          ///< none for the root
    std::optional<std::size_t> quaternion; ///< the variable of the first of four (x, y, z, w), for a floating joint
    std::size_t depth = 0;                 ///< number of groups above

    /// Likewise of all joints that follow the variable.
    [[nodiscard]] bool repeats_after_a_turn(std::size_t variable) const;
};

/// A link or a part: what pairs are made of.
struct Owner {
    std::string name;
    std::size_t group = 0;
    motion::FixedPose place; ///< in the frame of the group
};

/// A shape of an owner.
struct Element {
    std::size_t owner = 0;
    std::size_t group = 0;
    motion::FixedPose place; ///< in the frame of the group
    Polyhedron shape;
    std::size_t shape_index = 0; ///< in LinkDescription::collisions
};

/// The values of all steps during a segment.
struct SegmentMotion {
    /// Of each step, by group.
    std::vector<std::vector<std::shared_ptr<const motion::TimePolynomial>>> values;
    struct Turn { ///< of a floating joint
        motion::FixedPose start;
        motion::ElementaryJoint joint;
    };
    std::map<std::size_t, Turn> turns; ///< by group
};

class Model {
public:
    explicit Model(RobotDescription description);

    RobotDescription description;
    std::vector<RobotVariable> variables;
    JointPath::Variables variables_of_paths; ///< the same, kept by each path of the robot
    std::vector<std::size_t> quaternions;    ///< first variables of the quaternions of floating joints
    std::vector<RigidGroup> groups;          ///< parents first
    std::vector<Owner> owners;               ///< links in the order of the description, then parts
    std::vector<Element> elements;
    std::vector<AttachedPart> parts;
    Pose base;
    std::map<std::string, std::size_t, std::less<>> variable_of; ///< by name
    std::map<std::string, std::size_t, std::less<>> owner_of;    ///< by name
    using OwnerPair = std::pair<std::size_t, std::size_t>;       ///< the smaller one first
    using NamePair = std::pair<std::string, std::string>;
    std::set<OwnerPair> neighbours; ///< a link with its parent, and with the next one above that has shapes
    std::set<OwnerPair> ignored;
    std::map<OwnerPair, double> margins;
    std::set<NamePair> ignored_in_scene;

    void attach(const AttachedPart& part);
    void detach(std::string_view name);
    /// A part, and the links that carry it or touch it, are not tested against each other.
    void let_touch(std::string_view part, std::string_view link, const std::vector<std::string>& touch_links);
    /// The part moves with another link. It keeps its place in the world at the begin of a segment.
    void hand_over(std::string_view part, std::string_view link, const SegmentMotion& segment);
    /// Throws InvalidInput for an unknown name.
    [[nodiscard]] std::size_t owner(std::string_view name) const;
    [[nodiscard]] OwnerPair owners_of(std::string_view a, std::string_view b) const;
    [[nodiscard]] bool is_tested(const OwnerPair& pair) const {
        return owners[pair.first].group != owners[pair.second].group && !ignored.contains(pair);
    }

    [[nodiscard]] SegmentMotion motion_of(const JointPath::Segment& segment) const;
    /// The name of its owner, and its index there.
    [[nodiscard]] std::pair<std::string, std::size_t> name_of(const Element& element) const {
        return {owners[element.owner].name, element.shape_index};
    }

    /// In the world, at a time of the segment.
    [[nodiscard]] motion::FixedPose place_of(const SegmentMotion& motion, std::size_t group,
                                             const motion::FixedPose& place, double time) const;
    /// The pose of a link or part in the world at a time of the segment.
    [[nodiscard]] Pose pose_of(const SegmentMotion& motion, std::size_t owner, double time) const;
    /// Those of all links, in the order of the description.
    [[nodiscard]] std::vector<Pose> link_poses(const SegmentMotion& motion, double time) const;
    /// From the world to a place in a group, and from a place in one group to one in another.
    [[nodiscard]] motion::Chain chain(const SegmentMotion& motion, std::size_t group,
                                      const motion::FixedPose& place) const;
    void add_chain(motion::Chain& chain, const SegmentMotion& motion, std::size_t group,
                   const motion::FixedPose& place) const;
    [[nodiscard]] motion::Chain chain_between(const SegmentMotion& motion, const Element& from,
                                              const Element& to) const;

private:
    void add_variables();
    void add_links();
    [[nodiscard]] std::size_t root_link() const;
    void add_below(std::size_t root);
    Owner child_of(const Owner& parent, const JointDescription& joint);
    [[nodiscard]] RigidGroup group_of(const JointDescription& joint) const;
    void find_continuous();
    void apply_pairs();
    void add_down(motion::Chain& chain, const SegmentMotion& motion, std::size_t group, std::size_t above) const;
    void add_up(motion::Chain& chain, const SegmentMotion& motion, std::size_t group, std::size_t above) const;
};

/// The even turn of a floating joint in a straight segment, whose quaternion begins at this variable.
SegmentMotion::Turn turn_of(const JointPath::Segment& segment, std::size_t first);

/// The suffixes of the names of the variables of a joint that follows none: as many as it has numbers in a state.
std::vector<const char*> suffixes_of(JointType type);

/// Why no joint follows one of this type, for a message that begins with its name; empty if a joint may.
std::string why_not_followed(JointType type);

/// Why a value of a variable is refused, likewise; empty if it is not.
std::string why_too_large(const Model& model, std::size_t variable, double value);

/// Throws InvalidInput "robot: WHAT: WHY".
[[noreturn]] void refuse(std::string_view what, std::string_view why);

} // namespace chasles::robot
