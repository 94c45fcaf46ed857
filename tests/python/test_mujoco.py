"""Models of MuJoCo as robots: its own kinematics and its own collision at many poses, and what is refused."""

import doctest
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT
from test_docs import code_of

import chasles

mujoco = pytest.importorskip("mujoco")
pytest.importorskip("scipy")
import chasles.mujoco  # noqa: E402
from chasles.mujoco_pairs import geoms_of  # noqa: E402
from chasles.mujoco_shapes import shape_of  # noqa: E402
from chasles.mujoco_tree import body_names  # noqa: E402
from mujoco_models import ALL_JOINTS, distances_of, humanoid, model_of, random_state  # noqa: E402

MENAGERIE = """agility_cassie aloha anybotics_anymal_c arx_l5 booster_t1 franka_emika_panda google_barkour_v0 google_robot i2rt_yam
kinova_gen3 kuka_iiwa_14 low_cost_robot_arm pal_talos pal_tiago robotiq_2f85 robotstudio_so101 shadow_hand stanford_tidybot
toddlerbot_2xc trossen_vx300s ufactory_xarm7 unitree_g1 unitree_h1 wonik_allegro""".split()
OPTIONS = {"meshes": "hull", "deviation": 0.01, "plane": 10.0, "inner": False}


def check_poses(model, count, seed=1):
    """Links, geoms and joints at random states. Returns how many contacts MuJoCo found there."""
    robot, names, bodies = chasles.mujoco.robot(model), geoms_of(model, ()).names, body_names(model)
    assert len(robot.tested_pairs()) == geoms_of(model, ()).tested
    checker, ids, data, random = (
        chasles.RobotChecker(robot),
        geoms_of(model, ()).ids,
        mujoco.MjData(model),
        np.random.default_rng(seed),
    )
    states, mocap = (
        np.array([random_state(random, model) for _ in range(count)]),
        random.normal(size=(count, model.nmocap, 7)),
    )
    values, contacts = chasles.mujoco.configurations(model, states, mocap), 0
    for state, poses, value in zip(states, mocap, values):
        theirs = distances_of(model, data, state, poses)
        links = robot.link_poses(value)
        for name, place, turn in [
            *((bodies[b], data.xpos[b], data.xmat[b]) for b in range(model.nbody)),
            *((names[g], data.geom_xpos[g], data.geom_xmat[g]) for g in ids),
        ]:
            size = max(1.0, np.abs(place).max())
            assert np.abs(links[name][:3, 3] - place).max() <= 1e-12 * size, name
            assert np.abs(links[name][:3, :3] - turn.reshape(3, 3)).max() <= 1e-12, name
        ours = {frozenset(pair) for pair in checker.pairs_in_contact(value)}
        for pair, distance in theirs.items():
            assert distance > -1e-6 or {names[g] for g in pair} in ours, (pair, distance)
            contacts += distance < -1e-6
    return contacts


def test_all_joints_stand_where_mujoco_says():
    model = model_of(ALL_JOINTS)
    assert check_poses(model, 1000) > 100
    robot = chasles.mujoco.robot(model)
    assert (
        robot.variables[:3] == ["a", "b", "c"]
        and not any(robot.continuous)
        and robot.links[:3] == ["world", "base", "arm"]
    )
    np.testing.assert_allclose(robot.limits[robot.variables.index("a")], np.radians([-90, 60]))
    np.testing.assert_array_equal(robot.limits[robot.variables.index("b")], [-np.inf, np.inf])
    one = random_state(np.random.default_rng(3), model)
    np.testing.assert_array_equal(
        chasles.mujoco.configurations(model, one), chasles.mujoco.configurations(model, [one])[0]
    )


def test_the_humanoid_stands_where_mujoco_says():
    assert check_poses(humanoid(), 200) > 100


@pytest.mark.parametrize("name", MENAGERIE)
def test_models_of_the_menagerie(name):
    """The wheel has no models: it downloads them, or takes those of the folder MENAGERIE_ROOT."""
    menagerie = pytest.importorskip("mujoco_menagerie")
    described, cache = menagerie.get(name), menagerie.Cache()
    if not (cache.is_cached(described) or (cache.root and (cache.root / name).is_dir())):
        pytest.skip(f"{name} is not here; `mujoco-menagerie prefetch {name}` downloads it")
    model = menagerie.load(name, described.default_model)
    check_poses(model, 60)


def test_pairs_are_those_of_mujoco():
    """Bodies on one spot, so that MuJoCo has a contact for each pair that it tests."""
    random, tested = np.random.default_rng(5), 0
    for number in range(60):
        model = model_of(random_pairs(random))
        if number % 4 == 0:
            model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_FILTERPARENT
        names, robot = geoms_of(model, ()).names, chasles.mujoco.robot(model)
        weld = model.body_weldid[
            model.geom_bodyid
        ]  # MuJoCo takes a pair of one body, too, if it is named; nothing moves there
        found = distances_of(model, mujoco.MjData(model), model.qpos0)
        theirs = {frozenset(names[g] for g in pair) for pair in found if len({weld[g] for g in pair}) == 2}
        ours = {frozenset(pair) for pair in robot.tested_pairs()}
        assert ours == theirs
        assert geoms_of(model, ()).tested == len(ours)
        assert len(ours) + sum(chasles.mujoco.untested(model).values()) == model.ngeom * (model.ngeom - 1) // 2
        tested += len(ours)
    assert tested > 500


