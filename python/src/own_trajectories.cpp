// chasles.Trajectory: a motion by two Python functions.
#include "chasles/base/invalid_input.h"
#include "chasles/motion/own_trajectory.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/motions.h"
#include "python/src/recipe.h"
#include "python/src/without_gil.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// Both functions while their Python object lives. Copies of motions in C++ have this link only: queries copy and
/// destroy motions without the GIL, and the collector does not see what C++ keeps.
struct Link {
    nb::handle pose_at, bounds;
};

/// The Python object that owns the functions of a trajectory.
class Functions {
public:
    Functions(nb::handle pose_at, nb::handle bounds)
        : pose_at_(nb::borrow(pose_at)), bounds_(nb::borrow(bounds)),
          link_(std::make_shared<Link>(Link{pose_at, bounds})) {}
    ~Functions() { *link_ = {}; }
    Functions(const Functions&) = delete;
    Functions& operator=(const Functions&) = delete;

    [[nodiscard]] std::shared_ptr<const Link> link() const { return link_; }

    template <typename Visit>
    friend void for_each_reference(Functions& functions, const Visit& visit) {
        visit(functions.pose_at_);
        visit(functions.bounds_);
        if (!functions.pose_at_.is_valid()) // the collector has cleared it
            *functions.link_ = {};
    }

private:
    nb::object pose_at_, bounds_;
    std::shared_ptr<Link> link_;
};

/// The function, kept alive while it is called. With the GIL only.
nb::object function_of(nb::handle linked) {
    if (!linked.is_valid())
        throw InvalidInput("trajectory: its functions are gone: Python has freed all objects with this motion");
    return nb::borrow(linked);
}

double bound_from(const nb::dict& bounds, const char* name, std::optional<double> unknown) {
    if (!bounds.contains(name)) {
        if (unknown)
            return *unknown;
        throw InvalidInput(fmt::format("trajectory: bounds: {} is missing", name));
    }
    double bound = 0;
    if (!nb::try_cast(bounds[name], bound))
        throw InvalidInput(fmt::format("trajectory: bounds: {} must be a number", name));
    return bound;
}

MotionBounds bounds_from(nb::handle result) {
    nb::dict bounds;
    if (!nb::try_cast(result, bounds))
        throw InvalidInput("trajectory: bounds: must return a dict");
    for (const auto& [name, bound] : bounds) {
        const std::string text = nb::cast<std::string>(nb::str(name));
        if (text != "turn_rate" && text != "turn_acceleration" && text != "speed" && text != "acceleration")
            throw InvalidInput(fmt::format("trajectory: bounds: there is no bound with the name {}", text));
    }
    constexpr double unknown = std::numeric_limits<double>::infinity();
    return {bound_from(bounds, "turn_rate", {}), bound_from(bounds, "turn_acceleration", unknown),
            bound_from(bounds, "speed", {}), bound_from(bounds, "acceleration", unknown)};
}

void require_function(nb::handle argument, const char* name, const char* form) {
    if (!PyCallable_Check(argument.ptr()))
        throw InvalidInput(fmt::format("trajectory: {}: {} is no function; one is needed, as in {}", name,
                                       text_of_argument(argument), form));
}

OwnTrajectory trajectory_from(const std::shared_ptr<const Link>& link, nb::handle reference, std::vector<double> knots,
                              double rounding) {
    OwnTrajectory own;
    own.pose_at = [link](double time) {
        const CallOfPython call;
        return pose_from(function_of(link->pose_at)(time), "trajectory: pose_at");
    };
    own.bounds = [link](double from, double to) {
        const CallOfPython call;
        return bounds_from(function_of(link->bounds)(from, to));
    };
    if (!reference.is_none())
        own.reference = vector_from(reference, "reference");
    own.knots = std::move(knots);
    own.rounding = rounding;
    return own;
}

OwnMotion own_motion(const nb::object& functions, nb::handle reference, std::vector<double> knots, double rounding) {
    const OwnTrajectory own =
        trajectory_from(nb::inst_ptr<Functions>(functions)->link(), reference, std::move(knots), rounding);
    return {{Motion::along(own), {functions}}, own};
}

nb::object functions_of(nb::handle pose_at, nb::handle bounds) {
    require_function(pose_at, "pose_at", "lambda time: [time, 0, 0, 1, 0, 0, 0]");
    require_function(bounds, "bounds", "lambda start, end: {\"turn_rate\": 0, \"speed\": 1}");
    return nb::cast(new Functions(pose_at, bounds), nb::rv_policy::take_ownership);
}

/// Pickle refuses functions that it cannot find by their names, by a message of its own.
nb::tuple state_of_trajectory(const OwnMotion& motion) {
    const nb::object& functions = motion.owners.front();
    const auto link = functions.is_valid() ? nb::inst_ptr<Functions>(functions)->link() : std::make_shared<Link>();
    const OwnTrajectory& own = motion.trajectory;
    return nb::make_tuple(function_of(link->pose_at), function_of(link->bounds), array_of(own.reference), own.knots,
                          own.rounding);
}

void set_trajectory_state(OwnMotion& motion, const nb::tuple& state) {
    std::vector<double> knots;
    double rounding = 0;
    if (state.size() != 5 || !nb::try_cast(state[3], knots) || !nb::try_cast(state[4], rounding))
        throw InvalidInput("state: is not that of a trajectory");
    new (&motion) OwnMotion(own_motion(functions_of(state[0], state[1]), state[2], std::move(knots), rounding));
}

