# %% [markdown]
# # Two arms hand over a part
# A left arm takes a bar from its place, hands it over to a right arm, and the right arm puts it down. Each arm has a path with
# times of its own. One question is about both arms and the bar, wherever it is. Pass a file name to save the picture, which needs
# the package `matplotlib`.

# %%
import sys

import numpy as np

import chasles

UPPER, LOWER, HAND = 0.5, 0.45, 0.15  # lengths from joint to joint, and to the middle of the bar


def box(x: float, y: float, z: float) -> chasles.Polyhedron:
    corners = (np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]) - 0.5) * [x, y, z]
    return chasles.Polyhedron(
        corners, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    )


def bar(name: str, length: float) -> dict:
    shape = {"shape": box(length, 0.06, 0.06), "origin": [length / 2, 0, 0, 1, 0, 0, 0]}
    return {"name": name, "collisions": [shape]}


def joint(name: str, parent: str, child: str, along: float) -> dict:
    return {
        "name": name, "type": "revolute", "parent": parent, "child": child, "origin": [along, 0, 0, 1, 0, 0, 0],
        "axis": [0, 0, 1], "lower": -np.pi, "upper": np.pi,
    }  # fmt: skip


def arm() -> chasles.Robot:
    return chasles.Robot(
        name="arm",
        links=[
            {"name": "base", "collisions": [box(0.1, 0.1, 0.1)]},
            bar("upper", UPPER),
            bar("lower", LOWER),
            bar("hand", 0.1),
        ],
        joints=[
            joint("shoulder", "base", "upper", 0),
            joint("elbow", "upper", "lower", UPPER),
            joint("wrist", "lower", "hand", LOWER),
        ],
    )


def reach(x: float, y: float, angle: float, bend: float) -> list[float]:
    """The joints that bring the middle of a held bar to (x, y) in the frame of the base, the hand turned by an angle."""
    x, y = x - HAND * np.cos(angle), y - HAND * np.sin(angle)
    elbow = bend * np.arccos((x * x + y * y - UPPER**2 - LOWER**2) / (2 * UPPER * LOWER))
    shoulder = np.arctan2(y, x) - np.arctan2(LOWER * np.sin(elbow), UPPER + LOWER * np.cos(elbow))
    return [shoulder, elbow, angle - shoulder - elbow]


# %% [markdown]
# ## The cell
# The right arm looks back. The bar lies on the root link of the cell, "world", until the left hand takes it.

# %%
left, right = arm(), arm()
right.set_base([1.6, 0, 0.01, 0, 0, 0, 1])
cell = chasles.Robot.together({"left": left, "right": right})
cell.attach("bar", "world", box(0.16, 0.04, 0.04), [0, 0.75, 0, 0.5**0.5, 0, 0, 0.5**0.5])
scene = chasles.Scene()
scene.add("post", chasles.capsule(0.05, 0.4), [0.8, -0.35, 0, 1, 0, 0, 0])

# %% [markdown]
# ## Two clocks
# The left arm takes the bar at 1 and is at the middle at 3. The right arm is there at 3, too, and puts the bar down at 5.

# %%
MIDDLE = 0.8, 0.3
take, give = reach(0, 0.75, np.pi / 2, 1), reach(*MIDDLE, 0, 1)
aside = reach(0.3, -0.5, -np.pi / 2, 1)
catch, put = reach(1.6 - MIDDLE[0], -MIDDLE[1], 0, -1), reach(0, -0.75, -np.pi / 2, -1)  # the right arm is turned by pi
away = reach(0.85, -0.3, -np.pi / 2, -1)
of_left = chasles.JointPath.straight(left, [aside, take, give, aside], [0, 1, 3, 4.4])
of_right = chasles.JointPath.straight(right, [away, catch, put, away], [1.7, 3, 5, 6])
path = chasles.JointPath.together(cell, {"left": of_left, "right": of_right})
handovers = [(1, "bar", "left/hand"), (3, "bar", "right/hand"), (5, "bar", "world")]
print("times of the cell:", path.times)

# %% [markdown]
# ## One question
# Nothing touches anything but the bar its carriers: proven for all times.

# %%
found = cell.first_contact_on_path(path, scene=scene, handovers=handovers)
print(found)
assert found.verdict == "clear" and found.certain
profile = cell.profile(path, scene=scene, handovers=handovers)
print("the least distance is", profile.lower.min())

# %% [markdown]
# ## A clock that is wrong
# If the right arm starts a second late, its hand is in the way of the left one.

# %%
late = chasles.JointPath.straight(right, [away, catch, put, away], [2.7, 4, 5, 6])
mixed = chasles.JointPath.together(cell, {"left": of_left, "right": late})
wrong = cell.first_contact_on_path(mixed, scene=scene, handovers=handovers)
print("late:", wrong)
assert wrong.verdict == "contact" and wrong.certain and wrong.time < 3

# %% [markdown]
# ## The picture
# The cell from above at five times, and the distance of the nearest pair over time.

# %%
if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplot_mosaic("abcde;fffff", figsize=(13, 5.5), height_ratios=(1.6, 1))
    def fill(axis, pose: np.ndarray, box_2d: tuple[float, float, float], colour: str) -> None:
        """From x to x + length, across by width."""
        x, length, width = box_2d
        corners = np.array([[x, -width / 2], [x + length, -width / 2], [x + length, width / 2], [x, width / 2]])
        axis.fill(*(corners @ pose[:2, :2].T + pose[:2, 3]).T, facecolor=colour, edgecolor="0.3")

    def place_of_bar(time: float) -> np.ndarray:
        carried = [("world", 0), *((link, stamp) for stamp, _, link in handovers if stamp <= time)]
        place = cell.link_pose("world", path.at(0)) @ START
        for (before, _), (link, stamp) in zip(carried, carried[1:]):
            at = path.at(stamp)
            place = np.linalg.inv(cell.link_pose(link, at)) @ cell.link_pose(before, at) @ place
        return cell.link_pose(carried[-1][0], path.at(time)) @ place

    START = np.eye(4)
    START[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    START[1, 3] = 0.75

    def draw(axis, time: float) -> None:
        poses = cell.link_poses(path.at(time))
        for robot, colour in (("left", "tab:blue"), ("right", "tab:orange")):
            for name, length in (("upper", UPPER), ("lower", LOWER), ("hand", 0.1)):
                fill(axis, poses[f"{robot}/{name}"], (0, length, 0.06), colour)
        fill(axis, place_of_bar(time), (-0.08, 0.16, 0.04), "tab:red")
        axis.add_patch(plt.Circle((0.8, -0.35), 0.05, color="0.4"))
        axis.set(aspect="equal", xlim=(-0.75, 2.35), ylim=(-0.95, 1.15), title=f"time {time:g}", xticks=[], yticks=[])

    for label, time in zip("abcde", (0.5, 2.0, 3.0, 4.2, 5.5)):
        draw(axes[label], time)
    axes["f"].fill_between(profile.times, profile.lower, profile.upper, step="post", color="tab:blue")
    for time, _, link in handovers:
        axes["f"].axvline(time, color="tab:red", linewidth=1)
        axes["f"].text(time, axes["f"].get_ylim()[1], f" {link}", va="top", color="tab:red")
    axes["f"].set(xlabel="time", ylabel="nearest pair [m]", ylim=(0, None))
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=120)
