"""A plot of an answer with matplotlib: both bodies, the path of the moving body, and the contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._core import FirstContact, InvalidInput, Polyhedron, ScrewMotion
from .enums import Verdict
from .round_polygons import round_polygons

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d import Axes3D

Array = npt.NDArray[np.float64]

# Colours of Okabe and Ito, as on the page that view() writes.
MOVING, FIXED, CONTACT = "#e69f00", "#3f8fc8", "#d4147f"

MOST_OUTLINED = 1500  # faces; with more outlines a body is black
MOST_TRIANGLES = 8000  # matplotlib sorts all triangles for every drawing
LEAST_ROUND = 0.005  # of a body's size: a smaller radius is not seen
SAMPLES = 121


def plot(
    found: FirstContact,
    axes: Axes3D | None = None,
    *,
    ghosts: int = 3,
) -> Axes3D:
    """Draw the bodies at the contact (or at the goal, if clear), earlier poses as ghosts, and the moving body's path.

    Contact points are dots, and normals are arrows from the fixed body to the moving body. They are drawn in front of
    the bodies, because most contacts lie hidden between the bodies. Bodies with a radius are drawn round. Large meshes
    are simplified; `view` draws them in full. A swapped answer is drawn as the query had it.

    Parameters
    ----------
    found : FirstContact
    axes : Axes3D, optional
        The axes to draw on. By default, new axes in a new figure.
    ghosts : int
        The number of transparent bodies along the motion, including the start.

    Returns
    -------
    Axes3D

    Raises
    ------
    InvalidInput
        For the answer of a clear scene, which names no bodies, and for an unknown one.
    """
    if found.verdict == Verdict.unknown:
        raise InvalidInput("plot: the limit was reached before the answer, so there is nothing to show")
    if found.moving is None:
        raise InvalidInput("plot: the scene is clear, so the answer has no pair of bodies; scene.view(found) shows all")
    axes = axes or new_axes(6.5, "3d")
    axes.computed_zorder = False  # fixed order: contacts are drawn in front of the bodies
    if found.is_swapped:
        found = found.swapped()  # the motion is that of the query
    is_clear = found.verdict == Verdict.clear
    end = 1.0 if is_clear else found.time
    motion = _poses(found.motion)
    moving, fixed = _polygons(found.moving), _polygons(found.fixed)
    moving_pose = motion(1.0) if is_clear else np.asarray(found.pose)
    fixed_pose = found.motion.fixed_pose_at(1.0) if is_clear else found.fixed_pose
    drawn = [_moved(fixed, fixed_pose), _moved(moving, moving_pose)]
    _draw_ghosts(axes, [_moved(moving, motion(time)) for time in _ghost_times(end, ghosts)])
    _draw_solid(axes, drawn, [_is_drawn_round(found.fixed), _is_drawn_round(found.moving)])
    _draw_path(axes, found.moving, motion)
    _draw_contacts(axes, found, _extent(drawn))
    _label(axes, found)
    axes.autoscale_view()
    axes.set_aspect("equal")
    return axes


def new_axes(height: float, projection: str | None = None) -> Any:
    """Axes in a new figure of this height in inches."""
    try:
        import matplotlib.pyplot as plt
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("plot draws with matplotlib, which is not installed: pip install matplotlib") from error

    return plt.figure(figsize=(8, height), layout="constrained").add_subplot(projection=projection)


def _poses(motion: Any) -> Any:
    """The pose of the moving body as a function of time. A screw is cut into pieces, as in the query."""
    if not isinstance(motion, ScrewMotion):
        return motion.pose_at
    pieces = motion.pieces()

    def pose_at(time: float) -> Array:
        place = time * len(pieces)
        index = min(int(place), len(pieces) - 1)
        return pieces[index].pose_at(min(place - index, 1.0))

    return pose_at


def _ghost_times(end: float, count: int) -> Array:
    return np.linspace(0, end, count, endpoint=False) if end > 0 else np.empty(0)


def _polygons(body: Polyhedron) -> list[Array]:
    """The faces, or, if there are too many, triangles of a simplified mesh; of a round body its round surface."""
    vertices = np.asarray(body.vertices)
    if _is_drawn_round(body):
        return _round(body, vertices)
    if body.report.faces <= MOST_OUTLINED:
        return [vertices[list(face)] for face in _faces(body)]
    return list(vertices[_coarse(vertices, np.asarray(body.triangles))])


def _faces(body: Polyhedron) -> list[tuple[int, ...]]:
    """Without the dropped faces that close gaps, which have no area."""
    return body.faces[: body.report.faces]


def _is_drawn_round(body: Polyhedron) -> bool:
    """Points and segments always, because they have no faces."""
    size = float(np.linalg.norm(np.ptp(np.asarray(body.vertices), axis=0)))
    return body.radius > 0 and (body.report.segments > 0 or body.radius > LEAST_ROUND * size)


def _round(body: Polyhedron, vertices: Array) -> list[Array]:
    report = body.report
    outlines = _faces(body)
    if len(outlines) > MOST_OUTLINED:
        whole = np.asarray(body.triangles)
        whole = whole[(whole[:, 0] != whole[:, 1]) & (whole[:, 1] != whole[:, 2])]
        thin = [outline for outline in outlines if len(set(outline)) < 3]
        coarse = _coarse(vertices, whole, MOST_TRIANGLES // 4)  # each may move to both sides
        outlines = thin + [tuple(triangle) for triangle in coarse.tolist()]
    is_solid = report.solid_parts + report.inward_parts == report.parts and report.volume > 0
    return round_polygons(vertices, outlines, body.radius, MOST_TRIANGLES, is_solid=is_solid)


def _coarse(vertices: Array, triangles: npt.NDArray[np.uint32], most: int = MOST_TRIANGLES) -> npt.NDArray[np.uint32]:
    """Triangles of a simplified mesh: one vertex per cell of a grid replaces all vertices of the cell."""
    low, size = vertices.min(axis=0), np.ptp(vertices, axis=0).max()
    cells = 256
    kept = triangles
    while len(kept) > most:
        keys = np.floor((vertices - low) / size * cells).astype(np.int64)
        _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        kept = first[inverse.reshape(-1)][triangles]
        is_whole = (kept[:, 0] != kept[:, 1]) & (kept[:, 1] != kept[:, 2]) & (kept[:, 2] != kept[:, 0])
        kept = np.unique(kept[is_whole], axis=0)
        cells = cells * 3 // 4
    return kept


def _moved(polygons: list[Array], pose: npt.ArrayLike) -> list[Array]:
    matrix = np.asarray(pose)
    return [polygon @ matrix[:3, :3].T + matrix[:3, 3] for polygon in polygons]


def _extent(bodies: list[list[Array]]) -> float:
    """The diagonal of the smaller body's box."""
    return min(float(np.linalg.norm(np.ptp(np.concatenate(polygons), axis=0))) for polygons in bodies)


