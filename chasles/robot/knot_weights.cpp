#include "chasles/robot/knot_weights.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/splines.h"

#include <algorithm>

namespace chasles::robot {

namespace {

/// Hermite's polynomials at a time in [0, 1]: of the values at both ends, and of the rates.
struct Hermite {
    double value[2];
    double rate[2];
};

Hermite cubic_at(double t) {
    const double rest = 1 - t;
    return {{rest * rest * (1 + 2 * t), t * t * (3 - 2 * t)}, {t * rest * rest, -t * t * rest}};
}

/// Of the value at the goal.
double quintic_at(double t) {
    return t * t * t * (10 + t * (6 * t - 15));
}

/// A knot counts for knots far away by less than a half of what it counts for their neighbours: of 64 knots on either
/// side, the last ones count for less than rounding.
std::vector<KnotWeight> natural_weights(const JointPath& path, std::size_t segment, double time) {
    constexpr std::size_t reach = 64;
    const std::vector<JointPath::Segment>& segments = path.segments();
    const std::size_t first = segment - std::min(segment, reach), last = std::min(segment + reach, segments.size());
    std::vector<double> times{segments[first].begin};
    for (std::size_t s = first; s < last; ++s)
        times.push_back(segments[s].end);
    const std::size_t count = times.size(), here = segment - first;
    std::vector<Configuration> units; // one variable for each knot, which is 1 there
    for (std::size_t i = 0; i < count; ++i)
        units.emplace_back(Configuration::Unit(Eigen::Index(count), Eigen::Index(i)));
    const std::vector<Configuration> velocities = natural_velocities(times, units);
    const Hermite at = cubic_at(time);
    const double duration = times[here + 1] - times[here];
    const Configuration values = at.value[0] * units[here] + at.value[1] * units[here + 1] +
                                 duration * (at.rate[0] * velocities[here] + at.rate[1] * velocities[here + 1]);
    std::vector<KnotWeight> weights;
    for (std::size_t i = 0; i < count; ++i)
        weights.push_back({first + i, values[Eigen::Index(i)]});
    return weights;
}

std::pair<double, double> weights_of_ends(JointPath::Knots knots, double time) {
    if (knots == JointPath::Knots::straight)
        return {1 - time, time};
    if (knots == JointPath::Knots::cubic)
        return {cubic_at(time).value[0], cubic_at(time).value[1]};
    return {quintic_at(1 - time), quintic_at(time)};
}

} // namespace

std::vector<KnotWeight> knot_weights(const JointPath& path, std::size_t segment, double time) {
    if (path.knots() == JointPath::Knots::none)
        throw InvalidInput("gradient: a path of polynomials has no knots to change; paths through configurations have");
    if (path.knots() == JointPath::Knots::natural_spline)
        return natural_weights(path, segment, time);
    const auto [start, goal] = weights_of_ends(path.knots(), time);
    std::vector<KnotWeight> weights;
    if (start != 0)
        weights.push_back({segment, start});
    if (goal != 0)
        weights.push_back({segment + 1, goal});
    return weights;
}

/// The velocities at the knots of the natural cubic spline.
std::vector<Configuration> natural_velocities(std::span<const double> times, std::span<const Configuration> positions) {
    const std::vector<Configuration> points(positions.begin(), positions.end());
    const std::vector<Configuration> seconds = motion::natural_second_derivatives(times, points);
    std::vector<Configuration> velocities;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t k = std::min(i, points.size() - 2); // the segment, at whose end the last knot is
        const double h = times[k + 1] - times[k], side = k == i ? -1 : 1;
        velocities.emplace_back((points[k + 1] - points[k]) / h +
                                side * h / 6 * (2 * seconds[i] + seconds[k == i ? k + 1 : k]));
    }
    return velocities;
}

} // namespace chasles::robot
