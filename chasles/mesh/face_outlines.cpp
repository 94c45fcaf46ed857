// Checks vertices and faces one by one and sorts proper faces from collapsed faces.
// Every message contains the number of the face or vertex.
#include "chasles/mesh/face_outlines.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/exact_orientation.h"
#include "chasles/mesh/merge_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace chasles {
namespace {

using Face = std::span<const std::uint32_t>; ///< vertex indices as given
using Outline = std::vector<std::uint32_t>;

// Both in the length unit of the mesh; docs/decisions/0012-range-of-coordinates.md.
constexpr double largest_coordinate = 1e30;
constexpr double smallest_size = 1e-30;

/// Throws "face N: WHY".
[[noreturn]] void refuse_face(std::size_t face, const std::string& why) {
    throw InvalidInput("face " + std::to_string(face) + ": " + why);
}

/// Refuses a coordinate that is not finite or out of range.
void check_vertex(std::size_t index, const Eigen::Vector3d& vertex) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto refuse = [&](const std::string& why) {
            throw InvalidInput("vertex " + std::to_string(index) + ": " + "xyz"[axis] + why);
        };
        if (!std::isfinite(vertex[axis]))
            refuse(" is not a finite number");
        if (std::abs(vertex[axis]) > largest_coordinate)
            refuse(" = " + number_text(vertex[axis]) + " is out of range (-" + number_text(largest_coordinate) +
                   " to " + number_text(largest_coordinate) + ")");
    }
}

/// Refuses meshes whose corners or BVH nodes cannot be numbered with 32 bits.
void check_counts(std::span<const Eigen::Vector3d> vertices, std::span<const Face> faces) {
    if (faces.empty())
        throw InvalidInput("mesh: has no faces");
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / 2;
    std::size_t corners = 0;
    for (const Face face : faces)
        corners += face.size();
    if (vertices.size() > most || corners > most)
        throw InvalidInput("mesh: " + std::to_string(vertices.size()) + " vertices and " + std::to_string(corners) +
                           " face corners are too many (at most " + std::to_string(most) + " each)");
}

/// Refuses a face with fewer than three corners or with an index out of range.
void check_indices(std::size_t index, Face face, std::size_t vertex_count) {
    if (face.size() < 3)
        refuse_face(index, "a face needs at least three vertices and this one has " + std::to_string(face.size()));
    for (const std::uint32_t vertex : face)
        if (vertex >= vertex_count)
            refuse_face(index, "vertex index " + std::to_string(vertex) + " is out of range (the mesh has " +
                                   std::to_string(vertex_count) + " vertices)");
}

/// Whether all corners lie on one line, decided exactly. Fewer than three corners do.
bool is_on_one_line(std::span<const Eigen::Vector3d> vertices, const Outline& outline) {
    for (std::size_t i = 2; i < outline.size(); ++i)
        if (!are_collinear(vertices[outline[0]], vertices[outline[1]], vertices[outline[i]]))
            return false;
    return true;
}

} // namespace

void check_vertices(std::span<const Eigen::Vector3d> vertices, bool is_round) {
    Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d upper = -lower;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        check_vertex(i, vertices[i]);
        lower = lower.cwiseMin(vertices[i]);
        upper = upper.cwiseMax(vertices[i]);
    }
    const bool is_point = is_round && lower == upper;
    if (!vertices.empty() && !is_point && (upper - lower).maxCoeff() < smallest_size)
        throw InvalidInput("mesh: all vertices lie within " + number_text((upper - lower).maxCoeff()) +
                           " of each other, which is too small to compute with (at least " +
                           number_text(smallest_size) + ")" +
                           (lower == upper && !is_round ? "; a point needs a radius above 0" : ""));
}

void refuse_without_area() {
    throw InvalidInput(
        "mesh: no face has an area, so the mesh has no surface; points and segments need a radius above 0");
}

void SortedFaces::append(Outline& corners, std::uint32_t source, std::span<const Eigen::Vector3d> vertices) {
    const auto repeated = std::ranges::unique(corners);
    corners.erase(repeated.begin(), repeated.end());
    while (corners.size() > 1 && corners.front() == corners.back())
        corners.pop_back();
    (is_on_one_line(vertices, corners) ? collapsed : proper).append(corners, source);
}

SortedFaces sort_faces(std::span<const Eigen::Vector3d> vertices, std::span<const Face> faces, bool is_round) {
    check_counts(vertices, faces);
    const std::vector<std::uint32_t> first_equal = first_equal_vertices(vertices);
    SortedFaces sorted;
    for (std::uint32_t vertex = 0; vertex < first_equal.size(); ++vertex)
        sorted.distinct_vertices += first_equal[vertex] == vertex ? 1 : 0;
    Outline corners;
    for (std::uint32_t index = 0; index < faces.size(); ++index) {
        check_indices(index, faces[index], vertices.size());
        corners.clear();
        for (const std::uint32_t vertex : faces[index])
            corners.push_back(first_equal[vertex]);
        sorted.append(corners, index, vertices);
    }
    if (sorted.proper.source.empty() && !is_round)
        refuse_without_area();
    return sorted;
}

} // namespace chasles
