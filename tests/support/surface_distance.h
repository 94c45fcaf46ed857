// The distance of two triangles at one instant: by clamping and comparing, in any scalar that has a square root. For
// dense sampling, which can only refute.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace chasles::test {

template <class S>
using Point3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Triangle3 = std::array<Point3<S>, 3>;

template <class S>
S squared_distance_to_segment(const Point3<S>& p, const Point3<S>& a, const Point3<S>& b) {
    const Point3<S> u = b - a;
    const Point3<S> arm = p - a;
    const S along = std::clamp<S>(S(u.dot(arm) / u.dot(u)), S(0), S(1));
    const Point3<S> rest = arm - u * along;
    return rest.dot(rest);
}

/// Only if both feet of the common normal are inside. The ends are tested separately.
template <class S>
S squared_distance_of_insides(const Point3<S>& a, const Point3<S>& b, const Point3<S>& c, const Point3<S>& d,
                              const S& otherwise) {
    const Point3<S> u = b - a;
    const Point3<S> v = d - c;
    const Point3<S> n = u.cross(v);
    const S square = n.dot(n);
    const Point3<S> arm = c - a;
    const S s = arm.cross(v).dot(n);
    const S t = arm.cross(u).dot(n);
    if (square == S(0) || s < S(0) || s > square || t < S(0) || t > square)
        return otherwise;
    const S height = n.dot(arm);
    return height * height / square;
}

template <class S>
S squared_distance_to_inside(const Point3<S>& p, const Triangle3<S>& t, const S& otherwise) {
    const Point3<S> n = (t[1] - t[0]).cross(t[2] - t[0]);
    for (std::size_t i = 0; i < 3; ++i)
        if (n.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) < S(0))
            return otherwise;
    const S height = n.dot(p - t[0]);
    return height * height / n.dot(n);
}

template <class S>
bool does_segment_cross(const Point3<S>& p, const Point3<S>& q, const Triangle3<S>& t) {
    const auto volume = [](const Point3<S>& a, const Point3<S>& b, const Point3<S>& c, const Point3<S>& d) {
        return S((b - a).cross(c - a).dot(d - a));
    };
    if (volume(t[0], t[1], t[2], p) * volume(t[0], t[1], t[2], q) >= S(0))
        return false;
    const S passes[] = {volume(p, q, t[0], t[1]), volume(p, q, t[1], t[2]), volume(p, q, t[2], t[0])};
    return (passes[0] > S(0) && passes[1] > S(0) && passes[2] > S(0)) ||
           (passes[0] < S(0) && passes[1] < S(0) && passes[2] < S(0));
}

/// The distance of two triangles; 0 if they cross.
template <class S>
S squared_distance_of_triangles(const Triangle3<S>& a, const Triangle3<S>& b) {
    S least = (a[0] - b[0]).dot(a[0] - b[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3;
        least = std::min<S>(least, squared_distance_to_inside<S>(a[i], b, least));
        least = std::min<S>(least, squared_distance_to_inside<S>(b[i], a, least));
        if (does_segment_cross<S>(a[i], a[i1], b) || does_segment_cross<S>(b[i], b[i1], a))
            return S(0);
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t j1 = (j + 1) % 3;
            least = std::min<S>(least, squared_distance_to_segment<S>(a[i], b[j], b[j1]));
            least = std::min<S>(least, squared_distance_to_segment<S>(b[j], a[i], a[i1]));
            least = std::min<S>(least, squared_distance_of_insides<S>(a[i], a[i1], b[j], b[j1], least));
        }
    }
    return least;
}

} // namespace chasles::test
