// chasles.JointPath.
#include "chasles/base/invalid_input.h"
#include "python/src/docstrings.h"
#include "python/src/no_constructor.h"
#include "python/src/robot.h"

#include <cmath>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// Array of shape (n,), as numbers.
std::vector<double> numbers_from(nb::handle argument, const std::string& name) {
    const Configuration numbers = configuration_from(argument, name);
    return {numbers.begin(), numbers.end()};
}

JointPath straight(const PythonRobot& robot, nb::handle configurations, nb::handle times) {
    return path_from(robot, {configurations, times, nb::none(), nb::none()});
}
JointPath cubic(const PythonRobot& robot, nb::handle times, nb::handle positions, nb::handle velocities) {
    return path_from(robot, {positions, times, velocities, nb::none()});
}
JointPath quintic(const PythonRobot& robot, nb::handle times, nb::handle positions, nb::handle velocities,
                  nb::handle accelerations) {
    return path_from(robot, {positions, times, velocities, accelerations});
}
JointPath natural_spline(const PythonRobot& robot, nb::handle times, nb::handle positions) {
    return JointPath::natural_spline(robot, numbers_from(times, "times"), rows_of(positions, "positions"));
}

/// `value` times the k-th power of `scale`, and what rounding took from it.
std::pair<double, double> scaled(double value, double scale, Eigen::Index k) {
    double rest = 0;
    for (; k > 0; --k) {
        const double product = value * scale;
        rest = std::fma(value, scale, -product) + rest * scale;
        value = product;
    }
    return {value, rest};
}

/// The laid-out coefficients of scipy.interpolate.PPoly: `coefficients` has the shape (powers, segments, variables),
/// the highest power comes first, and times count from the begin of the segment.
JointPath polynomials(const PythonRobot& robot, nb::handle breaks, nb::handle coefficients) {
    const std::vector<double> times = numbers_from(breaks, "breaks");
    const DoubleArray array(coefficients, "coefficients");
    const auto& shape = array.shape();
    if (shape.size() != 3 || shape[0] < 1 || shape[1] < 1)
        throw InvalidInput("coefficients: must have the shape (powers, segments, variables), and has " +
                           array.shape_text());
    if (times.size() != std::size_t(shape[1]) + 1)
        throw InvalidInput(fmt::format("breaks: there must be {} for {} segments, and there are {}", shape[1] + 1,
                                       shape[1], times.size()));
    const auto powers = Eigen::Index(shape[0]), variables = Eigen::Index(shape[2]);
    std::vector<JointPath::Segment> segments;
    for (std::size_t s = 0; s + 1 < times.size(); ++s) {
        JointPath::Segment segment{times[s], times[s + 1], Eigen::MatrixXd(powers, variables),
                                   Eigen::MatrixXd(powers, variables)};
        for (Eigen::Index k = 0; k < powers; ++k)
            for (Eigen::Index i = 0; i < variables; ++i) {
                const auto row = std::size_t((powers - 1 - k) * Eigen::Index(shape[1])) + s;
                const double value = array.numbers()[row * std::size_t(variables) + std::size_t(i)];
                std::tie(segment.coefficients(k, i), segment.remainders(k, i)) =
                    scaled(value, times[s + 1] - times[s], k);
            }
        segments.push_back(std::move(segment));
    }
    return JointPath::polynomials(robot, std::move(segments));
}

nb::object stamps_of(const JointPath& path) {
    std::vector<double> stamps{path.segments().front().begin};
    for (const JointPath::Segment& segment : path.segments())
        stamps.push_back(segment.end);
    return array_of(std::span(stamps), {stamps.size()});
}

// --- Pickle: the polynomials, to the last bit ---

nb::object numbers_of(const Eigen::MatrixXd& matrix) {
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
    return array_of(std::span(rows.data(), std::size_t(rows.size())),
                    {std::size_t(rows.rows()), std::size_t(rows.cols())});
}

