#!/usr/bin/env python3
"""How long a gate for policies takes: chunks of 50 actions of an arm of seven joints among 20 bodies, on one core.

Usage: policy_gate.py [--chunks N] [--robot URDF --srdf SRDF --packages NAME=FOLDER]

Without a robot file the arm of tests/python/seven_joints.py is asked, whose links are capsules and boxes. For each mode it
prints the processor time and the wall time of a decision (median, 99 %, longest), and the share of chunks that is decided
within 5 ms of each. Then the same chunks with the budget of 5 ms: the share that runs out of it, and the wall time. Half of
the chunks, or more, come within the margin of something. This is not a test: the times depend on the machine and on its
other work.
"""

import argparse
import os
import pathlib
import sys
import time

import numpy as np

import chasles
from chasles.policy import PolicyGate

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tests" / "python"))
from seven_joints import arm, chunk, clear_configuration, world  # noqa: E402

MARGIN, BUDGET, UNLIMITED = 0.005, 5.0, 1e6  # metres, milliseconds
MODES = [
    ("refuse", {}),
    ("shorten", {}),
    ("shorten, spline", {"interpolation": "natural_spline"}),
    ("scale", {"full_speed_from": 0.1}),
]


def chunks(robot: chasles.Robot, count: int):
    """Scenes with present configurations and chunks."""
    random = np.random.default_rng(46)
    for _ in range((count + 19) // 20):
        scene = world(random)
        checker = chasles.RobotChecker(robot, scene, margin=MARGIN)
        starts = [clear_configuration(robot, checker, random) for _ in range(20)]
        yield scene, [(start, chunk(robot, random, start)) for start in starts]


def line(name: str, times: list[float]) -> str:
    median, most, longest = np.percentile(times, [50, 99, 100])
    within = np.mean(np.array(times) <= BUDGET)
    return f"  {name:26} median {median:6.2f}  99 % {most:6.2f}  longest {longest:6.2f} ms; within {BUDGET:g} ms: {within:.1%}"


def measure(name: str, options: dict, cases: list) -> None:
    processor, wall, limited, made, late, verdicts = [], [], [], [], 0, {}
    for scene, pairs in cases:
        mode = name.split(",")[0]
        free = PolicyGate(robot, scene, margin=MARGIN, mode=mode, milliseconds=UNLIMITED, **options)
        gate = PolicyGate(robot, scene, margin=MARGIN, mode=mode, milliseconds=BUDGET, **options)
        begin = time.process_time()
        gate.set_scene(scene)
        made.append(1000 * (time.process_time() - begin))
        for start, actions in pairs:
            begin = time.process_time()
            decision = free(start, actions)
            processor.append(1000 * (time.process_time() - begin))
            wall.append(decision.milliseconds)
            verdicts[decision.verdict] = verdicts.get(decision.verdict, 0) + 1
            decision = gate(start, actions)
            limited.append(decision.milliseconds)
            late += decision.reason.startswith("not proven")
    print(f"{name}: {len(wall)} chunks, {verdicts}; set_scene takes {np.median(made):.2f} ms (median)")
    print(line("no budget, processor time", processor))
    print(line("no budget, wall time", wall))
    print(line(f"budget {BUDGET:g} ms, wall time", limited), f"not decided: {late / len(limited):.1%}")


def main() -> None:
    global robot
    parser = argparse.ArgumentParser()
    parser.add_argument("--chunks", type=int, default=1000)
    parser.add_argument("--robot")
    parser.add_argument("--srdf")
    parser.add_argument("--packages", default="")
    arguments = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    packages = dict([arguments.packages.split("=")]) if arguments.packages else {}
    robot = chasles.Robot.load(arguments.robot, arguments.srdf, packages) if arguments.robot else arm()
    base = next(link for link in robot.links if robot.collisions(link))
    robot.ignore_in_scene(base, "table")
    cases = list(chunks(robot, arguments.chunks))
    for name, options in MODES:
        measure(name, options, cases)


if __name__ == "__main__":
    main()
