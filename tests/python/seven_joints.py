"""An arm of seven joints, worlds of twenty bodies and chunks of actions, for tests and for bench/python/policy_gate.py."""

import numpy as np
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles

LENGTHS = (0.16, 0.2, 0.2, 0.21, 0.19, 0.21, 0.08)  # from joint to joint, metres
RADII = (0.07, 0.06, 0.06, 0.05, 0.05, 0.045, 0.04)


def box(x, y, z):
    return chasles.Polyhedron((np.array(CUBE_VERTICES, float) - 0.5) * [x, y, z], CUBE_FACES)


def pose(x, y, z, *rotation):
    return [x, y, z, *(rotation or (1, 0, 0, 0))]


def arm():
    """Axes along z and y in turn, links of capsules, and a gripper of boxes that stays open."""
    links = [{"name": "base", "collisions": [{"shape": box(0.2, 0.2, 0.1), "origin": pose(0, 0, 0.05)}]}]
    joints, height = [], 0.16
    for i, (length, radius) in enumerate(zip(LENGTHS, RADII, strict=True)):
        shape = {"shape": chasles.capsule(radius, length), "origin": pose(0, 0, length / 2)}
        links.append({"name": f"link{i + 1}", "collisions": [shape]})
        bound = 2.9 if i % 2 == 0 else 2.0
        joints.append(
            {"name": f"joint{i + 1}", "type": "revolute", "parent": links[-2]["name"], "child": links[-1]["name"],
             "origin": pose(0, 0, height), "axis": [0, 0, 1] if i % 2 == 0 else [0, 1, 0], "lower": -bound, "upper": bound}
        )  # fmt: skip
        height = length
    fingers = [{"shape": box(0.02, 0.015, 0.06), "origin": pose(0, y, 0.1)} for y in (-0.04, 0.04)]
    links.append({"name": "hand", "collisions": [{"shape": box(0.06, 0.18, 0.05), "origin": pose(0, 0, 0.045)}, *fingers]})
    joints.append({"name": "flange", "type": "fixed", "parent": "link7", "child": "hand", "origin": pose(0, 0, height)})
    neighbours = [("base", "link2"), ("link5", "link7"), ("link6", "hand"), ("link5", "hand")]
    neighbours += [(f"link{i}", f"link{i + 2}") for i in range(1, 5)]
    robot = chasles.Robot(name="arm", links=links, joints=joints, disabled_pairs=neighbours)
    robot.ignore_in_scene("base", "table")  # it stands there
    return robot


def world(random, bodies=20):
    """A table, and boxes, balls and bars around the arm."""
    scene = chasles.Scene()
    scene.add("table", box(2, 2, 0.05), pose(0, 0, -0.03))
    for i in range(bodies - 1):
        angle, far = random.uniform(-np.pi, np.pi), random.uniform(0.35, 0.9)
        place = pose(far * np.cos(angle), far * np.sin(angle), random.uniform(0.05, 1.1), *random.normal(size=4))
        shapes = (
            lambda: box(*random.uniform(0.05, 0.25, 3)),
            lambda: chasles.sphere(random.uniform(0.03, 0.1)),
            lambda: chasles.capsule(random.uniform(0.01, 0.04), random.uniform(0.1, 0.4)),
        )
        scene.add(f"body {i}", shapes[i % 3](), place)
    return scene


def chunk(robot, random, present, count=50, step=0.03):
    """A smooth way of about `step` radians an action, with a jitter of a hundredth of that, within the limits."""
    times = np.arange(1, count + 1)
    ways = random.normal(size=(2, len(present)))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    wave = np.outer(6 * np.sin(times / random.uniform(5, 12)), ways[1])
    actions = present + step * (np.outer(times, ways[0]) + wave + random.normal(0, 0.01, (count, len(present))))
    return np.clip(actions, *robot.limits.T)


def clear_configuration(robot, checker, random):
    while True:
        present = random.uniform(*robot.limits.T)
        if checker.is_clear(present):
            return present
