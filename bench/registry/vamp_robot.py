"""VAMP's Panda: spheres, tested at 32 samples a radian. By ctypes; the library is made by install.sh."""

import ctypes
import math
import pathlib

import numpy as np
import robot_worlds


def library(file: pathlib.Path) -> ctypes.CDLL:
    """Raises OSError where it is absent."""
    loaded = ctypes.CDLL(str(file))
    loaded.vamp_new.restype = ctypes.c_void_p
    loaded.vamp_is_clear.restype = ctypes.c_bool
    return loaded


def floats(values: np.ndarray | tuple) -> ctypes.Array:
    return (ctypes.c_float * len(values))(*values)


def doubles(values: np.ndarray) -> ctypes.Array:
    return (ctypes.c_double * len(values))(*values)


class VampRobot:
    """The world as VAMP's own scripts make it: cylinders are capsules, in the problems "box" they are boxes, and clouds
    are thinned to the least radius of the robot's spheres."""

    def __init__(
        self, loaded: ctypes.CDLL, world: robot_worlds.World | None, cloud: np.ndarray | None = None, radius: float = 0.0
    ):
        self.library = loaded
        self.handle = ctypes.c_void_p(loaded.vamp_new())
        if world is not None:
            self.add_obstacles(world)
        self.kept_points = 0 if cloud is None else self.add_cloud(cloud, radius)
        loaded.vamp_ready(self.handle)

    def add_cloud(self, points: np.ndarray, radius: float) -> int:
        """Returns how many points VAMP's filter keeps."""
        values = np.ascontiguousarray(points, np.float32)
        pointer = values.ctypes.data_as(ctypes.POINTER(ctypes.c_float))
        return self.library.vamp_add_cloud(self.handle, pointer, len(values), ctypes.c_float(radius))

    def add_obstacles(self, world: robot_worlds.World) -> None:
        for obstacle in world.obstacles:
            centre = floats(obstacle.pose[:3, 3])
            angles = floats(robot_worlds.angles_of(obstacle.pose[:3, :3]))
            if not obstacle.is_box and not world.name.startswith("box/"):
                height, radius = obstacle.sizes
                self.library.vamp_add_capsule(self.handle, centre, angles, ctypes.c_float(radius), ctypes.c_float(height))
                continue
            sizes = obstacle.sizes
            if not obstacle.is_box:
                height, radius = sizes
                sizes = (2 * radius, 2 * radius, height)
            self.library.vamp_add_cuboid(self.handle, centre, angles, floats([size / 2 for size in sizes]))

    def __del__(self) -> None:
        self.library.vamp_delete(self.handle)

    def ask(self, start: np.ndarray, goal: np.ndarray) -> tuple[bool, float]:
        seconds = ctypes.c_double()
        answer = self.library.vamp_is_clear(self.handle, doubles(start), doubles(goal), 10, ctypes.byref(seconds))
        return bool(answer), seconds.value

    def plan(self, start: np.ndarray, goal: np.ndarray) -> tuple[np.ndarray, float]:
        """The shortened path, without rows if there is none, and seconds."""
        room, seconds = 1000, ctypes.c_double(math.nan)
        path = np.zeros((room, len(start)))
        count = self.library.vamp_plan(
            self.handle,
            doubles(start),
            doubles(goal),
            path.ctypes.data_as(ctypes.POINTER(ctypes.c_double)),
            room,
            ctypes.byref(seconds),
        )
        return path[:count], seconds.value
