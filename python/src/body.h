// A polyhedron as Python holds it.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <memory>
#include <vector>

namespace chasles::python {

using Faces = std::vector<std::vector<std::uint32_t>>;

struct Body {
    Polyhedron polyhedron;
    /// What it was made from, where that cannot be told from the polyhedron: faces were dropped or cut.
    std::shared_ptr<const Faces> given_faces;
    PolyhedronOptions options;
};

} // namespace chasles::python
