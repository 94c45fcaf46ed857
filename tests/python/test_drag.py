"""A dragged body: it slides on what it touches, and pieces of its way are clear."""

import numpy as np
import pytest
from cubes import pose

import chasles


@pytest.fixture
def scene(cube):
    scene = chasles.Scene()
    scene.add("floor", cube, pose(0, 0, 0))
    scene.add("box", cube, pose(0, 0, 3))
    return scene


def test_a_box_slides_on_another_one(scene):
    hand = chasles.DraggedBody(scene, "box", margin=1e-3, stiffness=10)
    assert hand.margin == 1e-3 and "box" in repr(hand)
    step = hand.update(pose(0, 0, -1))
    rest = step.pose[2, 3]
    assert step.state == "resting" and step.blocking == ["floor"]
    assert [event.begins for event in step.events] == [True] * len(step.contacts)
    assert min(contact.contact.gap for contact in step.contacts) == pytest.approx(1e-3, rel=1e-6)
    assert step.wrench[2] == pytest.approx(10 * (rest + 1), abs=1e-6)
    assert sum(contact.force for contact in step.contacts) == pytest.approx(step.wrench[2], abs=1e-9)
    step = hand.update(pose(0.3, 0.2, -1), seconds=1 / 60)
    assert step.pose[:3, 3] == pytest.approx([0.3, 0.2, rest], abs=1e-9)
    assert "resting" in repr(step) and step.distance == pytest.approx(rest + 1, abs=1e-9)
    step = hand.update(pose(0, 0, 5))
    assert step.state == "reached" and step.distance == 0 and step.contacts == []
    assert np.array_equal(step.pose, hand.pose)


def test_each_piece_is_clear(scene, cube):
    hand = chasles.DraggedBody(scene, "box")
    random = np.random.default_rng(1)
    goals = np.array([pose(*random.uniform(-2, 2, 3)) for _ in range(60)])
    before, in_contact = hand.pose, 0
    for step in hand.follow(goals):
        for start, goal, until, clearance in step.pieces:
            found = chasles.first_contact(cube, cube, start, goal)
            assert clearance > 0 and (found.verdict == "clear" or found.time > until)
        in_contact += len(step.contacts) > 0
    assert in_contact > 5
    assert not np.array_equal(before, hand.pose)


def test_what_moves_in_is_reported(scene):
    hand = chasles.DraggedBody(scene, "box")
    scene.move("floor", pose(0, 0, 0), pose(0, 0, 3))
    step = hand.update(pose(0, 0, 5))
    assert [name for name, time in step.intrusions] == ["floor"]
    assert step.state == "touching" and step.touching == ["floor"] and step.pieces == []


def test_refuses_what_it_cannot_use(scene):
    with pytest.raises(chasles.InvalidInput, match="scene: nut: is not in the scene"):
        chasles.DraggedBody(scene, "nut")
    with pytest.raises(chasles.InvalidInput, match="drag: margin"):
        chasles.DraggedBody(scene, "box", margin=-1)
    hand = chasles.DraggedBody(scene, "box")
    with pytest.raises(chasles.InvalidInput, match="goal"):
        hand.update([1, 2])
    scene.remove("box")
    with pytest.raises(chasles.InvalidInput, match="box"):
        hand.update(pose(0, 0, 5))


def test_the_scene_outlives_its_name(scene, cube):
    def held():
        own = chasles.Scene()
        own.add("floor", cube, pose(0, 0, 0))
        own.add("box", cube, pose(0, 0, 3))
        return chasles.DraggedBody(own, "box")

    assert held().update(pose(0, 0, 5)).state == "reached"
