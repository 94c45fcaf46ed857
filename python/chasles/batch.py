"""Batches: many motions or many paths of one pair of bodies, on all cores."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from operator import index
from typing import Any, Literal, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import ConstantTwist, ConstantVelocity, InvalidInput, Polyhedron, ScrewMotion, SweepMotion
from .arrays import array_of
from .articles import with_article
from .enums import Find
from .extras import extra
from .table import NOT_DONE, empty_table, least_dtype, motion_dtype, path_dtype

Table = npt.NDArray[np.void]
Errors = Literal["raise", "mark"]
MotionKind = Literal["screw", "sweep", "velocity", "twist"]


class BatchInterrupted(KeyboardInterrupt):
    """Ctrl-C interrupted a batch. ``table`` has all finished rows; the verdict of an unfinished row is "not_done".

    To continue, pass this table to the batch as ``table=``. In an interactive session it is ``sys.last_value.table``.
    """

    def __init__(self, table: Table):
        done = int(np.count_nonzero(table["verdict"] != NOT_DONE))
        super().__init__(f"{done} of {len(table)} rows are answered; continue with table=error.table")
        self.table = table

    def __reduce__(self) -> tuple[type, tuple[Table]]:
        return type(self), (self.table,)  # so that a process pool can pickle the exception


def first_contact_batch(
    moving: Polyhedron,
    fixed: Polyhedron,
    starts: npt.ArrayLike | None = None,
    goals: npt.ArrayLike | None = None,
    *,
    motions: Sequence[Any] | None = None,
    margin: float = 0.0,
    hold: float | None = None,
    time_tolerance: float = 1e-12,
    motion: MotionKind = "screw",
    max_turn: float | None = None,
    find: Find | str = "first",
    threads: int = 0,
    errors: Errors = "raise",
    progress: bool = False,
    table: Table | None = None,
) -> Table:
    """The first contact of many motions of one pair of bodies.

    Each motion goes from its start to its goal, or is one of `motions`. The batch runs without the GIL (Python's global interpreter
    lock). The answers do not depend on the number of threads.

    Parameters
    ----------
    moving, fixed : Polyhedron
    starts, goals : array (n, 4, 4) or (n, 7)
        Poses of the moving body in the frame of the fixed body, in the form that `first_contact` takes.
    motions : list of motions, optional
        Instead of starts and goals: motions of any kinds, such as hinges or a `TimedPoses`.
    margin, hold, time_tolerance, max_turn, find
        As for `first_contact`. A row holds one contact; `first_contact` returns all of them.
    motion : "screw", "sweep", "velocity" or "twist"
        What lies between start and goal. A sweep and a constant velocity have the body's origin on a straight line.
        "velocity" and "twist" have no tau: it is NaN.
    threads : int
        The maximal number of threads; 0 for all cores.
    errors : "raise" or "mark"
        How to treat an invalid pose or motion: "raise" raises InvalidInput with its index before any motion is answered, "mark"
        sets the verdict of its row to "error". The reason is what `first_contact` raises for the motion of this row.
    progress : bool
        Show a progress bar; requires tqdm.
    table : structured array, optional
        The table of an interrupted batch. Rows with the verdict "not_done" are answered in place; other rows stay
        unchanged.

    Returns
    -------
    structured array of n rows
        With the columns of `chasles.table`.

    Raises
    ------
    InvalidInput
        A ValueError. Its message names the input, the place and the reason.
    BatchInterrupted
        A KeyboardInterrupt with the finished rows. After Ctrl-C it is raised within 0.1 seconds plus the time of the
        longest running query.
    """
    rows, of_motions = _motions(starts, goals, motions, motion)
    table = _table_for(table, rows, motion_dtype)
    answer_rows = partial(_core._first_contact_batch, moving, fixed, *of_motions, table, hold=hold, motion=motion)
    options = {"margin": margin, "time_tolerance": time_tolerance, "max_turn": max_turn, "find": find}
    return _run(answer_rows, table, options, threads, errors, progress, "motions")


def least_distance_batch(
    moving: Polyhedron,
    fixed: Polyhedron,
    starts: npt.ArrayLike | None = None,
    goals: npt.ArrayLike | None = None,
    *,
    motions: Sequence[Any] | None = None,
    tolerance: float = 1e-6,
    time_tolerance: float = 1e-12,
    motion: MotionKind = "screw",
    max_turn: float | None = None,
    threads: int = 0,
    errors: Errors = "raise",
    progress: bool = False,
    table: Table | None = None,
) -> Table:
    """How near two bodies come during many motions, when, and where.

    Each motion goes from its start to its goal. The answers do not depend on the number of threads.

    Parameters
    ----------
    moving, fixed : Polyhedron
    starts, goals : array (n, 4, 4) or (n, 7)
        Poses of the moving body in the frame of the fixed body, in the form that `first_contact` takes.
    motions : list of motions, optional
        Instead of starts and goals.
    tolerance, time_tolerance, max_turn
        As for `least_distance`. A row holds one pair of nearest features.
    motion
        As for `first_contact_batch`.
    threads, errors, progress, table
        As for `first_contact_batch`.

    Returns
    -------
    structured array of n rows
        With the columns of `chasles.table`. The verdict is "clear" where the bodies are proven to stay apart,
        "contact" or "contact_at_start" where they are proven to touch, otherwise "unknown".

    Raises
    ------
    InvalidInput, BatchInterrupted
        As for `first_contact_batch`.
    """
    rows, of_motions = _motions(starts, goals, motions, motion)
    table = _table_for(table, rows, least_dtype)
    answer_rows = partial(_core._least_distance_batch, moving, fixed, *of_motions, table, motion=motion)
    options = {"tolerance": tolerance, "time_tolerance": time_tolerance, "max_turn": max_turn}
    return _run(answer_rows, table, options, threads, errors, progress, "motions")


def path_is_clear_batch(
    moving: Polyhedron,
    fixed: Polyhedron,
    paths: npt.ArrayLike | Sequence[npt.ArrayLike],
    *,
    margin: float = 0.0,
    time_tolerance: float = 1e-12,
    max_turn: float = math.pi / 18,
    find: Find | str = "any",
    threads: int = 0,
    errors: Errors = "raise",
    progress: bool = False,
    table: Table | None = None,
) -> Table:
    """Which paths are clear, that is, have no contact on any segment.

    Each segment between two poses is one screw. With the default `find` "any" the answer is yes or no, and the time of
    a contact is the time of any contact on its segment. With `find` "first" it is the first contact of the path.

    Parameters
    ----------
    moving, fixed : Polyhedron
    paths : array (p, n, 4, 4) or (p, n, 7), or a sequence of p arrays (n, 4, 4) or (n, 7)
        Poses of the moving body in the frame of the fixed body. Each path has at least two poses.
    margin, time_tolerance, max_turn, find
        As for `first_contact_on_path`.
    threads, errors, progress, table
        As for `first_contact_batch`.

    Returns
    -------
    structured array of p rows
        With the columns of `chasles.table`. `table["verdict"] == "clear"` selects the paths that are proven clear.
    """
    poses, offsets = _joined(paths)
    table = _table_for(table, len(offsets) - 1, path_dtype)
    answer_rows = partial(_core._path_is_clear_batch, moving, fixed, poses, offsets, table)
    options = {"margin": margin, "time_tolerance": time_tolerance, "max_turn": max_turn, "find": find}
    return _run(answer_rows, table, options, threads, errors, progress, "paths")


def certificate_batch(
    moving: Polyhedron,
    fixed: Polyhedron,
    starts: npt.ArrayLike | None = None,
    goals: npt.ArrayLike | None = None,
    *,
    motions: Sequence[Any] | None = None,
    margin: float = 0.0,
    motion: MotionKind = "screw",
    threads: int = 0,
    errors: Errors = "raise",
) -> list[str | None]:
    """A proof of the first contact of many motions of one pair of bodies: what `FirstContact.certificate` gives for each.

    Parameters
    ----------
    moving, fixed : Polyhedron
    starts, goals : array (n, 4, 4) or (n, 7)
        Poses of the moving body in the frame of the fixed body.
    motions : list of motions, optional
        Instead of starts and goals.
    margin
        As for `first_contact`.
    motion, threads
        As for `first_contact_batch`.
    errors : "raise" or "mark"
        How to treat a row that cannot be certified, or is not proven: "raise" raises InvalidInput with its index and the
        reason, "mark" makes it None.

    Returns
    -------
    list of n str
        For a column of a table, for example.

    Raises
    ------
    InvalidInput
        For bodies that cannot be certified, too.
    """
    rows, (starts, goals, given) = _motions(starts, goals, motions, motion)
    if given is None:
        kinds = {"screw": ScrewMotion, "sweep": SweepMotion, "velocity": ConstantVelocity, "twist": ConstantTwist}
        if motion not in kinds:
            raise InvalidInput(f"motion: {motion!r} must be one of {', '.join(map(repr, kinds))}")
        if starts.ndim < 2 or starts.shape != goals.shape:
            raise InvalidInput(f"starts, goals: have the shapes {starts.shape} and {goals.shape}; both are (n, 4, 4) or (n, 7)")
        given = [_named(i, partial(kinds[motion].between, *ends)) for i, ends in enumerate(zip(starts, goals, strict=True))]
    marks, found = _marks(errors), []
    for i, (text, missing) in enumerate(_core._certificate_batch(moving, fixed, given, margin, _thread_count(threads))):
        if missing and not marks:
            raise InvalidInput(f"motions[{i}]: {missing}")
        found.append(None if missing else text)
    return found


def _named(row: int, make: Callable[[], Any]) -> Any:
    try:
        return make()
    except InvalidInput as error:
        raise InvalidInput(f"motions[{row}]: {error}") from None


def _run(
    answer_rows: Callable[..., None],
    table: Table,
    options: dict[str, Any],
    threads: int,
    errors: Errors,
    progress: bool,
    unit: str,
) -> Table:
    options |= {"threads": _thread_count(threads), "marks_errors": _marks(errors)}
    with _bar(progress, len(table), unit) as bar:
        report = None if bar is None else lambda done: bar.update(done - bar.n)
        try:
            answer_rows(**options, report=report)
        except KeyboardInterrupt:
            raise BatchInterrupted(table) from None
    return table


def _bar(progress: bool, rows: int, unit: str) -> AbstractContextManager[Any]:
    if not progress:
        return nullcontext()
    with extra("progress", "progress"):
        from tqdm.auto import tqdm

    return tqdm(total=rows, unit=f" {unit}")


def _marks(errors: Errors) -> bool:
    if errors not in ("raise", "mark"):
        raise InvalidInput(f"errors: {errors!r}: must be 'raise' or 'mark'")
    return errors == "mark"


def _thread_count(threads: int) -> int:
    if not isinstance(threads, SupportsIndex):
        raise TypeError(f"threads: {threads!r} is not a whole number")
    if index(threads) < 0:
        raise InvalidInput(f"threads: {threads} is negative; 0 means all cores")
    return min(index(threads), 1 << 16)  # more threads than any machine has


def _motions(starts: Any, goals: Any, motions: Any, kind: str) -> tuple[int, tuple[Any, Any, Any]]:
    """The number of rows; and starts and goals as arrays, or motions as a list."""
    if motions is None:
        if starts is None or goals is None:
            raise InvalidInput("starts, goals: both are needed, or motions=[...]")
        starts, goals = array_of(starts, "starts"), array_of(goals, "goals")
        return len(starts) if starts.ndim else 0, (starts, goals, None)
    if starts is not None or goals is not None or kind != "screw":
        raise InvalidInput("motions: stand instead of starts, goals and motion")
    try:
        motions = list(motions)
    except TypeError:
        raise InvalidInput(f"motions: {with_article(motions)} is no list of motions; [motion] is one") from None
    return len(motions), (None, None, motions)


def _table_for(table: Table | None, rows: int, dtype: np.dtype) -> Table:
    if table is None:
        return empty_table(rows, dtype)
    if not isinstance(table, np.ndarray) or table.dtype != dtype or table.shape != (rows,):
        raise InvalidInput(f"table: must have {rows} rows and come from an earlier batch of the same function")
    return table


def _each(paths: Any) -> Iterator[Any]:
    try:
        return iter(paths)
    except TypeError as error:
        raise InvalidInput(f"paths: not a sequence: {error}") from None


def _joined(paths: npt.ArrayLike | Sequence[npt.ArrayLike]) -> tuple[npt.NDArray[Any], npt.NDArray[np.int64]]:
    """The poses of all paths in one array, and the index of each path's first pose, followed by the total number."""
    _core._refuse_masked(paths, "paths")
    if isinstance(paths, np.ndarray) and paths.dtype != object and paths.ndim > 0:
        return _joined_alike(paths)
    arrays = [array_of(path, f"paths[{i}]") for i, path in enumerate(_each(paths))]
    if not arrays:
        return np.empty((0, 7)), np.zeros(1, np.int64)
    for i, path in enumerate(arrays):
        _check_path(path, i)
        if path.shape[1:] != arrays[0].shape[1:]:
            raise InvalidInput(
                f"paths[{i}]: its poses have the shape {path.shape[1:]}, but the first path has {arrays[0].shape[1:]}"
            )
    return np.concatenate(arrays), np.cumsum([0, *map(len, arrays)], dtype=np.int64)


def _joined_alike(paths: npt.NDArray[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[np.int64]]:
    if len(paths) == 0:
        return np.empty((0, 7)), np.zeros(1, np.int64)
    _check_path(paths[0], 0)
    return paths.reshape(-1, *paths.shape[2:]), np.arange(len(paths) + 1, dtype=np.int64) * paths.shape[1]


def _check_path(path: npt.NDArray[Any], i: int) -> None:
    if path.ndim < 2 or path.shape[1:] not in ((7,), (4, 4)):
        raise InvalidInput(
            f"paths[{i}]: the shape is {path.shape}; a path has (n, 4, 4), or (n, 7) for x y z qw qx qy qz"
        )
    if len(path) < 2:
        raise InvalidInput(f"paths[{i}]: at least two poses are needed")
