# %% [markdown]
# # A B-spline past a thin plate
# An arm follows a B-spline, as Drake's trajectory optimisation makes them. Drake's distances at samples of it are above 0, and between
# two of them the arm goes through a thin plate. It needs the package `drake`.

# %%
import pathlib
import sys

import numpy as np
from pydrake.geometry import Box, Capsule
from pydrake.math import BsplineBasis, KnotVectorType, RigidTransform, RollPitchYaw
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint
from pydrake.systems.framework import DiagramBuilder
from pydrake.trajectories import BsplineTrajectory

import chasles.drake

builder = DiagramBuilder()
plant, scene_graph = AddMultibodyPlantSceneGraph(builder, 0.0)
along, friction = RigidTransform(RollPitchYaw(0, np.pi / 2, 0), [0.25, 0, 0]), CoulombFriction(1, 1)
frame = plant.world_frame()
for name, axis in (("shoulder", [0, 0, 1]), ("elbow", [0, 1, 0])):
    body = plant.AddRigidBody(f"{name} link")
    plant.RegisterCollisionGeometry(body, along, Capsule(0.03, 0.4), "bar", friction)
    plant.AddJoint(RevoluteJoint(name, frame, body.body_frame(), axis, -2, 2))
    frame = plant.AddFrame(FixedOffsetFrame(f"{name} end", body.body_frame(), RigidTransform([0.55, 0, 0])))
plate = RigidTransform(RollPitchYaw(0, 0, 0.665), [0.9 * np.cos(0.665), 0.9 * np.sin(0.665), 0])
plant.RegisterCollisionGeometry(plant.world_body(), plate, Box(0.2, 0.001, 0.2), "plate", friction)
plant.Finalize()
diagram = builder.Build()

basis = BsplineBasis(4, 6, KnotVectorType.kClampedUniform, 0.0, 2.0)  # cubic
points = [
    np.array([[shoulder], [elbow]]) for shoulder, elbow in ((-0.6, 0.1), (-0.5, 0), (0.2, -0.1), (1, 0), (1.7, 0.1), (1.8, 0))
]
trajectory = BsplineTrajectory(basis, points)

# %% [markdown]
# ## Samples

# %%
context = diagram.CreateDefaultContext()
plant_context = plant.GetMyContextFromRoot(context)


def distance_at(time: float) -> float:
    """The least distance of Drake at a time of the trajectory."""
    plant.SetPositions(plant_context, trajectory.value(time).ravel())
    query = plant.get_geometry_query_input_port().Eval(plant_context)
    return min(pair.distance for pair in query.ComputeSignedDistancePairwiseClosestPoints())


samples = np.linspace(0, 2, 21)
least = min(distance_at(time) for time in samples)
print(f"Drake's least distance at {len(samples)} samples: {1000 * least:.2f} mm")
assert least > 0

# %% [markdown]
# ## The proof

# %%
robot = chasles.drake.robot(plant, scene_graph)
path = chasles.drake.joint_path(trajectory, robot, plant)
found = robot.first_contact_on_path(path)
print(found)
assert found.verdict == "contact" and found.certain and found.pair == ("elbow link/bar", "world/plate")
print(f"Drake's distance there: {distance_at(found.time):.1e} m")

higher = BsplineTrajectory(basis, [point + [[0], [-0.7 * (0 < i < 5)]] for i, point in enumerate(points)])
path_over = chasles.drake.joint_path(higher, robot, plant)
near = chasles.RobotChecker(robot).least_distance_on_path(path_over)
print(f"with a higher elbow: never nearer than {1000 * near.distance:.2f} mm, at {near.time:.3f} s")
assert near.distance > 0

# %% [markdown]
# ## The page

# %%
page = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "trajectory.html").with_suffix(".html")
print("open", chasles.write_robot_page(robot, path, page, title="A B-spline past a thin plate"))
