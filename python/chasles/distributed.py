"""Batches on a Dask cluster: motions or edges of robots from Parquet files, results to Parquet files.

This module requires pyarrow, and Dask for a cluster: ``pip install "chasles[distributed]"``. The workers read the
rows and write the results. Both must therefore be on a file system that all workers share.
"""

import json
import math
import os
import pathlib
from collections import Counter
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

from ._core import Polyhedron, Robot, Scene
from .batch import MotionKind, _thread_count
from .enums import Find
from .extras import extra
from .partitions import UNFINISHED, Partition, answer_partition, files_of, is_done, manifest_of, partitions_of, prepare
from .questions import EdgeQuestion, MotionQuestion, Question

with extra("distributed", "chasles.distributed"):
    import pyarrow.compute as pc
    import pyarrow.parquet as pq


@dataclass(frozen=True)
class ParquetRun:
    """The outcome of first_contact_parquet and of edges_parquet."""

    out: pathlib.Path
    partitions: int  #: number of partitions of the motions or edges
    already_done: int  #: number of partitions that earlier runs finished
    rows: int  #: number of motions or edges in all partitions

    def verdicts(self) -> dict[str, int]:
        """The number of motions or edges for each verdict. Reads the column "verdict" of the results."""
        counts: Counter[str] = Counter()
        for file in sorted(self.out.glob("part-*.parquet")):
            column = pq.read_table(file, columns=["verdict"])["verdict"]
            for entry in pc.value_counts(column).to_pylist():
                counts[entry["values"]] += entry["counts"]
        return dict(counts)


def first_contact_parquet(
    moving: Polyhedron,
    fixed: Polyhedron,
    motions: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    client: Any = None,
    margin: float = 0.0,
    hold: float | None = None,
    time_tolerance: float = 1e-12,
    motion: MotionKind = "screw",
    max_turn: float | None = None,
    find: Find | str = "first",
    threads: int | None = None,
    retries: int = 3,
    progress: bool = False,
) -> ParquetRun:
    """The first contact of many motions of one pair of bodies, from Parquet to Parquet.

    Each row group of the motions is a partition. `first_contact_batch` answers it with ``errors="mark"``, and its
    results become one file in `out`. A run skips the partitions that an earlier run finished, so it resumes a run that
    was interrupted or lost its cluster. A file of results that a crash has damaged is written anew. A folder with
    results for other bodies, motions or options is refused: the results of a partition hold a digest of its rows. If a
    worker is killed, other workers repeat the partitions that it was working on.

    Parameters
    ----------
    moving, fixed : Polyhedron
    motions : file or folder
        Parquet with the columns x0 y0 z0 qw0 qx0 qy0 qz0 (the start), x1 y1 z1 qw1 qx1 qy1 qz1 (the goal), and
        optionally id.
    out : folder
        The folder for the results. They have the columns of `chasles.table`; a missing value is null. The id is the
        motion's id if the motions have one, otherwise the number of the row. ``pyarrow.dataset.dataset(out)`` reads the
        results in the order of the motions.
    client : dask.distributed.Client, optional
        The cluster. Without a client, this process answers all partitions.
    margin, hold, time_tolerance, motion, max_turn, find
        As for `first_contact_batch`.
    threads : int, optional
        Threads per partition. The default is 1 on a cluster, because its workers have several threads, otherwise all
        cores.
    retries : int
        How often a cluster retries a partition that fails. (Dask also repeats a partition whose worker was killed, up
        to Dask's own limit.)
    progress : bool
        Show a progress bar; requires tqdm.
    """
    options = {
        "margin": margin,
        "hold": hold,
        "time_tolerance": time_tolerance,
        "motion": motion,
        "max_turn": math.pi / 18 if max_turn is None and motion == "screw" else max_turn,
        "find": _find_name(find),
    }
    question = MotionQuestion(moving, fixed, options)
    question.check()
    return _run(question, motions, out, _Workers(client, threads, retries, progress))


