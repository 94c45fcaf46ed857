// Turns from one rational half turn to another are screws without a slide. Source: docs/derivations/35-one-axis.md.
#include "chasles/motion/axis_piece.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

static_assert(TrajectoryPiece<AxisPiece>);

namespace {

using Exact = algebra::ExactNumber;
using Wide = algebra::DoubleDouble;

/// Of shares, values and times, relative to the larger ones.
constexpr double rounding_outwards = 0x1p-49;
/// Within this time of an end the value may not rise or fall as it does elsewhere, as its rate is nearly zero.
constexpr double stop_duration = 0x1p-43;
/// The turn about the axis by a half turn.
Quaternion<Exact> quaternion(const HalfTurn& turn, const ScaledVector& direction) {
    return {turn.cosine * direction.unit, scale(direction.numerators, turn.sine)};
}

/// The turn from one place to another about a line, after `base` at the value 0.
RationalMotion<Exact> exact_turn(const AxisMotion& motion, const HalfTurn& from, const HalfTurn& to) {
    const Quaternion<Exact> start = quaternion(from, motion.direction);
    const Quaternion<Exact> turn = quaternion(to, motion.direction) * start.conjugate();
    const Exact square = start.squared_norm();
    const ScaledVector apart = motion.base.translation - motion.point;
    const Vector3<Exact> arm = scaled_rotation_matrix(start) * apart.numerators; // over the unit of `apart` and square
    RationalMotion<Exact> result;
    result.turn_unit = result.end_cosine = turn.w;
    result.axis = turn.v;
    result.length_unit = apart.unit * square;
    result.origin = arm + scale(motion.point.numerators, Exact(motion.base.translation.unit * square));
    result.moment = cross(turn.v, arm);
    const Quaternion<Exact> orientation = start * motion.base.rotation;
    result.orientation = scaled_rotation_matrix(orientation);
    result.orientation_unit = orientation.squared_norm();
    return result;
}

/// The slide from one multiple of the direction to another. At rest the direction is zero.
RationalMotion<Exact> exact_slide(const AxisMotion& motion, const Exact& from, const Exact& to) {
    const ScaledVector& place = motion.base.translation;
    const Vector3<Exact> direction = scale(motion.direction.numerators, place.unit);
    RationalMotion<Exact> result;
    result.end_cosine = 1.0;
    result.length_unit = place.unit * motion.direction.unit;
    result.origin = scale(place.numerators, motion.direction.unit) + scale(direction, from);
    result.displacement = scale(direction, Exact(to - from));
    result.orientation = scaled_rotation_matrix(motion.base.rotation);
    result.orientation_unit = motion.base.rotation.squared_norm();
    return result;
}

RationalMotion<Exact> exact_motion(const AxisSpan& span) {
    const AxisMotion& motion = span.way->section.motion;
    const HalfTurn &from = span.start.place, &to = span.goal.place;
    return motion.kind == AxisMotion::Kind::turn ? exact_turn(motion, from, to)
                                                 : exact_slide(motion, from.sine, to.sine);
}

RationalMotion<Wide> rounded(const RationalMotion<Exact>& motion) {
    const Matrix3<Exact>& turn = motion.orientation;
    const auto row = [&](int i) { return quotients({turn.row[i], motion.orientation_unit}); };
    RationalMotion<Wide> result;
    result.end_cosine = 1.0;
    result.axis = quotients({motion.axis, motion.turn_unit});
    result.moment = quotients({motion.moment, motion.turn_unit * motion.length_unit});
    result.displacement = quotients({motion.displacement, motion.length_unit});
    result.origin = quotients({motion.origin, motion.length_unit});
    result.orientation = {{row(0), row(1), row(2)}};
    return result;
}

/// The same from rounded numbers: quicker, with errors of some roundings of the arm.
RationalMotion<Wide> quick_turn(const AxisSpan& span) {
    const AxisNumbers& numbers = span.way->rounded;
    const auto& [sine, cosine] = span.start.rounded;
    const auto& [goal_sine, goal_cosine] = span.goal.rounded;
    const Quaternion<Wide> start{cosine, scale(numbers.direction, sine)};
    const Wide tangent = (goal_sine * cosine - goal_cosine * sine) / (goal_cosine * cosine + goal_sine * sine);
    const Vector3<Wide> across = cross(numbers.direction, numbers.arm);
    const Wide twice = Wide(2.0) * sine;
    const Vector3<Wide> swing =
        scale(across, twice * cosine) + scale(cross(numbers.direction, across), twice * sine); // (R(start) - I) arm
    RationalMotion<Wide> result;
    result.end_cosine = 1.0;
    result.axis = scale(numbers.direction, tangent);
    result.origin = numbers.place + swing;
    result.moment = cross(result.axis, numbers.arm + swing);
    result.orientation = scaled_rotation_matrix(start * numbers.rotation);
    result.reference_extent = length(in_double(numbers.arm)) + norm1(in_double(numbers.place));
    return result;
}

RationalMotion<Wide> quick_slide(const AxisSpan& span) {
    const AxisNumbers& numbers = span.way->rounded;
    const Wide &from = span.start.rounded.sine, &to = span.goal.rounded.sine;
    RationalMotion<Wide> result;
    result.end_cosine = 1.0;
    result.displacement = scale(numbers.direction, to - from);
    result.origin = numbers.place + scale(numbers.direction, from);
    result.orientation = scaled_rotation_matrix(numbers.rotation);
    result.reference_extent = norm1(in_double(scale(numbers.direction, from))) + norm1(in_double(numbers.place));
    return result;
}

/// A body that turns little may be far from its axis, whose length would count as rounded.
RationalMotion<Wide> refined_motion(const AxisSpan& span) {
    constexpr double small_turn = 0x1p-6;
    const AxisMotion& motion = span.way->section.motion;
    if (motion.kind != AxisMotion::Kind::turn)
        return quick_slide(span);
    return motion.value.size() < small_turn ? rounded(exact_motion(span)) : quick_turn(span);
}

class AxisPieces final : public AnyPieces {
public:
    AxisPieces(SmoothMotion motion, std::shared_ptr<const std::vector<AxisSpan>> spans)
        : motion_(std::move(motion)), spans_(std::move(spans)) {}
    [[nodiscard]] std::size_t size() const override { return spans_->size(); }
    [[nodiscard]] std::unique_ptr<const AnyPiece> at(std::size_t index) const override {
        return std::make_unique<ErasedPiece<AxisPiece>>(
            AxisPiece(motion_, std::shared_ptr<const AxisSpan>(spans_, &(*spans_)[index])));
    }

private:
    SmoothMotion motion_;
    std::shared_ptr<const std::vector<AxisSpan>> spans_;
};

} // namespace