def random_pairs(random):
    """Ten bodies in a random tree, some welded to their parents, with random bits, excluded bodies and pairs of geoms."""
    inside: dict[int, str] = {}
    parents = [int(random.integers(-1, body)) if body else -1 for body in range(10)]
    for body in range(9, -1, -1):
        joint = "" if random.random() < 0.3 else "<joint type='slide' axis='1 0 0'/>"
        bits = f"contype='{random.choice([0, 1, 1, 2, 3])}' conaffinity='{random.choice([0, 1, 1, 2])}'"
        children = "".join(inside[child] for child in range(10) if parents[child] == body)
        inside[body] = f"<body name='b{body}'>{joint}<geom name='g{body}' size='1' mass='1' {bits}/>{children}</body>"
    world = "".join(inside[body] for body in range(10) if parents[body] < 0)
    rules = []
    for tag in ("exclude body1='b{}' body2='b{}'", "exclude body1='b{}' body2='b{}'", "pair geom1='g{}' geom2='g{}'"):
        a, b = random.choice(10, 2, replace=False)
        rules.append(f"<{tag.format(a, b)}/>")
    text = f"<geom name='w' type='plane' size='1 1 1'/>{world}"
    return f"<mujoco><worldbody>{text}</worldbody><contact>{''.join(sorted(set(rules)))}</contact></mujoco>"


SHAPES = """<mujoco><asset><hfield name="hills" nrow="5" ncol="7" size="1.5 1 .4 .2"/>
<mesh name="tooth" vertex="0 0 0 1 0 0 0 1 0 0 0 1 .1 .1 .1"/></asset><worldbody>
<geom name="hills" type="hfield" hfield="hills"/><body pos="0 0 2"><freejoint/><geom name="ball" type="sphere" size=".07"/></body>
<body><freejoint/><geom name="can" type="cylinder" size=".5 .8"/></body><body><freejoint/><geom name="egg" type="ellipsoid" size=".2 .5 1"/></body>
<body><freejoint/><geom name="tooth" type="mesh" mesh="tooth"/></body></worldbody></mujoco>"""


