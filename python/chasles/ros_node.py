"""A node of ROS 2 that answers trajectories before the robot moves, for `chasles.ros`. It is imported without rclpy."""

from __future__ import annotations

import argparse
import contextlib
import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ._core import InvalidInput, Limit, Robot, RobotChecker, Scene, load_parts
from .program import CLEAR, Parser, run
from .ros_path import read

_WHEELS = "ros-rclpy ros-rmw-fastrtps-cpp ros-trajectory-msgs ros-sensor-msgs ros-std-msgs"


@contextlib.contextmanager
def _of_ros() -> Iterator[None]:
    """Around imports of ROS: an error says how to install it."""
    try:
        yield
    except ImportError as error:
        way = f"source the setup file of an installation of ROS 2, or pip install {_WHEELS}"
        kind = ModuleNotFoundError if isinstance(error, ModuleNotFoundError) else ImportError
        what = f"the validator needs {error.name or 'ROS 2'}, which cannot be imported ({error}): {way}"
        raise kind(what, name=error.name) from error


class Validator:
    """Proves each trajectory of a topic, and publishes the answer as JSON on TOPIC/validation.

    Parameters
    ----------
    node : rclpy.node.Node
    robot : Robot
    scene : Scene, optional
        The world.
    margin : float
        Distance that counts as contact, m.
    hold : float, optional
        As for `RobotChecker`: links that are within the margin where a segment begins may move on, to this distance.
    tolerance : float
        As for `joint_path`: how far a first point that is due at once may be from the last state, radians or m.
    seconds : float
        A question that takes longer has the verdict "unknown".
    topic : str
        Of trajectory_msgs/JointTrajectory.
    states : str or None
        The topic of sensor_msgs/JointState. Trajectories are then proven from the last state on, which has to name all variables of
        the robot. With None they are proven from their first point on, which may leave out the way to it.
    forward : str or None
        A topic on which trajectories with the verdict "clear" are published again, unchanged; no others are.
    """

    def __init__(
        self,
        node: Any,
        robot: Robot,
        *,
        scene: Scene | None = None,
        margin: float = 0.0,
        hold: float | None = None,
        tolerance: float = 0.01,
        seconds: float = 1.0,
        topic: str = "joint_trajectory",
        states: str | None = "joint_states",
        forward: str | None = None,
    ):
        with _of_ros():
            from sensor_msgs.msg import JointState
            from std_msgs.msg import String
            from trajectory_msgs.msg import JointTrajectory

        self.node, self.seconds, self.tolerance, self.has_states = node, seconds, tolerance, states is not None
        if not tolerance >= 0:
            raise InvalidInput(f"tolerance: must be at least 0, not {tolerance}")
        Limit(seconds)  # refuses what is none
        self.checker = RobotChecker(robot, scene, margin=margin, hold=hold)
        self.values: dict[str, float] = {}
        self._text = String
        self._answers = node.create_publisher(String, f"{topic}/validation", 10)
        self._forward = None if forward is None else node.create_publisher(JointTrajectory, forward, 10)
        self._inputs = [node.create_subscription(JointTrajectory, topic, self.on_trajectory, 10)]
        if states is not None:
            self._inputs.append(node.create_subscription(JointState, states, self.on_state, 10))

    def on_state(self, message: Any) -> None:
        self.values |= dict(zip(message.name, map(float, message.position), strict=False))

    def on_trajectory(self, message: Any) -> None:
        answer = self.validate(message)
        self._answers.publish(self._text(data=json.dumps(answer)))
        if self._forward is not None and answer["verdict"] == "clear":
            self._forward.publish(message)
        text = f"trajectory: {answer['verdict']} {answer.get('pair') or answer.get('error') or ''}"
        self.node.get_logger().info("; ".join([text.rstrip(), *answer.get("warnings", [])]))

    def validate(self, message: Any) -> dict[str, Any]:
        """The answer to one trajectory, as it is published. A trajectory that cannot be used has the verdict "error"."""
        answer: dict[str, Any] = {"from": self._begin()}
        try:
            stamp = message.header.stamp
            answer = {"stamp": {"sec": stamp.sec, "nanosec": stamp.nanosec}, **answer}
            return answer | self._proven(message)
        except InvalidInput as error:
            return answer | {"verdict": "error", "error": str(error)}
        except Exception as error:  # whatever it is: the node lives, and nothing is forwarded
            return answer | {"verdict": "error", "error": f"{type(error).__name__}: {error}"}

    def _proven(self, message: Any) -> dict[str, Any]:
        given = read(message, self.checker.robot, self._state(), self.tolerance)
        warnings = given.warnings + [f"path: {text}" for text in self.checker.robot.warnings_about(given.points)]
        with Limit(self.seconds):
            found = self.checker.first_contact_on_path(given.path)
        answer: dict[str, Any] = {"verdict": str(found.verdict), "clear_until": found.clear_until}
        if warnings:
            answer["warnings"] = warnings
        if found.pair is not None and found.verdict in ("contact", "contact_at_start"):
            answer |= {"pair": list(found.pair), "time": found.time, "time_upper": found.time_upper}
            answer |= {
                "certain": found.certain,
                "segment": found.segment,
                "configuration": found.configuration.tolist(),
            }
            answer["contacts"] = [{"point": c.point.tolist(), "normal": c.normal.tolist()} for c in found.contacts]
        return answer

    def _begin(self) -> str:
        return "state" if self.has_states else "first point"

    def _state(self) -> Any:
        if not self.has_states:
            return None
        variables = self.checker.robot.variables
        missing = [name for name in variables if name not in self.values]
        if missing:
            raise InvalidInput(
                f"states: no message has named {missing[0]!r} yet, so the way to the first point is not known"
            )
        return np.array([self.values[name] for name in variables])


