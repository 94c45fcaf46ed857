"""The audit of recorded states: what passes between two of them is found, and MuJoCo's own collision contradicts nothing."""

import base64
import json
import os
import pickle
import re

import numpy as np
import pytest

import chasles

mujoco = pytest.importorskip("mujoco")
pytest.importorskip("scipy")
import chasles.mujoco  # noqa: E402
from chasles.mujoco_pairs import geoms_of  # noqa: E402
from mujoco_models import (  # noqa: E402
    ALL_JOINTS,
    PLATE,
    ROD,
    between,
    distances_of,
    humanoid,
    model_of,
    random_state,
    simulated,
)


def seen(found):
    return [(row["what"], row["first"], row["second"], row["step"]) for row in found.table]


def contacts_of(model, states):
    """What MuJoCo reports in the recorded states."""
    data = mujoco.MjData(model)
    return [distances_of(model, data, state) for state in states]


def test_a_thin_plate_that_a_fast_ball_passes():
    model = model_of(PLATE)
    states, deepest = simulated(model, 20, [0, 0, -40.5, 0, 0, 0])
    assert deepest == 0 and not any(contacts_of(model, states)), "MuJoCo does not notice"
    found = chasles.mujoco.audit(model, states, 2e-4, times=0.01 * np.arange(21))
    assert seen(found) == [("passes", "ball/ball", "world/plate", 2)]
    (row,) = found.table
    touch = (1 - 0.0005 - 0.02 + 2e-4) / 40.5
    assert (
        row["certain"]
        and row["time"] - 1e-12 <= touch <= row["time_upper"] + 1e-12
        and row["time_upper"] - row["time"] < 1e-9
    )
    np.testing.assert_allclose([row["px"], row["py"], row["pz"]], [0, 0, 0.0004], atol=1e-9)
    assert not found.is_clear and found.steps == 20 and "passes   ball/ball | world/plate  step 2" in str(found)
    with pytest.raises(TypeError, match="no truth value"):
        bool(found)
    again = pickle.loads(pickle.dumps(found))
    assert str(again) == str(found) and (again.table == found.table).all()


def test_a_plate_that_is_thinner_than_the_allowed_overlap():
    model = model_of(PLATE)
    states, _ = simulated(model, 20, [0, 0, -40.5, 0, 0, 0])
    found = chasles.mujoco.audit(model, states, 0.01)
    assert seen(found) == [("passes", "ball/ball", "world/plate", 2)]
    assert "world/plate: is thin; beside geoms that are not, an overlap of 0.00545 is allowed" in str(found)


def test_a_rod_that_turns_through_a_wall():
    model = model_of(ROD)
    states = np.array([[0.0], [0.2], [1.3], [1.4]])
    assert not any(contacts_of(model, states))
    found = chasles.mujoco.audit(model, states)
    assert seen(found) == [("passes", "rod/rod", "world/wall", 1)]
    # The axis of the rod is 0.02 from the edge of the wall where x = 0.62 and y = 0.2.
    edge = np.hypot(0.62, 0.2)
    touch = np.arctan2(0.2, 0.62) - np.arcsin(0.02 / edge)
    assert abs(0.2 + (found.table["time"][0] - 1) * 1.1 - touch) < 1e-9
    assert chasles.mujoco.audit(model, [[0.0], [touch - 1e-6]]).is_clear


PITCH = 2.0


def thread(radius, begin, end):
    """The flanks of a thread about z, open at both ends."""
    turns = np.linspace(begin / PITCH, end / PITCH, round(24 * (end - begin) / PITCH) + 1)
    rows = []
    for inset, rise in ((1.0, 0.0), (0.0, PITCH / 2), (1.0, PITCH)):
        angles = 2 * np.pi * turns
        rows.append(
            np.column_stack(
                [(radius - inset) * np.cos(angles), (radius - inset) * np.sin(angles), PITCH * turns + rise]
            )
        )
    n = len(turns)
    quads = [
        (row * n + i, row * n + i + 1, row * n + n + i, row * n + n + i + 1) for row in range(2) for i in range(n - 1)
    ]
    return np.concatenate(rows), [face for a, b, c, d in quads for face in ([a, b, d], [a, d, c])]


