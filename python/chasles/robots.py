"""Robots: many edges at once, and pages."""

import os
import pathlib

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import JointPath, Robot, RobotChecker, Scene

edge_dtype = np.dtype(
    [
        ("verdict", "U16"),
        ("time", np.float64),
        ("time_upper", np.float64),
        ("clear_until", np.float64),
        ("certain", np.bool_),
        ("first", object),
        ("second", object),
    ]
)


def first_contacts_on_edges(
    robot: Robot | RobotChecker,
    starts: npt.ArrayLike,
    goals: npt.ArrayLike,
    *,
    scene: Scene | None = None,
    margin: float = 0.0,
    threads: int = 0,
) -> np.ndarray:
    """The first contact along each of many straight edges, on all cores.

    Parameters
    ----------
    robot : Robot or RobotChecker
        A checker has its own scene and margin.
    starts, goals : array (n, variables)
        Configurations: radians, or the mesh unit.
    scene : Scene, optional
        The world; without it the robot is tested against itself only.
    margin : float
        Distance that counts as contact, mesh unit.
    threads : int
        At most so many; 0 for all cores. The answers do not depend on it.

    Returns
    -------
    structured array (n,) of `edge_dtype`
        Times are in [0, 1]. `first` and `second` name the pair that touches.

    Raises
    ------
    InvalidInput
        With the number of the edge, for values that cannot be used.
    """
    checker = robot if isinstance(robot, RobotChecker) else RobotChecker(robot, scene, margin=margin)
    fields = checker.first_contacts(starts, goals, threads)
    table = np.zeros(len(fields[0]), edge_dtype)
    for name, values in zip(edge_dtype.names, fields, strict=True):
        table[name] = values
    return table


def write_robot_page(
    robot: Robot,
    configurations: npt.ArrayLike | JointPath,
    out: str | os.PathLike[str] = "page.html",
    *,
    scene: Scene | None = None,
    margin: float = 0.0,
    title: str = "Chasles",
) -> pathlib.Path:
    """Write a page of HTML that shows the robot on its path up to its first contact, and return the path of the page.

    The page is one file and needs no network.

    Parameters
    ----------
    robot : Robot
    configurations : array (n, variables) or JointPath
        Straight from each one to the next, or any path.
    out : path
        The file to write.
    scene : Scene, optional
        The world.
    margin : float
        Distance that counts as contact, mesh unit.
    title : str
        The title of the page.

    Raises
    ------
    InvalidInput
        For configurations that cannot be used, or if the package was built without the viewer.
    """
    page = _core.robot_page(robot, configurations, scene, margin, title)
    path = pathlib.Path(out)
    path.write_text(page, encoding="utf-8")
    return path
