"""Animations of glTF: poses beside scipy's, contacts at times of closed formulas, jumps, and what is not tested."""

import chasles
import chasles.gltf
import copy
import pickle

import numpy as np
import pytest
from conftest import ROOT

pytest.importorskip("scipy")
from chasles.gltf_cubic import CubicCurve, cubic_motion  # noqa: E402
from gltf_files import CUBE, Maker, Sampler, random_quaternions, random_scene  # noqa: E402
from test_docs import code_of  # noqa: E402

UP = [0, np.sin(np.pi / 4), 0, np.cos(np.pi / 4)]  # a quarter turn about y


@pytest.fixture
def file(tmp_path):
    return tmp_path / "scene.glb"


def corners_of(animation, poses, name):
    return animation.bodies[name].vertices @ poses[name][:3, :3].T + poses[name][:3, 3]


def check_poses(maker, file, times, tolerance):
    """Each vertex of each body is where the nodes of the file have it. Returns the number of poses."""
    animation, sampler = chasles.gltf.read(maker.write(file)), Sampler(maker)
    numbers = {node["name"]: index for index, node in enumerate(maker.json["nodes"])}
    count = 0
    for time in times * animation.duration:
        world, poses = sampler.world(time), animation.poses(time)
        for name in animation.bodies:
            matrix = world[numbers[name]]
            expected = CUBE[0].astype(np.float32) @ matrix[:3, :3].T + matrix[:3, 3]
            assert np.abs(corners_of(animation, poses, name) - expected).max() <= tolerance, (name, time)
            count += 1
    return count


def test_bodies_are_where_the_nodes_are(file):
    random = np.random.default_rng(4)
    assert sum(check_poses(random_scene(random), file, random.uniform(size=30), 1e-12) for _ in range(10)) > 1500


def test_a_cube_falls_on_a_floor(file):
    maker = Maker()
    mesh = maker.mesh()
    maker.node("floor", mesh=mesh, scale=[8, 1, 8], translation=[0, -0.5, 0])
    box = maker.node("box", mesh=mesh)
    maker.animate(box, "translation", [0, 2], [[0, 3, 0], [0, -1, 0]])
    animation = chasles.gltf.read(maker.write(file))
    found = animation.first_contact(find="first_with_all_contacts")
    assert (found.verdict, found.pair, found.certain) == ("contact", ("box", "floor"), True)
    assert found.time <= 1.25 <= found.time_upper and found.time_upper - found.time < 1e-11
    assert found.clear_until <= found.time and len(found.contacts) == 4
    assert found.contacts[0].normal.tolist() == [0, 1, 0] and found.contacts[0].approach_speed == pytest.approx(2)
    assert animation.first_contact(margin=1).time == pytest.approx(0.75, abs=1e-9)
    assert animation.duration == 2 and animation.animations == ["take 0"] and animation.kinds == "linear"
    with pytest.raises(TypeError, match="verdict"):
        bool(found)


def test_what_no_frame_shows(file):
    """A thin bar turns through a thin post between two keys, which are 1/24 s apart."""
    maker = Maker()
    maker.node("post", mesh=maker.mesh(), scale=[0.02, 2, 0.02], translation=[1, 0, 0])
    bar = maker.node("bar", mesh=maker.mesh(CUBE[0] + [0.5, 0, 0]), scale=[1.2, 0.1, 0.02])
    turns = [[0, np.sin(a / 2), 0, np.cos(a / 2)] for a in (-0.4, 0.4)]
    maker.animate(bar, "rotation", [0, 1 / 24], turns)
    animation = chasles.gltf.read(maker.write(file))
    for time in (0, animation.duration):
        poses = animation.poses(time)
        assert np.abs(corners_of(animation, poses, "bar")[:, 2]).max() > 0.3
    found = animation.first_contact()
    # The corner (0.99, 0.01) of the post meets the face of the bar that is 0.01 from the axis. Which side comes first, z tells.
    radius, offset = np.hypot(0.99, 0.01), 0.01
    angle = np.arctan2(0.01, 0.99) + np.arcsin(offset / radius)
    expected = (0.4 - angle) / 0.8 / 24
    assert found.pair == ("bar", "post") and found.time == pytest.approx(expected, abs=1e-6)


def test_keys_at_different_times_need_no_poses_between(file):
    """A cube that turns by a quarter in 1.5 s slides for 2 s: its diagonal is the first to reach the wall."""
    maker = Maker()
    mesh = maker.mesh()
    maker.node("wall", mesh=mesh, scale=[1, 9, 9], translation=[3, 0, 0])
    box = maker.node("box", mesh=mesh)
    maker.animate(box, "translation", [0, 2], [[0, 0, 0], [4, 0, 0]])
    maker.animate(box, "rotation", [0.25, 1.75], [[0, 0, 0, 1], UP])
    found = chasles.gltf.read(maker.write(file)).first_contact()
    times = np.linspace(0, 2, 200001)
    angles = np.clip((times - 0.25) / 1.5, 0, 1) * np.pi / 2
    reach = 2 * times + 0.5 * (np.abs(np.cos(angles)) + np.abs(np.sin(angles)))
    assert found.time == pytest.approx(times[np.argmax(reach >= 2.5)], abs=1e-5)