def nut_on_bolt():
    spec = mujoco.MjSpec()
    for name, mesh in (("bolt", thread(7.8, 0, 12)), ("nut", thread(8, 4, 8))):
        asset = spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        asset.uservert, asset.userface = mesh[0].ravel(), np.ravel(mesh[1])
        body = spec.worldbody.add_body(name=name)
        if name == "nut":
            body.add_joint(name="slide", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
            body.add_joint(name="turn", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1])
        body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, mass=1)
    return spec.compile()


def test_a_nut_that_is_pushed_through_a_bolt():
    """By one pitch: before and after it fits. A nut that turns as it slides is clear."""
    model = nut_on_bolt()
    pushed = chasles.mujoco.audit(model, [[0, 0], [PITCH, 0], [PITCH, 0.01]], meshes="mesh")
    assert seen(pushed) == [("passes", "nut/nut", "bolt/bolt", 0)] and pushed.table["certain"][0]
    turns = np.linspace(0, 2, 25)
    screwed = chasles.mujoco.audit(model, np.column_stack([PITCH * turns, 2 * np.pi * turns]), meshes="mesh")
    assert screwed.is_clear and screwed.steps == 24
    hulls = chasles.mujoco.audit(model, [[0, 0], [PITCH, 0]])
    assert seen(hulls) == [("overlaps", "nut/nut", "bolt/bolt", 0)]


def test_a_thousand_clean_steps_of_a_humanoid():
    model = humanoid()
    states, deepest = simulated(model, 1000, np.r_[0.3, 0.2, 0, 0.1, 0.2, 0.3, np.zeros(model.nv - 6)])
    touching = sum(bool(found) for found in contacts_of(model, states))
    assert touching > 300 and 0.001 < deepest < 0.03
    found = chasles.mujoco.audit(model, states, 1.05 * deepest)
    assert found.is_clear and found.steps == 1000 and found.tested > 50, str(found)
    less = chasles.mujoco.audit(model, states, 0.5 * deepest)
    assert len(less.table) > 0, "the deepest contact is deeper than this"
    none = chasles.mujoco.audit(model, states)
    assert {"enters"} <= set(none.table["what"]) and (none.table["last_step"] - none.table["step"]).max() > 50


def depth_of(model, data, qpos, first, second):
    """The overlap of two geoms as MuJoCo has it; negative: their distance."""
    distances_of(model, data, qpos)
    return -mujoco.mj_geomDistance(model, data, first, second, 1.0, None)


EXACT = ALL_JOINTS.replace('type="ellipsoid" size=".2 .3 .4"', 'type="box" size=".2 .3 .4"').replace(
    'type="cylinder" size=".05 .1"', 'type="capsule" size=".05 .1"'
)


@pytest.mark.parametrize("xml", [EXACT, ALL_JOINTS, None], ids=["exact shapes", "curved shapes", "humanoid"])
def test_dense_samples_contradict_nothing(xml):
    """MuJoCo's collision at 100 times of each step, on MuJoCo's own way from state to state."""
    model, random, allowed = humanoid() if xml is None else model_of(xml), np.random.default_rng(8), 0.01
    names, data = geoms_of(model, ()).names, mujoco.MjData(model)
    ids, sampled, reported = {name: number for number, name in enumerate(names)}, 0, 0
    count = 120 if "CHASLES_LONG" in os.environ else 15
    for _ in range(count):
        states = np.array([random_state(random, model)] * 2)
        states[1] += random.normal(size=model.nq) * 0.5
        found = chasles.mujoco.audit(model, states, allowed)
        rows = {frozenset((ids[row["first"]], ids[row["second"]])): row for row in found.table}
        for part in np.linspace(0, 1, 101):
            for pair, distance in distances_of(model, data, between(model, *states, part)).items():
                if (
                    distance < -1.74 * allowed
                ):  # corners of boxes move by up to the square root of 3 times as far as faces
                    assert pair in rows and rows[pair]["time"] <= part + 1e-9, (pair, part, distance)
                    sampled += 1
        for pair, row in rows.items():
            if row["certain"]:
                depth = depth_of(model, data, between(model, *states, row["time_upper"]), *sorted(pair))
                assert depth > allowed - 1e-4, (row, depth)
                reported += 1
                is_at_start = row["time"] == 0
                assert (row["what"] == "overlaps") == is_at_start and (is_at_start or depth < 2 * allowed + 0.01)
    assert sampled > 10 * count and reported > count / 4


