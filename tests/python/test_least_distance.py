"""How near bodies come."""

import math

import numpy as np
import pytest
from cubes import CUBE_VERTICES, pose, random_motions

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


def round_body(radius: float, splits: int = 3) -> chasles.Polyhedron:
    """An octahedron whose faces are split and whose vertices are moved to a sphere."""
    axes = np.vstack([np.eye(3), -np.eye(3)])
    corners = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    triangles = np.array([[axes[i] for i in corner] for corner in corners])
    for _ in range(splits):
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        d, e, f = (a + b) / 2, (b + c) / 2, (c + a) / 2
        triangles = np.concatenate([np.stack(part, 1) for part in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))])
    points = triangles.reshape(-1, 3)
    points, index = np.unique(points.round(9), axis=0, return_inverse=True)
    points *= radius / np.linalg.norm(points, axis=1, keepdims=True)
    return chasles.Polyhedron(points, index.reshape(-1, 3))


def assert_distance(found, expected):
    assert found.certain and found.distance <= expected <= found.distance_upper
    assert found.distance_upper - found.distance <= 1e-6 * found.distance_upper


def test_the_distance_of_a_round_body_that_flies_over_a_cube(cube):
    ball = round_body(0.5)
    found = chasles.least_distance(ball, cube, pose(-3, 0.4, 1.75), pose(4, 0.4, 1.75))
    assert_distance(found, 0.25)  # its lowest vertex is straight below the centre
    assert 3 / 7 - 1e-9 <= found.time <= found.time_upper <= 4 / 7 + 1e-9
    assert found.contacts[0].kind == "vertex_face" and found.contacts[0].normal == pytest.approx([0, 0, 1])
    turning = chasles.least_distance(ball, cube, pose(-3, 0.4, 1.75), pose(4, 0.4, 1.75, 0.2, 0.3, 0.9, 0.1))
    assert 0.25 <= turning.distance_upper < 0.25 + 0.5 * (1 - math.cos(math.radians(12)))


def test_the_distance_of_a_turning_edge(cube):
    """At 135 degrees the edge opposite to the axis is nearest: it is sqrt(2) away from the axis."""
    half = math.radians(85)
    found = chasles.least_distance(cube, cube, pose(3.5, 0, 0), pose(3.5, 0, 0, math.cos(half), 0, 0, math.sin(half)))
    assert_distance(found, 2.5 - math.sqrt(2))
    assert found.time == pytest.approx(135 / 170, abs=1e-6)
    assert found.contacts[0].gap == pytest.approx(2.5 - math.sqrt(2), rel=1e-12)


def test_bodies_that_touch_have_the_answer_of_first_contact(cube):
    for start, goal in ((pose(3, 0.2, 0.3), pose(-1, 0.2, 0.3)), (pose(0.5, 0.5, 0.25), pose(5, 0, 0))):
        found, touch = chasles.least_distance(cube, cube, start, goal), chasles.first_contact(cube, cube, start, goal)
        assert (found.distance, found.distance_upper, found.certain) == (0, 0, True)
        assert (found.time, found.time_upper, found.tau_upper) == (touch.time, touch.time_upper, touch.tau_upper)
        assert repr(found.contacts) == repr(touch.contacts) and repr(found.overlap) == repr(touch.overlap)
        np.testing.assert_array_equal(found.pose, touch.pose)
    assert repr(found) == "<chasles.LeastDistance: 0, touching at time 0, overlapping>"


def test_first_contact_agrees(cube):
    for start, goal in zip(*random_motions(60)):
        found = chasles.least_distance(cube, cube, start, goal)
        touch = chasles.first_contact(cube, cube, start, goal)
        assert (found.distance > 0) == (touch.verdict == "clear")
        if found.distance > 0:
            within = chasles.first_contact(cube, cube, start, goal, margin=(1 + 1e-9) * found.distance_upper)
            assert within.verdict != "clear"
            assert chasles.first_contact(cube, cube, start, goal, margin=(1 - 1e-9) * found.distance).verdict == "clear"
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
    assert chasles.least_distance(cube, cube, still, still, max_turn=0.05).motion.max_turn == 0.05
    with pytest.raises(chasles.InvalidInput, match=r"tolerance: must be in \[1e-12, 1\]"):
        chasles.least_distance(cube, cube, *BESIDE, tolerance=0)
    with pytest.raises(chasles.InvalidInput, match="find"):
        chasles.least_distance(cube, cube, *BESIDE, find="any")
    with pytest.raises(chasles.InvalidInput, match="start: .*NaN"):
        chasles.least_distance(cube, cube, pose(np.nan, 0, 0), still)
    with pytest.raises(TypeError):  # check has a margin
        chasles.least_distance(cube, cube, *BESIDE, margin=0.1)
    for bodies in ((None, cube), (cube, CUBE_VERTICES)):
        with pytest.raises(TypeError, match="must be a chasles.Polyhedron"):
            chasles.least_distance(*bodies, *BESIDE)


