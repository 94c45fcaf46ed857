// A polyhedron as a Python object.
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
    /// The faces that the polyhedron was made from. Null unless faces were dropped or cut.
    std::shared_ptr<const Faces> given_faces;
    PolyhedronOptions options;
};

/// The two bodies of a query.
struct BodyPair {
    const Polyhedron& moving;
    const Polyhedron& fixed;
};

/// The polyhedron of an argument. Throws Python's TypeError if the argument is not a chasles.Polyhedron.
inline const Polyhedron& polyhedron_of(nanobind::handle argument, const char* name) {
    const Body* body = nullptr;
    if (!nanobind::try_cast(argument, body) || !body)
        throw nanobind::type_error((std::string(name) + ": must be a chasles.Polyhedron").c_str());
    return body->polyhedron;
}

} // namespace chasles::python
