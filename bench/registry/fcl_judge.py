"""FCL's tests of triangles, which have no tolerance: Coal counts triangles as colliding that are 1e-6 apart or less."""

import fcl
import numpy as np
import pinocchio
import robot_worlds


class FclJudge:
    """Tests the pairs of a pinocchio.GeometryModel whose shapes are meshes or boxes."""

    def __init__(self, geometry: pinocchio.GeometryModel):
        self.geometry = geometry
        self.models: dict[int, fcl.BVHModel] = {}

    def mesh(self, index: int) -> tuple[np.ndarray, np.ndarray]:
        shape = self.geometry.geometryObjects[index].geometry
        if hasattr(shape, "halfSide"):
            vertices, faces = robot_worlds.box(tuple(2 * shape.halfSide))
            return vertices, np.array(robot_worlds.triangles(faces))
        return np.array(shape.vertices()), np.array(
            [[shape.tri_indices(i)[k] for k in range(3)] for i in range(shape.num_tris)]
        )

    def model(self, index: int) -> fcl.BVHModel:
        if index not in self.models:
            vertices, triangles = self.mesh(index)
            model = fcl.BVHModel()
            model.beginModel(len(vertices), len(triangles))
            model.addSubModel(vertices, triangles)
            model.endModel()
            self.models[index] = model
        return self.models[index]

    def collides(self, data: pinocchio.GeometryData) -> bool:
        """At the placements of the last update."""
        for pair in self.geometry.collisionPairs:
            first, second = (
                fcl.CollisionObject(self.model(i), fcl.Transform(data.oMg[i].rotation, data.oMg[i].translation))
                for i in (pair.first, pair.second)
            )
            if fcl.collide(first, second, fcl.CollisionRequest(), fcl.CollisionResult()) > 0:
                return True
        return False
