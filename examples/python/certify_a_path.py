# %% [markdown]
# # Certify a path of poses
# A planner returns poses, and the robot moves between them. If the robot moves by screws, the verdict "clear" is a proof
# for the whole path, not only for samples.

# %%
import numpy as np

import chasles

vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
parcel = chasles.Polyhedron(vertices - 0.5, faces)
pillar = chasles.Polyhedron((vertices - 0.5) * [1, 1, 8], faces)

# %% [markdown]
# ## A path around the pillar
# Poses are x y z qw qx qy qz. Here the parcel moves on a circle without rotation.


# %%
def around(radius: float, poses: int) -> np.ndarray:
    angles = np.linspace(0, np.pi, poses)
    path = np.zeros((poses, 7))
    path[:, 0], path[:, 1], path[:, 3] = radius * np.cos(angles), radius * np.sin(angles), 1
    return path


wide = chasles.first_contact_on_path(parcel, pillar, around(1.6, 24))
print(wide)
assert wide.verdict == chasles.Verdict.clear

# %% [markdown]
# ## A tight path fails
# Each pose of the next path is free of collisions. The motion between two of these poses is not.

# %%
tight = around(1.5, 4)
for pose in tight:
    assert chasles.first_contact(parcel, pillar, pose, pose).verdict == "clear"
found = chasles.first_contact_on_path(parcel, pillar, tight, find="first_with_all_contacts")
print(found)
assert found.verdict == chasles.Verdict.contact
print(f"segment {found.segment}, at {found.time:.6f} of it, at the pose\n{found.pose}")
for contact in found.contacts:
    print("  ", contact)

# %% [markdown]
# ## The velocities that the contacts allow
# There is one row per contact. `rows @ (v, w) >= 0` are the velocities that close no gap. The motion itself closes all
# gaps.

# %%
rows = chasles.constraint_rows(found.contacts)
step = (tight[found.segment + 1] - tight[found.segment])[:3]
rates = rows @ np.concatenate([step, np.zeros(3)])
print("rates of the gaps:", rates)
assert (rates < 0).all()

# %% [markdown]
# ## Many paths at once

# %%
radii = np.linspace(1.3, 1.7, 41)
table = chasles.path_is_clear_batch(parcel, pillar, np.stack([around(r, 24) for r in radii]))
clear = table["verdict"] == "clear"
print(f"{clear.sum()} of {len(radii)} are clear, from a radius of {radii[clear].min():.3f}")
assert clear.any() and not clear.all()
