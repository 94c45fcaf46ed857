// chasles scene --clearance: how near the bodies of a scene come to each other.
#pragma once

#include "chasles/query/least_distance.h"
#include "cli/commands.h"
#include "cli/scene_file.h"

#include <string>

namespace chasles::cli {

struct SceneClearanceQuestion {
    const SceneFile& file;
    LeastDistanceOptions options;
    std::string seconds; ///< empty: no limit
    bool json;
};

/// Prints the answer, and returns the exit status.
int run_scene_clearance(const SceneClearanceQuestion& question);

} // namespace chasles::cli
