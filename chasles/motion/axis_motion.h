// Motions about or along one axis, without rounding: the way is the paper's, whatever the law of time.
// Source: docs/derivations/35-one-axis.md.
#pragma once

#include "chasles/algebra/exact_number.h"
#include "chasles/motion/fixed_pose.h"
#include "chasles/motion/time_polynomial.h"

#include <cstdint>
#include <optional>

namespace chasles::motion {

/// A vector over a positive unit: the exact scalars have no division.
struct ScaledVector {
    Vector3<algebra::ExactNumber> numerators{};
    algebra::ExactNumber unit = 1.0;

    [[nodiscard]] bool is_zero() const;
    friend ScaledVector operator+(const ScaledVector& a, const ScaledVector& b);
    friend ScaledVector operator-(const ScaledVector& a, const ScaledVector& b);
};

/// A pose without rounding. The quaternion has any length.
struct ExactPose {
    Quaternion<algebra::ExactNumber> rotation{1.0, {}};
    ScaledVector translation;

    ExactPose() = default;
    explicit ExactPose(const Pose& pose);

    [[nodiscard]] ExactPose inverse() const;
    [[nodiscard]] ScaledVector turned(const ScaledVector& vector) const;
    [[nodiscard]] ScaledVector placed(const ScaledVector& point) const;
    friend ExactPose operator*(const ExactPose& outer, const ExactPose& inner);
};

/// Cosine and sine of half an angle over one positive unit, the sine divided by the length of the axis.
struct HalfTurn {
    algebra::ExactNumber cosine = 1.0;
    algebra::ExactNumber sine = 0.0;
};

/// The pose `base`, turned about a line by an angle in radians, or displaced by a multiple of `direction`, as `value`
/// says for each time in [0, 1].
struct AxisMotion {
    enum class Kind : std::uint8_t { rest, turn, slide };

    Kind kind = Kind::rest;
    ScaledVector direction; ///< of any length; zero at rest
    ScaledVector point;     ///< of the line, for a turn
    ExactPose base;
    TimePolynomial value = TimePolynomial(std::vector<double>{0, 1});
    std::optional<HalfTurn> goal; ///< at time 1, where it is known without rounding; the sine is the value for a slide

    /// The inverse of each pose.
    [[nodiscard]] AxisMotion inverse() const;
    /// From one time in [0, 1] to another.
    [[nodiscard]] AxisMotion part(double from, double to) const;
};

/// `inner`, carried by `outer`. Empty if it takes more than one axis, or numbers of more than 1,024 binary digits.
std::optional<AxisMotion> product(const AxisMotion& outer, const AxisMotion& inner);

/// A part of a frame's time during which it moves about or along one axis; the motion's own time is [0, 1].
struct AxisSection {
    Bracket times;
    AxisMotion motion;
};

/// The quotient of two exact numbers, of which the second is positive, with a relative error of at most 2^-100.
algebra::DoubleDouble quotient(const algebra::ExactNumber& a, const algebra::ExactNumber& b);

Vector3<algebra::DoubleDouble> quotients(const ScaledVector& v);

/// A number in double-double as an exact one.
algebra::ExactNumber exact_number(const algebra::DoubleDouble& x);

} // namespace chasles::motion
