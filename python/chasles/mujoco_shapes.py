"""The geoms of a MuJoCo model as bodies, for `chasles.mujoco`.

A shape is in the frame of its geom. Bodies whose surface is curved have two polyhedra: one that encloses them, for "clear",
and one inside of them, for "contact".
"""

from __future__ import annotations

from typing import Any

import mujoco as mj
import numpy as np

from ._core import InvalidInput, Polyhedron, capsule, first_contact, sphere
from .primitive_shapes import Array, Mesh, box, ellipsoid, prism

MOST_OF_BALL = 0.9
CURVED = ("CYLINDER", "ELLIPSOID")


def kind_of(model: Any, geom: int) -> str:
    """SPHERE, BOX and so on."""
    return mj.mjtGeom(int(model.geom_type[geom])).name.removeprefix("mjGEOM_")


def inset_of(model: Any, geom: int, wanted: float, meshes: str) -> float:
    """By how much the faces of a geom move inwards: as wanted, but by at most nine tenths of the radius of the largest ball in it."""
    size, kind = model.geom_size[geom], kind_of(model, geom)
    if wanted == 0 or kind in ("PLANE", "HFIELD") or (kind == "MESH" and meshes == "mesh"):
        return wanted
    if kind == "MESH":
        ball = _largest_ball(_planes(_hull(model, int(model.geom_dataid[geom]))[0]), wanted / MOST_OF_BALL)[1]
    else:
        ball = float(size[: {"SPHERE": 1, "CAPSULE": 1, "CYLINDER": 2}.get(kind, 3)].min())
    return min(wanted, MOST_OF_BALL * ball)


def shape_of(
    model: Any, geom: int, inset: float, *, meshes: str, deviation: float, plane: float, inner: bool
) -> Polyhedron:
    """The body of a geom, all of whose faces have moved inwards by `inset`.

    Parameters
    ----------
    model : mujoco.MjModel
    geom : int
    inset : float
        As `inset_of` has it, length unit.
    meshes : "hull" or "mesh"
    deviation : float
        The polyhedra of cylinders and ellipsoids leave them by at most this part of the (largest) radius.
    plane : float
        Half of the side, and the depth, of the slab of a plane, length unit.
    inner : bool
        Whether cylinders and ellipsoids are polyhedra inside of them, instead of around them.
    """
    size, kind = np.asarray(model.geom_size[geom], np.float64), kind_of(model, geom)
    if kind == "SPHERE":
        return sphere(size[0] - inset)
    if kind == "CAPSULE":
        return capsule(size[0] - inset, 2 * size[1])
    if kind == "PLANE":
        return box(np.array([-plane, -plane, -inset - plane]), np.array([plane, plane, -inset]))
    if kind == "BOX":
        return box(inset - size, size - inset)
    if kind == "HFIELD":
        return Polyhedron(*_field(model, int(model.geom_dataid[geom]), inset))
    if kind == "MESH" and meshes == "mesh":
        return _surface(model, int(model.geom_dataid[geom]), inset)
    if kind == "MESH":
        return _moved_inwards(_hull(model, int(model.geom_dataid[geom])), inset)
    if kind == "CYLINDER":
        return _moved_inwards(prism(size[0], size[1], deviation, inner), inset)
    if kind == "ELLIPSOID":
        return _moved_inwards(ellipsoid(size, deviation, inner), inset)
    raise InvalidInput(f"has no polyhedron: {kind}")


def _vertices(model: Any, mesh: int) -> Array:
    begin = model.mesh_vertadr[mesh]
    return np.asarray(model.mesh_vert[begin : begin + model.mesh_vertnum[mesh]], np.float64)


def _surface(model: Any, mesh: int, inset: float) -> Polyhedron:
    begin = model.mesh_faceadr[mesh]
    body = Polyhedron(_vertices(model, mesh), model.mesh_face[begin : begin + model.mesh_facenum[mesh]])
    try:
        return body.with_radius(-inset) if inset > 0 else body
    except InvalidInput as error:
        raise InvalidInput(
            f"{error}; meshes='hull' takes any allowed overlap that the hull is thick enough for"
        ) from None


