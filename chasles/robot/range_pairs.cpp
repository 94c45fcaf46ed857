#include "chasles/robot/range_pairs.h"

#include "chasles/motion/screw_path.h"
#include "chasles/robot/element_places.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;
using motion::GeneralPose;

/// The allowance for roundings of places, relative to the sizes that enter: as for boxes of note 29.
constexpr double rounding_of_places = 1e-11;

Vector3d as_eigen(const motion::Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

std::array<Vector3d, 8> corners_of(const Vector3d& centre, const Vector3d& half) {
    std::array<Vector3d, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = centre + Vector3d((i & 1U) != 0 ? half.x() : -half.x(), (i & 2U) != 0 ? half.y() : -half.y(),
                                       (i & 4U) != 0 ? half.z() : -half.z());
    return corners;
}

} // namespace

RestPlaces::RestPlaces(const RobotChecker::Prepared& prepared, const SegmentMotion& motion) : prepared_(prepared) {
    const Model& model = prepared.model();
    Placements placements(model, motion, 1);
    for (std::size_t g = 0; g < model.groups.size(); ++g) {
        groups_.push_back(placements(0, g));
        size_ += norm1(model.groups[g].origin.in_double.translation) + norm1(groups_.back().translation);
    }
}

GeneralPose<double> RestPlaces::element(std::size_t index) const {
    return product(groups_[prepared_.model().elements[index].group], prepared_.extents[index].place);
}

RangePair::RangePair(const RobotChecker::Prepared& prepared, const Task& task, std::span<const std::size_t> axis_of)
    : prepared_(&prepared), task_(task) {
    const Model& model = prepared.model();
    const bool is_self = task.kind == Task::Kind::self;
    const std::size_t moving = model.elements[prepared.moving_index(task)].group;
    const std::size_t fixed = is_self ? model.elements[prepared.self_pairs[task.first].fixed].group : 0;
    margin_ = is_self ? prepared.self_pairs[task.first].margin : prepared.options.margin;
    add_steps(fixed, moving, axis_of);
}

/// From a group up to the first one above both, and down to the other one.
void RangePair::add_steps(std::size_t from, std::size_t to, std::span<const std::size_t> axis_of) {
    const auto& groups = prepared_->model().groups;
    std::vector<std::size_t> down;
    while (from != to)
        if (groups[from].depth >= groups[to].depth) {
            const auto before = std::ptrdiff_t(steps_.size());
            add(from, axis_of);
            std::reverse(steps_.begin() + before, steps_.end());
            from = groups[from].parent;
        } else {
            down.push_back(to);
            to = groups[to].parent;
        }
    for (std::size_t i = down.size(); i-- > 0;)
        add(down[i], axis_of);
}

/// The turn of a group is its last step, so its axis goes through the origin of the group. The directions of all steps
/// are those of the frame of the joint, which none of them turns but the last one.
void RangePair::add(std::size_t group, std::span<const std::size_t> axis_of) {
    const RigidGroup& rigid = prepared_->model().groups[group];
    for (const JointStep& step : rigid.steps)
        if (axis_of[step.variable] != none && step.multiplier != 0)
            steps_.push_back(
                {axis_of[step.variable], group, std::abs(step.multiplier), step.turns, step.axis.in_double});
}

GeneralPose<double> RangePair::fixed_pose(const RestPlaces& places) const {
    return task_.kind == Task::Kind::self ? places.element(prepared_->self_pairs[task_.first].fixed)
                                          : prepared_->obstacles[task_.second].pose.in_double;
}

Eigen::Isometry3d RangePair::relative(const RestPlaces& places) const {
    const GeneralPose<double> pose = seen_from(fixed_pose(places), places.element(prepared_->moving_index(task_)));
    const auto& [w, v] = pose.rotation;
    Eigen::Isometry3d isometry(Eigen::Quaterniond(w, v.x, v.y, v.z).normalized());
    isometry.translation() = as_eigen(pose.translation);
    return isometry;
}

RangePair::Hull RangePair::hull_of(std::size_t element, const RestPlaces& places) const {
    const RobotChecker::Prepared::Extent& extent = prepared_->extents[element];
    const GeneralPose<double> pose = places.element(element);
    Hull hull{corners_of(extent.centre, extent.half), centre_at(extent, pose), extent.radius};
    for (Vector3d& corner : hull.corners)
        corner = as_eigen(placed(pose, motion::vector_in<double>(corner)));
    return hull;
}

RangePair::Hull RangePair::fixed_hull(const RestPlaces& places) const {
    if (task_.kind == Task::Kind::self)
        return hull_of(prepared_->self_pairs[task_.first].fixed, places);
    const RobotChecker::Prepared::Obstacle& obstacle = prepared_->obstacles[task_.second];
    return {corners_of(obstacle.box.center(), 0.5 * obstacle.box.sizes()), obstacle.centre, obstacle.radius};
}