def test_scales_and_mirrors_above_make_ways_longer(file):
    maker = Maker()
    mesh = maker.mesh()
    maker.node("floor", mesh=mesh, scale=[90, 2, 90], translation=[0, -1, 0])
    group = maker.node("group", scale=[-2, -2, -2], translation=[0, 10, 0])
    box = maker.node("box", group, mesh=mesh)
    maker.animate(box, "translation", [0, 1], [[0, 0, 0], [0, 5, 0]])
    found = chasles.gltf.read(maker.write(file)).first_contact()  # from 10 down to 0, and the cube has sides of 2
    assert found.time == pytest.approx(0.9, abs=1e-9) and found.certain


def test_what_stands_between_two_nodes_that_move_is_scaled_too(file):
    """In a hall of twice the size, a crane turns by a quarter turn, and a cube falls from its arm, which is 2 * 4 long then."""
    maker = Maker()
    mesh = maker.mesh()
    crane = maker.node("crane", maker.node("hall", scale=[2, 2, 2]))
    arm = maker.node("arm", crane, translation=[4, 3, 0], rotation=UP)
    maker.node("plate", mesh=mesh, scale=[3, 2, 3], translation=[0, -2, -8])
    maker.animate(crane, "rotation", [0, 1, 3], [[0, 0, 0, 1], UP, UP])
    maker.animate(maker.node("box", arm, mesh=mesh), "translation", [0, 1, 3], [[0, 0, 0], [0, 0, 0], [0, -4, 0]])
    found = chasles.gltf.read(maker.write(file)).first_contact()  # from 6 - 1 down to -1, at a speed of 4
    assert found.pair == ("box", "plate") and found.time == pytest.approx(2.5, abs=1e-9)


def test_a_quaternion_and_its_negative_do_not_move(file):
    maker = jumper(0, 0, 0)
    maker.animate(1, "rotation", [0, 2], [UP, [-x for x in UP]])
    assert "0 of them move" in repr(chasles.gltf.read(maker.write(file)))


@pytest.mark.parametrize("kind", ["LINEAR", "CUBICSPLINE"])
def test_an_uneven_scale_above_what_does_not_turn(file, kind):
    """A shaft is turned and squeezed, and a lift in it goes up by 2 * 0.5 a second, with a body that is sheared."""
    maker = Maker()
    mesh = maker.mesh()
    maker.node("ceiling", mesh=mesh, scale=[30, 1, 30], translation=[0, 3.5, 0])
    shaft = maker.node(
        "shaft", maker.node("house", scale=[1, 0.5, 3]), rotation=[0, 0, np.sin(np.pi / 8), np.cos(np.pi / 8)]
    )
    lift = maker.node("lift", shaft, mesh=mesh, rotation=UP)
    keys = (
        [[0, 0, 0], [0, 8, 0]]
        if kind == "LINEAR"
        else [[0, 0, 0], [0, 0, 0], [0, 2, 0], [0, 2, 0], [0, 8, 0], [0, 0, 0]]
    )
    maker.animate(lift, "translation", [0, 4], keys, kind)
    # The highest corner of a turned square of side 1 is at sqrt(1/2), times 0.5; the lift climbs by 2 * 0.5 * cos(45 degrees).
    root = np.sqrt(0.5)
    found = chasles.gltf.read(maker.write(file)).first_contact()
    assert found.pair == ("lift", "ceiling") and found.time == pytest.approx((3 - root / 2) / root, abs=1e-6)


