#!/usr/bin/env python3
"""The Panda of VAMP's spheres in clouds of points: Chasles beside VAMP and Coal's octree.

Usage: cloud_peers.py [FOLDER]   the folder is ignored; the other programs for robots take one

The clouds lie on the obstacles of planning problems. Each answer of Chasles is judged by a k-d tree and Pinocchio's
kinematics at 1,000 samples of the edge: the distance of all spheres from all points. A contradiction ends the program with
exit status 1. Times are of the processor. docs/decisions/0046-peers-of-robots.md says how each peer is called.
"""

import pathlib
import sys
import time
import typing

import robot_peers  # first: it may start the program again

import coal  # isort: skip
import coal_robot
import numpy as np
import robot_worlds
import scipy.spatial
import vamp_robot

import chasles

POINTS = 1_000_000
RADIUS = 0.0025  # metres
SAMPLES = 1000
ROUNDING = 1e-9  # metres; of the distances that judge
EDGES = 40  # of each kind in each cloud
NEAR = 0.005  # metres; a clear edge that comes so near to a point is "near"


def cloud_on(world: robot_worlds.World, count: int, random: np.random.Generator) -> np.ndarray:
    """Points on the obstacles, as many on each square metre."""
    corners = []
    for obstacle in world.obstacles:
        vertices, faces = world.mesh(obstacle)
        placed = np.asarray(vertices) @ obstacle.pose[:3, :3].T + obstacle.pose[:3, 3]
        corners.append(placed[np.asarray(robot_worlds.triangles(faces))])
    a, b, c = np.concatenate(corners).transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(a), count, p=areas / areas.sum())
    u, v = np.sort(random.random((2, count, 1)), axis=0)
    return u * a[chosen] + (v - u) * b[chosen] + (1 - v) * c[chosen]


class Judge:
    """Distances of spheres and points, by others' code alone."""

    def __init__(self, coal_model: coal_robot.CoalRobot, cloud: np.ndarray, radius: float):
        import pinocchio

        self.pinocchio, self.coal, self.tree = pinocchio, coal_model, scipy.spatial.cKDTree(cloud)
        self.spheres = [i for i, o in enumerate(coal_model.geometry.geometryObjects) if isinstance(o.geometry, coal.Sphere)]
        self.reach = np.array([coal_model.geometry.geometryObjects[i].geometry.radius + radius for i in self.spheres])
        # Links that do not move are no part of the question.
        moving = [coal_model.geometry.geometryObjects[i].parentJoint > 0 for i in self.spheres]
        self.spheres, self.reach = np.array(self.spheres)[moving], self.reach[moving]

    def gaps(self, configurations: np.ndarray) -> np.ndarray:
        """The least distance at each of them, below 0 where a sphere meets a point; infinite where none is near."""
        centres = []
        for configuration in configurations:
            self.pinocchio.updateGeometryPlacements(
                self.coal.model, self.coal.data, self.coal.geometry, self.coal.geometry_data, configuration
            )
            centres.append([self.coal.geometry_data.oMg[int(i)].translation for i in self.spheres])
        nearest = self.tree.query(np.array(centres), distance_upper_bound=1.01 * self.reach.max())[0]
        return (nearest - self.reach).min(axis=1)


