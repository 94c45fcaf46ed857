"""A valid call of every public function that takes arrays, for tests that damage one array after another.

Each entry makes what is called, and the arrays by the names of their parameters.
"""

import importlib
import importlib.util
import inspect
import re
from functools import partial

import numpy as np
from cubes import CUBE_FACES, CUBE_VERTICES, pose
from public_objects import cube, folder, hinge_robot, own_bounds, own_pose

import chasles

START, GOAL, REST = pose(3, 0, 0), pose(2, 0, 0), np.array([0.0, 0, 0, 1, 0, 0, 0])
TIMES, ROWS, RATES = np.array([0.0, 1, 2]), np.array([[0.0], [0.1], [0.2]]), np.zeros((3, 1))
ENDS, FOUR = {"start": START, "goal": GOAL}, {"start": START, "goal": GOAL, "fixed_start": REST, "fixed_goal": REST}
RELATIVE = {"moving_start": START, "moving_goal": GOAL, "fixed_start": REST, "fixed_goal": REST}
EDGE, EDGES = {"start": [0.0], "goal": [0.1]}, {"starts": [[0.0]], "goals": [[0.1]]}
PATH = {"configurations": ROWS, "times": TIMES, "velocities": RATES, "accelerations": RATES}


def world(*more):
    scene = chasles.Scene()
    for name, at in (("box", START), ("other", pose(9, 0, 0)), *more):
        scene.add(name, cube(), at)
    return scene


def manager():
    result = chasles.CollisionManager()
    result.add_object("a", cube())
    return result


def checker():
    return chasles.RobotChecker(hinge_robot())


def two_robots(paths):
    """One moves, and the other rests at the array."""
    robots = {"moving": hinge_robot(), "resting": hinge_robot()}
    moving = chasles.JointPath.straight(robots["moving"], ROWS)
    return chasles.JointPath.together(chasles.Robot.together(robots), {"moving": moving, "resting": paths})


def hand():
    return chasles.DraggedBody(world(), "box", margin=0.01)


