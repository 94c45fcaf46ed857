"""Trajectories of ROS as the motion that controllers make of them, bags of trajectories, and a validator node.

This module is imported by its name: ``import chasles.ros``. Bags and YAML files require the package `rosbags`, and the node an
installation of ROS 2 with `rclpy`.

    for topic, time, message in chasles.ros.trajectories("bag"):
        found = robot.first_contact_on_path(chasles.ros.joint_path(message, robot))

The guide is docs/ros.md. The choices are in docs/decisions/0119-ros-drake-pinocchio.md.
"""

from __future__ import annotations

import json
import os
import pathlib
import sys
from collections.abc import Collection, Iterator
from typing import Any, NamedTuple

from ._core import InvalidInput
from .extras import extra
from .ros_node import Validator, main
from .ros_path import is_message, joint_path

__all__ = ["Recorded", "Validator", "joint_path", "main", "trajectories"]

_TYPES = ("JointTrajectory", "RobotTrajectory", "DisplayTrajectory")


class Recorded(NamedTuple):
    """A message of a bag or a file."""

    topic: str  #: "" in a file
    time: float  #: s since the epoch at which it was recorded; 0 in a file
    message: Any


def trajectories(file: str | os.PathLike[str], topics: Collection[str] | None = None) -> list[Recorded]:
    """The messages with trajectories of a bag (a folder, .mcap, .db3, .bag), or of a YAML or JSON file.

    Parameters
    ----------
    file : path
    topics : collection of str, optional
        Of a bag; by default all topics of the types JointTrajectory, RobotTrajectory and DisplayTrajectory.

    Returns
    -------
    list of Recorded
        In the order of the bag, or of the documents of a file (as `ros2 topic echo` prints them). A document may be a list of
        messages.

    Raises
    ------
    InvalidInput
        With the name of the file, if it cannot be read, has no such message, or a document that is none.
    """
    path = pathlib.Path(file)
    if not path.exists():
        raise InvalidInput(f"{path}: there is no such file or folder")
    is_text = path.suffix.lower() in (".yaml", ".yml", ".json")
    found = list(_documents(path)) if is_text else list(_messages(path, topics))
    if not found:
        raise InvalidInput(
            f"{path}: has no trajectory" + ("" if topics is None else f" on {', '.join(sorted(topics))}")
        )
    return found


def _documents(path: pathlib.Path) -> Iterator[Recorded]:
    try:
        text = path.read_text("utf-8")
        if path.suffix.lower() == ".json":
            documents = [json.loads(text)]
        else:
            with extra("ros", "chasles.ros.trajectories"):
                from ruamel.yaml import YAML
            documents = list(YAML(typ="safe", pure=True).load_all(text))
    except ModuleNotFoundError:
        raise
    except Exception as error:  # of the file, or a parser
        raise InvalidInput(f"{path}: {' '.join(str(error).split())}") from None
    messages = [message for document in documents for message in (document if isinstance(document, list) else [document])]
    messages = [message for message in messages if message is not None]  # after the last ---
    for number, message in enumerate(messages):
        if not is_message(message):
            raise InvalidInput(f"{path}: message {number}: has no points, and no trajectory or joint_trajectory that has them")
    return (Recorded("", 0.0, message) for message in messages)


def _messages(path: pathlib.Path, topics: Collection[str] | None) -> Iterator[Recorded]:
    with extra("ros", "chasles.ros.trajectories"):
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    if isinstance(topics, str):
        raise InvalidInput(f"topics: {topics!r} is one text; a collection of names is needed")
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
            chosen = [
                c
                for c in reader.connections
                if (c.msgtype.rpartition("/")[2] in _TYPES if topics is None else c.topic in topics)
            ]
            for connection, stamp, raw in reader.messages(chosen) if chosen else ():
                yield Recorded(connection.topic, stamp / 1e9, reader.deserialize(raw, connection.msgtype))
    except Exception as error:  # rosbags has no common type of errors
        raise InvalidInput(f"{path}: {type(error).__name__}: {' '.join(str(error).split())}") from None


if __name__ == "__main__":
    sys.exit(main())
