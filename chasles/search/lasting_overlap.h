// Does an edge that passes through a face do so for a whole part of a motion? Its points run near their chords.
// Source: docs/derivations/39-profile.md, "Lasting overlaps".
#pragma once

#include "chasles/contact/contact.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/matrix_pose.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace chasles::search {

/// A point at both ends of a part of time; between them it stays near the straight way.
struct ChordPoint {
    Eigen::Vector3d start;
    Eigen::Vector3d end;
};

/// Whether the segment from `first` to `second` is proven to pass through the polygon all along. Points leave their
/// chords by at most `slack`. The polygon is convex.
bool passes_all_along(const ChordPoint& first, const ChordPoint& second, std::span<const ChordPoint> polygon,
                      double slack);

/// An edge of one body and a face of the other one, in the frame of the fixed body.
class OverlapOnChords {
public:
    /// The face has the id of the library's body. The poses are those of the moving body at both ends.
    OverlapOnChords(const Body& moving, const Body& fixed, const Overlap& overlap,
                    const std::array<motion::MatrixPose, 2>& poses);

    /// Whether the edge is proven to pass through the face all along.
    [[nodiscard]] bool lasts(double slack) const;
    /// The point of the edge in the plane of the face at the start, up to rounding.
    [[nodiscard]] Eigen::Vector3d point() const;

private:
    ChordPoint first_, second_; ///< ends of the edge
    std::vector<ChordPoint> outline_;
    std::span<const std::uint32_t> triangles_; ///< of a face that is not convex
};

} // namespace chasles::search
