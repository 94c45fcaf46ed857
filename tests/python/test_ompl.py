"""OMPL's validators: its contract to the letter, and what is refused."""

import math

import numpy as np
import pytest

import chasles

pytest.importorskip("ompl")
from ompl import base as ob  # noqa: E402
from ompl import geometric as og  # noqa: E402
from ompl_problems import Problem, bars, box, plan, quiet, seeded, wall  # noqa: E402, F401

import chasles.ompl  # noqa: E402
from chasles.ompl import LastValid, RobotMotionValidator, RobotValidityChecker, StateMap  # noqa: E402


def test_neither_part_of_last_valid_changes_on_success(bars):
    s1, s2, kept = bars.state(0, 0), bars.state(-1, 0.5), bars.state(0.125, 0.25)
    last = LastValid(kept, 0.375)
    assert bars.validator.checkMotion(s1, s2, last) is True
    assert bars.validator.checkMotion(s1, s2) is True
    assert last.first is kept and last.second == 0.375
    assert bars.values(kept).tolist() == [0.125, 0.25]
    assert (bars.validator.getValidMotionCount(), bars.validator.getInvalidMotionCount()) == (2, 0)
    assert (bars.values(s1).tolist(), bars.values(s2).tolist()) == ([0, 0], [-1, 0.5])


@pytest.mark.parametrize("alias", ["another", "s1", "s2", "none"])
def test_last_valid_is_a_valid_state_and_a_proven_fraction_on_failure(bars, alias):
    s1, s2 = bars.state(0, 0), bars.state(1, 0)
    found = bars.checker.first_contact([0, 0], [1, 0])
    target = {"another": bars.state(2, 2), "s1": s1, "s2": s2, "none": None}[alias]
    last = LastValid(target, -1)
    assert bars.validator.checkMotion(s1, s2, last) is False
    assert found.clear_until - 1e-6 < last.second < found.clear_until
    assert last.first is target
    for state, values in (("s1", [0, 0]), ("s2", [1, 0])):
        if alias != state:
            assert bars.values({"s1": s1, "s2": s2}[state]).tolist() == values
    if target is not None:
        assert bars.information.isValid(target)
        assert bars.values(target) == pytest.approx([last.second, 0], abs=1e-15)
        assert bars.checker.is_clear([0, 0], bars.values(target)) and bars.checker.is_clear(bars.values(target), [0, 0])
    assert bars.validator.getInvalidMotionCount() == 1 and bars.validator.getCheckedMotionCount() == 1


def test_a_motion_that_leaves_the_bounds_is_not_valid(bars):
    last = LastValid(bars.state(0, 0), -1)
    s1, s2 = bars.state(-2, 0), bars.state(-3.3, 0)
    assert bars.checker.is_clear([-2, 0], [-3.3, 0])  # the bounds alone make it so
    assert not bars.validator.checkMotion(s1, s2, last) and not bars.validator.checkMotion(s1, s2)
    assert bars.information.isValid(last.first) and 0.5 < last.second <= 1 / 1.3


def test_the_users_own_validity_counts(bars):
    bars.information.setStateValidityChecker(lambda state: state[0][0] > -0.9)
    last = LastValid(bars.state(0, 0), -1)
    assert bars.checker.is_clear([0, 0], [-1, 0])
    assert not bars.validator.checkMotion(bars.state(0, 0), bars.state(-1, 0))
    assert not bars.validator.checkMotion(bars.state(0, 0), bars.state(-1, 0), last)
    assert bars.values(last.first)[0] > -0.9 and 0.5 < last.second < 0.9


def test_a_start_that_touches_is_kept(bars):
    angle = math.atan2(0.6, 1.5)
    last = LastValid(bars.state(0, 0), -1)
    assert not bars.validator.checkMotion(bars.state(angle, 0), bars.state(0, 0), last)
    assert last.second == 0 and bars.values(last.first).tolist() == [angle, 0]


def test_the_shorter_way_round_is_that_of_ompl(bars):
    s1, s2, middle = bars.state(-1, 3), bars.state(-1, -3), bars.state(0, 0)
    length = 2 * math.pi - 6
    for t in np.linspace(0, 1, 17):
        bars.space.interpolate(s1, s2, t, middle)
        assert math.remainder(3 + t * length - bars.values(middle)[1], 2 * math.pi) == pytest.approx(0, abs=1e-14)
    post = chasles.Scene()  # where the elbow is at pi; the first bar is always there
    post.add("post", box(0.1, 0.1, 1), [math.cos(-1) * 0.2, math.sin(-1) * 0.2, 0.5, 1, 0, 0, 0])
    bars.robot.ignore_in_scene("first", "post")
    checker = chasles.RobotChecker(bars.robot, post)
    assert checker.first_contact([-1, 2.5], [-1, -2.5]).verdict == "contact"
    assert checker.first_contact([-1, 2.5], [-1, 0]).verdict == checker.first_contact([-1, 0], [-1, -2.5]).verdict == "clear"


