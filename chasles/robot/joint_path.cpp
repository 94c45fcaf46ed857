// Makes the polynomials of paths. Coefficients are kept in double-double, so that segments meet.
// Source: docs/derivations/29-robots.md, "Paths".
#include "chasles/robot/joint_path.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/invalid_input.h"
#include "chasles/motion/turn_about.h"
#include "chasles/robot/knot_weights.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace chasles {

namespace {

using Wide = algebra::DoubleDouble;
using Segment = JointPath::Segment;

/// Sines and cosines of larger angles have larger errors than those of frames allow for.
constexpr double largest_value = 1000;

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
    throw InvalidInput("path: " + what + ": " + why);
}

std::string numbered(const char* what, std::size_t i) {
    return std::string(what) + ' ' + std::to_string(i);
}

bool is_angle(const robot::Model& model, const std::string& variable) {
    const auto joint = std::ranges::find(model.description.joints, variable, &JointDescription::name);
    if (joint == model.description.joints.end())
        return variable.ends_with("/theta");
    return joint->type == JointType::revolute || joint->type == JointType::continuous;
}

/// How the values of a variable become smaller.
std::string way_to_smaller_values(const robot::Model& model, std::size_t variable) {
    const std::string& name = model.variables[variable].name;
    if (std::ranges::any_of(model.quaternions, [&](std::size_t q) { return q <= variable && variable < q + 4; }))
        return "give the quaternion the length 1";
    if (!is_angle(model, name))
        return "choose a larger unit of length";
    const std::string way = "take whole turns off all its values";
    const bool repeats = std::ranges::all_of(
        model.groups, [&](const robot::RigidGroup& group) { return group.repeats_after_a_turn(variable); });
    return repeats ? way : way + ", and add each turn times the multiplier to the offset of a joint that follows it";
}

void check_numbers(const robot::Model& model, const Configuration& values, const std::string& what) {
    const auto count = Eigen::Index(model.variables.size());
    if (values.size() != count)
        refuse(what, "has " + std::to_string(values.size()) + " values, and the robot has " + std::to_string(count) +
                         " variables");
    for (Eigen::Index i = 0; i < count; ++i)
        if (!std::isfinite(values[i]))
            refuse(what, model.variables[std::size_t(i)].name + " is not a finite number");
}

} // namespace

std::string robot::why_too_large(const Model& model, std::size_t variable, double value) {
    if (std::abs(value) <= largest_value)
        return {};
    const bool turns = chasles::is_angle(model, model.variables[variable].name);
    return std::string(" is beyond 1000") + (turns ? " radians (57295.8 degrees)" : "") +
           ", the largest value: " + way_to_smaller_values(model, variable);
}

namespace {

void check_configuration(const robot::Model& model, const Configuration& values, const std::string& what) {
    check_numbers(model, values, what);
    for (Eigen::Index i = 0; i < values.size(); ++i)
        if (const std::string why = robot::why_too_large(model, std::size_t(i), values[i]); !why.empty())
            refuse(what, model.variables[std::size_t(i)].name + why);
    for (const std::size_t first : model.quaternions)
        if (!(values.segment<4>(Eigen::Index(first)).norm() > 1e-6))
            refuse(what, model.variables[first].name + ": the quaternion is zero");
}

void check_configurations(const robot::Model& model, std::span<const Configuration> values) {
    if (values.size() < 2)
        refuse("configurations", "there must be at least two, and there are " + std::to_string(values.size()) +
                                     (values.empty() ? "" : "; repeat it to ask about this one at rest"));
    for (std::size_t i = 0; i < values.size(); ++i)
        check_configuration(model, values[i], numbered("configuration", i));
}

void check_times(std::span<const double> times, std::size_t count) {
    if (times.size() != count)
        refuse("times",
               "there are " + std::to_string(times.size()) + " for " + std::to_string(count) + " configurations");
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(times[i] - times[0]) || (i > 0 && !(times[i] > times[i - 1])))
            refuse(numbered("time", i), "must be finite and later than the one before");
}

void check_no_quaternion(const robot::Model& model) {
    if (!model.quaternions.empty())
        refuse(model.variables[model.quaternions.front()].name, "floating joints take straight paths only");
}

/// The segment with these coefficients; values[k](i) is that of power k and variable i.
Segment segment_of(double begin, double end, const std::vector<std::vector<Wide>>& values) {
    const auto rows = Eigen::Index(values.size()), columns = Eigen::Index(values.front().size());
    Segment segment{begin, end, Eigen::MatrixXd(rows, columns), Eigen::MatrixXd(rows, columns)};
    for (Eigen::Index k = 0; k < rows; ++k)
        for (Eigen::Index i = 0; i < columns; ++i) {
            const Wide& value = values[std::size_t(k)][std::size_t(i)];
            segment.coefficients(k, i) = double(value);
            segment.remainders(k, i) = double(value - Wide(double(value)));
        }
    return segment;
}

