#include "chasles/mesh/moved_inwards.h"

#include "chasles/base/flat_lists.h"
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/face_normal.h"
#include "chasles/mesh/merge_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <string>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// Normals nearer to a cap than this are on its rim.
constexpr double on_rim = 1e-12;
/// No plane moves where the cap around its normals is a half space up to this cosine: a needle would move by a million
/// times the distance.
constexpr double least_cosine = 1e-6;

Cap cap_around(const Vector3d& direction, const Vector3d& normal) {
    const double length = direction.norm();
    if (length < least_cosine)
        return {normal, 0};
    const Vector3d middle = direction / length;
    return {middle, middle.dot(normal)};
}

/// The cap with three normals on its rim.
Cap cap_through(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d across = (b - a).cross(c - a).stableNormalized();
    return cap_around(across.dot(a) < 0 ? Vector3d(-across) : across, a);
}

bool contains(const Cap& cap, const Vector3d& normal) {
    return cap.middle.dot(normal) >= cap.cosine - on_rim;
}

/// The faces around each place: vertices with equal coordinates, and those of a seam, are one place.
class Places {
public:
    explicit Places(const Body& body) : place_(first_equal_vertices(body.vertices())) {
        for (std::uint32_t& place : place_)
            place = body.volume().place_of(place);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;
        for (std::size_t face = 0; face < body.face_count(); ++face)
            for (const std::uint32_t vertex : body.face(face))
                if (!body.is_segment(face))
                    corners.emplace_back(place_[vertex], std::uint32_t(face));
        std::ranges::sort(corners);
        faces_.offsets.assign(place_.size() + 1, 0);
        for (const auto& [place, face] : corners) {
            ++faces_.offsets[place + 1];
            faces_.items.push_back(face);
        }
        for (std::size_t i = 1; i < faces_.offsets.size(); ++i)
            faces_.offsets[i] += faces_.offsets[i - 1];
    }

    [[nodiscard]] std::uint32_t of(std::size_t vertex) const { return place_[vertex]; }
    [[nodiscard]] std::span<const std::uint32_t> faces_around(std::uint32_t place) const { return faces_[place]; }

private:
    std::vector<std::uint32_t> place_; ///< for each vertex
    FlatLists<std::uint32_t> faces_;   ///< for each place
};

/// The shift of a vertex that moves each plane against its normal, by at most the distance.
Vector3d shift_against(std::span<const Vector3d> normals, double distance) {
    const Cap cap = smallest_cap(normals);
    if (cap.cosine < least_cosine)
        return Vector3d::Zero();
    double most = 0;
    for (const Vector3d& normal : normals)
        most = std::max(most, normal.dot(cap.middle));
    return -distance / most * cap.middle;
}

void require_closed(const Body& body, double distance) {
    const MeshReport& report = body.report();
    if (report.unpaired_edges > 0 || report.segments > 0)
        throw InvalidInput("mesh: radius: " + number_text(-distance) +
                           " moves the faces of a closed body inwards, and this surface is not closed, or its faces "
                           "are not turned the "
                           "same way, along " +
                           std::to_string(report.unpaired_edges + report.segments) +
                           " edges; mend the mesh, or leave its radius at 0");
}

/// Whether an edge points the other way, or the face itself: there is no room to move. A face that is a line up to
/// rounding points nowhere.
bool is_turned(std::span<const std::uint32_t> outline, std::span<const Vector3d> before,
               std::span<const Vector3d> after, const FaceNormal& normal) {
    Vector3d area = Vector3d::Zero();
    for (std::size_t i = 2; i < outline.size(); ++i)
        area += (after[outline[i - 1]] - after[outline[0]]).cross(after[outline[i]] - after[outline[0]]);
    if (normal.has_plane() && !(area.dot(normal.unit) > 0))
        return true;
    for (std::size_t i = 0, last = outline.size() - 1; i < outline.size(); last = i++)
        if (!((after[outline[i]] - after[outline[last]]).dot(before[outline[i]] - before[outline[last]]) > 0))
            return true;
    return false;
}

void require_turned_alike(const Body& body, std::span<const Vector3d> moved, double distance) {
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        if (is_turned(body.face(face), body.vertices(), moved, face_normal(body, face)))
            throw InvalidInput("mesh: radius: " + number_text(-distance) + " turns face " +
                               std::to_string(body.source_face(face)) +
                               " over, because the body is too thin there; a radius nearer to 0 may do");
    }
}

} // namespace

/// Normal by normal, in an order that has nothing to do with theirs: one that is not in the cap so far is on the rim of
/// the next one. Source: E. Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991, for three points on the
/// rim.
Cap smallest_cap(std::span<const Vector3d> given) {
    std::vector<Vector3d> normals(given.begin(), given.end());
    std::uint64_t state = 1;
    for (std::size_t i = normals.size(); i > 1; --i) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        std::swap(normals[i - 1], normals[(state >> 33U) % i]);
    }
    Cap cap{normals[0], 1};
    for (std::size_t i = 1; i < normals.size(); ++i) {
        if (contains(cap, normals[i]))
            continue;
        cap = {normals[i], 1};
        for (std::size_t j = 0; j < i; ++j) {
            if (contains(cap, normals[j]))
                continue;
            cap = cap_around(normals[i] + normals[j], normals[i]);
            for (std::size_t k = 0; k < j; ++k)
                if (!contains(cap, normals[k]))
                    cap = cap_through(normals[i], normals[j], normals[k]);
        }
    }
    for (const Vector3d& normal : normals)
        cap.cosine = std::min(cap.cosine, cap.middle.dot(normal));
    cap.cosine = std::max(cap.cosine, 0.0);
    return cap;
}

std::vector<Vector3d> moved_inwards(const Body& body, double distance) {
    require_closed(body, distance);
    const Places places(body);
    std::vector<FaceNormal> faces;
    for (std::uint32_t face = 0; face < body.face_count(); ++face)
        faces.push_back(face_normal(body, face));
    std::vector<Vector3d> moved(body.vertices().begin(), body.vertices().end());
    std::vector<Vector3d> normals;
    for (std::size_t vertex = 0; vertex < moved.size(); ++vertex) {
        const auto around = places.faces_around(places.of(vertex));
        normals.clear();
        for (const std::uint32_t face : around)
            if (faces[face].has_plane())
                normals.push_back(faces[face].unit);
        if (!normals.empty())
            moved[vertex] += shift_against(normals, distance);
    }
    require_turned_alike(body, moved, distance);
    return moved;
}

} // namespace chasles
