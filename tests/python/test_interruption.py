"""Ctrl-C in a separate process: it takes effect within a second, and no finished row is lost."""

import pickle
import signal
import subprocess
import sys
import time

import pytest

import chasles

BATCH = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
sys.path.insert(0, {tests!r})
import chasles
from cubes import CUBE_FACES, CUBE_VERTICES, random_motions

cube = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
starts, goals = (np.tile(poses, (100, 1)) for poses in random_motions(10_000))
table = chasles.empty_table(len(starts))
{prepare}
print("ready", flush=True)
try:
    {call}
except chasles.BatchInterrupted as interrupted:
    table = interrupted.table
    done = table["verdict"] != "not_done"
    if not done.any():
        print("too early", flush=True)
        raise SystemExit
    assert not done.all()
    expected = chasles.first_contact_batch(cube, cube, starts[:10_000], goals[:10_000]) if {checks} else None
    for rows in np.split(table, 100) if {checks} else []:
        answered = rows["verdict"] != "not_done"
        for name in ("verdict", "time", "px"):
            np.testing.assert_array_equal(rows[name][answered], expected[name][answered])
    print("interrupted", flush=True)  # once the answers are checked, where they are
"""


def program_for(request: pytest.FixtureRequest, call: str, checks: bool = False, prepare: str = "") -> str:
    return BATCH.format(tests=str(request.path.parent), call="chasles." + call, checks=checks, prepare=prepare)


def interrupted_after(program: str, seconds: float) -> float:
    """Runs the program and interrupts it. Returns the time until it reports the interruption, in seconds."""
    while seconds < 100:
        answer, took = output_when_interrupted_after(program, seconds)
        if answer != "too early\n":
            break
        seconds *= 3
    assert answer == "interrupted\n"
    return took


def output_when_interrupted_after(program: str, seconds: float) -> tuple[str, float]:
    process = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout.readline() == "ready\n", process.stderr.read()
        time.sleep(seconds)
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        answer = process.stdout.readline()
        took = time.monotonic() - sent
        assert process.wait(timeout=60) == 0, process.stderr.read()
        return answer, took
    finally:
        process.kill()
        process.communicate()


def test_what_was_interrupted_can_leave_its_process():
    table = chasles.empty_table(3)
    table["verdict"][0] = "clear"
    again = pickle.loads(pickle.dumps(chasles.BatchInterrupted(table)))
    assert str(again).startswith("1 of 3") and (again.table["verdict"] == table["verdict"]).all()


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("threads", [1, 0])
def test_a_batch_of_motions(threads, request):
    interrupted_after(
        program_for(request, f"first_contact_batch(cube, cube, starts, goals, threads={threads}, table=table)", True), 1
    )


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_it_takes_less_than_a_second(request):
    program = program_for(request, "first_contact_batch(cube, cube, starts, goals, table=table)")
    assert any(interrupted_after(program, 0.5) < 1 for _ in range(5))  # other programs may delay it


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_a_batch_of_least_distances(request):
    prepare = "table = chasles.empty_table(len(starts), chasles.least_dtype)"
    call = "least_distance_batch(cube, cube, starts, goals, table=table)"
    interrupted_after(program_for(request, call, prepare=prepare), 0.5)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_a_batch_of_long_paths(request):
    prepare = "paths = np.tile([[3, 1.6, 0, 1, 0, 0, 0], [-1, 1.6, 0, 0.9, 0.3, 0.1, 0.2]], (50_000, 20, 1))"
    interrupted_after(program_for(request, "path_is_clear_batch(cube, cube, paths)", prepare=prepare), 0.3)


# --- Questions that take long: two sheets of triangles slide past each other at a billionth of their size ---

SLOW = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
import chasles

def sheet(n):
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    corners = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    return corners, faces

GAP = 1e-9
corners, faces = sheet(320)
sheets = [chasles.Polyhedron(corners, faces) for _ in range(2)]
start, goal = [0, 0.1, GAP, 1, 0, 0, 0], [0.4, 0.1, GAP, np.cos(0.4), 0, 0, np.sin(0.4)]
slide = chasles.ConstantVelocity.between(start, goal)
scene = chasles.Scene()
scene.add("lower", sheets[0])
scene.add("upper", sheets[1], motion=slide)

def robot():
    import pathlib, tempfile
    folder = pathlib.Path(tempfile.mkdtemp())
    lines = ["v %r %r %r" % tuple(map(float, c)) for c in corners] + ["f %d %d %d" % tuple(f + 1) for f in faces]
    (folder / "sheet.obj").write_text("\\n".join(lines))
    shape = '<collision><geometry><mesh filename="sheet.obj"/></geometry></collision>'
    box = '<collision><origin xyz="0 0 5"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision>'
    (folder / "robot.urdf").write_text(
        f'<robot name="r"><link name="lower">{{shape}}</link><link name="between">{{box}}</link><link name="upper">{{shape}}</link>'
        f'<joint name="x" type="prismatic"><parent link="lower"/><child link="between"/><origin xyz="0 0.1 {{GAP}}"/>'
        '<axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        '<joint name="turn" type="revolute"><parent link="between"/><child link="upper"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>')
    (folder / "robot.srdf").write_text('<robot name="r"><enable_collisions link1="lower" link2="upper"/></robot>')
    return chasles.Robot.load(folder / "robot.urdf", srdf=folder / "robot.srdf")

{prepare}
print("ready", flush=True)
try:
    {call}
    print("too early", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

MOTIONS = "np.array([start] * 8), np.array([goal] * 8)"

QUESTIONS = {
    "first_contact": ("", "chasles.first_contact(*sheets[::-1], motion=slide)"),
    "least_distance": ("", "chasles.least_distance(*sheets[::-1], motion=slide)"),
    "path": ("", "chasles.first_contact_on_path(*sheets[::-1], [start, goal] * 1000, max_turn=3)"),
    "batch": ("", f"chasles.first_contact_batch(*sheets[::-1], {MOTIONS}, motion='velocity')"),
    "least_distance_batch": ("", f"chasles.least_distance_batch(*sheets[::-1], {MOTIONS}, motion='velocity')"),
    "scene": ("", "scene.first_contact()"),
    "all_contacts": ("", "scene.all_contacts()"),
    "clear_until": ("", "scene.clear_until()"),
    "nearest_pair": ("", "chasles._core._nearest_pair(scene, ['lower', 'upper'], tolerance=1e-9)"),
    "profile": ("", "chasles.profile(*sheets[::-1], motion=slide)"),
    "scene_profile": ("", "scene.profile()"),
    "scene_distances": ("", "scene.least_distances()"),
    "scene_distance": ("", "scene.least_distance()"),
    "stepper": ("stepper = chasles.Stepper(scene, margin=1e-10)", "stepper.advance()"),
    "robot": ("arm = robot()", "arm.first_contact([0, 0], [0.4, 0.8])"),
    "edge": ("checker = chasles.RobotChecker(robot())", "checker.first_contact([0, 0], [0.4, 0.8])"),
    "edge_is_clear": ("checker = chasles.RobotChecker(robot())", "checker.is_clear([0, 0], [0.4, 0.8])"),
    "robot_path": ("arm = robot()", "arm.first_contact_on_path([[0, 0], [0.4, 0.8]])"),
    "robot_distance": ("arm = robot()", "arm.least_distance([0, 0], [0.4, 0.8])"),
    "robot_profile": ("arm = robot()", "arm.profile([[0, 0], [0.4, 0.8]])"),
    "prove_pairs": ("arm = robot()", "arm.prove_pairs(seconds=100)"),
}


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("question", QUESTIONS)
def test_every_question_ends_at_once(question):
    prepare, call = QUESTIONS[question]
    program = SLOW.replace("{{", "{").replace("}}", "}").replace("{prepare}", prepare).replace("{call}", call)
    assert any(interrupted_after(program, 0.5) < 1 for _ in range(5))  # other programs may delay it


def limited(seconds: float, ask):
    begin = time.monotonic()
    with chasles.Limit(seconds):
        found = ask()
    return found, time.monotonic() - begin


def slow_sheets():
    names: dict = {}
    head = SLOW.split("GAP = 1e-9")[0].split("import numpy as np")[1]
    exec("import numpy as np" + head, names)  # noqa: S102: the program above
    corners, faces = names["sheet"](200)
    return chasles.Polyhedron(corners, faces), chasles.Polyhedron(corners, faces)


def test_a_limit_of_time():
    lower, upper = slow_sheets()
    slide = chasles.ConstantVelocity.between([0, 0.1, 1e-9, 1, 0, 0, 0], [0.4, 0.1, 1e-9, 0.92, 0, 0, 0.39])
    found, took = limited(0.1, lambda: chasles.first_contact(upper, lower, motion=slide))
    assert took < 1 and found.verdict == "unknown" and 0 <= found.clear_until < 1 and not found.certain
    assert "unknown: the limit was reached" in repr(found)
    for show in (found.view, found.plot):
        with pytest.raises(chasles.InvalidInput, match="nothing to show"):
            show()
    near, took = limited(0.1, lambda: chasles.least_distance(upper, lower, motion=slide))
    assert took < 2 and near.distance <= 1e-9 <= near.distance_upper
    table, took = limited(0.1, lambda: chasles.first_contact_batch(upper, lower, motions=[slide] * 3))
    assert took < 1 and (table["verdict"] == "not_done").all()
    scene = chasles.Scene()
    scene.add("lower", lower)
    scene.add("upper", upper, motion=slide)
    found, took = limited(0.1, scene.first_contact)
    assert took < 1 and found.verdict == "unknown"
    assert "unknown: the limit was reached" in repr(found)
    with pytest.raises(chasles.InvalidInput, match="nothing to show"):
        scene.view(found)
    with pytest.raises(chasles.Cancelled, match="a limit was reached before the answer, and nothing of it is known"):
        limited(0.1, scene.all_contacts)


def test_limits_are_refused_or_end():
    with pytest.raises(chasles.InvalidInput, match="seconds: must be positive"):
        chasles.Limit(0)
    limit = chasles.Limit(1e-9)
    assert not limit.is_over
    with limit:
        assert limit.is_over
        with pytest.raises(chasles.InvalidInput, match="is in use"):
            limit.__enter__()
    assert not limit.is_over
