#!/usr/bin/env python3
"""How many planned paths of the Panda collide as planned, and how many only as executed?

Usage: executed_paths.py FOLDER [PROBLEMS]

`planning_bench FOLDER` wrote paths.csv there; the page of a path comes there, too. Paths of OMPL's RRT-Connect (proven, and
with its own validator) and of VAMP: straight edges as planned, then TOPP-RA's splines and Ruckig's steps. Coal tests 500
samples of each motion. A contradiction to Chasles ends the program with exit status 1.
"""

import csv
import dataclasses
import pathlib
import sys

import coal_robot
import executed
import numpy as np
import robot_peers
import robot_worlds
import vamp_robot

import chasles

SAMPLES = 500
AFTER_CONTACT = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2)  # units of time
SPACING = 0.1


@dataclasses.dataclass
class Count:
    paths: int = 0
    touch_as_planned: int = 0
    executed: dict[str, int] = dataclasses.field(default_factory=dict)  # of those that are clear as planned
    touch: dict[str, int] = dataclasses.field(default_factory=dict)
    untimed: dict[str, int] = dataclasses.field(default_factory=dict)


class Judge:
    """Asks Chasles, and holds Coal's samples against it."""

    def __init__(self, world: robot_worlds.World):
        self.robot = world.robot.load()
        self.scene = world.scene()
        self.checker = chasles.RobotChecker(self.robot, self.scene)
        self.coal = coal_robot.CoalRobot(robot_worlds.urdf_with_world(world), self.robot)

    def is_clear(self, path: chasles.JointPath) -> bool:
        found = self.checker.first_contact_on_path(path)
        is_clear = found.verdict == "clear"
        begin, end = path.times[0], path.times[-1]
        until = end if is_clear else found.clear_until
        for time in np.linspace(begin, end, SAMPLES):
            if time < until and self.coal.surely_collides(path.at(time)):
                raise robot_peers.Contradiction(f"Coal collides at {time!r}, before {found}")
        after = [found.time_upper + part for part in AFTER_CONTACT if found.time_upper + part <= end]
        if not is_clear and after and not any(self.coal.collides(path.at(time)) for time in after):
            raise robot_peers.Contradiction(f"Coal does not collide after {found}")
        return is_clear


def motions(robot: chasles.Robot, path: np.ndarray) -> dict[str, chasles.JointPath | None]:
    return {
        "TOPP-RA through the path's points": executed.by_toppra(robot, path),
        "TOPP-RA through points each 0.1 rad": executed.by_toppra(robot, executed.with_points_between(path, SPACING)),
        "Ruckig, a stop at each point": executed.by_ruckig(robot, path),
    }


def judge(count: Count, of: Judge, path: np.ndarray) -> chasles.JointPath | None:
    """A motion that touches although the path is clear as planned, if there is one."""
    path = executed.without_repeats(path)
    count.paths += 1
    if not of.is_clear(chasles.JointPath.straight(of.robot, path)):
        count.touch_as_planned += 1
        return None
    touching = None
    for name, motion in motions(of.robot, path).items():
        if motion is None:
            count.untimed[name] = count.untimed.get(name, 0) + 1
            continue
        is_clear = of.is_clear(motion)
        count.executed[name] = count.executed.get(name, 0) + 1
        count.touch[name] = count.touch.get(name, 0) + (not is_clear)
        touching = touching if is_clear or touching else motion
    return touching


def planned_paths(file: pathlib.Path) -> dict[str, dict[str, np.ndarray]]:
    """By problem and by validator."""
    rows: dict[str, dict[str, list[list[str]]]] = {}
    with open(file, newline="") as opened:
        for problem, validator, *values in csv.reader(opened):
            rows.setdefault(problem, {}).setdefault(validator, []).append(values)
    return {p: {v: np.array(values, float) for v, values in of_p.items()} for p, of_p in rows.items()}


def vamp_path(world: robot_worlds.World) -> np.ndarray | None:
    try:
        robot = vamp_robot.VampRobot(vamp_robot.library(robot_peers.VAMP_LIBRARY), world)
    except OSError:
        return None
    path, seconds = robot.plan(world.start, world.goal)
    VAMP_SECONDS.append(seconds)
    return path if len(path) else None


VAMP = "VAMP (judged with prisms inside of cylinders)"
VAMP_SECONDS: list[float] = []


def report(counts: dict[str, Count]) -> None:
    for planner, count in counts.items():
        print(f"\n{planner}: {count.paths} paths, {count.touch_as_planned} touch as planned; the others as executed:")
        for name, paths in count.executed.items():
            print(f"  {name:38} {count.touch[name]:4} of {paths} touch; not timed: {count.untimed.get(name, 0)}")
    if VAMP_SECONDS:
        seconds = [1e3 * s for s in VAMP_SECONDS if s == s]
        print(f"\nVAMP plans and shortens in {np.median(seconds):.2f} ms (median), {np.mean(seconds):.2f} ms (mean)")


def main(arguments: list[str]) -> int:
    if not robot_worlds.PANDA.urdf.exists():
        print("skipped: no folder robots/panda of real inputs")
        return 0
    folder = pathlib.Path(arguments[0])
    names = robot_worlds.problem_names()
    names = names[:: max(1, len(names) // int(arguments[1]))] if len(arguments) > 1 else names
    planned = planned_paths(folder / "paths.csv") if (folder / "paths.csv").exists() else {}
    counts: dict[str, Count] = {}
    has_page = False
    for name in names:
        world = robot_worlds.problem(name)
        of = Judge(world)
        inside = Judge(dataclasses.replace(world, cylinders_inside=True))
        paths = dict(planned.get(name, {}))
        if (path := vamp_path(world)) is not None:
            paths[VAMP] = path
        for planner, path in paths.items():
            asked = inside if planner == VAMP else of
            touching = judge(counts.setdefault(planner, Count()), asked, path)
            if touching is not None and not has_page:
                title = f"{name}: a path that is clear as planned ({planner}), and touches as executed"
                page = folder / "executed.html"
                chasles.write_robot_page(asked.robot, touching, page, scene=asked.scene, title=title)
                print(f"{page}: {title}: {asked.checker.first_contact_on_path(touching)}")
                has_page = True
    report(counts)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except robot_peers.Contradiction as found:
        print(f"contradiction: {found}", file=sys.stderr)
        sys.exit(1)
