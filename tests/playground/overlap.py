"""Do two surfaces of triangles cross each other? In floating point, without any code of the library.

Two closed surfaces that are apart at a start and cross nowhere on sampled poses have not gone into each other there. Gaps are a
thousand times larger than the rounding here.
"""


def sub(a: tuple, b: tuple) -> tuple:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: tuple, b: tuple) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: tuple, b: tuple) -> tuple:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def moved(pose: list, point: tuple) -> tuple:
    """The point carried by a pose x y z qw qx qy qz."""
    w, axis = pose[3], tuple(pose[4:])
    twice = tuple(2 * part for part in cross(axis, point))
    turned = cross(axis, twice)
    return tuple(point[i] + w * twice[i] + turned[i] + pose[i] for i in range(3))


def mesh_in(obj: str) -> tuple:
    """Vertices, and triangles that fan out from the first corner of each convex face."""
    vertices, triangles = [], []
    for line in obj.splitlines():
        kind, *words = line.split()
        if kind == "v":
            vertices.append(tuple(float(word) for word in words))
        elif kind == "f":
            corners = [int(word) - 1 for word in words]
            triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return vertices, triangles


def crosses(a: tuple, b: tuple, corners: list) -> bool:
    """Does the segment from a to b go through the triangle?"""
    first, second = sub(corners[1], corners[0]), sub(corners[2], corners[0])
    normal = cross(first, second)
    before, after = dot(normal, sub(a, corners[0])), dot(normal, sub(b, corners[0]))
    if before * after >= 0:
        return False
    share = before / (before - after)
    place = tuple(a[i] + share * (b[i] - a[i]) for i in range(3))
    return all(dot(normal, cross(sub(corners[(k + 1) % 3], corners[k]), sub(place, corners[k]))) >= 0 for k in range(3))


def box(points: list) -> list:
    return [(min(axis), max(axis)) for axis in zip(*points)]


def boxes_meet(a: list, b: list) -> bool:
    return all(low <= other_high and other_low <= high for (low, high), (other_low, other_high) in zip(a, b))


def edges_of(triangles: list) -> set:
    return {(min(a, b), max(a, b)) for triangle in triangles for a, b in zip(triangle, triangle[1:] + triangle[:1])}


def do_cross(one: tuple, other: tuple) -> bool:
    """Does an edge of either mesh go through a triangle of the other one?"""
    whole = [box(mesh[0]) for mesh in (one, other)]
    for (vertices, triangles), (other_vertices, other_triangles), its_box in [(one, other, whole[1]), (other, one, whole[0])]:
        near = [
            (ends, box(ends)) for ends in ([vertices[i] for i in edge] for edge in edges_of(triangles)) if boxes_meet(box(ends), its_box)
        ]
        for triangle in other_triangles:
            corners = [other_vertices[i] for i in triangle]
            around = box(corners)
            for (a, b), edge_box in near:
                if boxes_meet(edge_box, around) and crosses(a, b, corners):
                    return True
    return False
