"""Ctrl-C in a separate process: it takes effect within a second, and no finished row is lost."""

import pickle
import signal
import subprocess
import sys
import time

import pytest

import chasles

BATCH = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it
import numpy as np
sys.path.insert(0, {tests!r})
import chasles
from cubes import CUBE_FACES, CUBE_VERTICES, random_motions

cube = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
starts, goals = (np.tile(poses, (100, 1)) for poses in random_motions(10_000))
table = chasles.empty_table(len(starts))
{prepare}
print("ready", flush=True)
try:
    {call}
except chasles.BatchInterrupted as interrupted:
    table = interrupted.table
    done = table["verdict"] != "not_done"
    if not done.any():
        print("too early", flush=True)
        raise SystemExit
    assert not done.all()
    expected = chasles.first_contact_batch(cube, cube, starts[:10_000], goals[:10_000]) if {checks} else None
    for rows in np.split(table, 100) if {checks} else []:
        answered = rows["verdict"] != "not_done"
        for name in ("verdict", "time", "px"):
            np.testing.assert_array_equal(rows[name][answered], expected[name][answered])
    print("interrupted", flush=True)  # once the answers are checked, where they are
"""


def program_for(request: pytest.FixtureRequest, call: str, checks: bool = False, prepare: str = "") -> str:
    return BATCH.format(tests=str(request.path.parent), call="chasles." + call, checks=checks, prepare=prepare)


def interrupted_after(program: str, seconds: float) -> float:
    """Runs the program and interrupts it. Returns the time until it reports the interruption, in seconds."""
    while seconds < 100:
        answer, took = output_when_interrupted_after(program, seconds)
        if answer != "too early\n":
            break
        seconds *= 3
    assert answer == "interrupted\n"
    return took


def output_when_interrupted_after(program: str, seconds: float) -> tuple[str, float]:
    process = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout.readline() == "ready\n", process.stderr.read()
        time.sleep(seconds)
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        answer = process.stdout.readline()
        took = time.monotonic() - sent
        assert process.wait(timeout=60) == 0, process.stderr.read()
        return answer, took
    finally:
        process.kill()
        process.communicate()


def test_what_was_interrupted_can_leave_its_process():
    table = chasles.empty_table(3)
    table["verdict"][0] = "clear"
    again = pickle.loads(pickle.dumps(chasles.BatchInterrupted(table)))
    assert str(again).startswith("1 of 3") and (again.table["verdict"] == table["verdict"]).all()


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
@pytest.mark.parametrize("threads", [1, 0])
def test_a_batch_of_motions(threads, request):
    interrupted_after(
        program_for(request, f"first_contact_batch(cube, cube, starts, goals, threads={threads}, table=table)", True), 1
    )


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_it_takes_less_than_a_second(request):
    program = program_for(request, "first_contact_batch(cube, cube, starts, goals, table=table)")
    assert any(interrupted_after(program, 0.5) < 1 for _ in range(5))  # other programs may delay it


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_a_batch_of_least_distances(request):
    prepare = "table = chasles.empty_table(len(starts), chasles.least_dtype)"
    call = "least_distance_batch(cube, cube, starts, goals, table=table)"
    interrupted_after(program_for(request, call, prepare=prepare), 0.5)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_a_batch_of_long_paths(request):
    prepare = "paths = np.tile([[3, 1.6, 0, 1, 0, 0, 0], [-1, 1.6, 0, 0.9, 0.3, 0.1, 0.2]], (50_000, 20, 1))"
    interrupted_after(program_for(request, "path_is_clear_batch(cube, cube, paths)", prepare=prepare), 0.3)
