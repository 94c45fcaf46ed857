#include "chasles/search/lasting_overlap.h"

#include "chasles/motion/screw_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace chasles::search {

namespace {

using Eigen::Vector3d;

/// The vector from one point to another one.
struct Way {
    Way(const ChordPoint& from, const ChordPoint& to) : at{to.start - from.start, to.end - from.end} {}
    [[nodiscard]] double length() const { return std::max(at[0].norm(), at[1].norm()); }

    std::array<Vector3d, 2> at;
};

/// The sign of the determinant of three ways, 1 or -1, if it is proven to stay the same; else 0. On chords it is a
/// cubic polynomial, whose Bernstein coefficients are means of determinants with ends of ways.
int lasting_sign(const Way& a, const Way& b, const Way& c, double slack) {
    const auto volume = [&](int i, int j, int k) { return a.at[i].dot(b.at[j].cross(c.at[k])); };
    const std::array coefficients{volume(0, 0, 0), (volume(1, 0, 0) + volume(0, 1, 0) + volume(0, 0, 1)) / 3,
                                  (volume(0, 1, 1) + volume(1, 0, 1) + volume(1, 1, 0)) / 3, volume(1, 1, 1)};
    constexpr double rounding = 0x1p-48;
    const double x = a.length(), y = b.length(), z = c.length(),
                 way = 2 * slack; // both ends of a way leave their chords
    const double error = (x + way) * (y + way) * (z + way) * (1 + rounding) - x * y * z * (1 - rounding);
    const auto [least, greatest] = std::ranges::minmax(coefficients);
    return least > error ? 1 : greatest < -error ? -1 : 0;
}

} // namespace

/// The line goes round the outline once, so it meets each surface that the outline bounds, as the fan of triangles from
/// one corner. Both ends are on different sides of each of them.
bool passes_all_along(const ChordPoint& first, const ChordPoint& second, std::span<const ChordPoint> polygon,
                      double slack) {
    const Way edge(first, second);
    const std::size_t count = polygon.size();
    const auto side_of_line = [&](std::size_t i) {
        const ChordPoint &corner = polygon[i], &next = polygon[(i + 1) % count];
        return lasting_sign(edge, Way(first, corner), Way(first, next), slack);
    };
    const auto side_of_triangle = [&](const ChordPoint& point, std::size_t i) {
        const ChordPoint& apex = polygon.front();
        return lasting_sign(Way(apex, polygon[i]), Way(apex, polygon[i + 1]), Way(apex, point), slack);
    };
    const int round = side_of_line(0);
    if (round == 0)
        return false;
    for (std::size_t i = 1; i < count; ++i)
        if (side_of_line(i) != round)
            return false;
    for (std::size_t i = 1; i + 1 < count; ++i)
        if (side_of_triangle(first, i) * side_of_triangle(second, i) != -1)
            return false;
    return true;
}

OverlapOnChords::OverlapOnChords(const Body& moving, const Body& fixed, const Overlap& overlap,
                                 const std::array<motion::MatrixPose, 2>& poses) {
    const auto moved = [&](std::uint32_t vertex) {
        const auto point = motion::vector_in<double>(moving.vertices()[vertex]);
        const auto start = poses[0](point), end = poses[1](point);
        return ChordPoint{{start.x, start.y, start.z}, {end.x, end.y, end.z}};
    };
    const auto at_rest = [&](std::uint32_t vertex) {
        return ChordPoint{fixed.vertices()[vertex], fixed.vertices()[vertex]};
    };
    const auto edge_point = [&](std::uint32_t vertex) {
        return overlap.edge_is_moving ? moved(vertex) : at_rest(vertex);
    };
    first_ = edge_point(overlap.edge.first);
    second_ = edge_point(overlap.edge.second);
    const Body& of_face = overlap.edge_is_moving ? fixed : moving;
    for (const std::uint32_t corner : of_face.face(overlap.face.first))
        outline_.push_back(overlap.edge_is_moving ? at_rest(corner) : moved(corner));
    triangles_ = of_face.face_triangles(overlap.face.first);
}

bool OverlapOnChords::lasts(double slack) const {
    if (triangles_.empty())
        return passes_all_along(first_, second_, outline_, slack);
    for (std::size_t i = 0; i < triangles_.size(); i += 3) {
        const std::array triangle{outline_[triangles_[i]], outline_[triangles_[i + 1]], outline_[triangles_[i + 2]]};
        if (passes_all_along(first_, second_, triangle, slack))
            return true;
    }
    return false;
}

Vector3d OverlapOnChords::point() const {
    const Vector3d& apex = outline_.front().start;
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < outline_.size(); ++i)
        normal += (outline_[i].start - apex).cross(outline_[i + 1].start - apex);
    const Vector3d way = second_.start - first_.start;
    const double share = normal.dot(apex - first_.start) / normal.dot(way);
    return first_.start + std::clamp(share, 0.0, 1.0) * way;
}

} // namespace chasles::search
