// A place where two bodies touch at one tau, and rays that tell what is inside. Source: docs/certificate.md.
#pragma once

#include "chasles/certificate/separating_normal.h"

#include <optional>
#include <string>

namespace chasles::certificate {

/// The line `witness` at a tau; nothing where the bodies only touch by less than rounding, or where the faces there are
/// not convex.
std::optional<std::string> witness_at(const PieceOfBodies& piece, double tau);

/// A vertex of one body and a ray from it: `moving|fixed F C X Y Z`, and how often the other surface winds around it
/// at tau = 0. Nothing if no ray is found that stays away from edges.
struct Ray {
    std::string words;
    int winding = 0;
};
std::optional<Ray> ray_from(const PieceOfBodies& piece, bool from_moving, std::size_t face, std::size_t corner);

} // namespace chasles::certificate