def test_rows_say_when_a_contact_shows():
    """A ball that goes into a wall, stays, leaves, and comes back."""
    model = model_of("""<mujoco><worldbody><geom name="wall" type="box" size=".1 1 1"/>
<body name="ball"><joint type="slide" axis="1 0 0"/><geom name="ball" size=".1"/></body></worldbody></mujoco>""")
    states = np.array([0, 1, 0.5, 0.15, 0.1, 0.3, 0.5, 0.1, 0.5, 0.3, -0.3])[:, None]
    found = chasles.mujoco.audit(model, states, times=10 * np.arange(11))
    rows = [(row["what"], row["step"], row["last_step"]) for row in found.table]
    assert rows == [("overlaps", 0, 0), ("enters", 2, 4), ("enters", 6, 7), ("passes", 9, 9)]
    np.testing.assert_allclose(
        found.table["time"], [0, 20 + 10 * 0.3 / 0.35, 60 + 10 * 0.3 / 0.4, 90 + 10 * 0.1 / 0.6], atol=1e-9
    )
    assert "step 2 to 4" in str(found)


def test_curved_geoms_have_a_bracket():
    """A cylinder on its side above a floor: MuJoCo's own distance is that of the cylinder, not that of a polyhedron around it."""
    model = model_of("""<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1"/><body name="can" euler="90 0 0">
<joint type="slide" axis="0 1 0"/><joint axis="0 0 1"/><geom type="cylinder" size=".5 .1"/></body></worldbody></mujoco>""")
    touch, doubts = 0.5, 0
    for turn in np.linspace(0, 0.3, 9):
        (row,) = chasles.mujoco.audit(model, [[1, turn], [0.4, turn]]).table
        assert (
            row["certain"]
            and row["time"] <= (1 - touch) / 0.6 <= row["time_upper"]
            and row["time_upper"] - row["time"] < 0.01
        )
        near = chasles.mujoco.audit(model, [[1, turn], [0.5005, turn]])
        doubts += len(near.table) and not near.table["certain"][0]
    assert doubts > 0
    assert chasles.mujoco.audit(model, [[1, 0], [0.504, 0]]).is_clear


def test_flush_faces_are_certain():
    """Both fingers of a gripper close beyond each other, with all sides in common planes: touch alone could not be told."""
    finger = """<body name="{0}" pos="{1} 0 0"><joint name="{0}" type="slide" axis="{2} 0 0"/>
<geom name="{0}" type="box" size=".01 .02 .03"/></body>"""
    arm = f"""<mujoco><worldbody><body name="arm" euler="10 20 30"><joint axis="1 2 3"/><geom size=".02" pos="0 0 -.3"/>
{finger.format("left", -0.1, 1)}{finger.format("right", 0.1, -1)}</body></worldbody></mujoco>"""
    found = chasles.mujoco.audit(model_of(arm), [[0, 0, 0], [0.5, 0.2, 0.2]])
    assert seen(found) == [("passes", "right/right", "left/left", 0)]
    (row,) = found.table
    assert row["certain"] and row["time"] <= 0.45 <= row["time_upper"] < 0.46


def test_planes_reach_as_far_as_any_body():
    model = model_of("""<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1" pos="0 50 0"/>
<body name="ball"><freejoint/><geom name="ball" size=".1"/><body name="tail" pos="0 0 5"><joint type="slide" axis="0 1 0"/>
<geom name="tail" size=".1"/></body></body></worldbody></mujoco>""")
    states = np.zeros((3, model.nq))
    states[:, :4] = [[900, -800, 10, 1], [900, -800, 5, 1], [900, -800, -4.5, 1]]
    states[:, 7] = -9
    found = chasles.mujoco.audit(model, states)
    assert (
        seen(found) == [("enters", "ball/ball", "world/floor", 1)]
        and abs(found.table["time"][0] - 1 - 4.9 / 9.5) < 1e-9
    )
    states[2, 2] = -5
    assert seen(chasles.mujoco.audit(model, states)) == [
        ("enters", "ball/ball", "world/floor", 1),
        ("enters", "tail/tail", "world/floor", 1),
    ]


