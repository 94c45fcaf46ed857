"""Distances of the arm of seven_joints.py to balls and bars, by its own kinematics in NumPy: what the gate is compared with."""

import numpy as np
from seven_joints import LENGTHS, RADII, pose

import chasles


def turn(angles, axis):
    """Rotations about z or y, (n, 3, 3)."""
    c, s, o, i = np.cos(angles), np.sin(angles), np.zeros_like(angles), np.ones_like(angles)
    rows = [[c, -s, o], [s, c, o], [o, o, i]] if axis == "z" else [[c, o, s], [o, i, o], [-s, o, c]]
    return np.moveaxis(np.array(rows), -1, 0)


def frames(configurations):
    """Places (n, 8, 3) of the seven joints and of the flange, and rotations (n, 7, 3, 3) of the links."""
    q = np.atleast_2d(configurations)
    place, rotation = np.tile([0.0, 0.0, 0.16], (len(q), 1)), np.tile(np.eye(3), (len(q), 1, 1))
    places, rotations = [place], []
    for i, length in enumerate(LENGTHS):
        rotation = rotation @ turn(q[:, i], "z" if i % 2 == 0 else "y")
        place = place + length * rotation[:, :, 2]
        places.append(place)
        rotations.append(rotation)
    return np.stack(places, 1), np.stack(rotations, 1)


def segment_distances(a, b, c, d):
    """Distances of segments a-b and c-d, (..., 3) each: the least of 4 end points and the two inner points."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv, uw, vw = (np.sum(x * y, -1) for x, y in ((u, u), (u, v), (v, v), (u, w), (v, w)))
    det = np.maximum(uu * vv - uv * uv, 1e-300)
    s, t = (uv * vw - vv * uw) / det, (uu * vw - uv * uw) / det
    inside = (s > 0) & (s < 1) & (t > 0) & (t < 1)
    inner = np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1)
    ends = [point_distances(p, c, d) for p in (a, b)] + [point_distances(p, a, b) for p in (c, d)]
    return np.minimum(np.min(np.broadcast_arrays(*ends), 0), np.where(inside, inner, np.inf))


def point_distances(p, a, b):
    u = b - a
    share = np.clip(np.sum((p - a) * u, -1) / np.maximum(np.sum(u * u, -1), 1e-300), 0, 1)
    return np.linalg.norm(p - a - share[..., None] * u, axis=-1)


class Bars:
    """Bars and balls at rest: (m, 3) ends and (m,) radii."""

    def __init__(self, random, count=20):
        middles = random.uniform([-0.9, -0.9, 0.05], [0.9, 0.9, 1.1], (count, 3))
        far = np.hypot(*middles.T[:2]) > 0.3
        ways = random.normal(size=(count, 3)) * random.integers(0, 2, count)[:, None] * 0.08  # half of them are balls
        self.a, self.b, self.radii = (middles - ways)[far], (middles + ways)[far], random.uniform(0.01, 0.08, far.sum())

    def scene(self):
        result = chasles.Scene()
        for i, (a, b, radius) in enumerate(zip(self.a, self.b, self.radii, strict=True)):
            way, length = b - a, np.linalg.norm(b - a)
            quaternion = [1, 0, 0, 0]
            if length > 0:
                quaternion = np.array([length + way[2], -way[1], way[0], 0.0])  # from z to the way, the shortest turn
            shape = chasles.capsule(radius, length) if length > 0 else chasles.sphere(radius)
            result.add(f"bar {i}", shape, pose(*((a + b) / 2), *quaternion))
        return result

    def distances(self, configurations):
        """Of each link and each bar, (n, 7, m)."""
        places, _ = frames(configurations)
        a, b = places[:, :7, None], places[:, 1:, None]
        axes = segment_distances(a, b, self.a[None, None], self.b[None, None])
        return axes - np.array(RADII)[:, None] - self.radii


def bare_arm(arm):
    """The arm without hand and base, which the distances leave out, and without tests against itself."""
    for first, second in arm.tested_pairs():
        arm.ignore(first, second)
    return arm


def samples(rows, between=10):
    """Configurations on the straight way through rows (n + 1, 7), and their times, in actions."""
    times = np.linspace(0, len(rows) - 1, between * (len(rows) - 1) + 1)
    return times, np.stack([np.interp(times, np.arange(len(rows)), column) for column in rows.T], 1)
