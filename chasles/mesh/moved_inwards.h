// The faces of a closed body moved inwards: an overlap that is allowed.
// Source: docs/derivations/38-radius.md, "Below zero".
#pragma once

#include "chasles/mesh/body.h"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace chasles {

/// The direction whose least cosine to some unit normals is greatest, with this cosine: the middle of the smallest cap
/// around them. The cosine is 0 where no half space contains all of them, up to rounding.
struct Cap {
    Eigen::Vector3d middle = Eigen::Vector3d::UnitZ(); ///< unit
    double cosine = 1;
};
[[nodiscard]] Cap smallest_cap(std::span<const Eigen::Vector3d> given);

/// The vertices of a body. At each of them, the planes of the faces around it move inwards, against their normals, by
/// at most `distance`, and as evenly as one shift of the vertex moves them. A vertex stays where no shift moves all of
/// them inwards. Throws InvalidInput if the body is not closed or a face turns over.
[[nodiscard]] std::vector<Eigen::Vector3d> moved_inwards(const Body& body, double distance);

} // namespace chasles
