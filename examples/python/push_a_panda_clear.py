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
RADIUS, POLE = 0.06, [0.7, 0.0, 0.6, 1, 0, 0, 0]

# %% [markdown]
# ## A clearance that goes below 0
# In contact the least distance is 0, whatever the path. But the distance of a round body is that of its axis, less its
# radius, and a thin pole has the same gradient. So the distance to a pole of a millimetre, less the rest of the radius, tells
# how deep a link is in the pole.

# %%
THIN = 0.001


def checker_with(radius: float) -> chasles.RobotChecker:
    scene = chasles.Scene()
    scene.add("pole", chasles.capsule(radius, 1.2), POLE)
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

# %% [markdown]
# ## One row for each edge
# Each edge that is too near to something is one linear condition on its two knots: its gradient times the step is what it
# lacks. The least step that satisfies all of them is a problem of least squares.

# %%
MARGIN, ROOM = 0.02, 0.005  # wanted, and what an edge may have more before it counts


def clearance(near: chasles.RobotClearance) -> float:
    is_pole = near.pair is not None and near.pair[1] == "pole"
    return near.distance_upper - (RADIUS - THIN if is_pole else 0)


def rows(path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The gradients of the edges that are too near, (rows, knots * variables), and how much each lacks."""
    gradients, lacks = [], []
    for k in range(len(path) - 1):
        near = thin.least_distance(path[k], path[k + 1])
        if near.gradient is None or clearance(near) > MARGIN + ROOM:
            continue
        row = np.zeros(path.shape)
        row[k : k + 2] = near.gradient
        row[[0, -1]] = 0  # the ends stay
        gradients.append(row.ravel())
        lacks.append(max(0.0, MARGIN + ROOM - clearance(near)))
    return np.array(gradients), np.array(lacks)


path, history = first.copy(), []
for step in range(40):
    history.append(min(clearance(thin.least_distance(a, b)) for a, b in zip(path, path[1:])))
    if history[-1] >= MARGIN:
        break
    gradients, lacks = rows(path)
    change = np.linalg.lstsq(gradients, lacks, rcond=1e-3)[0].reshape(path.shape)
    path += change * min(1.0, 0.2 / np.abs(change).max())  # at most 0.2 radians

# %% [markdown]
# ## The proof
# The gradients are computed in double and prove nothing. This question does, for all pairs and all times.

# %%
after = true.first_contact_on_path(path)
print(f"after {len(history) - 1} steps: {after}, clearance from {history[0]:.4f} to {history[-1]:.4f}")
assert after.verdict == "clear" and after.certain
assert true.least_distance_on_path(path).distance > 0.9 * MARGIN

# %% [markdown]
# ## The picture
# The way of the hand from above before and after, and the clearance after each step.

# %%
if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (above, right) = plt.subplots(1, 2, figsize=(10, 4.5))
    for knots, label in ((first, "before"), (path, "after")):
        track = chasles.JointPath.straight(robot, knots)
        hand = [robot.link_pose("panda_hand", track.at(time))[:2, 3] for time in np.linspace(0, len(knots) - 1, 200)]
        above.plot(*np.array(hand).T, label=f"hand {label}")
    above.add_patch(plt.Circle(POLE[:2], RADIUS, color="0.6", label="pole"))
    above.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    above.legend(loc="center left", bbox_to_anchor=(1, 0.9))
    right.plot(np.array(history) * 1000, marker="o")
    right.axhline(0, color="0.6")
    right.set(xlabel="step", ylabel="clearance [mm]", xticks=range(len(history)))
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=120)
