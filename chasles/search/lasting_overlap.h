// Does an edge that passes through a face do so for a whole part of a motion? Its points run near their chords.
// Source: docs/derivations/39-profile.md, "Lasting overlaps".
#pragma once

#include <Eigen/Core>

#include <span>

namespace chasles::search {

/// A point at both ends of a part of time; between them it stays near the straight way.
struct ChordPoint {
    Eigen::Vector3d start;
    Eigen::Vector3d end;
};

/// Whether the segment from `first` to `second` is proven to pass through the polygon all along. Points leave their
/// chords by at most `slack`. Each three consecutive corners of the polygon turn the same way.
bool passes_all_along(const ChordPoint& first, const ChordPoint& second, std::span<const ChordPoint> polygon,
                      double slack);

} // namespace chasles::search
