"""Joints of `chasles.cad` that follow others, and what is refused of them."""

import numpy as np
import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_shapes as cs  # noqa: E402
from chasles.cad_assembly import Assembly  # noqa: E402
from chasles.cad_tree import Node  # noqa: E402


def hinge(*followers, **leader):
    """The hinge of `cad_cases`, whose leaf meets its stop at STOP; and a block far away, which leads."""
    made = cs.assembly(leaf=cs.box(40, 2, 10), stop=cs.box(10, 5, 10, (20, 20, 0)), block=cs.box(1, 1, 1, (0, 0, 90)))
    made.add_joint("lead", "prismatic", "world", "block", **dict(dict(lower=0, upper=1), **leader))
    for name, child, follows, options in followers:
        made.add_joint(name, "revolute", "world", child, follows=follows, **options)
    return made


STOP = np.arctan2(20, 30) - np.arcsin(2 / np.hypot(30, 20))


def stopped_at(assembly):
    found = chasles.cad.check(assembly, pairs=False, least_seconds=0)
    stop = found.joints[0].stops[1]
    assert len(found.joints) == 1 and stop.pair == ("leaf", "stop")
    return stop.clear_until


@pytest.mark.parametrize(
    "follows, message",
    [
        ("motor", "joint 'leaf': follows 'motor', which is no joint; the joints are lead, leaf"),
        ("leaf", "joint 'leaf': follows itself: leaf -> leaf"),
        ("weld", "follows 'weld', which is fixed and has no value"),
    ],
)
def test_what_follows_nothing_is_refused(follows, message):
    for others in ([], ["lead"]):  # also where no other joint moves
        assembly = hinge(("leaf", "leaf", (follows, 1.0, 0.0), {}))
        assembly.joints = [joint for joint in assembly.joints if joint.name != "lead"] + assembly.joints[: len(others)]
        if follows == "weld":
            assembly.add_joint("weld", "fixed", "world", "stop")
        for ask in (lambda a: chasles.cad.check(a), lambda a: a.robot()):
            with pytest.raises(chasles.InvalidInput, match=message.split(";")[0]):
                ask(assembly)


def test_circles_of_followers_are_refused():
    assembly = hinge(("leaf", "leaf", ("other", 1.0, 0.0), {}), ("other", "stop", ("leaf", 1.0, 0.0), {}))
    with pytest.raises(chasles.InvalidInput, match="joint 'other': follows itself: leaf -> other -> leaf"):
        chasles.cad.check(assembly)


@pytest.mark.parametrize("follows", ["lead", ("lead", 1.0), ("lead", 1.0, np.inf), (1, 2.0, 3.0)])
def test_what_is_no_follower_is_refused(follows):
    with pytest.raises(chasles.InvalidInput, match="joint 'leaf': follows: must be the name of a joint"):
        hinge(("leaf", "leaf", follows, {}))


def test_a_part_turns_and_slides_by_an_assembly_of_its_own():
    pin = Node("arm", children=[Node("pin", shape=cs.box(4, 1, 1))])
    made = Assembly(Node("model", children=[pin, Node("stop", shape=cs.box(1, 1, 1, (0, 0, 9)))]), deflection=0.01)
    made.add_joint("slide", "prismatic", "world", "arm", lower=0, upper=20)
    with pytest.raises(chasles.InvalidInput, match="another joint moves 'arm' already; .* one joint moves 'arm', the other one 'arm/pin'"):
        made.add_joint("turn", "revolute", "world", "arm")
    made.add_joint("turn", "revolute", "arm", "arm/pin", lower=-3, upper=3)
    robot = made.robot()
    row = made.rest
    row[[robot.variables.index("slide"), robot.variables.index("turn")]] = 5.0, np.pi / 2
    assert made.poses(robot, row)["arm/pin"] == pytest.approx(cs.matrix((0, 0, 5), (0, 0, 1), 90), abs=1e-12)


def test_a_joint_of_no_part_is_refused_where_nothing_moves():
    assembly = cs.assembly(a=cs.box(1, 1, 1))
    assembly.add_joint("weld", "fixed", "world", "b")
    with pytest.raises(chasles.InvalidInput, match="'b' is no part of the assembly, and carries none"):
        chasles.cad.check(assembly)


def test_a_follower_of_a_follower_moves():
    chain = cs.assembly(
        leaf=cs.box(40, 2, 10),
        stop=cs.box(10, 5, 10, (20, 20, 0)),
        block=cs.box(1, 1, 1, (0, 0, 90)),
        mid=cs.box(1, 1, 1, (0, 0, -90)),
    )
    chain.add_joint("leaf", "revolute", "world", "leaf", follows=("mid", 0.5, 0.0))
    chain.add_joint("mid", "revolute", "world", "mid", follows=("lead", 2.0, 0.0))
    chain.add_joint("lead", "prismatic", "world", "block", lower=0, upper=1)
    assert stopped_at(chain) == pytest.approx(STOP, abs=1e-6)


def test_a_follower_is_mounted_where_its_leader_puts_it():
    wrong = hinge(("leaf", "leaf", ("lead", 1.0, 0.25), {}))
    for ask in (lambda a: chasles.cad.check(a), lambda a: a.robot()):
        with pytest.raises(chasles.InvalidInput, match="joint 'leaf': value: is mounted at 0, but follows 'lead'.* 0.25 there"):
            ask(wrong)
    right = hinge(("leaf", "leaf", ("lead", 1.0, 0.25), dict(value=0.25)))
    poses = right.poses(right.robot(), right.rest)
    assert all(np.abs(poses[name] - part.place).max() < 1e-12 for name, part in right.parts.items())
    assert stopped_at(right) == pytest.approx(STOP, abs=1e-6)  # the mounted leaf is at 0 of its way


@pytest.mark.parametrize(
    "factor, limits, ends", [(1.0, (-0.5, 0.1), (0.0, 0.1)), (-2.0, (-0.5, 0.1), (0.0, 0.25)), (0.0, (-1, 1), (0.0, 0.3))]
)
def test_limits_of_followers_limit_their_leader(factor, limits, ends):
    assembly = hinge(("leaf", "leaf", ("lead", factor, 0.0), dict(lower=limits[0], upper=limits[1])), upper=0.3)
    joint = chasles.cad.check(assembly, least_seconds=0).joints[0]
    assert (joint.lower, joint.upper) == pytest.approx(ends)
    assert np.ravel(assembly.robot().limits) == pytest.approx(ends)
    assert joint.verdict == "clear" and joint.clear == pytest.approx(list(ends))


def test_a_follower_beyond_its_limits_is_refused():
    with pytest.raises(chasles.InvalidInput, match="joint 'leaf': value: is mounted at 0.5, outside of 0 to 0.1"):
        hinge(("leaf", "leaf", ("lead", 1.0, 0.5), dict(value=0.5, lower=0, upper=0.1)))
