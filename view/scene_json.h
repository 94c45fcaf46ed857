// All data of a page as JSON, shared by the command line and Python.
#pragma once

#include "view/curve.h"
#include "view/motion_numbers.h"

#include <optional>
#include <string>

namespace chasles::view {

/// An answered query and its names. A Scene holds references: bodies, motion, numbers and answer must outlive it.
struct Scene {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    const Motion& motion;
    const MotionNumbers& numbers; ///< of the motion
    const FirstContact& found;
    double margin = 0;             ///< margin of the query, mesh unit
    std::string title = "Chasles"; ///< UTF-8; invalid bytes are replaced
    std::string moving_name = "moving";
    std::string fixed_name = "fixed";
    std::optional<Curve> curve = {}; ///< of the whole motion
};

/// One JSON object in ASCII without "<", safe inside a script element of a page. docs/decisions/0070-viewer.md lists
/// the keys.
std::string scene_json(const Scene& scene);

} // namespace chasles::view
