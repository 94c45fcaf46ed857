"""The gate for actions of policies. Distances are compared with those of NumPy at dense samples, which can only refute."""

import json
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from arm_by_numpy import Bars, bare_arm, frames, samples
from seven_joints import arm, box, chunk, clear_configuration, pose, world

import chasles
from chasles.policy import PolicyGate

MARGIN = 0.005
LONG = 60_000.0  # milliseconds: no test of proofs depends on times
TIMES = 20 if os.environ.get("CHASLES_LONG") else 1


def capsules_only():
    """The arm of arm_by_numpy.py: without what has other shapes."""
    description = arm().description()
    for link in description["links"]:
        if link["name"] in ("base", "hand"):
            link["collisions"] = []
    return bare_arm(chasles.Robot(**description))


@pytest.fixture(scope="module")
def robot():
    return capsules_only()


def questions(robot, seed, count, **options):
    """Random chunks before gates in random worlds: bars, rows with the present configuration, and the decision."""
    random = np.random.default_rng(seed)
    for _ in range(count // 5):
        bars = Bars(random)
        scene = bars.scene()
        gate = PolicyGate(robot, scene, margin=MARGIN, milliseconds=LONG, **options)
        checker = chasles.RobotChecker(robot, scene, margin=MARGIN)
        for _ in range(5):
            present = clear_configuration(robot, checker, random)
            rows = np.vstack([present, chunk(robot, random, present)])
            yield bars, rows, gate(rows[0], rows[1:])


# --- What passes is proven, and what does not pass is not clear ---


def test_what_passes_keeps_the_margin_and_what_stops_comes_to_it(robot):
    """20 chunks of 50 actions, 501 poses of each; 20 times as many with CHASLES_LONG."""
    verdicts = {"passed": 0, "shortened": 0, "refused": 0}
    for bars, rows, decision in questions(robot, 1, 20 * TIMES, mode="shorten"):
        verdicts[decision.verdict] += 1
        times, at = samples(rows)
        near = bars.distances(at).min(axis=(1, 2))
        passed = len(decision.actions)
        assert near[times <= passed].min() > MARGIN - 1e-12
        assert np.array_equal(decision.actions, rows[1 : passed + 1])
        if decision.verdict == "passed":
            continue
        assert passed <= decision.time <= passed + 1 and decision.clear_until <= decision.time + 1e-9
        assert near[times < decision.clear_until].min() > MARGIN - 1e-12
        distances = bars.distances([np.interp(decision.time, np.arange(len(rows)), column) for column in rows.T])[0]
        link, bar = np.unravel_index(distances.argmin(), distances.shape)
        assert distances.min() == pytest.approx(MARGIN, abs=1e-8)
        assert decision.pair == (f"link{link + 1}", f"bar {bar}") and decision.pair[0] in decision.reason
        assert f"action {passed}" in decision.reason
    assert verdicts["passed"] > 5 and verdicts["shortened"] > 5, verdicts


def test_what_is_refused_is_what_is_shortened(robot):
    pairs = zip(questions(robot, 2, 20, mode="refuse"), questions(robot, 2, 20, mode="shorten"), strict=True)
    for (_, _, refusing), (_, _, shortening) in pairs:
        assert (refusing.verdict == "passed") == (shortening.verdict == "passed")
        assert refusing.verdict == "passed" or len(refusing.actions) == 0
        assert (refusing.pair, refusing.time) == (shortening.pair, shortening.time)


def test_chunks_that_collide_only_between_waypoints_are_all_refused(robot):
    """A ball of a millimetre on the way of a link, that no waypoint touches: 100 of 100."""
    random, refused = np.random.default_rng(5), 0
    while refused < 100:
        present = random.uniform(*robot.limits.T)
        rows = np.vstack([present, chunk(robot, random, present, count=20, step=0.15)])
        action, link = random.integers(1, 20), random.integers(3, 7)
        middle = (rows[action] + rows[action + 1]) / 2
        places, rotations = frames(middle)
        bars = Bars(random, 0)
        bars.a = bars.b = (places[0, link] + places[0, link + 1])[None] / 2 + rotations[0, link, :, 0] * 0.04
        bars.radii = np.array([0.001])
        if bars.distances(rows).min() < 1e-6 or bars.distances(middle).min() > -1e-6:
            continue  # a waypoint touches it, or none of the way does
        gate = PolicyGate(robot, bars.scene(), milliseconds=LONG)
        decision = gate(rows[0], rows[1:])
        assert decision.verdict == "refused" and decision.pair[1] == "bar 0" and len(decision.actions) == 0
        times, at = samples(rows, 10)
        first = times[bars.distances(at).min(axis=(1, 2)) < 0][0]
        assert decision.time <= first and decision.time % 1 > 0
        touch = [np.interp(decision.time, np.arange(len(rows)), column) for column in rows.T]
        assert bars.distances(touch).min() == pytest.approx(0, abs=1e-8)
        refused += 1


def test_the_way_to_the_first_action_is_checked(robot):
    rows = np.vstack([np.zeros(7), np.full((3, 7), 0.0)])
    rows[:, 1], rows[1:, 1] = -1.2, 1.2  # from one side to the other at once
    place = frames([0, 0.0, 0, 0, 0, 0, 0])[0][0, 5]
    scene = chasles.Scene()
    scene.add("ball", chasles.sphere(0.01), pose(*place))
    decision = PolicyGate(robot, scene, milliseconds=LONG, mode="shorten")(rows[0], rows[1:])
    assert decision.verdict == "refused" and 0 < decision.time < 1 and "on the way to action 0" in decision.reason
    assert np.linalg.norm(decision.place - place) < 0.01 + 1e-9
    assert PolicyGate(robot, scene, milliseconds=LONG)(rows[1], rows[1:]).verdict == "passed"


# --- Speeds by distance ---


def test_no_speed_is_above_the_line_and_none_rises(robot):
    full, seen = 0.1, set()
    for bars, rows, decision in questions(robot, 3, 20 * TIMES, mode="scale", full_speed_from=0.1):
        times, at = samples(rows)
        near = bars.distances(at).min(axis=(1, 2))
        least = np.array([near[(times >= k) & (times <= k + 1)].min() for k in range(len(rows) - 1)])
        line = np.clip((least - MARGIN) / (full - MARGIN), 0, 1)
        passed = len(decision.actions)
        assert np.all(decision.speeds <= line[:passed] + 1e-9) and np.all(np.diff(decision.speeds) <= 0)
        lowest = np.minimum.accumulate(line)
        assert np.all(decision.speeds >= np.floor(8 * lowest[:passed] - 1e-6) / 8 - 1e-9), (
            "in steps of an eighth, as near as that"
        )
        assert passed == len(rows) - 1 or np.floor(8 * lowest[passed] - 1e-6) <= 0 or line[passed] < 1 / 8 + 0.02
        assert decision.verdict not in ("shortened", "refused") or passed <= decision.time <= passed + 1
        seen.add(decision.verdict)
    assert seen >= {"slowed", "shortened"}


def test_slowed_actions_at_a_period_stay_on_the_path(robot):
    for _, rows, decision in questions(robot, 4, 10, mode="scale", full_speed_from=0.1):
        slow = decision.at_period(rows[0], rows[1:])
        assert len(slow) >= len(decision.actions)
        parts = np.ceil(1 / decision.speeds).astype(int)
        assert np.array_equal(slow[np.cumsum(parts) - 1], decision.actions)
        steps = np.abs(np.diff(np.vstack([rows[0], slow]), axis=0))
        ways = np.repeat(np.abs(np.diff(rows[: len(parts) + 1], axis=0)) * decision.speeds[:, None], parts, axis=0)
        assert np.all(steps <= ways + 1e-12)
        assert decision.times == pytest.approx(np.cumsum(1 / decision.speeds))


# --- Other interpolations ---


def natural_spline(rows, times):
    """By second derivatives that are 0 at both ends."""
    n = len(rows) - 1
    system, right = np.eye(n + 1), np.zeros(rows.shape)
    for i in range(1, n):
        system[i, i - 1 : i + 2] = 1 / 6, 4 / 6, 1 / 6
        right[i] = rows[i + 1] - 2 * rows[i] + rows[i - 1]
    second = np.linalg.solve(system, right)
    k = np.minimum(times.astype(int), n - 1)
    t = (times - k)[:, None]
    bend = ((1 - t) ** 3 - (1 - t)) * second[k] / 6 + (t**3 - t) * second[k + 1] / 6
    return (1 - t) * rows[k] + t * rows[k + 1] + bend


def test_a_shortened_spline_is_proven_as_the_spline_that_is_left(robot):
    verdicts = {"passed": 0, "shortened": 0, "refused": 0}
    for bars, rows, decision in questions(robot, 6, 20 * TIMES, mode="shorten", interpolation="natural_spline"):
        verdicts[decision.verdict] += 1
        passed = len(decision.actions)
        if passed:
            at = natural_spline(rows[: passed + 1], np.linspace(0, passed, 10 * passed + 1))
            assert bars.distances(at).min() > MARGIN - 1e-9
    assert verdicts["passed"] > 2 and verdicts["shortened"] > 2, verdicts


def test_what_is_left_of_a_spline_may_touch_where_the_whole_one_did_not(robot):
    """A jump of joint1 at the end makes the spline swing back before: without it, the way goes through a ball."""
    rows = np.zeros((5, 7))
    rows[:, 1], rows[4, 0] = 0.1 * np.arange(5), 1.5
    scene = chasles.Scene()
    for name, at, side in (("end", natural_spline(rows, np.array([3.6]))[0], 0.0), ("side", [0, 0.25, 0, 0, 0, 0, 0], 0.045)):
        place = frames(at)[0][0, 7] + [0, side, 0]
        scene.add(name, chasles.sphere(0.008), pose(*place))
    options = {"milliseconds": LONG, "interpolation": "natural_spline"}
    whole = PolicyGate(robot, scene, **options)(rows[0], rows[1:])
    assert whole.verdict == "refused" and whole.pair[1] == "end" and 3 < whole.time < 4
    left = PolicyGate(robot, scene, mode="shorten", **options)(rows[0], rows[1:])
    assert left.verdict == "shortened" and len(left.actions) == 2 and left.pair[1] == "side" and 2 < left.time < 3


def test_a_spline_may_touch_where_the_straight_way_does_not(robot):
    rows = np.zeros((6, 7))
    rows[1:, 1] = [0.3, 0.9, 0.9, 0.9, 0.9]  # the spline swings beyond 0.9
    swing = natural_spline(rows, np.array([2.5]))[0]
    place = frames(swing)[0][0, 7] + frames(swing)[1][0, 6, :, 0] * 0.04
    scene = chasles.Scene()
    scene.add("ball", chasles.sphere(0.001), pose(*place))
    assert PolicyGate(robot, scene, milliseconds=LONG)(rows[0], rows[1:]).verdict == "passed"
    bent = PolicyGate(robot, scene, milliseconds=LONG, interpolation="natural_spline")(rows[0], rows[1:])
    assert bent.verdict == "refused" and 2 < bent.time < 3 and bent.pair[1] == "ball"

    def slow_at_actions(robot, times, configurations):
        return chasles.JointPath.cubic(robot, times, configurations, np.zeros_like(configurations))

    own = PolicyGate(robot, scene, milliseconds=LONG, interpolation=slow_at_actions)
    assert own(rows[0], rows[1:]).verdict == "passed"
    scaled = PolicyGate(robot, scene, milliseconds=LONG, interpolation="natural_spline", mode="scale", full_speed_from=0.1)
    assert scaled(rows[0], rows[1:]).verdict == "refused"
    assert len(set(scaled(rows[0], rows[1:3]).speeds)) <= 1


# --- Budgets, starts and values ---


def test_what_is_not_decided_within_the_budget_does_not_pass():
    robot, random = arm(), np.random.default_rng(8)
    scene = world(random)
    present = clear_configuration(robot, chasles.RobotChecker(robot, scene, margin=MARGIN), random)
    actions = chunk(robot, random, present, count=5000, step=0.00002)
    whole = PolicyGate(robot, scene, margin=MARGIN, milliseconds=LONG)(present, actions)
    assert whole.verdict == "passed"
    for mode, options in (("refuse", {}), ("shorten", {}), ("scale", {"full_speed_from": MARGIN + 1e-3})):
        decision = PolicyGate(robot, scene, margin=MARGIN, mode=mode, milliseconds=1.0, **options)(present, actions)
        assert decision.verdict in ("refused", "shortened") and len(decision.actions) < 5000
        assert decision.reason == "not proven within 1 ms" and decision.pair is None and decision.time is None


def test_from_within_the_margin_a_robot_may_leave(robot):
    bars = Bars(np.random.default_rng(0), 0)
    place = frames(np.zeros(7))[0][0, 7]
    bars.a = bars.b = (place + [0.04 + 0.01 + 0.8 * MARGIN, 0, -0.04])[None]  # at 0.8 of the margin from link7
    bars.radii = np.array([0.01])
    away, nearer = np.zeros((2, 5, 7))
    away[:, 1], nearer[:, 1] = -0.01 * np.arange(1, 6), 0.002 * np.arange(1, 6)
    gate = PolicyGate(robot, bars.scene(), margin=MARGIN, milliseconds=LONG)
    assert 0.7 * MARGIN < bars.distances(np.zeros(7)).min() < 0.9 * MARGIN
    assert gate(np.zeros(7), away).verdict == "passed"
    assert gate(np.zeros(7), nearer).verdict == "refused"
    near_limit = PolicyGate(robot, bars.scene(), margin=MARGIN, hold=0.0, milliseconds=LONG, mode="shorten")(
        np.zeros(7), nearer
    )
    assert bars.distances(near_limit.actions).min() > 0
    fast = PolicyGate(robot, bars.scene(), margin=MARGIN, mode="scale", full_speed_from=0.1, milliseconds=LONG)
    assert fast(np.zeros(7), away).verdict == "refused" and "present" in fast(np.zeros(7), away).reason


def test_values_that_no_robot_can_take_stop_a_chunk(robot):
    actions = np.zeros((5, 7))
    shorten = PolicyGate(robot, mode="shorten", milliseconds=LONG)
    for value, reason in (
        (np.nan, "nan is no value"),
        (np.inf, "inf is no value"),
        (1e4, "10000.0 is no value"),
        (2.9001, "beyond its limits, [-2.9, 2.9]"),
    ):
        actions[3, 2] = value
        decision = shorten(np.zeros(7), actions)
        assert decision.verdict == "shortened" and len(decision.actions) == 3 and decision.clear_until == 3
        assert decision.reason.startswith("action 3: joint3: ") and reason in decision.reason
        assert PolicyGate(robot, milliseconds=LONG)(np.zeros(7), actions).verdict == "refused"
    scene = chasles.Scene()
    scene.add("ball", chasles.sphere(0.01), pose(0.11, 0, 1.41))  # at 0.06 from link7
    slow = PolicyGate(robot, scene, mode="scale", full_speed_from=0.1, milliseconds=LONG)(np.zeros(7), actions)
    assert slow.speeds.tolist() == [0.5] * 3 and slow.reason.startswith("action 3: joint3: ")
    actions[3, 2] = np.float32(2.9)
    assert actions[3, 2] > 2.9 and shorten(np.zeros(7), actions).verdict == "passed"
    assert shorten([0, 0, 2.95, 0, 0, 0, 0], np.zeros((1, 7))).verdict == "passed", "the robot is where it is"
    unknown = shorten([0, 0, np.nan, 0, 0, 0, 0], np.zeros((1, 7)))
    assert unknown.verdict == "refused" and unknown.reason.startswith("present: joint3: nan")


def test_half_a_turn_of_a_continuous_joint_may_go_either_way():
    links = [{"name": "base"}, {"name": "wheel", "collisions": [box(1, 0.1, 0.1)]}]
    turn = {"name": "turn", "type": "continuous", "parent": "base", "child": "wheel", "axis": [0, 0, 1]}
    gate = PolicyGate(chasles.Robot(links=links, joints=[turn]), mode="shorten", milliseconds=LONG)
    assert gate([3.0], [[3.2], [-3.0]]).reason == "action 1: turn: turns by half a turn or more, and it may go either way round"
    assert len(gate([3.0], [[3.2], [-3.0]]).actions) == 1 and gate([0.0], [[3.1]]).verdict == "passed"


# --- The interface ---


def test_a_record_is_json_and_has_no_truth_value(robot):
    scene = chasles.Scene()
    scene.add("wall", box(0.01, 2, 2), pose(0.3, 0, 1))
    rows = np.zeros((4, 7))
    rows[1:, 1] = [0.1, 0.2, 1.2]
    decision = PolicyGate(robot, scene, margin=MARGIN, mode="shorten", milliseconds=LONG)(rows[0], rows[1:])
    record = json.loads(json.dumps(decision.record()))
    assert record["verdict"] == "shortened" and record["actions"] == 2 and record["pair"][1] == "wall"
    assert 2 < record["time"] < 3 and record["speed"] == 1 and record["clear_until"] <= record["time"]
    assert record["place"][0] == pytest.approx(0.295) and 0 < record["milliseconds"]
    with pytest.raises(TypeError, match="compare its verdict"):
        bool(decision)


def test_another_world_and_a_carried_part_count_from_then_on():
    robot = capsules_only()
    gate = PolicyGate(robot, milliseconds=LONG)
    sweep = np.zeros((1, 7))
    sweep[0, 1] = 1.0
    assert gate(np.zeros(7), sweep).verdict == "passed"
    scene = chasles.Scene()
    scene.add("wall", box(0.01, 2, 2), pose(1.15, 0, 0.3))
    gate.set_scene(scene)
    assert gate(np.zeros(7), sweep).verdict == "passed"
    robot.attach("stick", "link7", chasles.capsule(0.01, 0.4), pose(0, 0, 0.2), ["link6"])
    gate.set_scene(scene)
    assert gate(np.zeros(7), sweep).pair == ("stick", "wall")


def test_threads_may_share_a_gate(robot):
    random = np.random.default_rng(9)
    scene = Bars(random).scene()
    gate = PolicyGate(robot, scene, margin=MARGIN, mode="shorten", milliseconds=LONG)
    starts = [clear_configuration(robot, chasles.RobotChecker(robot, scene, margin=MARGIN), random) for _ in range(16)]
    chunks = [chunk(robot, random, present) for present in starts]
    alone = [gate(*pair) for pair in zip(starts, chunks, strict=True)]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(gate, starts, chunks))
    assert [(d.verdict, d.time, d.pair) for d in alone] == [(d.verdict, d.time, d.pair) for d in together]


