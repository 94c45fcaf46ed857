// Whether two triangles have a common point at one instant, in whole numbers, including all flat cases.
#pragma once

#include "tests/support/exact_reference_numbers.h"

#include <algorithm>

namespace chasles::reference {

using Point = std::array<Integer, 3>;
using Triangle = std::array<const Point*, 3>;

namespace detail {

inline Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point times_cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline int volume_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point n = times_cross(minus(b, a), minus(c, a));
    const Point arm = minus(d, a);
    return Integer(n[0] * arm[0] + n[1] * arm[1] + n[2] * arm[2]).sign();
}

/// A projection along an axis that is not parallel to the plane.
struct View {
    std::size_t x;
    std::size_t y;

    [[nodiscard]] int turn(const Point& a, const Point& b, const Point& c) const {
        return Integer((b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x])).sign();
    }
    [[nodiscard]] bool is_between(const Point& p, const Point& a, const Point& b) const {
        const auto within = [&](std::size_t i) { return std::min(a[i], b[i]) <= p[i] && p[i] <= std::max(a[i], b[i]); };
        return within(x) && within(y);
    }
    [[nodiscard]] bool do_segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) const {
        const int ca = turn(c, d, a), cb = turn(c, d, b), ac = turn(a, b, c), ad = turn(a, b, d);
        if (ca * cb < 0 && ac * ad < 0)
            return true;
        return (ca == 0 && is_between(a, c, d)) || (cb == 0 && is_between(b, c, d)) ||
               (ac == 0 && is_between(c, a, b)) || (ad == 0 && is_between(d, a, b));
    }
    [[nodiscard]] bool is_inside(const Point& p, const Triangle& t) const {
        const int i = turn(*t[0], *t[1], p), j = turn(*t[1], *t[2], p), k = turn(*t[2], *t[0], p);
        return (i >= 0 && j >= 0 && k >= 0) || (i <= 0 && j <= 0 && k <= 0);
    }
};

inline bool meets_in_plane(const Point& p, const Point& q, const Triangle& t) {
    const Point n = times_cross(minus(*t[1], *t[0]), minus(*t[2], *t[0]));
    const std::size_t axis = n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
    const View view{(axis + 1) % 3, (axis + 2) % 3};
    if (view.is_inside(p, t) || view.is_inside(q, t))
        return true;
    for (std::size_t i = 0; i < 3; ++i)
        if (view.do_segments_meet(p, q, *t[i], *t[(i + 1) % 3]))
            return true;
    return false;
}

} // namespace detail

/// Whether two closed segments have a common point: they are coplanar, and they meet along each axis. Seen along one of
/// the axes, no two points of their plane or line coincide.
inline bool do_segments_meet(const Point& p, const Point& q, const Point& a, const Point& b) {
    return detail::volume_sign(p, q, a, b) == 0 && detail::View{0, 1}.do_segments_meet(p, q, a, b) &&
           detail::View{1, 2}.do_segments_meet(p, q, a, b) && detail::View{2, 0}.do_segments_meet(p, q, a, b);
}

/// Whether a closed segment and a closed triangle with an area have a common point.
inline bool segment_meets_triangle(const Point& p, const Point& q, const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [least, most] = std::minmax({(*t[0])[i], (*t[1])[i], (*t[2])[i]});
        if (std::max(p[i], q[i]) < least || std::min(p[i], q[i]) > most)
            return false;
    }
    const int at_p = detail::volume_sign(*t[0], *t[1], *t[2], p);
    const int at_q = detail::volume_sign(*t[0], *t[1], *t[2], q);
    if (at_p * at_q > 0)
        return false;
    if (at_p == 0 && at_q == 0)
        return detail::meets_in_plane(p, q, t);
    int least = 1;
    int most = -1;
    for (std::size_t i = 0; i < 3; ++i) { // on which side of each edge the line passes
        const int passes = detail::volume_sign(p, q, *t[i], *t[(i + 1) % 3]);
        least = std::min(least, passes);
        most = std::max(most, passes);
    }
    return least >= 0 || most <= 0;
}

} // namespace chasles::reference
