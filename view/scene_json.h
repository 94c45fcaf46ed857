// All data of a page as JSON, shared by the command line and Python.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::view {

/// An answered query and its names. A Scene holds references: bodies, motion and answer must outlive the Scene.
struct Scene {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    const Motion& motion;
    const FirstContact& found;
    double max_turn = std::numbers::pi / 18; ///< max_turn of the query, radians
    double margin = 0;                       ///< margin of the query, mesh unit
    std::string title = "Chasles";           ///< UTF-8; invalid bytes are replaced
    std::string moving_name = "moving";
    std::string fixed_name = "fixed";
};

/// One JSON object in ASCII without "<", safe inside a script element of a page. docs/decisions/0070-viewer.md lists
/// the keys.
std::string scene_json(const Scene& scene);

} // namespace chasles::view
