// The options that say how a body moves between two poses, and the motion that they make.
#pragma once

#include "cli/options.h"
#include "view/motion_numbers.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace chasles::cli {

struct MotionOptions {
    std::string motion = "screw"; ///< one default for every subcommand and every file, with time stamps or without
    std::string centre;           ///< empty: the origin of the moving body
    std::string max_turn_degrees; ///< empty: the default
};

/// How a body moves from one pose to the next.
struct MotionRule {
    view::MotionKind kind = view::MotionKind::screw;
    double max_turn = ScrewMotion::default_max_turn;  ///< of a screw, radians
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of a sweep and of a constant velocity
};

/// Empty if there is no motion of this name.
std::optional<view::MotionKind> kind_named(const std::string& name);

void add_motion_rule_options(CLI::App& command, MotionOptions& options);

/// Throws InvalidInput for numbers that cannot be read, and for a centre or a largest turn of a motion that has none.
MotionRule rule_of(const MotionOptions& options);

/// The point given for an option, or the origin if there is no text. Throws InvalidInput if a point is given for a
/// motion of a kind that is not in `right_kinds`.
Eigen::Vector3d centre_of(const std::string& option, const std::string& text, view::MotionKind kind,
                          std::initializer_list<view::MotionKind> right_kinds);

Motion motion_between(const MotionRule& rule, const Pose& start, const Pose& goal);
/// Through stamped poses at constant velocity or by constant twists.
TimedPoses track_through(const MotionRule& rule, const std::vector<double>& stamps, const std::vector<Pose>& poses);
view::MotionNumbers numbers_between(const MotionRule& rule, const Pose& start, const Pose& goal);

} // namespace chasles::cli
