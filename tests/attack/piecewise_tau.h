// An exact first contact on a motion that is cut into pieces, as tau and as time.
#pragma once

#include "tests/attack/posed_motion.h"

#include <cmath>
#include <optional>

namespace chasles::attack {

using reference::Root;

/// The first touch: the piece, the number of pieces, and tau within the piece.
struct PiecewiseTau {
    std::optional<Root> tau;
    std::size_t piece = 0;
    std::size_t count = 1;

    /// Compares the exact tau, (piece + tau) / count, with a double.
    [[nodiscard]] int compared_to(double x) const {
        Integer mantissa(static_cast<long long>(std::ldexp(x, 62)));
        unsigned depth = 62;
        while (std::ldexp(static_cast<double>(mantissa), -int(depth)) != x) { // tiny numbers
            depth += 62;
            mantissa = Integer(numerator(Rational(Rational(x) * Integer(Integer(1) << depth))));
        }
        const Integer within = mantissa * Integer(count) - (Integer(piece) << depth);
        Root copy = *tau;
        Root there = Root::point(within, depth);
        return compare(copy, there);
    }

    /// The time in extended precision, with an error of about 1e-18. In a piece of a screw tau is
    /// f(t) = tan(w t / 2) / tan(w / 2), and the weight is 1 + tan(w / 2)^2 tau^2 times a number. On a sweep time is
    /// tau.
    [[nodiscard]] long double time(MotionKind kind, const MotionPath<Rational>& path) const {
        Root copy = *tau;
        const auto at = copy.narrowed(90).convert_to<long double>(); // times may run hundreds of times as fast
        const Rational square(path.weight[2] / path.weight[0]);
        const long double tangent = std::sqrt(square.convert_to<long double>());
        const long double within =
            kind == MotionKind::sweep || tangent == 0 ? at : std::atan(at * tangent) / std::atan(tangent);
        return (static_cast<long double>(piece) + within) / static_cast<long double>(count);
    }
};

} // namespace chasles::attack