def heights(body, points):
    """How far points are above the highest face of a convex body; below 0 inside of it."""
    corners = body.vertices[[list(face[:3]) for face in body.faces]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return ((points[:, None] - corners[None, :, 0]) * normals).sum(axis=2).max(axis=1)


@pytest.mark.parametrize("inset", [0.0, 0.01])
@pytest.mark.parametrize("deviation", [0.02, 0.005])
def test_polyhedra_of_curved_geoms_enclose_them(inset, deviation):
    model, random = model_of(SHAPES), np.random.default_rng(2)
    turns = random.normal(size=(300, 3))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    round_points = np.column_stack(
        [0.5 * turns[:, :2] / np.linalg.norm(turns[:, :2], axis=1, keepdims=True), 0.8 * np.sign(turns[:, 2])]
    )
    for name, points, radius in (("can", round_points, 0.5), ("egg", turns * [0.2, 0.5, 1], 1)):
        options = {**OPTIONS, "deviation": deviation}
        outer = shape_of(model, model.geom(name).id, inset, **options)
        inner = shape_of(model, model.geom(name).id, inset, **{**options, "inner": True})
        assert -deviation * radius - 1e-9 <= heights(outer, points).min() - inset
        assert heights(outer, points).max() <= inset + 1e-12  # planes of convex bodies move by the inset
        assert heights(inner, points).min() >= inset - 1e-12
        assert heights(outer, inner.vertices[::10]).max() <= 1e-12
        assert outer.report.solid_parts == 1


def test_a_height_field_is_cut_as_mujoco_cuts_it():
    """A ball at many places: MuJoCo's distance of the two geoms is that of the bodies."""
    model, random = model_of(SHAPES), np.random.default_rng(4)
    model.hfield_data[:] = random.uniform(size=35).round(2)
    field, ball = (shape_of(model, model.geom(name).id, 0.0, **OPTIONS) for name in ("hills", "ball"))
    data, near = mujoco.MjData(model), 0
    for _ in range(300):
        place = random.uniform([-1.2, -0.8, 0.1], [1.2, 0.8, 0.6])
        data.qpos[:3] = place
        theirs = distances_of(model, data, data.qpos.copy()).get(
            frozenset((model.geom("hills").id, model.geom("ball").id))
        )
        ours = chasles.first_contact(ball, field, [*place, 1, 0, 0, 0], [*place, 1, 0, 0, 0])
        assert theirs is None or theirs > 1e-6 or ours.verdict == "contact_at_start"
        assert ours.verdict == "clear" or (theirs is not None and theirs < 1e-6)
        near += ours.verdict == "contact_at_start"
    assert 50 < near < 250


def test_a_mesh_is_its_hull_or_its_faces():
    model = model_of(SHAPES)
    tooth = model.geom("tooth").id
    hull, mesh = (shape_of(model, tooth, 0.0, **{**OPTIONS, "meshes": kind}) for kind in ("hull", "mesh"))
    assert len(hull.vertices) == 4 and len(mesh.vertices) == 5
    assert abs(hull.report.volume - 1 / 6) < 1e-6
    less = shape_of(model, tooth, 0.02, **OPTIONS)
    assert np.allclose(heights(hull, less.vertices), -0.02, atol=1e-9)


REFUSED = [
    ({"allowed_overlap": -1}, "allowed_overlap: must be at least 0"),
    ({"meshes": "convex"}, "meshes: must be 'hull' or 'mesh', not 'convex'"),
    ({"deviation": 0}, "deviation: must be in"),
    ({"plane_size": 0}, "plane_size: must be above 0"),
    ({"leave_out": "egg"}, "leave_out: 'egg' is one text"),
    ({"leave_out": ["eg"]}, "leave_out: 'eg': there is no such geom or flex"),
]


@pytest.mark.parametrize("options, why", REFUSED, ids=[why for _, why in REFUSED])
def test_what_is_refused(options, why):
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.mujoco.robot(model_of(ALL_JOINTS), **options)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


def test_thin_geoms_keep_a_tenth():
    model = model_of(ALL_JOINTS)
    robot = chasles.mujoco.robot(model, allowed_overlap=0.15)
    assert [line.split(":")[0] for line in robot.warnings] == ["arm/geom 2", "body 4/nail", "on hook/sign"]
    assert robot.warnings[0] == "arm/geom 2: is thin; beside geoms that are not, an overlap of 0.138 is allowed"
    ((capsule, _, _),), ((sign, _, _),) = robot.collisions("arm/geom 2"), robot.collisions("on hook/sign")
    assert abs(capsule.radius - 0.007) < 1e-15
    np.testing.assert_allclose(np.ptp(sign.vertices, axis=0), [0.51, 0.01, 0.31])


CLOTH = """<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1"/><body name="a"><freejoint/><geom name="a" size=".1"/></body>
<flexcomp name="cloth" type="grid" count="3 3 1" spacing=".1 .1 .1" radius=".01" pos="0 0 1" mass="1" dim="2"><edge equality="true"/></flexcomp></worldbody></mujoco>"""


def test_what_deforms_is_refused_by_name():
    model = model_of(CLOTH)
    with pytest.raises(chasles.InvalidInput, match="^flex 'cloth': deforms, .*leave_out$"):
        chasles.mujoco.robot(model)
    assert chasles.mujoco.robot(model, leave_out=["cloth"]).tested_pairs() == [("world/floor", "a/a")]
    with pytest.raises(TypeError, match="^model: a str is not a mujoco.MjModel$"):
        chasles.mujoco.robot("model.xml")
    with pytest.raises(
        chasles.InvalidInput, match=r"^qpos: the shape is \(3,\); \(\d+,\) or \(states, \d+\) is needed$"
    ):
        chasles.mujoco.configurations(model, [1, 2, 3])
    data = mujoco.MjData(model)
    for function in (chasles.mujoco.configurations, chasles.mujoco.audit):
        with pytest.raises(chasles.InvalidInput, match="^qpos: is an MjData; give arrays of its numbers, such as a copy of its"):
            function(model, data)
        with pytest.raises(chasles.InvalidInput, match="^qpos: not an array of numbers: "):
            function(model, [["x"]])


RING = """<mujoco><extension><plugin plugin="mujoco.sdf.torus"><instance name="ring"/></plugin></extension>
<asset><mesh name="ring"><plugin instance="ring"/></mesh></asset><worldbody><geom name="floor" type="plane" size="1 1 1"/>
<body pos="0 0 1"><freejoint/><geom type="sdf" name="ring" mesh="ring"><plugin instance="ring"/></geom></body></worldbody></mujoco>"""


def test_signed_distance_fields_are_refused_by_name():
    with pytest.raises(
        chasles.InvalidInput, match="^geom 'body 1/ring': signed distance fields have no polyhedron; .*leave_out$"
    ):
        chasles.mujoco.robot(model_of(RING))
    assert chasles.mujoco.robot(model_of(RING), leave_out=["ring"]).tested_pairs() == []


def test_geoms_may_be_left_out():
    model = model_of(ALL_JOINTS)
    robot = chasles.mujoco.robot(model, leave_out=["egg", "world/floor"])
    assert "free/egg" not in robot.links and "world/floor" not in robot.links and "free/tail" not in robot.links
    assert chasles.mujoco.untested(model, ["egg", "world/floor"])["left out"] > 10


def test_chasles_alone_does_not_import_mujoco():
    code = "import sys, chasles; assert 'mujoco' not in sys.modules and 'scipy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_page_of_the_guide_tells_the_truth(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(code_of(ROOT / "docs/mujoco.md"), {}, "mujoco.md", "mujoco.md", 0)
    assert len(example.examples) > 15
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)
