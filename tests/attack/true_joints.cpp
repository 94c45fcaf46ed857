// Hinges, paths, B-splines and tracks in multiprecision.
//
// Rates of a polynomial p over a part of time follow from the mean value theorem: |p| is at most |p| in the middle and
// half of the duration times the largest |p'|. This ends at the degree.
#include "tests/attack/true_motion.h"
#include "tests/attack/wide_turn.h"

#include <algorithm>
#include <cmath>

namespace chasles::attack {

namespace {

/// The coefficients of a polynomial; T is a number or a vector.
template <class T>
using Series = std::vector<T>;

Wide zero_of(const Wide*) {
    return Wide(0);
}
WideVector zero_of(const WideVector*) {
    return WideVector::Zero();
}
double length_of(const Wide& x) {
    return double(abs(x)) * bound_rounding;
}
double length_of(const WideVector& v) {
    return double(v.norm()) * bound_rounding;
}

template <class T>
T value_of(const Series<T>& series, const Wide& time) {
    T value = zero_of(static_cast<const T*>(nullptr));
    for (std::size_t k = series.size(); k-- > 0;)
        value = T(value * time + series[k]);
    return value;
}

template <class T>
Series<T> derivative_of(const Series<T>& series) {
    Series<T> derivative;
    for (std::size_t k = 1; k < series.size(); ++k)
        derivative.push_back(T(series[k] * Wide(int(k))));
    return derivative;
}

template <class T>
double largest(const Series<T>& series, const TruePart& part) {
    if (series.empty())
        return 0;
    const double change = part.half() * largest(derivative_of(series), part);
    return (length_of(value_of(series, part.middle())) + change) * bound_rounding;
}

std::vector<TruePart> equal_parts(int count) {
    std::vector<TruePart> parts;
    for (int i = 0; i < count; ++i)
        parts.push_back({double(i) / count, double(i + 1) / count});
    return parts;
}

/// Six times the basis of the uniform cubic B-spline: the weights of four control points, lowest power first.
constexpr int basis[4][4] = {{1, -3, 3, -1}, {4, 0, -6, 3}, {1, 3, 3, -3}, {0, 0, 0, 1}};

Series<WideVector> place_of(const Pose* poses) {
    Series<WideVector> place(4, WideVector::Zero());
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            place[k] += widened(poses[i].translation) * Wide(basis[i][k]) / Wide(6);
    return place;
}

/// The angle of the turn from control orientation j to the next one: it has the weights of all later ones.
Series<Wide> angle_of(std::size_t j, const Wide& angle) {
    Series<Wide> share(4, Wide(0));
    for (std::size_t i = j + 1; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            share[k] += angle * Wide(basis[i][k]) / Wide(6);
    return share;
}

/// A turn that is carried by the orientation before.
struct CarriedTurn {
    EvenTurn turn;
    Series<Wide> angle;

    [[nodiscard]] WideMatrix at(const Wide& time) const {
        return turn.from.transpose() * turn.turned(value_of(angle, time)) * turn.from;
    }
};

/// One segment with four control poses. Angular velocities add up, and each turn carries the later ones.
TrueMotion segment_of(const Pose* poses) {
    std::vector<CarriedTurn> turns;
    for (std::size_t j = 0; j < 3; ++j) {
        const EvenTurn turn(poses[j], poses[j + 1]);
        turns.push_back({turn, angle_of(j, turn.angle)});
    }
    const Series<WideVector> place = place_of(poses);
    TruePart part;
    TrueRates& rates = part.rates;
    for (const CarriedTurn& turn : turns) {
        const Series<Wide> rate = derivative_of(turn.angle);
        const double turn_rate = largest(rate, part);
        rates.turn_acceleration += largest(derivative_of(rate), part) + rates.turn_rate * turn_rate;
        rates.turn_rate += turn_rate;
    }
    rates.turn_acceleration *= bound_rounding;
    rates.turn_rate *= bound_rounding;
    rates.speed = largest(derivative_of(place), part);
    rates.acceleration = largest(derivative_of(derivative_of(place)), part);
    const auto at = [turns, place, from = turns.front().turn.from](const Wide& time) {
        return TruePose{from * turns[0].at(time) * turns[1].at(time) * turns[2].at(time), value_of(place, time)};
    };
    return {at, Eigen::Vector3d::Zero(), {part}, 0, 4};
}

} // namespace

TrueMotion true_rest(const Pose& pose) {
    const TruePose stays{matrix_of(unit_of(pose)), widened(pose.translation)};
    return {[stays](const Wide&) { return stays; }, Eigen::Vector3d::Zero(), {TruePart{}}, pose.translation.norm(), 1};
}

/// The reference is on the line. A part turns by about a radian.
TrueMotion true_hinge(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                      const std::vector<double>& angle) {
    const WideVector line = widened(direction) / Wide(widened(direction).norm());
    const Series<Wide> series(angle.begin(), angle.end());
    const Series<Wide> rate = derivative_of(series);
    TrueMotion hinge;
    hinge.reference = point;
    hinge.size = 2 * point.norm();
    hinge.parts = equal_parts(std::clamp(int(std::ceil(largest(rate, {0, 1}))), 1, 40));
    for (TruePart& part : hinge.parts) {
        part.rates.turn_rate = largest(rate, part);
        part.rates.turn_acceleration = largest(derivative_of(rate), part);
    }
    hinge.at = [line, series, point = widened(point)](const Wide& time) {
        const WideMatrix turn = turn_about(line, value_of(series, time));
        return TruePose{turn, point - turn * point};
    };
    return hinge;
}

TrueMotion true_polynomial(const std::vector<Eigen::Vector3d>& places) {
    TrueMotion path;
    Series<WideVector> series;
    for (const Eigen::Vector3d& place : places) {
        series.push_back(widened(place));
        path.size += place.norm();
    }
    const Series<WideVector> velocity = derivative_of(series);
    path.parts = equal_parts(places.size() > 2 ? 4 : 1);
    for (TruePart& part : path.parts) {
        part.rates.speed = largest(velocity, part);
        part.rates.acceleration = largest(derivative_of(velocity), part);
    }
    path.at = [series](const Wide& time) { return TruePose{WideMatrix::Identity(), value_of(series, time)}; };
    return path;
}

TrueMotion true_b_spline(const std::vector<Pose>& poses) {
    std::vector<Pose> control(2, poses.front());
    control.insert(control.end(), poses.begin(), poses.end());
    control.insert(control.end(), 2, poses.back());
    const std::size_t count = control.size() - 3;
    std::vector<double> times{0};
    std::vector<TrueMotion> segments;
    for (std::size_t i = 0; i < count; ++i) {
        times.push_back(double(i + 1) / double(count)); // the knots are doubles
        segments.push_back(segment_of(&control[i]));
    }
    return true_track(times, segments);
}

TrueMotion true_track(const std::vector<double>& times, const std::vector<TrueMotion>& motions) {
    TrueMotion track;
    track.reference = motions.front().reference;
    track.elements = motions.front().elements;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const double slower = bound_rounding / (times[i + 1] - times[i]);
        const TrueRates& rates = motions[i].parts.front().rates;
        track.parts.push_back({times[i],
                               times[i + 1],
                               {rates.turn_rate * slower, rates.turn_acceleration * slower * slower,
                                rates.speed * slower, rates.acceleration * slower * slower}});
        track.size = std::max(track.size, motions[i].size);
    }
    track.at = [times, motions](const Wide& time) {
        std::size_t i = 0;
        while (i + 1 < motions.size() && time >= times[i + 1])
            ++i;
        const Wide from = times[i];
        return motions[i].at(Wide((time - from) / (times[i + 1] - from)));
    };
    return track;
}

} // namespace chasles::attack
