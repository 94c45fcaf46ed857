// chasles.ScrewMotion and chasles.SweepMotion.
#include "python/src/motions.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/screw_trajectory.h"
#include "chasles/motion/sweep_trajectory.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/no_constructor.h"
#include "python/src/recipe.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

#define CHASLES_POSE "numpy.typing.ArrayLike"
#define CHASLES_RELATIVE                                                                                               \
    "def relative(moving_start: " CHASLES_POSE ", moving_goal: " CHASLES_POSE ", fixed_start: " CHASLES_POSE           \
    ", fixed_goal: " CHASLES_POSE
#define CHASLES_MAX_TURN ", max_turn: float = math.pi / 18"

constexpr const char* relative_text =
    "For two moving bodies: the motion of one body in the frame of the other, which is called fixed. "
    "All four poses are in the world, (4, 4) or (7,).";

void require_in_unit_interval(double number, const char* name) {
    if (!(number >= 0 && number <= 1))
        throw InvalidInput(fmt::format("{}: {} is not in [0, 1]", name, number));
}

template <typename M>
nb::object pose_at(const M& motion, double time) {
    require_in_unit_interval(time, "time");
    return matrix_of(motion.pose_at(time));
}

template <typename M>
M relative(nb::handle moving_start, nb::handle moving_goal, nb::handle fixed_start, nb::handle fixed_goal) {
    return M::relative(pose_from(moving_start, "moving_start"), pose_from(moving_goal, "moving_goal"),
                       pose_from(fixed_start, "fixed_start"), pose_from(fixed_goal, "fixed_goal"));
}

/// The part of a pickled motion that follows its poses: the largest turn of a screw, the centre of a sweep.
nb::object last_part(const ScrewMotion& motion) {
    return nb::float_(motion.max_turn());
}

nb::object last_part(const SweepMotion& motion) {
    return array_of(motion.trajectory().centre());
}

ScrewMotion with_last_part(const ScrewMotion& motion, nb::handle max_turn) {
    double turn = 0;
    if (!nb::try_cast(max_turn, turn))
        throw InvalidInput("max_turn: must be a number");
    return motion.with_max_turn(turn);
}

SweepMotion with_last_part(const SweepMotion& motion, nb::handle centre) {
    return motion.about(vector_from(centre, "centre"));
}

/// The poses that the motion was made from, and its last part, for pickle. With two moving bodies all poses are in the
/// world.
template <typename M>
nb::tuple state_of_ends(const M& motion) {
    const motion::MotionEnds& ends = motion.trajectory().ends();
    return nb::make_tuple(numbers_of(ends.start_is_in_world ? ends.start : ends.in_world(ends.start, 0)),
                          numbers_of(ends.goal_is_in_world ? ends.goal : ends.in_world(ends.goal, 1)),
                          ends.fixed ? numbers_of(ends.fixed->start) : nb::none(),
                          ends.fixed ? numbers_of(ends.fixed->goal) : nb::none(), last_part(motion));
}

nb::tuple state_of_motion(const SweepMotion& motion) {
    return state_of_ends(motion);
}

/// Of a piece: the whole screw, its index, and its own largest turn.
nb::tuple state_of_motion(const PythonScrew& motion) {
    if (motion.whole)
        return nb::make_tuple(nb::cast(*motion.whole), motion.index, motion.max_turn());
    return state_of_ends(motion);
}

template <typename M>
M made_from_ends(const nb::tuple& state) {
    if (state.size() != 5)
        throw InvalidInput(fmt::format("state: a motion has 5 parts, not {}", state.size()));
    const M motion = state[2].is_none() ? M::between(pose_from(state[0], "start"), pose_from(state[1], "goal"))
                                        : relative<M>(state[0], state[1], state[2], state[3]);
    return with_last_part(motion, state[4]);
}

void set_state(SweepMotion& motion, const nb::tuple& state) {
    new (&motion) SweepMotion(made_from_ends<SweepMotion>(state));
}

std::vector<PythonScrew> pieces_of(const PythonScrew& screw) {
    const bool is_seen_from_moving_body = bool(screw.trajectory().ends().fixed);
    const auto whole = is_seen_from_moving_body ? std::make_shared<const PythonScrew>(screw) : nullptr;
    std::vector<PythonScrew> pieces;
    for (ScrewMotion& piece : screw.pieces())
        pieces.push_back({std::move(piece), whole, pieces.size()});
    return pieces;
}

PythonScrew with_max_turn(const PythonScrew& screw, double max_turn) {
    return {screw.with_max_turn(max_turn), screw.whole, screw.index};
}

void set_state(PythonScrew& motion, const nb::tuple& state) {
    if (state.size() != 3) {
        new (&motion) PythonScrew{made_from_ends<ScrewMotion>(state)};
        return;
    }
    const PythonScrew* whole = nullptr;
    std::size_t index = 0;
    double max_turn = 0;
    if (!nb::try_cast(state[0], whole) || !whole || !nb::try_cast(state[1], index) || !nb::try_cast(state[2], max_turn))
        throw InvalidInput("state: is not that of a piece of a screw");
    const std::vector<PythonScrew> pieces = pieces_of(*whole);
    if (index >= pieces.size())
        throw InvalidInput("state: the screw has no such piece");
    new (&motion) PythonScrew(with_max_turn(pieces[index], max_turn));
}

