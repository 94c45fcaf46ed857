"""Makers of the objects of all public types, for the tests of pickle and of copies."""

import functools
import pathlib
import tempfile

import numpy as np
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
        lambda: (slider() * trajectory()).reversed(),
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
