"""Curves of the distance, against closed forms and against the distances of another library at many poses."""

import numpy as np
import pytest
from cubes import pose

import chasles

TOLERANCE = 0.02


def holds(profile, times, distances, slack=1e-12):
    step = np.minimum(np.searchsorted(profile.times, times, side="right"), len(profile.times) - 1) - 1
    return np.all(profile.lower[step] <= distances + slack) and np.all(profile.upper[step] >= distances - slack)


def test_the_curve_of_cubes_that_pass_each_other(cube):
    profile = chasles.profile(cube, cube, pose(-4, 1.5, 0), pose(4, 1.5, 0), tolerance=TOLERANCE)
    times = np.linspace(0, 1, 777)
    distances = np.hypot(np.maximum(np.abs(8 * times - 4) - 1, 0), 0.5)
    assert profile.certain and holds(profile, times, distances)
    assert profile.times[0] == 0 and profile.times[-1] == 1 and np.all(np.diff(profile.times) > 0)
    assert np.all(profile.upper - profile.lower <= TOLERANCE * profile.upper + 1e-12)
    assert profile.free == [(0, 1)]
    assert "steps, from 0.4" in repr(profile) and "to 3.0" in repr(profile)


def test_zones_and_free_times(cube):
    profile = chasles.profile(cube, cube, pose(-4, 0.25, 0), pose(4, 0.25, 0), margins=[0.5])
    (inside,), doubt = profile.zones(0.5)
    np.testing.assert_allclose(inside, (2.5 / 8, 5.5 / 8), atol=2e-6)
    assert sum(b - a for a, b in doubt) < 4e-6
    (before, after) = profile.free
    np.testing.assert_allclose([*before, *after], [0, 3 / 8, 5 / 8, 1], atol=1e-6)
    with pytest.raises(chasles.InvalidInput, match="margin: must be in"):
        profile.zones(-1)


def random_body(random, corners):
    hull = pytest.importorskip("scipy.spatial").ConvexHull(random.normal(size=(corners, 3)))
    return chasles.Polyhedron(hull.points, [tuple(face) for face in hull.simplices])


@pytest.mark.parametrize("seed", range(6))
def test_no_distance_of_fcl_crosses_the_curve(seed):
    fcl = pytest.importorskip("fcl")
    random = np.random.default_rng(seed)
    bodies = [random_body(random, 12) for _ in range(2)]
    models = []
    for body in bodies:
        model = fcl.BVHModel()
        model.beginModel(len(body.vertices), len(body.triangles))
        model.addSubModel(np.asarray(body.vertices), np.asarray(body.triangles))
        model.endModel()
        models.append(model)
    ends = [np.r_[random.normal(size=3) * 3 + side, random.normal(size=4)] for side in ([5, 0, 0], [0, 5, 0])]
    for kind in ("screw", "sweep", "velocity", "twist"):
        whole = {"max_turn": np.pi} if kind == "screw" else {}  # an answer's screw is not cut into pieces
        profile = chasles.profile(*bodies, *ends, motion=kind, tolerance=TOLERANCE, **whole)
        motion = chasles.first_contact(*bodies, *ends, motion=kind, **whole).motion
        if profile.free != [(0, 1)]:
            continue
        times = np.linspace(0, 1, 100)
        fixed = fcl.CollisionObject(models[1], fcl.Transform())
        distances = []
        for time in times:
            place = np.asarray(motion.pose_at(time))
            moving = fcl.CollisionObject(models[0], fcl.Transform(place[:3, :3], place[:3, 3]))
            distances.append(fcl.distance(moving, fixed, fcl.DistanceRequest(), fcl.DistanceResult()))
        assert profile.certain and holds(profile, times, np.array(distances), slack=1e-6), kind


def test_the_plot_has_both_bounds(cube):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = chasles.profile(cube, cube, pose(-4, 1.5, 0), pose(4, 1.5, 0)).plot(margins=[1])
    (band,) = axes.collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert heights.min() == pytest.approx(0.5, rel=0.02) and heights.max() == pytest.approx(np.hypot(3, 0.5), rel=0.02)


def test_options_out_of_their_range_are_refused(cube):
    with pytest.raises(chasles.InvalidInput, match="query: tolerance: must be in"):
        chasles.profile(cube, cube, pose(3, 0, 0), pose(4, 0, 0), tolerance=0)
    with pytest.raises(chasles.InvalidInput, match="margins"):
        chasles.profile(cube, cube, pose(3, 0, 0), pose(4, 0, 0), margins="near")


def test_a_scene_names_the_pair_that_is_nearest(cube):
    scene = chasles.Scene()
    scene.add("left", cube, pose=pose(-4, 0, 0))
    scene.add("right", cube, pose=pose(4, 0, 0))
    scene.add("cart", cube, pose=pose(-2, 0, 0), goal=pose(2, 0, 0))
    profile = scene.profile(margins=[1.5])
    assert profile.pairs == [("cart", "left"), ("cart", "right")] and len(profile.nearest) == len(profile.times) - 1
    times = np.linspace(0, 1, 333)
    assert profile.certain and holds(profile, times, 1 + np.minimum(4 * times, 4 - 4 * times))
    nearest = [profile.pairs[i] for i in profile.nearest]
    middle = (profile.times[:-1] + profile.times[1:]) / 2
    assert all(pair == ("cart", "left") for pair, time in zip(nearest, middle) if time < 0.49)
    assert all(pair == ("cart", "right") for pair, time in zip(nearest, middle) if time > 0.51)
    assert len(profile.untested) == 1  # the walls never move
    assert chasles.profile(cube, cube, pose(3, 0, 0), pose(2, 0, 0)).pairs == []


def test_a_scene_without_pairs_is_infinite(cube):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    profile = chasles.Scene().profile()
    assert np.isinf(profile.lower).all() and np.isinf(profile.upper).all() and profile.pairs == []
    assert profile.free == [(0, 1)] and profile.zones(3) == ([], [])
    profile.plot()


def test_a_robot_counts_segments_or_stamps(cube):
    robot = chasles.Robot(
        links=[{"name": "base"}, {"name": "cube", "collisions": [cube]}],
        joints=[{"name": "way", "type": "prismatic", "parent": "base", "child": "cube", "axis": [1, 0, 0]}],
    )
    scene = chasles.Scene()
    scene.add("first", cube, pose=pose(2, 1.5, 0))
    scene.add("second", cube, pose=pose(6, 1.25, 0))
    for stamps in (None, [10, 12, 20]):
        profile = robot.profile([[0], [4], [8]], stamps, scene=scene, tolerance=TOLERANCE)
        knots = [0, 1, 2] if stamps is None else stamps
        assert profile.times[0] == knots[0] and profile.times[-1] == knots[-1] and profile.certain
        times = np.linspace(knots[0], knots[-1], 400)
        x = np.interp(times, knots, [0, 4, 8])
        to_post = [np.hypot(np.maximum(np.abs(x - post) - 1, 0), gap) for post, gap in ((2, 0.5), (6, 0.25))]
        assert holds(profile, times, np.minimum(*to_post))
        assert profile.pairs == [("cube", "first"), ("cube", "second")]
    with pytest.raises(chasles.InvalidInput, match="tolerance: must be in"):
        robot.profile([[0], [4]], tolerance=3)