double tau_at(const ScrewMotion& motion, double time) {
    return motion.tau_at(time);
}

double tau_at(const SweepMotion& /*motion*/, double time) {
    return time;
}

double time_at(const ScrewMotion& motion, double tau) {
    return motion.time_at(tau);
}

double time_at(const SweepMotion& /*motion*/, double tau) {
    return tau;
}

/// Binds the members that both kinds of motion have.
template <typename M>
void bind_common(nb::class_<M>& type, const char* pose_text) {
    type.def("pose_at", pose_at<M>, "time"_a, nb::sig("def pose_at(self, time: float) -> " CHASLES_ARRAY), pose_text)
        .def(
            "fixed_pose_at",
            [](const M& motion, double time) {
                require_in_unit_interval(time, "time");
                return matrix_of(motion.trajectory().fixed_pose_at(time));
            },
            "time"_a, nb::sig("def fixed_pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the fixed body in the world at a time in [0, 1].")
        .def(
            "tau_at",
            [](const M& motion, double time) {
                require_in_unit_interval(time, "time");
                return tau_at(motion, time);
            },
            "time"_a, doc("ScrewMotion.tau_at"))
        .def(
            "time_at",
            [](const M& motion, double tau) {
                require_in_unit_interval(tau, "tau");
                return time_at(motion, tau);
            },
            "tau"_a, "The time that belongs to a tau: the inverse of tau_at().")
        .def_prop_ro("angle", &M::angle, doc("ScrewMotion.angle"))
        .def("__getstate__", [](const M& motion) { return state_of_motion(motion); })
        .def("__setstate__", [](M& motion, const nb::tuple& state) { set_state(motion, state); });
}

std::string repr_of_screw(const ScrewMotion& motion) {
    return fmt::format("<chasles.ScrewMotion: turns {:.6g} rad about {} through {}, slides {:.6g}>", motion.angle(),
                       text_of(motion.axis_direction()), text_of(motion.axis_point()), motion.slide());
}

std::string repr_of_sweep(const SweepMotion& motion) {
    return fmt::format("<chasles.SweepMotion: turns {:.6g} rad, moves by {}>", motion.angle(),
                       text_of(motion.displacement()));
}

void bind_screw(nb::module_& module) {
    nb::class_<PythonScrew> type(module, "ScrewMotion", doc("ScrewMotion"));
    refuse_constructor(type, "ScrewMotion.between(start, goal) makes one, and ScrewMotion.relative that of two bodies");
    type.def_static(
            "between",
            [](nb::handle start, nb::handle goal, double max_turn) {
                return PythonScrew{ScrewMotion::between(pose_from(start, "start"), pose_from(goal, "goal"), max_turn)};
            },
            "start"_a.none(), "goal"_a.none(), "max_turn"_a = ScrewMotion::default_max_turn,
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE CHASLES_MAX_TURN ") -> ScrewMotion"),
            doc("ScrewMotion.between"))
        .def_static(
            "relative",
            [](nb::handle moving_start, nb::handle moving_goal, nb::handle fixed_start, nb::handle fixed_goal,
               double max_turn) {
                return PythonScrew{
                    relative<ScrewMotion>(moving_start, moving_goal, fixed_start, fixed_goal).with_max_turn(max_turn)};
            },
            "moving_start"_a.none(), "moving_goal"_a.none(), "fixed_start"_a.none(), "fixed_goal"_a.none(),
            "max_turn"_a = ScrewMotion::default_max_turn, nb::sig(CHASLES_RELATIVE CHASLES_MAX_TURN ") -> ScrewMotion"),
            relative_text)
        .def_prop_ro("slide", &ScrewMotion::slide, doc("ScrewMotion.slide"))
        .def_prop_ro(
            "axis_direction", [](const PythonScrew& m) { return array_of(m.axis_direction()); },
            nb::sig("def axis_direction(self) -> " CHASLES_ARRAY), doc("ScrewMotion.axis_direction"))
        .def_prop_ro(
            "axis_point", [](const PythonScrew& m) { return array_of(m.axis_point()); },
            nb::sig("def axis_point(self) -> " CHASLES_ARRAY), doc("ScrewMotion.axis_point"))
        .def_prop_ro("max_turn", &ScrewMotion::max_turn, doc("ScrewMotion.max_turn"))
        .def("with_max_turn", with_max_turn, "max_turn"_a, doc("ScrewMotion.with_max_turn"))
        .def("pieces", pieces_of, doc("ScrewMotion.pieces"))
        .def(
            "reversed", [](const PythonScrew& m) { return PlainMotion{Motion(m).reversed()}; },
            nb::sig("def reversed(self) -> Motion"), doc("Motion.reversed"))
        .def(
            "cut", [](const PythonScrew& m, double max_turn) { return pieces_of(with_max_turn(m, max_turn)); },
            "max_turn"_a, "The same as with_max_turn(max_turn).pieces().")
        .def("__repr__", [](const PythonScrew& m) { return repr_of_screw(m); });
    bind_common(type, "The pose (4, 4) of the moving body in the world at a time in [0, 1], along the uncut screw.\n\n"
                      "A query follows `pieces()` one after another: equal turns of at most `max_turn`, by default 10\n"
                      "degrees, with equal slides. So a screw that turns by more and slides is elsewhere between its\n"
                      "ends, and the pose of an answer is that of a piece.");
}

