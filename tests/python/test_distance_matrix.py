"""The least distances of all pairs of a scene: cubes in closed form, limits, the table, the plot and the page."""

import itertools
import re

import numpy as np
import pytest
from cubes import pose

import chasles


@pytest.fixture
def scene(cube):
    """A cart passes a post, drives through a wall, and a lid lies in it; two of them stand still."""
    world = chasles.Scene()
    world.add("post", cube, pose(0, 1.5, 0))
    world.add("wall", cube, pose(3, 0.2, 0.1))
    world.add("cart", cube, pose(-4, 0, 0), pose(4, 0, 0))
    world.add("lid", cube, pose(-3.5, 0.3, 0.2), pose(-3.5, 9, 0.2))
    world.ignore("wall", "lid")
    return world


def test_each_pair_has_its_answer(scene):
    found = scene.least_distances()
    assert found.names == scene.names == ["post", "wall", "cart", "lid"]
    pairs = {frozenset(answer.pair): answer for answer in found.pairs}
    assert [set(answer.pair) for answer in found.pairs] == [{"post", "cart"}, {"post", "lid"}, {"wall", "cart"}, {"cart", "lid"}]
    assert pairs[frozenset(("post", "cart"))].distance_upper == pytest.approx(0.5)
    crash = pairs[frozenset(("wall", "cart"))]
    assert crash.pair == ("cart", "wall") and crash.distance == crash.distance_upper == 0 and crash.time == pytest.approx(6 / 8)
    nested = pairs[frozenset(("cart", "lid"))]
    assert nested.time == 0 and (nested.overlap or nested.inside)
    assert found.untested.reasons == {"at_rest": 1, "ignored": 1}


def test_arrays_are_symmetric_and_have_no_number_without_a_pair(scene):
    found = scene.least_distances(tolerance=1e-9)
    for ends in (found.lower, found.upper):
        np.testing.assert_array_equal(ends, ends.T)
        assert ends.shape == (4, 4) and np.isnan(np.diagonal(ends)).all()
        assert np.isnan(ends[0, 1]) and np.isnan(ends[1, 3])
    tested = ~np.isnan(found.lower)
    assert tested.sum() == 2 * len(found.pairs) == 8
    assert (found.lower[tested] <= found.upper[tested]).all()
    assert found.lower[0, 3] == pytest.approx(2.5) and found.upper[1, 2] == 0


def test_of_spheres_it_is_the_distance_of_points():
    random = np.random.default_rng(5)
    starts, goals, radii = random.uniform(-3, 3, (7, 3)), random.uniform(-3, 3, (7, 3)), random.uniform(0.1, 0.5, 7)
    world = chasles.Scene()
    for i in range(7):
        world.add(f"ball {i}", chasles.sphere(radii[i]), pose(*starts[i]), pose(*goals[i]))
    found = world.least_distances()
    assert len(found.pairs) == 21
    for a, b in itertools.combinations(range(7), 2):
        at, way = starts[a] - starts[b], (goals - starts)[a] - (goals - starts)[b]
        time = np.clip(-at @ way / (way @ way), 0, 1)
        distance = max(0.0, np.linalg.norm(at + time * way) - radii[a] - radii[b])
        assert found.lower[a, b] <= distance + 1e-12
        assert found.upper[a, b] == pytest.approx(distance, rel=2e-6, abs=1e-12)
    nearest = min(found.pairs, key=lambda answer: answer.distance_upper)
    assert world.least_distance().distance_upper == nearest.distance_upper


def test_the_answer_does_not_depend_on_threads(scene):
    one = scene.least_distances(threads=1)
    for threads in (0, 2, 3):
        many = scene.least_distances(threads=threads)
        np.testing.assert_array_equal(many.lower, one.lower)
        np.testing.assert_array_equal(many.upper, one.upper)
        assert [answer.time for answer in many.pairs] == [answer.time for answer in one.pairs]


