"""All methods of CollisionManager against all pairs one by one, in closed form: boxes along the axes."""

import itertools
import math

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, pose

import chasles

NONE = (math.inf, [])


class Box:
    """A box along the axes: its body is a cube of this size at the origin, and its place the lowest corner."""

    bodies = {}  # by size

    def __init__(self, low, size):
        self.low, self.high = np.asarray(low, float), np.asarray(low, float) + size
        if tuple(size) not in self.bodies:
            self.bodies[tuple(size)] = chasles.Polyhedron(CUBE_VERTICES * np.asarray(size, float), CUBE_FACES)
        self.body, self.pose = self.bodies[tuple(size)], pose(*low)


def distance_of(a, b):
    """Of two boxes: 0 where one lies inside the other."""
    gaps = np.maximum(np.maximum(a.low - b.high, b.low - a.high), 0)
    return float(np.linalg.norm(gaps))


def nearest(first, second=None):
    """The least distance, and all pairs of names that have it."""
    pairs = itertools.combinations(first, 2) if second is None else itertools.product(first, second)
    everything = first | (second or {})
    of_pairs = {pair: distance_of(first[pair[0]], (second or everything)[pair[1]]) for pair in pairs}
    least = min(of_pairs.values(), default=math.inf)
    return least, [pair for pair, distance in of_pairs.items() if distance == least], of_pairs


def manager_of(boxes):
    manager = chasles.CollisionManager()
    for name, box in boxes.items():
        manager.add_object(name, box.body, box.pose)
    return manager


def expect_nearest(answer, expected, boxes):
    """`boxes` are those of both names, which may be equal."""
    distance, names, data = answer
    least, pairs, _ = expected
    if not pairs:
        assert (distance, names, data) == (math.inf, None, None)
        return
    assert distance == pytest.approx(least, rel=1e-11, abs=1e-12) and names in pairs
    assert data.lower <= least + 1e-12 and least <= data.distance + 1e-12 and data.distance - data.lower <= 1e-11 * least
    if names[0] != names[1]:
        a, b = (data.point(name) for name in names)
        assert np.linalg.norm(a - b) == pytest.approx(least, abs=1e-9)


def touching(of_pairs):
    return {pair for pair, distance in of_pairs.items() if distance == 0}


def expect_all(boxes, others, one):
    """Every question of a manager of `boxes`, with another manager and one more box."""
    manager, other = manager_of(boxes), manager_of(others)
    within, between = nearest(boxes), nearest(boxes, others)
    with_one = nearest(boxes, {"__external": one})

    expect_nearest(manager.min_distance_internal(return_names=True, return_data=True), within, boxes)
    assert manager.min_distance_internal() == pytest.approx(within[0], rel=1e-11, abs=1e-12)
    assert manager.in_collision_internal(return_names=True) == (within[0] == 0, touching(within[2]))
    assert manager.in_collision_internal() is (within[0] == 0)

    expect_nearest(manager.min_distance_other(other, True, True), between, boxes)
    expect_nearest(other.min_distance_other(manager, True, True), nearest(others, boxes), boxes)
    assert manager.in_collision_other(other, return_names=True) == (between[0] == 0, touching(between[2]))
    assert manager.in_collision_other(other) is (between[0] == 0)

    distance, name, data = manager.min_distance_single(one.body, one.pose, True, True)
    expect_nearest((distance, name and (name, "__external"), data), with_one, boxes)
    names = {name for name, _ in touching(with_one[2])}
    assert manager.in_collision_single(one.body, one.pose, return_names=True) == (bool(names), names)
    assert manager.in_collision_single(one.body, one.pose) is bool(names)

    for name in boxes:
        rest = {key: box for key, box in boxes.items() if key != name}
        least, pairs, of_pairs = nearest({name: boxes[name]}, rest)
        pairs = [tuple(sorted(pair)) for pair in pairs]
        expect_nearest(manager.min_distance_internal(name, True, True), (least, pairs, of_pairs), boxes)
    return within[0]


