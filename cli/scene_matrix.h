// chasles scene --matrix: how near each two bodies of a scene come to each other.
#pragma once

#include "chasles/query/least_distance.h"
#include "cli/scene_file.h"

#include <string>

namespace chasles::cli {

struct SceneMatrixQuestion {
    const SceneFile& file;
    LeastDistanceOptions options;
    unsigned threads = 0;
    std::string seconds; ///< empty: no limit
    bool json = false;
    std::string csv;  ///< empty: none
    std::string plot; ///< likewise
    std::string page; ///< likewise
    std::string title;
    bool wants_curve = false; ///< on the page
};

/// Prints the answer, writes the files, and returns the exit status.
int run_scene_matrix(const SceneMatrixQuestion& question);

} // namespace chasles::cli