@pytest.mark.parametrize("by", ["seconds", "limit"])
def test_at_a_limit_every_pair_has_a_bracket(scene, by):
    scene.add("far", scene_body(), pose(20, 20, 20), pose(22, 20, 20))
    exact = scene.least_distances()
    if by == "seconds":
        found = scene.least_distances(seconds=1e-9)
    else:
        with chasles.Limit(1e-9):
            found = scene.least_distances()
    assert not any(answer.certain for answer in found.pairs)
    tested = ~np.isnan(exact.lower)
    np.testing.assert_array_equal(np.isnan(found.lower), ~tested)
    assert (found.lower[tested] <= exact.upper[tested]).all() and (found.upper[tested] >= exact.lower[tested]).all()
    assert found.lower[0, 4] > 20 and np.isfinite(found.upper[tested]).all()
    assert "to" in str(found)
    in_doubt = np.count_nonzero(np.triu((found.lower == 0) & (found.upper > 0)))
    assert in_doubt > 0 and f" in contact, {in_doubt} perhaps, " in str(found)


def scene_body():
    return chasles.sphere(1)


def test_a_pair_that_takes_long_is_asked_again():
    """Two sheets near each other take more than the first attempt within a limit, which is short."""
    n = 40
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    sheet = chasles.Polyhedron(np.stack([x, y, 0 * x], axis=1), faces)
    world = chasles.Scene()
    world.add("lower", sheet)
    world.add("upper", sheet, pose(0, 0.1, 1e-3), pose(0.4, 0.1, 1e-3, np.cos(0.4), 0, 0, np.sin(0.4)))
    (found,) = world.least_distances(seconds=60).pairs
    assert found.certain and found.distance == pytest.approx(1e-3)


def test_the_text_has_the_nearest_pairs_first(scene):
    found = scene.least_distances()
    head, *lines = str(found).splitlines()
    assert head == "4 bodies, 4 pairs, 2 in contact, 2 not tested"
    assert repr(found) == f"<chasles.DistanceMatrix: {head}>"
    assert re.match(r"contact, (overlapping|inside) +at time 0 +cart on lid$", lines[0])
    assert re.match(r"contact +at time 0\.75\d* +cart on wall$", lines[1])
    assert re.match(r"0\.49999\d* +at time 0\.\d+ +cart on post$", lines[2])
    assert lines[3].endswith("lid on post") and len(lines) == 4


def test_a_scene_without_pairs(cube):
    world = chasles.Scene()
    assert world.least_distances().pairs == [] and world.least_distances().lower.shape == (0, 0)
    world.add("alone", cube)
    found = world.least_distances()
    assert np.isnan(found.upper).all() and found.lower.shape == (1, 1)
    assert str(found) == "1 bodies, 0 pairs, 0 in contact"


def test_it_refuses_what_it_cannot_use(scene):
    for wrong in ({"tolerance": 0}, {"tolerance": 2}, {"find": "any"}, {"seconds": 0}, {"seconds": -1}):
        with pytest.raises(chasles.InvalidInput):
            scene.least_distances(**wrong)


@pytest.mark.parametrize("count", [0, 1, 4, 20])
def test_the_plot_marks_pairs_that_touch(scene, cube, count):
    pytest.importorskip("matplotlib").use("Agg")
    world = scene if count == 4 else chasles.Scene()
    for i in range(count if count != 4 else 0):
        world.add(f"body {i}", cube, pose(2 * i, 0, 0), pose(2 * i, 1, 0.01 * i))
    found = world.least_distances()
    axes = found.plot()
    axes.figure.canvas.draw()
    if count == 4:
        texts = sorted(text.get_text() for text in axes.texts)
        assert len(texts) == 8 and texts.count("t 0.75") == 2 and texts.count("0.5") == 2
        assert [label.get_text() for label in axes.get_yticklabels()] == found.names


def test_the_page_has_the_pairs_as_a_table(scene, tmp_path):
    from test_view import scene_of

    found = scene.least_distances()
    page = tmp_path / "matrix.html"
    try:
        scene.view(found, page)
    except chasles.InvalidInput as error:
        pytest.skip(str(error))
    record = scene_of(page)
    assert [body["name"] for body in record["bodies"]] == found.names
    for answer, pair in zip(found.pairs, record["matrix"], strict=True):
        assert [found.names[body] for body in pair["pair"]] == list(answer.pair)
        assert (pair["distance"], pair["distance_upper"], pair["time"]) == (answer.distance, answer.distance_upper, answer.time)
    assert len(record["events"]) == 2
    scene.remove("post")
    with pytest.raises(chasles.InvalidInput, match="found: is the answer of another scene, or of this one before it was changed"):
        scene.view(found, page)
