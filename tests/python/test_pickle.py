"""Pickle and copies of every public type: the copy behaves the same to the last bit, or one error names the way out."""

import copy
import functools
import gc
import importlib
import inspect
import pathlib
import pickle
import subprocess
import sys

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, pose

import chasles

RANDOM = np.random.default_rng(7)
ORIGIN = pose(0, 0, 0)

ROBOT = """<robot name="r"><link name="base"/><link name="back"><collision><origin xyz="-2 0 0"/>
<geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="bolted" type="fixed"><parent link="base"/><child link="back"/></joint><link name="arm"><collision><origin xyz="0.5 0 0"/>
<geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
<joint name="float" type="floating"><parent link="arm"/><child link="free"/></joint><link name="free"/></robot>"""


def own_pose(time):
    return [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0]


def own_bounds(start, end):
    return {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0}


@functools.cache
def cube():
    return chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)


def any_pose(x):
    """With a quaternion of any length, whose unit quaternion is no tuple of doubles."""
    return np.array([x, *RANDOM.uniform(-1, 1, 2), *RANDOM.normal(size=4)])


def poses(count):
    return [any_pose(x) for x in np.linspace(3, -1, count)]


def trajectory():
    return chasles.Trajectory(own_pose, own_bounds, reference=[0.1, 0.2, 0.3], knots=[0.5], rounding=2**-46)


def velocity():
    return chasles.ConstantVelocity.between(*poses(2), RANDOM.normal(size=3))


def hinge():
    return chasles.Motion.hinge(RANDOM.normal(size=3), RANDOM.normal(size=3), RANDOM.normal(size=4))


def slider():
    return chasles.Motion.slider(RANDOM.normal(size=3), [0.3, *RANDOM.normal(size=2)])


def track(**options):
    return chasles.TimedPoses.through([-1.3, 0.1, 0.7, 10 / 3], poses(4), **options)


def two_bodies():
    return chasles.ScrewMotion.relative(*poses(2), *poses(2), 0.3)


def many_factors():
    motion = chasles.Motion.at_rest(any_pose(3))
    for _ in range(900):
        motion = motion * chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 1e-4])
    return motion


def doubled():
    """Each step takes the one before twice: 64 factors."""
    motion = chasles.Motion.hinge(RANDOM.normal(size=3), RANDOM.normal(size=3), [0, 0.01, 0.02])
    for _ in range(6):
        motion = motion * motion
    return motion


MOTIONS = {
    "ScrewMotion": [
        lambda: chasles.ScrewMotion.between(*poses(2), 0.2),
        lambda: chasles.ScrewMotion.between(*poses(2), 0.2).pieces()[1],
        two_bodies,
        lambda: two_bodies().pieces()[2],
        lambda: two_bodies().pieces()[2].with_max_turn(0.11).pieces()[1],
        lambda: chasles.ConstantTwist.between(*poses(2)).screw_of_same_poses,
        lambda: chasles.first_contact(cube(), cube(), *poses(2)).motion,
    ],
    "SweepMotion": [
        lambda: chasles.SweepMotion.between(*poses(2), [0.5, 0, 0.25]),
        lambda: chasles.SweepMotion.relative(*poses(2), *poses(2)).about([1, 2, 3]),
    ],
    "ConstantVelocity": [velocity, lambda: chasles.first_contact(cube(), cube(), motion=velocity()).motion],
    "ConstantTwist": [lambda: chasles.ConstantTwist.between(*poses(2))],
    "TimedPoses": [track, lambda: track(between="twist"), lambda: track(centre=[1, 2, 3])],
    "Trajectory": [trajectory],
    "Motion": [
        lambda: chasles.Motion.at_rest(any_pose(1)),
        hinge,
        slider,
        lambda: chasles.Motion.polynomial(RANDOM.normal(size=(4, 3))),
        lambda: chasles.Spline.through([0, 0.1, 1 / 3, 1], poses(4)),
        lambda: chasles.Spline.b_spline(poses(3)),
        lambda: velocity() * hinge() * (slider() * chasles.ConstantTwist.between(*poses(2))),
        lambda: chasles.relative(velocity() * hinge(), track()),
        lambda: chasles.rest_of(slider() * hinge(), 1 / 3),
        lambda: chasles.Motion.at_rest(any_pose(1)) * trajectory(),
        lambda: trajectory() * chasles.rest_of(trajectory(), 0.1),
        lambda: scene().all_contacts(margin=1)[0].motion,
        lambda: manager().first_contact({"b": ORIGIN}).motion,
        many_factors,
        doubled,
    ],
}


