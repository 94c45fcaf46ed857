// The motion of rigid groups during a segment, in double: placements at even times, and bounds of rates that hold for
// all values of the joints. Source: docs/derivations/29-robots.md, "Chains".
#pragma once

#include "chasles/robot/model.h"

#include <cstddef>
#include <vector>

namespace chasles::robot {

/// Bounds of the rates of a chain of groups. The reference is the origin of the last group.
class GroupRates {
public:
    GroupRates(const Model& model, const SegmentMotion& motion);

    /// Goes on from a group's parent to the group, or from the group to its parent.
    void go_down(motion::RateBounds& bounds, std::size_t group) const;
    void go_up(motion::RateBounds& bounds, std::size_t group) const;

private:
    /// The sums of the joint of a group: at most one turn, and slides.
    struct Steps {
        double origin = 0; ///< its distance from the origin of the parent
        double turn_rate = 0, turn_acceleration = 0;
        double slide = 0, slide_rate = 0, slide_acceleration = 0;

        void add(const motion::TimePolynomial& value, bool turns);
        void apply_to(motion::RateBounds& bounds) const;
    };

    std::vector<Steps> steps_;
};

/// Where the groups are at even times, computed when they are needed.
class Placements {
public:
    /// From time 0 to time 1, in so many intervals.
    Placements(const Model& model, const SegmentMotion& motion, std::size_t intervals);

    const motion::GeneralPose<double>& operator()(std::size_t time, std::size_t group) {
        if (poses_[time].empty())
            make(time);
        return poses_[time][group];
    }

private:
    void make(std::size_t index);
    [[nodiscard]] motion::GeneralPose<double> placed_group(std::size_t group, double time,
                                                           const motion::GeneralPose<double>& parent) const;

    const Model& model_;
    const SegmentMotion& motion_;
    std::size_t intervals_;
    motion::GeneralPose<double> base_;
    std::vector<std::vector<motion::GeneralPose<double>>> poses_; ///< at each time, of each group; empty until needed
};

} // namespace chasles::robot
