#!/usr/bin/env python3
"""A million motions on a cluster of two workers, with one worker killed, compared with one process.

Usage: million_motions.py MOVING FIXED [--motions N] [--folder FOLDER]

Writes random motions of the pair to Parquet and answers them on two worker processes of one thread each. Kills one
worker with SIGKILL when a third of the partitions is done. Answers the motions again without a cluster and compares the
results row by row. Prints the steps and their times. The exit status is 1 if a row differs.
"""

import argparse
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from dask.distributed import Client, LocalCluster

import chasles
from chasles.distributed import first_contact_parquet
from chasles.partitions import GOAL_COLUMNS, START_COLUMNS

ROWS_IN_PARTITION = 10_000


def write_motions(file: pathlib.Path, fixed: chasles.Polyhedron, count: int) -> None:
    """Starts are random in the box of the fixed body. Goals are a tenth of its size away and turn by about 20 degrees."""
    random = np.random.default_rng(2000)
    lower, upper = fixed.vertices.min(axis=0), fixed.vertices.max(axis=0)
    starts = np.hstack([random.uniform(lower, upper, (count, 3)), random.normal(size=(count, 4))])
    starts[:, 3:] /= np.linalg.norm(starts[:, 3:], axis=1, keepdims=True)
    goals = starts + np.hstack(
        [random.normal(size=(count, 3)) * (upper - lower) / 10, random.normal(size=(count, 4)) * 0.1]
    )
    columns = dict(zip(START_COLUMNS + GOAL_COLUMNS, np.hstack([starts, goals]).T))
    pq.write_table(pa.table(columns), file, row_group_size=ROWS_IN_PARTITION)


def results_in(out: pathlib.Path) -> list[pathlib.Path]:
    return sorted(out.glob("part-*.parquet"))


def kill_after(pid: int, out: pathlib.Path, results: int) -> None:
    while len(results_in(out)) < results:
        time.sleep(0.01)
    os.kill(pid, signal.SIGKILL)
    print(f"killed worker {pid} when {len(results_in(out))} partitions were done", flush=True)


def on_cluster(bodies: tuple, motions: pathlib.Path, out: pathlib.Path, kill_at: int) -> None:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        first = next(iter(client.run(os.getpid).values()))
        threading.Thread(target=kill_after, args=(first, out, kill_at), daemon=True).start()
        begin = time.perf_counter()
        first_contact_parquet(*bodies, motions, out, client=client)
        print(f"two workers, one killed: {time.perf_counter() - begin:.1f} s", flush=True)


def in_one_process(bodies: tuple, motions: pathlib.Path, out: pathlib.Path) -> None:
    begin = time.perf_counter()
    run = first_contact_parquet(*bodies, motions, out)
    print(f"one process, all cores:  {time.perf_counter() - begin:.1f} s; {run.verdicts()}", flush=True)


def differing(one: pathlib.Path, other: pathlib.Path) -> int:
    """The number of partitions that differ in any row."""
    pairs = zip(results_in(one), results_in(other), strict=True)
    return sum(not pq.read_table(first).equals(pq.read_table(second)) for first, second in pairs)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("moving")
    parser.add_argument("fixed")
    parser.add_argument("--motions", type=int, default=1_000_000)
    parser.add_argument("--folder", type=pathlib.Path, help="folder for the files (default: a temporary folder)")
    arguments = parser.parse_args()
    bodies = chasles.load(arguments.moving), chasles.load(arguments.fixed)
    with tempfile.TemporaryDirectory(dir=arguments.folder) as name:
        folder = pathlib.Path(name)
        write_motions(folder / "motions.parquet", bodies[1], arguments.motions)
        partitions = -(-arguments.motions // ROWS_IN_PARTITION)
        on_cluster(bodies, folder / "motions.parquet", folder / "cluster", max(1, partitions // 3))
        in_one_process(bodies, folder / "motions.parquet", folder / "process")
        different = differing(folder / "cluster", folder / "process")
        print(f"{arguments.motions:,} motions in {partitions} partitions; {different} partitions differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