def scene():
    result = chasles.Scene()
    result.add("rest", cube())
    result.add("own", cube(), motion=trajectory())
    result.add("product", cube(), motion=slider() * hinge(), group="moving")
    result.add("poses", cube(), any_pose(3), any_pose(-1), centre=[0.5, 0.5, 0.5])
    result.add("twist", cube(), any_pose(3), any_pose(0), motion="twist")
    result.ignore("rest", "twist")
    result.set_margin("rest", "own", 0.125)
    result.set_group_hold("", "moving", 0.001)
    return result


def dragged_scene():
    """The body is where an update has left it."""
    result = chasles.Scene()
    result.add("floor", cube())
    result.add("box", cube(), [0, 0, 3, 1, 0, 0, 0])
    chasles.DraggedBody(result, "box", margin=1e-3).update(pose(0.1, 0, -1, 1, 0.01, 0.02, 0))
    return result


def manager():
    result = chasles.CollisionManager()
    result.add_object("a", cube(), any_pose(0))
    result.add_object("b", cube(), any_pose(3))
    return result


@functools.cache
def folder():
    import tempfile

    path = pathlib.Path(tempfile.mkdtemp())
    (path / "robot.urdf").write_text(ROBOT)
    return path


def robot():
    (folder() / "robot.srdf").write_text('<robot name="r"><disable_collisions link1="none" link2="arm" reason="no"/></robot>')
    result = chasles.Robot.load(folder() / "robot.urdf", folder() / "robot.srdf")
    assert len(result.warnings) == 1
    result.attach("part", "arm", cube(), any_pose(0))
    return result


def configurations(count=4):
    return RANDOM.uniform(-1, 1, (count, 8))


def hinge_robot():
    text = ROBOT[: ROBOT.index('<joint name="float"')] + "</robot>"
    (folder() / "hinge.urdf").write_text(text)
    return chasles.Robot.load(folder() / "hinge.urdf")


def joint_paths():
    times, places = [0, 0.3, 1.7, 2], RANDOM.uniform(-1, 1, (4, 1))
    return [
        chasles.JointPath.straight(robot(), configurations()),
        chasles.JointPath.straight(robot(), configurations(), times),
        chasles.JointPath.cubic(hinge_robot(), times, places, RANDOM.normal(size=(4, 1))),
        chasles.JointPath.quintic(hinge_robot(), times, places, *RANDOM.normal(size=(2, 4, 1))),
        chasles.JointPath.natural_spline(hinge_robot(), times, places),
        chasles.JointPath.polynomials(hinge_robot(), [0, 1 / 3], RANDOM.uniform(-1, 1, (3, 1, 1))),
    ]


def interrupted():
    table = chasles.empty_table(3)
    table["verdict"][0] = "clear"
    return chasles.BatchInterrupted(table)


# --- What can be pickled: makers of objects, and all that can be seen of them ---


def answer(found):
    return found.verdict, found.time, found.time_upper, found.certain, found.clear_until, found.pose.tobytes()


def seen_of_motion(motion):
    times = [0, 1e-9, 0.3, 0.5, 2 / 3, 1]
    seen = [f(time).tobytes() for time in times for f in (motion.pose_at, motion.fixed_pose_at)]
    for name in ("angle", "max_turn", "stamps", "slide", "tau_at"):
        if hasattr(motion, name):
            value = getattr(motion, name)
            seen.append(value(0.3) if callable(value) else value)
    return [type(motion), *seen, answer(chasles.first_contact(cube(), cube(), motion=motion))]


def seen_of_scene(world):
    contacts = [(c.pair, answer(c)) for until in (0, 1) for c in world.all_contacts(margin=0.01, until=until)]
    return world.names, contacts, world.untested().named, world.clear_until(), answer(world.first_contact(margin=0.01))


def seen_of_manager(objects):
    moving = objects.first_contact({"b": ORIGIN})
    return moving.pair, answer(moving), objects.min_distance_internal(), objects.in_collision_single(cube())


def seen_of_robot(arm):
    rows = np.linspace(-1, 1, 16).reshape(2, 8)
    found = arm.first_contact(*rows, scene=dragged_scene())
    numbers = found.time, found.time_upper, found.clear_until, found.configuration.tobytes()
    return arm.name, arm.variables, arm.links, arm.warnings, arm.limits.tobytes(), found.pair, numbers


