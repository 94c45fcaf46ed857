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
from cubes import pose
from public_objects import (
    MOTIONS,
    ORIGIN,
    RANDOM,
    any_pose,
    configurations,
    cube,
    doubled,
    dragged_scene,
    hinge,
    hinge_robot,
    interrupted,
    joint_paths,
    manager,
    many_factors,
    own_bounds,
    own_pose,
    robot,
    scene,
    slider,
    track,
    trajectory,
)

import chasles
from chasles.policy import PolicyGate
from chasles.ros import Recorded


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
    "gate_decision.GateDecision": (
        [lambda: PolicyGate(hinge_robot(), mode="shorten", milliseconds=1e4)([0], [[0.1], [3.5]])],
        lambda decision: (decision.record(), decision.actions.tobytes(), decision.speeds.tobytes()),
    ),
    "ros.Recorded": ([lambda: Recorded("/arm", 1.5, {"points": []})], lambda message: message),
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
    "DistanceMatrix": (lambda: falling().least_distances(), ANSWER),
    "DistanceProfile": (lambda: chasles.profile(cube(), cube(), pose(3, 0, 0), pose(2, 0, 0)), ANSWER),
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
    "ClearBox": (lambda: robot().clear_box(*robot().box_of_joints(["turn"])), ANSWER),
    "RobotRange": (lambda: robot().range(*robot().box_of_joints(["turn"])), ANSWER),
    "SceneContact": (lambda: scene().first_contact(), ANSWER),
    "StepEvent": (lambda: chasles.Stepper(falling(), margin=1e-3).advance(), ANSWER),
    "Stepper": (stepper, "pickle its scene, and make another one"),
    "policy.PolicyGate": (lambda: PolicyGate(robot()), "pickle its robot and its scene, and make another one"),
    "UntestedPairs": (lambda: scene().untested(), ANSWER),
    "Work": (lambda: found_contact().work, ANSWER),
}
WITHOUT_OBJECTS = {"Spline"}  # its functions return a Motion


def falling():
    world = chasles.Scene()
    world.add("floor", cube())
    world.add("box", cube(), pose(0, 0, 3), pose(0, 0, 0))
    return world


# Modules of the package's own use.
OWN_USE = ("placed", "partitions", "questions", "gate_question", "program", "robot_tree", "ros_node", "ros_path", "ros_followers")


def public_types():
    types = {name: value for name, value in vars(chasles).items() if isinstance(value, type)}
    found = {name for name, value in types.items() if value.__module__.startswith("chasles")}
    for file in pathlib.Path(chasles.__file__).parent.glob("[a-z]*.py"):
        # tests of the adapters pickle what they have, such as an Audit
        is_optional = file.stem in ("ompl", "lerobot", "pinocchio") or file.stem.startswith(("mujoco", "drake", "gltf", "cad"))
        if is_optional or file.stem in OWN_USE:
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
        assert type(make()).__name__ == name.split(".")[-1]


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


@pytest.mark.parametrize("kind", "Motion TimedPoses JointPath Trajectory ConstantVelocity ConstantTwist Polyhedron".split())
@pytest.mark.parametrize("state", SPOILT)
def test_a_spoilt_state_is_refused(kind, state):
    kind = getattr(chasles, kind)
    with pytest.raises(chasles.InvalidInput):
        kind.__new__(kind).__setstate__(state)


def test_what_rounding_took_from_coefficients_is_kept():
    for path in joint_paths()[2:]:
        segments, *_ = path.__getstate__()
        assert any(np.any(remainders) for _, _, _, remainders in segments)


def test_a_joint_path_remembers_its_variables():
    arm = hinge_robot()
    path = copy.copy(chasles.JointPath.straight(arm, [[0], [1]]))
    again = pickle.loads(pickle.dumps(path))
    assert arm.first_contact_on_path(again).verdict == arm.first_contact_on_path(path).verdict
    ((name, is_continuous),) = again.__getstate__()[2]
    assert ([name], [is_continuous]) == (arm.variables, arm.continuous)
    other = chasles.JointPath.__new__(chasles.JointPath)
    other.__setstate__((*again.__getstate__()[:2], (("other", is_continuous),)))
    with pytest.raises(chasles.InvalidInput, match=f"belongs to another robot: variable 0 is 'other' .* '{name}'"):
        arm.first_contact_on_path(other)


def test_a_spoilt_joint_path_is_refused():
    segments, quaternions, variables, _ = joint_paths()[0].__getstate__()
    begin, end, coefficients, rest = segments[0]
    for state in [
        (segments, [5], variables),
        (segments, [2**64 - 1], variables),
        ((), quaternions, variables),
        (((end, begin, coefficients, rest),), quaternions, variables),
        (((begin, end, coefficients * np.nan, rest),), quaternions, variables),
        (((begin, end, coefficients, rest[:, 1:]),), quaternions, variables),
        ((segments[0], (begin, end, coefficients[:, 1:], rest[:, 1:])), quaternions, variables),
        (segments, quaternions),
        (segments, quaternions, variables[1:]),
        (segments, quaternions, (("a", True, 1), *variables[1:])),
        (segments, quaternions, ((1, True), *variables[1:])),
        (segments, quaternions, variables, 5),
        (segments, quaternions, variables, "straight"),
    ]:
        with pytest.raises(chasles.InvalidInput, match="state: is not that of a path"):
            chasles.JointPath.__new__(chasles.JointPath).__setstate__(state)
