"""Joints of a message that follow others (`mimic` in a URDF), for `chasles.ros`: they have no variables, and may only agree."""

from __future__ import annotations

from typing import Any, NamedTuple

from ._core import InvalidInput, Robot
from .arrays import Array

AGREES = 1e-4  # radians or m, and per s and s^2: planners and files round


class Follower(NamedTuple):
    name: str
    place: int  #: in the message
    leader: str  #: the joint that the description names
    variable: int  #: at the end of the chain
    multiplier: float
    offset: float


def follower_named(name: Any, place: int, robot: Robot) -> Follower | None:
    """The joint of this name, if it follows another one."""
    joints = {joint["name"]: joint for joint in robot.description()["joints"]}
    joint = joints.get(name) if isinstance(name, str) else None
    if joint is None or joint["mimic"] is None:
        return None
    leader, multiplier, offset = joint["mimic"]["joint"], 1.0, 0.0
    while joint["mimic"] is not None:
        offset += multiplier * joint["mimic"]["offset"]
        multiplier *= joint["mimic"]["multiplier"]
        joint = joints[joint["mimic"]["joint"]]
    return Follower(name, place, leader, robot.variables.index(joint["name"]), multiplier, offset)


def require_agreement(number: int, given: list[Array], whole: list[Array], followers: list[Follower], robot: Robot) -> None:
    """Refuses a point whose followers are not where the robot has them. `whole` are the states of all variables."""
    for follower in followers:
        for order, (what, state) in enumerate(zip(("positions", "velocities", "accelerations"), given, strict=False)):
            value, offset = state[follower.place], follower.offset if order == 0 else 0.0
            followed = follower.multiplier * whole[order][follower.variable] + offset
            if not abs(value - followed) <= AGREES:
                raise InvalidInput(
                    f"points: point {number}: {what}: {follower.name!r} is {value:.9g} and would be {followed:.9g}; "
                    f"leave it out: it follows {follower.leader!r}"
                )
