// The polyhedra of a question.
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/mesh/polyhedron.h"
#include "tests/attack/shapes.h"
#include "tests/attack/tally.h"

#include <optional>

namespace chasles::attack {

struct TwoBodies {
    Polyhedron moving;
    Polyhedron fixed;
};

/// Surfaces: the references know no volumes, and `check_inside` asks again about solid bodies. Empty, and counted, if
/// the library refuses one of the meshes.
inline std::optional<TwoBodies> bodies_of(const Shape& moving, const Shape& fixed, Tally& tally) {
    try {
        return TwoBodies{Polyhedron::from_polygons(moving.vertices, moving.faces, {.solid = Solid::no}),
                         Polyhedron::from_polygons(fixed.vertices, fixed.faces, {.solid = Solid::no})};
    } catch (const InvalidInput&) {
        ++tally.refused;
        return std::nullopt;
    }
}

} // namespace chasles::attack