def _hull(model: Any, mesh: int) -> Mesh:
    """The convex hull that MuJoCo made of the mesh: what it collides."""
    begin = int(model.mesh_graphadr[mesh])
    if begin < 0:
        raise InvalidInput("its mesh has no convex hull in the model; take meshes='mesh'")
    count, faces = (int(number) for number in model.mesh_graph[begin : begin + 2])
    ids = np.asarray(model.mesh_graph[begin + 2 + count : begin + 2 + 2 * count])
    triangles = model.mesh_graph[begin + 2 + 3 * (count + faces) :][: 3 * faces].reshape(
        -1, 3
    )  # after the lists of edges
    order = np.argsort(ids)
    return _vertices(model, mesh)[ids], order[np.searchsorted(ids[order], triangles)].tolist()


def _field(model: Any, field: int, inset: float) -> Mesh:
    """The cells of a height field, cut as MuJoCo cuts them, down to its base."""
    rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    half_x, half_y, top, base = (float(number) for number in model.hfield_size[field])
    begin = model.hfield_adr[field]
    heights = np.asarray(model.hfield_data[begin : begin + rows * columns], np.float64) * top - inset
    if heights.min() <= -base:
        raise InvalidInput(
            f"its base is {base:g} thick, which is no more than half of the allowed overlap of {2 * inset:g}"
        )
    x, y = np.meshgrid(np.linspace(-half_x, half_x, columns), np.linspace(-half_y, half_y, rows))
    upper = np.column_stack([x.ravel(), y.ravel(), heights])
    at = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in (at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]))
    surface = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]).tolist()
    rim = np.concatenate([at[0, :-1], at[:-1, -1], at[-1, :0:-1], at[:0:-1, 0]])
    below = upper[rim]
    below[:, 2] = -base
    count = len(rim)
    under = np.arange(count) + rows * columns
    walls = [[int(under[i]), int(under[(i + 1) % count]), int(rim[(i + 1) % count]), int(rim[i])] for i in range(count)]
    return np.concatenate([upper, below]), [*surface, *walls, under[::-1].tolist()]


def _moved_inwards(mesh: Mesh, inset: float) -> Polyhedron:
    """A convex body: all points that are at least `inset` below each of its faces.

    Narrow faces may vanish on the way, which `Polyhedron.with_radius` refuses. The hull of hundreds of points has many.
    """
    vertices, faces = mesh
    if inset == 0:
        return Polyhedron(vertices, faces)
    from scipy.spatial import (
        ConvexHull,
        HalfspaceIntersection,
        QhullError,
    )  # here: only overlaps that are allowed need it

    planes = _planes(vertices)
    middle, ball = _largest_ball(planes, inset / MOST_OF_BALL)
    if ball <= inset:
        raise InvalidInput(f"is thinner than {2 * inset:g}")
    planes[:, 3] += inset + planes[:, :3] @ middle  # seen from the middle of the ball
    try:
        corners = HalfspaceIntersection(planes, np.zeros(3)).intersections
        hull = ConvexHull(
            corners, qhull_options="Qt Q12"
        )  # Q12: wide facets are no error; the proof below finds what they spoil
    except QhullError:
        raise InvalidInput("its faces cannot be moved inwards; give an allowed overlap of 0") from None
    triangles, outer = hull.simplices.copy(), corners[hull.simplices]
    normals = np.cross(outer[:, 1] - outer[:, 0], outer[:, 2] - outer[:, 0])
    is_turned = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0
    triangles[is_turned] = triangles[is_turned][:, ::-1]
    body, origin = Polyhedron(corners + middle, triangles), [0, 0, 0, 1, 0, 0, 0]
    # Hulls are computed in double. That all points of the body are so deep inside of the given one is proven here.
    found = first_contact(body, Polyhedron(vertices, faces), origin, origin, margin=0.99 * inset)
    if found.inside != "moving":
        raise InvalidInput("its faces cannot be moved inwards; give an allowed overlap of 0")
    return body


def _planes(vertices: Array) -> Array:
    """Of the faces of a convex body: unit normals n and numbers d, so that n x + d <= 0 inside."""
    from scipy.spatial import ConvexHull

    return np.array(ConvexHull(vertices).equations)


def _largest_ball(planes: Array, enough: float) -> tuple[Array, float]:
    """The middle and the radius of the largest ball within planes, or of one whose radius is enough."""
    from scipy.optimize import linprog

    bounds = [(None, None)] * 3 + [(0, enough)]
    found = linprog([0, 0, 0, -1], np.column_stack([planes[:, :3], np.ones(len(planes))]), -planes[:, 3], bounds=bounds)
    return np.asarray(found.x[:3], np.float64), float(found.x[3])