/// From one value to the next: of continuous joints the shorter way round.
Wide way_between(const RobotVariable& variable, double from, double to) {
    const Wide way = Wide(to) - Wide(from);
    if (!variable.is_continuous)
        return way;
    static const Wide turn = Wide(2 * std::numbers::pi) + Wide(2.4492935982947064e-16); // 2 pi in double-double
    return way - Wide(std::nearbyint(double(way) / (2 * std::numbers::pi))) * turn;
}

Segment straight_segment(const robot::Model& model, double begin, double end, const Configuration& from,
                         const Configuration& to) {
    const std::size_t count = model.variables.size();
    std::vector<std::vector<Wide>> values(2, std::vector<Wide>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = Eigen::Index(i);
        values[0][i] = Wide(from[k]);
        values[1][i] = way_between(model.variables[i], from[k], to[k]);
    }
    return segment_of(begin, end, values);
}

/// The polynomial over [0, 1] with these values and scaled rates at both ends: of degree 2 n - 1 for n of each.
std::vector<Wide> hermite(std::span<const Wide> start, std::span<const Wide> goal) {
    const Wide &p = start[0], &v = start[1], d = goal[0] - p;
    const Wide& w = goal[1];
    if (start.size() == 2)
        return {p, v, Wide(3.0) * d - Wide(2.0) * v - w, v + w - Wide(2.0) * d};
    const Wide a = start[2], b = goal[2], half(0.5);
    return {p,
            v,
            half * a,
            Wide(10.0) * d - Wide(6.0) * v - Wide(4.0) * w - Wide(1.5) * a + half * b,
            Wide(8.0) * v + Wide(7.0) * w + Wide(1.5) * a - b - Wide(15.0) * d,
            Wide(6.0) * d - Wide(3.0) * (v + w) - half * a + half * b};
}

void check_segment(const robot::Model& model, const Segment& segment, const std::string& what) {
    const auto count = Eigen::Index(model.variables.size());
    const Eigen::MatrixXd &c = segment.coefficients, &r = segment.remainders;
    if (c.rows() == 0 || c.cols() != count)
        refuse(what, "coefficients must have a row for each power and a column for each variable");
    if (r.size() > 0 && (r.rows() != c.rows() || r.cols() != c.cols()))
        refuse(what, "remainders must have the shape of the coefficients");
    if (!c.allFinite() || !r.allFinite())
        refuse(what, "a coefficient is not a finite number");
    Eigen::Index largest = 0;
    if (count > 0 && c.cwiseAbs().colwise().sum().maxCoeff(&largest) > largest_value)
        refuse(what, "the coefficients of " + model.variables[std::size_t(largest)].name +
                         " sum up to more than 1000, the largest value: divide the segment, or " +
                         way_to_smaller_values(model, std::size_t(largest)));
    if (!std::isfinite(segment.end - segment.begin) || !(segment.begin < segment.end))
        refuse(what, "must end later than it begins");
}

/// Positions, and their rates of the first order, and of the second.
using Rates = std::span<const std::span<const Configuration>>;

void check_rates(const robot::Model& model, std::span<const double> times, const Rates& rates) {
    constexpr std::array names{"position", "velocity", "acceleration"};
    check_no_quaternion(model);
    check_configurations(model, rates[0]);
    check_times(times, rates[0].size());
    for (std::size_t order = 1; order < rates.size(); ++order) {
        if (rates[order].size() != times.size())
            refuse(names[order], "there are " + std::to_string(rates[order].size()) + " for " +
                                     std::to_string(times.size()) + " times");
        for (std::size_t i = 0; i < times.size(); ++i)
            check_numbers(model, rates[order][i], numbered(names[order], i));
    }
}

/// Of joint `i` from knot `s` to the next one, over [0, 1].
std::vector<Wide> hermite_polynomial(const Rates& rates, std::size_t s, std::size_t i, const Wide& duration) {
    std::vector<Wide> start, goal;
    Wide factor(1.0);
    for (const std::span<const Configuration>& rate : rates) {
        start.push_back(Wide(rate[s][Eigen::Index(i)]) * factor);
        goal.push_back(Wide(rate[s + 1][Eigen::Index(i)]) * factor);
        factor = factor * duration;
    }
    return hermite(start, goal);
}

/// From knot `s` to the next one.
Segment hermite_segment(std::span<const double> times, const Rates& rates, std::size_t s) {
    const Wide duration = Wide(times[s + 1]) - Wide(times[s]);
    const auto count = std::size_t(rates[0][0].size());
    std::vector<std::vector<Wide>> values(2 * rates.size(), std::vector<Wide>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<Wide> polynomial = hermite_polynomial(rates, s, i, duration);
        for (std::size_t k = 0; k < polynomial.size(); ++k)
            values[k][i] = polynomial[k];
    }
    return segment_of(times[s], times[s + 1], values);
}

