// Screws and sweeps as polynomials in tau, for planes that stand still: where a corner of the moving body is.
// Source: docs/derivations/02-rational-motion.md; docs/certificate.md, "Motion".
#pragma once

#include "chasles/certificate/plane_form.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::certificate {

/// W p = sum of tau^k (linear[k] b + shift[k]), W = 1 + 2 bend tau + square tau^2.
template <class S>
class RationalPiece {
public:
    explicit RationalPiece(const motion::RationalMotion<S>& given)
        : bend_(given.end_cosine - S(1)), square_(bend_ * bend_ + dot(given.axis, given.axis)) {
        const Vector3<S>&a = given.axis, &m = given.moment, &d = given.displacement, &o = given.origin;
        const S two(2), twice(two * bend_);
        const Matrix3<S>& turned = given.orientation;
        const Matrix3<S> across = cross_matrix(a) * turned, again = cross_matrix(a) * across;
        linear_ = {turned, scale(turned, twice) + scale(across, two),
                   scale(turned, square_) + scale(across, twice) + scale(again, two)};
        shift_ = {o, d + scale(o, twice) + scale(m, two),
                  scale(d, twice) + scale(o, square_) + scale(scale(m, bend_) + cross(a, m), two), scale(d, square_)};
    }

    [[nodiscard]] Vector3<S> place(const Corner& corner, const S& tau) const {
        const Vector3<S> b = algebra::cast<S>(corner);
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
    /// Of the plane n . x = offset, in Bernstein form.
    [[nodiscard]] PlaneForm<S> against(const Vector3<S>& normal, const S& offset, const Cell& cell,
                                       const Ball& /*node*/) const {
        std::array<Vector3<S>, 4> rows;
        std::array<S, 4> shifts;
        for (std::size_t k = 0; k < 4; ++k) {
            if (k < 3)
                rows[k] = linear_[k].transposed() * normal;
            shifts[k] = dot(normal, shift_[k]);
        }
        shifts[0] = shifts[0] - offset;
        shifts[1] = shifts[1] - offset * S(2) * bend_;
        shifts[2] = shifts[2] - offset * square_;
        const S l = S(cell.lower), u = S(cell.upper);
        PlaneForm<S> form;
        form.shift = bernstein(shifts, l, u);
        for (int axis = 0; axis < 3; ++axis) {
            const std::array<S, 4> of_axis =
                bernstein({rows[0][axis], rows[1][axis], rows[2][axis], rows[3][axis]}, l, u);
            for (std::size_t j = 0; j < 4; ++j)
                form.row[j][axis] = of_axis[j];
        }
        return form;
    }

private:
    [[nodiscard]] S weight(const S& tau) const { return S(1) + tau * (S(2) * bend_ + square_ * tau); }
    static std::array<S, 4> bernstein(const std::array<S, 4>& c, const S& l, const S& u) {
        const S h = u - l, third = S(1) / S(3);
        const auto value = [&](const S& x) { return S(c[0] + x * (c[1] + x * (c[2] + x * c[3]))); };
        const auto rate = [&](const S& x) { return S(c[1] + x * (S(2) * c[2] + x * (S(3) * c[3]))); };
        return {value(l), S(value(l) + h * third * rate(l)), S(value(u) - h * third * rate(u)), value(u)};
    }

    S bend_, square_;
    std::array<Matrix3<S>, 3> linear_;
    std::array<Vector3<S>, 4> shift_;
};

} // namespace chasles::certificate
