// Pairs of a robot and its world during a segment of a path: their motions, names and times.
// Source: docs/derivations/29-robots.md, "Answers".
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/robot/prepared.h"

#include <span>

namespace chasles::robot {

/// Time within a part of a segment, as time within the segment, rounded outwards.
Bracket in_segment(const Bracket& local, const Bracket& part);

/// Time within a segment as stamps, rounded outwards.
Bracket stamps_of(const JointPath::Segment& segment, const Bracket& time);

/// Speeds in the time of a part of a segment, as speeds in the time of the segment.
void slow_down(std::span<Contact> contacts, const Bracket& part);

/// The names of a pair.
RobotPair name_of(const RobotChecker::Prepared& prepared, const Task& task);

/// A segment of a path, for a robot and a scene. The robot is kept by reference.
class SegmentPairs {
public:
    /// Throws InvalidInput if the path belongs to another robot.
    SegmentPairs(const RobotChecker::Prepared& prepared, const JointPath& path, std::size_t segment);

    [[nodiscard]] const RobotChecker::Prepared& prepared() const { return prepared_; }
    [[nodiscard]] const SegmentMotion& motion() const { return motion_; }
    /// The moving element as seen from the fixed body, by the joints between them alone, and both in the world.
    [[nodiscard]] motion::ErasedTrajectory<motion::SmoothTrajectory> trajectory(const Task& task) const;
    [[nodiscard]] RobotPair name_of(const Task& task) const { return robot::name_of(prepared_, task); }
    /// What `work` returns. What it refuses (InvalidInput) gets the names of the pair in front.
    template <class Work>
    auto naming(const Task& task, const Work& work) const {
        try {
            return work();
        } catch (const InvalidInput& error) {
            const RobotPair pair = name_of(task);
            throw InvalidInput("robot: " + pair.first + " and " + pair.second + ": " + error.what());
        }
    }

private:
    [[nodiscard]] motion::SmoothMotion motion_of(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_of_self(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_to_obstacle(const Task& task) const;
    [[nodiscard]] motion::SmoothMotion motion_to_mover(const Task& task) const;
    [[nodiscard]] motion::SharedFrame frame_of(const Element& element) const;

    const RobotChecker::Prepared& prepared_;
    SegmentMotion motion_;
    Bracket of_scene_; ///< the time of the segment in that of the scene
};

/// So far apart are the pairs that a search for the nearest one tries first: a tenth of the largest link.
double first_distance(const RobotChecker::Prepared& prepared);

/// The pairs that may touch during a segment, in order of time. With `hold`, a pair that may be held is searched from
/// the start of the segment to the end of its last part: it is held all along, whatever boxes prove in between.
std::vector<Task> tasks_of(const SegmentPairs& segment);

} // namespace chasles::robot
