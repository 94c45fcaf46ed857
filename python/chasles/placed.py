"""Bodies at rest at poses in the world."""

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ._core import Motion, Polyhedron, Scene


class Placed:
    """A body at a pose in the world."""

    def __init__(self, shape: Polyhedron, pose: npt.NDArray[np.float64]):
        self.shape, self.pose = shape, pose
        self.matrix = np.asarray(Motion.at_rest(pose).pose_at(0.0))

    @cached_property
    def _outlines(self) -> list[tuple[int, ...]]:
        return self.shape.faces

    def normal_of(self, face: int) -> npt.NDArray[np.float64]:
        """The unit normal of a face of the input mesh, in the world; zeros for a face without area."""
        outline = self._outlines[int(np.flatnonzero(self.shape.source_faces == face)[0])]
        corners = self.shape.vertices[list(outline)]
        sides = corners - corners[0]
        normal = self.matrix[:3, :3] @ np.cross(sides, np.roll(sides, -1, axis=0)).sum(axis=0)
        length = float(np.linalg.norm(normal))
        return normal / length if length > 0 else np.zeros(3)

    def face_with(self, kind: str, feature: tuple[int, ...]) -> int:
        """The face, or a face that has the vertex or both vertices of the edge, as numbered in the input mesh."""
        if kind == "face":
            return feature[0]
        found = next(i for i, outline in enumerate(self._outlines) if set(feature) <= set(outline))
        return int(self.shape.source_faces[found])


def scene_of(groups: Sequence[Mapping[str, Placed]]) -> tuple[Scene, dict[str, Placed]]:
    """A scene in which the bodies of a group are not tested in pairs. A name begins with the number of the group."""
    scene = Scene()
    bodies: dict[str, Placed] = {}
    for group, placed in enumerate(groups):
        scene.ignore_groups(str(group), str(group))
        for name, body in placed.items():
            bodies[scene.add(f"{group}{name}", body.shape, body.pose, group=str(group))] = body
    return scene, bodies
