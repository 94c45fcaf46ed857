// Tests with Shewchuk's first filter for orient2d; exact arithmetic decides the remaining cases.
// Source: J. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997.
#include "chasles/mesh/exact_orientation.h"

#include "chasles/algebra/dyadic.h"
#include "chasles/algebra/exact_sum.h"
#include "chasles/algebra/vector.h"

#include <cmath>
#include <limits>

namespace chasles {
namespace {

/// The sign of the expanded determinant.
int exact_orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    ExactSum sum;
    sum.add_product(a.x(), b.y());
    sum.add_product(-a.y(), b.x());
    sum.add_product(b.x(), c.y());
    sum.add_product(-b.y(), c.x());
    sum.add_product(c.x(), a.y());
    sum.add_product(-c.y(), a.x());
    return sum.sign();
}

using Arm = algebra::Vector3<algebra::Dyadic>;

Arm exact_arm(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    using algebra::Dyadic;
    return {Dyadic(to.x()) - Dyadic(from.x()), Dyadic(to.y()) - Dyadic(from.y()), Dyadic(to.z()) - Dyadic(from.z())};
}

} // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d ca = a - c;
    const Eigen::Vector2d cb = b - c;
    // A computed difference is zero only for equal numbers. Products with zero are therefore exact. This case decides
    // points on a line parallel to an axis.
    if ((ca.x() == 0.0 || cb.y() == 0.0) && (ca.y() == 0.0 || cb.x() == 0.0))
        return 0;
    const double left = ca.x() * cb.y();
    const double right = ca.y() * cb.x();
    constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
    constexpr double relative = (3.0 + 16.0 * unit) * unit; // ccwerrboundA in Shewchuk's predicates.c
    // The least normal number covers the underflow of products.
    const double bound = relative * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
    const double determinant = left - right;
    if (std::abs(determinant) > bound)
        return determinant > 0.0 ? 1 : -1;
    return exact_orientation(a, b, c);
}

bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    for (int axis = 0; axis < 3; ++axis)
        if (orientation(without_axis(axis, a), without_axis(axis, b), without_axis(axis, c)) != 0)
            return false;
    return true;
}

bool detail::are_coplanar_exactly(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                  const Eigen::Vector3d& d) {
    for (int axis = 0; axis < 3; ++axis)
        if (a[axis] == d[axis] && b[axis] == d[axis] && c[axis] == d[axis])
            return true;
    return dot(exact_arm(d, a), cross(exact_arm(d, b), exact_arm(d, c))).sign() == 0;
}

bool lies_beyond(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d lower = a.cwiseMin(c);
    const Eigen::Vector2d upper = a.cwiseMax(c);
    return (b.array() < lower.array()).any() || (b.array() > upper.array()).any();
}

} // namespace chasles
