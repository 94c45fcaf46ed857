#include "chasles/mesh/moved_inwards.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/face_normal.h"
#include "chasles/mesh/merge_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
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

/// Faces that are much narrower than long, and narrower than the distance, as between points of a circle that all but
/// lie on a line. Their normals mean little.
bool is_narrow(const Body& body, std::uint32_t face, double distance) {
    constexpr double of_length = 0.01;
    const std::span<const std::uint32_t> outline = body.face(face);
    const auto corner = [&](std::size_t i) -> const Vector3d& { return body.vertices()[outline[i]]; };
    Vector3d area = Vector3d::Zero();
    double length = 0;
    for (std::size_t i = 1; i < outline.size(); ++i) {
        length = std::max(length, (corner(i) - corner(0)).norm());
        if (i > 1)
            area += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0));
    }
    return area.norm() < std::min(distance, of_length * length) * length;
}

/// The normals of the faces around vertices, but for narrow ones. Those with equal coordinates, and those of a seam,
/// have the same.
class Normals {
public:
    Normals(const Body& body, double distance) : body_(body), first_equal_(first_equal_vertices(body.vertices())) {
        for (std::uint32_t face = 0; face < body.face_count(); ++face) {
            of_face_.push_back(face_normal(body, face));
            is_narrow_.push_back(is_narrow(body, face, distance));
        }
        for (const auto& [from, to] : body.volume().joined)
            joined_.emplace(to, from);
    }

    [[nodiscard]] std::vector<Vector3d> around(std::size_t vertex) const {
        const std::uint32_t place = body_.volume().place_of(first_equal_[vertex]);
        std::vector<Vector3d> normals;
        add_around(place, normals);
        const auto [begin, end] = joined_.equal_range(place);
        for (auto other = begin; other != end; ++other)
            add_around(other->second, normals);
        return normals;
    }

    /// Whether a face is narrow and no side of a thin wall: the faces beside it, and beside the narrow ones that it
    /// hangs together with, look to one side.
    [[nodiscard]] bool is_sliver(std::uint32_t face) const {
        constexpr double one_side = 0.2;
        if (!is_narrow_[face])
            return false;
        std::vector<Vector3d> normals;
        std::set<std::uint32_t> narrow{face};
        for (std::vector<std::uint32_t> left{face}; !left.empty();) {
            const std::uint32_t next = left.back();
            left.pop_back();
            for (const std::uint32_t other : faces_beside(next))
                if (!is_narrow_[other])
                    normals.push_back(of_face_[other].unit);
                else if (narrow.insert(other).second)
                    left.push_back(other);
        }
        return normals.empty() || smallest_cap(normals).cosine > one_side;
    }

private:
    void add_around(std::uint32_t vertex, std::vector<Vector3d>& normals) const {
        for (const std::uint32_t face : body_.faces_around(vertex))
            if (of_face_[face].has_plane() && !is_narrow_[face])
                normals.push_back(of_face_[face].unit);
    }

    /// Those with two corners of a face.
    [[nodiscard]] std::vector<std::uint32_t> faces_beside(std::uint32_t face) const {
        std::vector<std::uint32_t> around, beside;
        for (const std::uint32_t corner : body_.face(face))
            std::ranges::copy(body_.faces_around(corner), std::back_inserter(around));
        std::ranges::sort(around);
        for (std::size_t i = 1; i < around.size(); ++i)
            if (around[i] == around[i - 1] && around[i] != face)
                beside.push_back(around[i]);
        return beside;
    }

    const Body& body_;
    std::vector<std::uint32_t> first_equal_;
    std::vector<FaceNormal> of_face_;
    std::vector<bool> is_narrow_;                        ///< of each face
    std::multimap<std::uint32_t, std::uint32_t> joined_; ///< from the place of a seam to its other vertices
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
    if (report.segments == report.faces)
        throw InvalidInput("mesh: radius: " + number_text(-distance) +
                           " moves the faces of a closed body inwards, and points and segments have none; their radius "
                           "must be above 0");
    if (report.unpaired_edges > 0 || report.segments > 0)
        throw InvalidInput("mesh: radius: " + number_text(-distance) +
                           " moves the faces of a closed body inwards, and this surface is not closed, or its faces "
                           "are not turned the same way, along " +
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

/// A sliver may turn over: it stays within the distance of the faces around it.
void require_turned_alike(const Body& body, const Normals& normals, std::span<const Vector3d> moved, double distance) {
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        if (is_turned(body.face(face), body.vertices(), moved, face_normal(body, face)) && !normals.is_sliver(face))
            throw InvalidInput(
                "mesh: radius: " + number_text(-distance) + " turns face " + std::to_string(body.source_face(face)) +
                " over: the body is too thin there, or the face too small; a radius nearer to 0, or a mesh "
                "without such faces, may do");
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
    const Normals normals(body, distance);
    std::vector<Vector3d> moved(body.vertices().begin(), body.vertices().end());
    for (std::size_t vertex = 0; vertex < moved.size(); ++vertex)
        if (const std::vector<Vector3d> around = normals.around(vertex); !around.empty())
            moved[vertex] += shift_against(around, distance);
    require_turned_alike(body, normals, moved, distance);
    return moved;
}

} // namespace chasles
