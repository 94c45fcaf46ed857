"""The gate in worlds of boxes, balls and bars, hand and base included: FCL's discrete collision refutes nothing."""

import os

import numpy as np
import pytest
from arm_by_numpy import frames, samples
from seven_joints import LENGTHS, arm, chunk, clear_configuration, world

import chasles
from chasles.policy import PolicyGate

fcl = pytest.importorskip("fcl")

MARGIN = 0.005


def fcl_shape(body):
    """A ball, a capsule along z, or a hull."""
    vertices = body.vertices
    if len(vertices) == 1:
        return fcl.Sphere(body.radius)
    if len(vertices) == 2:
        return fcl.Capsule(body.radius, np.linalg.norm(vertices[1] - vertices[0]))
    model = fcl.BVHModel()
    faces = [[f[0], f[i], f[i + 1]] for f in body.faces for i in range(1, len(f) - 1)]
    model.beginModel(len(faces), len(vertices))
    model.addSubModel(vertices, np.array(faces))
    model.endModel()
    return model


class ByFcl:
    """All pairs of a link and a body, at a configuration, with the kinematics of arm_by_numpy.py."""

    def __init__(self, robot, scene):
        self.bodies = {}
        for name, shape, motion, _ in scene.__getstate__()[0]:
            at = motion.pose_at(0)
            self.bodies[name] = fcl.CollisionObject(fcl_shape(shape), fcl.Transform(at[:3, :3], at[:3, 3]))
        self.links = [
            (name, index, fcl_shape(shape), at)
            for index, name in enumerate([*(f"link{i + 1}" for i in range(7)), "hand"])
            for shape, at, _ in robot.collisions(name)
        ]

    def collides(self, configuration):
        places, rotations = frames(configuration)
        for name, index, shape, at in self.links:
            rotation, place = rotations[0, min(index, 6)], places[0, index]  # the hand turns with link7, from its end on
            link = fcl.CollisionObject(shape, fcl.Transform(rotation @ at[:3, :3], rotation @ at[:3, 3] + place))
            for body, other in self.bodies.items():
                if fcl.collide(link, other, fcl.CollisionRequest(), fcl.CollisionResult()):
                    return name, body
        return None


def test_fcl_finds_nothing_where_a_chunk_passed():
    """At least 1,000 poses of what passed; and where a chunk was stopped without a margin, FCL finds the pair soon after."""
    robot, random = arm(), np.random.default_rng(11)
    for first, second in robot.tested_pairs():
        robot.ignore(first, second)
    assert len(LENGTHS) == 7
    poses, found = 0, 0
    for _ in range(160 if os.environ.get("CHASLES_LONG") else 8):
        scene = world(random)
        by_fcl = ByFcl(robot, scene)
        gate = PolicyGate(robot, scene, mode="shorten", milliseconds=60_000)
        for _ in range(5):
            present = clear_configuration(robot, chasles.RobotChecker(robot, scene, margin=MARGIN), random)
            rows = np.vstack([present, chunk(robot, random, present)])
            decision = gate(rows[0], rows[1:])
            for at in samples(rows[: len(decision.actions) + 1], 2)[1]:
                assert by_fcl.collides(at) is None, (decision.record(), at)
                poses += 1
            if decision.verdict == "shortened":
                after = [np.interp(min(decision.time + 0.2, 50), np.arange(51), column) for column in rows.T]
                found += by_fcl.collides(after) is not None
    assert poses >= 1000 and found >= 10, (poses, found)
