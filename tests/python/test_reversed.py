"""Motions back from their goal, of every kind."""

import chasles
import numpy as np
import pytest
from motion_kinds import GOAL, KINDS, START


@pytest.mark.parametrize("kind", KINDS)
def test_the_poses_are_those_from_the_end(kind):
    motion = KINDS[kind]()
    back = motion.reversed()
    for time in (0, 0.25, 0.5, 1):
        np.testing.assert_allclose(back.pose_at(time), motion.pose_at(1 - time), atol=1e-14)
        np.testing.assert_allclose(back.fixed_pose_at(time), motion.fixed_pose_at(1 - time), atol=1e-14)


@pytest.mark.parametrize("kind", ["screw", "sweep"])
def test_screws_and_sweeps_stay_what_they_are(kind):
    motion = KINDS[kind]()
    assert type(motion.reversed()) is type(motion)
    assert motion.reversed().angle == motion.angle


def test_the_last_contact_is_the_first_one_on_the_way_back(cube):
    # Two unit cubes touch from x = 1 to x = -1 on the way from 3 to -5.
    beyond = [-5, *GOAL[1:]]
    through = chasles.ConstantVelocity.between(START, beyond)
    assert chasles.first_contact(cube, cube, motion=through).time == pytest.approx(2 / 8, abs=1e-12)
    last = chasles.first_contact(cube, cube, motion=through.reversed())
    assert 1 - last.time == pytest.approx(4 / 8, abs=1e-12)