nb::tuple state_of(const JointPath& path) {
    nb::list segments;
    for (const JointPath::Segment& s : path.segments())
        segments.append(nb::make_tuple(s.begin, s.end, numbers_of(s.coefficients), numbers_of(s.remainders)));
    nb::list variables;
    if (path.variables())
        for (const RobotVariable& variable : *path.variables())
            variables.append(nb::make_tuple(variable.name, variable.is_continuous));
    return nb::make_tuple(nb::tuple(segments), path.quaternions(), nb::tuple(variables), int(path.knots()));
}

[[noreturn]] void refuse_state(const char* why) {
    throw InvalidInput(std::string("state: is not that of a path: ") + why);
}

/// What the library may assume of a segment.
void check(const JointPath::Segment& segment, Eigen::Index variables) {
    const Eigen::MatrixXd &c = segment.coefficients, &r = segment.remainders;
    const bool is_like_coefficients = r.size() == 0 || (r.rows() == c.rows() && r.cols() == c.cols());
    if (c.rows() == 0 || c.cols() != variables || !is_like_coefficients)
        refuse_state("a segment has another shape");
    if (!c.allFinite() || !r.allFinite() || !std::isfinite(segment.end - segment.begin) ||
        !(segment.begin < segment.end))
        refuse_state("a number cannot be used");
}

/// Null if none is named.
JointPath::Variables variables_from(const nb::tuple& state) {
    std::vector<RobotVariable> variables;
    for (const nb::handle item : state) {
        nb::tuple variable;
        RobotVariable& last = variables.emplace_back(RobotVariable{{}, 0, 0, false}); // a path needs no limits
        if (!nb::try_cast(item, variable) || variable.size() != 2 || !nb::try_cast(variable[0], last.name) ||
            !nb::try_cast(variable[1], last.is_continuous))
            refuse_state("a variable has a name, and is continuous or not");
    }
    return variables.empty() ? nullptr : std::make_shared<const std::vector<RobotVariable>>(std::move(variables));
}

JointPath::Segment segment_from(const nb::tuple& state) {
    JointPath::Segment segment;
    if (state.size() != 4 || !nb::try_cast(state[0], segment.begin) || !nb::try_cast(state[1], segment.end))
        refuse_state("a segment has a begin, an end and two arrays");
    segment.coefficients = configurations_from(state[2], "coefficients");
    segment.remainders = configurations_from(state[3], "remainders");
    return segment;
}

void set_state(JointPath& path, const nb::tuple& state) {
    nb::tuple list, names;
    std::vector<std::size_t> quaternions;
    int knots = 0;
    constexpr int last_kind = int(JointPath::Knots::natural_spline);
    const bool is_older = state.size() == 3; // before paths knew their knots
    if ((!is_older && state.size() != 4) || !nb::try_cast(state[0], list) || !nb::try_cast(state[1], quaternions) ||
        !nb::try_cast(state[2], names) || (!is_older && !nb::try_cast(state[3], knots)) || list.size() == 0)
        refuse_state("it has segments, floating joints, variables and a kind of knots");
    if (knots < 0 || knots > last_kind)
        refuse_state("there is no such kind of knots");
    std::vector<JointPath::Segment> segments;
    for (const nb::handle item : list) {
        nb::tuple segment;
        if (!nb::try_cast(item, segment))
            refuse_state("a segment is a tuple");
        segments.push_back(segment_from(segment));
        check(segments.back(), segments.front().coefficients.cols());
    }
    const auto variables = std::size_t(segments.front().coefficients.cols());
    for (const std::size_t first : quaternions)
        if (first >= variables || variables - first < 4)
            refuse_state("a floating joint has four variables");
    JointPath::Variables of_robot = variables_from(names);
    if (of_robot && of_robot->size() != variables)
        refuse_state("there are other variables than numbers of a configuration");
    new (&path) JointPath(
        JointPath::of_parts(std::move(segments), std::move(quaternions), std::move(of_robot), JointPath::Knots(knots)));
}

