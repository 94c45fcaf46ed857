"""OMPL's validators: its contract to the letter, and planners whose paths are proven again and sampled densely."""

import math

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles

pytest.importorskip("ompl")
from ompl import base as ob  # noqa: E402
from ompl import geometric as og  # noqa: E402
from ompl import util as ou  # noqa: E402

import chasles.ompl  # noqa: E402
from chasles.ompl import LastValid, RobotMotionValidator, RobotValidityChecker, StateMap  # noqa: E402

BARS = """<robot name="bars">
  <link name="base"/>
  <link name="first"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
  <link name="second"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.08"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="first"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="first"/><child link="second"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"""


@pytest.fixture(autouse=True, scope="module")
def quiet():
    before = ou.getLogLevel()
    ou.setLogLevel(ou.LogLevel.LOG_ERROR)
    yield
    ou.setLogLevel(before)


def box(x, y, z, at=(0, 0, 0)):
    return chasles.Polyhedron((CUBE_VERTICES - 0.5) * [x, y, z] + at, CUBE_FACES)


def wall():
    scene = chasles.Scene()
    scene.add("wall", box(0.6, 0.04, 2), [1.5, 0.6, 0, 1, 0, 0, 0])
    return scene


class Bars:
    """Two bars in a plane, the second joint without limits, and a wall."""

    def __init__(self, folder):
        (folder / "bars.urdf").write_text(BARS)
        self.robot = chasles.Robot.load(folder / "bars.urdf")
        self.checker = chasles.RobotChecker(self.robot, wall())
        shoulder = ob.RealVectorStateSpace(1)
        shoulder.setBounds(-3, 3)
        self.space = ob.CompoundStateSpace()
        self.space.addSubspace(shoulder, 1)
        self.space.addSubspace(ob.SO2StateSpace(), 1)
        self.information = ob.SpaceInformation(self.space)
        self.information.setStateValidityChecker(RobotValidityChecker(self.information, self.checker))
        self.validator = RobotMotionValidator(self.information, self.checker)
        self.information.setMotionValidator(self.validator)
        self.information.setup()
        self.map = StateMap(self.robot)

    def state(self, shoulder, elbow):
        state = self.information.allocState()
        state[0][0], state[1].value = shoulder, elbow
        return state

    def values(self, state):
        return self.map(self.space, state)


@pytest.fixture
def bars(tmp_path):
    return Bars(tmp_path)


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
        assert bars.checker.is_clear([0, 0], bars.values(target))
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
    post = chasles.Scene()  # where the elbow is at pi, and nowhere else on this way
    post.add("post", box(0.1, 0.1, 1), [math.cos(-1) * 0.2, math.sin(-1) * 0.2, 0.55, 1, 0, 0, 0])
    assert chasles.RobotChecker(bars.robot, post).first_contact([-1, 3], [-1, -3]).verdict != "clear"


def test_what_a_planner_in_cpp_asks_reaches_the_validator(bars):
    """A planner's question for the last valid state arrives without it, as the module says."""
    seen = []

    class Spy(RobotMotionValidator):
        def checkMotion(self, *arguments):
            seen.append(len(arguments))
            return super().checkMotion(*arguments)

    bars.information.setMotionValidator(Spy(bars.information, bars.checker))
    for planner in (og.RRTConnect, og.KPIECE1):
        plan(bars, planner, bars.state(0, 0), bars.state(-1, 0))
    assert len(seen) > 3 and set(seen) == {2}
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


def plan(problem, planner, start, goal, seconds=20):
    setup = og.SimpleSetup(problem.information)
    setup.setStartAndGoalStates(start, goal)
    made = planner(problem.information)
    if hasattr(made, "setProjectionEvaluator") and not problem.space.hasDefaultProjection():
        problem.space.registerDefaultProjection(ob.SubspaceProjectionEvaluator(problem.space, 0))
    setup.setPlanner(made)
    status = setup.solve(seconds)
    assert status.getStatus() == ob.PlannerStatus.PlannerStatusType.EXACT_SOLUTION
    return setup.getSolutionPath()


def expect_proven(problem, path, sample_is_clear):
    """Every edge is proven again by another call, and no sample touches."""
    rows = problem.map.configurations(problem.space, path)
    table = chasles.first_contacts_on_edges(problem.checker, rows[:-1], rows[1:])
    assert set(table["verdict"]) == {"clear"}
    between = problem.information.allocState()
    for i in range(len(rows) - 1):
        for t in np.linspace(0, 1, 51):
            problem.space.interpolate(path.getState(i), path.getState(i + 1), t, between)
            assert sample_is_clear(problem.map(problem.space, between))


def bars_are_clear(values):
    """Whether the bars keep off the wall at a configuration: separating axes in the plane, without chasles."""
    a, b = values[0], values[0] + values[1]
    elbow = np.array([math.cos(a), math.sin(a)])
    wall_corners = np.array([[x, y] for x in (1.2, 1.8) for y in (0.58, 0.62)])
    for angle, base in ((a, np.zeros(2)), (b, elbow)):
        along, across = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
        bar = np.array([base + x * along + y * across for x in (0.05, 0.95) for y in (-0.05, 0.05)])
        if all(overlap(bar @ axis, wall_corners @ axis) for axis in (along, across, [1, 0], [0, 1])):
            return False
    return True


def overlap(a, b):
    return a.min() <= b.max() and b.min() <= a.max()


