"""Continuous validation of hpp-core: Dichotomy and Progressive. They bound velocities, and compute in plain double."""

import os
import sys
import sysconfig
import time
import typing

import numpy as np
import robot_worlds


def with_library_path() -> None:
    """Starts the program again where hpp's libraries are found: the wheel's own search path is one folder short."""
    folder = os.path.join(sysconfig.get_path("purelib"), "cmeel.prefix", "lib")
    paths = os.environ.get("LD_LIBRARY_PATH", "").split(":")
    if os.path.isdir(folder) and folder not in paths:
        os.environ["LD_LIBRARY_PATH"] = ":".join([folder, *filter(None, paths)])
        os.execv(sys.executable, [sys.executable, *sys.argv])


class HppRobot:
    def __init__(self, world: robot_worlds.World, urdf: str):
        import pinocchio
        import pyhpp.core
        import pyhpp.pinocchio.urdf

        self.core = pyhpp.core
        self.device = pyhpp.pinocchio.Device(world.robot.name)
        pyhpp.pinocchio.urdf.loadModel(
            self.device, 0, "", "anchor", urdf, str(world.robot.srdf), pinocchio.SE3.Identity()
        )
        self.space = self.device.configSpace()

    def pairs(self) -> int:
        return len(self.device.geomModel().collisionPairs)

    def validator(self, kind: str, tolerance: float) -> typing.Callable:
        """A function of start and goal: the answer and the seconds of hpp's call. The path is made before."""
        validation = getattr(self.core, kind)(self.device, tolerance)

        def ask(start: np.ndarray, goal: np.ndarray) -> tuple[bool, float]:
            length = float(np.linalg.norm(goal - start))
            path = self.core.StraightPath(self.space, start, goal, self.core.interval(0.0, length), None)
            began = time.process_time()
            is_valid = validation.validate(path, False)[0]
            return bool(is_valid), time.process_time() - began

        return ask
