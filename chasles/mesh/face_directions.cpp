#include "chasles/mesh/face_directions.h"

#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace chasles {

namespace {

using Eigen::Vector3d;
using Corners = std::span<const std::uint32_t>;

/// Of the corners of a face from the first one.
double length_of(std::span<const Vector3d> vertices, Corners corners) {
    double length = 0;
    for (const std::uint32_t corner : corners)
        length = std::max(length, (vertices[corner] - vertices[corners[0]]).norm());
    return length;
}

bool lies_in_plane(const Body& body, std::uint32_t face, const Vector3d& direction, double flat) {
    const Corners corners = body.face(face);
    return thickness(body.vertices(), corners, direction) <= flat &&
           area_vector(body.vertices(), corners).dot(direction) >= -flat * length_of(body.vertices(), corners);
}

/// Whether a face beside it looks the other way: there the face is the rim of a thin wall.
bool is_between_walls(const Body& body, std::uint32_t face, std::span<const Vector3d> directions) {
    constexpr double other_way = -0.5;
    return std::ranges::any_of(faces_beside(body, face), [&](std::uint32_t other) {
        return directions[other].dot(directions[face]) < other_way;
    });
}

} // namespace

std::vector<std::uint32_t> faces_beside(const Body& body, std::uint32_t face) {
    const Corners corners = body.face(face);
    std::vector<std::uint32_t> beside;
    for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++) {
        Corners few = body.faces_around(corners[last]), many = body.faces_around(corners[i]);
        if (few.size() > many.size())
            std::swap(few, many);
        for (const std::uint32_t other : few) // ascending
            if (other != face && std::ranges::binary_search(many, other))
                beside.push_back(other);
    }
    return beside;
}

double thickness(std::span<const Vector3d> vertices, Corners corners, const Vector3d& direction) {
    double least = 0, most = 0;
    for (const std::uint32_t corner : corners) {
        const double height = (vertices[corner] - vertices[corners[0]]).dot(direction);
        least = std::min(least, height);
        most = std::max(most, height);
    }
    return most - least;
}

Vector3d area_vector(std::span<const Vector3d> vertices, Corners corners) {
    Vector3d area = Vector3d::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i)
        area += (vertices[corners[i - 1]] - vertices[corners[0]]).cross(vertices[corners[i]] - vertices[corners[0]]);
    return area;
}

double width_of(const Body& body, std::uint32_t face) {
    const Corners corners = body.face(face);
    const double length = length_of(body.vertices(), corners);
    return length > 0 ? area_vector(body.vertices(), corners).norm() / length : 0;
}

std::vector<Vector3d> face_directions(const Body& body, double flat) {
    constexpr double narrow = 0.01; // of the length
    std::vector<Vector3d> directions(body.face_count(), Vector3d::Zero());
    std::vector<std::uint32_t> settled; // faces whose direction their neighbours may take
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        if (width_of(body, face) < narrow * length_of(body.vertices(), body.face(face)))
            continue;
        directions[face] = face_normal(body, face).unit;
        settled.push_back(face);
    }
    for (std::size_t i = 0; i < settled.size(); ++i) // grows
        for (const std::uint32_t other : faces_beside(body, settled[i]))
            if (directions[other].isZero(0) && lies_in_plane(body, other, directions[settled[i]], flat)) {
                directions[other] = directions[settled[i]];
                settled.push_back(other);
            }
    const std::vector<Vector3d> taken = directions;
    for (std::uint32_t face = 0; face < body.face_count(); ++face)
        if (!taken[face].isZero(0) && is_between_walls(body, face, taken))
            directions[face].setZero();
    for (std::uint32_t face = 0; face < body.face_count(); ++face)
        if (const FaceNormal normal = face_normal(body, face); directions[face].isZero(0) && normal.has_plane())
            directions[face] = normal.unit;
    return directions;
}

} // namespace chasles
