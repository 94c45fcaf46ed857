// The directions along which the faces of a body may move, and the faces beside a face.
// Source: docs/derivations/38-radius.md, "Below zero".
#pragma once

#include "chasles/mesh/body.h"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace chasles {

/// The faces that share a side with a face, side by side.
[[nodiscard]] std::vector<std::uint32_t> faces_beside(const Body& body, std::uint32_t face);

/// How far some corners are from each other along a direction: a face is so thick, seen from its side.
[[nodiscard]] double thickness(std::span<const Eigen::Vector3d> vertices, std::span<const std::uint32_t> corners,
                               const Eigen::Vector3d& direction);

/// Twice the area of a face over its greatest diagonal from the first corner: of a triangle, its least height or more.
[[nodiscard]] double width_of(const Body& body, std::uint32_t face);

/// Twice the area of a face as a vector along its normal.
[[nodiscard]] Eigen::Vector3d area_vector(std::span<const Eigen::Vector3d> vertices,
                                          std::span<const std::uint32_t> corners);

/// For each face, the unit direction against which it moves: its normal. Narrow faces have bad normals, as those
/// between points that all but lie on a line. Such a face takes the direction of a face beside it in whose plane it
/// lies: its thickness along the direction is at most `flat`, and it does not look the other way by more. A face that
/// has no plane, and lies in none beside it, has the direction 0.
[[nodiscard]] std::vector<Eigen::Vector3d> face_directions(const Body& body, double flat);

} // namespace chasles