PLANNERS = ["RRTConnect", "LBKPIECE1", "KPIECE1", "BKPIECE1", "RRT", "PRM", "PDST", "RLRT"]


@pytest.mark.parametrize("name", PLANNERS)
def test_planners_find_proven_paths_in_joint_space(bars, name):
    if not hasattr(og, name):
        pytest.skip(f"the package ompl has no {name}")
    path = plan(bars, getattr(og, name), bars.state(0, 0), bars.state(1.2, 0))
    assert path.getStateCount() > 2  # the wall is in the way
    expect_proven(bars, path, bars_are_clear)
    assert bars.validator.getCheckedMotionCount() > 0


def test_the_samples_can_refute():
    assert not bars_are_clear([math.atan2(0.6, 1.5), 0]) and bars_are_clear([0, 0])


def window():
    """A wall at x = 0 with a window of 1 by 1 around the x axis."""
    scene = chasles.Scene()
    for side in (-1, 1):
        scene.add(f"y{side}", box(0.2, 2, 6), [0, side * 1.5, 0, 1, 0, 0, 0])
        scene.add(f"z{side}", box(0.2, 6, 2), [0, 0, side * 1.5, 1, 0, 0, 0])
    return scene


class Problem:
    """A robot in a space, with both validators."""

    def __init__(self, space, robot, scene, names=None):
        self.space, self.robot, self.map = space, robot, StateMap(robot, names)
        self.checker = chasles.RobotChecker(robot, scene)
        self.information = ob.SpaceInformation(space)
        self.information.setStateValidityChecker(RobotValidityChecker(self.information, self.checker, self.map))
        self.information.setMotionValidator(RobotMotionValidator(self.information, self.checker, self.map))
        self.information.setup()


@pytest.mark.parametrize("planner", [og.RRTConnect, og.LBKPIECE1])
def test_a_free_body_finds_the_window(planner):
    shape, scene = box(1.2, 0.4, 0.4), window()
    space = ob.SE3StateSpace()
    space.setBounds(bounds(3, -2, 2))
    problem = Problem(space, chasles.ompl.free_body(shape), scene)
    start, goal = problem.information.allocState(), problem.information.allocState()
    start.setXYZ(-1.5, 1, 0)
    start.rotation().setAxisAngle(0, 0, 1, math.pi / 2)  # across
    goal.setXYZ(1.5, -1, 0)
    goal.rotation().setIdentity()
    assert problem.map(space, start) == pytest.approx([-1.5, 1, 0, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    path = plan(problem, planner, start, goal)

    walls = {name: window_wall(name) for name in scene.names}

    def is_clear(q):  # by the query for two bodies, which knows no robots
        pose = np.array([*q[:3], q[6], *q[3:6]])
        return all(
            chasles.first_contact(shape, wall, motion=chasles.Motion.at_rest(pose)).verdict == "clear"
            for wall in walls.values()
        )

    expect_proven(problem, path, is_clear)
    assert not is_clear(np.array([0, 0.5, 0, 0, 0, 0, 1]))


def window_wall(name):
    side = int(name[1:])
    return box(0.2, 2, 6, (0, side * 1.5, 0)) if name[0] == "y" else box(0.2, 6, 2, (0, 0, side * 1.5))


def bounds(size, low, high):
    made = ob.RealVectorBounds(size)
    made.setLow(low)
    made.setHigh(high)
    return made


CART = """<robot name="cart"><link name="floor"/>
  <link name="cart"><collision><geometry><box size="1 0.2 0.2"/></geometry></collision></link>
  <joint name="drive" type="planar"><parent link="floor"/><child link="cart"/><axis xyz="0 0 1"/></joint></robot>"""


def test_a_cart_on_a_planar_joint_turns_through_a_gate(tmp_path):
    (tmp_path / "cart.urdf").write_text(CART)
    robot = chasles.Robot.load(tmp_path / "cart.urdf")
    assert robot.continuous == [False, False, True]
    scene = chasles.Scene()
    scene.add("left", box(0.1, 2, 1), [0, 1.3, 0, 1, 0, 0, 0])
    scene.add("right", box(0.1, 2, 1), [0, -1.3, 0, 1, 0, 0, 0])
    space = ob.SE2StateSpace()
    space.setBounds(bounds(2, -2, 2))
    problem = Problem(space, robot, scene)
    start, goal = problem.information.allocState(), problem.information.allocState()
    start.setXY(-1, 0)
    start.setYaw(math.pi / 2)
    goal.setXY(1, 0)
    goal.setYaw(-math.pi / 2)
    path = plan(problem, og.RRTConnect, start, goal)
    assert path.getStateCount() > 2
    expect_proven(problem, path, cart_is_clear)
    assert not cart_is_clear([0, 0, math.pi / 2])


def cart_is_clear(q):
    """Separating axes in the plane, without chasles."""
    along, across = np.array([math.cos(q[2]), math.sin(q[2])]), np.array([-math.sin(q[2]), math.cos(q[2])])
    cart = np.array([q[:2] + x * along + y * across for x in (-0.5, 0.5) for y in (-0.1, 0.1)])
    for side in (-1, 1):
        gate = np.array([[x, side * y] for x in (-0.05, 0.05) for y in (0.3, 2.3)])
        if all(overlap(cart @ axis, gate @ axis) for axis in (along, across, [1, 0], [0, 1])):
            return False
    return True


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