std::vector<Segment> hermite_segments(const robot::Model& model, std::span<const double> times, const Rates& rates) {
    check_rates(model, times, rates);
    std::vector<Segment> segments;
    for (std::size_t s = 0; s + 1 < times.size(); ++s)
        check_segment(model, segments.emplace_back(hermite_segment(times, rates, s)), numbered("segment", s));
    return segments;
}

Configuration value_at(const Segment& segment, double time) {
    Configuration value = Configuration::Zero(segment.coefficients.cols());
    for (Eigen::Index k = segment.coefficients.rows(); k-- > 0 && value.size() > 0;) // a robot may have no joints
        value = value * time + segment.coefficients.row(k).transpose();
    return value;
}

/// The quaternion of a floating joint at a time of a straight segment.
void turn_evenly(const Segment& segment, std::size_t first, double time, Configuration& value) {
    const auto quaternion = [&](double t) {
        const Eigen::Vector4d q = value_at(segment, t).segment<4>(Eigen::Index(first));
        return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
    };
    Eigen::Quaterniond turn = quaternion(0).conjugate() * quaternion(1);
    if (turn.w() < 0) // the shorter way round
        turn.coeffs() *= -1;
    const double sine = turn.vec().norm();
    const double angle = sine > 0 ? 2 * algebra::arc_tangent(sine, turn.w()) : 0;
    const Eigen::Vector3d direction = sine > 0 ? Eigen::Vector3d(turn.vec() / sine) : Eigen::Vector3d::UnitZ();
    const Eigen::Quaterniond q = quaternion(0) * turn_about(direction, time * angle);
    value.segment<4>(Eigen::Index(first)) << q.x(), q.y(), q.z(), q.w();
}

} // namespace

JointPath JointPath::straight(const Robot& robot, std::span<const Configuration> configurations) {
    std::vector<double> times(configurations.size());
    std::iota(times.begin(), times.end(), 0.0);
    return straight(robot, configurations, times);
}

JointPath JointPath::straight(const Robot& robot, std::span<const Configuration> configurations,
                              std::span<const double> times) {
    const robot::Model& model = robot.model();
    check_configurations(model, configurations);
    check_times(times, configurations.size());
    std::vector<Segment> segments;
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        segments.push_back(straight_segment(model, times[i], times[i + 1], configurations[i], configurations[i + 1]));
    return {std::move(segments), model.quaternions, model.variables_of_paths, Knots::straight};
}

JointPath JointPath::cubic(const Robot& robot, std::span<const double> times, std::span<const Configuration> positions,
                           std::span<const Configuration> velocities) {
    return {hermite_segments(robot.model(), times, std::array{positions, velocities}),
            {},
            robot.model().variables_of_paths,
            Knots::cubic};
}

JointPath JointPath::quintic(const Robot& robot, std::span<const double> times,
                             std::span<const Configuration> positions, std::span<const Configuration> velocities,
                             std::span<const Configuration> accelerations) {
    return {hermite_segments(robot.model(), times, std::array{positions, velocities, accelerations}),
            {},
            robot.model().variables_of_paths,
            Knots::quintic};
}

JointPath JointPath::natural_spline(const Robot& robot, std::span<const double> times,
                                    std::span<const Configuration> positions) {
    check_configurations(robot.model(), positions);
    check_times(times, positions.size());
    JointPath path = cubic(robot, times, positions, robot::natural_velocities(times, positions));
    path.knots_ = Knots::natural_spline;
    return path;
}

namespace {

/// Whether a segment begins where the one before ends, up to rounding of the values or of the terms that they are the
/// sum of.
bool continues(const JointPath::Segment& before, const JointPath::Segment& segment) {
    const Configuration end = value_at(before, 1), begin = value_at(segment, 0);
    const Configuration terms = before.coefficients.cwiseAbs().colwise().sum();
    return segment.begin == before.end &&
           (begin.isApprox(end, 1e-9) || ((begin - end).cwiseAbs().array() <= 0x1p-48 * terms.array()).all());
}

} // namespace

JointPath JointPath::polynomials(const Robot& robot, std::vector<Segment> segments) {
    check_no_quaternion(robot.model());
    if (segments.empty())
        refuse("segments", "there is none");
    for (std::size_t s = 0; s < segments.size(); ++s) {
        check_segment(robot.model(), segments[s], numbered("segment", s));
        if (s > 0 && !continues(segments[s - 1], segments[s]))
            refuse(numbered("segment", s), "does not begin where the one before ends");
    }
    return {std::move(segments), {}, robot.model().variables_of_paths, Knots::none};
}

Configuration JointPath::at(double stamp) const {
    const auto after =
        std::ranges::upper_bound(segments_, stamp, {}, &Segment::begin); // the first one that begins later
    const Segment& segment = after == segments_.begin() ? *after : *(after - 1);
    const double time = std::clamp((stamp - segment.begin) / (segment.end - segment.begin), 0.0, 1.0);
    Configuration value = value_at(segment, time);
    for (const std::size_t first : quaternions_)
        turn_evenly(segment, first, time, value);
    return value;
}

} // namespace chasles
