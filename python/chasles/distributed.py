"""Batches on a Dask cluster: motions from Parquet files, results to Parquet files.

This module requires pyarrow, and Dask for a cluster: ``pip install "chasles[distributed]"``. The workers read the
motions and write the results. Both must therefore be on a file system that all workers share.
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

import pyarrow.compute as pc
import pyarrow.parquet as pq

from ._core import Polyhedron
from .batch import MotionKind, first_contact_batch
from .enums import Find
from .partitions import Partition, answer_partition, manifest_of, motion_files, partitions_of, prepare


@dataclass(frozen=True)
class ParquetRun:
    """The outcome of first_contact_parquet."""

    out: pathlib.Path
    partitions: int  #: number of partitions of the motions
    already_done: int  #: number of partitions that earlier runs finished
    rows: int  #: number of motions in all partitions

    def verdicts(self) -> dict[str, int]:
        """The number of motions for each verdict. Reads the column "verdict" of the results."""
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
    max_turn: float = math.pi / 18,
    find: Find | str = "first",
    threads: int | None = None,
    retries: int = 3,
    progress: bool = False,
) -> ParquetRun:
    """The first contact of many motions of one pair of bodies, from Parquet to Parquet.

    Each row group of the motions is a partition. `first_contact_batch` answers it with ``errors="mark"``, and its
    results become one file in `out`. A run skips the partitions that an earlier run finished, so it resumes a run that
    was interrupted or lost its cluster. A folder with results for other bodies, motions or options is refused. If a
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
        "max_turn": max_turn,
        "find": str(Find(find)) if find in list(Find) else find,
    }
    _check(moving, fixed, options)
    folder = pathlib.Path(out).resolve()
    files = motion_files(motions)
    partitions = partitions_of(files)
    manifest = manifest_of(moving, fixed, files, options)
    prepare(folder, moving, fixed, manifest)
    waiting = [partition for partition in partitions if not (folder / partition.name).exists()]
    digest = json.dumps(manifest)
    with _bar(progress, sum(partition.rows for partition in waiting)) as bar:
        if client is None:
            done = _in_this_process(waiting, (folder, digest, options, threads or 0))
        else:
            done = _on_cluster(client, waiting, (folder, digest, options, threads or 1), retries)
        for rows in done:
            if bar is not None:
                bar.update(rows)
    for unfinished in folder.glob(".part-*"):  # left by workers that were killed
        unfinished.unlink(missing_ok=True)
    return ParquetRun(folder, len(partitions), len(partitions) - len(waiting), sum(p.rows for p in partitions))


def _check(moving: Polyhedron, fixed: Polyhedron, options: dict[str, Any]) -> None:
    """Refuses invalid options before any worker starts, by one query with them."""
    for body in (moving, fixed):
        if not isinstance(body, Polyhedron):
            raise TypeError(f"a {type(body).__name__} is not a chasles.Polyhedron")
    far_away = [[1e20, 0, 0, 1, 0, 0, 0]]
    first_contact_batch(moving, fixed, far_away, far_away, threads=1, **options)


def _in_this_process(partitions: list[Partition], arguments: tuple[Any, ...]) -> Iterator[int]:
    for partition in partitions:
        yield answer_partition(partition, *arguments)


def _on_cluster(client: Any, partitions: list[Partition], arguments: tuple[Any, ...], retries: int) -> Iterator[int]:
    from dask.distributed import as_completed

    folder, digest, options, threads = arguments
    futures = client.map(
        answer_partition,
        partitions,
        out=folder,
        digest=digest,
        options=options,
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


def _bar(progress: bool, rows: int) -> AbstractContextManager[Any]:
    if not progress:
        return nullcontext()
    from tqdm.auto import tqdm

    return tqdm(total=rows, unit=" motions")