@pytest.mark.parametrize(
    "options, message",
    [
        ({"mode": "stop"}, "mode: 'stop' is none of refuse, shorten, scale"),
        ({"mode": "scale"}, 'full_speed_from: None with the mode "scale"; it belongs to "scale", which needs it'),
        ({"full_speed_from": 1.0}, 'full_speed_from: 1.0 with the mode "refuse"'),
        ({"mode": "scale", "full_speed_from": 0.1, "margin": 0.1}, "full_speed_from: 0.1 is not greater than the margin, 0.1"),
        ({"mode": "scale", "full_speed_from": 0.1, "hold": 0.0}, 'hold: has no effect with the mode "scale"'),
        ({"interpolation": "cubic"}, "interpolation: 'cubic' is neither"),
        ({"milliseconds": 0}, "milliseconds: 0 is not a positive number"),
        ({"milliseconds": np.nan}, "milliseconds: nan is not a positive number"),
        ({"margin": -1.0}, "query: margin: must be in"),
        ({"margin": 0.1, "hold": 0.2}, "query: hold: 0.2 is not less than the margin 0.1"),
    ],
)
def test_options_out_of_range_are_refused(robot, options, message):
    with pytest.raises(chasles.InvalidInput, match="^" + message.replace("(", "\\(")):
        PolicyGate(robot, **options)


