// Scene files: bodies, motions and filters as JSON. docs/command-line.md describes the keys.
#pragma once

#include "chasles/chasles.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace chasles::cli {

struct SceneFile {
    Scene scene;
    double margin = 0;
    std::optional<double> hold;
    bool ignores_touching_at_start = false; ///< done to the scene; a command may refuse it
    std::string motion; ///< how the bodies move: "velocity", "twist", "velocity and twist", or "rest"
    std::vector<std::string> warnings = {}; ///< of the robots that are bodies
};

/// An answer about a scene file, with its motion and its warnings, as a line of text.
std::string json_line(nlohmann::ordered_json answer, const SceneFile& file);

/// Reads a scene and its meshes, whose paths are relative to the file. Each mesh is loaded once. `margin` counts
/// instead of that of the file, also for what touches at the start. Throws InvalidInput "FILE: PLACE: WHY", for an
/// unknown key and for a key that comes twice, too.
SceneFile load_scene(const std::filesystem::path& file, const PolyhedronOptions& options,
                     std::optional<double> margin = {});

} // namespace chasles::cli
