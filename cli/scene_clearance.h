// chasles scene --clearance and --profile: how near the bodies of a scene come to each other.
#pragma once

#include "chasles/query/least_distance.h"
#include "cli/commands.h"
#include "cli/profile_report.h"
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

struct SceneProfileQuestion {
    const SceneFile& file;
    const ProfileFlags& flags;
    std::string tolerance; ///< empty: that of the library
    std::string seconds;   ///< empty: no limit
    bool json;
};

/// Likewise.
int run_scene_profile(const SceneProfileQuestion& question);

} // namespace chasles::cli