nb::object broken_bound(const OwnMotion& own, int intervals, std::uint64_t seed) {
    const auto broken = [&] {
        const WithoutGil without_gil; // the functions take it for each call
        return find_broken_bound(own.trajectory, intervals, seed);
    }();
    if (!broken)
        return nb::none();
    nb::dict result;
    result["bound"] = broken->bound;
    result["from"] = broken->from;
    result["to"] = broken->to;
    result["at"] = broken->at;
    result["stated"] = broken->stated;
    result["found"] = broken->found;
    return result;
}

constexpr const char* trajectory_text =
    "A motion over time in [0, 1] by two functions of your own. The proof of a query holds if the bounds hold.\n\n"
    "Parameters\n----------\n"
    "pose_at : function of a time\n"
    "    The pose (4, 4) or (7,) of the moving body in the frame of the fixed body.\n"
    "bounds : function of two times, from and to\n"
    "    A dict with bounds that hold between both times, per unit of the time in [0, 1]: turn_rate and\n"
    "    turn_acceleration in radians, speed and acceleration of the reference point. The accelerations may be left\n"
    "    out; a query then takes far more steps, and no contact is certain.\n"
    "reference : (3,), default the origin\n"
    "    The point of the moving body, in its frame, whose speed and acceleration are bounded.\n"
    "knots : times in (0, 1) at which velocities jump\n"
    "rounding : float\n"
    "    A bound of the error of poses by rounding: of unit quaternions, and of translations over their size.\n\n"
    "Each pose and each bound is a call of Python, so a query may take long. `TimedPoses.through` many poses of the "
    "same\n"
    "motion takes a third of the time (median), and a hundredth of it where no accelerations are stated. Between two\n"
    "poses it strays from the motion by at most (a + (alpha + 2 omega^2) r) h^2 / 8, with the acceleration a of the\n"
    "reference, the turn acceleration alpha and the turn rate omega, the greatest distance r of a point of the body "
    "from\n"
    "the reference, and the step h of the time. Add this length to the margin: then a clear answer is proven for the\n"
    "motion itself. See docs/python.md.\n";

} // namespace

OwnMotion own_motion(const Recipe& recipe, const Owners& owners) {
    const auto found = std::ranges::find_if(owners, [&](const nb::object& o) { return o.is(recipe.functions); });
    if (found == owners.end())
        throw InvalidInput("trajectory: its functions are gone");
    const Numbers& numbers = recipe.numbers;
    return own_motion(*found, nb::cast(numbers[0]), numbers[1], numbers[2].front());
}

void bind_own_trajectories(nb::module_& module) {
    nb::class_<Functions>(module, "_Functions", collected<Functions>());
    nb::class_<OwnMotion>(module, "Trajectory", trajectory_text, collected<OwnMotion>())
        .def(
            "__init__",
            [](OwnMotion* self, nb::handle pose_at, nb::handle bounds, nb::handle reference, std::vector<double> knots,
               double rounding) {
                new (self) OwnMotion(own_motion(functions_of(pose_at, bounds), reference, std::move(knots), rounding));
            },
            "pose_at"_a.none(), "bounds"_a.none(), nb::kw_only(), "reference"_a = nb::none(),
            "knots"_a = std::vector<double>(), "rounding"_a = OwnTrajectory().rounding,
            nb::sig("def __init__(self, pose_at: collections.abc.Callable[[float], numpy.typing.ArrayLike], "
                    "bounds: collections.abc.Callable[[float, float], dict[str, float]], *, "
                    "reference: numpy.typing.ArrayLike | None = None, "
                    "knots: collections.abc.Sequence[float] = (), rounding: float = 2**-47) -> None"))
        .def(
            "find_broken_bound", broken_bound, "intervals"_a = 2000, "seed"_a = 1,
            nb::sig(
                "def find_broken_bound(self, intervals: int = 2000, seed: int = 1) -> dict[str, typing.Any] | None"),
            "Samples the poses at random times and compares them with the bounds. Returns the first bound that it "
            "finds broken: its name, the interval, the time, what is stated and what the poses show. None is no proof.")
        .def(
            "pose_at", [](const OwnMotion& m, double time) { return matrix_of(m.motion.pose_at(time)); }, "time"_a,
            nb::sig("def pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the moving body at a time in [0, 1].")
        .def(
            "fixed_pose_at", [](const OwnMotion& m, double time) { return matrix_of(m.motion.fixed_pose_at(time)); },
            "time"_a, nb::sig("def fixed_pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the fixed body, which stands still.")
        .def(
            "reversed", [](const OwnMotion& m) { return made("reversed", {}, {as_plain(m)}); },
            nb::sig("def reversed(self) -> Motion"), doc("Motion.reversed"))
        .def(
            "__mul__",
            [](const OwnMotion& m, nb::handle inner) {
                return made("product", {}, {as_plain(m), as_plain(given_motion(inner))});
            },
            "inner"_a.none(), nb::sig("def __mul__(self, inner: typing.Any) -> Motion"),
            "The motion `inner`, carried by this one.")
        .def("__getstate__", state_of_trajectory)
        .def("__setstate__", set_trajectory_state)
        .def("__repr__", [](const OwnMotion&) { return "<chasles.Trajectory>"; });
}

} // namespace chasles::python