CALLS = {
    "ConstantTwist.between": lambda: (chasles.ConstantTwist.between, ENDS),
    "ConstantVelocity.between": lambda: (chasles.ConstantVelocity.between, ENDS | {"centre": [0.0, 0, 0]}),
    "DragLock.__init__": lambda: (partial(chasles.DragLock, "hinge"), {"direction": [0.0, 0, 1], "point": [0.0, 0, 0]}),
    "DraggedBody.update": lambda: (hand().update, {"goal": GOAL}),
    "DraggedBody.follow": lambda: (hand().follow, {"goals": [START, GOAL]}),
    "DraggedBody.force": lambda: (hand().force, {"goal": GOAL}),
    "JointPath.straight": lambda: (
        partial(chasles.JointPath.straight, hinge_robot()), {"configurations": ROWS, "times": TIMES}),
    "JointPath.cubic": lambda: (
        partial(chasles.JointPath.cubic, hinge_robot()), {"times": TIMES, "positions": ROWS, "velocities": RATES}),
    "JointPath.quintic": lambda: (
        partial(chasles.JointPath.quintic, hinge_robot()),
        {"times": TIMES, "positions": ROWS, "velocities": RATES, "accelerations": RATES}),
    "JointPath.natural_spline": lambda: (
        partial(chasles.JointPath.natural_spline, hinge_robot()), {"times": TIMES, "positions": ROWS}),
    "JointPath.polynomials": lambda: (
        partial(chasles.JointPath.polynomials, hinge_robot()), {"breaks": TIMES[:2], "coefficients": np.zeros((2, 1, 1))}),
    "MassProperties.__init__": lambda: (chasles.MassProperties, {"inertia": np.eye(3), "centre": [0.0, 0, 0]}),
    "Motion.at_rest": lambda: (chasles.Motion.at_rest, {"pose": START}),
    "Motion.hinge": lambda: (
        partial(chasles.Motion.hinge, angle=[0, 1]), {"point": [0.0, 0, 0], "direction": [0.0, 0, 1]}),
    "Motion.slider": lambda: (partial(chasles.Motion.slider, way=[0, 1]), {"direction": [0.0, 0, 1]}),
    "Motion.polynomial": lambda: (chasles.Motion.polynomial, {"places": [[0.0, 0, 0], [1, 0, 0]]}),
    "Polyhedron.__init__": lambda: (chasles.Polyhedron, {"vertices": CUBE_VERTICES, "faces": CUBE_FACES}),
    "Robot.profile": lambda: (hinge_robot().profile, PATH | {"margins": [0.1]}),
    "Robot.box_of_joints": lambda: (partial(hinge_robot().box_of_joints, ["turn"]), {"configuration": [0.0]}),
    "Robot.range": lambda: (hinge_robot().range, {"lower": [0.0], "upper": [0.1]}),
    "Robot.clear_box": lambda: (hinge_robot().clear_box, {"lower": [0.0], "upper": [0.1], "around": [0.05]}),
    "Robot.warnings_about": lambda: (hinge_robot().warnings_about, {"configurations": ROWS}),
    "Robot.shape": lambda: (hinge_robot().shape, {"configuration": [0.0]}),
    "Robot.link_pose": lambda: (partial(hinge_robot().link_pose, "arm"), {"configuration": [0.0]}),
    "Robot.link_poses": lambda: (hinge_robot().link_poses, {"configuration": [0.0]}),
    "Robot.set_base": lambda: (hinge_robot().set_base, {"pose": START}),
    "Robot.attach": lambda: (partial(hinge_robot().attach, "new", "arm", cube()), {"pose": START}),
    "Robot.first_contact": lambda: (hinge_robot().first_contact, EDGE),
    "Robot.first_contact_on_path": lambda: (hinge_robot().first_contact_on_path, PATH),
    "Robot.least_distance": lambda: (hinge_robot().least_distance, EDGE),
    "RobotChecker.first_contact": lambda: (checker().first_contact, EDGE),
    "RobotChecker.is_clear": lambda: (checker().is_clear, EDGE),
    "RobotChecker.pairs_in_contact": lambda: (checker().pairs_in_contact, {"configuration": [0.0]}),
    "RobotChecker.certificate": lambda: (checker().certificate, {"configurations": ROWS}),
    "RobotChecker.verify": lambda: (
        partial(checker().verify, certificate=checker().certificate(ROWS)),
        {"configurations": ROWS},
    ),
    "RobotChecker.first_contact_on_path": lambda: (checker().first_contact_on_path, PATH),
    "RobotChecker.least_distance": lambda: (checker().least_distance, EDGE),
    "RobotChecker.least_distance_on_path": lambda: (checker().least_distance_on_path, PATH),
    "RobotChecker.first_contacts": lambda: (checker().first_contacts, EDGES),
    "Scene.profile": lambda: (world().profile, {"margins": [0.1]}),
    "Scene.add": lambda: (
        partial(world().add, "new", cube()), {"pose": pose(6, 0, 0), "goal": pose(7, 0, 0), "centre": [0.0, 0, 0]}),
    "Scene.move": lambda: (partial(world().move, "box"), {"pose": START, "goal": GOAL, "centre": [0.0, 0, 0]}),
    "Scene.move_all": lambda: (world().move_all, {"starts": [START, pose(9, 0, 0)], "goals": [GOAL, pose(9, 0, 0)]}),
    "ScrewMotion.between": lambda: (chasles.ScrewMotion.between, ENDS),
    "ScrewMotion.relative": lambda: (chasles.ScrewMotion.relative, RELATIVE),
    "Spline.through": lambda: (partial(chasles.Spline.through, [0, 0.2, 0.5, 1]), {"poses": [START, GOAL, START, GOAL]}),
    "Spline.b_spline": lambda: (chasles.Spline.b_spline, {"poses": [START, GOAL, START, GOAL]}),
    "Stepper.move": lambda: (
        partial(chasles.Stepper(world(), margin=0.1).move, "box"), {"goal": GOAL, "centre": [0.0, 0, 0]}),
    "SweepMotion.between": lambda: (chasles.SweepMotion.between, ENDS | {"centre": [0.0, 0, 0]}),
    "SweepMotion.relative": lambda: (chasles.SweepMotion.relative, RELATIVE),
    "SweepMotion.about": lambda: (chasles.SweepMotion.between(START, GOAL).about, {"centre": [0.0, 0, 0]}),
    "TimedPoses.through": lambda: (
        partial(chasles.TimedPoses.through, [0, 1]), {"poses": [START, GOAL], "centre": [0.0, 0, 0]}),
    "Trajectory.__init__": lambda: (partial(chasles.Trajectory, own_pose, own_bounds), {"reference": [0.0, 0, 0]}),
    "first_contact": lambda: (partial(chasles.first_contact, cube(), cube()), FOUR),
    "least_distance": lambda: (partial(chasles.least_distance, cube(), cube()), FOUR),
    "profile": lambda: (partial(chasles.profile, cube(), cube()), FOUR | {"margins": [0.1]}),
    "first_contact_on_path": lambda: (partial(chasles.first_contact_on_path, cube(), cube()), {"poses": [START, GOAL]}),
    "points": lambda: (partial(chasles.points, radius=0.1), {"points": CUBE_VERTICES}),
    "first_contact_batch": lambda: (
        partial(chasles.first_contact_batch, cube(), cube()), {"starts": [START], "goals": [GOAL]}),
    "least_distance_batch": lambda: (
        partial(chasles.least_distance_batch, cube(), cube()), {"starts": [START], "goals": [GOAL]}),
    "certificate_batch": lambda: (partial(chasles.certificate_batch, cube(), cube()), {"starts": [START], "goals": [GOAL]}),
    "path_is_clear_batch": lambda: (partial(chasles.path_is_clear_batch, cube(), cube()), {"paths": [[START, GOAL]]}),
    "first_contacts_on_edges": lambda: (partial(chasles.first_contacts_on_edges, checker()), EDGES),
    "CollisionManager.add_object": lambda: (partial(manager().add_object, "b", cube()), {"transform": np.eye(4)}),
    "CollisionManager.set_transform": lambda: (partial(manager().set_transform, "a"), {"transform": np.eye(4)}),
    "CollisionManager.in_collision_single": lambda: (
        partial(manager().in_collision_single, cube()), {"transform": np.eye(4)}),
    "CollisionManager.min_distance_single": lambda: (
        partial(manager().min_distance_single, cube()), {"transform": np.eye(4)}),
    "CollisionManager.first_contact": lambda: (lambda goals: manager().first_contact({"a": goals}), {"goals": np.eye(4)}),
    "JointPath.together": lambda: (two_robots, {"paths": [0.0]}),
    "recording_page": lambda: (
        partial(chasles.recording_page, folder() / "page.html", [cube(), cube()]), {"times": [0.0, 1], "poses": [[START, REST]] * 2}),
    "view": lambda: (partial(chasles.view, cube(), cube(), out=folder() / "page.html"), ENDS),
    "write_robot_page": lambda: (
        partial(chasles.write_robot_page, hinge_robot(), out=folder() / "page.html"), {"configurations": ROWS}),
}  # fmt: skip


