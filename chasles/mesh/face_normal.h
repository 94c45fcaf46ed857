// The unit normal of a face, with a bound of its error. Source: docs/derivations/18-contact-set.md, "Which pairs".
#pragma once

#include "chasles/mesh/body.h"

namespace chasles {

struct FaceNormal {
    Eigen::Vector3d unit;
    double error; ///< of the direction, radians; at most 1. A normal with the error 1 is arbitrary

    /// A normal with a larger error gives no plane: the face is a line, up to rounding.
    [[nodiscard]] bool has_plane() const { return error <= 0x1p-7; }
};

/// Newell's normal of a face, computed at the size of one, where nothing underflows. For a face so thin that it
/// vanishes in rounding: any unit vector at a right angle to its longest diagonal.
FaceNormal face_normal(const Body& body, std::uint32_t face);

} // namespace chasles
