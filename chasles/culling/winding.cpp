#include "chasles/culling/winding.h"

#include "chasles/algebra/double_double.h"
#include "chasles/algebra/exact_number.h"
#include "chasles/culling/cached_face.h"
#include "chasles/elementary/error_scale.h"

#include <algorithm>
#include <array>
#include <limits>

namespace chasles::culling {

namespace {

using algebra::Vector3;

/// Few digits, so that exact products stay short; in general position to the edges of most meshes.
constexpr std::array<std::array<double, 3>, ray_count> directions{
    {{41, 29, 67}, {-53, 71, 31}, {23, -61, 47}, {-37, -19, -59}}};

/// The sign of a number whose error is at most `error`; 0 if that does not tell.
template <class S>
int sign_of(const S& value, const S& error) {
    return value > error ? 1 : value < S(0) - error ? -1 : 0;
}

/// A ray that crosses triangles. Corners are taken relative to its origin, times its weight.
template <class S>
class Ray {
public:
    Ray(const WeightedPoint<S>& origin, int ray) : origin_(origin), error_(origin.error * origin.weight) {
        for (int i = 0; i < 3; ++i)
            direction_[i] = S(directions[std::size_t(ray)][std::size_t(i)]);
        size_ = norm1(direction_);
    }

    [[nodiscard]] Vector3<S> seen(const Vector3<S>& corner) const {
        return scale(corner, origin_.weight) - origin_.place;
    }

    /// What a triangle adds to the winding number: 1 if the ray leaves through it, -1 if it enters, 0 if it misses.
    /// Empty if that is not certain.
    [[nodiscard]] std::optional<int> crossing(const Vector3<S>& a, const Vector3<S>& b, const Vector3<S>& c) const {
        const int first = side(a, b), second = side(b, c), third = side(c, a);
        const auto [least, greatest] = std::minmax({first, second, third});
        if (least < 0 && greatest > 0)
            return 0; // the line passes beside it
        if (is_behind(a) && is_behind(b) && is_behind(c))
            return 0;
        if (least != greatest || least == 0)
            return std::nullopt; // near the rim
        const int way = least * sign_of<S>(dot(a, cross(b, c)),
                                           bound(S(wide(a) * wide(b) + wide(b) * wide(c) + wide(c) * wide(a))));
        return way > 0 ? std::optional(least) : way < 0 ? std::optional(0) : std::nullopt;
    }

private:
    /// On which side of the line the edge from a to b passes.
    [[nodiscard]] int side(const Vector3<S>& a, const Vector3<S>& b) const {
        return sign_of<S>(dot(direction_, cross(a, b)), bound(S(size_ * (wide(a) + wide(b)))));
    }
    [[nodiscard]] bool is_behind(const Vector3<S>& corner) const {
        return sign_of<S>(dot(direction_, corner), bound(size_)) < 0;
    }

    // Both bounds are those of the note: twice the error of a position covers the roundings, too.
    [[nodiscard]] S wide(const Vector3<S>& corner) const { return S(norm1(corner) + S(3) * error_); }
    [[nodiscard]] S bound(const S& size) const { return elementary::with_underflow<S>(S(S(2) * error_ * size)); }

    const WeightedPoint<S>& origin_;
    S error_;
    Vector3<S> direction_;
    S size_;
};

/// Calls visit(face) for the faces whose boxes a ray may meet, until it returns false.
template <class Visit>
void for_each_face_ahead(const Body& body, const Eigen::Vector3d& from, double slack, int ray, Visit visit) {
    constexpr double rounding = 0x1p-40;
    const Bvh& bvh = body.bvh();
    const Eigen::Vector3d origin = from - bvh.centre();
    const double wide = slack + rounding * (bvh.radius() + origin.lpNorm<1>());
    const auto may_meet = [&](const BvhNode& node) {
        double begin = 0, end = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 3; ++i) {
            const double inverse = 1 / directions[std::size_t(ray)][i];
            const double a = (double(node.lower[i]) - wide - origin[Eigen::Index(i)]) * inverse;
            const double b = (double(node.upper[i]) + wide - origin[Eigen::Index(i)]) * inverse;
            begin = std::max(begin, std::min(a, b));
            end = std::min(end, std::max(a, b));
        }
        return begin <= end;
    };
    std::array<std::uint32_t, Bvh::max_depth + 1> waiting; // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const BvhNode& node = bvh.nodes()[waiting[--count]];
        if (!may_meet(node))
            continue;
        if (!node.is_leaf()) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
        } else if (!visit(std::uint32_t(node.first))) {
            return;
        }
    }
}

} // namespace

/// A face is a fan of triangles at its first corner, also if it is not convex: triangles that turn back are counted
/// backwards. The sum depends on the rim alone, which a face and its fan have in common.
template <class S>
std::optional<int> winding_around(const Body& body, const WeightedPoint<S>& point, const Eigen::Vector3d& near,
                                  double slack, int ray) {
    const Volume& volume = body.volume();
    const Ray<S> line(point, ray);
    std::optional<int> winding = 0;
    for_each_face_ahead(body, near, slack + volume.seam, ray, [&](std::uint32_t face) {
        if (!volume.is_bounded_by(face) || body.is_segment(face))
            return true;
        const auto outline = body.face(face);
        const auto corner = [&](std::size_t i) { return line.seen(point_of<S>(body, volume.place_of(outline[i]))); };
        const Vector3<S> first = corner(0);
        Vector3<S> previous = corner(1);
        for (std::size_t i = 2; i < outline.size() && winding; ++i) {
            const Vector3<S> next = corner(i);
            const std::optional<int> crossing = line.crossing(first, previous, next);
            winding = crossing ? std::optional(*winding + *crossing) : std::nullopt;
            previous = next;
        }
        return winding.has_value();
    });
    return winding;
}

template std::optional<int> winding_around(const Body&, const WeightedPoint<double>&, const Eigen::Vector3d&, double,
                                           int);
template std::optional<int> winding_around(const Body&, const WeightedPoint<algebra::DoubleDouble>&,
                                           const Eigen::Vector3d&, double, int);
template std::optional<int> winding_around(const Body&, const WeightedPoint<algebra::ExactNumber>&,
                                           const Eigen::Vector3d&, double, int);

} // namespace chasles::culling
