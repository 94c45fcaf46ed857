"""Robots in spaces of OMPL that the tests of chasles.ompl share. Needs the package ompl."""

import pytest
from cubes import CUBE_FACES, CUBE_VERTICES
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

import chasles
from chasles.ompl import RobotMotionValidator, RobotValidityChecker, StateMap

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


@pytest.fixture(autouse=True)
def seeded():
    """The same random numbers in every run: OMPL seeds each new generator from this one."""
    ou.RNG.setSeed(1)


@pytest.fixture
def bars(tmp_path, seeded):
    return Bars(tmp_path)


class Problem:
    """A robot in a space, with both validators."""

    def __init__(self, space, robot, scene, names=None):
        self.space, self.robot, self.map = space, robot, StateMap(robot, names)
        self.checker = chasles.RobotChecker(robot, scene)
        self.information = ob.SpaceInformation(space)
        self.information.setStateValidityChecker(RobotValidityChecker(self.information, self.checker, self.map))
        self.information.setMotionValidator(RobotMotionValidator(self.information, self.checker, self.map))
        self.information.setup()


def bounds(size, low, high):
    made = ob.RealVectorBounds(size)
    made.setLow(low)
    made.setHigh(high)
    return made


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