class Cloud:
    """One cloud, with everybody's model of it. Edges along which the robot meets itself are left out."""

    def __init__(self, points: np.ndarray, radius: float, files: tuple[pathlib.Path, pathlib.Path]):
        self.robot = chasles.Robot.load(files[0], srdf=files[1])
        self.built: dict[str, float] = {}
        began = time.perf_counter()
        cloud = chasles.points(points, radius)
        self.built["chasles"] = time.perf_counter() - began
        self.checker, self.alone = self.checker_of(cloud), chasles.RobotChecker(self.robot)
        self.checker_near = self.checker_of(cloud.with_radius(radius + NEAR))
        began = time.perf_counter()
        octree = coal.makeOctree(points, 2 * radius)
        self.built["Coal"] = time.perf_counter() - began
        self.coal = coal_robot.CoalRobot(files[0], self.robot, octree)
        self.judge = Judge(self.coal, points, radius)
        self.asks: dict[str, robot_peers.Ask | str] = {
            "chasles, is_clear": lambda s, g: timed(lambda: self.checker.is_clear(s, g)),
            "chasles, first_contact": lambda s, g: timed(lambda: self.checker.first_contact(s, g).verdict == "clear"),
            "Coal, samples at 1 %": lambda s, g: self.coal.timed(s, g, 0.01),
            "Coal, samples at 0.1 %": lambda s, g: self.coal.timed(s, g, 0.001),
            "VAMP": self.vamp(points, radius),
        }

    def checker_of(self, cloud: chasles.Polyhedron) -> chasles.RobotChecker:
        scene = chasles.Scene()
        scene.add("cloud", cloud)
        return chasles.RobotChecker(self.robot, scene)

    def vamp(self, points: np.ndarray, radius: float) -> robot_peers.Ask | str:
        try:
            library = vamp_robot.library(robot_peers.VAMP_LIBRARY)
        except OSError as error:
            return str(error)
        began = time.perf_counter()
        robot = vamp_robot.VampRobot(library, None, points, radius)
        self.built[f"VAMP, {robot.kept_points} points kept"] = time.perf_counter() - began
        self.vamp_alone = vamp_robot.VampRobot(library, None)
        return robot.ask

    def truth(self, start: np.ndarray, goal: np.ndarray) -> bool:
        """Whether the edge is clear, if Chasles and the distances agree."""
        found = self.checker.first_contact(start, goal)
        is_clear = found.verdict == "clear"
        where = f"{found}: {start.tolist()} to {goal.tolist()}"
        if self.checker.is_clear(start, goal) != is_clear:
            raise robot_peers.Contradiction(f"is_clear and {where}")
        until = 1.0 if is_clear else found.clear_until
        parts = np.linspace(0, until, SAMPLES + 1)[:, None]
        if self.judge.gaps(start + parts * (goal - start)).min() < -ROUNDING:
            raise robot_peers.Contradiction(f"a sphere meets a point before {where}")
        if not is_clear and self.judge.gaps(start + found.time_upper * (goal - start)[None])[0] > ROUNDING:
            raise robot_peers.Contradiction(f"no sphere meets a point at {where}")
        return is_clear

    def judged(self, name: str, is_clear: bool, truth: bool, edge: tuple[np.ndarray, np.ndarray]) -> bool:
        return truth

    def is_alone_clear(self, start: np.ndarray, goal: np.ndarray) -> bool:
        """Self-collision, as each peer defines it, is no part of the comparison."""
        return self.alone.is_clear(start, goal) and (not hasattr(self, "vamp_alone") or self.vamp_alone.ask(start, goal)[0])

    def edges(self, random: np.random.Generator) -> dict[str, list[tuple[np.ndarray, np.ndarray]]]:
        """By kind, from free configurations within the limits; 1 rad in all joints together."""
        lower, upper = self.robot.limits.T
        edges: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {"random": [], "near": [], "between free ends": []}
        while min(map(len, edges.values())) < EDGES:
            start = random.uniform(lower, upper)
            way = random.uniform(lower, upper) - random.uniform(lower, upper)
            goal = start + way / np.abs(way).sum()
            if not self.checker.is_clear(start) or not self.is_alone_clear(start, goal):
                continue
            edges["random"].append((start, goal))
            if self.checker.is_clear(start, goal):
                if not self.checker_near.is_clear(start, goal):
                    edges["near"].append((start, goal))
            elif self.checker.is_clear(goal):
                edges["between free ends"].append((start, goal))
        return {kind: found[:EDGES] for kind, found in edges.items()}


def timed(ask: typing.Callable[[], bool]) -> tuple[bool, float]:
    began = time.process_time()
    answer = ask()
    return answer, time.process_time() - began


def vamp_robot_files() -> tuple[pathlib.Path, pathlib.Path] | None:
    """VAMP's URDF file of spheres, which install.sh unpacks, and the Panda's SRDF file."""
    found = sorted(robot_peers.VAMP_LIBRARY.parent.glob("vamp_planner-*/resources/panda/panda_spherized.urdf"))
    return (found[0], robot_worlds.PANDA.srdf) if found and robot_worlds.PANDA.srdf.exists() else None


def main() -> int:
    files = vamp_robot_files()
    if files is None:
        print("skipped: no folder robots/panda of real inputs, or no robot of spheres of VAMP")
        return 0
    random = np.random.default_rng(21)
    rows: dict[str, dict[str, robot_peers.Row]] = {}
    built: dict[str, list[float]] = {}
    for name in robot_worlds.problem_names()[::80]:
        cloud = Cloud(cloud_on(robot_worlds.problem(name), POINTS, random), RADIUS, files)
        for kind, edges in cloud.edges(random).items():
            robot_peers.race(rows.setdefault(kind, {}), cloud, edges)
        for who, seconds in cloud.built.items():
            built.setdefault(who.split(",")[0], []).append(seconds)
        print(name, {who: round(seconds, 2) for who, seconds in cloud.built.items()}, flush=True)
    print("built in seconds, median: " + ", ".join(f"{who} {np.median(s):.2f}" for who, s in built.items()))
    titles = {
        "random": "edges from free configurations",
        "near": f"clear edges that come within {1000 * NEAR:g} mm of a point",
        "between free ends": "edges that touch between free ends",
    }
    for kind, title in titles.items():
        robot_peers.report(f"Panda of spheres, clouds of {POINTS:,} points, {title}", rows[kind])
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except robot_peers.Contradiction as found:
        print(f"contradiction: {found}", file=sys.stderr)
        sys.exit(1)