def test_a_cubic_spline_of_places(file):
    """Hermite: x(t) = 5 (3 t^2 - 2 t^3) overshoots nothing, and the face reaches the wall where 5 (3 t^2 - 2 t^3) = 2."""
    maker = Maker()
    mesh = maker.mesh()
    maker.node("wall", mesh=mesh, scale=[1, 9, 9], translation=[3, 0, 0])
    box = maker.node("box", mesh=maker.mesh(CUBE[0] + [0, 0.1, 0.2]))
    still = [0, 0, 0]
    maker.animate(box, "translation", [0, 1], [still, [0, 0, 0], still, still, [5, 0, 0], still], "CUBICSPLINE")
    found = chasles.gltf.read(maker.write(file)).first_contact()
    (root,) = (x.real for x in np.roots([-10, 15, 0, -2]) if abs(x.imag) < 1e-9 and 0 < x.real < 1)
    assert found.time <= root <= found.time_upper and found.certain and found.time_upper - found.time < 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_bounds_of_cubic_splines_hold(seed):
    random = np.random.default_rng(seed)
    stamps = np.sort(random.uniform(0, 2, 4))
    tangents = random.normal(scale=1.5, size=(4, 2, 4))
    places = CubicCurve.hermite(stamps, random.normal(size=(4, 3)), 4 * random.normal(size=(4, 2, 3)), 2.0)
    quaternions = CubicCurve.hermite(stamps, np.abs(random_quaternions(random, 4)) + 0.3, tangents, 2.0)
    motion = cubic_motion(places, quaternions)
    assert motion.find_broken_bound(600, seed) is None
    halves = chasles.Trajectory(
        motion.pose_at,
        lambda a, b: {"speed": 0.5 * places.within(a, b).bound(1), "turn_rate": 1e9},
        knots=places.knots[1:-1].tolist(),
    )
    assert halves.find_broken_bound(600, seed) is not None  # the bounds are not loose


def test_a_quaternion_that_passes_zero_is_refused(file):
    maker = Maker()
    box = maker.node("box", mesh=maker.mesh())
    zero = [0, 0, 0, 0]
    maker.animate(box, "rotation", [0, 1], [zero, [0, 0, 0, 1], zero, zero, [0, 0, 0, -1], zero], "CUBICSPLINE")
    with pytest.raises(chasles.InvalidInput, match=r"node 0 \('box'\): the cubic spline of a rotation may pass 0"):
        chasles.gltf.read(maker.write(file))


def jumper(*places, stamps=(0, 1, 2)):
    maker = Maker()
    mesh = maker.mesh()
    maker.node("wall", mesh=mesh, scale=[1, 9, 9], translation=[3, 0, 0])
    box = maker.node("box", mesh=mesh)
    maker.animate(box, "translation", stamps, [[x, 0, 0] for x in places], "STEP")
    return maker


def test_a_jump_over_a_wall_touches_nothing(file):
    animation = chasles.gltf.read(jumper(0, 6, 6).write(file))
    assert animation.jumps.tolist() == [1] and animation.kinds == "step"
    found = animation.first_contact()
    assert found.verdict == "clear" and found.clear_until == 2 and found.untested.tested == 1
    assert animation.scene(1).first_contact().verdict == "clear"
    for wrong in (lambda: animation.scene(2), lambda: animation.poses(2.5)):
        with pytest.raises(chasles.InvalidInput, match="must be from 0 to"):
            wrong()
    assert [animation.poses(t)["box"][0, 3] for t in (0, 0.999, 1, 2)] == [0, 0, 6, 6]


@pytest.mark.parametrize(("places", "time"), [((0, 3.25, 6), 1), ((0, 0, 2.25), 2), ((0, 6, 3.5), 2)])
def test_a_jump_into_a_wall_touches_it_then(file, places, time):
    animation = chasles.gltf.read(jumper(*places).write(file))
    for found in (animation.first_contact(), *animation.all_contacts()):
        assert (found.verdict, found.pair, found.at_jump) == ("contact", ("box", "wall"), True)
        assert found.time == found.time_upper == found.clear_until == time


def test_a_jump_at_the_start_is_where_it_begins(file):
    found = chasles.gltf.read(jumper(3.25, 0, 0).write(file)).first_contact()
    assert found.verdict == "contact_at_start" and not found.at_jump and found.time == 0


def test_others_move_on_while_one_jumps(file):
    """The sled touches the box after the jump, and would have passed its old place before."""
    maker = jumper(0, 6, 6)
    sled = maker.node("sled", mesh=0, translation=[0, 0, 9])
    maker.animate(sled, "translation", [0, 2], [[6, 0, 9], [6, 0, -3]])
    found = chasles.gltf.read(maker.write(file)).first_contact()
    assert set(found.pair) == {"box", "sled"} and found.time == pytest.approx(8 / 6, abs=1e-9) and not found.at_jump
    maker = jumper(0, 6, 6)
    sled = maker.node("sled", mesh=0)
    maker.animate(sled, "translation", [0, 2], [[6, 0, 0.25], [6, 0, -9]])
    assert (
        chasles.gltf.read(maker.write(file)).first_contact().verdict == "clear"
    )  # it has left the place when the box comes