double RangePair::rounding(const RestPlaces& places) const {
    const double fixed = task_.kind == Task::Kind::self
                             ? prepared_->extents[prepared_->self_pairs[task_.first].fixed].size
                             : prepared_->obstacles[task_.second].size;
    return rounding_of_places * (places.size() + prepared_->extents[prepared_->moving_index(task_)].size + fixed);
}

std::vector<SmallMotion::Step> RangePair::steps_in_world(const RestPlaces& places, std::span<const double> half) const {
    std::vector<SmallMotion::Step> steps;
    for (const Step& step : steps_) {
        const RigidGroup& group = prepared_->model().groups[step.group];
        const motion::Quaternion<double> frame = places.group(group.parent).rotation * group.origin.in_double.rotation;
        steps.push_back({as_eigen(rotated(frame, step.direction)), as_eigen(places.group(step.group).translation),
                         step.multiplier * half[step.axis] * outward_sum, step.turns});
    }
    return steps;
}

/// The next step away from the points, where those before have moved them by at most `ways.sum`. A turn changes the
/// directions of these displacements and of its own: that is what is beyond the first order.
void RangePair::add_way(Ways& ways, const SmallMotion::Step& step, const Hull& hull, double rounding) {
    double way = step.way;
    if (step.turns) {
        const auto from_axis = [&](const Vector3d& point) { return (point - step.origin).cross(step.axis).norm(); };
        double by_box = 0;
        for (const Vector3d& corner : hull.corners)
            by_box = std::max(by_box, from_axis(corner));
        const double by_ball = from_axis(hull.centre) + hull.radius;
        way *= (std::min(by_box, by_ball) + ways.sum + rounding) * outward_sum;
        ways.rest += step.way * (ways.sum + 0.5 * way) * outward_sum;
    }
    ways.sum += way;
    ways.of_axes.push_back(way);
}

/// Steps are seen from the fixed body in its frame.
PairInCell RangePair::in_cell(const RestPlaces& places, std::span<const double> half) const {
    PairInCell cell;
    cell.ways.resize(half.size());
    if (steps_.empty())
        return cell;
    cell.motion.steps = steps_in_world(places, half);
    const Hull moving = hull_of(prepared_->moving_index(task_), places), fixed = fixed_hull(places);
    const double slack = rounding(places);
    Ways of_moving, of_fixed;
    for (std::size_t i = steps_.size(); i-- > 0;)
        add_way(of_moving, cell.motion.steps[i], moving, slack);
    std::ranges::reverse(of_moving.of_axes);
    for (const SmallMotion::Step& step : cell.motion.steps)
        add_way(of_fixed, step, fixed, slack);
    cell.motion.way_of_moving = of_moving.sum;
    cell.motion.way_of_fixed = of_fixed.sum;
    cell.motion.rest_of_moving = of_moving.rest;
    cell.motion.rest_of_fixed = of_fixed.rest;
    const Ways& less = of_fixed.sum < of_moving.sum ? of_fixed : of_moving;
    for (std::size_t i = 0; i < steps_.size(); ++i)
        cell.ways[steps_[i].axis] += less.of_axes[i];
    const GeneralPose<double> frame = fixed_pose(places);
    for (SmallMotion::Step& step : cell.motion.steps) {
        const motion::Vector3<double> origin = motion::vector_in<double>(step.origin) - frame.translation;
        step.axis = as_eigen(rotated(frame.rotation.conjugate(), motion::vector_in<double>(step.axis)));
        step.origin = as_eigen(rotated(frame.rotation.conjugate(), origin));
    }
    return cell;
}

bool RangePair::is_far_apart(const RestPlaces& places, const PairInCell& cell) const {
    const std::size_t element = prepared_->moving_index(task_);
    const RobotChecker::Prepared::Extent& extent = prepared_->extents[element];
    const Vector3d moving = centre_at(extent, places.element(element));
    Vector3d fixed;
    double radius = 0;
    if (task_.kind == Task::Kind::self) {
        const std::size_t other = prepared_->self_pairs[task_.first].fixed;
        fixed = centre_at(prepared_->extents[other], places.element(other));
        radius = prepared_->extents[other].radius;
    } else {
        fixed = prepared_->obstacles[task_.second].centre;
        radius = prepared_->obstacles[task_.second].radius;
    }
    return (moving - fixed).norm() > (extent.radius + radius + margin_ + cell.way()) * outward_sum + rounding(places);
}

std::vector<RangePair> pairs_of_box(const RobotChecker::Prepared& prepared, std::span<const std::size_t> axis_of) {
    std::vector<RangePair> pairs;
    for (std::size_t i = 0; i < prepared.self_pairs.size(); ++i)
        pairs.emplace_back(prepared, Task{Task::Kind::self, i, 0, {}}, axis_of);
    for (std::size_t e = 0; e < prepared.extents.size(); ++e)
        for (std::size_t o = 0; o < prepared.obstacles.size(); ++o)
            if (!prepared.is_ignored(e, prepared.obstacles[o].body))
                pairs.emplace_back(prepared, Task{Task::Kind::obstacle, e, o, {}}, axis_of);
    return pairs;
}

} // namespace chasles::robot
