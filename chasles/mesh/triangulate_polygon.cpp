// Ear clipping with exact predicates, and a proof of the result: the triangles cover the polygon exactly once.
// Proof: cutting off a triangle that turns left lowers the winding number by one inside the triangle and changes it
// nowhere else. If nothing remains and no two triangles overlap, the outline winds once around the triangles and around
// nothing else. The choice of the ears therefore needs no proof, and an invalid outline is always refused.
#include "chasles/mesh/triangulate_polygon.h"

#include "chasles/base/sort.h"
#include "chasles/mesh/exact_orientation.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace chasles {
namespace {

using Point = Eigen::Vector2d;

/// A triangle that turns left, with its bounding box. "Inside" means in its interior.
struct Triangle {
    std::array<Point, 3> corners;
    Point lower;
    Point upper;

    Triangle(const Point& a, const Point& b, const Point& c)
        : corners{a, b, c}, lower(a.cwiseMin(b).cwiseMin(c)), upper(a.cwiseMax(b).cwiseMax(c)) {}

    /// Whether all points are on or beyond one side of the triangle.
    template <std::size_t Count>
    [[nodiscard]] bool has_beyond_a_side(const std::array<Point, Count>& points) const {
        for (std::size_t side = 0; side < 3; ++side) {
            const auto is_out = [&](const Point& point) {
                return orientation(corners[side], corners[(side + 1) % 3], point) <= 0;
            };
            if (std::ranges::all_of(points, is_out))
                return true;
        }
        return false;
    }

    /// Whether the bounding boxes have no common interior point.
    [[nodiscard]] bool boxes_are_apart(const Point& other_lower, const Point& other_upper) const {
        return (other_upper.array() <= lower.array()).any() || (other_lower.array() >= upper.array()).any();
    }
};

/// Whether two triangles have a common interior point: no side of either triangle separates them.
bool overlap(const Triangle& first, const Triangle& second) {
    return !first.boxes_are_apart(second.lower, second.upper) && !first.has_beyond_a_side(second.corners) &&
           !second.has_beyond_a_side(first.corners);
}

/// Whether the triangle is on one side of the line through p and q. p and q must differ.
bool is_on_one_side(const Triangle& triangle, const Point& p, const Point& q) {
    int least = 1;
    int greatest = -1;
    for (const Point& corner : triangle.corners) {
        const int side = orientation(p, q, corner);
        least = std::min(least, side);
        greatest = std::max(greatest, side);
    }
    return least >= 0 || greatest <= 0;
}

/// Whether the segment has a point inside the triangle. Only the lines along the sides of the triangle and along the
/// segment can separate them (separating axes of convex sets in the plane).
bool enters(const Point& p, const Point& q, const Triangle& triangle) {
    if (triangle.boxes_are_apart(p.cwiseMin(q), p.cwiseMax(q)))
        return false;
    return !triangle.has_beyond_a_side(std::array{p, q}) && (p == q || !is_on_one_side(triangle, p, q));
}

/// The remaining part of the outline as a ring of corners.
class EarClipping {
public:
    explicit EarClipping(std::span<const Point> points)
        : points_(points), next_(points.size()), previous_(points.size()), left_(points.size()) {
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            next_[i] = (i + 1) % count;
            previous_[next_[i]] = i;
        }
    }

    /// Cuts ears until at most two corners remain. Returns false if the remaining ring has no ear.
    bool run() {
        while (left_ >= 3)
            if (!cut_first(&EarClipping::cut_ear) && !cut_first(&EarClipping::cut_flat_corner))
                return false;
        return true;
    }

    [[nodiscard]] std::vector<std::uint32_t> triangles() && { return std::move(triangles_); }

private:
    using Cut = bool (EarClipping::*)(std::uint32_t);

    /// Tries all corners, beginning after the last cut.
    bool cut_first(Cut cut) {
        std::uint32_t corner = current_;
        for (std::size_t tried = 0; tried < left_; ++tried, corner = next_[corner])
            if ((this->*cut)(corner))
                return true;
        return false;
    }

