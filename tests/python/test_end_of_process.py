"""Nothing is left at the end of a process: for each class that takes functions of Python, as a script and as a module.

nanobind lists on standard error what is still alive at the end. The end is silent while other threads ask, too, and the
process keeps its exit status.
"""

import gc
import importlib.util
import os
import pathlib
import subprocess
import sys
import weakref

import pytest
from test_interruption import QUESTIONS, SLOW

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


# --- Threads that ask when the process ends ---

DAEMON = """
import atexit, sys, threading, time
ended = []
atexit.register(lambda: print("slow" if time.monotonic() - ended[0] > 3 else "in time"))  # runs last
{before}
{head}
started = threading.Event()
def work():
    {work}
def repeat():
    started.set()
    while True:
        work()
threading.Thread(target=repeat, daemon={daemon}).start()
started.wait()
time.sleep({seconds})
print("main")
ended.append(time.monotonic())
{end}
"""

WORKS = {
    "nothing": "time.sleep(100)",
    "python": "cube.report",
    "first_contact": "chasles.first_contact(cube, cube, [3, 0.2, 0.3, 1, 0, 0, 0], [0, 0.2, 0.3, 0.9, 0.1, 0, 0])",
    "trajectory": "chasles.first_contact(cube, cube, motion=trajectory)",
    "pose_at": "trajectory.pose_at(0.5)",
    "bounds": "trajectory.find_broken_bound(100_000_000)",
    "batch": "chasles.first_contact_batch(cube, cube, *poses)",
    "batch_of_trajectories": "chasles.first_contact_batch(cube, cube, motions=[trajectory] * 10_000)",
    "progress": "chasles.first_contact_batch(cube, cube, *poses, progress=True)",
    "least_distances": "chasles.least_distance_batch(cube, cube, *poses)",
    "scene": "scene_of().all_contacts()",
    "stepper": "chasles.Stepper(scene_of(), margin=0.01).advance()",
    "load": "chasles.Polyhedron(np.tile(corners, (20_000, 1)), (np.arange(20_000)[:, None] * 8 + [0, 1, 3, 2]))",
}

POSES = """
poses = [np.tile(np.array(pose, float), (200_000, 1)) for pose in ([3, 0.2, 0.3, 1, 0, 0, 0], [0, 0.2, 0.3, 0.9, 0.1, 0, 0])]
"""


def end_of(folder, work, daemon=True, before="", end="sys.exit(3)", seconds=0.3):
    """The exit status, standard output and standard error of a program whose other thread works when it ends."""
    (folder / "program.py").write_text(
        DAEMON.format(before=before, head=HEAD + POSES, work=work, daemon=daemon, end=end, seconds=seconds)
    )
    done = subprocess.run([sys.executable, "program.py"], capture_output=True, text=True, timeout=120, cwd=folder)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("work", WORKS)
def test_the_end_is_silent_while_a_thread_asks(work, tmp_path):
    for seconds in (0.3, 0.31, 0.37):
        status, printed, errors = end_of(tmp_path, WORKS[work], seconds=seconds)
        if work == "progress":
            errors = "" if "Traceback" not in errors and "terminate" not in errors else errors
        assert (status, printed, errors) == (3, "main\nin time\n", "")


@pytest.mark.skipif(sys.platform == "win32", reason="the programs are those of the tests of signals")
@pytest.mark.parametrize("question", QUESTIONS)
def test_the_end_is_silent_during_a_long_question(question, tmp_path):
    prepare, call = QUESTIONS[question]
    head = SLOW.replace("{{", "{").replace("}}", "}").split("{prepare}")[0]
    program = f"""
import atexit, time
begin = [0]
atexit.register(lambda: print(time.monotonic() - begin[0] < 2))  # before the import, so it runs last
{head}
import threading
{prepare}
def ask():
    print("asked", flush=True)
    {call}
    print("answered")
threading.Thread(target=ask, daemon=True).start()
time.sleep({{seconds}})
begin[0] = time.monotonic()
sys.exit(3)
"""
    for seconds in (0.5, 0.1, 0.02):
        this = program.replace("{seconds}", str(seconds))
        done = subprocess.run([sys.executable, "-c", this], capture_output=True, text=True, timeout=120)
        if "answered" not in done.stdout:  # a fast machine may have answered
            break
    assert (done.returncode, done.stdout, done.stderr) == (3, "asked\nTrue\n", "")


def test_the_end_waits_for_threads_that_are_no_daemons(tmp_path):
    work = "found = chasles.first_contact_batch(cube, cube, *poses); print(len(found)); sys.exit()"
    status, printed, errors = end_of(tmp_path, work, daemon=False)
    assert (status, printed.split()[:2], errors) == (3, ["main", "200000"], "")


def test_an_error_of_the_main_program_is_shown_as_ever(tmp_path):
    status, printed, errors = end_of(tmp_path, WORKS["trajectory"], end="raise RuntimeError('mine')")
    assert (status, printed) == (1, "main\nin time\n")
    assert errors.startswith("Traceback") and errors.endswith("RuntimeError: mine\n") and errors.count("Error") == 1 + 1


def test_functions_at_exit_may_ask(tmp_path):
    """Those that were registered before the import run after the questions of other threads have ended."""
    before = """
def last():
    found = chasles.first_contact(cube, cube, motion=trajectory)
    print(found.verdict, scene_of().first_contact().pair)
atexit.register(last)
"""
    assert end_of(tmp_path, WORKS["trajectory"], before=before) == (3, "main\ncontact ('a', 'b')\nin time\n", "")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_forked_process_ends_at_once(tmp_path):
    end = """
begin = time.monotonic()
child = os.fork()
if child == 0:
    threading.Thread(target=time.sleep, args=(100,), daemon=True).start()
    sys.exit(4)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), time.monotonic() - begin < 3)
sys.exit(3)
"""
    work = "chasles.first_contact_batch(cube, cube, *poses)"
    before = "import os, warnings; warnings.simplefilter('ignore')"  # Python warns of forks with threads
    status, printed, errors = end_of(tmp_path, work, before=before, end=end)
    assert (status, errors) == (3, "") and printed.endswith("4 True\nin time\n")
