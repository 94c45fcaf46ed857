// A polyhedron as Python holds it.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <memory>
#include <nanobind/nanobind.h>
#include <string>
#include <vector>

namespace chasles::python {

using Faces = std::vector<std::vector<std::uint32_t>>;

struct Body {
    Polyhedron polyhedron;
    /// What it was made from, where that cannot be told from the polyhedron: faces were dropped or cut.
    std::shared_ptr<const Faces> given_faces;
    PolyhedronOptions options;
};

/// Of an argument. Throws Python's TypeError if it is another thing.
inline const Polyhedron& polyhedron_of(nanobind::handle argument, const char* name) {
    const Body* body = nullptr;
    if (!nanobind::try_cast(argument, body) || !body)
        throw nanobind::type_error((std::string(name) + ": must be a chasles.Polyhedron").c_str());
    return body->polyhedron;
}

} // namespace chasles::python
