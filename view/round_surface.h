// The surface of a round body as the viewer draws it: balls around vertices, tubes around edges, and faces moved out.
#pragma once

#include "view/drawn_mesh.h"

#include <string>

namespace chasles::view {

/// Adds the surface at the radius of the body. Its polyhedron is inside and not drawn. Of more than 20,000 vertices
/// only as many have balls, and of more edges only as many have tubes: always the same ones, without a pattern. The
/// more there are, the fewer corners each one has: from 24 around down to 4.
void add_round_surface(DrawnMesh& drawn, const Polyhedron& body);

/// Which part of a round body is drawn: "20000 of 100000 points". Empty if nothing is left out.
std::string drawn_in_part(const Polyhedron& body);

} // namespace chasles::view
