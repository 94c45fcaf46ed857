"""A radius as the tessellation error: what is clear is clear for the true parts (examples/python/tessellated_pin.py)."""

import math
import runpy

import numpy as np
import pytest
from conftest import ROOT

import chasles

EXAMPLE = ROOT / "examples" / "python" / "tessellated_pin.py"


@pytest.fixture(scope="module")
def example():
    return runpy.run_path(str(EXAMPLE))


def distances_to_polygon(points, corners):
    """From each point of the plane to the nearest side."""
    ends = np.roll(corners, -1, axis=0) - corners
    ways = points[:, None] - corners
    shares = np.clip((ways * ends).sum(axis=2) / (ends * ends).sum(axis=1), 0, 1)
    return np.linalg.norm(ways - shares[:, :, None] * ends, axis=2).min(axis=1)


@pytest.mark.parametrize("sides", [12, 64, 191])
def test_the_error_is_the_greatest_distance_of_true_parts(sides, example):
    angles = np.linspace(0, 2 * math.pi / sides, 2001)  # one side; the others are alike
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    pin = example["pin"](example["is_too_thick"], sides).vertices[:sides, :2]
    farthest = [distances_to_polygon(example["is_too_thick"] * directions, pin).max()]
    for has_vertices_on_bore in (True, False):
        bore = example["block"](sides, has_vertices_on_bore).vertices[:sides, :2]
        farthest.append(distances_to_polygon(example["BORE"] * directions, bore).max())
    e = example["error"](sides)
    assert max(farthest) <= e and min(farthest) > 0.999 * e


def test_the_lock_is_where_vertices_reach_sides(example):
    """By bisection over the turn, without the formula."""
    sides, radius = example["COARSE"], example["fits"]
    bore = example["block"](sides, True).vertices[:sides, :2]
    low, high = 0.0, math.pi / sides
    for _ in range(60):
        middle = (low + high) / 2
        vertex = radius * np.array([math.cos(middle), math.sin(middle)])
        side = bore[1] - bore[0]
        is_free = side[0] * (vertex - bore[0])[1] - side[1] * (vertex - bore[0])[0] > 0
        low, high = (middle, high) if is_free else (low, middle)
    assert low == pytest.approx(example["locks_after"](radius, example["BORE"] * math.cos(math.pi / sides)), abs=1e-12)


def test_clear_holds_for_the_true_parts(example):
    """Pins that are too thick or fit, beside the axis of the bore, against the true clearance."""
    seed = 20261129
    print("seed", seed)
    random = np.random.default_rng(seed)
    counts = dict.fromkeys(("false clear", "false contact", "proven clear", "too thick", "doubt"), 0)
    for case in range(400):
        sides = int(random.integers(12, 97))
        e = 1.05 * example["error"](sides)
        clearance, aside = random.uniform(-1, 6) * e, (case % 4 > 1) * random.uniform(0, 2) * e
        radius = example["BORE"] - clearance - aside
        assert radius < 1.05 * (example["BORE"] + example["PLAY"])
        direction, turn = random.uniform(0, 2 * math.pi), random.uniform(0, 2 * math.pi / sides)
        place = [aside * math.cos(direction), aside * math.sin(direction)]
        start = [*place, example["DEPTH"] + 5, 1, 0, 0, 0]
        goal = [*place, -2, math.cos(turn / 2), 0, 0, math.sin(turn / 2)]
        pin, block = example["pin"](radius, sides), example["block"](sides, bool(case % 2))
        meshes = chasles.first_contact(pin, block, start, goal).verdict
        bodies = chasles.first_contact(pin.with_radius(e), block.with_radius(e), start, goal).verdict
        counts["false clear"] += meshes == "clear" and clearance < 0
        counts["false contact"] += meshes == "contact" and clearance > 0
        counts["proven clear"] += bodies == "clear"
        counts["too thick"] += clearance < 0
        counts["doubt"] += bodies == "contact" and clearance > 0
        assert clearance > 0 or bodies == "contact", (seed, case)
        assert clearance < 4 * e or bodies == "clear", (seed, case)
    print(counts)
    assert min(counts.values()) >= 5, counts
