"""An argument that says nothing is refused by its name, with the way out."""

import pytest
from public_objects import any_pose, cube, hinge, pose

import chasles

STILL = "is for a body that moves; without a goal it stands still"


@pytest.mark.parametrize("kind, parts", [("free", ("direction", "point")), ("slider", ("point",)), ("plane", ("point",))])
def test_parts_of_a_lock_that_has_none(kind, parts):
    for part in parts:
        with pytest.raises(chasles.InvalidInput) as error:
            chasles.DragLock(kind, **{part: [0, 0, 1]})
        assert str(error.value) == f"drag: lock: {part}: says nothing about a lock of the kind {kind}"
    assert chasles.DragLock(kind).kind == kind


def test_parts_of_a_lock_that_has_them():
    for kind in ("hinge", "cylinder"):
        assert chasles.DragLock(kind, [0, 1, 0], point=[1, 0, 0]).kind == kind
    for kind in ("slider", "plane"):
        assert chasles.DragLock(kind, direction=[0, 1, 0]).kind == kind


@pytest.mark.parametrize("given", [{"motion": "twist"}, {"motion": "velocity"}, {"centre": [0, 0, 1]}])
def test_a_motion_of_a_body_that_stands_still(given):
    scene = chasles.Scene()
    scene.add("body", cube(), any_pose(3))
    stepper = chasles.Stepper(scene, margin=1e-3)
    (name,) = given
    for ask in (
        lambda: scene.add("other", cube(), **given),
        lambda: scene.add("other", cube(), any_pose(3), **given),
        lambda: scene.move("body", any_pose(3), **given),
        lambda: stepper.move("body", **given),
    ):
        with pytest.raises(chasles.InvalidInput) as error:
            ask()
        assert str(error.value) == f"{name}: {STILL}"
    assert scene.names == ["body"]


def test_what_is_no_motion_is_named_before_the_poses():
    scene = chasles.Scene()
    questions = [
        lambda motion: chasles.first_contact(cube(), cube(), pose(3, 0, 0), pose(2, 0, 0), motion=motion),
        lambda motion: chasles.least_distance(cube(), cube(), pose(3, 0, 0), pose(2, 0, 0), motion=motion),
        lambda motion: chasles.profile(cube(), cube(), pose(3, 0, 0), pose(2, 0, 0), motion=motion),
        lambda motion: scene.add("body", cube(), pose(3, 0, 0), pose(2, 0, 0), motion=motion),
    ]
    for ask in questions:
        with pytest.raises(chasles.InvalidInput, match="^motion: 3 must be a motion, such as "):
            ask(3)
        with pytest.raises(chasles.InvalidInput, match="^motion: .*(both a motion and poses|stands instead of pose)"):
            ask(hinge())


def test_the_limit_says_what_profiles_do():
    assert "profiles the bounds so far" in chasles.Limit.__doc__
