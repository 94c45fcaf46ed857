// The surface of a round body as the viewer draws it: balls around vertices, tubes around edges, and faces moved out.
#pragma once

#include "view/drawn_mesh.h"

namespace chasles::view {

/// Adds the surface at the radius of the body. Its polyhedron is inside and not drawn. Of more than 20,000 vertices
/// only some have balls.
void add_round_surface(DrawnMesh& drawn, const Polyhedron& body);

} // namespace chasles::view
