# %% [markdown]
# # Push a path out of contact
# A Panda is to swing from one side to the other, and a pole is in its way: the straight path goes through it. The gradient of
# the least distance by each joint of each knot pushes the path out, until `first_contact` proves it clear. Pass a file name
# to save the picture. The example needs the packages `matplotlib` and `example_robot_data`, which has the robot.

# %%
import importlib.metadata
import pathlib
import sys

import numpy as np

import chasles

files = importlib.metadata.files("example_robot_data") or []
urdf = next(pathlib.Path(str(f.locate())).resolve() for f in files if f.name == "panda.urdf")
robot = chasles.Robot.load(urdf, srdf=next(urdf.parents[1].glob("srdf/panda.srdf")))
RADIUS, POLE = 0.06, [0.45, 0.0, 0.6, 1, 0, 0, 0]

# %% [markdown]
# ## A clearance that goes below 0
# In contact the least distance is 0, whatever the path. But the distance of a round body is that of its axis, less its
# radius, and a thin pole has the same gradient. So the distance to a pole of a millimetre, less the rest of the radius, tells
# how deep a link is in the pole.

# %%
THIN = 0.001


def checker_with(radius: float) -> chasles.RobotChecker:
    scene = chasles.Scene()
    scene.add("pole", chasles.capsule(radius, 1.2), chasles.Motion.at_rest(POLE))
    return chasles.RobotChecker(robot, scene)


thin, true = checker_with(THIN), checker_with(RADIUS)

# %% [markdown]
# ## The path that is in contact

# %%
start, goal = robot.neutral(), robot.neutral()
start[:7] = [-0.9, 0.5, 0, -1.9, 0, 2.3, 0.8]
goal[:7] = [0.9, 0.5, 0, -1.9, 0, 2.3, 0.8]
first = np.linspace(start, goal, 9)
print("before:", true.first_contact_on_path(first))
assert true.first_contact_on_path(first).verdict == "contact"