def seen_of_path(path):
    begin, end = path.times[0], path.times[-1]
    parts = [part.tobytes() for segment in path.__getstate__()[0] for part in segment[2:]]
    return parts, path.times.tobytes(), [path.at(t).tobytes() for t in np.linspace(begin, end, 23)], repr(path)


def seen_of_hand(**options):
    world = dragged_scene()
    step = chasles.DraggedBody(world, "box", margin=1e-3, **options).update(pose(1, 1, -1, 1, 0.1, 0, 0))
    return step.pose.tobytes(), step.wrench.tobytes()


PICKLED = {
    **{name: (makers, seen_of_motion) for name, makers in MOTIONS.items()},
    "BatchInterrupted": ([interrupted], lambda e: (str(e), e.table.tobytes())),
    "Cancelled": ([lambda: chasles.Cancelled("cancelled")], lambda e: e.args),
    "CollisionManager": ([manager], seen_of_manager),
    "ContactKind": ([lambda: chasles.ContactKind.edge_edge], lambda kind: kind is chasles.ContactKind.edge_edge),
    "DragLock": (
        [lambda: chasles.DragLock("cylinder", RANDOM.normal(size=3), RANDOM.normal(size=3))],
        lambda lock: (lock.kind, seen_of_hand(lock=lock)),
    ),
    "Find": ([lambda: chasles.Find.any], lambda find: find is chasles.Find.any),
    "InvalidInput": ([lambda: chasles.InvalidInput("what: why")], lambda e: e.args),
    "JointPath": ([functools.partial(lambda i: joint_paths()[i], i) for i in range(6)], seen_of_path),
    "MassProperties": (
        [lambda: chasles.MassProperties(np.diag([1.1, 1.2, 1.3]) + 0.1, [0.1, 0.2, 0.3])],
        lambda mass: seen_of_hand(mass=mass),
    ),
    "Polyhedron": ([cube], lambda body: (body.vertices.tobytes(), body.faces, body.source_faces.tobytes())),
    "Robot": ([robot], seen_of_robot),
    "Scene": ([scene, dragged_scene], seen_of_scene),
    "Verdict": ([lambda: chasles.Verdict.clear], lambda verdict: verdict is chasles.Verdict.clear),
    "collision_data.ContactData": (
        [lambda: touching().in_collision_internal(return_data=True)[1][0]],
        lambda d: (d.names, d.point.tobytes(), d.normal.tobytes(), d.index("a")),
    ),
    "collision_data.DistanceData": (
        [lambda: manager().min_distance_internal(return_data=True)[1]],
        lambda d: (d.names, d.distance, d.lower, d.point("a").tobytes(), d.index("b")),
    ),
    "distributed.ParquetRun": ([lambda: parquet_run()], lambda run: run),
}


def touching():
    result = manager()
    result.set_transform("a", ORIGIN)
    result.set_transform("b", pose(1, 0.5, 0.5))
    return result


def parquet_run():
    kind = pytest.importorskip("chasles.distributed").ParquetRun
    return kind(*range(len(inspect.signature(kind).parameters)))


# --- What refuses: makers of objects, and the way out ---

ANSWER = "keep the numbers that you need from this answer, or ask again"


def dragged():
    world = chasles.Scene()
    world.add("floor", cube())
    world.add("box", cube(), [0, 0, 1.001, 1, 0, 0, 0])
    return chasles.DraggedBody(world, "box", margin=1e-3)


def found_contact():
    return chasles.first_contact(cube(), cube(), pose(3, 0.2, 0.3), pose(0, 0.2, 0.3))


def overlapping():
    return chasles.first_contact(cube(), cube(), pose(0.5, 0.2, 0.3), pose(3, 0.2, 0.3))


def stepper():
    return chasles.Stepper(scene(), margin=1e-3)