def test_mocap_bodies_move_as_they_are_told():
    model = model_of("""<mujoco><worldbody><body name="hand" mocap="true" pos="0 0 5"><geom name="hand" size=".1"/></body>
<body name="box"><freejoint/><geom name="box" type="box" size=".1 .1 .1"/></body></worldbody></mujoco>""")
    rest = np.tile(model.qpos0, (2, 1))
    assert chasles.mujoco.audit(model, rest).is_clear
    poses = np.array([[[-1, 0, 0, 1, 0, 0, 0]], [[1, 0, 0, 1, 0, 0, 0]]])
    assert seen(chasles.mujoco.audit(model, rest, mocap=poses)) == [("passes", "box/box", "hand/hand", 0)]
    with pytest.raises(chasles.InvalidInput, match="^mocap: has 3 states, and qpos has the shape"):
        chasles.mujoco.audit(model, rest, mocap=np.repeat(poses[:1], 3, axis=0))


REFUSED = [
    (([0.0],), {}, r"qpos: the shape is \(1,\); \(states, 1\) with two states or more is needed"),
    (([[0.0]],), {}, r"qpos: the shape is \(1, 1\)"),
    (([[], []],), {}, r"qpos: the shape is \(2, 0\); \(states, 1\) with two states or more is needed"),
    (([[0.0], [np.nan]],), {}, "path: configuration 1: "),
    (([[0.0], [2000.0]],), {}, "path: configuration 1: "),
    (([[0.0]] * 1500 + [[2000.0]],), {}, "path: configuration 1500: "),
    (([[0.0], [1.0]],), {"times": [0, 0]}, "times: 2 finite times that ascend are needed"),
    (([[0.0], [1.0]], np.nan), {}, "allowed_overlap: must be at least 0"),
]


@pytest.mark.parametrize("given, options, why", REFUSED, ids=[why for *_, why in REFUSED])
def test_what_is_refused(given, options, why):
    with pytest.raises(chasles.InvalidInput, match=f"^{why}") as error:
        chasles.mujoco.audit(model_of(ROD), *given, **options)
    assert "\n" not in str(error.value)


def test_nothing_to_test_is_clear():
    model = model_of('<mujoco><worldbody><body><freejoint/><geom size="1"/></body></worldbody></mujoco>')
    found = chasles.mujoco.audit(model, np.tile(model.qpos0, (3, 1)))
    assert found.is_clear and found.tested == 0 and str(found).startswith("2 of 2 steps, no pairs of geoms")


def test_a_limit_of_time_ends_an_audit():
    model = humanoid()
    random = np.random.default_rng(1)
    states = np.array([random_state(random, model) for _ in range(200)])
    with chasles.Limit(0.2):
        found = chasles.mujoco.audit(model, states)
    assert found.steps < found.recorded_steps == 199 and not found.is_clear
    assert (found.table["step"] < found.steps).all() and f"{found.steps} of 199 steps" in str(found)


def test_the_page_shows_who_passed(tmp_path):
    model = model_of(ROD)
    found = chasles.mujoco.audit(model, [[0.0], [0.2], [1.3], [1.4]], times=[0, 1, 2, 3])
    try:
        page = found.view(tmp_path / "page.html", title="A rod")
    except chasles.InvalidInput as error:
        if "has no viewer" not in str(error) or os.environ.get("CHASLES_HAS_VIEWER"):
            raise
        pytest.skip(str(error))
    data = json.loads(re.search(r'<script id="scene" type="application/json">(.*?)</script>', page.read_text())[1])
    assert data["title"] == "A rod" and [body["name"] for body in data["bodies"]] == ["world/wall", "rod/rod"]
    (event,) = data["events"]
    assert event["kind"] == "passes" and event["time"] == found.table["time"][0] and sorted(event["pair"]) == [0, 1]
    assert event["contacts"][0]["point"] == [found.table[name][0] for name in ("px", "py", "pz")]
    times = np.frombuffer(base64.b64decode(data["times"]))
    assert event["time"] in times and [((times >= at) & (times < at + 1)).sum() for at in range(3)] == [1, 17, 1]
    clear = chasles.mujoco.audit(humanoid(), np.tile(humanoid().qpos0, (2, 1)))
    assert clear.is_clear and clear.view(tmp_path / "clear.html").is_file()