nb::object at(const JointPath& path, double time) {
    if (!std::isfinite(time))
        throw InvalidInput("time: must be a finite number");
    return array_of(path.at(time));
}

} // namespace

#define CHASLES_TIMES "times: numpy.typing.ArrayLike"

void bind_joint_path(nb::module_& module) {
    nb::class_<JointPath> type(
        module, "JointPath",
        "A path of a robot in joint space: segments of time, in each of which every variable is a polynomial.\nTimes "
        "ascend, in any unit.");
    refuse_constructor(type, "JointPath.straight(robot, configurations) makes one, as cubic, quintic, natural_spline, "
                             "polynomials and together do");
    type.def_static("straight", straight, "robot"_a, "configurations"_a.none(), "times"_a = nb::none(),
                    nb::sig("def straight(robot: Robot, configurations: numpy.typing.ArrayLike, "
                            "times: numpy.typing.ArrayLike | None = None) -> JointPath"),
                    "Straight from each configuration (n, variables) to the next; continuous joints go the shorter "
                    "way. Without times,\nsegment k has the times k and k + 1.")
        .def_static(
            "cubic", cubic, "robot"_a, "times"_a, "positions"_a, "velocities"_a,
            nb::sig("def cubic(robot: Robot, " CHASLES_TIMES ", positions: numpy.typing.ArrayLike, "
                    "velocities: numpy.typing.ArrayLike) -> JointPath"),
            "Cubic Hermite splines; velocities are per unit of time. Values are taken as they are, also those of "
            "continuous joints.")
        .def_static("quintic", quintic, "robot"_a, "times"_a, "positions"_a, "velocities"_a, "accelerations"_a,
                    nb::sig("def quintic(robot: Robot, " CHASLES_TIMES ", positions: numpy.typing.ArrayLike, "
                            "velocities: numpy.typing.ArrayLike, accelerations: numpy.typing.ArrayLike) -> JointPath"),
                    "Quintic Hermite splines.")
        .def_static("natural_spline", natural_spline, "robot"_a, "times"_a, "positions"_a,
                    nb::sig("def natural_spline(robot: Robot, " CHASLES_TIMES ", positions: numpy.typing.ArrayLike) "
                            "-> JointPath"),
                    doc("JointPath.natural_spline"))
        .def_static("polynomials", polynomials, "robot"_a, "breaks"_a, "coefficients"_a,
                    nb::sig("def polynomials(robot: Robot, breaks: numpy.typing.ArrayLike, "
                            "coefficients: numpy.typing.ArrayLike) -> JointPath"),
                    "Any polynomials, laid out as in scipy.interpolate.PPoly (x and c).\n\nParameters\n----------\n"
                    "robot : Robot\nbreaks : array (segments + 1,)\n    Times, ascending.\ncoefficients : array "
                    "(powers, segments, variables)\n    The highest power first; of the time since the begin of the "
                    "segment.\n\nRaises\n------\nInvalidInput\n    For floating joints, wrong shapes, and a segment "
                    "that does not begin where the one before ends (1e-9 of the sizes).")
        .def_static("together", paths_together, "cell"_a, "paths"_a.none(),
                    nb::sig("def together(cell: Robot, paths: collections.abc.Mapping[str, JointPath | "
                            "numpy.typing.ArrayLike]) -> JointPath"),
                    doc("JointPath.together"))
        .def_prop_ro("times", stamps_of, nb::sig("def times(self) -> " CHASLES_ARRAY), "Of the ends of all segments.")
        .def("at", at, "time"_a, nb::sig("def at(self, time: float) -> " CHASLES_ARRAY),
             "The configuration at a time; outside of the path, at its nearer end.")
        .def("__getstate__", state_of)
        .def("__setstate__", set_state)
        .def("__repr__", [](const JointPath& path) {
            return fmt::format("<chasles.JointPath: {} segments, {} variables>", path.segments().size(),
                               path.segments().front().coefficients.cols());
        });
}

} // namespace chasles::python
