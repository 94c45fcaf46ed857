#include "chasles/robot/range_pairs.h"

#include "chasles/motion/screw_path.h"
#include "chasles/robot/element_places.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;
using motion::GeneralPose;
using Prepared = RobotChecker::Prepared;

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

std::array<Vector3d, 8> placed_corners(const Prepared::Extent& extent, const GeneralPose<double>& pose) {
    std::array<Vector3d, 8> corners = corners_of(extent.centre, extent.half);
    for (Vector3d& corner : corners)
        corner = as_eigen(placed(pose, motion::vector_in<double>(corner)));
    return corners;
}

} // namespace

RestPlaces::RestPlaces(const Prepared& prepared, const SegmentMotion& motion) : prepared_(prepared) {
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

RangePair::RangePair(const Prepared& prepared, const Task& task, std::span<const std::size_t> axis_of)
    : prepared_(&prepared), task_(task) {
    const Model& model = prepared.model();
    const bool is_self = task.kind == Task::Kind::self;
    const std::size_t moving = model.elements[prepared.moving_index(task)].group;
    const std::size_t fixed = is_self ? model.elements[prepared.self_pairs[task.first].fixed].group : 0;
    margin_ = is_self ? prepared.self_pairs[task.first].margin : prepared.options.margin;
    greatest_depth_ = outward_sum * std::max(prepared.moving(task).shape.body().ball_radius(),
                                             prepared.fixed_shape(task).body().ball_radius()) +
                      margin_;
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

/// The turn of a group is its last step, so that its axis goes through the origin of the group.
void RangePair::add(std::size_t group, std::span<const std::size_t> axis_of) {
    for (const JointStep& step : prepared_->model().groups[group].steps)
        if (axis_of[step.variable] != none && step.multiplier != 0)
            steps_.push_back(
                {axis_of[step.variable], group, std::abs(step.multiplier), step.turns, step.axis.in_double});
}

Eigen::Isometry3d RangePair::relative(const RestPlaces& places) const {
    const GeneralPose<double> moving = places.element(prepared_->moving_index(task_));
    const GeneralPose<double> pose =
        task_.kind == Task::Kind::self ? seen_from(places.element(prepared_->self_pairs[task_.first].fixed), moving)
                                       : seen_from(prepared_->obstacles[task_.second].pose.in_double, moving);
    const auto& [w, v] = pose.rotation;
    Eigen::Isometry3d isometry(Eigen::Quaterniond(w, v.x, v.y, v.z).normalized());
    isometry.translation() = as_eigen(pose.translation);
    return isometry;
}

RangePair::Hull RangePair::moving_hull(const RestPlaces& places) const {
    const std::size_t element = prepared_->moving_index(task_);
    const Prepared::Extent& extent = prepared_->extents[element];
    const GeneralPose<double> pose = places.element(element);
    return {placed_corners(extent, pose), centre_at(extent, pose), extent.radius};
}

RangePair::Hull RangePair::fixed_hull(const RestPlaces& places) const {
    if (task_.kind == Task::Kind::self) {
        const std::size_t element = prepared_->self_pairs[task_.first].fixed;
        const Prepared::Extent& extent = prepared_->extents[element];
        const GeneralPose<double> pose = places.element(element);
        return {placed_corners(extent, pose), centre_at(extent, pose), extent.radius};
    }
    const Prepared::Obstacle& obstacle = prepared_->obstacles[task_.second];
    const scene::Box& box = obstacle.box;
    return {corners_of(box.center(), 0.5 * box.sizes()), obstacle.centre, obstacle.radius};
}

/// The greatest distance of a point of the body from the axis of a step.
double RangePair::distance(const Hull& hull, const Step& step, const RestPlaces& places) {
    const GeneralPose<double>& pose = places.group(step.group);
    const Vector3d origin = as_eigen(pose.translation), axis = as_eigen(rotated(pose.rotation, step.direction));
    const auto from_axis = [&](const Vector3d& point) { return (point - origin).cross(axis).norm(); };
    double by_box = 0;
    for (const Vector3d& corner : hull.corners)
        by_box = std::max(by_box, from_axis(corner));
    const double by_ball = from_axis(hull.centre) + hull.radius;
    return std::min(by_box, by_ball) * outward_sum +
           rounding_of_places * (places.size() + origin.lpNorm<1>() + hull.centre.lpNorm<1>() + hull.radius);
}

/// What a step adds, where the steps between it and the points have moved them by at most `so_far`.
double RangePair::add_way(std::vector<double>& ways, const Step& step, const Hull& hull, double so_far,
                          const RestPlaces& places, std::span<const double> half) const {
    const double reach = step.turns ? distance(hull, step, places) + so_far : 1;
    const double way = step.multiplier * half[step.axis] * reach * outward_sum;
    ways[step.axis] += way;
    return way;
}

std::vector<double> RangePair::displacements(const RestPlaces& places, std::span<const double> half) const {
    std::vector<double> of_moving(half.size()), of_fixed(half.size());
    if (steps_.empty())
        return of_moving;
    const Hull moving = moving_hull(places), fixed = fixed_hull(places);
    double sum_of_moving = 0, sum_of_fixed = 0;
    for (std::size_t i = steps_.size(); i-- > 0;)
        sum_of_moving += add_way(of_moving, steps_[i], moving, sum_of_moving, places, half);
    for (const Step& step : steps_)
        sum_of_fixed += add_way(of_fixed, step, fixed, sum_of_fixed, places, half);
    return sum_of_fixed < sum_of_moving ? of_fixed : of_moving;
}

std::vector<RangePair> pairs_of_box(const Prepared& prepared, std::span<const std::size_t> axis_of) {
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
