"""Nothing is left at the end of a process: for each class that takes functions of Python, as a script and as a module.

nanobind lists on standard error what is still alive at the end.
"""

import gc
import importlib.util
import os
import pathlib
import subprocess
import sys
import weakref

import pytest

import chasles

HEAD = """
import numpy as np
import chasles
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
cube = chasles.Polyhedron(corners, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
def pose_at(time): return [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0]
def bounds(start, end): return {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0}
trajectory = chasles.Trajectory(pose_at, bounds)
rest = chasles.Motion.at_rest([0, 0, 0, 1, 0, 0, 0])
def scene_of():
    scene = chasles.Scene()
    scene.add("a", cube, motion=trajectory)
    scene.add("b", cube)
    return scene
"""

USES = {
    "trajectory": "assert trajectory.pose_at(0)[0, 3] == 3 and trajectory.find_broken_bound() is None",
    "first_contact": "found = chasles.first_contact(cube, cube, motion=trajectory); again = found.motion; other = found.swapped()",
    "least_distance": "found = chasles.least_distance(cube, cube, motion=trajectory)",
    "product": "product = trajectory * rest; other = rest * product; found = chasles.first_contact(cube, cube, motion=other)",
    "relative": "motion = chasles.relative(chasles.rest_of(trajectory, 0.1), rest); motion.pose_at(0.5)",
    "batch": "table = chasles.first_contact_batch(cube, cube, motions=[trajectory] * 3)",
    "scene": "scene = scene_of(); found = scene.first_contact(); all_found = scene.all_contacts()",
    "stepper": "stepper = chasles.Stepper(scene_of(), margin=0.01); event = stepper.advance()",
    "dragged_body": "scene = scene_of(); scene.add('c', cube, [0, 5, 0, 1, 0, 0, 0]); hand = chasles.DraggedBody(scene, 'c');"
    " step = hand.update([0, 6, 0, 1, 0, 0, 0])",
    "checker": "robot = chasles.ompl.free_body(cube) if hasattr(chasles, 'ompl') else chasles._core._free_body(cube, 'r');"
    " checker = chasles.RobotChecker(robot, scene_of()); found = checker.first_contact([0, 0, 9, 0, 0, 0, 1], [0, 0, 8, 0, 0, 0, 1])",
    "validator": """
class Validator:
    def __init__(self):
        self.trajectory = chasles.Trajectory(self.pose, lambda start, end: bounds(start, end))
        self.found = chasles.first_contact(cube, cube, motion=self.trajectory)
    def pose(self, time):
        return pose_at(time)
validator = Validator()""",
    "callback": """
def may_go_on(done): return None
chasles._core._first_contact_batch(cube, cube, np.zeros((2, 7)) + [3, 0, 0, 1, 0, 0, 0], np.zeros((2, 7)) + [0, 0, 0, 1, 0, 0, 0],
    None, chasles.empty_table(2), margin=0.0, hold=None, time_tolerance=1e-12, motion="screw", max_turn=0.1, find="first",
    threads=1, marks_errors=False, report=may_go_on)""",
}

PLAN = """
from ompl import base as ob, geometric as og, util as ou
import chasles, chasles.ompl, numpy as np
ou.setLogLevel(ou.LogLevel.LOG_NONE)
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
cube = chasles.Polyhedron(corners, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
scene = chasles.Scene()
scene.add("wall", cube)
space = ob.SE3StateSpace()
box = ob.RealVectorBounds(3)
box.setLow(-3)
box.setHigh(4)
space.setBounds(box)
information = ob.SpaceInformation(space)
checker = chasles.RobotChecker(chasles.ompl.free_body(cube), scene)
validity = chasles.ompl.RobotValidityChecker(information, checker)
validator = chasles.ompl.RobotMotionValidator(information, checker)
information.setStateValidityChecker(validity)
information.setMotionValidator(validator)
information.setup()
setup = og.SimpleSetup(information)
start, goal = information.allocState(), information.allocState()
for state, x in ((start, -2.0), (goal, 2.0)):
    state.setXYZ(x, 0.1, 0.2)
    state.rotation().setIdentity()
setup.setStartAndGoalStates(start, goal)
setup.setPlanner(og.RRTConnect(information))
assert setup.solve(10)
assert validator.getCheckedMotionCount() > 0
"""


def expect_silent_end(folder, text, imported):
    (folder / "user_module.py").write_text(text)
    script = folder / "user_script.py"
    script.write_text("import user_module\n" if imported else text)
    package = str(pathlib.Path(chasles.__file__).parents[1])
    path = os.pathsep.join([package, *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=120, env=os.environ | {"PYTHONPATH": path}
    )
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("imported", [False, True], ids=["script", "module"])
@pytest.mark.parametrize("use", USES)
def test_nothing_is_left_at_the_end(use, imported, tmp_path):
    expect_silent_end(tmp_path, HEAD + USES[use], imported)


@pytest.mark.parametrize("imported", [False, True], ids=["script", "module"])
def test_nothing_is_left_after_planning(imported, tmp_path):
    pytest.importorskip("ompl")
    expect_silent_end(tmp_path, PLAN, imported)


@pytest.mark.parametrize("use", [use for use in USES if use != "callback"])
def test_cycles_are_collected_while_the_process_runs(use, tmp_path):
    """A module that is dropped is freed with its functions, though motions hold these."""
    (tmp_path / "dropped.py").write_text(HEAD + USES[use])
    spec = importlib.util.spec_from_file_location("dropped", tmp_path / "dropped.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    function = weakref.ref(module.pose_at)
    assert function() is not None
    del module, spec
    gc.collect()
    gc.collect()
    assert function() is None


def test_a_motion_lives_as_long_as_anything_that_follows_it(cube):
    """Only the product, the answer or the scene is kept."""

    def trajectory():
        pose = [3, 0.2, 0.3, 1, 0, 0, 0]
        return chasles.Trajectory(
            lambda time: [pose[0] - 4 * time, *pose[1:]],
            lambda start, end: {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0},
        )

    product = chasles.Motion.at_rest([0, 0, 0, 1, 0, 0, 0]) * trajectory()
    rest = chasles.relative(chasles.rest_of(trajectory(), 0.25), chasles.Motion.at_rest([0, 0, 0, 1, 0, 0, 0]))
    answer = chasles.first_contact(cube, cube, motion=trajectory())
    least = chasles.least_distance(cube, cube, motion=trajectory())
    scene = chasles.Scene()
    scene.add("a", cube, motion=trajectory())
    scene.add("b", cube)
    stepper = chasles.Stepper(scene, margin=0.01)
    checker = chasles.RobotChecker(chasles._core._free_body(cube, "body"), scene)
    contact = scene.first_contact()
    del scene
    gc.collect()
    assert product.pose_at(0.5)[0, 3] == 1 and rest.pose_at(0)[0, 3] == 2
    assert answer.motion.pose_at(0.5)[0, 3] == least.motion.pose_at(0.5)[0, 3] == 1
    assert contact.motion.pose_at(0.5)[0, 3] == 1
    assert stepper.advance().contacts[0].pair == ("a", "b")
    far = [[0, 0, z, 0, 0, 0, 1] for z in (9, 8)]
    assert checker.first_contact(*far).verdict == "clear"
