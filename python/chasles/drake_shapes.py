"""The proximity geometries of Drake as bodies, for `chasles.drake`."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydrake import geometry as dg

from ._core import InvalidInput, Polyhedron, capsule, load, sphere
from .primitive_shapes import box, ellipsoid, prism, slab


def body_of(
    inspector: dg.SceneGraphInspector, geometry: Any, meshes: str, deviation: float, plane_size: float
) -> tuple[Polyhedron, float]:
    """A body in the frame of the geometry, and by how much it is larger than the shape."""
    shape = inspector.GetShape(geometry)
    if isinstance(shape, dg.Sphere):
        return sphere(shape.radius()), 0.0
    if isinstance(shape, dg.Capsule):
        return capsule(shape.radius(), shape.length()), 0.0
    if isinstance(shape, dg.Box):
        return box(-shape.size() / 2, shape.size() / 2), 0.0
    if isinstance(shape, dg.Cylinder):
        return Polyhedron(*prism(shape.radius(), shape.length() / 2, deviation)), deviation * shape.radius()
    if isinstance(shape, dg.Ellipsoid):
        axes = np.array([shape.a(), shape.b(), shape.c()])
        return Polyhedron(*ellipsoid(axes, deviation)), deviation * float(axes.max())
    if isinstance(shape, dg.HalfSpace):
        return slab(np.array([0.0, 0.0, 1.0]), 0.0, plane_size), 0.0
    if isinstance(shape, dg.Mesh) and meshes == "mesh":
        return _faces_of(shape), 0.0
    if isinstance(shape, dg.Mesh | dg.Convex):
        return _hull_of(inspector.GetConvexHull(geometry)), 0.0
    raise InvalidInput(f"a {type(shape).__name__} has no polyhedron")


def _hull_of(hull: dg.PolygonSurfaceMesh) -> Polyhedron:
    vertices = [hull.vertex(i) for i in range(hull.num_vertices())]
    polygons = [hull.element(i) for i in range(hull.num_elements())]
    faces = [[polygon.vertex(k) for k in range(polygon.num_vertices())] for polygon in polygons]
    return Polyhedron(np.array(vertices), faces, triangulate=True)


def _faces_of(shape: dg.Mesh) -> Polyhedron:
    """Other formats may have a unit or an upward axis of their own, so only OBJ is read."""
    source = shape.source()
    if not source.is_path() or shape.extension().lower() != ".obj":
        raise InvalidInput(
            "only meshes of OBJ files can be read with meshes='mesh'; meshes='hull' takes its convex hull"
        )
    body = load(source.path())
    return Polyhedron(body.vertices * shape.scale3(), body.faces)