def random_boxes(random, count, prefix=""):
    """On a grid of halves: many ties, faces in one plane, boxes that touch, overlap, coincide and hold each other."""
    span = random.choice([3, 6, 12])
    return {
        f"{prefix}{i:02}": Box(random.integers(0, 2 * span, 3) / 2, random.integers(1, 8 if i % 3 == 0 else 3, 3) / 2)
        for i in range(count)
    }


@pytest.mark.parametrize("seed", range(10))
def test_all_questions_of_a_hundred_random_scenes(seed):
    random = np.random.default_rng([41, seed])
    kinds = {"apart": 0, "touching": 0, "no pair": 0}
    for scene in range(100):
        boxes = random_boxes(random, random.integers(0, 9))
        others = random_boxes(random, random.integers(0, 5))
        (one,) = random_boxes(random, 1).values()
        try:
            least = expect_all(boxes, others, one)
        except AssertionError as error:
            raise AssertionError(f"seed {seed}, scene {scene}") from error
        kinds["no pair" if least == math.inf else "touching" if least == 0 else "apart"] += 1
    assert min(kinds.values()) >= 5, kinds


def test_the_three_cubes_of_the_report():
    places = {"a": [0, 3, 2], "b": [2.5, 0.5, 1.5], "c": [3.5, 3.5, 1]}
    manager = manager_of({name: Box(place, (1, 1, 1)) for name, place in places.items()})
    distance, names, data = manager.min_distance_internal(return_names=True, return_data=True)
    assert distance == pytest.approx(2, abs=1e-11) and names == ("b", "c") and data.lower <= 2


@pytest.mark.parametrize("count", [2, 5, 17, 65, 300])
def test_the_nearest_of_clusters_far_apart(count):
    """The search goes down a tree: two clusters, and one pair that is nearer than all others."""
    random = np.random.default_rng(count)
    boxes = {}
    for i in range(count):
        cell = [i % 7, i // 7 % 7, i // 49]
        at = np.array(cell) * 2 + random.integers(0, 7, 3) / 16
        boxes[f"{i:03}"] = Box(at + (1000 if i % 2 else 0), (1, 1, 1))
    manager = manager_of(boxes)
    expect_nearest(manager.min_distance_internal(return_names=True, return_data=True), nearest(boxes), boxes)
    even, odd = ({name: box for i, (name, box) in enumerate(boxes.items()) if i % 2 == k} for k in range(2))
    answer = manager_of(even).min_distance_other(manager_of(odd), True, True)
    expect_nearest(answer, nearest(even, odd), boxes)


def random_pose(random, size):
    return [*random.uniform(-size, size, 3), *random.normal(size=4)]


@pytest.mark.parametrize("seed", range(5))
def test_turned_bodies_are_those_of_all_pairs(seed, cube):
    """All pairs are asked one by one by least_distance; the motion of `first_contact` by first_contact."""
    random = np.random.default_rng([42, seed])
    moving = 0
    for _ in range(12):
        poses = {f"o{i}": random_pose(random, 2.5) for i in range(7)}
        manager = chasles.CollisionManager()
        for name, place in poses.items():
            manager.add_object(name, cube, place)

        def rests(name, poses=poses):
            return chasles.Motion.at_rest(poses[name])

        def between(a, b, rests=rests):
            return chasles.least_distance(cube, cube, motion=chasles.relative(rests(a), rests(b)), tolerance=1e-12)

        expected = min(between(a, b).distance_upper for a, b in itertools.combinations(poses, 2))
        assert manager.min_distance_internal() == pytest.approx(expected, rel=1e-11, abs=1e-12)

        goals = {name: random_pose(random, 2.5) for name in ("o0", "o3")}
        ways = {
            name: chasles.ConstantVelocity.between(place, goals[name]) if name in goals else rests(name)
            for name, place in poses.items()
        }
        times = [
            found.time
            for a, b in itertools.combinations(poses, 2)
            if a in goals or b in goals
            for found in [chasles.first_contact(cube, cube, motion=chasles.relative(ways[a], ways[b]))]
            if found.verdict != "clear"
        ]
        touching = manager.in_collision_internal()
        found = manager.first_contact(goals)
        moving += bool(times) and not touching
        if times and not touching:
            assert found.time == pytest.approx(min(times), abs=1e-11)
        elif not touching:
            assert found.verdict == "clear"
    assert moving > 2
