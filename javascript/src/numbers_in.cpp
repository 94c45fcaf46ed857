// Every message names the argument as JavaScript does.
#include "javascript/src/numbers_in.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/pose_text.h"
#include "chasles/motion/timed_poses.h"

#include <string>

namespace chasles::javascript {
namespace {

using view::MotionKind;

constexpr const char* names[] = {"screw", "sweep", "velocity", "twist"};

/// A point that only motions of a kind have whose points move straight.
Eigen::Vector3d centre_for(const char* name, const std::optional<Eigen::Vector3d>& centre, MotionKind kind) {
    if (centre && !view::moves_straight(kind))
        throw InvalidInput(std::string(name) + ": is for the motions sweep and velocity, but the motion is a " +
                           names[std::size_t(kind)]);
    return centre.value_or(Eigen::Vector3d::Zero());
}

/// "NAME: WHY", also of a reason that begins with the name.
std::string placed(const std::string& name, const std::string& why) {
    return why.starts_with(name + ": ") ? why : name + ": " + why;
}

template <typename Typed>
NamedMotion named(const Typed& motion) {
    return {motion, view::numbers_of(motion)};
}

/// Screws and sweeps are motions of one body as seen from the other one; the even motions are motions in the world.
NamedMotion motion_of_two(const MotionRule& rule, const Pose& start, const Pose& goal, NumbersIn& in) {
    const Pose fixed_start = in.pose("fixedStart");
    const Pose fixed_goal = in.pose("fixedGoal");
    const auto fixed_centre = in.point("fixedCentre");
    if (fixed_centre && rule.kind != MotionKind::velocity)
        throw InvalidInput(std::string("fixedCentre: is for the motion velocity, but the motion is a ") +
                           names[std::size_t(rule.kind)]);
    if (rule.kind == MotionKind::screw)
        return named(ScrewMotion::relative(start, goal, fixed_start, fixed_goal, rule.max_turn));
    if (rule.kind == MotionKind::sweep)
        return named(SweepMotion::relative(start, goal, fixed_start, fixed_goal).about(rule.centre));
    MotionRule fixed_rule = rule;
    fixed_rule.centre = fixed_centre.value_or(Eigen::Vector3d::Zero());
    NamedMotion moving = motion_between(rule, start, goal);
    moving.numbers.is_in_world = true;
    return {relative(moving.motion, motion_between(fixed_rule, fixed_start, fixed_goal).motion), moving.numbers};
}

/// What the numbers of a motion in the world are.
enum class WorldForm : std::uint8_t {
    poses,    ///< a pose, and a flag with a goal
    track,    ///< poses and as many times: even from pose to pose
    spline,   ///< poses and as many times: the natural cubic spline
    b_spline, ///< poses
};

std::vector<double> times_in(NumbersIn& in, std::size_t count) {
    const auto times = in.some(count);
    return {times.begin(), times.end()};
}

Motion track_in(NumbersIn& in, const MotionRule& rule) {
    const std::vector<Pose> poses = in.poses("poses");
    const std::vector<double> times = times_in(in, poses.size());
    if (times.empty() || times.front() != 0 || times.back() != 1)
        throw InvalidInput("times: must run from 0 to 1, which is the time of the whole scene");
    const auto between = rule.kind == MotionKind::twist ? TimedPoses::Between::twist : TimedPoses::Between::velocity;
    return TimedPoses::through(times, poses, between, rule.centre);
}

} // namespace

double NumbersIn::number() {
    return some(1)[0];
}

std::size_t NumbersIn::whole(std::size_t most) {
    const double given = number();
    if (!(given >= 0 && given <= static_cast<double>(most)) || given != static_cast<double>(std::size_t(given)))
        throw InvalidInput("arguments: " + std::to_string(given) + " is no whole number up to " + std::to_string(most));
    return static_cast<std::size_t>(given);
}

std::span<const double> NumbersIn::some(std::size_t count) {
    if (count > rest_.size())
        throw InvalidInput("arguments: there are too few numbers");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
}

std::optional<Eigen::Vector3d> NumbersIn::point(const char* name) {
    if (!flag())
        return std::nullopt;
    const std::size_t count = whole(rest_.size());
    const auto numbers = some(count);
    if (count != 3)
        throw InvalidInput(std::string(name) + ": a point needs 3 numbers, and there are " + std::to_string(count));
    return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

Pose NumbersIn::pose(const std::string& name) {
    try {
        return io::pose_from_numbers(some(whole(rest_.size())));
    } catch (const InvalidInput& error) {
        throw InvalidInput(placed(name, error.what()));
    }
}

std::vector<Pose> NumbersIn::poses(const std::string& name) {
    std::vector<Pose> found(whole(rest_.size()));
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = pose(name + "[" + std::to_string(i) + "]");
    return found;
}

double NumbersIn::time() {
    const double given = number();
    if (!(given >= 0 && given <= 1))
        throw InvalidInput("time: must be in [0, 1]");
    return given;
}

MotionRule rule_in(NumbersIn& in) {
    MotionRule rule;
    rule.kind = static_cast<MotionKind>(in.whole(3));
    if (in.flag()) {
        rule.max_turn = in.number();
        if (rule.kind != MotionKind::screw)
            throw InvalidInput(std::string("maxTurn: is for the motion screw, but the motion is a ") +
                               names[std::size_t(rule.kind)]);
    }
    rule.centre = centre_for("centre", in.point("centre"), rule.kind);
    return rule;
}

NamedMotion motion_between(const MotionRule& rule, const Pose& start, const Pose& goal) {
    switch (rule.kind) {
    case MotionKind::screw:
        return named(ScrewMotion::between(start, goal, rule.max_turn));
    case MotionKind::sweep:
        return named(SweepMotion::between(start, goal, rule.centre));
    case MotionKind::velocity:
        return named(ConstantVelocity::between(start, goal, rule.centre));
    case MotionKind::twist:
        break;
    }
    return named(ConstantTwist::between(start, goal));
}

NamedMotion motion_in(NumbersIn& in) {
    const MotionRule rule = rule_in(in);
    const Pose start = in.pose("start");
    const Pose goal = in.pose("goal");
    return in.flag() ? motion_of_two(rule, start, goal, in) : motion_between(rule, start, goal);
}

Motion world_motion_in(NumbersIn& in) {
    const MotionRule rule = rule_in(in);
    switch (static_cast<WorldForm>(in.whole(std::size_t(WorldForm::b_spline)))) {
    case WorldForm::poses:
        break;
    case WorldForm::track:
        return track_in(in, rule);
    case WorldForm::spline: {
        const std::vector<Pose> poses = in.poses("poses");
        return Motion::spline(times_in(in, poses.size()), poses);
    }
    case WorldForm::b_spline:
        return Motion::b_spline(in.poses("poses"));
    }
    const Pose start = in.pose("pose");
    return in.flag() ? motion_between(rule, start, in.pose("goal")).motion : Motion::at_rest(start);
}

QueryOptions options_in(NumbersIn& in) {
    QueryOptions options;
    options.margin = in.number();
    if (in.flag())
        options.hold = in.number();
    options.time_tolerance = in.number();
    options.find = static_cast<Find>(in.whole(2));
    return options;
}

LeastDistanceOptions least_options_in(NumbersIn& in) {
    LeastDistanceOptions options;
    options.tolerance = in.number();
    options.time_tolerance = in.number();
    options.find = static_cast<Find>(in.whole(2));
    return options;
}

ProfileOptions profile_options_in(NumbersIn& in) {
    ProfileOptions options;
    options.tolerance = in.number();
    options.absolute_tolerance = in.number();
    options.time_tolerance = in.number();
    const auto margins = in.some(std::size_t(in.number()));
    options.margins.assign(margins.begin(), margins.end());
    return options;
}

} // namespace chasles::javascript
