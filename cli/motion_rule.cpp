// One rule makes the motions of every subcommand.
#include "cli/motion_rule.h"

#include "chasles/base/invalid_input.h"
#include "view/names.h"

#include <algorithm>
#include <array>

namespace chasles::cli {
namespace {

using view::MotionKind;

constexpr std::array kinds = {MotionKind::screw, MotionKind::sweep, MotionKind::velocity, MotionKind::twist};

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
}

Eigen::Vector3d centre_of(const std::string& option, const std::string& text, MotionKind kind,
                          std::initializer_list<MotionKind> right_kinds) {
    if (text.empty())
        return Eigen::Vector3d::Zero();
    if (std::ranges::find(right_kinds, kind) == right_kinds.end()) {
        std::string names;
        for (const MotionKind right : right_kinds)
            names += std::string(names.empty() ? "" : " and ") + "--motion " + std::string(view::name_of(right));
        throw InvalidInput(option + ": is for " + names + ", but the motion is a " + std::string(view::name_of(kind)));
    }
    return point_of(option, text);
}

MotionRule rule_of(const MotionOptions& options, const QuestionOptions& query) {
    const MotionKind kind = kind_named(options.motion).value();
    return {.kind = kind,
            .max_turn = max_turn_of(query),
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
