# %% [markdown]
# # A batch and a plot
# A parcel moves through a gap between two walls, with a different offset and turn each time. When does it first touch?
# Pass a file name to save the plot.

# %%
import sys

import numpy as np

import chasles

vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) - 0.5
faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
parcel = chasles.Polyhedron(vertices, faces)
GAP = 1.2
wall = vertices * [0.2, 3, 3]
walls = chasles.Polyhedron(
    np.concatenate([wall + [0, 1.5 + GAP / 2, 0], wall - [0, 1.5 + GAP / 2, 0]]), np.concatenate([faces, faces + 8])
)

# %% [markdown]
# ## Ten thousand motions
# Each motion goes straight through the gap, at an offset from its middle, and turns about z by an angle.

# %%
COUNT = 10_000
random = np.random.default_rng(7)
offsets, turns = random.uniform(-0.2, 0.2, COUNT), random.uniform(-0.6, 0.6, COUNT)
starts, goals = np.zeros((2, COUNT, 7))
starts[:, 0], starts[:, 1], starts[:, 3] = -2, offsets, 1
goals[:, 0], goals[:, 1], goals[:, 3], goals[:, 6] = 2, offsets, np.cos(turns / 2), np.sin(turns / 2)
table = chasles.first_contact_batch(parcel, walls, starts, goals)
touched = table["verdict"] == "contact"
first, last = np.nanmin(table["time"]), np.nanmax(table["time"])
print(f"{touched.sum()} of {COUNT} touch; first contacts from {first:.3f} to {last:.3f}")
assert touched.any() and not touched.all() and table["certain"].all()

# %% [markdown]
# ## The plot

# %%
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.scatter(offsets[~touched], turns[~touched], s=2, color="lightgrey", label="clear")
points = left.scatter(offsets[touched], turns[touched], s=2, c=table["time"][touched])
figure.colorbar(points, ax=left, label="time of the first contact")
left.set(xlabel="offset from the middle", ylabel="turn, rad")
left.legend(loc="upper right")
right.hist(table["time"][touched], bins=60)
right.set(xlabel="time of the first contact", ylabel="motions")
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=120)
