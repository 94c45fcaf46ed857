"""Motions back from their goal, of every kind."""

import chasles
import numpy as np
import pytest
from motion_kinds import GOAL, KINDS, START


@pytest.mark.parametrize("kind", [kind for kind in KINDS if not kind.startswith("screw")])
def test_the_poses_are_those_from_the_end(kind):
    motion = KINDS[kind]()
    back = motion.reversed()
    for time in (0, 0.25, 0.5, 1):
        np.testing.assert_allclose(back.pose_at(time), motion.pose_at(1 - time), atol=1e-14)
        np.testing.assert_allclose(back.fixed_pose_at(time), motion.fixed_pose_at(1 - time), atol=1e-14)


def test_a_sweep_stays_a_sweep_and_a_screw_has_no_way_back():
    sweep = KINDS["sweep"]()
    assert type(sweep.reversed()) is chasles.SweepMotion
    assert sweep.reversed().angle == sweep.angle
    with pytest.raises(chasles.InvalidInput, match="the constant twist between the same poses has one"):
        KINDS["screw"]().reversed()


def test_the_last_contact_is_the_first_one_on_the_way_back(cube):
    # Two unit cubes touch from x = 1 to x = -1 on the way from 3 to -5.
    beyond = [-5, *GOAL[1:]]
    through = chasles.ConstantVelocity.between(START, beyond)
    assert chasles.first_contact(cube, cube, motion=through).time == pytest.approx(2 / 8, abs=1e-12)
    last = chasles.first_contact(cube, cube, motion=through.reversed())
    assert 1 - last.time == pytest.approx(4 / 8, abs=1e-12)
