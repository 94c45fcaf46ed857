// Carries axes by poses; joins turns about one line. Source: docs/derivations/35-one-axis.md.
#include "chasles/motion/axis_motion.h"

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>

namespace chasles::motion {

namespace {

using Exact = algebra::ExactNumber;
using Wide = algebra::DoubleDouble;

bool is_zero(const Vector3<Exact>& v) {
    return v.x.sign() == 0 && v.y.sign() == 0 && v.z.sign() == 0;
}

Vector3<Exact> negated(const Vector3<Exact>& v) {
    return Vector3<Exact>() - v;
}

/// Longer numbers make coefficients that the exact stage gives up, and products of many poses would double them again
/// and again.
constexpr unsigned most_digits = 1024;

/// A number of size about one, rounded.
Wide wide(const algebra::Dyadic& x) {
    const double high = x.truncated();
    return Wide::exact_sum(high, (x - algebra::Dyadic(high)).truncated());
}

/// Divides integers, each times a power of two, by what they have in common: poses that undo each other leave nothing.
void reduce(std::initializer_list<Exact*> numbers) {
    algebra::Dyadic::Integer common = 0;
    for (const Exact* number : numbers)
        common = gcd(common, number->rational().mantissa());
    if (common <= 1)
        return;
    for (Exact* number : numbers) {
        const algebra::Dyadic& given = number->rational();
        *number = algebra::Dyadic(given.mantissa() / common, given.exponent());
    }
}

ScaledVector reduced(ScaledVector vector) {
    auto& [x, y, z] = vector.numerators;
    reduce({&x, &y, &z, &vector.unit});
    return vector;
}

/// 1 or -1 if both lines are one, 0 if not.
int same_line(const AxisMotion& a, const AxisMotion& b) {
    const Vector3<Exact>& direction = a.direction.numerators;
    const ScaledVector apart = b.point - a.point;
    if (!is_zero(cross(direction, b.direction.numerators)) || !is_zero(cross(direction, apart.numerators)))
        return 0;
    return dot(direction, b.direction.numerators).sign();
}

bool is_long(const ScaledVector& v) {
    const auto& [x, y, z] = v.numerators;
    return std::max({x.digits(), y.digits(), z.digits(), v.unit.digits()}) > most_digits;
}

bool is_long(const AxisMotion& motion) {
    return is_long(motion.direction) || is_long(motion.point) || is_long(motion.base.translation) ||
           is_long(ScaledVector{motion.base.rotation.v, motion.base.rotation.w});
}

/// A motion, seen from outside of a pose that carries it.
AxisMotion carried(const ExactPose& pose, AxisMotion motion) {
    motion.direction = pose.turned(motion.direction);
    motion.point = pose.placed(motion.point);
    motion.base = pose * motion.base;
    return motion;
}

} // namespace

std::vector<AxisSection> MovingFrame::axis_sections() const {
    return {};
}

bool ScaledVector::is_zero() const {
    return motion::is_zero(numerators);
}

ScaledVector operator+(const ScaledVector& a, const ScaledVector& b) {
    return {scale(a.numerators, b.unit) + scale(b.numerators, a.unit), a.unit * b.unit};
}

ScaledVector operator-(const ScaledVector& a, const ScaledVector& b) {
    return a + ScaledVector{negated(b.numerators), b.unit};
}

Exact exact_number(const Wide& x) {
    return Exact(x.high()) + Exact(x.low());
}

Wide quotient(const Exact& a, const Exact& b) {
    const algebra::Dyadic& divisor = b.rational();
    const int power = -(divisor.exponent() + int(divisor.digits()));
    return wide(a.rational().times_power_of_two(power)) / wide(divisor.times_power_of_two(power));
}

Vector3<Wide> quotients(const ScaledVector& v) {
    const auto& [x, y, z] = v.numerators;
    return {quotient(x, v.unit), quotient(y, v.unit), quotient(z, v.unit)};
}

ExactPose::ExactPose(const Pose& pose) {
    const auto given = pose_in<Exact>(pose);
    rotation = given.rotation;
    translation.numerators = given.translation;
}

/// Without a turn, numbers do not become longer.
ScaledVector ExactPose::turned(const ScaledVector& vector) const {
    if (motion::is_zero(rotation.v) || vector.is_zero())
        return vector;
    return reduced({scaled_rotation_matrix(rotation) * vector.numerators, vector.unit * rotation.squared_norm()});
}

ScaledVector ExactPose::placed(const ScaledVector& point) const {
    if (point.is_zero())
        return translation;
    return translation.is_zero() ? turned(point) : reduced(turned(point) + translation);
}

ExactPose ExactPose::inverse() const {
    ExactPose back;
    back.rotation = rotation.conjugate();
    back.translation = back.turned({negated(translation.numerators), translation.unit});
    return back;
}

ExactPose operator*(const ExactPose& outer, const ExactPose& inner) {
    ExactPose product;
    product.rotation = outer.rotation * inner.rotation;
    auto& [w, v] = product.rotation;
    reduce({&w, &v.x, &v.y, &v.z});
    product.translation = outer.placed(inner.translation);
    return product;
}

/// (X B)^-1 is B^-1 X^-1, where X^-1 goes the other way.
AxisMotion AxisMotion::inverse() const {
    AxisMotion back = *this;
    back.base = ExactPose();
    back.direction.numerators = negated(direction.numerators);
    return carried(base.inverse(), back);
}

AxisMotion AxisMotion::part(double from, double to) const {
    AxisMotion part = *this;
    if (kind == Kind::rest || (from == 0 && to == 1))
        return part;
    part.value = value.part(from, to);
    part.goal.reset();
    return part;
}

/// (X A) (Y B) is X Y' A B, where A carries Y to Y'.
std::optional<AxisMotion> product(const AxisMotion& outer, const AxisMotion& inner) {
    const AxisMotion moved = carried(outer.base, inner);
    if (is_long(moved))
        return std::nullopt;
    if (outer.kind == AxisMotion::Kind::rest)
        return moved;
    AxisMotion result = outer;
    result.base = moved.base;
    if (inner.kind == AxisMotion::Kind::rest)
        return result;
    const bool turn = outer.kind == AxisMotion::Kind::turn && inner.kind == AxisMotion::Kind::turn;
    const int way = turn ? same_line(outer, moved) : 0;
    if (way == 0)
        return std::nullopt;
    result.value = way > 0 ? outer.value + inner.value : outer.value - inner.value;
    result.goal.reset();
    if (result.value.is_zero())
        result.kind = AxisMotion::Kind::rest;
    return result;
}

} // namespace chasles::motion
