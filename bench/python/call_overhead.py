#!/usr/bin/env python3
"""The overhead of a query from Python over the C++ query, and of a batch from Python over the C++ batch.

Usage: call_overhead.py. Python and C++ take turns. The minimum of the times counts, because noise only adds time. This
is not a test: the times depend on the machine and on its other work.
"""

import time

import numpy as np

import chasles
from chasles import _core

VERTICES = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], np.float64)
FACES = np.array([[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
ROUNDS = 7


def matrix(numbers: np.ndarray) -> np.ndarray:
    motion = chasles.ScrewMotion.between(numbers, numbers)
    return motion.pose_at(0)


def seconds_of(work, times: int = 1) -> float:
    begin = time.perf_counter()
    for _ in range(times):
        work()
    return time.perf_counter() - begin


def call(name: str, cube: chasles.Polyhedron, start: np.ndarray, goal: np.ndarray, times: int) -> None:
    find = "first"
    python, cpp = [], []
    for _ in range(ROUNDS):
        python.append(seconds_of(lambda: chasles.first_contact(cube, cube, start, goal), times) / times)
        cpp.append(_core._query_seconds(cube, cube, start, goal, find, times) / times)
    overhead = min(python) - min(cpp)
    print(
        f"{name:36} C++ {min(cpp) * 1e6:7.3f} us, Python {min(python) * 1e6:7.3f} us, overhead {overhead * 1e6:6.3f} us"
    )


def batch(cube: chasles.Polyhedron, starts: np.ndarray, goals: np.ndarray, threads: int) -> None:
    python, cpp = [], []
    for _ in range(ROUNDS):
        python.append(seconds_of(lambda: chasles.first_contact_batch(cube, cube, starts, goals, threads=threads)))
        cpp.append(_core._batch_seconds(cube, cube, starts, goals, threads))
    name = f"batch of {len(starts):,}, {threads or 'all'} threads, {'x'.join(map(str, starts.shape[1:]))}"
    print(
        f"{name:36} C++ {min(cpp) * 1e3:7.2f} ms, Python {min(python) * 1e3:7.2f} ms, ratio {min(python) / min(cpp):.3f}"
    )


def main() -> None:
    cube = chasles.Polyhedron(VERTICES, FACES)
    random = np.random.default_rng(1)
    starts = np.zeros((10_000, 7))
    starts[:, 0], starts[:, 1:3], starts[:, 3] = 3, random.uniform(-1, 1, (10_000, 2)), 1
    goals = starts.copy()
    goals[:, 0], goals[:, 3:] = -1, random.normal(size=(10_000, 4))
    far = starts[0] + [9, 0, 0, 0, 0, 0, 0]
    call("far apart, (7,)", cube, starts[0], far, 50_000)
    call("far apart, (4, 4)", cube, matrix(starts[0]), matrix(far), 50_000)
    call("far apart, (4, 4) of float32", cube, *(matrix(p).astype(np.float32) for p in (starts[0], far)), 20_000)
    call("contact, (7,)", cube, starts[0], goals[0], 5_000)
    starts_as_matrices, goals_as_matrices = (np.stack([matrix(p) for p in poses]) for poses in (starts, goals))
    for threads in (1, 0):
        batch(cube, starts, goals, threads)
        batch(cube, starts_as_matrices, goals_as_matrices, threads)


if __name__ == "__main__":
    main()
