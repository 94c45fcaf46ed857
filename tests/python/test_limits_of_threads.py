"""A limit is of one thread, a memory of one question at a time: what breaks this is one error, never a crash."""

import threading

import pytest
from cubes import pose
from gates import Gate, held

import chasles

ORIGIN = pose(0, 0, 0)


def test_a_memory_cannot_be_used_by_the_question_that_has_it(cube):
    memory = chasles.PairMemory(cube, cube)
    far = pose(9, 0, 0)

    def pose_at(time):
        chasles.first_contact(cube, cube, far, far, memory=memory)
        return [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0]

    gate = Gate()
    own = chasles.Trajectory(
        lambda time: pose_at(time) if gate.open.is_set() else [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0],
        lambda start, end: {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0},
    )
    gate.open.set()
    has_it = pytest.raises(chasles.InvalidInput, match="memory: the question around this call has it")
    with has_it, chasles.Limit(20):  # it would wait for itself
        chasles.first_contact(cube, cube, motion=own, margin=0.1, memory=memory)
    gate.open.clear()
    assert chasles.first_contact(cube, cube, motion=own, margin=0.1, memory=memory).verdict == "contact"


def test_a_limit_ends_the_wait_for_a_memory(cube):
    memory = chasles.PairMemory(cube, cube)
    gate = Gate()
    own = gate.trajectory()
    with held(gate, lambda: chasles.first_contact(cube, cube, motion=own, memory=memory)) as answers:
        with pytest.raises(chasles.Cancelled), chasles.Limit(0.1):
            chasles.first_contact(cube, cube, ORIGIN, ORIGIN, memory=memory)
    assert answers[0].verdict == "contact"


def is_limited(cube):
    """Whether questions of this thread reach a limit."""
    return chasles.first_contact_batch(cube, cube, [ORIGIN], [ORIGIN])["verdict"][0] == "not_done"


def test_limits_end_in_the_opposite_order(cube):
    outer, inner = chasles.Limit(1e-9), chasles.Limit(100)
    outer.__enter__()
    inner.__enter__()
    with pytest.raises(chasles.InvalidInput, match="limit: ends before a limit that began inside of it"):
        outer.__exit__(None, None, None)
    inner.__exit__(None, None, None)
    assert not is_limited(cube)


def test_a_limit_of_a_generator_ends_with_it(cube):
    def limited():
        with chasles.Limit(1e-9):
            yield is_limited(cube)

    generator = limited()
    assert next(generator)
    with chasles.Limit(100):
        with pytest.raises(chasles.InvalidInput, match="limit: ends before"):
            generator.close()
        assert is_limited(cube)  # as the message says
    assert not is_limited(cube)


def test_a_limit_is_of_one_thread(cube):
    limit = chasles.Limit(1e-9)
    limits, step = [limit], [threading.Event(), threading.Event()]
    seen = []

    def other():
        limits[0].__enter__()
        step[0].set()
        assert step[1].wait(60)
        seen.append(is_limited(cube))
        with chasles.Limit(100):
            seen.append(is_limited(cube))

    thread = threading.Thread(target=other)
    thread.start()
    assert step[0].wait(60)
    assert not limit.is_over and not is_limited(cube)
    with pytest.raises(chasles.InvalidInput, match="limit: ends in another thread than it began in"):
        limit.__exit__(None, None, None)
    limits.clear()
    del limit
    step[1].set()
    thread.join()
    assert seen == [True, False] and not is_limited(cube)
