# %% [markdown]
# # A gate before the actions of a policy
# A policy swings an arm of seven joints past a thin post. Each of its actions is free of collision, and the way between two
# of them is not. The gate proves the whole way before anything moves: it refuses the chunk, shortens it, or slows it down by
# the proven distance. Pass a file name to save the picture, which needs `matplotlib`.

# %%
import json
import sys

import numpy as np

import chasles
from chasles.policy import PolicyGate

LENGTHS, RADIUS = (0.16, 0.2, 0.2, 0.2, 0.2, 0.15, 0.08), 0.03  # from joint to joint, metres
links, joints, height = [{"name": "base", "collisions": [chasles.sphere(0.1)]}], [], 0.2
for i, length in enumerate(LENGTHS):
    bar = {"shape": chasles.capsule(RADIUS, length), "origin": [0, 0, length / 2, 1, 0, 0, 0]}
    links.append({"name": f"link{i + 1}", "collisions": [bar]})
    joints.append(
        {"name": f"joint{i + 1}", "type": "revolute", "parent": links[i]["name"], "child": links[i + 1]["name"],
         "origin": [0, 0, height, 1, 0, 0, 0], "axis": [0, i % 2, 1 - i % 2], "lower": -2.9, "upper": 2.9}
    )  # fmt: skip
    height = length
folding = [(links[i]["name"], links[i + 2]["name"]) for i in range(6)]
robot = chasles.Robot(name="arm", links=links, joints=joints, disabled_pairs=folding)

POST, THICK = [0.7, 0.0, 0.5, 1, 0, 0, 0], 0.004
scene = chasles.Scene()
scene.add("post", chasles.capsule(THICK, 0.6), POST)

# %% [markdown]
# ## What the policy wants
# Twelve actions at a low rate: 0.15 radians from one to the next.

# %%
present = np.array([-0.975, np.pi / 2 - 0.1, 0, 0.1, 0, 0, 0])
actions = np.tile(present, (12, 1))
actions[:, 0] += 0.15 * np.arange(1, 13)

checker = chasles.RobotChecker(robot, scene)
assert all(checker.is_clear(action) for action in actions), "as a check of each action says"

# %% [markdown]
# ## What the gate says
# The budget is generous here: the first call of a process takes longer than the others.

# %%
OPTIONS = {"margin": 0.002, "milliseconds": 100}
refused = PolicyGate(robot, scene, **OPTIONS)(present, actions)
print(json.dumps(refused.record(), indent=2))
assert refused.verdict == "refused" and refused.pair[1] == "post" and len(refused.actions) == 0

shortened = PolicyGate(robot, scene, mode="shorten", **OPTIONS)(present, actions)
assert shortened.verdict == "shortened" and len(shortened.actions) == int(refused.time)

FULL = 0.4
slowed = PolicyGate(robot, scene, mode="scale", full_speed_from=FULL, **OPTIONS)(present, actions)
print(
    f"{slowed.verdict}: {len(slowed.actions)} of 12 actions, at {slowed.speeds.round(3).tolist()} of full speed: {slowed.reason}"
)
assert 0 < slowed.speeds.min() < 1 and len(slowed.at_period(present, actions)) > len(slowed.actions)

# %% [markdown]
# ## The picture
# From above: the arm at each action, and the post between two of them. Beside it, the distance on the way to each action,
# and the speeds.

# %%
if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, (above, right) = plt.subplots(1, 2, figsize=(11, 4.5))
    for k, configuration in enumerate([present, *actions]):
        places = [robot.link_pose(link["name"], configuration)[:2, 3] for link in links]
        color = "tab:blue" if k <= len(shortened.actions) else "tab:red"
        above.plot(*np.array(places).T, color=color, alpha=0.5, linewidth=8, solid_capstyle="round")
    above.plot([], [], color="tab:blue", label="proven")
    above.plot([], [], color="tab:red", label="not sent")
    above.add_patch(plt.Circle(POST[:2], 3 * THICK, color="black", label="post (three times as thick)"))
    above.plot(*refused.place[:2], "x", color="black", label=f"contact at {refused.time:.3f}")
    above.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    above.legend(loc="center left", bbox_to_anchor=(1, 0.8))
    ways = zip([present, *actions[:-1]], actions)
    near = [checker.least_distance(*way).distance for way in ways]
    at = np.arange(12)
    right.step(at, near, where="mid", color="0.3", label="least distance on the way [m]")
    right.axhline(FULL, color="0.3", linestyle=":", label="full speed from here on [m]")
    right.step(at[: len(slowed.speeds)], slowed.speeds, where="mid", color="tab:green", label="part of full speed")
    right.set(xlabel="action", ylim=(0, 1.05))
    right.legend()
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=120)