def test_pairs_that_stand_still_are_named(file):
    maker = Maker()
    mesh = maker.mesh()
    for number in range(3):
        maker.node(f"rock {number}", mesh=mesh, translation=[9 * number, 0, 0])
    cart = maker.node("cart")
    for number in range(2):
        maker.node(f"wheel {number}", cart, mesh=mesh, translation=[number / 2, 0, 0])
    maker.animate(cart, "translation", [0, 1], [[0, 5, 0], [9, 5, 0]])
    animation = chasles.gltf.read(maker.write(file))
    found = animation.first_contact()
    assert found.verdict == "clear" and found.untested.reasons == {"at_rest": 4} and found.untested.tested == 6
    assert ("wheel 0", "wheel 1") in found.untested.named["at_rest"] and "4 at rest" in str(found)
    scene = animation.scene()
    assert scene.first_contact().untested.tested == 6 and scene.least_distance().distance == pytest.approx(4, rel=1e-5)
    ignored = animation.untested(ignore=[("wheel 0", "rock 1"), ("rock 1", "wheel 0"), ("rock 0", "rock 1")])
    assert ignored.reasons == {"at_rest": 4, "ignored": 1} and ignored.pairs == 5
    with pytest.raises(chasles.InvalidInput, match="nobody"):
        animation.first_contact(ignore=[("wheel 0", "nobody")])


def test_what_touches_at_the_start_can_be_left_out(file):
    maker = jumper(0, 0, 0)
    maker.animate(maker.node("lid", mesh=0), "translation", [0, 2], [[0, 1, 0], [0, 1.5, 0]])
    animation = chasles.gltf.read(maker.write(file))
    assert animation.first_contact().verdict == "contact_at_start"
    found = animation.first_contact(ignore_touching_at_start=True)
    assert found.verdict == "clear" and found.untested.reasons == {"at_rest": 1, "touching_at_start": 1}


def test_names_are_those_of_load_parts(file):
    maker = Maker()
    named, nameless = maker.mesh(name="wheel"), maker.mesh()
    group = maker.node("group")
    for name, mesh in [("wheel", nameless), (None, named), ("wheel_2", named), (None, nameless), ("wheel", named)]:
        maker.node(name, group, mesh=mesh)
    maker.node(None, mesh=nameless)
    maker.animate(group, "translation", [0, 1], [[0, 0, 0], [1, 0, 0]])
    animation = chasles.gltf.read(maker.write(file))
    parts = chasles.load_parts(file)
    assert sorted(animation.bodies) == sorted(parts) == ["group", "part", "wheel", "wheel_2", "wheel_3", "wheel_4"]
    poses = animation.poses(0)
    for name, part in parts.items():
        np.testing.assert_array_equal(corners_of(animation, poses, name), part.vertices)


def test_several_animations_are_chosen_or_played_together(file):
    maker = jumper(0, 0, 0)
    box = 1
    maker.animate(box, "rotation", [0, 4], [[0, 0, 0, 1], UP], animation=1)
    assert chasles.gltf.animations(maker.write(file)) == ["take 0", "take 1"]
    with pytest.raises(chasles.InvalidInput, match="has 2 animations \\('take 0', 'take 1'\\); choose one"):
        chasles.gltf.read(file)
    both = chasles.gltf.read(file, ["take 0", 1])
    assert both.duration == 4 and both.animations == ["take 0", "take 1"]
    for wrong, why in [
        ("walk", "no animation 'walk'"),
        (2, "no animation 2"),
        ([0, 0], "each once"),
        ([], "at least one"),
    ]:
        with pytest.raises(chasles.InvalidInput, match=why):
            chasles.gltf.read(file, wrong)


def test_a_copy_answers_with_the_same_bits(file):
    animation = chasles.gltf.read(random_scene(np.random.default_rng(4)).write(file))
    found = animation.first_contact()
    for again in (pickle.loads(pickle.dumps(animation)), copy.deepcopy(animation)):
        assert again.first_contact().as_json() == found.as_json()
    assert pickle.loads(pickle.dumps(found)).as_json() == found.as_json()


def test_frames_of_pages_show_fast_turns(file):
    maker = jumper(0, 0, 0)
    spin = [[0, np.sin(a), 0, np.cos(a)] for a in 1.4 * np.arange(3)]
    maker.animate(1, "rotation", [0, 0.01, 1], spin)
    times = chasles.gltf.read(maker.write(file)).frames(0.5)
    assert times[0] == 0 and times[-1] == 2 and np.isclose(times, 0.01).any()
    assert np.diff(times[times <= 0.0101]).max() < 0.0018 and len(times) == 2 * 6 + 1


def test_a_limit_of_time_leaves_what_is_proven(file):
    animation = chasles.gltf.read(random_scene(np.random.default_rng(0)).write(file))
    with chasles.Limit(1e-9):
        found = animation.first_contact()
    assert found.verdict == "unknown" and found.clear_until < animation.duration and "UNKNOWN" in str(found)


def test_the_page_tells_the_truth(tmp_path, monkeypatch):
    import doctest

    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(
        code_of(ROOT / "docs" / "gltf.md"), {}, "docs/gltf.md", "docs/gltf.md", 0
    )
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures and len(example.examples) > 5, "".join(failures)
