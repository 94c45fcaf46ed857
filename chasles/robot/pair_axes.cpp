#include "chasles/robot/pair_axes.h"

#include "chasles/mesh/body.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chasles::robot {

namespace {

/// Of a variable, as on paths.
constexpr double largest_value = 1000;

/// How far the points of an element are from the origin of its group.
double group_reach(const Element& element) {
    const Body& body = element.shape.body();
    return length(placed(element.place.in_double, motion::vector_in<double>(body.bvh().centre()))) + body.ball_radius();
}

/// Goes from the points of one link outwards, to the other link.
class ReachSum {
public:
    /// `groups` are those whose joints are between the links.
    ReachSum(const Model& model, const std::vector<const Element*>& shapes, std::vector<std::size_t> groups)
        : model_(model), groups_(std::move(groups)) {
        for (const Element* element : shapes)
            arm_ = std::max(arm_, group_reach(*element));
    }

    void add_arm(std::size_t group) { arm_ += length(model_.groups[group].origin.in_double.translation); }
    void add_joint(std::size_t group) {
        const RigidGroup& g = model_.groups[group];
        found_.have_limits = found_.have_limits && !g.quaternion && g.steps.size() == 1;
        for (const JointStep& step : g.steps)
            add(step);
    }
    /// With the axis that moves points farthest as the last one.
    PairAxes result() && {
        const auto way = [](const Axis& axis) { return axis.reach * (axis.upper - axis.lower); };
        if (!found_.axes.empty())
            std::ranges::iter_swap(std::ranges::max_element(found_.axes, {}, way), found_.axes.end() - 1);
        return std::move(found_);
    }

private:
    /// A slide brings all joints behind it as much farther away.
    void add(const JointStep& step) {
        Axis& axis = axis_of(step.variable);
        axis.reach += std::abs(step.multiplier) * (step.turns ? arm_ : 1) * outward_sum;
        if (!step.turns)
            arm_ += std::abs(step.multiplier) * std::max(std::abs(axis.lower), std::abs(axis.upper)) +
                    std::abs(step.offset);
    }
    /// A variable may move several joints.
    Axis& axis_of(std::size_t variable) {
        const auto known = std::ranges::find(found_.axes, variable, &Axis::variable);
        if (known != found_.axes.end())
            return *known;
        const RobotVariable& v = model_.variables[variable];
        constexpr double half_turn = std::numbers::pi * outward_sum; // the ends overlap, so no angle is left out
        found_.axes.push_back(needs_one_turn(variable) ? Axis{variable, -half_turn, half_turn, 0}
                                                       : Axis{variable, v.lower, v.upper, 0});
        const Axis& axis = found_.axes.back();
        found_.have_limits =
            found_.have_limits && std::max(std::abs(axis.lower), std::abs(axis.upper)) <= largest_value;
        return found_.axes.back();
    }

    /// Of a variable without limits: all joints between the links are where they were after each turn. Joints elsewhere
    /// may follow it in other ways.
    [[nodiscard]] bool needs_one_turn(std::size_t variable) const {
        const RobotVariable& v = model_.variables[variable];
        return std::isinf(v.lower) && std::isinf(v.upper) && std::ranges::all_of(groups_, [&](std::size_t group) {
                   return model_.groups[group].repeats_after_a_turn(variable);
               });
    }

    const Model& model_;
    std::vector<std::size_t> groups_;
    double arm_ = 0; ///< a bound of the distance of all points from here, in any configuration
    PairAxes found_;
};

} // namespace

/// From the first link up to the first group above both, and down to the second one.
PairAxes axes_between(const Model& model, const std::vector<const Element*>& first,
                      const std::vector<const Element*>& second) {
    std::size_t a = first.front()->group, b = second.front()->group;
    std::vector<std::size_t> up, down;
    while (a != b) {
        const bool goes_up = model.groups[a].depth >= model.groups[b].depth;
        std::size_t& next = goes_up ? a : b;
        (goes_up ? up : down).push_back(next);
        next = model.groups[next].parent;
    }
    std::vector<std::size_t> between = up;
    between.insert(between.end(), down.begin(), down.end());
    ReachSum sum(model, first, std::move(between));
    for (const std::size_t group : up) {
        sum.add_joint(group);
        sum.add_arm(group);
    }
    for (std::size_t i = down.size(); i-- > 0;) {
        sum.add_arm(down[i]);
        sum.add_joint(down[i]);
    }
    return std::move(sum).result();
}

} // namespace chasles::robot