def main(arguments: Sequence[str] | None = None) -> int:
    """The node as a program: `python -m chasles.ros --urdf robot.urdf`. Returns its exit status."""
    return run(_parser(), arguments, _spin)


def _parser() -> Parser:
    parser = Parser(prog="python -m chasles.ros", description="Proves trajectories before the robot moves.")
    add = parser.add_argument
    add("--urdf", required=True, help="the robot")
    add("--srdf", help="pairs of links that are not tested")
    add("--package", action="append", default=[], metavar="NAME=FOLDER", help="of package:// in the URDF")
    add("--scene", help="a mesh file of the world, in its frame")
    add("--margin", type=float, default=0.0, help="distance that counts as contact, m")
    add("--tolerance", type=float, default=0.01, help="of the first point, if it is due at once, rad or m")
    add("--seconds", type=float, default=1.0, help="for each trajectory")
    add("--topic", default="joint_trajectory")
    add("--states", default="joint_states", help='"" proves from the first point on')
    add("--forward", help="a topic for trajectories that are proven clear")
    return parser


def _spin(options: argparse.Namespace) -> int:
    """Until the node is asked to end."""
    for item in options.package:
        if "=" not in item:
            raise InvalidInput(f"--package: {item!r} is not NAME=FOLDER")
    packages = dict(item.split("=", 1) for item in options.package)
    robot = Robot.load(options.urdf, srdf=options.srdf, packages=packages)
    scene = _scene_of(options.scene) if options.scene else None
    try:
        with _of_ros():
            import rclpy
            from rclpy.exceptions import NameValidationException
            from rclpy.executors import ExternalShutdownException
        rclpy.init()
    except (ImportError, RuntimeError) as error:  # RuntimeError: of a middleware
        raise InvalidInput(str(error)) from None
    node = rclpy.create_node("chasles_validator")
    try:
        validator = _validator(node, robot, scene, options)
        rclpy.spin(validator.node)
    except (ImportError, NameValidationException) as error:  # of messages, and of names of topics
        raise InvalidInput(str(error)) from None
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return CLEAR


def _validator(node: Any, robot: Robot, scene: Scene | None, options: argparse.Namespace) -> Validator:
    return Validator(
        node, robot, scene=scene, margin=options.margin, tolerance=options.tolerance, seconds=options.seconds, topic=options.topic,
        states=options.states or None, forward=options.forward,
    )  # fmt: skip


def _scene_of(file: str) -> Scene:
    scene = Scene()
    for name, body in load_parts(file).items():
        scene.add(name, body)
    return scene