REFUSED = {
    "Contact": (lambda: found_contact().contacts[0], ANSWER),
    "DragContact": (lambda: dragged().update(pose(0, 0, -1)).contacts[0], ANSWER),
    "DragEvent": (lambda: dragged().update(pose(0, 0, -1)).events[0], ANSWER),
    "DragStep": (lambda: dragged().update(pose(0, 0, -1)), ANSWER),
    "DraggedBody": (dragged, "pickle its scene, and make another one"),
    "FirstContact": (found_contact, ANSWER),
    "LeastDistance": (lambda: chasles.least_distance(cube(), cube(), pose(3, 0, 0), pose(2, 0, 0)), ANSWER),
    "Limit": (lambda: chasles.Limit(1), "make another one"),
    "MeshReport": (lambda: cube().report, ANSWER),
    "Overlap": (lambda: overlapping().overlap, ANSWER),
    "PairMemory": (lambda: chasles.PairMemory(cube(), cube()), "make another one"),
    "PairProof": (lambda: hinge_robot().prove_pairs(seconds=0.1)[0], ANSWER),
    "PathContact": (lambda: chasles.first_contact_on_path(cube(), cube(), [pose(3, 0, 0), pose(2, 0, 0)]), ANSWER),
    "RobotChecker": (lambda: chasles.RobotChecker(robot()), "pickle its robot and its scene, and make another one"),
    "RobotClearance": (lambda: robot().least_distance(*configurations(2)), ANSWER),
    "RobotContact": (lambda: robot().first_contact(*configurations(2)), ANSWER),
    "SceneContact": (lambda: scene().first_contact(), ANSWER),
    "StepEvent": (lambda: chasles.Stepper(falling(), margin=1e-3).advance(), ANSWER),
    "Stepper": (stepper, "pickle its scene, and make another one"),
    "UntestedPairs": (lambda: scene().untested(), ANSWER),
    "Work": (lambda: found_contact().work, ANSWER),
}
WITHOUT_OBJECTS = {"Spline"}  # its functions return a Motion


def falling():
    world = chasles.Scene()
    world.add("floor", cube())
    world.add("box", cube(), pose(0, 0, 3), pose(0, 0, 0))
    return world


def public_types():
    types = {name: value for name, value in vars(chasles).items() if isinstance(value, type)}
    found = {name for name, value in types.items() if value.__module__.startswith("chasles")}
    for file in pathlib.Path(chasles.__file__).parent.glob("[a-z]*.py"):
        if file.stem in ("ompl", "placed", "partitions", "questions"):  # optional, and of the package's own use
            continue
        module = importlib.import_module(f"chasles.{file.stem}")
        for name, value in vars(module).items():
            is_own = isinstance(value, type) and value.__module__ == module.__name__ and not name.startswith("_")
            if is_own and not hasattr(chasles, name):
                found.add(f"{file.stem}.{name}")
    return found


def test_every_public_type_is_pickled_or_refuses():
    """A new type has to be named above."""
    assert set(PICKLED) | set(REFUSED) | WITHOUT_OBJECTS == public_types()
    assert not set(PICKLED) & set(REFUSED)


CASES = [pytest.param(make, seen, id=f"{name}-{i}") for name, (all_, seen) in PICKLED.items() for i, make in enumerate(all_)]


@pytest.mark.parametrize("make, seen", CASES)
def test_copies_are_the_same_to_the_last_bit(make, seen):
    thing = make()
    expected = seen(thing)
    for again in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
        assert type(again) is type(thing)
        assert seen(again) == expected
        assert seen(pickle.loads(pickle.dumps(again))) == expected


def test_the_makers_make_what_they_are_named_by():
    for name, (makers, _) in PICKLED.items():
        assert all(type(make()).__name__ == name.split(".")[-1] for make in makers)
    for name, (make, _) in REFUSED.items():
        assert type(make()).__name__ == name


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_pickled_says_so_and_names_the_way_out(name):
    make, way_out = REFUSED[name]
    thing = make()
    for save in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError) as error:
            save(thing)
        assert str(error.value) == f"cannot pickle or copy a chasles.{name}: {way_out}"


def test_spline_has_no_objects():
    with pytest.raises(TypeError):
        chasles.Spline()


# --- Motions ---


def test_functions_that_pickle_cannot_find_are_refused_by_name():
    own = chasles.Trajectory(lambda time: own_pose(time), own_bounds)
    for thing in (own, own * slider(), chasles.rest_of(own, 0.5)):
        with pytest.raises((pickle.PicklingError, AttributeError), match="lambda"):
            pickle.dumps(thing)
        assert copy.copy(thing).pose_at(0.5).tobytes() == thing.pose_at(0.5).tobytes()


class Follower:
    def __init__(self):
        self.speed = 4

    def pose_at(self, time):
        return [3 - self.speed * time, 0.2, 0.3, 1, 0, 0, 0]


