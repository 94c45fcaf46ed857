"""What answers about many bodies do not look at, and robots that carry, hold and stand on a table."""

import numpy as np
import pytest
from cubes import pose

import chasles

ARM = """<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.3 0.3 0.2"/></geometry></collision></link>
  <link name="l1"><collision><origin xyz="0.5 0 0.35"/><geometry><box size="1 0.1 0.1"/></geometry></collision></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><axis xyz="0 0 1"/><limit lower="3" upper="-3"/></joint>
</robot>"""


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    (tmp_path / "arm.srdf").write_text(
        '<robot name="arm"><disable_collisions link1="base" link2="table" reason="Never"/></robot>'
    )
    return chasles.Robot.load(tmp_path / "arm.urdf", srdf=tmp_path / "arm.srdf")


@pytest.fixture
def tiles(cube):
    scene = chasles.Scene()
    for i in range(4):
        scene.add(f"t{i}", cube, pose(i, 0, 0))
    scene.add("moving", cube, pose(0, 0, 5), pose(3, 0, 5))
    return scene


def test_bodies_at_rest_are_no_question_about_motion(tiles):
    found = tiles.first_contact()
    assert found.verdict == "clear" and tiles.all_contacts() == []
    assert found.untested.reasons == {"at_rest": 6} and len(found.untested) == 6 and found.untested.tested == 4
    assert found.untested.named[0] == ("t0", "t1", "at_rest")
    assert tiles.first_contact(until=0).verdict == "contact_at_start"
    assert len(tiles.all_contacts(until=0)) == 3
    assert len(tiles.untested(until=0)) == 0


def test_what_touches_at_the_start_is_ignored_and_named(tiles, cube):
    tiles.add("lid", cube, pose(0, 0, 1), pose(0, 0, 3))
    assert tiles.first_contact().verdict == "contact_at_start"
    assert tiles.ignore_touching_at_start() == [("lid", "t0"), ("lid", "t1"), ("t0", "t1"), ("t1", "t2"), ("t2", "t3")]
    assert tiles.first_contact().untested.reasons == {"at_rest": 3, "touching_at_start": 5}
    assert tiles.first_contact().verdict == "clear"


def test_a_manager_tells_what_touches_as_it_stands(cube):
    manager = chasles.CollisionManager()
    manager.add_object("a", cube)
    manager.add_object("b", cube, pose(0.5, 0, 0))
    assert manager.in_collision_internal(return_names=True) == (True, {("a", "b")})
    assert manager.in_collision_single(cube, pose(0, 0.5, 0))
    assert manager.min_distance_internal() == 0


def test_robots_say_what_they_do_not_test(arm, cube):
    scene = chasles.Scene()
    scene.add("table", cube, pose(-0.5, -0.5, -1))
    assert arm.first_contact([0], [1], scene=scene).verdict == "contact_at_start"
    arm.ignore_in_scene("base", "table")
    found = arm.first_contact([0], [1], scene=scene)
    assert found.verdict == "clear" and found.untested.reasons == {"adjacent": 1, "ignored": 1}
    assert found.untested.named == [("base", "l1", "adjacent"), ("base", "table", "ignored")]
    assert "1 pairs are tested, and 2 are not" in repr(found)
    checker = chasles.RobotChecker(arm, scene)
    assert repr(checker.untested) == repr(checker.least_distance([0], [1]).untested) == repr(found.untested)


def test_robots_hold_a_distance(arm, cube):
    scene = chasles.Scene()
    scene.add("table", cube, pose(-0.5, -0.5, -1.05))
    assert arm.first_contact([0], [1], scene=scene, margin=0.1).verdict == "contact_at_start"
    assert arm.first_contact([0], [1], scene=scene, margin=0.1, hold=0.02).verdict == "clear"
    assert chasles.RobotChecker(arm, scene, margin=0.1, hold=0.02).is_clear([0], [1])
    assert arm.first_contact_on_path([[0], [1]], scene=scene, margin=0.1, hold=0.02).verdict == "clear"


def test_files_and_paths_make_warnings(arm):
    assert len(arm.warnings) == 2
    assert "limit: the lower one, 3, is above the upper one, -3: the joint has no limits" in arm.warnings[0]
    assert arm.warnings[1].endswith("there is no link 'table'")
    assert np.isinf(arm.limits).all()
    assert arm.warnings_about([[0], [90]]) == ["j1: 90 in configuration 1 looks like degrees; angles are in radians"]


def test_a_robot_is_a_body_of_a_scene(arm, cube):
    shape = arm.shape()
    assert shape.vertices.shape == (16, 3)
    scene = chasles.Scene()
    scene.add("arm", shape)
    scene.add("cube", cube, pose(0, 0, 2), pose(0, 0, -2))
    assert scene.first_contact().time == pytest.approx((2 - 0.4) / 4, abs=1e-12)


def test_proofs_tell_their_progress(arm):
    done = []
    proofs = arm.prove_pairs(progress=done.append)
    assert [proof.reason for proof in proofs] == ["adjacent"]
    assert all(isinstance(count, int) for count in done)


def test_the_text_of_an_answer_counts_untested_pairs(cube):
    scene = chasles.Scene()
    scene.add("a", cube)
    scene.add("b", cube, [0, 0, 9, 1, 0, 0, 0])
    scene.add("high", cube, [0, 0, 5, 1, 0, 0, 0], [1, 0, 5, 1, 0, 0, 0])
    assert repr(scene.first_contact()) == "<chasles.SceneContact: clear until 1, 1 pair not tested>"
    scene.ignore("a", "high")
    assert repr(scene.first_contact()) == "<chasles.SceneContact: clear until 1, 2 pairs not tested>"
    scene.remove("b")
    scene.add("low", cube, [0, 0, 0.5, 1, 0, 0, 0], [1, 0, 0.5, 1, 0, 0, 0])
    assert repr(scene.first_contact()).endswith(", 1 pair not tested>")