def test_bodies_that_move_are_refused(robot):
    scene = chasles.Scene()
    scene.add("door", box(1, 1, 0.1), motion=chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 1]))
    with pytest.raises(chasles.InvalidInput, match="scene: door: moves, and a gate is about a world at rest"):
        PolicyGate(robot, scene)


def test_other_shapes_and_types_are_refused(robot):
    gate = PolicyGate(robot, milliseconds=LONG)
    for present, actions, message in (
        (np.zeros(6), np.zeros((5, 7)), r"present: the shape is \(6,\); \(7,\) is needed"),
        (np.zeros(7), np.zeros(7), r"actions: the shape is \(7,\); \(n, 7\) is needed"),
        (np.zeros(7), np.zeros((0, 7)), r"actions: the shape is \(0, 7\)"),
        (["a"] * 7, np.zeros((5, 7)), "present: not an array of numbers: an array of <U1"),
    ):
        with pytest.raises(chasles.InvalidInput, match="^" + message):
            gate(present, actions)
    with pytest.raises(TypeError, match="robot: a str is not a chasles.Robot"):
        PolicyGate("panda")
    for function, kind, message in (
        (lambda *_: 3, TypeError, "interpolation: returned an int"),
        (lambda r, t, q: chasles.JointPath.straight(r, q, 2 * t), chasles.InvalidInput, "has the times 0.0 to 10.0; 0 to 5.0"),
        (lambda r, t, q: chasles.JointPath.straight(r, q + 1, t), chasles.InvalidInput, "does not begin at the present"),
    ):
        with pytest.raises(kind, match=message):
            PolicyGate(robot, interpolation=function, milliseconds=LONG)(np.zeros(7), np.zeros((5, 7)))
