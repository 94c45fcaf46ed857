#include "chasles/robot/group_motion.h"

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/screw_path.h"

#include <cmath>

namespace chasles::robot {

namespace {

using motion::GeneralPose;
using motion::RateBounds;

/// The reference moves out by an arm that turns with the group.
void go_out(RateBounds& bounds, double arm) {
    bounds.speed += bounds.turn_rate * arm;
    bounds.acceleration += (bounds.turn_acceleration + bounds.turn_rate * bounds.turn_rate) * arm;
}

void apply(GeneralPose<double>& pose, const motion::FixedAxis& axis, bool turns, double value) {
    if (turns) {
        const auto [sine, cosine] = algebra::sine_cosine(0.5 * value);
        pose.rotation = pose.rotation * motion::Quaternion<double>{cosine, scale(axis.in_double, sine)};
    } else {
        pose.translation = pose.translation + rotated(pose.rotation, scale(axis.in_double, value));
    }
}

} // namespace

GroupRates::GroupRates(const Model& model, const SegmentMotion& motion) : steps_(model.groups.size()) {
    for (std::size_t g = 0; g < steps_.size(); ++g) {
        const RigidGroup& group = model.groups[g];
        steps_[g].origin = length(group.origin.in_double.translation);
        for (std::size_t i = 0; i < group.steps.size(); ++i)
            steps_[g].add(*motion.values[g][i], group.steps[i].turns);
        if (group.quaternion)
            steps_[g].add(*motion.turns.at(g).joint.value, true);
    }
}

void GroupRates::Steps::add(const motion::TimePolynomial& value, bool turns) {
    const motion::PolynomialRates rates = value.rates({0, 1});
    if (turns) {
        turn_acceleration += rates.bounds[1];
        turn_rate += rates.bounds[0];
    } else {
        slide += value.size();
        slide_rate += rates.bounds[0];
        slide_acceleration += rates.bounds[1];
    }
}

/// The turn comes first, whatever the order of the steps. Then its rates count for the slides.
void GroupRates::Steps::apply_to(RateBounds& bounds) const {
    bounds.turn_acceleration += turn_acceleration + bounds.turn_rate * turn_rate;
    bounds.turn_rate += turn_rate;
    if (slide == 0)
        return;
    go_out(bounds, slide);
    bounds.acceleration += slide_acceleration + 2 * bounds.turn_rate * slide_rate;
    bounds.speed += slide_rate;
}

void GroupRates::go_down(RateBounds& bounds, std::size_t group) const {
    go_out(bounds, steps_[group].origin);
    steps_[group].apply_to(bounds);
}

void GroupRates::go_up(RateBounds& bounds, std::size_t group) const {
    steps_[group].apply_to(bounds);
    go_out(bounds, steps_[group].origin);
}

Placements::Placements(const Model& model, const SegmentMotion& motion, std::size_t intervals)
    : model_(model), motion_(motion), intervals_(intervals), base_(motion::FixedPose(model.base).in_double),
      poses_(intervals + 1) {}

void Placements::make(std::size_t index) {
    std::vector<GeneralPose<double>>& poses = poses_[index];
    poses.reserve(model_.groups.size());
    poses.push_back(base_);
    for (std::size_t g = 1; g < model_.groups.size(); ++g)
        poses.push_back(placed_group(g, double(index) / double(intervals_), poses[model_.groups[g].parent]));
}

GeneralPose<double> Placements::placed_group(std::size_t group, double time, const GeneralPose<double>& parent) const {
    const RigidGroup& g = model_.groups[group];
    GeneralPose<double> pose = product(parent, g.origin.in_double);
    for (std::size_t i = 0; i < g.steps.size(); ++i)
        apply(pose, g.steps[i].axis, g.steps[i].turns, motion_.values[group][i]->at(time));
    if (g.quaternion) {
        const auto& [start, joint] = motion_.turns.at(group);
        pose = product(pose, start.in_double);
        apply(pose, joint.axis, true, joint.value->at(time));
    }
    return pose;
}

} // namespace chasles::robot
