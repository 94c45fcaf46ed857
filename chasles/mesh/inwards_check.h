// Whether the faces of a body have moved inwards, whatever moved them.
// Source: docs/derivations/38-radius.md, "Below zero".
#pragma once

#include "chasles/mesh/body.h"

#include <Eigen/Core>
#include <span>

namespace chasles {

/// Where the vertices of a body shall go.
struct InwardsMove {
    const Body& body;
    std::span<const Eigen::Vector3d> directions; ///< of the faces, see face_directions.h
    std::span<const Eigen::Vector3d> moved;      ///< the vertices
    double distance;
    double flat; ///< what lies within this length counts as one plane
};

/// Throws InvalidInput, with a face, unless all of this holds:
/// - the corners of each face move against its direction, by at most the distance;
/// - no vertex leaves the body through another face;
/// - no face lies on a face beside it and looks the other way;
/// - no face turns over, but where its corners do not move along the directions of the faces beside it.
void require_inwards(const InwardsMove& move);

} // namespace chasles
