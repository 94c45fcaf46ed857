#include "chasles/mesh/moved_inwards.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/face_directions.h"
#include "chasles/mesh/inwards_check.h"
#include "chasles/mesh/merge_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
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

/// The directions of the faces around vertices. Those with equal coordinates, and those of a seam, have the same.
class Directions {
public:
    Directions(const Body& body, std::span<const Vector3d> of_face)
        : body_(body), of_face_(of_face), first_equal_(first_equal_vertices(body.vertices())) {
        for (const auto& [from, to] : body.volume().joined)
            joined_.emplace(to, from);
    }

    [[nodiscard]] std::vector<Vector3d> around(std::size_t vertex) const {
        const std::uint32_t place = body_.volume().place_of(first_equal_[vertex]);
        std::vector<Vector3d> directions;
        add_around(place, directions);
        const auto [begin, end] = joined_.equal_range(place);
        for (auto other = begin; other != end; ++other)
            add_around(other->second, directions);
        return directions;
    }

private:
    void add_around(std::uint32_t vertex, std::vector<Vector3d>& directions) const {
        for (const std::uint32_t face : body_.faces_around(vertex))
            if (!of_face_[face].isZero(0))
                directions.push_back(of_face_[face]);
    }

    const Body& body_;
    std::span<const Vector3d> of_face_;
    std::vector<std::uint32_t> first_equal_;
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
    constexpr double of_distance = 1e-3;
    require_closed(body, distance);
    const std::vector<Vector3d> of_face = face_directions(body, of_distance * distance);
    const Directions directions(body, of_face);
    std::vector<Vector3d> moved(body.vertices().begin(), body.vertices().end());
    for (std::size_t vertex = 0; vertex < moved.size(); ++vertex)
        if (const std::vector<Vector3d> around = directions.around(vertex); !around.empty())
            moved[vertex] += shift_against(around, distance);
    require_inwards({body, of_face, moved, distance, of_distance * distance});
    return moved;
}

} // namespace chasles
