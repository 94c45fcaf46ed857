// The poses and the rates of a chain, from joint to joint. Source: docs/derivations/29-robots.md, "Chains".
#include "chasles/motion/chain_frame.h"

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/frame_in_both.h"
#include "chasles/motion/screw_path.h"

#include <cmath>
#include <utility>

namespace chasles::motion {

namespace {

using Wide = algebra::DoubleDouble;

template <class S>
Vector3<S> turned_by_unit(const Quaternion<S>& unit, const Vector3<S>& v) {
    const Vector3<S> across = cross(unit.v, v);
    return v + scale(scale(across, unit.w) + cross(unit.v, across), S(2));
}

template <class S>
GeneralPose<S> product_of_unit(const GeneralPose<S>& outer, const GeneralPose<S>& inner) {
    return {turned_by_unit(outer.rotation, inner.translation) + outer.translation, outer.rotation * inner.rotation};
}

template <class S>
const GeneralPose<S>& in(const FixedPose& pose) {
    if constexpr (std::is_same_v<S, double>)
        return pose.in_double;
    else
        return pose.refined;
}

template <class S>
const Vector3<S>& in(const FixedAxis& axis) {
    if constexpr (std::is_same_v<S, double>)
        return axis.in_double;
    else
        return axis.refined;
}

/// A turn by half the angle `half` about an axis.
template <class S>
Quaternion<S> turn_about(const FixedAxis& axis, const S& half) {
    const auto [sine, cosine] = algebra::sine_cosine(half);
    return {cosine, scale(in<S>(axis), sine)};
}

/// The rates of a polynomial, seen backwards where the joint is inverse.
PolynomialRates rates_of(const ElementaryJoint& joint, const Bracket& times) {
    PolynomialRates rates = joint.value->rates(times);
    if (joint.is_inverse)
        rates = {-rates.first, -rates.second, rates.bounds};
    return rates;
}

double signed_value(const ElementaryJoint& joint, double time) {
    const double value = joint.value->at(time);
    return joint.is_inverse ? -value : value;
}

void turn(RateExpansion& expansion, const FixedAxis& axis, double value, const PolynomialRates& rates) {
    expansion.pose.rotation = turn_about(axis, 0.5 * value);
    expansion.turn_rate = scale(axis.in_double, rates.first);
    expansion.turn_acceleration = scale(axis.in_double, rates.second);
    expansion.bounds = {rates.bounds[0], rates.bounds[1], 0, 0};
    expansion.turn_jerk = rates.bounds[2];
}

void slide(RateExpansion& expansion, const Vector3<double>& axis, double value, const PolynomialRates& rates) {
    expansion.pose.translation = expansion.reference = scale(axis, value);
    expansion.velocity = scale(axis, rates.first);
    expansion.acceleration = scale(axis, rates.second);
    expansion.bounds = {0, 0, rates.bounds[0], rates.bounds[1]};
    expansion.jerk = rates.bounds[2];
}

/// A joint as a frame of its own, whose reference is its origin.
RateExpansion expansion_of(const ElementaryJoint& joint, const Bracket& times) {
    const PolynomialRates rates = rates_of(joint, times);
    const double value = signed_value(joint, middle_of(times));
    const Vector3<double>& axis = joint.axis.in_double;
    RateExpansion expansion{.pose = {{}, {1, {}}}};
    expansion.turn_jerk = expansion.jerk = 0;
    if (joint.turns)
        turn(expansion, joint.axis, value, rates);
    else
        slide(expansion, axis, value, rates);
    expansion.sums = expansion.bounds;
    return expansion;
}

RateExpansion at_rest(const FixedPose& pose) {
    RateExpansion expansion{.pose = pose.in_double, .reference = pose.in_double.translation};
    expansion.turn_jerk = expansion.jerk = 0;
    return expansion;
}

class ChainFrame final : public FrameInBoth<ChainFrame> {
public:
    explicit ChainFrame(Chain chain) : chain_(std::move(chain)), size_(chain_.size()), rounding_(chain_.rounding()) {}

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        GeneralPose<S> pose{{}, {S(1.0), {}}};
        for (const auto& [before, joint] : chain_.joints()) {
            pose = product_of_unit(pose, in<S>(before));
            S value = joint.value->at(time);
            if (joint.is_inverse)
                value = -value;
            if (joint.turns)
                pose.rotation = pose.rotation * turn_about<S>(joint.axis, S(0.5) * value);
            else
                pose.translation = pose.translation + turned_by_unit(pose.rotation, scale(in<S>(joint.axis), value));
        }
        return product_of_unit(pose, in<S>(chain_.last()));
    }
    [[nodiscard]] Vector3<double> reference() const override { return {}; }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return {}; }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        const double half = half_of(times);
        RateExpansion expansion = at_rest(chain_.joints().empty() ? chain_.last() : chain_.joints().front().before);
        for (std::size_t i = 0; i < chain_.joints().size(); ++i) {
            const bool is_last = i + 1 == chain_.joints().size();
            expansion = carried(expansion, expansion_of(chain_.joints()[i].joint, times), half, size_);
            expansion =
                carried(expansion, at_rest(is_last ? chain_.last() : chain_.joints()[i + 1].before), half, size_);
        }
        return expansion;
    }
    [[nodiscard]] double size() const override { return size_; }
    [[nodiscard]] double rounding() const override { return rounding_; }

