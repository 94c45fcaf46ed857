// The paper's motion as polynomials in tau, for planes that stand still: where a corner of the moving body is.
// Source: docs/derivations/01-screw-from-two-poses.md; docs/certificate.md, "Motion".
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/motion/rational_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chasles::certificate {

using algebra::DoubleDouble;
using algebra::Matrix3;
using algebra::Vector3;

using Wide = Vector3<DoubleDouble>;

inline Wide widened(const Vector3<double>& v) {
    return {DoubleDouble(v.x), DoubleDouble(v.y), DoubleDouble(v.z)};
}

/// Part of a piece, in tau.
struct Cell {
    DoubleDouble lower;
    DoubleDouble upper;
};

/// The distances of corners b of the moving body from a plane, times the weight W and the length of the normal: in
/// Bernstein form on a cell, coefficient j is row[j] . b + shift[j].
template <class S>
struct PlaneForm {
    std::array<Vector3<S>, 4> row;
    std::array<S, 4> shift;

    /// The least coefficient of a corner.
    [[nodiscard]] S least(const Vector3<double>& corner) const {
        return std::min(std::min(at(corner, 0), at(corner, 1)), std::min(at(corner, 2), at(corner, 3)));
    }
    /// No corner of a box has a lesser one, up to rounding.
    [[nodiscard]] double least_in(const Vector3<double>& centre, const Vector3<double>& half) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < 4; ++j) {
            double way = 0;
            for (int axis = 0; axis < 3; ++axis)
                way += std::abs(double(row[j][axis])) * half[axis];
            least = std::min(least, double(at(centre, j)) - way);
        }
        return least;
    }

private:
    [[nodiscard]] S at(const Vector3<double>& corner, std::size_t j) const {
        return S(row[j].x * S(corner.x) + row[j].y * S(corner.y)) + S(row[j].z * S(corner.z) + shift[j]);
    }
};

/// W p = sum of tau^k (linear[k] b + shift[k]), W = 1 + square tau^2.
template <class S>
class PiecePolynomials {
public:
    explicit PiecePolynomials(const motion::RationalMotion<S>& screw) : square_(dot(screw.axis, screw.axis)) {
        const Vector3<S>&a = screw.axis, &m = screw.moment, &d = screw.displacement, &t = screw.origin;
        const Matrix3<S> turning = times(a, screw.orientation), again = times(a, turning);
        const S two(2);
        linear_ = {screw.orientation, scale(turning, two), scale(screw.orientation, square_) + scale(again, two)};
        shift_ = {t, d + scale(m, two), scale(t, square_) + scale(cross(a, m), two), scale(d, square_)};
    }

    [[nodiscard]] Vector3<S> place(const Vector3<double>& corner, const S& tau) const {
        const Vector3<S> b{S(corner.x), S(corner.y), S(corner.z)};
        Vector3<S> sum = shift_[3];
        for (int k = 2; k >= 0; --k)
            sum = scale(sum, tau) + (linear_[std::size_t(k)] * b + shift_[std::size_t(k)]);
        return scale(sum, S(S(1) / weight(tau)));
    }
    [[nodiscard]] Vector3<S> turned(const Vector3<S>& direction, const S& tau) const {
        const Vector3<S> sum =
            linear_[0] * direction + scale(linear_[1] * direction, tau) + scale(linear_[2] * direction, S(tau * tau));
        return scale(sum, S(S(1) / weight(tau)));
    }
    [[nodiscard]] S weight(const S& tau) const { return S(1) + square_ * tau * tau; }

    /// Of the plane n . x = offset.
    [[nodiscard]] PlaneForm<S> against(const Vector3<S>& normal, const S& offset, const Cell& cell) const {
        std::array<Vector3<S>, 4> rows;
        std::array<S, 4> shifts;
        for (std::size_t k = 0; k < 4; ++k) {
            if (k < 3)
                rows[k] = linear_[k].transposed() * normal;
            shifts[k] = dot(normal, shift_[k]);
        }
        shifts[0] = shifts[0] - offset;
        shifts[2] = shifts[2] - offset * square_;
        const S l = in<S>(cell.lower), u = in<S>(cell.upper);
        const auto forms = [&](const auto& c) { return bernstein(c, l, u); };
        PlaneForm<S> form;
        form.shift = forms(shifts);
        for (int axis = 0; axis < 3; ++axis) {
            const std::array<S, 4> of_axis =
                forms(std::array<S, 4>{rows[0][axis], rows[1][axis], rows[2][axis], rows[3][axis]});
            for (std::size_t j = 0; j < 4; ++j)
                form.row[j][axis] = of_axis[j];
        }
        return form;
    }

private:
    template <class T>
    static T in(const DoubleDouble& value) {
        return T(value);
    }
    static Matrix3<S> times(const Vector3<S>& a, const Matrix3<S>& m) {
        const Matrix3<S> columns = m.transposed();
        return Matrix3<S>{{cross(a, columns.row[0]), cross(a, columns.row[1]), cross(a, columns.row[2])}}.transposed();
    }
    static std::array<S, 4> bernstein(const std::array<S, 4>& c, const S& l, const S& u) {
        const S h = u - l, third = S(1) / S(3);
        const auto value = [&](const S& x) { return S(c[0] + x * (c[1] + x * (c[2] + x * c[3]))); };
        const auto rate = [&](const S& x) { return S(c[1] + x * (S(2) * c[2] + x * (S(3) * c[3]))); };
        return {value(l), S(value(l) + h * third * rate(l)), S(value(u) - h * third * rate(u)), value(u)};
    }

    S square_;
    std::array<Matrix3<S>, 3> linear_;
    std::array<Vector3<S>, 4> shift_;
};

} // namespace chasles::certificate
