"""Ctrl-C, in a process of its own: within a second, and nothing that was answered is lost."""

import signal
import subprocess
import sys
import time

import pytest

BATCH = """
import sys, time
import numpy as np
sys.path.insert(0, {tests!r})
import chasles
from cubes import CUBE_FACES, CUBE_VERTICES, random_motions

cube = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
starts, goals = (np.tile(poses, (200, 1)) for poses in random_motions(10_000))
print("ready", flush=True)
try:
    {call}
except chasles.BatchInterrupted as interrupted:
    table = interrupted.table
    done = table["verdict"] != "not_done"
    assert 0 < done.sum() < len(table), done.sum()
    expected = chasles.first_contact_batch(cube, cube, starts[:10_000], goals[:10_000]) if {checks} else None
    for rows in np.split(table, 200) if {checks} else []:
        answered = rows["verdict"] != "not_done"
        for name in ("verdict", "time", "px"):
            np.testing.assert_array_equal(rows[name][answered], expected[name][answered])
    some = table[~done][:5].copy()
    print("interrupted", flush=True)
"""


def interrupted_after(program: str, seconds: float) -> float:
    """How long the program takes to say that it was interrupted."""
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "ready\n", process.stderr.read()
        time.sleep(seconds)
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        answer = process.stdout.readline()
        took = time.monotonic() - sent
        assert answer == "interrupted\n", process.stderr.read()
        assert process.wait(timeout=60) == 0
        return took
    finally:
        process.kill()
        process.communicate()


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("threads", [1, 0])
def test_a_batch_of_motions(threads, request):
    call = f"chasles.first_contact_batch(cube, cube, starts, goals, threads={threads})"
    program = BATCH.format(tests=str(request.path.parent), call=call, checks=threads == 0)
    interrupted_after(program, 1)  # the answers are checked before the word is said


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_it_takes_less_than_a_second(request):
    call = "chasles.first_contact_batch(cube, cube, starts, goals)"
    program = BATCH.format(tests=str(request.path.parent), call=call, checks=False)
    assert min(interrupted_after(program, 0.5) for _ in range(2)) < 1


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_a_batch_of_long_paths(request):
    call = "chasles.path_is_clear_batch(cube, cube, np.stack([starts + [9, 0, 0, 0, 0, 0, 0]] * 40, axis=1)[:60_000])"
    program = BATCH.format(tests=str(request.path.parent), call=call, checks=False)
    interrupted_after(program, 2)
