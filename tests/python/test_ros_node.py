"""The validator node of `chasles.ros`: by a stand-in for rclpy's node, and by rclpy where that is installed."""

import importlib.util
import json
import subprocess
import sys
import types

import pytest
from conftest import ROOT
from test_ros import ARM, Message

import chasles
import chasles.ros


@pytest.fixture(scope="module")
def arm():
    return chasles.Robot.load(ARM)


class Node:
    """The methods of rclpy's node that a validator uses."""

    def __init__(self):
        self.published, self.inputs = {}, {}

    def create_publisher(self, kind, topic, depth):
        self.published[topic] = []
        return types.SimpleNamespace(publish=self.published[topic].append)

    def create_subscription(self, kind, topic, callback, depth):
        self.inputs[topic] = callback
        return callback

    def get_logger(self):
        return types.SimpleNamespace(info=lambda text: None)


def stand_in(monkeypatch):
    for package, names in (("trajectory_msgs", ["JointTrajectory"]), ("sensor_msgs", ["JointState"]), ("std_msgs", ["String"])):
        module = types.SimpleNamespace(**{name: types.SimpleNamespace for name in names})
        monkeypatch.setitem(sys.modules, package, types.SimpleNamespace(msg=module))
        monkeypatch.setitem(sys.modules, f"{package}.msg", module)
    return Node()


def stamped(names, rows):
    points = [{"positions": row, "time_from_start": {"sec": k, "nanosec": 0}} for k, row in enumerate(rows, 1)]
    return Message({"joint_names": names, "points": points, "header": {"stamp": {"sec": 7, "nanosec": 8}}})


def test_the_node_by_a_stand_in(arm, monkeypatch):
    node = stand_in(monkeypatch)
    chasles.ros.Validator(node, arm, forward="safe")
    ask, answers = node.inputs["joint_trajectory"], node.published["joint_trajectory/validation"]
    good, bad = ([[0.5, 0.5, 0, 0.01]], [[0.5, 0.5, 0, 0.01], [0.5, 2.9, 0, 0.01]])
    ask(stamped(arm.variables, good))
    assert json.loads(answers[-1].data)["error"].startswith("states: no message has named 'waist' yet")
    node.inputs["joint_states"](Message({"name": [*arm.variables, "right"], "position": [0.0, 0, 0, 0.01, 0.01]}))
    ask(stamped(arm.variables, good))
    assert json.loads(answers[-1].data) == {
        "stamp": {"sec": 7, "nanosec": 8},
        "from": "state",
        "verdict": "clear",
        "clear_until": 1.0,
    }
    ask(stamped(arm.variables, bad))
    found = json.loads(answers[-1].data)
    assert (found["verdict"], found["pair"], found["segment"], found["certain"]) == ("contact", ["right_finger", "post"], 1, True)
    assert 1 < found["time"] <= found["time_upper"] < 2 and len(found["contacts"][0]["point"]) == 3
    ask(stamped(["waist"], [[0]] * 2)), ask(stamped(["wais"], [[0]]))
    assert "error" in json.loads(answers[-1].data) and len(node.published["safe"]) == 2  # "waist" alone is clear, the others stay


@pytest.mark.parametrize("tolerance, verdict", [(0.05, "error"), (0.2, "clear")])
def test_the_node_has_a_tolerance(arm, monkeypatch, tolerance, verdict):
    node = stand_in(monkeypatch)
    validator = chasles.ros.Validator(node, arm, tolerance=tolerance)
    node.inputs["joint_states"](Message({"name": arm.variables, "position": [0.1, 0.5, 0, 0.01]}))
    message = stamped(arm.variables, [[0.0, 0.5, 0, 0.01], [0.2, 0.5, 0, 0.01]])
    for point in message.points:
        point.time_from_start.sec -= 1
    assert validator.validate(message)["verdict"] == verdict


def test_the_node_ends_in_time_and_without_states(arm, monkeypatch):
    node = stand_in(monkeypatch)
    validator = chasles.ros.Validator(node, arm, states=None, seconds=1e-9, forward="safe")
    answer = validator.validate(stamped(arm.variables, [[0.5, 0.5, 0, 0.01], [0.5, 2.9, 0, 0.01]]))
    assert (answer["verdict"], answer["from"], "joint_states" in node.inputs) == ("unknown", "first point", False)


def test_the_node_of_rclpy():
    """In a process of its own: rclpy keeps threads."""
    if importlib.util.find_spec("rclpy") is None:
        pytest.skip("no rclpy")
    done = subprocess.run(
        [sys.executable, ROOT / "tests" / "python" / "ros_by_rclpy.py", ARM], capture_output=True, text=True, timeout=120
    )
    if "librmw" in done.stderr:
        pytest.skip("rclpy has no middleware: ros-rmw-fastrtps-cpp is one")
    assert done.returncode == 0, done.stderr


def validator(arm, monkeypatch, **options):
    node = stand_in(monkeypatch)
    made = chasles.ros.Validator(node, arm, states=None, forward="safe", **options)
    return node, made, node.inputs["joint_trajectory"], node.published["joint_trajectory/validation"]


GOOD = [[0.5, 0.5, 0, 0.01], [0.5, 0.6, 0, 0.01]]


