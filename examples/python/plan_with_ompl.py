# %% [markdown]
# # Plan with OMPL, and prove every edge
# OMPL's own validator tests motions at samples, and may step over thin obstacles. The validator of Chasles proves each
# edge of the planner's tree for the whole motion. This example needs the package `ompl` (2.0 or later).

# %%
import json
import pathlib
import sys

import numpy as np
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

import chasles
import chasles.ompl

ou.setLogLevel(ou.LogLevel.LOG_WARN)
ou.RNG.setSeed(1)
folder = pathlib.Path(__file__).parents[1] / "robot"

# %% [markdown]
# ## The robot and its world
# `arm.urdf` has a waist, an elbow, a wrist without limits and a gripper. `cell.json` has a table and a shelf.

# %%
robot = chasles.Robot.load(folder / "arm.urdf")
scene = chasles.Scene()
for body in json.loads((folder / "cell.json").read_text("utf-8"))["bodies"]:
    mesh = chasles.load(folder / body["mesh"])
    shape = chasles.Polyhedron(body["scale"] * mesh.vertices, mesh.faces)
    scene.add(body["name"], shape, [*body["pose"], 1, 0, 0, 0])
checker = chasles.RobotChecker(robot, scene, margin=0.005)

# %% [markdown]
# ## The space of the planner
# Joints with limits are numbers of a RealVectorStateSpace. The wrist goes the shorter way round, so it needs an
# SO2StateSpace. The gripper stays as open as it is: it is no variable of the space. A validator whose space does not fit
# the robot raises `chasles.InvalidInput`.

# %%
planned = ["waist", "elbow", "wrist"]
bounds = ob.RealVectorBounds(2)
for i, (lower, upper) in enumerate(robot.limits[:2]):
    bounds.setLow(i, lower)
    bounds.setHigh(i, upper)
joints = ob.RealVectorStateSpace(2)
joints.setBounds(bounds)
space = ob.CompoundStateSpace()
space.addSubspace(joints, 1)
space.addSubspace(ob.SO2StateSpace(), 0.2)

states = chasles.ompl.StateMap(robot, planned, others=[0, 0, 0, 0.03])
information = ob.SpaceInformation(space)
information.setStateValidityChecker(chasles.ompl.RobotValidityChecker(information, checker, states))
validator = chasles.ompl.RobotMotionValidator(information, checker, states)
information.setMotionValidator(validator)

# %% [markdown]
# ## From one side of the table to the other


# %%
def state_of(waist: float, elbow: float, wrist: float) -> ob.State:
    state = information.allocState()
    state[0][0], state[0][1], state[1].value = waist, elbow, wrist
    return state


start, goal = state_of(-1.2, 0.9, 0), state_of(2.2, 0.9, 3)
setup = og.SimpleSetup(information)
setup.setStartAndGoalStates(start, goal)
setup.setPlanner(og.RRTConnect(information))
direct = checker.first_contact(states(space, start), states(space, goal))
print("straight there:", direct)
assert direct.verdict == "contact"

assert setup.solve(30.0)
path = states.configurations(space, setup.getSolutionPath())
print(f"a path of {len(path)} states, after {validator.getCheckedMotionCount()} edges that were proven or refused")

# %% [markdown]
# ## The proof, once more
# Every edge of the path is proven by a call that knows nothing of the planner. Simplified paths consist of edges that
# the validator has proven, too.

# %%
setup.simplifySolution()
short = states.configurations(space, setup.getSolutionPath())
for edges in (path, short):
    table = chasles.first_contacts_on_edges(checker, edges[:-1], edges[1:])
    assert (table["verdict"] == "clear").all() and (table["clear_until"] == 1).all()
print(f"simplified: {len(short)} states, {np.abs(np.diff(short, axis=0)).sum():.2f} rad in all; every edge is proven")

# %% [markdown]
# ## A page to look at
# The page shows the way of the robot. It is one file and needs no network.

# %%
page = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "plan").with_suffix(".html")
try:
    print("written:", chasles.write_robot_page(robot, short, page, scene=scene, title="A proven plan"))
except chasles.InvalidInput as error:  # the package was built without the viewer
    print(error)
