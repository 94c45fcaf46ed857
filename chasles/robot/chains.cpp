// Chains of joints between two places of a robot. Source: docs/derivations/29-robots.md, "Chains".
#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/screw_path.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

using motion::Chain;
using motion::ElementaryJoint;
using motion::FixedAxis;
using motion::FixedPose;
using motion::Quaternion;
using motion::TimePolynomial;
using motion::Vector3;
using Wide = algebra::DoubleDouble;

/// A coefficient with what rounding has taken from it.
Wide coefficient(const JointPath::Segment& segment, Eigen::Index power, std::size_t variable) {
    const auto i = Eigen::Index(variable);
    const Wide high(segment.coefficients(power, i));
    return segment.remainders.size() > 0 ? high + Wide(segment.remainders(power, i)) : high;
}

std::shared_ptr<const TimePolynomial> value_of(const JointStep& step, const JointPath::Segment& segment) {
    std::vector<Wide> values;
    for (Eigen::Index power = 0; power < segment.coefficients.rows(); ++power)
        values.push_back(Wide(step.multiplier) * coefficient(segment, power, step.variable));
    values[0] = values[0] + Wide(step.offset);
    while (values.size() > 1 && values.back() == Wide(0.0))
        values.pop_back();
    return std::make_shared<const TimePolynomial>(std::move(values));
}

/// Sine and cosine are exact enough up to 1000, and take half of an angle.
void check_value(const JointStep& step, const motion::TimePolynomial& value, const std::string& variable) {
    const double largest = step.turns ? 2000 : Pose::largest_length;
    const double ends = std::max(std::abs(value.at(0.0)), std::abs(value.at(1.0)));
    if (!((value.is_straight() ? ends : value.size()) <= largest))
        refuse(variable, "moves a joint too far: by more than 2000 radians, or 1e30");
}

/// The quaternion (x, y, z, w) at an end of a straight segment, of unit length.
Quaternion<Wide> quaternion_at(const JointPath::Segment& segment, std::size_t first, bool is_goal) {
    std::array<Wide, 4> q;
    for (std::size_t i = 0; i < 4; ++i) {
        q[i] = coefficient(segment, 0, first + i);
        if (is_goal && segment.coefficients.rows() > 1)
            q[i] = q[i] + coefficient(segment, 1, first + i);
    }
    const Quaternion<Wide> given{q[3], {q[0], q[1], q[2]}};
    const Wide inverse = Wide(1.0) / sqrt(given.squared_norm());
    return {given.w * inverse, scale(given.v, inverse)};
}

} // namespace

/// The even turn from one orientation to another, the shorter way round, about an axis in the turning frame.
SegmentMotion::Turn turn_of(const JointPath::Segment& segment, std::size_t first) {
    const Quaternion<Wide> start = quaternion_at(segment, first, false);
    Quaternion<Wide> turn = start.conjugate() * quaternion_at(segment, first, true);
    if (turn.w < Wide(0.0))
        turn = {-turn.w, Vector3<Wide>() - turn.v};
    const Wide sine = length(turn.v);
    const bool turns = Wide(0.0) < sine;
    const Wide angle = turns ? Wide(2.0) * algebra::angle_of({sine, turn.w}) : Wide(0.0);
    const Vector3<Wide> axis = turns ? scale(turn.v, Wide(1.0) / sine) : Vector3<Wide>{Wide(0.0), Wide(0.0), Wide(1.0)};
    const auto value = std::make_shared<const TimePolynomial>(std::vector<Wide>{Wide(0.0), angle});
    return {FixedPose(motion::GeneralPose<Wide>{{}, start}), {FixedAxis(axis), value, true, false}};
}

SegmentMotion Model::motion_of(const JointPath::Segment& segment) const {
    SegmentMotion motion;
    motion.values.resize(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const JointStep& step : groups[g].steps) {
            motion.values[g].push_back(value_of(step, segment));
            check_value(step, *motion.values[g].back(), variables[step.variable].name);
        }
        if (groups[g].quaternion)
            motion.turns.emplace(g, turn_of(segment, *groups[g].quaternion));
    }
    return motion;
}

/// From the group `above` down to a group below it.
void Model::add_down(Chain& chain, const SegmentMotion& motion, std::size_t group, std::size_t above) const {
    if (group == above)
        return;
    const RigidGroup& g = groups[group];
    add_down(chain, motion, g.parent, above);
    chain.add(g.origin);
    for (std::size_t i = 0; i < g.steps.size(); ++i)
        chain.add(ElementaryJoint{g.steps[i].axis, motion.values[group][i], g.steps[i].turns, false});
    if (g.quaternion) {
        const SegmentMotion::Turn& turn = motion.turns.at(group);
        chain.add(turn.start);
        chain.add(turn.joint);
    }
}

/// From a group up to the group `above`: the same backwards.
void Model::add_up(Chain& chain, const SegmentMotion& motion, std::size_t group, std::size_t above) const {
    for (; group != above; group = groups[group].parent) {
        const RigidGroup& g = groups[group];
        if (g.quaternion) {
            const SegmentMotion::Turn& turn = motion.turns.at(group);
            ElementaryJoint back = turn.joint;
            back.is_inverse = true;
            chain.add(back);
            chain.add(turn.start.inverse());
        }
        for (std::size_t i = g.steps.size(); i-- > 0;)
            chain.add(ElementaryJoint{g.steps[i].axis, motion.values[group][i], g.steps[i].turns, true});
        chain.add(g.origin.inverse());
    }
}

Chain Model::chain(const SegmentMotion& motion, std::size_t group, const FixedPose& place) const {
    Chain chain;
    add_chain(chain, motion, group, place);
    return chain;
}

void Model::add_chain(Chain& chain, const SegmentMotion& motion, std::size_t group, const FixedPose& place) const {
    chain.add(FixedPose(base));
    add_down(chain, motion, group, 0);
    chain.add(place);
}

FixedPose Model::place_of(const SegmentMotion& motion, std::size_t group, const FixedPose& place, double time) const {
    return FixedPose(motion::chain_frame(chain(motion, group, place))->refined_at(Wide(time)));
}

Pose Model::pose_of(const SegmentMotion& motion, std::size_t owner, double time) const {
    return motion::rounded(place_of(motion, owners[owner].group, owners[owner].place, time).refined);
}

/// Each group is placed by the group above it, once.
std::vector<Pose> Model::link_poses(const SegmentMotion& motion, double time) const {
    std::vector<FixedPose> of_groups{FixedPose(base)};
    for (std::size_t g = 1; g < groups.size(); ++g) {
        Chain chain;
        chain.add(of_groups[groups[g].parent]);
        add_down(chain, motion, g, groups[g].parent);
        of_groups.emplace_back(motion::chain_frame(std::move(chain))->refined_at(Wide(time)));
    }
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < description.links.size(); ++i)
        poses.push_back(motion::rounded((of_groups[owners[i].group] * owners[i].place).refined));
    return poses;
}

Chain Model::chain_between(const SegmentMotion& motion, const Element& from, const Element& to) const {
    std::size_t a = from.group, b = to.group; // their first common group above
    while (a != b)
        (groups[a].depth >= groups[b].depth ? a : b) = groups[groups[a].depth >= groups[b].depth ? a : b].parent;
    Chain chain;
    chain.add(from.place.inverse());
    add_up(chain, motion, from.group, a);
    add_down(chain, motion, to.group, a);
    chain.add(to.place);
    return chain;
}

} // namespace chasles::robot
