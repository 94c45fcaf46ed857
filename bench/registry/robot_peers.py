#!/usr/bin/env python3
"""Edges of robots: Chasles beside Coal with Pinocchio, hpp-core and VAMP.

Usage: robot_peers.py [FOLDER]   where `planning_bench FOLDER` wrote edges.csv: without it, random edges only

Each answer of Chasles is judged by Coal at 2,000 samples of the edge, and shortly after a contact. A contradiction ends
the program with exit status 1. Times are of the processor. docs/decisions/0040-peers.md says how each peer is called.
"""

import csv
import dataclasses
import pathlib
import sys
import time
import typing

import hpp_robot

hpp_robot.with_library_path()

import coal_robot  # noqa: E402
import numpy as np  # noqa: E402
import robot_worlds  # noqa: E402
import vamp_robot  # noqa: E402

import chasles  # noqa: E402

JUDGED_SAMPLES = 2000
AFTER_CONTACT = (1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2)  # of the edge
RUNS = 3
VAMP_LIBRARY = pathlib.Path(sys.prefix).parent / "libvamp_panda.so"

Ask = typing.Callable[[np.ndarray, np.ndarray], tuple[bool, float]]


@dataclasses.dataclass
class Row:
    """One peer on edges of one kind."""

    seconds: list[float] = dataclasses.field(default_factory=list)
    of_clear: list[float] = dataclasses.field(default_factory=list)
    missed: int = 0
    false_alarms: int = 0
    absent: str = ""

    def add(self, is_clear: bool, truth: bool, seconds: float) -> None:
        self.seconds.append(seconds)
        if truth:
            self.of_clear.append(seconds)
        self.missed += is_clear and not truth
        self.false_alarms += truth and not is_clear


class Contradiction(Exception):
    pass


class Worlds:
    """One world at a time, with everybody's model of it."""

    def __init__(self, world: robot_worlds.World):
        self.robot = world.robot.load()
        self.checker = chasles.RobotChecker(self.robot, world.scene())
        inside = dataclasses.replace(world, cylinders_inside=True)
        self.checker_inside = chasles.RobotChecker(self.robot, inside.scene())
        self.coal = coal_robot.CoalRobot(robot_worlds.urdf_with_world(world), self.robot)
        self.asks: dict[str, Ask | str] = {
            "chasles, is_clear": self.chasles_is_clear,
            "chasles, first_contact": self.chasles_first_contact,
            "Coal, samples at 1 %": lambda s, g: self.coal.timed(s, g, 0.01),
            "Coal, samples at 0.1 %": lambda s, g: self.coal.timed(s, g, 0.001),
            **self.hpp(world),
            "VAMP": self.vamp(world),
        }

    def chasles_is_clear(self, start: np.ndarray, goal: np.ndarray) -> tuple[bool, float]:
        began = time.process_time()
        answer = self.checker.is_clear(start, goal)
        return answer, time.process_time() - began

    def chasles_first_contact(self, start: np.ndarray, goal: np.ndarray) -> tuple[bool, float]:
        began = time.process_time()
        answer = self.checker.first_contact(start, goal)
        return answer.verdict == "clear", time.process_time() - began

    def hpp(self, world: robot_worlds.World) -> dict[str, Ask | str]:
        kinds = {"hpp, Dichotomy": ("Dichotomy", 0.0), "hpp, Progressive, 1 mm": ("Progressive", 1e-3)}
        try:
            robot = hpp_robot.HppRobot(world, self.coal.file)
        except (ImportError, RuntimeError) as error:
            return dict.fromkeys(kinds, str(error))
        if robot.pairs() != len(self.coal.geometry.collisionPairs):
            return dict.fromkeys(kinds, "tests other pairs")
        self.hpp_robot = robot  # owns what the validators use
        return {name: robot.validator(*kind) for name, kind in kinds.items()}

    def vamp(self, world: robot_worlds.World) -> Ask | str:
        if world.robot is not robot_worlds.PANDA:
            return "has no such robot"
        try:
            return vamp_robot.VampRobot(vamp_robot.library(VAMP_LIBRARY), world).ask
        except OSError as error:
            return str(error)

    def truth(self, start: np.ndarray, goal: np.ndarray) -> bool:
        """Whether the edge is clear, if Chasles and Coal agree."""
        found = self.checker.first_contact(start, goal)
        is_clear = found.verdict == "clear"
        if self.checker.is_clear(start, goal) != is_clear:
            raise Contradiction(f"is_clear and first_contact: {start.tolist()} to {goal.tolist()}")
        way = goal - start
        until = 1.0 if is_clear else found.clear_until
        for part in np.linspace(0, 1, JUDGED_SAMPLES + 1):
            if part < until and self.coal.surely_collides(start + part * way):
                raise Contradiction(f"Coal collides at {part!r}, before {found}: {start.tolist()} to {goal.tolist()}")
        after = [found.time_upper + part for part in AFTER_CONTACT if found.time_upper + part <= 1]
        if not is_clear and after and not any(self.coal.collides(start + part * way) for part in after):
            raise Contradiction(f"Coal does not collide after {found}: {start.tolist()} to {goal.tolist()}")
        return is_clear

    def random_edges(self, random: np.random.Generator, count: int) -> list[tuple[np.ndarray, np.ndarray]]:
        """From free configurations within the limits; 1 rad in all joints together."""
        lower, upper = self.robot.limits.T
        edges = []
        while len(edges) < count:
            start = random.uniform(lower, upper)
            way = random.uniform(lower, upper) - random.uniform(lower, upper)
            if self.checker.is_clear(start):
                edges.append((start, start + way / np.abs(way).sum()))
        return edges


    def judged(self, name: str, is_clear: bool, truth: bool, edge: tuple[np.ndarray, np.ndarray]) -> bool:
        """The truth about what this peer was given: VAMP's cylinders are thinner than our prisms."""
        return self.checker_inside.is_clear(*edge) if name == "VAMP" and is_clear and not truth else truth