def gate():
    from chasles.policy import PolicyGate

    return PolicyGate(hinge_robot(), milliseconds=1000)


def trajectory_of(positions, velocities, accelerations, start):
    """A message whose second point has them, and whose first one has neither rate."""
    import chasles.ros

    last = {"positions": positions, "velocities": velocities, "accelerations": accelerations, "time_from_start": 2.0}
    points = [{"positions": [0.0], "time_from_start": 1.0}, last]
    return chasles.ros.joint_path({"joint_names": ["turn"], "points": points}, hinge_robot(), start=start)


def of_mujoco():
    import mujoco

    world = """<mujoco><worldbody><geom size="0.1"/><body mocap="true" name="m" pos="5 0 0"><geom size="0.1"/></body>
    <body pos="0 0 1"><joint type="slide"/><joint type="ball"/><geom size="0.1"/></body></worldbody></mujoco>"""
    return mujoco.MjModel.from_xml_string(world)


STATES = {"qpos": np.array([[0.0, 1, 0, 0, 0], [0.1, 1, 0, 0, 0]]), "mocap": np.array([[[5.0, 0, 0, 1, 0, 0, 0]]] * 2)}


def of_pinocchio():
    import pinocchio as pin

    model = pin.Model()
    for name, joint in (("turn", pin.JointModelRUBZ()), ("free", pin.JointModelFreeFlyer())):
        model.addJoint(0, joint, pin.SE3.Identity(), name)
    return model


def of_drake():
    from pydrake.geometry import Sphere
    from pydrake.math import RigidTransform
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction
    from pydrake.multibody.tree import PrismaticJoint
    from pydrake.systems.framework import DiagramBuilder

    import chasles.drake

    plant, graph = AddMultibodyPlantSceneGraph(DiagramBuilder(), 0.0)
    ball = plant.AddRigidBody("ball")
    plant.RegisterCollisionGeometry(ball, RigidTransform(), Sphere(0.1), "shape", CoulombFriction(1, 1))
    plant.AddJoint(PrismaticJoint("slide", plant.world_frame(), ball.body_frame(), [1, 0, 0]))
    plant.Finalize()
    return plant, graph, chasles.drake.robot(plant, graph)


