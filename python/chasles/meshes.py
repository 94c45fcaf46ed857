"""Bodies from the meshes of other packages."""

from typing import Any

from ._core import InvalidInput, Polyhedron


def from_trimesh(
    mesh: Any, *, triangulate: bool = False, drop_degenerate: bool = False, threads: int = 0
) -> Polyhedron:
    """A polyhedron from a ``trimesh.Trimesh``. It keeps the ids of the vertices and faces.

    Scenes and other geometry raise InvalidInput; ``scene.to_mesh()`` converts a scene to a Trimesh.
    """
    vertices, faces = getattr(mesh, "vertices", None), getattr(mesh, "faces", None)
    if vertices is None or faces is None:
        raise InvalidInput(f"mesh: a {type(mesh).__name__} has no vertices and faces; a trimesh.Trimesh is needed")
    return Polyhedron(vertices, faces, triangulate=triangulate, drop_degenerate=drop_degenerate, threads=threads)