    /// Cuts off the triangle at a corner, if the corner is an ear.
    bool cut_ear(std::uint32_t corner) {
        if (!is_ear(corner) || touches_diagonal(corner))
            return false;
        triangles_.insert(triangles_.end(), {previous_[corner], corner, next_[corner]});
        remove_corner(corner);
        return true;
    }

    /// Removes a straight corner. Straight corners remain, for example, where holes are bridged.
    bool cut_flat_corner(std::uint32_t corner) {
        if (orientation(points_[previous_[corner]], points_[corner], points_[next_[corner]]) != 0)
            return false;
        remove_corner(corner);
        return true;
    }

    /// Whether the corner turns left and no side of the ring has a point inside its triangle.
    [[nodiscard]] bool is_ear(std::uint32_t corner) const {
        const Point& a = points_[previous_[corner]];
        const Point& b = points_[corner];
        const Point& c = points_[next_[corner]];
        if (orientation(a, b, c) <= 0)
            return false;
        const Triangle ear(a, b, c);
        for (std::uint32_t i = next_[corner]; i != previous_[corner]; i = next_[i])
            if (enters(points_[i], points_[next_[i]], ear))
                return false;
        return true;
    }

    /// Whether another corner lies on the new side, strictly between its ends.
    [[nodiscard]] bool touches_diagonal(std::uint32_t corner) const {
        const Point& a = points_[previous_[corner]];
        const Point& c = points_[next_[corner]];
        for (std::uint32_t i = next_[next_[corner]]; i != previous_[corner]; i = next_[i])
            if (points_[i] != a && points_[i] != c && !lies_beyond(a, points_[i], c) &&
                orientation(a, points_[i], c) == 0)
                return true;
        return false;
    }

    /// Removes a corner from the ring, then removes folded corners next to it. Next to a folded side, a corner that
    /// turns left need not have the polygon on its left.
    void remove_corner(std::uint32_t corner) {
        std::uint32_t before = previous_[corner];
        std::uint32_t after = next_[corner];
        unlink(corner);
        while (left_ >= 3) {
            if (is_folded(before)) {
                unlink(before);
                before = previous_[before];
            } else if (is_folded(after)) {
                unlink(after);
                after = next_[after];
            } else {
                break;
            }
        }
        current_ = next_[after]; // cutting adjacent corners one after another would make slivers
    }

    /// Whether the ring turns back onto the previous side, or the corner coincides with a neighbour.
    [[nodiscard]] bool is_folded(std::uint32_t corner) const {
        const Point& a = points_[previous_[corner]];
        const Point& b = points_[corner];
        const Point& c = points_[next_[corner]];
        const bool is_at_neighbour = a == b || b == c || c == a;
        return is_at_neighbour || (lies_beyond(a, b, c) && orientation(a, b, c) == 0);
    }

    /// Removes a corner from the ring only.
    void unlink(std::uint32_t corner) {
        next_[previous_[corner]] = next_[corner];
        previous_[next_[corner]] = previous_[corner];
        --left_;
    }

    std::span<const Point> points_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<std::uint32_t> triangles_;
    std::size_t left_;
    std::uint32_t current_ = 1; ///< a quad is cut from its first corner, as other programs cut it
};

/// Whether two triangles overlap. The triangles are sorted by their lower end along x, and a triangle is compared only
/// with triangles that begin before its upper end.
bool any_overlap(std::span<const Point> points, std::span<const std::uint32_t> corners) {
    std::vector<Triangle> triangles;
    triangles.reserve(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); i += 3)
        triangles.emplace_back(points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]);
    chasles::sort(triangles, {}, [](const Triangle& triangle) { return triangle.lower.x(); });
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t j = i + 1; j < triangles.size() && triangles[j].lower.x() < triangles[i].upper.x(); ++j)
            if (overlap(triangles[i], triangles[j]))
                return true;
    return false;
}

} // namespace

std::optional<std::vector<std::uint32_t>> triangulate_polygon(std::span<const Eigen::Vector2d> outline) {
    EarClipping clipping(outline);
    if (!clipping.run())
        return std::nullopt;
    std::vector<std::uint32_t> triangles = std::move(clipping).triangles();
    if (any_overlap(outline, triangles))
        return std::nullopt;
    return triangles;
}

} // namespace chasles