def drake_path(rest):
    from pydrake.trajectories import BezierCurve

    plant, _, robot = of_drake()
    return chasles.drake.joint_path(BezierCurve(0, 1, np.array([[0.0, 1.0]])), robot, plant, rest=rest)


def cad_assembly():
    import cad_shapes as cs

    return cs.assembly(block=cs.box(10, 10, 10), left=cs.box(2, 30, 30, (-9, -10, -10)))


def cad_poses(configuration):
    made = cad_assembly()
    made.add_joint("rail", "prismatic", "world", "block", axis=(1, 0, 0), lower=-20, upper=50)
    return made.poses(made.robot(), configuration)


def joint_map(**options):
    return importlib.import_module("chasles.lerobot").JointMap(hinge_robot(), ["turn"], **options)


#: By the module, then as above. A module is left out where its platform is not installed.
OF_ADAPTERS = {
    "policy": {
        "PolicyGate.__call__": lambda: (gate(), {"present": [0.0], "actions": ROWS}),
        "GateDecision.at_period": lambda: (gate()([0.0], ROWS).at_period, {"present": [0.0], "actions": ROWS}),
    },
    "ros": {
        "joint_path": lambda: (
            trajectory_of, {"positions": [0.0], "velocities": [0.0], "accelerations": [0.0], "start": [0.0]}),
    },
    "mujoco": {
        "configurations": lambda: (partial(chasles.mujoco.configurations, of_mujoco()), STATES),
        "audit": lambda: (partial(chasles.mujoco.audit, of_mujoco()), STATES | {"times": TIMES[:2]}),
    },
    "pinocchio": {
        "configurations": lambda: (
            partial(chasles.pinocchio.configurations, of_pinocchio()), {"q": [[1.0, 0, 0, 0, 0, 0, 0, 0, 1]]}),
    },
    "drake": {
        "robot": lambda: (partial(chasles.drake.robot, *of_drake()[:2]), {"rest": [0.0]}),
        "configurations": lambda: (partial(chasles.drake.configurations, *of_drake()[::-2]), {"q": [[0.0]]}),
        "joint_path": lambda: (drake_path, {"rest": [0.0]}),
    },
    "ompl": {"StateMap.__init__": lambda: (partial(chasles.ompl.StateMap, hinge_robot(), ["turn"]), {"others": [0.0]})},
    "cad": {
        "Assembly.add_joint": lambda: (
            partial(cad_assembly().add_joint, "rail", "prismatic", "world", "block", lower=-1, upper=1),
            {"point": [0.0, 0, 0], "axis": [0.0, 0, 1]}),
        "Assembly.poses": lambda: (cad_poses, {"configuration": [0.0]}),
    },
    "lerobot": {
        "JointMap.__init__": lambda: (joint_map, {"scale": [1.0], "offset": [0.0], "others": [0.0]}),
        "JointMap.configurations": lambda: (joint_map().configurations, {"actions": ROWS}),
    },
}  # fmt: skip
PLATFORMS = {"ros": "numpy", "policy": "numpy", "pinocchio": "coal", "drake": "pydrake", "cad": "OCP"}


def modules():
    """The package, and its adapters whose platforms are installed."""
    names = [name for name in OF_ADAPTERS if importlib.util.find_spec(PLATFORMS.get(name, name))]
    return {"": chasles} | {name: importlib.import_module(f"chasles.{name}") for name in names}


def calls_of(module):
    return OF_ADAPTERS[module] if module else CALLS


def signatures_of(function):
    """Of all overloads."""
    of_core = getattr(function, "__nb_signature__", None)
    if of_core is not None:
        return [re.findall(r"(\w+): ([^:]*?ArrayLike)", text) for text, *_ in of_core]
    try:
        given = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return []
    return [[(p.name, str(p.annotation)) for p in given if re.search("ArrayLike|_SupportsArray", str(p.annotation))]]


def arrays_of(module):
    """(function, parameter) of all that a module offers."""
    found = set()
    for name in module.__all__:
        thing = getattr(module, name)
        functions = {name: thing}
        if inspect.isclass(thing):
            functions = {f"{name}.{key}": getattr(value, "__func__", value) for key, value in vars(thing).items()
                         if not key.startswith("_") or key in ("__init__", "__call__")}  # fmt: skip
        for key, function in functions.items():
            for signature in signatures_of(function):
                found |= {(key, parameter) for parameter, text in signature if "Callable" not in text}
    return found
