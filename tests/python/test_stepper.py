"""Steps from contact to contact: bodies bounce and slide, and never go through."""

import numpy as np
import pytest
from cubes import pose

import chasles


@pytest.fixture
def scene(cube):
    scene = chasles.Scene()
    scene.add("left", cube, pose(-4, 0, 0), pose(0, 0, 0))
    scene.add("right", cube, pose(4, 0, 0), pose(0, 0, 0))
    scene.add("floor", cube, pose(0, 0, -9))
    return scene


def test_two_cubes_bounce(scene):
    stepper = chasles.Stepper(scene, margin=0.01)
    event = stepper.advance()
    assert event.time == stepper.time == pytest.approx((7 - 0.01) / 8, abs=1e-11)
    assert [contact.pair for contact in event.contacts] == [("left", "right")]
    assert event.connected == [] and "left on right" in repr(event)
    gaps = [contact.gap for contact in event.contacts[0].contacts]
    assert gaps == pytest.approx([0.01] * len(gaps), abs=1e-10) and len(gaps) == 4
    assert event.contacts[0].contacts[0].approach_speed == pytest.approx(8, abs=1e-9)
    rest = 1 - event.time
    for name, speed in [("left", -4), ("right", 4)]:
        goal = stepper.pose(name)
        goal[0, 3] += speed * rest
        stepper.move(name, goal)
    assert stepper.advance() is None and stepper.time == 1
    assert stepper.pose("left")[0, 3] == pytest.approx(-0.505 - 4 * rest, abs=1e-10)
    assert np.shape(stepper.poses()) == (3, 4, 4)


def test_the_scene_may_change_meanwhile(scene):
    stepper = chasles.Stepper(scene, margin=0.01)
    scene.remove("right")
    assert stepper.advance().contacts[0].pair == ("left", "right")
    stepper.move("left")  # stands still
    stepper.move("right", motion=chasles.ConstantTwist.between(stepper.pose("right"), pose(9, 0, 0)))
    assert stepper.advance() is None


def test_wrong_arguments_get_one_clear_error(scene):
    with pytest.raises(chasles.InvalidInput, match="margin: must be positive"):
        chasles.Stepper(scene, margin=0)
    with pytest.raises(chasles.InvalidInput, match="reach: must be at least"):
        chasles.Stepper(scene, margin=0.01, reach=0)
    stepper = chasles.Stepper(scene, margin=0.01, reach=0.03, threads=1)
    stepper.advance()
    with pytest.raises(chasles.InvalidInput, match="scene: nobody: is not in the scene"):
        stepper.move("nobody")
    with pytest.raises(chasles.InvalidInput, match="left: move: the motion starts .* away"):
        stepper.move("left", motion=chasles.ConstantTwist.between(pose(9, 0, 0), pose(8, 0, 0)))
    with pytest.raises(chasles.InvalidInput, match="left on right: at time .* they are nearer"):
        while stepper.advance() is not None:
            pass
