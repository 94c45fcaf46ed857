// Finds the times at which a polynomial turns back by the signs of its rate, and where it has a value by bisection.
// Source: docs/derivations/35-one-axis.md, "Stops".
#include "chasles/motion/axis_way.h"

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/screw_clock.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

using Exact = algebra::ExactNumber;
using Wide = algebra::DoubleDouble;

/// Of one piece, in radians: just a small rotation (`is_small_rotation`), whose maps are made in double.
constexpr double most_turn_of_piece = 0.2485;
/// An interval in which a rate may change its sign is halved until it is as short as this.
constexpr double least_interval = 0x1p-45;
/// More often a value turns back only by design.
constexpr std::size_t most_turning_points = 200;
/// The next turning point is at least so much later, and the first and the last are so far from the ends.
constexpr double least_distance = 4 * least_interval;
/// How far a way goes on beyond an end that is rounded, relative to the sizes of the value and its rate: more than the
/// error of a value and of its sine, and than a way that counts as none.
constexpr double reserve = 0x1p-90;

/// Finds the times at which a polynomial turns back, up to rounding.
class TurningPoints {
public:
    explicit TurningPoints(const TimePolynomial& value) : rate_(value.derivative()) { find({0, 1}); }

    [[nodiscard]] const std::vector<double>& all() const { return found_; }

private:
    void find(const Bracket& times);
    void add(double time) {
        if (time > (found_.empty() ? 0 : found_.back()) + least_distance && 1 - time > least_distance)
            found_.push_back(time);
    }

    TimePolynomial rate_;
    int sign_ = 0; ///< of the rate in the interval before; 0 where it is not known
    std::vector<double> found_;
};

/// Where all Bernstein coefficients of the rate have one sign, the polynomial rises or falls.
void TurningPoints::find(const Bracket& times) {
    if (found_.size() > most_turning_points)
        return;
    const double rounding = reserve * rate_.size();
    const std::vector<Wide> rates = rate_.part(times.lower, times.upper).bernstein();
    const auto rises = [&](const Wide& rate) { return double(rate) > -rounding; };
    const auto falls = [&](const Wide& rate) { return double(rate) < rounding; };
    const bool never_falls = std::ranges::all_of(rates, rises), never_rises = std::ranges::all_of(rates, falls);
    if (never_falls && never_rises)
        return;
    if (never_falls || never_rises) {
        const int sign = never_falls ? 1 : -1;
        if (sign * sign_ < 0)
            add(times.lower);
        sign_ = sign;
    } else if (times.upper - times.lower <= least_interval) {
        add(middle_of(times));
        sign_ = 0;
    } else {
        find({times.lower, middle_of(times)});
        find({middle_of(times), times.upper});
    }
}

bool is_turn(const AxisMotion& motion) {
    return motion.kind == AxisMotion::Kind::turn;
}

/// From the nearest point of the line to the body's origin.
ScaledVector arm_of(const AxisMotion& motion) {
    const ScaledVector apart = motion.base.translation - motion.point;
    const Vector3<Exact>& direction = motion.direction.numerators;
    const Exact square = dot(direction, direction);
    const Exact along = dot(direction, apart.numerators);
    return {scale(apart.numerators, square) - scale(direction, along), apart.unit * square};
}

Quaternion<Wide> unit_quaternion(const Quaternion<Exact>& q) {
    const Exact square = q.squared_norm();
    const auto component = [&](const Exact& x) { // with the sign of x
        const Wide size = sqrt(quotient(x * x, square));
        return x.sign() < 0 ? -size : size;
    };
    return {component(q.w), {component(q.v.x), component(q.v.y), component(q.v.z)}};
}

/// Makes the stops of one section.
class Stops {
public:
    explicit Stops(const AxisSection& section)
        : times_(section.times), motion_(section.motion),
          reserve_(reserve * (1 + motion_.value.size() + motion_.value.derivative().size())) {
        if (is_turn(motion_))
            length_ = length(quotients(motion_.direction));
    }

    [[nodiscard]] std::vector<AxisStop> all() const;

private:
    [[nodiscard]] Wide value_at(double time) const { return motion_.value.at(Wide(time)); }
    [[nodiscard]] AxisStop stop(double time, const Wide& value) const;
    void round(AxisStop& stop, const Wide& cosine, const Wide& sine) const;
    [[nodiscard]] AxisStop end(double time, double outwards) const;
    void add_between(std::vector<AxisStop>& stops, const Bracket& times) const;

    Bracket times_;
    const AxisMotion& motion_;
    double reserve_;    ///< in values
    Wide length_ = 1.0; ///< of the axis of a turn
};

/// At a time of the section.
AxisStop Stops::stop(double time, const Wide& value) const {
    const double duration = times_.upper - times_.lower;
    AxisStop stop{time == 1 ? times_.upper : times_.lower + time * duration, value, false, {}, {value, 1.0}};
    if (is_turn(motion_)) {
        stop.rounded = algebra::sine_cosine(Wide(0.5) * value);
        stop.place = {exact_number(stop.rounded.cosine), exact_number(stop.rounded.sine / length_)};
    } else {
        stop.place.sine = exact_number(value);
    }
    return stop;
}

