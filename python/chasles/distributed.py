"""Batches beyond one machine: motions from Parquet files, results to Parquet files, over a Dask cluster.

Needs pyarrow, and Dask for a cluster: ``pip install "chasles[distributed]"``. Workers read the motions and write the
results themselves, so both have to be on a file system that all of them see.
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

from ._core import Polyhedron, first_contact
from .enums import Find
from .partitions import Partition, answer_partition, manifest_of, motion_files, partitions_of, prepare


@dataclass(frozen=True)
class ParquetRun:
    """What first_contact_parquet did."""

    out: pathlib.Path
    partitions: int  #: of the motions
    already_done: int  #: by earlier runs
    rows: int  #: motions in all partitions

    def verdicts(self) -> dict[str, int]:
        """How many motions have which verdict; reads that column of the results."""
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
    max_turn: float = math.pi / 18,
    find: Find | str = "first",
    threads: int | None = None,
    retries: int = 3,
    progress: bool = False,
) -> ParquetRun:
    """The first contact of many motions of one pair of bodies, from Parquet to Parquet.

    Each row group of the motions is a partition, answered as by `first_contact_batch` with ``errors="mark"`` and
    written to a file of its own in `out`. Partitions that are there from an earlier run are not done again, so that a run that
    was interrupted, or lost its cluster, goes on where it was; results of another question are refused. A worker that
    is killed loses at most the partitions that it was at, which other workers do again.

    Parameters
    ----------
    moving, fixed : Polyhedron
    motions : file or folder
        Parquet with the columns x0 y0 z0 qw0 qx0 qy0 qz0 x1 y1 z1 qw1 qx1 qy1 qz1, start and goal, and perhaps id.
    out : folder
        Where the results go: the columns of `chasles.table`, with null for what an answer does not have. The id is that
        of the motion, or else the number of its row. ``pyarrow.dataset.dataset(out)`` reads them in the order of the
        motions.
    client : dask.distributed.Client, optional
        The cluster; without one, this process does all.
    margin, hold, time_tolerance, max_turn, find
        As for `first_contact_batch`.
    threads : int, optional
        For one partition. By default 1 on a cluster, whose workers have threads of their own, else all cores.
    retries : int
        How often a partition that fails is tried again on a cluster. (A partition whose worker was killed is done again
        in any case, unless it takes more workers down than Dask allows.)
    progress : bool
        Show a bar; needs tqdm.
    """
    options = {
        "margin": margin,
        "hold": hold,
        "time_tolerance": time_tolerance,
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
            done = _here(waiting, (folder, digest, options, threads or 0))
        else:
            done = _on_cluster(client, waiting, (folder, digest, options, threads or 1), retries)
        for rows in done:
            if bar is not None:
                bar.update(rows)
    for unfinished in folder.glob(".part-*"):  # of workers that were killed
        unfinished.unlink(missing_ok=True)
    return ParquetRun(folder, len(partitions), len(partitions) - len(waiting), sum(p.rows for p in partitions))


def _check(moving: Polyhedron, fixed: Polyhedron, options: dict[str, Any]) -> None:
    """Options out of their range are refused here, not by every worker."""
    for body in (moving, fixed):
        if not isinstance(body, Polyhedron):
            raise TypeError(f"a {type(body).__name__} is no chasles.Polyhedron")
    nowhere = [1e20, 0, 0, 1, 0, 0, 0]
    first_contact(moving, fixed, nowhere, nowhere, **options)


def _here(partitions: list[Partition], how: tuple[Any, ...]) -> Iterator[int]:
    for partition in partitions:
        yield answer_partition(partition, *how)


def _on_cluster(client: Any, partitions: list[Partition], how: tuple[Any, ...], retries: int) -> Iterator[int]:
    from dask.distributed import as_completed

    folder, digest, options, threads = how
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
            future.release()  # the cluster need not remember that it is done: the file does
    finally:
        client.cancel(futures)  # nothing to cancel once all are done


def _bar(progress: bool, rows: int) -> AbstractContextManager[Any]:
    if not progress:
        return nullcontext()
    from tqdm.auto import tqdm

    return tqdm(total=rows, unit=" motions")
