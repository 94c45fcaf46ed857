"""The questions that batches in Parquet files ask about each row: about motions of two bodies, and edges of a robot.

A question can be pickled, so that other processes answer it.
"""

import functools
import hashlib
import json
import pickle
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Polyhedron, Robot, RobotChecker, Scene, Trajectory
from .articles import with_article
from .batch import first_contact_batch
from .extras import extra
from .robots import first_contacts_on_edges

with extra("distributed", "chasles.distributed"):
    import pyarrow as pa

_POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")
START_COLUMNS = [name + "0" for name in _POSE]
GOAL_COLUMNS = [name + "1" for name in _POSE]


class Question(Protocol):
    """What is asked about each row of a Parquet file."""

    @property
    def rows(self) -> str:
        """What the rows are called."""

    @property
    def columns(self) -> list[str]:
        """The columns that the rows must have."""

    def identity(self) -> dict[str, Any]:
        """All that the answers depend on besides the rows, as JSON."""

    def pickled(self) -> bytes:
        """The question itself. Raises InvalidInput if it cannot be sent to other processes."""

    def answer(self, rows: pa.Table, threads: int) -> npt.NDArray[np.void]:
        """The answers of these rows. Rows that cannot be used have the verdict "error"."""


@dataclass(frozen=True)
class MotionQuestion:
    """The first contact of motions of one pair of bodies."""

    moving: Polyhedron
    fixed: Polyhedron
    options: dict[str, Any]
    rows: str = "motions"
    columns: list[str] = field(default_factory=lambda: START_COLUMNS + GOAL_COLUMNS)

    def check(self) -> None:
        """Refuses invalid bodies and options before any worker starts, by one query with them."""
        for body in (self.moving, self.fixed):
            if not isinstance(body, Polyhedron):
                raise TypeError(f"{with_article(body)} is not a chasles.Polyhedron")
        far_away = [[1e20, 0, 0, 1, 0, 0, 0]]
        first_contact_batch(self.moving, self.fixed, far_away, far_away, threads=1, **self.options)

    def identity(self) -> dict[str, Any]:
        return {"moving": digest_of(self.moving), "fixed": digest_of(self.fixed), "options": self.options}

    def pickled(self) -> bytes:
        return pickle.dumps(self)

    def answer(self, rows: pa.Table, threads: int) -> npt.NDArray[np.void]:
        starts, goals = (numbers_of(rows, names) for names in (START_COLUMNS, GOAL_COLUMNS))
        return first_contact_batch(self.moving, self.fixed, starts, goals, threads=threads, errors="mark", **self.options)


def edge_columns(robot: Robot) -> tuple[list[str], list[str]]:
    """The names of the columns of the starts and of the goals: start_NAME and goal_NAME for each variable."""
    return [f"start_{name}" for name in robot.variables], [f"goal_{name}" for name in robot.variables]


@dataclass(frozen=True)
class EdgeQuestion:
    """The first contact of a robot along straight edges."""

    robot: Robot
    scene: Scene | None
    options: dict[str, Any]
    rows: str = "edges"

    @property
    def columns(self) -> list[str]:
        return sum(edge_columns(self.robot), [])

    @functools.cached_property
    def _checker(self) -> RobotChecker:
        return RobotChecker(self.robot, self.scene, **self.options)

    def check(self) -> None:
        """Refuses what is no robot or scene, and invalid options, before any worker starts."""
        if not isinstance(self.robot, Robot):
            raise TypeError(f"robot: {with_article(self.robot)} is not a chasles.Robot")
        _ = self._checker
        self.pickled()

    def identity(self) -> dict[str, Any]:
        scene = None if self.scene is None else _digest(self.scene)
        return {"robot": _digest(self.robot), "scene": scene, "options": self.options}

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_checker"}

    def pickled(self) -> bytes:
        try:
            return pickle.dumps(self)
        except (TypeError, AttributeError, RuntimeError, pickle.PicklingError) as error:
            raise InvalidInput(f"scene: cannot be sent to other processes: {error}") from None

    def answer(self, rows: pa.Table, threads: int) -> npt.NDArray[np.void]:
        starts, goals = (numbers_of(rows, names) for names in edge_columns(self.robot))
        return first_contacts_on_edges(self._checker, starts, goals, threads=threads, errors="mark")


def numbers_of(rows: pa.Table, names: list[str]) -> npt.NDArray[np.float64]:
    """The numbers in these columns, (rows, columns). A missing number becomes NaN, which makes the row invalid."""
    columns = [rows[name].to_numpy().astype(np.float64) for name in names]
    return np.stack(columns, axis=1) if columns else np.zeros((len(rows), 0))


def digest_of(body: Polyhedron) -> str:
    """Of the vertices and faces of a body."""
    digest = hashlib.sha256(np.ascontiguousarray(body.vertices).tobytes())
    digest.update(json.dumps(body.faces).encode())
    return digest.hexdigest()


def _digest(thing: Any) -> str:
    """Of all that pickle keeps of a robot or of a scene."""
    return hashlib.sha256(repr(_plain(thing)).encode()).hexdigest()


def _plain(thing: Any) -> Any:
    """Tuples of numbers and texts, with digests of bodies."""
    if isinstance(thing, Polyhedron):
        return digest_of(thing)
    if isinstance(thing, Trajectory):
        raise InvalidInput(
            "scene: cannot be sent to other processes: a body follows a chasles.Trajectory, whose functions may be "
            "others there; give it chasles.TimedPoses"
        )
    if isinstance(thing, np.ndarray):
        return thing.tolist()
    if isinstance(thing, dict):
        return [(_plain(key), _plain(value)) for key, value in sorted(thing.items())]
    if isinstance(thing, (list, tuple)):
        return [_plain(part) for part in thing]
    if thing is None or isinstance(thing, (str, int, float)):
        return thing
    state = thing.__getstate__()
    if isinstance(thing, Robot):
        state = state[:-1]  # its warnings name files, and change no answer
    return type(thing).__name__, _plain(state)
