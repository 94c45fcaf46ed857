"""Planners of OMPL with proven motions: each edge of each path is proven again and sampled densely."""

import math

import numpy as np
import pytest

import chasles

pytest.importorskip("ompl")
from ompl import base as ob  # noqa: E402
from ompl import geometric as og  # noqa: E402
from ompl_problems import Problem, bars, bounds, box, plan, quiet, seeded  # noqa: E402, F401

import chasles.ompl  # noqa: E402


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
