#!/usr/bin/env python3
"""A library of the Python Package Index as a peer of bench/peers_bench.cpp; the protocol is in bench/process_peer.h.

Usage: peers.py coal-start | coal-distance | coal-samples | fcl-default | fcl-screw

Only the library's own call is timed. Poses, requests and results are made before the call.
"""

import sys

import protocol

try:
    import numpy as np

    import coal
    import fcl
except ImportError as error:
    protocol.absent(str(error))
    sys.exit(0)


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The product of two quaternions, w first."""
    w = a[0] * b[0] - a[1:] @ b[1:]
    return np.array([w, *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])


def matrix(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def on_uniform_screw(start: np.ndarray, goal: np.ndarray, times: list[float]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Rotation matrices and translations at the times. `start` and `goal` are a translation and a quaternion each."""
    turn = product(goal[3:], start[3:] * [1, -1, -1, -1])
    turn = -turn if turn[0] < 0 else turn
    sine = np.linalg.norm(turn[1:])
    travel = goal[:3] - start[:3]
    if sine < 1e-9:
        return [(matrix(start[3:]), start[:3] + time * travel) for time in times]
    axis = turn[1:] / sine
    slide = (travel @ axis) * axis
    across = travel - slide
    arm = -0.5 * (across + turn[0] / sine * np.cross(axis, across))  # from a point of the axis to the start
    half = np.arctan2(sine, turn[0])

    def pose_at(time: float) -> tuple[np.ndarray, np.ndarray]:
        turned = np.array([np.cos(half * time), *(np.sin(half * time) * axis)])
        shift = start[:3] - arm + matrix(turned) @ arm + time * slide
        return matrix(product(turned, start[3:])), shift

    return [pose_at(time) for time in times]


class CoalStart:
    """`collide` at the start pose, for at most one contact."""

    Model = coal.BVHModelOBB
    times = [0.0]

    def body(self, vertices: np.ndarray, triangles: np.ndarray):
        model = self.Model()
        model.beginModel(len(triangles), len(vertices))
        model.addVertices(vertices)
        model.addTriangles(triangles)
        model.endModel()
        return model

    def ask(self, moving, fixed, start: np.ndarray, goal: np.ndarray) -> str:
        poses = [coal.Transform3s(*pose) for pose in on_uniform_screw(start, goal, self.times)]
        still = coal.Transform3s.Identity()
        request = coal.CollisionRequest(coal.CollisionRequestFlag.NO_REQUEST, 1)
        request.break_distance = 0  # the default of 1e-3 makes the M16 nut in metres 40 times slower
        results = [coal.CollisionResult() for _ in poses]

        def first_hit():
            for time, pose, result in zip(self.times, poses, results):
                if coal.collide(moving, pose, fixed, still, request, result):
                    return time
            return None

        hit, seconds = protocol.timed(first_hit)
        return protocol.answer(hit is not None, hit, seconds)


class CoalSamples(CoalStart):
    """`collide` at a hundred poses in order of time, until the first contact."""

    times = [i / 99 for i in range(100)]


class CoalDistance(CoalStart):
    """`distance` at the start pose."""

    Model = coal.BVHModelOBBRSS

    def ask(self, moving, fixed, start: np.ndarray, goal: np.ndarray) -> str:
        pose = coal.Transform3s(matrix(start[3:]), start[:3])
        still = coal.Transform3s.Identity()
        request = coal.DistanceRequest()
        result = coal.DistanceResult()
        distance, seconds = protocol.timed(lambda: coal.distance(moving, pose, fixed, still, request, result))
        return protocol.answer(distance <= 0, 0 if distance <= 0 else None, seconds)


class FclDefault:
    """`continuousCollide` with the defaults of its request: conservative advancement without rotation."""

    def request(self):
        return fcl.ContinuousCollisionRequest()

    def body(self, vertices: np.ndarray, triangles: np.ndarray):
        model = fcl.BVHModel()
        model.beginModel(len(triangles), len(vertices))
        model.addSubModel(vertices, triangles)
        model.endModel()
        return model

    def ask(self, moving, fixed, start: np.ndarray, goal: np.ndarray) -> str:
        moving_object = fcl.CollisionObject(moving, fcl.Transform(start[3:], start[:3]))
        fixed_object = fcl.CollisionObject(fixed, fcl.Transform())
        end, still = fcl.Transform(goal[3:], goal[:3]), fcl.Transform()
        request, result = self.request(), fcl.ContinuousCollisionResult()
        _, seconds = protocol.timed(
            lambda: fcl.continuousCollide(moving_object, end, fixed_object, still, request, result)
        )
        return protocol.answer(result.is_collide, result.time_of_contact if result.is_collide else None, seconds)


class FclScrew(FclDefault):
    """The same with a screw motion, which is not the default."""

    def request(self):
        return fcl.ContinuousCollisionRequest(ccd_motion_type=fcl.CCDMotionType.CCDM_SCREW)


PEERS = {
    "coal-start": CoalStart,
    "coal-distance": CoalDistance,
    "coal-samples": CoalSamples,
    "fcl-default": FclDefault,
    "fcl-screw": FclScrew,
}


def main() -> None:
    peer = PEERS[sys.argv[1]]()
    bodies = []

    def add_body(text: str) -> str:
        vertices, triangles, numbers = text.split(" ", 2)
        end = 3 * int(vertices)
        values = np.array(numbers.split(), dtype=float)
        bodies.append(peer.body(values[:end].reshape(-1, 3), values[end:].reshape(int(triangles), 3).astype(np.int64)))
        return "done"

    def ask(text: str) -> str:
        moving, fixed, *numbers = text.split()
        poses = np.array(numbers, dtype=float)
        return peer.ask(bodies[int(moving)], bodies[int(fixed)], poses[:7], poses[7:])

    protocol.serve({"body": add_body, "ask": ask})


if __name__ == "__main__":
    main()
