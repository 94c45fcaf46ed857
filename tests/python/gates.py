"""Threads that are held inside of a question, by functions of a trajectory or of progress: no test depends on times."""

import contextlib
import threading

import chasles


class Gate:
    """Holds the threads that come to it until it is opened."""

    def __init__(self):
        self.came, self.open = threading.Event(), threading.Event()

    def wait(self):
        self.came.set()
        assert self.open.wait(60)

    def pose_at(self, time):
        self.wait()
        return [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0]

    def trajectory(self):
        bounds = {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0}
        closed = self.open.is_set()
        self.open.set()  # while the motion is made
        own = chasles.Trajectory(self.pose_at, lambda start, end: bounds)
        if not closed:
            self.open.clear()
            self.came.clear()
        return own


def started(ask, answers):
    """A thread that adds its answer, or its error."""

    def run():
        try:
            answers.append(ask())
        except Exception as error:
            answers.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    return thread


@contextlib.contextmanager
def held(gate, ask):
    """While another thread asks, inside of its question. Yields a list, which has the answer afterwards."""
    answers: list = []
    thread = started(ask, answers)
    try:
        assert gate.came.wait(60), "the question has to come to the gate"
        yield answers
    finally:
        gate.open.set()
        thread.join()


def both_at_once(barrier, ask):
    """Two threads, each of which waits for the other one inside of its question."""
    answers: list = []
    for thread in [started(ask, answers) for _ in range(2)]:
        thread.join()
    assert not barrier.broken, "the questions do not run at the same time"
    return answers