def test_numbers_that_are_not_finite_do_not_end_the_node(arm, monkeypatch):
    """Only the last two points have velocities."""
    node, _, ask, answers = validator(arm, monkeypatch)
    for value in (float("nan"), float("inf")):
        message = stamped(arm.variables, [GOOD[0], *GOOD])
        message.points[1].velocities, message.points[2].velocities = [0.0] * 4, [0.0, value, 0.0, 0.0]
        ask(message)
        answer = json.loads(answers[-1].data)
        assert answer["verdict"] == "error" and answer["error"].startswith("points: point 2: velocities: 'elbow' is ")
    ask(stamped(arm.variables, GOOD))
    assert json.loads(answers[-1].data)["verdict"] == "clear" and len(node.published["safe"]) == 1


@pytest.mark.parametrize("error", [ZeroDivisionError("x"), RuntimeError("x"), MemoryError("x"), chasles.Cancelled("x")], ids=repr)
def test_whatever_a_message_raises_is_the_verdict_error(arm, monkeypatch, error):
    node, made, ask, answers = validator(arm, monkeypatch)

    class Bad:
        @property
        def first_contact_on_path(self):
            raise error

        robot = arm

    checker, made.checker = made.checker, Bad()
    ask(stamped(arm.variables, GOOD))
    answer = json.loads(answers[-1].data)
    assert (answer["verdict"], answer["error"], answer["stamp"]["sec"]) == ("error", f"{type(error).__name__}: x", 7)
    made.checker = checker
    ask(types.SimpleNamespace())  # without a header
    assert json.loads(answers[-1].data)["verdict"] == "error" and not node.published["safe"]
    ask(stamped(arm.variables, GOOD))
    assert json.loads(answers[-1].data)["verdict"] == "clear" and len(node.published["safe"]) == 1


def test_warnings_are_those_of_the_command_line(arm, monkeypatch):
    node, _, ask, answers = validator(arm, monkeypatch)
    told = []
    node.get_logger = lambda: types.SimpleNamespace(info=told.append)
    ask(stamped([*arm.variables, "right"], [[0.5, 0.5, 0, 0.04, 0.04], [0.5, 0.5, 0, 0.06, 0.06]]))
    answer = json.loads(answers[-1].data)
    assert answer["warnings"] == [
        "joint_names: ignored joints: 'right', which follows 'left'",
        "path: left: 0.06 in configuration 1 is beyond the limits [0, 0.04]",
    ]
    assert told == ["; ".join([f"trajectory: {answer['verdict']}", *answer["warnings"]])]
    ask(stamped(arm.variables, GOOD))
    assert "warnings" not in json.loads(answers[-1].data) and told[-1] == "trajectory: clear"


@pytest.mark.parametrize("options", [{"tolerance": -1}, {"tolerance": float("nan")}, {"seconds": -1}, {"margin": -1}], ids=str)
def test_options_are_refused_before_the_first_message(arm, monkeypatch, options):
    with pytest.raises(chasles.InvalidInput):
        validator(arm, monkeypatch, **options)


WITHOUT = "the validator needs rclpy, which cannot be imported"
PROGRAM = [
    (["--urdf", "nix.urdf"], "chasles: nix.urdf: "),
    (["--urdf", ARM, "--scene", "cell.json"], "chasles: cell.json: "),
    (["--urdf", ARM, "--package", "x"], "chasles: --package: 'x' is not NAME=FOLDER"),
    (["--urdf", ARM, "--margin", "x"], "chasles: chasles.ros: argument --margin: invalid float value: 'x'"),
    (["--urdf", ARM, "--margin", "-1"], "chasles: query: margin: must be in "),
    ([], "chasles: chasles.ros: the following arguments are required: --urdf"),
]


@pytest.mark.parametrize("arguments, why", PROGRAM, ids=[why for _, why in PROGRAM])
def test_the_program_refuses_by_one_line(arguments, why, monkeypatch, capsys):
    stand_in(monkeypatch)
    ended = []
    node = Node()
    node.destroy_node = lambda: ended.append("node")
    names = types.SimpleNamespace(ExternalShutdownException=KeyError, NameValidationException=LookupError)
    rclpy = types.SimpleNamespace(executors=names, exceptions=names, init=lambda: None, create_node=lambda name: node)
    rclpy.try_shutdown = lambda: ended.append("rclpy")
    for name, module in (("rclpy", rclpy), ("rclpy.executors", names), ("rclpy.exceptions", names)):
        monkeypatch.setitem(sys.modules, name, module)
    try:
        status = chasles.ros.main(list(map(str, arguments)))
    except SystemExit as end:
        status = end.code
    text = capsys.readouterr().err
    assert status == 2 and text.startswith(why) and text.count("\n") == 1
    assert ended == (["node", "rclpy"] if "-1" in arguments else [])


def test_the_program_without_ros(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "rclpy", None)
    assert chasles.ros.main(["--urdf", str(ARM)]) == 2
    text = capsys.readouterr().err
    assert text.startswith(f"chasles: {WITHOUT}") and text.count("\n") == 1
    assert "pip install ros-rclpy ros-rmw-fastrtps-cpp ros-trajectory-msgs ros-sensor-msgs ros-std-msgs" in text
