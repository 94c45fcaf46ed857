// One rule makes the motions of every subcommand.
#include "cli/motion_rule.h"

#include "chasles/base/invalid_input.h"
#include "view/names.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace chasles::cli {
namespace {

using view::MotionKind;

constexpr std::array kinds = {MotionKind::screw, MotionKind::sweep, MotionKind::velocity, MotionKind::twist};

/// Throws InvalidInput if the option is given for a motion of a kind that has no such number.
void require_kind(const std::string& option, MotionKind kind, std::initializer_list<MotionKind> right_kinds) {
    if (std::ranges::find(right_kinds, kind) != right_kinds.end())
        return;
    std::string names;
    for (const MotionKind right : right_kinds)
        names += std::string(names.empty() ? "" : " and ") + "--motion " + std::string(view::name_of(right));
    throw InvalidInput(option + ": is for " + names + ", but the motion is a " + std::string(view::name_of(kind)));
}

/// In radians. Dividing first makes 180 degrees exactly the double nearest to pi.
double max_turn_of(const std::string& text, MotionKind kind) {
    if (text.empty())
        return ScrewMotion::default_max_turn;
    require_kind("--max-turn-deg", kind, {MotionKind::screw});
    const double degrees = number_of("--max-turn-deg", text);
    if (degrees > 180)
        throw InvalidInput("--max-turn-deg: must be at most 180, which leaves a screw in one piece");
    return degrees / 180 * std::numbers::pi;
}

} // namespace

std::optional<MotionKind> kind_named(const std::string& name) {
    const auto found = std::ranges::find(kinds, name, [](MotionKind kind) { return view::name_of(kind); });
    return found == kinds.end() ? std::nullopt : std::optional(*found);
}

void add_motion_rule_options(CLI::App& command, MotionOptions& options) {
    std::vector<std::string> names(kinds.size());
    std::ranges::transform(kinds, names.begin(), [](MotionKind kind) { return std::string(view::name_of(kind)); });
    command
        .add_option("--motion", options.motion,
                    "the motion between the poses: screw, sweep, velocity (constant velocity) or twist (constant "
                    "twist)")
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    command
        .add_option("--centre", options.centre,
                    "point of the moving body that a sweep or a constant velocity carries along a line")
        ->type_name("\"X Y Z\"");
    command
        .add_option("--max-turn-deg", options.max_turn_degrees,
                    "a screw that turns by more is cut into equal turns; default 10; 180: one screw in one piece")
        ->type_name("DEGREES");
}

Eigen::Vector3d centre_of(const std::string& option, const std::string& text, MotionKind kind,
                          std::initializer_list<MotionKind> right_kinds) {
    if (text.empty())
        return Eigen::Vector3d::Zero();
    require_kind(option, kind, right_kinds);
    return point_of(option, text);
}

MotionRule rule_of(const MotionOptions& options) {
    const MotionKind kind = kind_named(options.motion).value();
    return {.kind = kind,
            .max_turn = max_turn_of(options.max_turn_degrees, kind),
            .centre = centre_of("--centre", options.centre, kind, {MotionKind::sweep, MotionKind::velocity})};
}

Motion motion_between(const MotionRule& rule, const Pose& start, const Pose& goal) {
    switch (rule.kind) {
    case MotionKind::screw:
        return Motion::screw(start, goal, rule.max_turn);
    case MotionKind::sweep:
        return Motion::sweep(start, goal, rule.centre);
    case MotionKind::velocity:
        return Motion::velocity(start, goal, rule.centre);
    case MotionKind::twist:
        break;
    }
    return Motion::twist(start, goal);
}

TimedPoses track_through(const MotionRule& rule, const std::vector<double>& stamps, const std::vector<Pose>& poses) {
    const auto between = rule.kind == MotionKind::twist ? TimedPoses::Between::twist : TimedPoses::Between::velocity;
    return TimedPoses::through(stamps, poses, between, rule.centre);
}

view::MotionNumbers numbers_between(const MotionRule& rule, const Pose& start, const Pose& goal) {
    switch (rule.kind) {
    case MotionKind::screw:
        return view::numbers_of(ScrewMotion::between(start, goal, rule.max_turn));
    case MotionKind::sweep:
        return view::numbers_of(SweepMotion::between(start, goal, rule.centre));
    case MotionKind::velocity:
        return view::numbers_of(ConstantVelocity::between(start, goal, rule.centre));
    case MotionKind::twist:
        break;
    }
    return view::numbers_of(ConstantTwist::between(start, goal));
}

} // namespace chasles::cli