AxisPiece::AxisPiece(SmoothMotion motion, std::shared_ptr<const AxisSpan> span)
    : motion_(std::move(motion)), span_(std::move(span)), times_{span_->start.time, span_->goal.time},
      cubic_(refined_motion(*span_)), clock_(Quaternion<Wide>{1.0, cubic_.axis}) {}

std::optional<ExactMotion> AxisPiece::exact() const {
    return ExactMotion{nullptr, control_maps(exact_motion(*span_))};
}

/// Whether the share of the way is that of the time. Where there is no way, it may be.
bool AxisPiece::runs_evenly() const {
    const AxisMotion& motion = section().motion;
    return motion.kind == AxisMotion::Kind::rest || motion.value.is_straight() ||
           span_->start.value == span_->goal.value;
}

/// The section's own time.
double AxisPiece::local(double time) const {
    const auto& [lower, upper] = section().times;
    return std::clamp((time - lower) / (upper - lower), 0.0, 1.0);
}

double AxisPiece::global(double time) const {
    const auto& [lower, upper] = section().times;
    return lower + time * (upper - lower);
}

/// Rounded outward.
Bracket AxisPiece::times_of_shares(const Bracket& shares) const {
    const double duration = times_.upper - times_.lower;
    if (runs_evenly())
        return {times_.lower + shares.lower * duration, times_.lower + shares.upper * duration};
    const Wide &start = span_->start.value, way = span_->goal.value - start;
    const Bracket within{local(times_.lower), local(times_.upper)};
    Bracket times = times_at(section().motion.value, start + way * Wide(shares.lower * (1 - rounding_outwards)),
                             start + way * Wide(shares.upper * (1 + rounding_outwards)), within);
    const auto is_at_stop = [&](double time) {
        return (span_->start.is_slow && time < within.lower + stop_duration) ||
               (span_->goal.is_slow && time > within.upper - stop_duration);
    };
    if (is_at_stop(times.lower))
        times.lower -= stop_duration;
    if (is_at_stop(times.upper))
        times.upper += stop_duration;
    return {global(times.lower), global(times.upper)};
}