def _normals(polygons: list[Array]) -> Array:
    sums = [np.cross(p[1:-1] - p[0], p[2:] - p[0]).sum(axis=0) for p in polygons]
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    return np.asarray(sums) / np.where(lengths > 0, lengths, 1)


def _shaded(polygons: list[Array], colour: str) -> Array:
    from matplotlib.colors import to_rgb

    light = np.array([0.35, -0.55, 0.76])
    brightness = 0.72 + 0.28 * (_normals(polygons) @ light)
    return np.clip(brightness[:, None] * np.asarray(to_rgb(colour)), 0, 1)


def _draw_solid(axes: Axes3D, bodies: list[list[Array]], are_round: list[bool]) -> None:
    # Both bodies are one collection, because matplotlib sorts faces only within a collection.
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    polygons = [polygon for body in bodies for polygon in body]
    shades = [_shaded(body, colour) for body, colour in zip(bodies, (FIXED, MOVING), strict=True)]
    is_outlined = sum(len(body) for body, is_round in zip(bodies, are_round, strict=True) if not is_round) <= 2 * MOST_OUTLINED
    colours = np.concatenate(shades)
    edges = np.concatenate([s if is_round or not is_outlined else 0.45 * s for s, is_round in zip(shades, are_round, strict=True)])
    solid = Poly3DCollection(polygons, facecolors=colours, edgecolors=edges, linewidths=0.5, zorder=2)
    axes.add_collection3d(solid)
    _widen_limits(axes, polygons)


def _draw_ghosts(axes: Axes3D, bodies: list[list[Array]]) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    for polygons in bodies:
        axes.add_collection3d(Poly3DCollection(polygons, facecolors=MOVING, linewidths=0, alpha=0.12, zorder=1))
        _widen_limits(axes, polygons)


def _widen_limits(axes: Axes3D, polygons: list[Array]) -> None:
    """Extends the limits of the axes to the polygons, which matplotlib does not do for collections."""
    points = np.concatenate(polygons)
    axes.auto_scale_xyz(*np.stack([points.min(axis=0), points.max(axis=0)], axis=1))


def _draw_path(axes: Axes3D, moving: Polyhedron, motion: Any) -> None:
    vertices = np.asarray(moving.vertices)
    middle = np.append((vertices.min(axis=0) + vertices.max(axis=0)) / 2, 1)
    path = np.array([(motion(time) @ middle)[:3] for time in np.linspace(0, 1, SAMPLES)])
    axes.plot(*path.T, color=MOVING, linewidth=0.9, alpha=0.6, zorder=1.5)


def _draw_contacts(axes: Axes3D, found: FirstContact, extent: float) -> None:
    points = [contact.point for contact in found.contacts]
    marks = [found.inside_point if found.overlap is None else found.overlap.point]
    for point in (mark for mark in marks if mark is not None):
        axes.scatter(*np.asarray(point), color=CONTACT, marker="D", depthshade=False, zorder=11)
    if not points:
        return
    normals = np.array([contact.normal for contact in found.contacts])
    axes.scatter(*np.array(points).T, color=CONTACT, edgecolors="white", s=36, depthshade=False, zorder=11)
    axes.quiver(*np.array(points).T, *normals.T, length=0.3 * extent, color=CONTACT, linewidth=1.8, zorder=10)


def _title(found: FirstContact) -> str:
    within = f" within {found.margin:g}" if found.margin > 0 else ""
    if found.verdict == Verdict.contact:
        return f"contact{within} at time {found.time:.12g}"
    if found.verdict == Verdict.contact_at_start:
        return f"contact{within} at the start"
    if found.held:
        return "clear: the hold distance is kept, or that of the start if it is less"
    return f"clear: nothing {'comes' + within if within else 'touches'} during the whole motion"


def _label(axes: Axes3D, found: FirstContact) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.ticker import MaxNLocator

    axes.set_title(_title(found))
    labels = {"moving": MOVING, "fixed": FIXED} | ({"contact": CONTACT} if found.contacts else {})
    marks = [Line2D([], [], linestyle="", marker="o", color=colour, label=label) for label, colour in labels.items()]
    axes.legend(handles=marks, loc="upper left", frameon=False)
    axes.set(xlabel="x", ylabel="y", zlabel="z")
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_major_locator(MaxNLocator(5))