/// Rounds the place, which is a multiple of these numbers.
void Stops::round(AxisStop& stop, const Wide& cosine, const Wide& sine) const {
    if (!is_turn(motion_))
        return;
    const Wide of_unit_length = sine * length_;
    const Wide inverse = Wide(1.0) / sqrt(cosine * cosine + of_unit_length * of_unit_length);
    stop.rounded = {of_unit_length * inverse, cosine * inverse};
}

/// An end of the way, or where it turns back, a little beyond.
AxisStop Stops::end(double time, double outwards) const {
    const Wide value = value_at(time);
    if (time == 1 && motion_.goal) {
        AxisStop stop = this->stop(time, value);
        stop.place = *motion_.goal;
        const Exact sum = stop.place.cosine + stop.place.sine; // of numbers that are not negative
        round(stop, quotient(stop.place.cosine, sum), quotient(stop.place.sine, sum));
        return stop;
    }
    const double near = 2 * least_distance; // the rate may be zero so near
    const double curvature = motion_.value.rates({std::max(0.0, time - near), std::min(1.0, time + near)}).bounds[1];
    const double rate = std::abs(motion_.value.rates({time, time}).first);
    const bool is_slow = rate <= curvature * near;
    const bool is_exact = value == Wide(0.0) && (time == 0 || time == 1) && (rate == 0 || !is_slow);
    const double beyond = is_exact ? 0 : reserve_ + curvature * near * near;
    AxisStop stop = this->stop(time, value + Wide(outwards * beyond));
    stop.is_slow = is_slow;
    return stop;
}

/// Between two ends of a turn. Their places need not be those of their values: doubles keep numbers short.
void Stops::add_between(std::vector<AxisStop>& stops, const Bracket& times) const {
    if (!is_turn(motion_))
        return;
    const double first = double(value_at(times.lower)), turn = double(value_at(times.upper)) - first;
    const std::size_t count = equal_turns(std::abs(turn), most_turn_of_piece);
    for (std::size_t k = 1; k < count; ++k) {
        const double value = first + double(k) / double(count) * turn;
        const double time = middle_of(times_at(motion_.value, value, value, times));
        AxisStop stop = this->stop(time, Wide(value));
        const double cosine = stop.place.cosine.rational().truncated(), sine = stop.place.sine.rational().truncated();
        stop.place = {cosine, sine};
        round(stop, cosine, sine);
        stops.push_back(std::move(stop));
    }
}

std::vector<AxisStop> Stops::all() const {
    std::vector<double> ends{0};
    if (motion_.kind != AxisMotion::Kind::rest && !motion_.value.is_straight()) {
        const TurningPoints turning(motion_.value);
        ends.insert(ends.end(), turning.all().begin(), turning.all().end());
    }
    if (ends.size() > most_turning_points)
        return {};
    ends.push_back(1);
    std::vector<AxisStop> stops;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto falls_to = [&](std::size_t other) { // from this end; 0 where it stays
            const double fall = double(value_at(ends[i]) - value_at(ends[other]));
            return std::abs(fall) <= reserve_ ? 0.0 : std::copysign(1.0, fall);
        };
        const double before = falls_to(i == 0 ? 1 : i - 1), after = falls_to(i + 1 == ends.size() ? i - 1 : i + 1);
        stops.push_back(end(ends[i], before == after ? before : 0));
        if (i + 1 < ends.size())
            add_between(stops, {ends[i], ends[i + 1]});
    }
    return stops;
}

} // namespace

AxisNumbers::AxisNumbers(const AxisMotion& motion)
    : direction(quotients(motion.direction)), place(quotients(motion.base.translation)),
      rotation(unit_quaternion(motion.base.rotation)) {
    if (!is_turn(motion))
        return;
    direction = scale(direction, Wide(1.0) / length(direction));
    arm = quotients(arm_of(motion));
}

std::vector<AxisSpan> axis_spans(std::vector<AxisSection> sections) {
    std::vector<AxisSpan> spans;
    for (AxisSection& given : sections) {
        const auto way = std::make_shared<const AxisWay>(std::move(given));
        const std::vector<AxisStop> stops = Stops(way->section).all();
        if (stops.empty())
            return {};
        for (std::size_t i = 0; i + 1 < stops.size(); ++i)
            spans.push_back({way, stops[i], stops[i + 1]});
    }
    return spans;
}

Bracket times_at(const TimePolynomial& polynomial, const Wide& first, const Wide& last, const Bracket& times) {
    constexpr double rounding = 0x1p-96;
    const Wide start = polynomial.at(Wide(times.lower)), goal = polynomial.at(Wide(times.upper));
    const bool rises = start == goal ? !(last < first) : start < goal;
    const Wide slack((rises ? rounding : -rounding) * (1 + polynomial.size()));
    // The last time at which the polynomial is before a value, and the next one.
    const auto around = [&](const Wide& value) {
        Bracket found = times;
        for (double middle = middle_of(found); found.lower < middle && middle < found.upper;
             middle = middle_of(found)) {
            const Wide there = polynomial.at(Wide(middle));
            ((rises ? there < value : value < there) ? found.lower : found.upper) = middle;
        }
        return found;
    };
    return {around(first - slack).lower, around(last + slack).upper};
}

} // namespace chasles::motion
