// Everything that a page shows, as JSON: the one source for the command line and for Python.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::view {

/// An answered query and how to name it. Holds references: for passing on, not for keeping.
struct Scene {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    const Motion& motion;
    const FirstContact& found;
    double max_turn = std::numbers::pi / 18; ///< of the query; radians
    double margin = 0;                       ///< of the query; mesh unit
    std::string title = "Chasles";           ///< UTF-8; what is not is replaced
    std::string moving_name = "moving";
    std::string fixed_name = "fixed";
};

/// One object in ASCII without "<", safe inside a script element of a page. docs/decisions/0070-viewer.md lists its
/// keys.
std::string scene_json(const Scene& scene);

} // namespace chasles::view