def test_what_a_planner_in_cpp_asks_reaches_the_validator(bars):
    """A planner's question for the last valid state arrives without it, as the module says."""
    seen = []

    class Spy(RobotMotionValidator):
        def checkMotion(self, *arguments):
            seen.append(len(arguments))
            return super().checkMotion(*arguments)

    bars.information.setMotionValidator(Spy(bars.information, bars.checker))
    for planner in (og.RRTConnect, og.KPIECE1):
        asked = len(seen)
        plan(bars, planner, bars.state(0, 0), bars.state(-1, 0))
        assert len(seen) > asked
    assert set(seen) == {2}
    assert bars.information.getMotionValidator().getCheckedMotionCount() == len(seen)


def test_no_edge_of_a_tree_is_unproven_where_planners_keep_parts_of_motions(bars):
    """KPIECE1 would keep the valid part of each motion, however short, if it were told."""
    planner = og.KPIECE1(bars.information)
    planner.setMinValidPathFraction(1e-9)
    plan(bars, lambda _: planner, bars.state(0, 0), bars.state(1.2, 0))
    data = ob.PlannerData(bars.information)
    planner.getPlannerData(data)
    states = [bars.values(data.getVertex(i).getState()) for i in range(data.numVertices())]
    edges = [(i, k) for i in range(len(states)) for k in data.getEdges(i)]
    assert len(edges) > 10 and bars.validator.getInvalidMotionCount() > 3
    assert all(bars.checker.is_clear(states[i], states[k]) for i, k in edges)


def test_some_variables_may_be_planned_and_the_others_stay(bars):
    space = ob.SO2StateSpace()
    problem = Problem(space, bars.robot, wall(), ["elbow"])
    state = problem.information.allocState()
    state.value = 0.5
    assert problem.map(space, state).tolist() == [0, 0.5]
    assert StateMap(bars.robot, ["elbow"], others=[0.25, 9])(space, state).tolist() == [0.25, 0.5]


def test_spaces_that_do_not_fit_are_refused_by_name(bars):
    class Bent(ob.RealVectorStateSpace):
        def interpolate(self, a, b, t, c):
            pass

    straight = ob.RealVectorStateSpace(2)
    straight.setBounds(-3, 3)
    bent = Bent(2)
    bent.setBounds(-3, 3)
    dubins = ob.DubinsStateSpace()
    for space, names, message in [
        (straight, None, "space: number 1: elbow goes the shorter way round"),
        (straight, ["shoulder"], "state: has 2 numbers, and 1 variables are named"),
        (bent, None, "space: Bent: its interpolation need not be a straight path"),
        (dubins, None, "space: DubinsStateSpace: its interpolation"),
        (ob.SO2StateSpace(), ["shoulder"], "space: number 0: shoulder goes straight"),
        (ob.SO3StateSpace(), ["shoulder"], "state: has 4 numbers"),
    ]:
        information = ob.SpaceInformation(space)
        for kind in (RobotMotionValidator, RobotValidityChecker):
            with pytest.raises(chasles.InvalidInput) as error:
                kind(information, bars.checker, StateMap(bars.robot, names))
            assert str(error.value).startswith(message)
    body = chasles.ompl.free_body(box(1, 1, 1))
    names = body.variables
    information = ob.SpaceInformation(ob.SO3StateSpace())
    with pytest.raises(chasles.InvalidInput, match="number 0: free/rot_w is part of a quaternion"):
        RobotMotionValidator(information, chasles.RobotChecker(body), StateMap(body, names[6:] + names[3:6]))


def test_wrong_arguments_are_refused(bars):
    states = bars.state(0, 0), bars.state(1, 0)
    unready = RobotMotionValidator(ob.SpaceInformation(bars.space), bars.checker)
    for call, error, message in [
        (lambda: StateMap(bars.robot, ["wrist"]), chasles.InvalidInput, "robot: wrist: there is no such variable"),
        (lambda: StateMap(bars.robot, ["elbow", "elbow"]), chasles.InvalidInput, "names: elbow: is named twice"),
        (lambda: StateMap(bars.robot, "elbow"), chasles.InvalidInput, "names: 'elbow' is one text"),
        (lambda: StateMap(None), TypeError, "robot: a NoneType is not a chasles.Robot"),
        (lambda: bars.validator.checkMotion(*states, (states[0], 0)), TypeError, "last: a tuple is not"),
        (lambda: unready.checkMotion(*states), chasles.InvalidInput, "information: has no validity checker"),
        (lambda: StateMap(bars.robot, others=[1]), chasles.InvalidInput, "others: the shape is (1,); (2,) is needed"),
        (lambda: StateMap(bars.robot, others="no"), chasles.InvalidInput, "others: not an array of numbers"),
        (lambda: RobotMotionValidator(None, bars.checker), TypeError, "information: a NoneType is not"),
        (lambda: RobotMotionValidator(bars.information, bars.robot), TypeError, "checker: a Robot is not"),
        (lambda: RobotValidityChecker(bars.information, bars.checker, []), TypeError, "state_map: a list is not"),
        (lambda: chasles.ompl.free_body(None), TypeError, "shape: must be a chasles.Polyhedron"),
    ]:
        with pytest.raises(error) as caught:
            call()
        assert str(caught.value).startswith(message)


def test_states_that_are_no_numbers_raise_through_the_planner(bars):
    with pytest.raises(chasles.InvalidInput, match="path: configuration 1"):
        bars.validator.checkMotion(bars.state(0, 0), bars.state(0, math.nan), LastValid())
