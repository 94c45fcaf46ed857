"""Scenes: the answers are those of the pairs, and wrong arguments get one clear error."""

import pickle

import numpy as np
import pytest
from cubes import pose

import chasles


@pytest.fixture
def scene(cube):
    scene = chasles.Scene()
    scene.add("left", cube, pose(-4, 0, 0), pose(0, 0, 0))
    scene.add("right", cube, pose(4, 0.25, 0.25), pose(0, 0.25, 0.25), group="right")
    scene.add("floor", cube, pose(0, 0, -9))
    return scene


def test_the_first_contact_is_that_of_its_pair(scene, cube):
    found = scene.first_contact()
    assert found.verdict == "contact" and found.pair == ("left", "right")
    assert found.time == pytest.approx(7 / 8, abs=1e-12)  # 7 between the faces, at a speed of 8
    left = chasles.ConstantVelocity.between(pose(-4, 0, 0), pose(0, 0, 0))
    right = chasles.ConstantVelocity.between(pose(4, 0.25, 0.25), pose(0, 0.25, 0.25))
    alone = chasles.first_contact(cube, cube, motion=chasles.relative(left, right))
    assert (found.time, found.time_upper) == (alone.time, alone.time_upper)
    assert found.moving is cube and found.contacts[0].normal.shape == (3,)
    assert [c.pair for c in scene.all_contacts()] == [("left", "right")]
    assert scene.clear_until() == {"left": found.time, "right": found.time, "floor": 1}
    assert "left on right" in repr(found)


def test_pairs_and_groups_have_margins_of_their_own(scene):
    scene.set_margin("left", "right", 1)
    assert scene.first_contact().time == pytest.approx(6 / 8, abs=1e-12)
    scene.set_group_margin("", "right", 9)  # the pair's own margin counts first
    found = scene.first_contact()
    assert found.verdict == "contact_at_start" and found.pair == ("right", "floor")
    with pytest.raises(chasles.InvalidInput, match="left: margin: the same body twice"):
        scene.set_margin("left", "left", 1)


def test_what_rests_on_a_table_may_slide(cube):
    scene = chasles.Scene()
    scene.add("table", cube)
    scene.add("box", cube, [0, 0, 1.05, 1, 0, 0, 0], [0.5, 0, 1.05, 1, 0, 0, 0.1], motion="twist")
    assert scene.first_contact(margin=0.1).verdict == "contact_at_start"
    found = scene.first_contact(margin=0.1, hold=0.02)
    assert found.verdict == "clear" and found.clear_until == 1
    assert scene.all_contacts(margin=0.1, hold=0.02) == []
    assert scene.clear_until(margin=0.1, hold=0.02) == {"table": 1, "box": 1}
    scene.set_group_hold("", "", 0.02)
    for copy in (scene, pickle.loads(pickle.dumps(scene))):
        assert copy.first_contact(margin=0.1).verdict == "clear"
    scene.set_hold("table", "box", 0.2)  # not less than the margin
    assert scene.first_contact(margin=0.1).verdict == "contact_at_start"
    with pytest.raises(chasles.InvalidInput, match="query: hold: 0 is not less than the margin, which is 0 unless"):
        scene.first_contact(hold=0)


def test_many_scenes_with_dask(cube):
    dask = pytest.importorskip("dask")

    @dask.delayed
    def earliest(shapes, starts, goals):
        scene = chasles.Scene()
        for name, shape in shapes.items():
            scene.add(name, shape)
        scene.move_all(starts, goals)
        found = scene.first_contact(threads=1)
        return found.verdict, found.time, found.pair

    places = [[0, 3, 9], [0, 3, 6], [0, 3, 3.5], [1.5, 3, 9]]  # of three cubes in a row
    poses = np.zeros((4, 3, 7))
    poses[:, :, 0], poses[:, :, 3] = places, 1
    shapes = {"a": cube, "b": cube, "c": cube}
    answers = dask.compute(*[earliest(shapes, poses[i], poses[i + 1]) for i in range(3)], scheduler="threads")
    assert [answer[0] for answer in answers] == ["clear", "contact", "contact_at_start"]
    assert answers[1][1] == pytest.approx(2 / 2.5, abs=1e-12) and answers[1][2] == ("c", "b")  # "b" rests


def test_a_clear_scene_has_no_pair(scene):
    found = scene.first_contact(until=0.5, threads=1)
    assert found.verdict == "clear" and found.pair is None and found.clear_until == 0.5
    assert scene.all_contacts(until=0.5) == []
    scene.ignore("left", "right")
    assert scene.first_contact(find="any").verdict == "clear"


