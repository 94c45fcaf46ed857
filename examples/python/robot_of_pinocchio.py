# %% [markdown]
# # Configurations of Pinocchio
# Pinocchio and Chasles read the same URDF file, but order the numbers of a configuration in different ways. Pinocchio
# sorts joints by its own rules, and gives a continuous joint two numbers: cosine and sine. This example maps one to the
# other and asks for a contact. It needs the package `pin`.

# %%
import math
import pathlib

import numpy as np
import pinocchio

import chasles

file = pathlib.Path(__file__).parents[1] / "robot" / "arm.urdf"
robot = chasles.Robot.load(file)
model = pinocchio.buildModelFromUrdf(str(file))
print("Pinocchio:", [(name, index, size) for name, index, size in zip(model.names, model.idx_qs, model.nqs) if size])
print("Chasles:", robot.variables)

# %% [markdown]
# ## The map, in both directions
# A joint that mimics another one has a number in Pinocchio's model and none in Chasles. Chasles moves it along; for
# Pinocchio its number is filled in.

# %%
MIMICS = {"right": ("left", 1.0, 0.0)}  # joint: the one that it follows, multiplier, offset; as in the URDF file


def from_pinocchio(q: np.ndarray) -> np.ndarray:
    """A configuration of Chasles, (variables,), from one of Pinocchio, (nq,)."""
    values = robot.neutral()
    for i, name in enumerate(robot.variables):
        joint = model.getJointId(name)
        numbers = q[model.idx_qs[joint] :][: model.nqs[joint]]
        values[i] = math.atan2(numbers[1], numbers[0]) if len(numbers) == 2 else numbers[0]
    return values


def to_pinocchio(values: np.ndarray) -> np.ndarray:
    """A configuration of Pinocchio, (nq,), from one of Chasles, (variables,)."""
    by_name = dict(zip(robot.variables, values))
    by_name |= {name: factor * by_name[other] + offset for name, (other, factor, offset) in MIMICS.items()}
    q = pinocchio.neutral(model)
    for joint in range(1, model.njoints):
        value, first = by_name[model.names[joint]], model.idx_qs[joint]
        q[first : first + model.nqs[joint]] = [math.cos(value), math.sin(value)] if model.nqs[joint] == 2 else value
    return q


# %% [markdown]
# ## Both agree where the links are

# %%
random = np.random.default_rng(1)
data = model.createData()
for _ in range(100):
    values = random.uniform(*np.clip(robot.limits.T, -math.pi, math.pi))
    q = to_pinocchio(values)
    np.testing.assert_allclose(from_pinocchio(q), values, atol=1e-15)
    pinocchio.framesForwardKinematics(model, data, q)
    for link, pose in robot.link_poses(values).items():
        np.testing.assert_allclose(pose, data.oMf[model.getFrameId(link)].homogeneous, atol=1e-14)
print("100 configurations agree in the poses of all links")

# %% [markdown]
# ## A contact along an edge
# The straight edge of Chasles is that of `pinocchio.interpolate`: the wrist goes the shorter way round. The answer names
# the pair, the time and the configuration, here in the order of Pinocchio.

# %%
box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
scene = chasles.Scene()
scene.add("table", chasles.Polyhedron(0.5 * box, faces), [0.45, 0.1, -0.1, 1, 0, 0, 0])

start, goal = (to_pinocchio(np.array(values)) for values in ([-1, -0.5, 3, 0.03], [0.5, 1.2, -3, 0.01]))
found = robot.first_contact(from_pinocchio(start), from_pinocchio(goal), scene=scene)
print(found)
assert found.verdict == "contact" and found.certain
at_contact = pinocchio.interpolate(model, start, goal, found.time)
np.testing.assert_allclose(to_pinocchio(found.configuration), at_contact, atol=1e-12)
print(f"{found.pair[0]} meets the {found.pair[1]} at q = {at_contact.round(6)}")
