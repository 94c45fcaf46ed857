"""Plants and trajectories that the tests of chasles.drake share. They are written here; none is Drake's own."""

import numpy as np
from pydrake.common import MemoryFile
from pydrake.geometry import (
    Box,
    Capsule,
    Convex,
    Cylinder,
    Ellipsoid,
    HalfSpace,
    InMemoryMesh,
    Mesh,
    MeshSource,
    Sphere,
)
from pydrake.math import BsplineBasis, KnotVectorType, RigidTransform, RollPitchYaw
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction
from pydrake.multibody.tree import (
    BallRpyJoint,
    FixedOffsetFrame,
    PlanarJoint,
    PrismaticJoint,
    QuaternionFloatingJoint,
    RevoluteJoint,
    RpyFloatingJoint,
    ScrewJoint,
    SpatialInertia,
    UnitInertia,
    UniversalJoint,
    WeldJoint,
)
from pydrake.systems.framework import DiagramBuilder
from pydrake.trajectories import BezierCurve, BsplineTrajectory, CompositeTrajectory, PiecewisePolynomial

TOOTH = "v 0 0 0\nv .4 0 0\nv 0 .3 0\nv 0 0 .5\nv .1 .1 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5\n"
KINDS = {
    "revolute": lambda random, name, a, b: RevoluteJoint(name, a, b, unit(random), -1, 2),
    "prismatic": lambda random, name, a, b: PrismaticJoint(name, a, b, unit(random)),
    "screw": lambda random, name, a, b: ScrewJoint(name, a, b, unit(random), 0.3, 0.0),
    "universal": lambda random, name, a, b: UniversalJoint(name, a, b),
    "planar": lambda random, name, a, b: PlanarJoint(name, a, b, [0, 0, 0]),
    "ball": lambda random, name, a, b: BallRpyJoint(name, a, b),
    "rpy": lambda random, name, a, b: RpyFloatingJoint(name, a, b),
    "weld": lambda random, name, a, b: WeldJoint(name, a, b, pose(random)),
    "quaternion": lambda random, name, a, b: QuaternionFloatingJoint(name, a, b),
}


def unit(random):
    way = random.normal(size=3)
    return way / np.linalg.norm(way)


def pose(random, reach=0.4):
    return RigidTransform(RollPitchYaw(random.uniform(-3, 3, 3)), random.uniform(-reach, reach, 3))


def in_memory(text=TOOTH):
    return MeshSource(mesh=InMemoryMesh(mesh_file=MemoryFile(contents=text, extension=".obj", filename_hint="tooth.obj")))


def shapes():
    return [
        Box(0.2, 0.3, 0.5), Sphere(0.2), Capsule(0.1, 0.4), Cylinder(0.15, 0.3), Ellipsoid(0.1, 0.2, 0.3),
        Convex(in_memory(), 0.8), Mesh(in_memory(), np.array([1.0, 0.5, -0.7])),
    ]  # fmt: skip


class World:
    """A plant that is being built, and its diagram."""

    def __init__(self, name="plant"):
        self.builder = DiagramBuilder()
        self.plant, self.scene_graph = AddMultibodyPlantSceneGraph(self.builder, 0.0)
        self.plant.set_name(name)
        self.instance = self.plant.AddModelInstance("model")
        self.bodies = [self.plant.world_body()]

    def body(self, name, shape, where=None):
        body = self.plant.AddRigidBody(name, self.instance, SpatialInertia(1.0, [0, 0, 0], UnitInertia(1, 1, 1)))
        self.shape(body, shape, "shape", where)
        self.bodies.append(body)
        return body

    def shape(self, body, shape, name, where=None):
        where = RigidTransform() if where is None else where
        self.plant.RegisterCollisionGeometry(body, where, shape, name, CoulombFriction(1, 1))

    def frame(self, name, body, where):
        return self.plant.AddFrame(FixedOffsetFrame(name, body.body_frame(), where))

    def finish(self):
        self.plant.Finalize()
        self.diagram = self.builder.Build()
        self.context = self.diagram.CreateDefaultContext()
        self.plant_context = self.plant.GetMyContextFromRoot(self.context)
        return self

    def at(self, q):
        self.plant.SetPositions(self.plant_context, q)


def random_world(random, kinds, with_ground=True):
    """A tree of joints with offset frames and one shape each. Half-spaces and ellipsoids have few distances in Drake."""
    world, parts = World("many"), shapes()
    for number, kind in enumerate(kinds):
        body = world.body(f"{kind} {number}", parts[int(random.integers(len(parts)))], pose(random, 0.2))
        parent = world.bodies[int(random.integers(max(0, len(world.bodies) - 3), len(world.bodies) - 1))]
        frames = world.frame(f"f{number}", parent, pose(random)), world.frame(f"m{number}", body, pose(random, 0.2))
        world.plant.AddJoint(KINDS[kind](random, f"{kind} {number}", *frames))
    if with_ground:
        world.shape(world.plant.world_body(), HalfSpace(), "ground", RigidTransform(RollPitchYaw(0.1, 0.2, 0), [0, 0, -1.5]))
    return world.finish()


def trajectories(random, rows):
    """Of each kind that is read; values of about 1."""
    times, values = np.array([0.2, 1, 2.5, 3.1, 4]), random.uniform(-1, 1, (rows, 5))
    yield PiecewisePolynomial.CubicWithContinuousSecondDerivatives(times, values)
    yield PiecewisePolynomial.FirstOrderHold(times, values)
    yield PiecewisePolynomial.CubicShapePreserving(times, values)
    for degree, kind in ((3, KnotVectorType.kClampedUniform), (5, KnotVectorType.kUniform), (1, KnotVectorType.kClampedUniform)):
        points = [random.uniform(-1, 1, (rows, 1)) for _ in range(9)]
        yield BsplineTrajectory(BsplineBasis(degree + 1, 9, kind, 0.2, 3.3), points)
    yield BezierCurve(0.5, 2.5, values)
    yield CompositeTrajectory([BezierCurve(0.5, 2.5, values), BezierCurve(2.5, 3.5, values[:, ::-1])])