Bracket AxisPiece::time_of(const Bracket& tau) const {
    const Bracket times = times_of_shares({clock_.time_at(tau.lower), clock_.time_at(tau.upper)});
    const auto at = [&](double place, double time) { // the ends are exact
        return place <= 0 ? times_.lower : place >= 1 ? times_.upper : std::clamp(time, times_.lower, times_.upper);
    };
    return {at(tau.lower, times.lower * (1 - rounding_outwards)), at(tau.upper, times.upper * (1 + rounding_outwards))};
}

double AxisPiece::time_at(double tau) const {
    return middle_of(time_of({tau, tau}));
}

/// The share of the piece's way per unit of time, at a time.
double AxisPiece::share_rate(double time) const {
    if (runs_evenly())
        return 1 / (times_.upper - times_.lower);
    const double way = std::abs(double(span_->goal.value - span_->start.value));
    const double rate = std::abs(section().motion.value.rates({local(time), local(time)}).first);
    return rate / way / (section().times.upper - section().times.lower);
}

/// A lower bound during the piece.
double AxisPiece::least_share_rate() const {
    if (runs_evenly())
        return 1 / (times_.upper - times_.lower);
    const double way = std::abs(double(span_->goal.value - span_->start.value));
    const Bracket times{local(times_.lower), local(times_.upper)};
    const PolynomialRates rates = section().motion.value.rates(times);
    const double rate = std::max(0.0, std::abs(rates.first) - rates.bounds[1] * half_of(times));
    return rate / way / (section().times.upper - section().times.lower);
}

double AxisPiece::tau_rate(double tau) const {
    return clock_.tau_rate(tau) * share_rate(time_at(tau));
}

/// Where the value all but stops, no width of tau is narrow enough: a bracket of time is as wide as that of the value
/// makes it.
double AxisPiece::tau_tolerance(double time_tolerance) const {
    constexpr double least_rate = 0x1p-12; // of the mean rate
    const double mean_rate = 1 / (times_.upper - times_.lower);
    const double rate = std::max(least_share_rate(), least_rate * mean_rate);
    return std::min(1.0, time_tolerance * rate * std::min(1.0, clock_.tau_rate(0)));
}

Pose AxisPiece::pose_at(double tau) const {
    return public_pose(motion_.moving->at(time_at(tau)));
}

Pose AxisPiece::fixed_pose_at(double tau) const {
    return motion_.fixed ? public_pose(motion_.fixed->at(time_at(tau))) : Pose();
}

std::unique_ptr<const AnyPieces> axis_pieces(SmoothMotion motion, std::shared_ptr<const std::vector<AxisSpan>> spans) {
    if (spans->empty())
        return nullptr;
    return std::make_unique<AxisPieces>(std::move(motion), std::move(spans));
}

} // namespace chasles::motion
