# %% [markdown]
# # What a controller makes of a trajectory
# A message of ROS has points with velocities. Straight from point to point the arm is clear of the table, and so are all points. The
# controller moves along cubics through them, and these swing through the table. No ROS is needed here.

# %%
import pathlib
import sys

import numpy as np

import chasles.ros

robot = chasles.Robot.load(pathlib.Path(__file__).parents[1] / "robot" / "arm.urdf")
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
scene = chasles.Scene()
scene.add("table", chasles.Polyhedron(corners * [0.6, 1.2, 0.03], faces), [0.45, -0.6, 0.3, 1, 0, 0, 0])

message = {
    "joint_names": ["waist", "elbow", "wrist", "left"],
    "points": [
        {"positions": [-0.6, 0.45, 0.0, 0.02], "velocities": [0.4, 0.6, 0.0, 0.0], "time_from_start": {"sec": 2, "nanosec": 0}},
        {"positions": [0.6, 0.45, 1.5, 0.02], "velocities": [0.4, -0.6, 0.0, 0.0], "time_from_start": {"sec": 4, "nanosec": 0}},
    ],
}
present = np.array([-1.2, -0.3, 0.0, 0.02])  # the robot rests here before

# %% [markdown]
# ## From point to point

# %%
points = [present, *(point["positions"] for point in message["points"])]
straight = robot.first_contact_on_path(points, [0, 2, 4], scene=scene)
print("straight: ", straight)
assert straight.verdict == "clear"

# %% [markdown]
# ## What moves

# %%
path = chasles.ros.joint_path(message, robot, start=present)
found = robot.first_contact_on_path(path, scene=scene)
print("the spline:", found)
assert found.verdict == "contact" and found.certain and "table" in found.pair
print(f"{found.pair[0]} meets the {found.pair[1]} {found.time:.4f} s after the start, at {found.contacts[0].point.round(3)}")

# %% [markdown]
# ## The page

# %%
page = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "trajectory.html").with_suffix(".html")
print("open", chasles.write_robot_page(robot, path, page, scene=scene, title="What a controller makes of a trajectory"))
