"""Bodies from the meshes of other packages."""

import itertools
from typing import Any

import numpy as np

from ._core import InvalidInput, Polyhedron
from .arrays import array_of, numbers
from .articles import with_article


def from_trimesh(
    mesh: Any, *, triangulate: bool = False, threads: int = 0, solid: str = "automatic", radius: float = 0.0
) -> Polyhedron:
    """A polyhedron from a ``trimesh.Trimesh``. It keeps the ids of the vertices and faces.

    Scenes and other geometry raise InvalidInput. `parts_from_trimesh` gives the parts of a scene, and
    ``scene.to_mesh()`` makes one Trimesh of it.
    """
    vertices, faces = getattr(mesh, "vertices", None), getattr(mesh, "faces", None)
    if vertices is None or faces is None:
        way_out = "parts_from_trimesh gives its parts" if hasattr(mesh, "graph") else "a trimesh.Trimesh is needed"
        raise InvalidInput(f"mesh: {with_article(mesh)} has no vertices and faces; {way_out}")
    return Polyhedron(vertices, faces, triangulate=triangulate, threads=threads, solid=solid, radius=radius)


def parts_from_trimesh(
    scene: Any, *, triangulate: bool = False, threads: int = 0, solid: str = "automatic", radius: float = 0.0
) -> dict[str, Polyhedron]:
    """The parts of a ``trimesh.Scene``: a polyhedron for each node of its graph that has a mesh, by the node's name.

    Vertices are in the world of the scene: all transforms above a node are applied to them, with their scale, mirroring
    and shear. Faces of mirrored parts are reversed, so that they still turn outwards. Each part keeps the ids of the
    vertices and faces of its mesh.

    Raises
    ------
    InvalidInput
        For what is no scene, and with the name of the node for geometry without faces or a mesh that is refused.
    """
    if not hasattr(scene, "graph") or not hasattr(scene, "geometry"):
        raise InvalidInput(f"scene: {with_article(scene)} is no trimesh.Scene; from_trimesh takes a Trimesh")
    parts, names = {}, _names_of(scene.graph.nodes_geometry)
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        try:
            mesh = _placed(scene.geometry[name], numbers(matrix, "transform"))
            parts[names[node]] = Polyhedron(*mesh, triangulate=triangulate, threads=threads, solid=solid, radius=radius)
        except InvalidInput as error:
            raise InvalidInput(f"{node}: {error}") from None
    return parts


def _names_of(nodes: Any) -> dict[Any, str]:
    """A text for each node. Nodes that are no texts, as 1 beside "1", take no name of another node."""
    names = {node: node for node in nodes if isinstance(node, str)}
    used = set(names.values())
    for node in nodes:
        if node not in names:
            endings = itertools.chain([""], (f"_{number}" for number in itertools.count(2)))
            names[node] = next(name for name in (f"{node}{ending}" for ending in endings) if name not in used)
            used.add(names[node])
    return names


def _placed(mesh: Any, matrix: Any) -> tuple[Any, Any]:
    """The vertices and faces of a mesh after an affine map."""
    if not hasattr(mesh, "faces"):
        raise InvalidInput(f"{with_article(mesh)} has no faces; delete it from the scene")
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all() or (matrix[3] != [0, 0, 0, 1]).any():
        raise InvalidInput("transform: is no affine map: finite numbers (4, 4) with the last row 0 0 0 1 are needed")
    vertices, faces = numbers(mesh.vertices, "vertices"), array_of(mesh.faces, "faces")
    if vertices.shape[1:] != (3,):
        raise InvalidInput(f"vertices: the shape is {vertices.shape}; (n, 3) is needed")
    vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
    return vertices, faces[..., ::-1] if _orientation(matrix[:3, :3]) < 0 else faces


def _orientation(matrix: Any) -> float:
    """The sign of the determinant, at any scale. A matrix that flattens the mesh is refused, as in files."""
    largest = np.abs(matrix).max()
    rows = matrix / largest if largest > 0 else matrix
    orientation = float(np.sign(np.dot(rows[0], np.cross(rows[1], rows[2]))))
    if orientation == 0:
        raise InvalidInput("its transform flattens the mesh (a scale of 0); remove the node or scale it")
    return orientation