class World(typing.Protocol):
    """What a race asks about. `asks` has a reason in place of a peer that is absent."""

    asks: dict[str, Ask | str]

    def truth(self, start: np.ndarray, goal: np.ndarray) -> bool: ...
    def judged(self, name: str, is_clear: bool, truth: bool, edge: tuple[np.ndarray, np.ndarray]) -> bool: ...


def race(rows: dict[str, Row], world: World, edges: list[tuple[np.ndarray, np.ndarray]]) -> None:
    for start, goal in edges:
        truth = world.truth(start, goal)
        for name, ask in world.asks.items():
            row = rows.setdefault(name, Row())
            if isinstance(ask, str):
                row.absent = ask
                continue
            answers = [ask(start, goal) for _ in range(RUNS)]
            is_clear = answers[0][0]
            judged = world.judged(name, is_clear, truth, (start, goal))
            row.add(is_clear, judged, float(np.median([seconds for _, seconds in answers])))


def report(title: str, rows: dict[str, Row]) -> None:
    ours = rows["chasles, is_clear"]
    print(f"\n{title}: {len(ours.seconds)} edges, {len(ours.of_clear)} of them clear; microseconds")
    print(f"{'':24} {'median':>9} {'clear':>9} {'mean':>9} {'slowest':>9} {'missed':>7} {'false alarms':>13}")
    for name, row in rows.items():
        if row.absent:
            print(f"{name:24} absent: {row.absent}")
            continue
        times = [np.median(row.seconds), np.median(row.of_clear or [np.nan]), np.mean(row.seconds), max(row.seconds)]
        print(f"{name:24} " + " ".join(f"{1e6 * t:9.1f}" for t in times) + f" {row.missed:7} {row.false_alarms:13}")
    sys.stdout.flush()


def planner_edges(folder: pathlib.Path) -> dict[str, list[tuple[np.ndarray, np.ndarray]]]:
    """Of OMPL's RRT-Connect with its own validator at 1 %, by problem."""
    edges: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    with open(folder / "edges.csv", newline="") as file:
        for problem, validator, *numbers in csv.reader(file):
            if "at 1 %" in validator:
                values = np.array(numbers, float)
                edges.setdefault(problem, []).append((values[:7], values[7:]))
    return edges


def main(arguments: list[str]) -> int:
    if not robot_worlds.PANDA.urdf.exists():
        print("skipped: no folder robots/panda of real inputs")
        return 0
    random = np.random.default_rng(20)
    of_planner = planner_edges(pathlib.Path(arguments[0])) if arguments else {}
    at_random: dict[str, Row] = {}
    planned: dict[str, Row] = {}
    for name in robot_worlds.problem_names()[::8]:
        worlds = Worlds(robot_worlds.problem(name))
        race(at_random, worlds, worlds.random_edges(random, 6))
        race(planned, worlds, [edge for edge in of_planner.get(name, []) if worlds.checker.is_clear(edge[0])][:6])
    print(f"Python's share of a sample of Coal: {1e6 * worlds.coal.overhead():.1f} us")
    report("Panda in the worlds of its planning problems, random edges of 1 rad in all joints together", at_random)
    if planned:
        report("Panda in the same worlds, edges that OMPL's RRT-Connect asks for", planned)
    abb: dict[str, Row] = {}
    for seed in range(10):
        worlds = Worlds(robot_worlds.boxes_around_abb(seed))
        race(abb, worlds, worlds.random_edges(random, 20))
    report("irb2400 among 12 boxes, random edges of 1 rad in all joints together", abb)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except Contradiction as found:
        print(f"contradiction: {found}", file=sys.stderr)
        sys.exit(1)
