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
