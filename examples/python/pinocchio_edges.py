# %% [markdown]
# # An edge that samples call free
# A planner with Pinocchio looks at configurations along an edge. Here an arm sweeps over a thin rod between two of them. The
# same model is asked for a proof. It needs the packages `pin` and `coal`.

# %%
import pathlib
import sys

import coal
import numpy as np
import pinocchio as pin

import chasles.pinocchio

model, geometry = pin.Model(), pin.GeometryModel()
turn = pin.SE3(pin.utils.rotate("y", np.pi / 2), np.array([0.25, 0, 0]))  # a capsule lies along x


def add(parent: int, joint: pin.JointModel, place: list[float], name: str, shape: coal.CollisionGeometry) -> int:
    number = model.addJoint(parent, joint, pin.SE3(np.eye(3), np.array(place)), name)
    geometry.addGeometryObject(pin.GeometryObject(f"{name} bar", number, turn, shape))
    return number


base = add(0, pin.JointModelRZ(), [0, 0, 0.4], "base", coal.Capsule(0.04, 0.5))
shoulder = add(base, pin.JointModelRY(), [0.55, 0, 0], "shoulder", coal.Capsule(0.03, 0.45))
wrist = add(shoulder, pin.JointModelRUBX(), [0.5, 0, 0], "wrist", coal.Cylinder(0.02, 0.1))
geometry.addGeometryObject(
    pin.GeometryObject("rod", 0, pin.SE3(np.eye(3), np.array([0.7, 0.42, 0.3])), coal.Cylinder(0.0015, 0.6))
)
geometry.addGeometryObject(pin.GeometryObject("floor", 0, pin.SE3(np.eye(3), np.array([0.5, 0, -0.01])), coal.Box(1.2, 2, 0.02)))
geometry.addAllCollisionPairs()
for joint, parent in ((1, 0), (2, 1)):  # neighbours touch by design
    geometry.removeCollisionPair(pin.CollisionPair(parent, joint))

# %% [markdown]
# ## Samples

# %%
start, goal = np.array([-0.4, 0.1, 1, 0]), np.array([1.3, -0.2, 0, 1])
data, geometry_data = model.createData(), geometry.createData()
samples = 20
hits = sum(
    pin.computeCollisions(model, data, geometry, geometry_data, pin.interpolate(model, start, goal, time), True)
    for time in np.linspace(0, 1, samples)
)
print(f"{hits} of {samples} samples of Pinocchio are in collision")
assert hits == 0

# %% [markdown]
# ## The proof

# %%
robot = chasles.pinocchio.robot(model, geometry)
edge = chasles.pinocchio.configurations(model, [start, goal])
found = robot.first_contact(*edge)
print(found)
assert found.verdict == "contact" and found.certain and "rod" in found.pair

at_contact = pin.interpolate(model, start, goal, found.time)
pin.computeDistances(model, data, geometry, geometry_data, at_contact)
pair = pin.CollisionPair(*sorted(geometry.getGeometryId(name) for name in found.pair))
print(f"coal's distance there: {geometry_data.distanceResults[geometry.findCollisionPair(pair)].min_distance:.1e} m")

over = np.array([edge[0], [0.45, -0.8, 0.8], edge[1]])  # over the rod instead
path = chasles.JointPath.natural_spline(robot, [0, 1, 2], over)
assert robot.first_contact_on_path(path).verdict == "clear"
near = chasles.RobotChecker(robot).least_distance_on_path(path)
print(f"over the rod: clear, and never nearer than {1000 * near.distance:.2f} mm ({near.pair[0]}, {near.pair[1]})")

# %% [markdown]
# ## The page

# %%
page = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "edge.html").with_suffix(".html")
print("open", chasles.write_robot_page(robot, edge, page, title="An edge that samples call free"))
