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

/// Without the division that `product` needs for quaternions of any length.
template <class S>
GeneralPose<S> product_of_unit(const GeneralPose<S>& outer, const GeneralPose<S>& inner) {
    return {turned_by_unit(outer.rotation, inner.translation) + outer.translation, outer.rotation * inner.rotation};
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

AxisRates rates_across(const ElementaryJoint& joint, const Vector3<double>& direction, const RateBounds& bounds) {
    const Vector3<double>& axis = joint.axis.in_double;
    if (joint.turns)
        return turn_across(axis, direction, bounds.turn_rate, bounds.turn_acceleration);
    return {.acceleration = std::abs(dot(axis, direction)) * bounds.acceleration};
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
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        const double half = half_of(times);
        AxisExpansion e{at_rest({}), {}};
        for (const auto& [before, joint] : chain_.joints()) {
            e = carried(e, {at_rest(before), {}}, half, size_);
            const RateExpansion all = expansion_of(joint, times);
            e = carried(e, {all, rates_across(joint, seen_by(e.all, direction), all.bounds)}, half, size_);
        }
        return carried(e, {at_rest(chain_.last()), {}}, half, size_);
    }
    [[nodiscard]] double size() const override { return size_; }
    [[nodiscard]] double rounding() const override { return rounding_; }

private:
    Chain chain_;
    double size_;
    double rounding_;
};

} // namespace

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
