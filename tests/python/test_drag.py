"""A dragged body: it slides on what it touches, and pieces of its way are clear."""

import concurrent.futures

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


def test_friction_holds_a_box_back(scene):
    hand = chasles.DraggedBody(scene, "box", margin=1e-3, friction=0.5)
    rest = hand.update(pose(0, 0, -1)).pose[2, 3]
    push = rest + 1
    held = hand.update(pose(0.4 * push, 0, -1))
    assert held.pose[:3, 3] == pytest.approx([0, 0, rest], abs=1e-9) and held.state == "resting"
    slid = hand.update(pose(0, 0.6 * push, -1))
    assert slid.pose[:3, 3] == pytest.approx([0, 0.1 * push, rest], abs=1e-6)
    assert slid.wrench[:3] == pytest.approx([0, -0.5 * push, push], abs=1e-6)
    friction = sum(contact.friction for contact in slid.contacts)
    assert friction == pytest.approx([0, -0.5 * push, 0], abs=1e-6)
    for contact in slid.contacts:
        assert np.linalg.norm(contact.friction) <= 0.5 * contact.force * (1 + 1e-9)


def test_locks_leave_what_they_name(scene):
    slider = chasles.DragLock("slider", [0, 0, -2])
    assert slider.kind == "slider" and "slider" in repr(slider)
    step = chasles.DraggedBody(scene, "box", lock=slider).update(pose(4, -3, 5))
    assert step.state == "reached" and step.pose[:3, 3] == pytest.approx([0, 0, 5], abs=1e-12)
    assert step.distance == pytest.approx(5, abs=1e-9)
    hinge = chasles.DragLock("hinge", direction=[0, 0, 1], point=[-2, 0, 0])
    hand = chasles.DraggedBody(scene, "box", lock=hinge)
    for step in hand.follow(np.array([pose(*np.random.default_rng(i).uniform(-3, 3, 3)) for i in range(50)])):
        assert step.pose @ [-2, 0, 0, 1] == pytest.approx([-2, 0, 5, 1], abs=1e-13)
        assert step.pose[:3, 2] == pytest.approx([0, 0, 1], abs=1e-13)


@pytest.mark.parametrize("inertia", [0.1, 0.4, 3])
def test_mass_says_how_hard_turning_is_against_shifting(scene, inertia):
    """A lever of length 2 and a goal that is shifted by 1 and not turned: the energy of the spring has no slope there."""
    hinge = chasles.DragLock("hinge", [0, 0, 1], [-2, 0, 0])
    mass = chasles.MassProperties(inertia * np.eye(3))
    hand = chasles.DraggedBody(scene, "box", lock=hinge, mass=mass)
    for _ in range(4):
        step = hand.update(pose(0, 1, 5))
    angle = np.arctan2(step.pose[1, 0], step.pose[0, 0])
    # 1/2 |(2, 1) - 2 (cos a, sin a)|^2 + 1/2 I a^2
    assert 4 * np.sin(angle) - 2 * np.cos(angle) + inertia * angle == pytest.approx(0, abs=1e-6)


def test_the_force_for_another_goal_needs_no_update(scene):
    hand = chasles.DraggedBody(scene, "box", margin=1e-3, stiffness=10, friction=0.2)
    step = hand.update(pose(0, 0, -1))
    assert np.array_equal(hand.force(pose(0, 0, -1)), step.wrench)
    deeper = hand.force(pose(0.1, 0, -2))
    assert deeper[:3] == pytest.approx([-1, 0, step.wrench[2] + 10], abs=1e-6)
    assert np.array_equal(hand.pose, step.pose)
    with pytest.raises(chasles.InvalidInput, match="goal"):
        hand.force([1, 2])


def test_forces_on_another_thread(scene):
    hand = chasles.DraggedBody(scene, "box", margin=1e-3)
    push = hand.update(pose(0, 0, -1)).wrench[2]
    with concurrent.futures.ThreadPoolExecutor(1) as geometry:
        goals = np.array([pose(0.4 * np.sin(0.1 * i), 0, -1) for i in range(300)])
        following = geometry.submit(hand.follow, goals)
        forces = []
        while not following.done() or not forces:
            forces.append(hand.force(pose(0, 0, -1))[2])
    assert np.array(forces) == pytest.approx(push, abs=1e-9)


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
    with pytest.raises(chasles.InvalidInput, match="drag: friction"):
        chasles.DraggedBody(scene, "box", friction=float("nan"))
    with pytest.raises(chasles.InvalidInput, match="drag: lock: the direction"):
        chasles.DraggedBody(scene, "box", lock=chasles.DragLock("hinge", [0, 0, 0]))
    with pytest.raises(chasles.InvalidInput, match=r"inertia: shape \(3,\); a matrix of inertia has shape \(3, 3\)"):
        chasles.MassProperties([1, 1, 1])
    with pytest.raises(chasles.InvalidInput, match="drag: mass: the inertia must be symmetric"):
        chasles.DraggedBody(scene, "box", mass=chasles.MassProperties(np.diag([1, 1, -1])))
    with pytest.raises(chasles.InvalidInput, match="drag: lock: the kind must be .* not door"):
        chasles.DragLock("door")
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
