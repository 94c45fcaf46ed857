"""How near bodies come."""

import numpy as np
import pytest
from cubes import pose, random_motions

import chasles

BESIDE = ([-3, 1.25, 0.5, 1, 0, 0, 0], [3, 1.25, 0.5, 1, 0, 0, 0])


def test_the_distance_of_cubes_that_pass_each_other(cube):
    found = chasles.least_distance(cube, cube, *BESIDE)
    assert found.distance <= 0.25 <= found.distance_upper
    assert found.certain and found.distance_upper - found.distance <= 0.25e-6
    assert 1 / 3 - 1e-9 <= found.time <= found.time_upper <= 2 / 3 + 1e-9
    assert len(found.contacts) == 1 and found.contacts[0].gap == pytest.approx(0.25)
    assert found.pose[0, 3] == pytest.approx(-3 + 6 * found.time)
    assert found.overlap is None and not found.contacts_cut
    assert repr(found).startswith("<chasles.LeastDistance: 0.2499")


def test_first_contact_agrees(cube):
    for start, goal in zip(*random_motions(60)):
        found = chasles.least_distance(cube, cube, start, goal)
        touch = chasles.first_contact(cube, cube, start, goal)
        assert (found.distance > 0) == (touch.verdict == "clear")
        if found.distance > 0:
            within = chasles.first_contact(cube, cube, start, goal, margin=1.001 * found.distance_upper)
            assert within.verdict != "clear"
            assert chasles.first_contact(cube, cube, start, goal, margin=0.999 * found.distance).verdict == "clear"
        else:
            assert (found.distance_upper, found.time, found.time_upper) == (0, touch.time, touch.time_upper)


def test_options(cube):
    still = pose(3, 0, 0)
    moved = chasles.least_distance(cube, cube, still, still, fixed_start=pose(0, 0, 0), fixed_goal=pose(-1, 0, 0))
    assert moved.distance == pytest.approx(2, rel=1e-5)
    everything = chasles.least_distance(cube, cube, still, still, find="first_with_all_contacts")
    assert len(everything.contacts) == 4
    sweep = chasles.SweepMotion.between(*BESIDE)
    rough = chasles.least_distance(cube, cube, motion=sweep, tolerance=0.5)
    assert rough.distance_upper - rough.distance > 1e-3
    swapped = everything.swapped()
    assert swapped.is_swapped and swapped.contacts[0].moving == everything.contacts[0].fixed
    with pytest.raises(chasles.InvalidInput, match=r"tolerance: must be in \[1e-12, 1\]"):
        chasles.least_distance(cube, cube, *BESIDE, tolerance=0)
    with pytest.raises(chasles.InvalidInput, match="find"):
        chasles.least_distance(cube, cube, *BESIDE, find="any")


def test_a_batch_answers_as_single_questions_do(cube):
    starts, goals = random_motions(80)
    table = chasles.least_distance_batch(cube, cube, starts, goals, threads=2)
    assert table.dtype == chasles.least_dtype
    assert 10 < np.count_nonzero(table["verdict"] == "clear") < 70
    for row, start, goal in zip(table, starts, goals):
        found = chasles.least_distance(cube, cube, start, goal)
        assert (row["distance"], row["distance_upper"]) == (found.distance, found.distance_upper)
        assert (row["time"], row["time_upper"], row["certain"]) == (found.time, found.time_upper, found.certain)
        if found.contacts:
            assert row["kind"] == found.contacts[0].kind
            np.testing.assert_array_equal([row["px"], row["py"], row["pz"]], found.contacts[0].point)


def test_a_batch_names_the_pose_that_it_refuses(cube):
    starts, goals = random_motions(5)
    starts = np.array(starts)
    starts[3, 0] = np.nan
    with pytest.raises(chasles.InvalidInput, match=r"starts\[3\]"):
        chasles.least_distance_batch(cube, cube, starts, goals)
    table = chasles.least_distance_batch(cube, cube, starts, goals, errors="mark")
    assert table["verdict"][3] == "error" and np.isnan(table["distance"][3])
    assert np.isfinite(table["distance"][[0, 1, 2, 4]]).all()
    with pytest.raises(chasles.InvalidInput, match="tolerance"):
        chasles.least_distance_batch(cube, cube, goals, goals, tolerance=-1)