def edges_parquet(
    robot: Robot,
    edges: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    scene: Scene | None = None,
    client: Any = None,
    margin: float = 0.0,
    time_tolerance: float = 1e-12,
    find: Find | str = "first",
    threads: int | None = None,
    retries: int = 3,
    progress: bool = False,
) -> ParquetRun:
    """The first contact of a robot along many straight edges, from Parquet to Parquet.

    Row groups, results, interruptions and clusters are treated as by `first_contact_parquet`. The robot with all its
    changes and the scene are sent to the workers, which need no files of them. Bodies of a scene that move by anything
    but poses, ConstantVelocity or ConstantTwist cannot be sent.

    Parameters
    ----------
    robot : Robot
    edges : file or folder
        Parquet with the columns start_NAME and goal_NAME for each variable of the robot (radians, or the mesh unit), and
        optionally id. `chasles.questions.edge_columns` gives their names.
    out : folder
        The folder for the results. They have the columns id, verdict, time, time_upper, clear_until, certain, first and
        second of `first_contacts_on_edges`; a missing value is null. The verdict is "error" for an edge that cannot be
        used. The id is the edge's id if the edges have one, otherwise the number of the row.
    scene : Scene, optional
        The world; without it the robot is tested against itself only.
    margin, time_tolerance, find
        As for `RobotChecker`.
    client, threads, retries, progress
        As for `first_contact_parquet`.
    """
    options = {"margin": margin, "time_tolerance": time_tolerance, "find": _find_name(find)}
    question = EdgeQuestion(robot, scene, options)
    question.check()
    return _run(question, edges, out, _Workers(client, threads, retries, progress))


def _find_name(find: Find | str) -> str:
    return str(Find(find)) if find in list(Find) else find


@dataclass(frozen=True)
class _Workers:
    """Who answers, and how."""

    client: Any
    threads: int | None
    retries: int
    progress: bool

    def answer(self, partitions: list[Partition], folder: pathlib.Path, digest: str) -> Iterator[int]:
        if self.client is None:
            return _in_this_process(partitions, (folder, digest, self.threads or 0))
        return _on_cluster(self.client, partitions, (folder, digest, self.threads or 1), self.retries)


def _run(
    question: Question, rows: str | os.PathLike[str], out: str | os.PathLike[str], workers: _Workers
) -> ParquetRun:
    _thread_count(workers.threads or 0)
    folder = pathlib.Path(out).resolve()
    files = files_of(rows, question)
    partitions = partitions_of(files, question)
    manifest = manifest_of(question, files)
    prepare(folder, question, manifest)
    waiting = [partition for partition in partitions if not is_done(partition, folder, question)]
    finished = len(partitions) - len(waiting)
    with _bar(workers.progress, sum(partition.rows for partition in waiting), question.rows) as bar:
        try:
            for done in workers.answer(waiting, folder, json.dumps(manifest)):
                finished += 1
                if bar is not None:
                    bar.update(done)
        except KeyboardInterrupt:  # not the table of one partition, which is lost
            raise KeyboardInterrupt(
                f"{finished} of {len(partitions)} partitions are finished; the same call again answers the others"
            ) from None
    for file in folder.iterdir():
        if file.name.startswith(UNFINISHED):  # left by workers that were killed
            file.unlink(missing_ok=True)
    return ParquetRun(folder, len(partitions), len(partitions) - len(waiting), sum(p.rows for p in partitions))


def _in_this_process(partitions: list[Partition], arguments: tuple[Any, ...]) -> Iterator[int]:
    for partition in partitions:
        yield answer_partition(partition, *arguments)


def _on_cluster(client: Any, partitions: list[Partition], arguments: tuple[Any, ...], retries: int) -> Iterator[int]:
    from dask.distributed import as_completed

    folder, digest, threads = arguments
    futures = client.map(
        answer_partition,
        partitions,
        out=folder,
        digest=digest,
        threads=threads,
        retries=retries,
        pure=False,
    )
    try:
        for future in as_completed(futures):
            yield future.result()
            future.release()  # frees memory of the cluster; the file records that the partition is done
    finally:
        client.cancel(futures)  # has no effect if all futures are done


def _bar(progress: bool, rows: int, unit: str) -> AbstractContextManager[Any]:
    if not progress:
        return nullcontext()
    with extra("progress", "progress"):
        from tqdm.auto import tqdm

    return tqdm(total=rows, unit=f" {unit}")
