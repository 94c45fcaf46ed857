"""Bodies from the meshes of other packages."""

from typing import Any

from ._core import InvalidInput, Polyhedron


def from_trimesh(
    mesh: Any, *, triangulate: bool = False, drop_degenerate: bool = False, threads: int = 0
) -> Polyhedron:
    """A polyhedron from a ``trimesh.Trimesh``, with the ids of its vertices and faces.

    Scenes and other geometry are refused; ``scene.to_mesh()`` makes a Trimesh of a scene.
    """
    vertices, faces = getattr(mesh, "vertices", None), getattr(mesh, "faces", None)
    if vertices is None or faces is None:
        raise InvalidInput(f"mesh: a {type(mesh).__name__} has no vertices and faces; a trimesh.Trimesh is needed")
    return Polyhedron(vertices, faces, triangulate=triangulate, drop_degenerate=drop_degenerate, threads=threads)
