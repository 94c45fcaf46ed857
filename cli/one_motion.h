// One motion between two poses, shared by several subcommands: the options, the query and its answer.
#pragma once

#include "cli/motion_rule.h"
#include "cli/options.h"

#include <optional>

namespace chasles::cli {

struct OneMotionOptions {
    BodyOptions bodies;
    QuestionOptions query;
    std::string start;
    std::string goal;
    std::string fixed_start;
    std::string fixed_goal;
    MotionOptions motion;
    std::string fixed_centre; ///< empty: the origin of the fixed body
};

/// A query that owns its bodies.
struct OneMotion {
    Motion motion;
    view::MotionNumbers numbers; ///< of the motion
    QueryOptions options;
    double seconds; ///< limit of the answer
    Bodies bodies;
};

/// The options of the bodies and of the motion, and with those of the query.
void add_motion_options(CLI::App& command, OneMotionOptions& options);
void add_one_motion_options(CLI::App& command, OneMotionOptions& options);

/// Reads poses, numbers and bodies, and prints warnings about the bodies. Throws InvalidInput.
OneMotion read_one_motion(const OneMotionOptions& options);

FirstContact first_contact(const OneMotion& question);

} // namespace chasles::cli
