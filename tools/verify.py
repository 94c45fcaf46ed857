#!/usr/bin/env python3
# Checks a Chasles certificate:  verify.py MOVING FIXED CERTIFICATE
#
# MOVING and FIXED are mesh files (.obj or .stl). Exit status: 0 verified; 1 not verified, with the reason on standard
# output; 2 wrong usage, or a file that cannot be read. After reading, only integers are computed with: lengths are
# multiples of one unit, a power of two that divides all lengths of the meshes and of the certificate.
import fractions, functools, hashlib, io, math, re, struct, sys

MAX_MESH, MAX_LINE, MAX_DEPTH = 1 << 28, 1 << 26, 4000   # bytes of a mesh and of a line; halvings of a cell
NAMES = ("moving", "fixed")
WHERE = {}           # what is being read: the file, the line, the step of a proof
INTEGER = re.compile(r"-?[0-9]{1,1000}")
REAL = re.compile(r"(-?)0x([0-9a-f]{1,32})(?:\.([0-9a-f]{1,32}))?p([+-]?[0-9]{1,5})")
LINE = re.compile(rb"[\t\x20-\x7e]*\r?\n?")
DECIMAL = re.compile(rb"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
OBJ_CORNER = re.compile(rb"(-?[0-9]{1,10})(/-?[0-9]+|//-?[0-9]+|/-?[0-9]+/-?[0-9]+)?")


class Refused(Exception): pass


def need(condition, reason):
    if not condition: raise Refused(reason)


# --- vectors of integers ---------------------------------------------------------------------------------------------

def sub(a, b): return a[0] - b[0], a[1] - b[1], a[2] - b[2]
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
def scale(s, a): return tuple([s * x for x in a])
def add(*vectors): return tuple(map(sum, zip(*vectors)))


# --- words -----------------------------------------------------------------------------------------------------------

# A point of a mesh file: decimal numbers become the nearest doubles.
def point(words, most):
    need(3 <= len(words) <= most and all(map(DECIMAL.fullmatch, words)), "a vertex has three decimal numbers")
    return tuple(map(float, words[:3]))


# A double of the certificate; the text has to be one exactly.
def real(word):
    need(match := REAL.fullmatch(word), f"{word!r:.50} is not a hexadecimal number")
    sign, whole, part, power = match.groups("")
    value = int(sign + whole + part, 16) * fractions.Fraction(2) ** (int(power) - 4 * len(part))
    need(abs(value) <= sys.float_info.max and value == float(value), f"{word!r:.50} is not a finite double")
    return value


def integer(word, least=-math.inf, below=math.inf):
    need(INTEGER.fullmatch(word) and least <= int(word) < below, f"{word!r:.50} is not an integer that fits")
    return int(word)


# Doubles as multiples of 1 / unit, a power of two.
def integers(values, unit): return tuple(a * (unit // b) for a, b in (x.as_integer_ratio() for x in values))


# The words of a certificate, by lines or (in a proof) one by one; row has those of the line to come, reversed.
class Reader:
    def __init__(self, file):
        WHERE.update(file="certificate", line=0)
        self.file, self.row = file, []

    # The words of the next line that has any; none at the end of the file.
    def peek(self):
        while not self.row and (raw := self.file.readline(MAX_LINE + 1)):
            WHERE["line"] += 1
            need(len(raw) <= MAX_LINE and LINE.fullmatch(raw), "the line is too long or not printable ASCII")
            self.row = raw.decode("ascii").partition("#")[0].split()[::-1]
        return self.row[::-1]

    # The words of the next line after those of head.
    def take(self, head, count):
        row, head, self.row = self.peek(), head.split(), []
        need(row[:len(head)] == head and len(row) == len(head) + count,
             f"'{' '.join(head)}' and {count} words are expected, not {' '.join(row) or 'the end':.50}")
        return row[len(head):]

    def word(self):
        need(self.row or self.peek(), "the file ends too early")
        return self.row.pop()


# --- bodies ----------------------------------------------------------------------------------------------------------

# The words of each line of a mesh file that has any.
def rows(data):
    for WHERE["line"], line in enumerate(io.BytesIO(data), 1):
        if words := line.partition(b"#")[0].split(): yield words


# Faces of an OBJ file, where a face may have vertices that follow it.
def obj_faces(data):
    points, faces = [], []
    for words in rows(re.sub(rb"\\[ \t]*\r?\n", b" ", data)):   # a line and its continuations count as one
        if words[0] == b"v": points.append(point(words[1:], 7))
        elif words[0] == b"f":
            found = [OBJ_CORNER.fullmatch(word) for word in words[1:]]
            need(len(found) >= 3 and all(found), "a face has at least three corners, each a, a/b, a//c or a/b/c")
            faces.append([int(match[1]) - 1 if int(match[1]) >= 0 else len(points) + int(match[1]) for match in found])
            need(min(faces[-1]) >= 0, "a face has a vertex that is missing")
    need(all(i < len(points) for face in faces for i in face), "a face has a vertex that is missing")
    return [[points[i] for i in face] for face in faces]


def stl_faces(data):
    if len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return [(n[3:6], n[6:9], n[9:12]) for n in struct.iter_unpack("<12fH", data[84:])]   # n[0:3] is a normal
    faces, loop = [], []
    for words in rows(data):
        key = words[0].lower()
        need(key in b"solid facet outer vertex endloop endfacet endsolid".split(), f"unknown keyword {key!r:.40}")
        if key == b"vertex": loop.append(point(words[1:], 3))
        elif loop or key == b"endloop":
            need(len(loop) == 3 and key == b"endloop", "a loop has three corners")
            faces.append(loop)
            loop = []
    need(not loop, "the file ends in a loop")
    return faces


# A face is a list of indices of corners; equal corners have one index. order and corners (integers) are set later.
class Body:
    def __init__(self, name, path):
        WHERE.update(file=name + " mesh", line=0)
        with open(path, "rb") as file: data = file.read(MAX_MESH + 1)
        need(len(data) <= MAX_MESH, "the file is too large")
        numbers, digest = {}, hashlib.sha256()
        self.name, self.solid, self.faces = name, False, []
        for face in (obj_faces if path.lower().endswith(".obj") else stl_faces)(data):
            face = [tuple([x + 0.0 for x in p]) for p in face]   # -0 becomes 0
            need(all(math.isfinite(x) for p in face for x in p), f"a number of face {len(self.faces)} is not finite")
            digest.update(struct.pack(f"<I{3 * len(face)}d", len(face), *(x for p in face for x in p)))
            self.faces.append([numbers.setdefault(p, len(numbers)) for p in face])
        need(self.faces, "there are no faces")
        self.hash, self.points = digest.hexdigest(), list(numbers)
        self.node = functools.lru_cache(maxsize=None)(lambda begin, end: [   # the different corners of a node
            self.corners[v] for v in {v for f in self.order[begin:end] for v in self.faces[f]}])

    # No face has a corner twice, so none has an edge twice or in both directions.
    def is_closed(self):
        edges, text = {}, f"the {self.name} body is no solid:"
        for f, face in enumerate(self.faces):
            need(len(set(face)) == len(face), f"{text} face {f} has a corner twice")
            for edge in zip(face, face[1:] + face[:1]):
                need(edges.setdefault(edge, f) == f, f"{text} faces {edges[edge]} and {f} have an edge in one sense")
        for (p, q), f in edges.items():
            need((q, p) in edges, f"{text} an edge of face {f} is of no other face")
        return True

    # For each corner the first one of the list of the corners of its connected part of the surface.
    def parts(self):
        part = [[v] for v in range(len(self.points))]
        for p, q in ((face[0], v) for face in self.faces for v in face):
            small, large = sorted((part[p], part[q]), key=len)
            if small is not large:
                large += small
                for v in small: part[v] = large
        return [corners[0] for corners in part]


# --- motion ----------------------------------------------------------------------------------------------------------

# With a = v / w and Q = t1 - t0, and as v x across = v x Q, the formulas of the page times w^2 are
#     w^2 W   = w^2 + tau^2 v.v
#     w^2 W p = w^2 (t0 + y) + tau (w^2 Q - w v x Q + 2 w v x y)
#             + tau^2 (v.v (t0 + y + Q) - v (v.Q) + w v x Q + 2 v x (v x y)) + tau^3 v (v.Q).
# They need no division and hold for v = 0, too. power[k] has the factors of tau^k, all times |q0|^2: three vectors for
# the coordinates of the corner, a constant vector, and a number for W; 13 integers.
class Piece:
    def __init__(self, start, end):
        (t0, (w0, *u0)), (t1, (w1, *u1)) = start, end
        w, v, q = w0 * w1 + dot(u0, u1), sub(sub(scale(w0, u1), scale(w1, u0)), cross(u1, u0)), sub(t1, t0)
        ww, vv, wvq, along = w * w, dot(v, v), scale(w, cross(v, q)), scale(dot(v, q), v)
        power = (), (), (), ()
        for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):   # y is R0 e, times |q0|^2
            y = add(scale(w0 * w0 - dot(u0, u0), e), scale(2 * dot(u0, e), u0), scale(2 * w0, cross(u0, e)))
            turned = add(scale(vv, y), scale(2, cross(v, cross(v, y))))
            power = [a + b for a, b in zip(power, (scale(ww, y), scale(2 * w, cross(v, y)), turned, (0, 0, 0)))]
        constants = ((*scale(ww, t0), ww), (*sub(scale(ww, q), wvq), 0),
                     (*sub(add(scale(vv, t0), scale(vv, q), wvq), along), vv), (*along, 0))
        power = [a + scale(w0 * w0 + dot(u0, u0), b) for a, b in zip(power, constants)]
        common = math.gcd(*(x for row in power for x in row))
        self.power = [[x // common for x in row] for row in power]

    # The factors of the powers of tau / end, times a positive number.
    def stretched(self, end):
        above, below = end.as_integer_ratio()
        return [[x * above ** k * below ** (3 - k) for x in row] for k, row in enumerate(self.power)]

    # Their sums, so what is at tau = end.
    def at(self, end): return [sum(column) for column in zip(*self.stretched(end))]

    # A function for the Bernstein coefficients, times a positive number, on cell j of 2^depth equal ones of [0, end].
    def cells(self, end):
        columns = list(zip(*self.stretched(end)))

        @functools.lru_cache(maxsize=1024)
        def cell(depth, j):
            found = []
            for c0, c1, c2, c3 in columns:   # first the powers of x - j, where the cell is [j, j + 1] of x
                c0, c1, c2 = c0 << 3 * depth, c1 << 2 * depth, c2 << depth
                c0, c1, c2 = ((c3 * j + c2) * j + c1) * j + c0, (3 * c3 * j + 2 * c2) * j + c1, 3 * c3 * j + c2
                found.append((3 * c0, 3 * c0 + c1, 3 * c0 + 2 * c1 + c2, 3 * (c0 + c1 + c2 + c3)))
            return [(row[0:3], row[3:6], row[6:9], row[9:12], row[12]) for row in zip(*found)]

        return cell


# Sets the places of all corners at tau in the frame of the fixed body, times the last of the numbers returned.
def place(piece, tau, moving, fixed):
    at = piece.at(tau)
    rows = [(at[i:9:3], at[9 + i]) for i in range(3)]
    moving.places = [tuple([dot(row, p) + constant for row, constant in rows]) for p in moving.corners]
    fixed.places = [scale(at[12], p) for p in fixed.corners]
    return at


# --- proof -----------------------------------------------------------------------------------------------------------

# Reads and checks the steps of one piece and returns their number.
def prove(reader, cell, moving, fixed, reach):
    stack, steps = [(0, len(moving.faces), 0, len(fixed.faces), 0, 0)], 0
    while stack:
        b, e, f, g, depth, j = stack.pop()   # the nodes [b, e) and [f, g), and cell j of 2^depth
        word, steps = reader.word(), steps + 1
        WHERE["step"] = steps
        if word == "P":
            n = nx, ny, nz = [integer(reader.word()) for _ in range(3)]
            need(any(n), "the normal is 0")
            root = math.isqrt(dot(n, n) - 1) + 1   # rounded up
            top = max([nx * x + ny * y + nz * z for x, y, z in fixed.node(f, g)]) + root * reach
            for ex, ey, ez, constant, weight in cell(depth, j):
                nx, ny, nz = dot(n, ex), dot(n, ey), dot(n, ez)
                least = min([nx * x + ny * y + nz * z for x, y, z in moving.node(b, e)]) + dot(n, constant)
                need(least > top * weight, "the plane does not separate")
        elif word == "T" and depth < MAX_DEPTH: stack += [(b, e, f, g, depth + 1, 2 * j + half) for half in (1, 0)]
        elif word == "A" and e - b > 1: stack += ((b + e) // 2, e, f, g, depth, j), (b, (b + e) // 2, f, g, depth, j)
        elif word == "B" and g - f > 1: stack += (b, e, (f + g) // 2, g, depth, j), (b, e, f, (f + g) // 2, depth, j)
        else: raise Refused("the certificate is incomplete" if word == "?" else f"{word!r:.50} is not possible here")
    need(not reader.row, "words after the end of the proof")
    del WHERE["step"]
    return steps


# --- who is inside of whom -------------------------------------------------------------------------------------------

# How often the surface of the body winds around the start of the ray.
def winding(body, start, ray):
    points = [sub(p, start) for p in body.places]
    need(any(ray), "the direction is 0")
    i, j, k = next((i, j, k) for i, j, k in ((1, 2, 0), (2, 0, 1), (0, 1, 2)) if ray[k])
    flat = [(ray[k] * p[i] - ray[i] * p[k], ray[k] * p[j] - ray[j] * p[k]) for p in points]   # seen along the ray
    count = 0
    for face in body.faces:
        for b, c in zip(face[1:], face[2:]):
            (ax, ay), (bx, by), (cx, cy) = flat[face[0]], flat[b], flat[c]
            areas = ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax   # ray[k] times ray . (a x b) and so on
            if min(areas) < 0 < max(areas): continue   # the line of the ray passes by
            need(any(areas), "the ray is in one plane with a triangle")
            height = dot(points[face[0]], cross(points[b], points[c]))   # point . normal
            leaves = (sum(areas) > 0) == (ray[k] > 0)   # the sum is ray[k] times ray . normal
            if height and (height > 0) != leaves: continue   # the triangle is behind the start
            need(height and all(areas), "the ray meets the edge of a triangle, or starts on one")
            count += 1 if leaves else -1
    return count


# The body called so, the other one, and corner c of face f with the next one.
def find_edge(bodies, name, f, c):
    need(name in NAMES, f"{name!r:.50} is neither 'moving' nor 'fixed'")
    body, other = bodies if name == "moving" else bodies[::-1]
    face = body.faces[integer(f, 0, len(body.faces))]
    c = integer(c, 0, len(face))
    return body, other, face[c], face[(c + 1) % len(face)]


# How often the other body winds around a corner; the places and at are of tau = 0 of piece 0.
def winding_at_start(bodies, at, name, f, c, *ray):
    body, other, corner, _ = find_edge(bodies, name, f, c)
    need(other.solid, f"the {other.name} body is no solid")
    ray = list(map(integer, ray))
    if name == "fixed": ray = [dot(at[i:9:3], ray) for i in range(3)]   # turned like the moving body
    return winding(other, body.places[corner], ray), body, corner


def check_outside(reader, bodies, at):
    parts, found = {body.name: body.parts() for body in bodies}, set()
    while reader.peek()[:1] == ["outside"]:
        count, body, corner = winding_at_start(bodies, at, *reader.take("outside", 6))
        need(count <= 0, "the corner is inside of the other body")
        found.add((body.name, parts[body.name][corner]))
    for body, other in zip(bodies, bodies[::-1]):
        for f, face in enumerate(body.faces if other.solid else ()):
            need((body.name, parts[body.name][face[0]]) in found, f"no 'outside {body.name}' for the part of face {f}")


# --- witness ---------------------------------------------------------------------------------------------------------

# Places of the corners of face f, which has to be convex. If the areas of its fan cancel (normal 0), it is not.
def convex(body, f):
    points = [body.places[v] for v in body.faces[integer(f, 0, len(body.faces))]]
    edges = [sub(q, p) for p, q in zip(points, points[1:] + points[:1])]
    fan = [cross(sub(p, points[0]), sub(q, points[0])) for p, q in zip(points[1:], points[2:])]
    normal, turns = add(*fan), [cross(p, q) for p, q in zip(edges, edges[1:] + edges[:1])]
    need(all(dot(normal, x) >= 0 for x in fan + turns) and (any(normal) or not any(map(any, fan))),
         "the face of the witness is not convex")
    return points


# The point (U a + V b + W c) / (U + V + W) of face f as its numerator and denominator.
def weighted(body, f, i, j, k, *weights):
    points, weights = convex(body, f), [integer(word, 0) for word in weights]
    i, j, k = (integer(word, 0, len(points)) for word in (i, j, k))
    need(i == 0 < j and k == j + 1 and any(weights), "corners other than 0, k, k + 1, or all weights are 0")
    return add(*map(scale, weights, (points[0], points[j], points[k]))), sum(weights)


def check_witness(reader, bodies, piece, verdict, lower, upper, reach):
    kind = "".join(reader.peek()[1:2])
    need(kind in ("cross", "near") or (kind, verdict) == ("inside", "start"), "a witness that fits is expected here")
    tau, *words = reader.take("witness " + kind, {"cross": 6, "near": 15, "inside": 6}[kind])
    if kind == "inside":
        count = winding_at_start(bodies, place(piece, 0, *bodies), tau, *words)[0]   # the first word is no tau
        return need(count > 0, "the corner of the witness is not inside of the other body")
    need(lower <= real(tau) <= upper, "TAU of the witness does not fit the verdict")
    unit = place(piece, real(tau), *bodies)[12]
    if kind == "cross":
        body, other, p, q = find_edge(bodies, *words[:3])
        p, q, points = body.places[p], body.places[q], convex(other, words[3])
        k = integer(words[4], 1, len(points) - 1)
        triangle = points[0], points[k], points[k + 1]
        normal = cross(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0]))
        sp, sq = dot(normal, sub(p, triangle[0])), dot(normal, sub(q, triangle[0]))
        # sp = sq = 0 if the triangle has no area, or the edge is in its plane
        need(sp * sq <= 0 and sp != sq, "the edge of the witness does not cross the plane of the triangle")
        unit, meet = abs(sp - sq), add(scale(abs(sq), p), scale(abs(sp), q))   # they meet at meet / unit
        sides = [cross(sub(b, a), sub(meet, scale(unit, a))) for a, b in zip(triangle, triangle[1:] + triangle[:1])]
        return need(all(dot(normal, x) >= 0 for x in sides), "the edge of the witness passes beside the triangle")
    (p, sp), (q, sq) = weighted(bodies[0], *words[:7]), weighted(bodies[1], *words[7:])
    gap = sub(scale(sq, p), scale(sp, q))
    need(dot(gap, gap) <= (reach * unit * sp * sq) ** 2, "the points of the witness are too far apart")


# --- certificate -----------------------------------------------------------------------------------------------------

# Reads and checks a certificate and returns the lines that say what is proven.
def check(reader, bodies):
    reader.take("chasles certificate 1", 0)
    for body in bodies:
        words = [body.hash, str(len(body.faces))]
        need(reader.take(body.name, 2) == words, f"the mesh file has the hash {words[0]} and {words[1]} faces")
    solid = reader.take("solid", 1)[0]
    need(solid in NAMES + ("both", "none"), f"unknown word {solid!r:.50}")
    for body in bodies: body.solid = solid in (body.name, "both") and body.is_closed()
    lengths = [real(word) for word in reader.take("radius", 2) + reader.take("margin", 1)]
    need(min(lengths) >= 0, "a radius or the margin is below 0")
    count, poses = 1 + integer(reader.take("motion screw", 1)[0], 1), []
    while len(poses) < count:
        poses.append([real(word) for word in reader.take("pose", 7)])
        need(any(poses[-1][3:]), "the quaternion is 0")
        need(sum(x * y for x, y in zip(poses[max(0, len(poses) - 2)][3:], poses[-1][3:])), "the piece is half a turn")
    verdict, *words = reader.take("verdict", max(1, len(reader.peek()) - 1))
    need((verdict, len(words)) in (("clear", 0), ("contact", 3), ("start", 0)), "unknown verdict")
    end, lower, upper = (0, 0, 0) if verdict == "start" else (count - 2, 1, 1)   # the last piece that matters
    if verdict == "contact":
        end, lower, upper = integer(words[0], 0, count - 1), real(words[1]), real(words[2])
        need(0 <= lower <= upper <= 1, "0 <= LOWER <= UPPER <= 1 does not hold")

    # From here on all lengths are integers.
    doubles = (lengths, *(row[:3] for row in poses), *(p for body in bodies for p in body.points))
    unit = max(x.as_integer_ratio()[1] for row in doubles for x in row)
    reach, steps = sum(integers(lengths, unit)), 0
    for body in bodies: body.corners = [integers(p, unit) for p in body.points]
    # The quaternions are integers, too, as their lengths do not matter.
    frames = [(integers(row[:3], unit), integers(row[3:], max(x.denominator for x in row[3:]))) for row in poses]
    if verdict != "start":
        for body in bodies:
            body.order = list(map(integer, reader.take("order " + body.name, len(body.faces))))
            need(sorted(body.order) == list(range(len(body.faces))), "the order is no permutation of the faces")
        check_outside(reader, bodies, place(Piece(*frames[:2]), 0, *bodies))
        for i in range(end + 1):
            reader.take(f"proof {i}", 0)
            steps += prove(reader, Piece(*frames[i:i + 2]).cells(lower if i == end else 1), *bodies, reach)
    if verdict != "clear":
        check_witness(reader, bodies, Piece(*frames[end:end + 2]), verdict, lower, upper, reach)
    need(not reader.peek(), "nothing more is expected")
    if verdict == "contact": verdict += f" in piece {end}, not up to tau {float(lower)}, but up to tau {float(upper)}"
    rows = {"margin": lengths[2:], "radii": lengths[:2], "first pose": poses[0], "last pose": poses[-1]}
    texts = [f"{name}: {' '.join(str(float(x)) for x in row)}" for name, row in rows.items()]
    return [f"verdict: {verdict}", *texts, f"solid: {solid}", f"pieces: {count - 1}", f"steps: {steps}"]


# The exit status, and what to print.
def main(paths):
    if len(paths) != 3 or not all(path.lower().endswith((".obj", ".stl")) for path in paths[:2]):
        return 2, "usage: verify.py MOVING FIXED CERTIFICATE (MOVING and FIXED are .obj or .stl files)"
    try:
        WHERE.clear()
        bodies = [Body(name, path) for name, path in zip(NAMES, paths)]
        with open(paths[2], "rb") as file:
            return 0, "\n".join(["verified", *check(Reader(file), bodies)])
    except OSError as error:
        return 2, f"cannot be read: {error}"
    except Exception as error:   # whatever is not proven is refused, even if it is too large for this program
        reason = str(error) if isinstance(error, Refused) else f"the program failed ({type(error).__name__})"
        return 1, f"not verified: {', '.join(f'{key} {value}' for key, value in WHERE.items())}: {reason}"


if __name__ == "__main__":
    status, text = main(sys.argv[1:])
    print(text)
    sys.exit(status)