def test_methods_of_objects_are_pickled_with_their_objects():
    follower = Follower()
    own = chasles.Trajectory(follower.pose_at, own_bounds)
    follower_again, again, product = pickle.loads(pickle.dumps((follower, own, hinge() * own)))
    follower_again.speed = 8
    assert again.pose_at(0.25)[0, 3] == 1 and own.pose_at(0.25)[0, 3] == 2
    assert product.pose_at(0.25).tobytes() != (hinge() * own).pose_at(0.25).tobytes()


def test_a_copy_keeps_its_functions_alive():
    again = pickle.loads(pickle.dumps(hinge() * trajectory()))
    world = pickle.loads(pickle.dumps(scene()))
    gc.collect()
    assert again.pose_at(0.5).shape == (4, 4) and world.first_contact().verdict == "contact_at_start"


def test_shared_factors_are_saved_once():
    assert len(doubled().__getstate__()) == 7
    assert len(pickle.dumps(doubled())) < 3000


def test_another_process_reads_them(tmp_path):
    things = [many_factors(), track(), joint_paths()[4], scene_by_poses()]
    (tmp_path / "things").write_bytes(pickle.dumps(things))
    program = (
        "import pickle, pathlib, sys\n"
        "motion, track, path, scene = pickle.loads(pathlib.Path(sys.argv[1]).read_bytes())\n"
        "print(motion.pose_at(0.3).tobytes(), track.pose_at(0.3).tobytes(), path.at(0.4).tobytes(), scene.first_contact().time)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "things")], capture_output=True, text=True, timeout=100
    )
    motion, stamped, path, world = things
    expected = motion.pose_at(0.3).tobytes(), stamped.pose_at(0.3).tobytes(), path.at(0.4).tobytes()
    assert (done.stdout.strip(), done.stderr) == (
        " ".join([*map(str, expected), str(world.first_contact().time)]),
        "",
    )


def scene_by_poses():
    result = falling()
    result.move("floor", motion=slider() * hinge())
    result.move("box", any_pose(3), any_pose(0))
    return result


def test_a_copied_scene_changes_by_itself():
    world = falling()
    other = copy.copy(world)
    other.remove("floor")
    other.move("box", ORIGIN)
    assert world.names == ["floor", "box"] and world.first_contact().verdict == "contact"
    assert other.names == ["box"]


def test_a_copied_robot_changes_by_itself():
    arm = robot()
    other = copy.copy(arm)
    other.detach("part")
    other.set_base(pose(1, 0, 0))
    assert arm.link_pose("base", configurations(1)[0])[0, 3] == 0
    assert not arm.is_tested("part", "arm")
    with pytest.raises(chasles.InvalidInput):
        other.is_tested("part", "arm")


SPOILT = [(), (1,), ("rest",), (("rest", (np.zeros(7),), ()),), (("rest", (), ()),), (("product", (), (0, 1)),)]
SPOILT += [(("rest", (ORIGIN,), ()), ("product", (), (0, 1))), (("none", (), ()),), (("hinge", ("a", 1, 2), ()),)]
SPOILT += [(("trajectory", 3),), (("trajectory", chasles.ScrewMotion.between(ORIGIN, ORIGIN)),), ((None,) * 3,)]


@pytest.mark.parametrize("kind", ["Motion", "TimedPoses", "JointPath", "Trajectory", "ConstantVelocity", "ConstantTwist"])
@pytest.mark.parametrize("state", SPOILT)
def test_a_spoilt_state_is_refused(kind, state):
    kind = getattr(chasles, kind)
    with pytest.raises(chasles.InvalidInput):
        kind.__new__(kind).__setstate__(state)


def test_what_rounding_took_from_coefficients_is_kept():
    for path in joint_paths()[2:]:
        segments, _ = path.__getstate__()
        assert any(np.any(remainders) for _, _, _, remainders in segments)


def test_a_spoilt_joint_path_is_refused():
    segments, quaternions = joint_paths()[0].__getstate__()
    begin, end, coefficients, rest = segments[0]
    for state in [
        (segments, [5]),
        (segments, [2**64 - 1]),
        ((), quaternions),
        (((end, begin, coefficients, rest),), quaternions),
        (((begin, end, coefficients * np.nan, rest),), quaternions),
        (((begin, end, coefficients, rest[:, 1:]),), quaternions),
        ((segments[0], (begin, end, coefficients[:, 1:], rest[:, 1:])), quaternions),
    ]:
        with pytest.raises(chasles.InvalidInput, match="state: is not that of a path"):
            chasles.JointPath.__new__(chasles.JointPath).__setstate__(state)
