// One motion between two poses, shared by several subcommands: the options, the query and its answer.
#pragma once

#include "cli/options.h"

#include <optional>

namespace chasles::cli {

struct OneMotionOptions {
    BodyOptions bodies;
    QueryOptions query;
    std::string start;
    std::string goal;
    std::string fixed_start;
    std::string fixed_goal;
    std::string motion = "screw";
    std::string centre = "0 0 0";
    std::string hold; ///< empty: none
};

/// A query that owns its bodies.
struct OneMotion {
    Motion motion;
    double margin;
    std::optional<double> hold;
    double time_tolerance;
    double max_turn; ///< radians
    Find find;
    Bodies bodies;
};

void add_one_motion_options(CLI::App& command, OneMotionOptions& options);

/// Reads poses, numbers and bodies. Throws InvalidInput.
OneMotion read_one_motion(const OneMotionOptions& options);

FirstContact first_contact(const OneMotion& question);

} // namespace chasles::cli
