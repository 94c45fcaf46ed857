"""A robot in Pinocchio and Coal: tests of single configurations, and of samples along an edge."""

import pathlib
import time

import coal
import fcl_judge
import numpy as np
import pinocchio

import chasles


class CoalRobot:
    """One call of pinocchio.computeCollisions a sample; a sample that collides ends the edge."""

    def __init__(self, file: pathlib.Path, robot: chasles.Robot, cloud: coal.OcTree | None = None):
        """`file` is a URDF file whose links "obstacle..." are the world, and so is the cloud."""
        self.file = str(file)
        self.model = pinocchio.buildModelFromUrdf(self.file)
        self.geometry = pinocchio.buildGeomFromUrdf(self.model, self.file, pinocchio.GeometryType.COLLISION)
        if cloud is not None:
            here = pinocchio.SE3.Identity()
            self.geometry.addGeometryObject(pinocchio.GeometryObject("obstacle", 0, 0, here, cloud))
        self.add_pairs(robot)
        self.data = self.model.createData()
        self.geometry_data = self.geometry.createData()
        for request in self.geometry_data.collisionRequests:
            request.break_distance = 0.0  # see docs/decisions/0040-peers.md
        self.broad_phase = pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager(
            self.model, self.geometry, self.geometry_data
        )
        self.fcl = None if cloud is not None else fcl_judge.FclJudge(self.geometry)
        self.extent = float(
            np.linalg.norm(self.model.upperPositionLimit - self.model.lowerPositionLimit)
        )  # OMPL's largest distance

    def add_pairs(self, robot: chasles.Robot) -> None:
        """The pairs that Chasles tests, too, and the robot's moving links with all obstacles."""
        objects = self.geometry.geometryObjects
        links = [self.model.frames[o.parentFrame].name for o in objects]
        for i in range(len(objects)):
            for j in range(i + 1, len(objects)):
                if objects[i].parentJoint == objects[j].parentJoint:
                    continue
                is_world = [objects[k].name.startswith("obstacle") for k in (i, j)]
                if any(is_world) or robot.is_tested(links[i], links[j]):
                    self.geometry.addCollisionPair(pinocchio.CollisionPair(i, j))

    def collides(self, configuration: np.ndarray) -> bool:
        return pinocchio.computeCollisions(self.model, self.data, self.broad_phase, configuration, True)

    def surely_collides(self, configuration: np.ndarray) -> bool:
        """Not only within Coal's tolerance."""
        return self.collides(configuration) and self.fcl.collides(self.geometry_data)

    def samples(self, start: np.ndarray, goal: np.ndarray, part: float) -> np.ndarray:
        """As OMPL takes them: at most `part` of the extent apart, without the start."""
        count = max(1, int(np.ceil(np.linalg.norm(goal - start) / (part * self.extent))))
        return start + np.linspace(0, 1, count + 1)[1:, None] * (goal - start)

    def is_clear(self, samples: np.ndarray) -> bool:
        return not any(map(self.collides, samples))

    def timed(self, start: np.ndarray, goal: np.ndarray, part: float) -> tuple[bool, float]:
        """The answer and the seconds of the calls: samples are made before."""
        samples = list(self.samples(start, goal, part))
        collides, arguments = pinocchio.computeCollisions, (self.model, self.data, self.broad_phase)
        began = time.process_time()
        for sample in samples:
            if collides(*arguments, sample, True):
                return False, time.process_time() - began
        return True, time.process_time() - began

    def overhead(self) -> float:
        """Seconds of Python a sample: the same call for a model without shapes, with its kinematics."""
        geometry = pinocchio.GeometryModel()
        arguments = (self.model, self.data, geometry, geometry.createData())
        sample = pinocchio.neutral(self.model)
        began = time.process_time()
        for _ in range(10000):
            pinocchio.computeCollisions(*arguments, sample, True)
        return (time.process_time() - began) / 10000
