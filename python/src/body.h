// A polyhedron as a Python object.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <nanobind/nanobind.h>
#include <string>

namespace chasles::python {

struct Body {
    Polyhedron polyhedron;
    unsigned threads = 0; ///< that build the hierarchy of a copy
};

/// The two bodies of a query.
struct BodyPair {
    const Polyhedron& moving;
    const Polyhedron& fixed;
};

/// "moving: must be a chasles.Polyhedron", with the way to one from a mesh of another package.
inline std::string no_polyhedron(nanobind::handle argument, const char* name) {
    const std::string text = std::string(name) + ": must be a chasles.Polyhedron";
    if (nanobind::isinstance<Body>(argument)) // its attributes come here, too
        return text + "; nothing was put into this one";
    const std::string type = nanobind::inst_name(argument).c_str();
    if (nanobind::hasattr(argument, "vertices") && nanobind::hasattr(argument, "faces"))
        return text + ", not a " + type + "; chasles.from_trimesh makes one of a trimesh.Trimesh";
    if (nanobind::hasattr(argument, "graph") && nanobind::hasattr(argument, "geometry"))
        return text + ", not a " + type + "; chasles.parts_from_trimesh makes one of each part of a trimesh.Scene";
    return text;
}

/// The polyhedron of an argument. Throws Python's TypeError if the argument is not a chasles.Polyhedron.
inline const Polyhedron& polyhedron_of(nanobind::handle argument, const char* name) {
    const Body* body = nullptr;
    if (!nanobind::try_cast(argument, body) || !body)
        throw nanobind::type_error(no_polyhedron(argument, name).c_str());
    return body->polyhedron;
}

} // namespace chasles::python
