"""Robots: many edges at once, and pages."""

import os
import pathlib
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InvalidInput, JointPath, Robot, RobotChecker, Scene
from .arrays import numbers
from .batch import Errors, _marks, _thread_count

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
    errors: Errors = "raise",
) -> np.ndarray:
    """The first contact along each of many straight edges, on all cores.

    Parameters
    ----------
    robot : Robot or RobotChecker
        A checker has its own scene and margin, and takes no others.
    starts, goals : array (n, variables)
        Configurations: radians, or the mesh unit.
    scene : Scene, optional
        The world; without it the robot is tested against itself only.
    margin : float
        Distance that counts as contact, mesh unit.
    threads : int
        At most so many; 0 for all cores. The answers do not depend on it.
    errors : "raise" or "mark"
        How to treat an edge that cannot be used, such as one with NaN: "raise" raises InvalidInput with its number,
        "mark" gives its row the verdict "error", times that are NaN, and a `clear_until` of 0.

    Returns
    -------
    structured array (n,) of `edge_dtype`
        Times are in [0, 1]; those of a contact are NaN where there is none. `first` and `second` name the pair that
        touches; they are "" where there is none.

    Raises
    ------
    InvalidInput
        With the number of the edge, for values that cannot be used.
    """
    if isinstance(robot, RobotChecker):
        for name, is_given in (("scene", scene is not None), ("margin", margin != 0)):
            if is_given:
                raise InvalidInput(f"{name}: the checker has its own: make it by RobotChecker(robot, scene, margin=...)")
        checker = robot
    else:
        checker = RobotChecker(robot, scene, margin=margin)
    threads = _thread_count(threads)
    if not _marks(errors):
        return _table(checker.first_contacts(starts, goals, threads))
    return _marked(checker, *_rows(checker, starts, goals), threads)


def _rows(checker: RobotChecker, starts: npt.ArrayLike, goals: npt.ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Both arrays, of the same shape (n, variables)."""
    arrays = []
    for name, rows in (("starts", starts), ("goals", goals)):
        arrays.append(numbers(rows, name))
        if arrays[-1].ndim != 2 or arrays[-1].shape[1] != len(checker.robot.variables):
            raise InvalidInput(f"{name}: the shape is {arrays[-1].shape}; (n, {len(checker.robot.variables)}) is needed")
    if len(arrays[0]) != len(arrays[1]):
        raise InvalidInput(f"starts, goals: {len(arrays[0])} starts and {len(arrays[1])} goals")
    return arrays[0], arrays[1]


def _table(fields: tuple) -> np.ndarray:
    table = np.zeros(len(fields[0]), edge_dtype)
    for name, values in zip(edge_dtype.names, fields, strict=True):
        table[name] = values
    is_clear = table["verdict"] == "clear"
    table["time"][is_clear] = table["time_upper"][is_clear] = np.nan
    return table


def _marked(checker: RobotChecker, starts: np.ndarray, goals: np.ndarray, threads: int) -> np.ndarray:
    """Edges that cannot be used are found by halving, after those that are not finite."""
    table = _refused(len(starts))
    usable = np.flatnonzero(np.isfinite(starts).all(axis=1) & np.isfinite(goals).all(axis=1))
    waiting = [usable] if len(usable) else []
    while waiting:
        rows = waiting.pop()
        try:
            table[rows] = _table(checker.first_contacts(starts[rows], goals[rows], threads))
        except InvalidInput:
            half = len(rows) // 2
            waiting += [rows[:half], rows[half:]] if half else []
    return table


def _refused(rows: int) -> np.ndarray:
    """Rows of edges that cannot be used."""
    table = np.zeros(rows, edge_dtype)
    table["verdict"], table["first"], table["second"] = "error", "", ""
    table["time"], table["time_upper"] = np.nan, np.nan
    return table


def write_robot_page(
    robot: Robot,
    configurations: npt.ArrayLike | JointPath,
    out: str | os.PathLike[str] = "page.html",
    *,
    scene: Scene | None = None,
    margin: float = 0.0,
    title: str = "Chasles",
    curve: bool = False,
    handovers: Sequence[tuple[float, str, str] | tuple[float, str, str, list[str]]] = (),
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
    curve : bool
        Whether the page shows the distance over time below the slider. It takes the time of `robot.profile`.
    handovers : sequence of tuples
        As for `robot.first_contact_on_path`.

    Raises
    ------
    InvalidInput
        For configurations that cannot be used, or if the package was built without the viewer.
    """
    page = _core.robot_page(robot, configurations, scene, margin, title, curve, handovers)
    path = pathlib.Path(out)
    path.write_text(page, encoding="utf-8")
    return path