void bind_sweep(nb::module_& module) {
    nb::class_<SweepMotion> type(module, "SweepMotion", doc("SweepMotion"));
    refuse_constructor(type, "SweepMotion.between(start, goal) makes one, and SweepMotion.relative that of two bodies");
    type.def_static(
            "between",
            [](nb::handle start, nb::handle goal, nb::handle centre) {
                const Pose from = pose_from(start, "start"), to = pose_from(goal, "goal");
                return centre.is_none() ? SweepMotion::between(from, to)
                                        : SweepMotion::between(from, to, vector_from(centre, "centre"));
            },
            "start"_a.none(), "goal"_a.none(), "centre"_a = nb::none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ", centre: " CHASLES_POSE
                    " | None = None) -> SweepMotion"),
            doc("SweepMotion.between"))
        .def_static("relative", relative<SweepMotion>, "moving_start"_a.none(), "moving_goal"_a.none(),
                    "fixed_start"_a.none(), "fixed_goal"_a.none(), nb::sig(CHASLES_RELATIVE ") -> SweepMotion"),
                    relative_text)
        .def(
            "about", [](const SweepMotion& m, nb::handle centre) { return m.about(vector_from(centre, "centre")); },
            "centre"_a.none(), nb::sig("def about(self, centre: " CHASLES_POSE ") -> SweepMotion"),
            doc("SweepMotion.about"))
        .def("reversed", &SweepMotion::reversed, doc("SweepMotion.reversed"))
        .def_prop_ro(
            "displacement", [](const SweepMotion& m) { return array_of(m.displacement()); },
            nb::sig("def displacement(self) -> " CHASLES_ARRAY), doc("SweepMotion.displacement"))
        .def("__repr__", repr_of_sweep);
    bind_common(type, "The pose (4, 4) of the moving body in the world at a time in [0, 1].");
}

/// The first of these kinds that the object is.
template <typename... Kinds>
std::optional<TypedMotion> cast_to(nb::handle motion, const std::variant<Kinds...>* /*kinds*/) {
    std::optional<TypedMotion> found;
    const auto try_kind = [&]<typename M>(const M* typed) {
        if (!found && nb::try_cast(motion, typed) && typed)
            found = *typed;
    };
    (try_kind(static_cast<const Kinds*>(nullptr)), ...);
    return found;
}

} // namespace

TypedMotion given_motion(nb::handle motion) {
    if (auto found = cast_to(motion, static_cast<const TypedMotion*>(nullptr)))
        return *found;
    throw InvalidInput("motion: " + text_of_argument(motion) +
                       " must be a motion, such as chasles.ConstantVelocity.between(start, goal)");
}

Motion plain(const TypedMotion& motion) {
    return std::visit([](const auto& typed) -> Motion { return typed; }, motion);
}

namespace {

PlainMotion with_recipe(const OwnMotion& motion) {
    const OwnTrajectory& own = motion.trajectory;
    const auto recipe =
        std::make_shared<Recipe>(Recipe::own_maker, Numbers{listed(own.reference), own.knots, {own.rounding}});
    recipe->functions = motion.owners.front();
    return {motion.motion, motion.owners, recipe};
}

PlainMotion with_recipe(const PlainMotion& motion) {
    return motion;
}
PlainMotion with_recipe(const PythonTrack& track) {
    return {track, {}, track.recipe};
}
PlainMotion with_recipe(const PythonVelocity& motion) {
    return made("velocity", {listed(motion.start), listed(motion.goal), listed(motion.centre())});
}
PlainMotion with_recipe(const PythonTwist& motion) {
    return made("twist", {listed(motion.start), listed(motion.goal)});
}
PlainMotion with_recipe(const Motion& screw_or_sweep) {
    return {screw_or_sweep};
}

} // namespace

PlainMotion as_plain(const TypedMotion& motion) {
    return std::visit([](const auto& typed) { return with_recipe(typed); }, motion);
}

Owners owners_of(const TypedMotion& motion) {
    return std::visit(
        [](const auto& typed) -> Owners {
            if constexpr (requires { typed.owners; })
                return typed.owners;
            else
                return {};
        },
        motion);
}

void bind_motions(nb::module_& module) {
    bind_screw(module);
    bind_sweep(module);
}

} // namespace chasles::python