def test_bodies_move_one_by_one_and_all_at_once(scene):
    scene.move("floor", motion=chasles.ConstantTwist.between(pose(0, 0, -9), pose(0, 0, 0.5)))
    found = scene.first_contact()  # the top of the floor rises to both others before they meet, but "right" is higher
    assert found.pair == ("floor", "left") and found.simultaneous == []
    assert found.time == pytest.approx(8 / 9.5, abs=1e-12)
    scene.move("right", pose(4, 0.25, 0), pose(0, 0.25, 0))
    assert scene.first_contact().simultaneous == [("floor", "right")]
    rest = np.array([np.eye(4)] * 3)
    rest[:, 0, 3] = [0, 5, 10]
    scene.move_all(rest, rest, motion="twist")
    assert scene.first_contact().verdict == "clear"
    scene.remove("left")
    assert scene.names == ["floor", "right"] and len(scene) == 2


def test_groups_are_ignored(scene):
    scene.ignore_groups("right", "")
    assert scene.first_contact().verdict == "clear"


def test_a_scene_is_pickled_with_all_its_rules(scene, cube):
    scene.add("twist", cube, pose(0, 9, 0), pose(0, 3, 0, 0.9, 0.1, 0.2, 0.3), motion="twist")
    scene.add("given", cube, motion=chasles.ConstantVelocity.between(pose(0, -9, 0), pose(0, 0, 0), [0.5, 0.5, 0.5]))
    scene.add("gone", cube, pose(9, 9, 9))
    scene.ignore("left", "given")
    scene.set_margin("left", "gone", 2)
    scene.remove("gone")
    scene.add("gone", cube, pose(90, 9, 9))  # another body: the rules of the first one are forgotten
    scene.set_margin("left", "right", 1)
    scene.set_margin("right", "left", 0.5)  # the same pair
    scene.set_group_margin("", "right", 0.25)
    scene.ignore_groups("right", "right")
    scene.move("floor", pose(0, 0, -9), pose(0, 0, -0.5, 0.9, 0.1, 0.2, 0.3), centre=[0.5, 0.5, 0.5])
    again = pickle.loads(pickle.dumps(scene))
    assert again.names == scene.names
    found, expected = (
        [(c.pair, c.time, c.time_upper) for c in s.all_contacts(margin=0.1)] for s in (again, scene)
    )
    assert found == expected and len(found) > 1
    assert again.first_contact().time == pytest.approx(6.5 / 8, abs=1e-12)
    again.move("left", pose(-4, 0, 0))
    assert again.first_contact().time != scene.first_contact().time


def test_wrong_arguments_are_refused(scene, cube):
    for call, message in [
        (lambda: scene.add("left", cube), "scene: left: is in the scene already"),
        (lambda: scene.add("", cube), "scene: a body has no name"),
        (lambda: scene.add("a", cube, pose(0, 0, 0) * np.nan), "pose: "),
        (lambda: scene.add("a", cube, motion="screw"), "motion: "),
        (lambda: scene.add("a", cube, motion=chasles.ScrewMotion.between(pose(0, 0, 0), pose(1, 0, 0))), "scene: a: mo"),
        (lambda: scene.add("a", cube, pose(0, 0, 0), motion="twist", centre=[0, 0, 0]), "centre: a twist has none"),
        (lambda: scene.remove("b"), "scene: b: is not in the scene"),
        (lambda: scene.move_all(np.zeros((2, 7)), np.zeros((2, 7))), "starts, goals: 2 and 2 poses for 3 bodies"),
        (lambda: scene.move_all(np.zeros((3, 7)), np.zeros((3, 7))), "starts[0], goals[0]: "),
        (lambda: scene.first_contact(until=2), "query: until: must be in [0, 1]"),
    ]:
        with pytest.raises(chasles.InvalidInput) as error:
            call()
        assert str(error.value).startswith(message)
    with pytest.raises(TypeError, match="shape: must be a chasles.Polyhedron"):
        scene.add("a", None)
    assert scene.names == ["left", "right", "floor"]


def test_the_least_distance_names_its_pair(cube):
    """A cart passes a post at (0.3, 0.4); the wall beside the post stands still, as the post does."""
    scene = chasles.Scene()
    scene.add("post", cube)
    scene.add("wall", cube, pose=[1.001, 0, 0, 1, 0, 0, 0])
    assert scene.least_distance() is None  # nothing moves
    scene.add("cart", cube, pose=[-4, 1.3, 1.4, 1, 0, 0, 0], goal=[4, 1.3, 1.4, 1, 0, 0, 0])
    found = scene.least_distance(tolerance=1e-9)
    assert found.pair[0] == "cart" and found.certain
    assert found.distance <= 0.5 <= found.distance_upper + 1e-12 and found.distance_upper - found.distance < 1e-8
    assert found.contacts[0].gap == pytest.approx(0.5, abs=1e-9) and "cart to " in repr(found)
    scene.ignore("cart", "post")
    assert scene.least_distance().pair == ("cart", "wall")
    with chasles.Limit(1e-9), pytest.raises(chasles.Cancelled):
        scene.least_distance()  # no pair was looked at
    with pytest.raises(chasles.InvalidInput, match="tolerance"):
        scene.least_distance(tolerance=2)
    assert chasles.least_distance(cube, cube, [3, 0, 0, 1, 0, 0, 0], [4, 0, 0, 1, 0, 0, 0]).pair is None