def test_bodies_swap_their_roles(cube):
    ball = round_body(0.5, 1)
    found = chasles.least_distance(ball, cube, pose(-3, 0.4, 1.75), pose(4, 0.4, 1.75))
    other = found.swapped()
    assert (other.moving is cube, other.fixed is ball, other.is_swapped) == (True, True, True)
    assert (other.distance, other.distance_upper, other.time) == (found.distance, found.distance_upper, found.time)
    np.testing.assert_array_equal(other.fixed_pose, found.pose)
    np.testing.assert_array_equal(other.contacts[0].normal, -found.contacts[0].normal)
    assert (other.contacts[0].moving, other.contacts[0].fixed) == (found.contacts[0].fixed, found.contacts[0].moving)
    assert repr(other.swapped()) == repr(found)


def test_a_batch_answers_as_single_questions_do(cube):
    starts, goals = random_motions(80)
    table = chasles.least_distance_batch(cube, cube, starts, goals, threads=2)
    assert table.dtype == chasles.least_dtype
    assert 10 < np.count_nonzero(table["verdict"] == "clear") < 70
    for row, start, goal in zip(table, starts, goals):
        found = chasles.least_distance(cube, cube, start, goal)
        touch = chasles.first_contact(cube, cube, start, goal)
        assert (row["verdict"], row["clear_until"]) == (touch.verdict, touch.clear_until)
        assert (row["distance"], row["distance_upper"]) == (found.distance, found.distance_upper)
        assert (row["time"], row["time_upper"], row["certain"]) == (found.time, found.time_upper, found.certain)
        assert (row["tau"], row["tau_upper"]) == (found.tau, found.tau_upper)
        contact = found.contacts[0]
        assert row["kind"] == contact.kind
        assert tuple(row["moving_feature"][: len(contact.moving)]) == contact.moving
        np.testing.assert_array_equal([row["px"], row["py"], row["pz"]], contact.point)
        np.testing.assert_array_equal([row["nx"], row["ny"], row["nz"]], contact.normal)


def test_a_row_claims_only_what_is_proven(cube):
    starts = [pose(0.5, 0.5, 0.25), pose(-2, 1 + 1e-15, 0), pose(-2, 1.5, 0)]
    goals = [pose(5, 0, 0), pose(2, 1 + 1e-15, 0), pose(2, 1.5, 0)]
    overlapping, grazing, clear = chasles.least_distance_batch(cube, cube, starts, goals)
    assert overlapping["verdict"] == "contact_at_start" and overlapping["kind"] == ""
    assert overlapping["moving_feature"][0] >= 0 and np.isfinite(overlapping["px"])
    assert clear["verdict"] == "clear" and clear["clear_until"] == 1 and clear["certain"]
    assert grazing["verdict"] == ("clear" if grazing["distance"] > 0 else "unknown")
    assert grazing["distance_upper"] > 0 and grazing["clear_until"] == (grazing["distance"] > 0)


@pytest.mark.parametrize("threads", [1, 3])
def test_the_same_rows_for_any_number_of_threads(cube, threads):
    starts, goals = random_motions(60)
    expected = chasles.least_distance_batch(cube, cube, starts, goals)
    assert chasles.least_distance_batch(cube, cube, starts, goals, threads=threads).tobytes() == expected.tobytes()


def test_a_table_is_finished(cube):
    starts, goals = random_motions(20)
    expected = chasles.least_distance_batch(cube, cube, starts, goals)
    table = chasles.empty_table(20, chasles.least_dtype)
    assert (table["verdict"] == "not_done").all() and np.isnan(table["distance_upper"]).all()
    table[:5] = expected[:5]
    table["distance"][:5] = 7  # a value that no answer has
    assert chasles.least_distance_batch(cube, cube, starts, goals, table=table) is table
    assert (table["distance"][:5] == 7).all() and table[5:].tobytes() == expected[5:].tobytes()
    with pytest.raises(chasles.InvalidInput, match="table"):
        chasles.least_distance_batch(cube, cube, starts, goals, table=chasles.empty_table(20))


def test_a_bar_shows_progress(cube, capsys):
    pytest.importorskip("tqdm")
    chasles.least_distance_batch(cube, cube, *random_motions(10), progress=True)
    assert "10/10" in capsys.readouterr().err


def test_a_batch_names_the_pose_that_it_refuses(cube):
    starts, goals = random_motions(5)
    starts = np.array(starts)
    starts[3, 0] = np.nan
    with pytest.raises(chasles.InvalidInput, match=r"starts\[3\]"):
        chasles.least_distance_batch(cube, cube, starts, goals)
    table = chasles.least_distance_batch(cube, cube, starts, goals, errors="mark")
    assert table["verdict"][3] == "error" and np.isnan(table["distance"][3])
    assert np.isfinite(table["distance"][[0, 1, 2, 4]]).all()
    with pytest.raises(chasles.InvalidInput, match="goals: there are 4 for 5 starts"):
        chasles.least_distance_batch(cube, cube, starts, goals[:4])


@pytest.mark.parametrize("options", [{"tolerance": -1}, {"time_tolerance": 2}, {"max_turn": 0}, {"threads": -1}])
def test_options_of_a_batch_are_refused_without_motions_too(cube, options):
    with pytest.raises(chasles.InvalidInput, match=next(iter(options))):
        chasles.least_distance_batch(cube, cube, [], [], **options)
