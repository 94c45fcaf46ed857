// The pairs of a robot and its world in boxes of configurations: how far the joints of a box move the points of one
// body as seen from the other one. Source: docs/derivations/40-ranges.md, "Displacements".
#pragma once

#include "chasles/robot/group_motion.h"
#include "chasles/robot/pair_axes.h"
#include "chasles/robot/prepared.h"
#include "chasles/robot/small_motions.h"

#include <array>
#include <span>
#include <vector>

namespace chasles::robot {

/// The world poses of all groups and shapes at one configuration, in double.
class RestPlaces {
public:
    RestPlaces(const RobotChecker::Prepared& prepared, const SegmentMotion& motion);

    [[nodiscard]] const motion::GeneralPose<double>& group(std::size_t index) const { return groups_[index]; }
    [[nodiscard]] motion::GeneralPose<double> element(std::size_t index) const;
    /// The sum of the sizes of all lengths.
    [[nodiscard]] double size() const { return size_; }

private:
    const RobotChecker::Prepared& prepared_;
    std::vector<motion::GeneralPose<double>> groups_;
    double size_ = 0;
};

/// A pair at the middle of a cell.
struct PairInCell {
    SmallMotion motion;
    /// Of each axis of the box: a bound of what it moves.
    std::vector<double> ways;

    /// A bound of what all axes move.
    [[nodiscard]] double way() const { return std::min(motion.way_of_moving, motion.way_of_fixed); }
};

/// A pair of the checker, with the joints of the box between both bodies.
class RangePair {
public:
    /// `axis_of` is the number of each variable in the box; `none` for variables that stand still.
    RangePair(const RobotChecker::Prepared& prepared, const Task& task, std::span<const std::size_t> axis_of);
    static constexpr std::size_t none = std::size_t(-1);

    [[nodiscard]] const Task& task() const { return task_; }
    [[nodiscard]] double margin() const { return margin_; }
    /// The moving element in the frame of the fixed body.
    [[nodiscard]] Eigen::Isometry3d relative(const RestPlaces& places) const;
    /// How each axis moves the bodies, where it is no farther than `half` from its value at `places`.
    [[nodiscard]] PairInCell in_cell(const RestPlaces& places, std::span<const double> half) const;
    /// Whether two balls prove the pair farther apart than its margin in the cell.
    [[nodiscard]] bool is_far_apart(const RestPlaces& places, const PairInCell& cell) const;

private:
    /// A step of a joint on the way from the fixed body to the moving one.
    struct Step {
        std::size_t axis;
        std::size_t group;
        double multiplier;
        bool turns;
        motion::Vector3<double> direction; ///< in the frame of the joint
    };
    /// A body in the world: the corners of a box around it, and a ball.
    struct Hull {
        std::array<Eigen::Vector3d, 8> corners;
        Eigen::Vector3d centre;
        double radius;
    };
    /// Bounds of displacements of the points of one body.
    struct Ways {
        std::vector<double> of_axes;
        double sum = 0;
        double rest = 0; ///< beyond the first order
    };
    void add_steps(std::size_t from, std::size_t to, std::span<const std::size_t> axis_of);
    void add(std::size_t group, std::span<const std::size_t> axis_of);
    [[nodiscard]] Hull hull_of(std::size_t element, const RestPlaces& places) const;
    [[nodiscard]] Hull fixed_hull(const RestPlaces& places) const;
    static void add_way(Ways& ways, const SmallMotion::Step& step, const Hull& hull, double rounding);
    [[nodiscard]] std::vector<SmallMotion::Step> steps_in_world(const RestPlaces& places,
                                                                std::span<const double> half) const;
    [[nodiscard]] motion::GeneralPose<double> fixed_pose(const RestPlaces& places) const;
    [[nodiscard]] double rounding(const RestPlaces& places) const;

    const RobotChecker::Prepared* prepared_;
    Task task_;
    double margin_ = 0;
    std::vector<Step> steps_; ///< from the fixed body outwards
};

/// All pairs of a checker whose scene stands still.
std::vector<RangePair> pairs_of_box(const RobotChecker::Prepared& prepared, std::span<const std::size_t> axis_of);

} // namespace chasles::robot