private:
    Chain chain_;
    double size_;
    double rounding_;
};

} // namespace

FixedPose::FixedPose(const Pose& given) {
    refined = pose_in<Wide>(is_ordinary(given) ? given : Pose(given.translation, Eigen::Quaterniond(given.rotation)));
    const Wide inverse = Wide(1.0) / sqrt(refined.rotation.squared_norm());
    refined.rotation = {refined.rotation.w * inverse, scale(refined.rotation.v, inverse)};
    in_double = rounded_pose(refined);
}

FixedPose FixedPose::inverse() const {
    const Quaternion<Wide> back = refined.rotation.conjugate();
    return FixedPose(GeneralPose<Wide>{Vector3<Wide>() - turned_by_unit(back, refined.translation), back});
}

FixedPose operator*(const FixedPose& outer, const FixedPose& inner) {
    return FixedPose(product_of_unit(outer.refined, inner.refined));
}

/// The largest component is brought to the order of one first, by a power of two: nothing underflows or is rounded.
FixedAxis::FixedAxis(const Eigen::Vector3d& direction) {
    const double factor = std::ldexp(1.0, -std::ilogb(direction.cwiseAbs().maxCoeff()));
    const Vector3<Wide> scaled = vector_in<Wide>(direction * factor);
    *this = FixedAxis(scale(scaled, Wide(1.0) / length(scaled)));
}

RateBounds Chain::rates(const Bracket& times) const {
    RateBounds bounds{0, 0, 0, 0};
    const auto go_out = [&](double arm) {
        bounds.speed += bounds.turn_rate * arm;
        bounds.acceleration += (bounds.turn_acceleration + bounds.turn_rate * bounds.turn_rate) * arm;
    };
    for (const auto& [before, joint] : joints_) {
        go_out(length(before.in_double.translation));
        const PolynomialRates rates = joint.value->rates(times);
        if (joint.turns) {
            bounds.turn_acceleration += rates.bounds[1] + bounds.turn_rate * rates.bounds[0];
            bounds.turn_rate += rates.bounds[0];
        } else {
            go_out(joint.value->size());
            bounds.acceleration += rates.bounds[1] + 2 * bounds.turn_rate * rates.bounds[0];
            bounds.speed += rates.bounds[0];
        }
    }
    go_out(length(last_.in_double.translation));
    return bounds;
}

double Chain::size() const {
    double size = norm1(last_.in_double.translation);
    for (const auto& [before, joint] : joints_)
        size += norm1(before.in_double.translation) + (joint.turns ? 0 : joint.value->size());
    return size;
}

/// Each turn counts for itself and for the rounding of its angle, each fixed pose once.
double Chain::rounding() const {
    double rounding = 1;
    for (const Joint& joint : joints_)
        rounding += 2 + joint.joint.value->rounding() * (joint.joint.turns ? joint.joint.value->size() : 1);
    return rounding;
}

SharedFrame chain_frame(Chain chain) {
    return std::make_shared<const ChainFrame>(std::move(chain));
}

} // namespace chasles::motion
