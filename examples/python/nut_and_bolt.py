# %% [markdown]
# # A nut on a bolt
# A thread is a screw, and the motion between two poses is a screw too. The nut comes off only if it slides by one pitch
# per turn. This example generates the bodies; `chasles.load` reads bodies from files.

# %%
import math

import numpy as np

import chasles

PITCH, LENGTH, SEGMENTS = 2.0, 12.0, 48
BOLT_RADIUS, NUT_RADIUS, DEPTH = 7.9, 8.0, 1.0  # a clearance of 0.1


def thread(radius: float, begin: float, end: float) -> chasles.Polyhedron:
    """The flanks of a thread about z: a band of triangles, open at both ends."""
    angles = np.linspace(0, 2 * math.pi * (end - begin) / PITCH, round(SEGMENTS * (end - begin) / PITCH) + 1)
    rows = []
    for inset, rise in ((DEPTH, 0.0), (0.0, PITCH / 2), (DEPTH, PITCH)):
        r = radius - inset
        rows.append(
            np.column_stack([r * np.cos(angles), r * np.sin(angles), begin + PITCH * angles / (2 * math.pi) + rise])
        )
    n = len(angles)
    faces = []
    for row in range(2):
        for i in range(n - 1):
            a, b, c, d = row * n + i, row * n + i + 1, (row + 1) * n + i, (row + 1) * n + i + 1
            faces += [[a, b, d], [a, d, c]]
    return chasles.Polyhedron(np.concatenate(rows), faces)


bolt, nut = thread(BOLT_RADIUS, 0, LENGTH), thread(NUT_RADIUS, 2, 6)
print(bolt, nut)


# %% [markdown]
# ## The right screw
# A screw between two poses turns by less than half a turn. The path therefore has twelve poses per turn.


# %%
def turned(turns: float, slide: float) -> np.ndarray:
    pose = np.eye(4)
    angle = 2 * math.pi * turns
    pose[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    pose[2, 3] = slide
    return pose


def unscrew(pitch: float, turns: int = 2) -> chasles.PathContact:
    path = np.stack([turned(i / 12, pitch * i / 12) for i in range(12 * turns + 1)])
    return chasles.first_contact_on_path(nut, bolt, path)


right = unscrew(PITCH)
print("right pitch:", right)
assert right.verdict == chasles.Verdict.clear

# %% [markdown]
# ## The wrong pitch, and a straight pull
# Both motions jam once the play between the flanks is used up.

# %%
wrong = unscrew(1.1 * PITCH)
print("wrong pitch:", wrong)
assert wrong.verdict == chasles.Verdict.contact

pull = chasles.first_contact(nut, bolt, np.eye(4), turned(0, 3.0))
print("straight pull:", pull)
assert pull.verdict == chasles.Verdict.contact
print(f"the nut moves by {3 * pull.time:.6f} before its flanks touch, at {pull.contacts[0].point.round(3)}")
assert 0 < 3 * pull.time < 0.3
