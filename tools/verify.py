#!/usr/bin/env python3
# Checks a Chasles certificate:  verify.py MESH [MESH ...] CERTIFICATE
#
# The meshes (.obj or .stl) of a pair are two: those of the moving and of the fixed body. Of a scene they are all that
# differ, once each, in any order. Exit status: 0 verified; 1 not verified, with the reason on standard output; 2 wrong
# usage, or a file that cannot be read. After reading, only integers are computed with: lengths are multiples of one
# unit, a power of two that divides all lengths of two bodies and of their motion. What is no fraction (in sweeps and
# chains) is rounded, with a bound of the error that goes through to all conditions.
import fractions, functools, hashlib, io, itertools, math, re, struct, sys

MAX_MESH, MAX_LINE, MAX_DEPTH = 1 << 28, 1 << 26, 4000   # bytes of a mesh and of a line; halvings of a cell
BITS = 192           # enclosures are narrower than 2^-BITS of the largest number, times a small one
LINKS = {"pose": (7, 0), "slide": (3, 1), "turn": (3, 1), "velocity": (3, 7), "twist": (0, 7)}   # numbers: link, knot
ZERO, AXES = (0, 0, 0), ((1, 0, 0), (0, 1, 0), (0, 0, 1))
NAMES = ("moving", "fixed")
WHERE = {}           # what is being read: the file, the line, the step of a proof
INTEGER = re.compile(r"0|-?[1-9][0-9]{0,999}")
REAL = re.compile(r"(-?)0x([0-9a-f]{1,32})(?:\.([0-9a-f]{1,32}))?p([+-]?[0-9]{1,5})")
LINE = re.compile(rb"[\t\x20-\x7e]*\r?\n?")
DECIMAL = re.compile(rb"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
OBJ_CORNER = re.compile(rb"([+-]?[0-9]{1,10})(/-?[0-9]+|//-?[0-9]+|/-?[0-9]+/-?[0-9]+)?")


class Refused(Exception): pass


def need(condition, reason):
    if not condition: raise Refused(reason)


# --- vectors of integers ---------------------------------------------------------------------------------------------

def sub(a, b): return a[0] - b[0], a[1] - b[1], a[2] - b[2]
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
def add(a, b): return a[0] + b[0], a[1] + b[1], a[2] + b[2]
def scale(s, a): return s * a[0], s * a[1], s * a[2]
def floor(a, divisor): return a[0] // divisor, a[1] // divisor, a[2] // divisor
def total(a): return sum(map(abs, a))   # at least the length of a


# --- quaternions (w, x, y, z), whose length does not matter ----------------------------------------------------------

def norm(q): return sum([x * x for x in q])
def conjugate(q): return q[0], -q[1], -q[2], -q[3]


def product(p, q):
    (a, *u), (b, *v) = p, q
    return a * b - dot(u, v), *add(add(scale(a, v), scale(b, u)), cross(u, v))


# The vector q b q^-1, times norm(q).
def rotate(q, b):
    w, u = q[0], q[1:]
    return add(add(scale(w * w - dot(u, u), b), scale(2 * dot(u, b), u)), scale(2 * w, cross(u, b)))


# The scalar part, which is not below 0, and the vector part of q1 q0^-1, both times norm(q0).
def relative(q0, q1):
    w, *v = product(q1, conjugate(q0))
    return (w, tuple(v)) if w >= 0 else (-w, scale(-1, v))


# --- enclosures ------------------------------------------------------------------------------------------------------

# All numbers from low to high. A comparison is true if it is for all of them.
class Interval:
    def __init__(self, low, high): self.low, self.high = low, high
    def __add__(self, other): return Interval(self.low + ends(other)[0], self.high + ends(other)[1])
    def __sub__(self, other): return Interval(self.low - ends(other)[1], self.high - ends(other)[0])
    def __ge__(self, other): return self.low >= ends(other)[1]
    def __le__(self, other): return self.high <= ends(other)[0]
    def __mul__(self, other): return hull([x * y for x in ends(self) for y in ends(other)])
    __rmul__ = __mul__


def hull(numbers): return Interval(min(numbers), max(numbers))
def ends(x): return (x.low, x.high) if isinstance(x, Interval) else (x, x)


# The cosine and the sine of angle / 2^bits, times 2^bits, each less than 2 too small or too great: by the series for
# the angle / 2^j, which is below 1/256, whose result z is squared j times. In units of 2^-q: the n terms have errors
# below 2, and the rest of the series is below 1. An error e of z, which is on the unit circle, becomes less than
# e (2 + e / 2^q) + 2 < 2 e + 3. In the end it is less than 2^j (2 n + 4), so below 1 in units of 2^-bits.
def cos_sin(angle, bits):
    j = max(0, angle.bit_length() - bits + 8)
    need(j < 72, "an angle is too large")
    q, t, z, term = bits + j + 24, angle << 24, [0, 0], 1 << bits + j + 24
    for k in range(q // 8 + 1):   # term is t^k / k!
        z[k % 2] += term if k % 4 < 2 else -term
        term = term * t // (k + 1 << q)
    for _ in range(j): z = (z[0] * z[0] - z[1] * z[1]) >> q, 2 * z[0] * z[1] >> q
    return z[0] >> j + 24, z[1] >> j + 24


# The angle 2 atan2(vv^(1/2), w), where w > 0, times 2^bits, less than 2 too small or too great. The angle of the
# complex number w + i s is halved when the absolute value N is added to w. In units of 2^-q: s is less than 1 too
# small, an error e of w becomes less than 2 e + 2, in the end 2^9, and then w > 2^7 N and N >= 1, so the 256-fold angle
# has an error below 2^4. t = s / w is below 2^-7. The series of the arc tangent alternates, so its rest is less than
# the first term that is left out, so 1; each of the n terms has an error below 3, all of them below 2^8 (3 n + 2).
def double_angle(w, vv, bits):
    q = bits + 32
    w, s = w << q, math.isqrt(vv << 2 * q)
    for _ in range(8): w += math.isqrt(w * w + s * s)
    power, result = (t := (s << q) // w), 0
    for k in range(1, q // 7 + 2, 2):   # power is t^k
        result += power // k if k % 4 == 1 else -(power // k)
        power = power * t * t >> 2 * q
    return result >> 23   # 2 times 2^8 / 2^32


# The unit vector along v, times 2^bits; each number less than 2 too small or great. Of root, which is at least
# 2^(bits + 2), less than 1 is missing; that makes less than 1/4.
def direction(v, bits):
    return floor(scale(1 << 2 * bits + 2, v), math.isqrt(norm(v) << 2 * bits + 4))   # the divisor is root


# --- words -----------------------------------------------------------------------------------------------------------

# A point of a mesh file: decimal numbers become the nearest doubles.
def point(words, most):
    need(3 <= len(words) <= most and all(map(DECIMAL.fullmatch, words)), "a vertex has three decimal numbers")
    return tuple(map(float, words[:3]))


# A double of the certificate; the text has to be one exactly.
def real(word):
    need(match := REAL.fullmatch(word), f"{word!r:.50} is not a hexadecimal number")
    sign, whole, part, power = match.groups("")
    number, power = int(sign + whole + part, 16), int(power) - 4 * len(part)
    value = fractions.Fraction(number << max(0, power), 1 << max(0, -power))
    need(abs(value.numerator) <= int(sys.float_info.max) * value.denominator
         and float(value).as_integer_ratio() == value.as_integer_ratio(), f"{word!r:.50} is not a finite double")
    return value


def integer(word, least=-math.inf, below=math.inf):
    need(INTEGER.fullmatch(word) and least <= int(word) < below, f"{word!r:.50} is not an integer that fits")
    return int(word)


# The quaternion of a pose as integers.
def quaternion(numbers):
    q = integers(numbers[3:7], max(x.denominator for x in numbers[3:7]))
    need(any(q), "the quaternion is 0")
    return q


# Doubles as multiples of 1 / unit, a power of two; and the least unit that does.
def integers(values, unit): return tuple(a * (unit // b) for a, b in (x.as_integer_ratio() for x in values))
def finest(values): return max((x.as_integer_ratio()[1] for x in values), default=1)


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

# The words of each line of a mesh file that has any; a mark of the byte order is none.
def rows(data):
    data = data.removeprefix(b"\xef\xbb\xbf")
    if b"\n" not in data: data = data.replace(b"\r", b"\n")
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


# A face is a list of indices of corners; equal corners have one index.
class Mesh:
    def __init__(self, name, path):
        WHERE.update(file=name, line=0)
        with open(path, "rb") as file: data = file.read(MAX_MESH + 1)
        need(len(data) <= MAX_MESH, "the file is too large")
        numbers, digest = {}, hashlib.sha256()
        self.path, self.faces = path, []
        for face in (obj_faces if path.lower().endswith(".obj") else stl_faces)(data):
            face = [tuple([x + 0.0 for x in p]) for p in face]   # -0 becomes 0
            need(all(math.isfinite(x) for p in face for x in p), f"a number of face {len(self.faces)} is not finite")
            digest.update(struct.pack(f"<I{3 * len(face)}d", len(face), *(x for p in face for x in p)))
            self.faces.append([numbers.setdefault(p, len(numbers)) for p in face])
        need(self.faces, "there are no faces")
        self.hash, self.points = digest.hexdigest(), list(numbers)
        numbers = [x for p in self.points for x in p]
        self.finest, self.largest = finest(numbers), max(map(abs, numbers))
        self.integers = functools.lru_cache(maxsize=4)(lambda unit: [integers(p, unit) for p in self.points])

    # Why this is no solid, or nothing. No face has a corner twice, so none has an edge twice or in both directions.
    @functools.cached_property
    def flaw(self):
        edges = {}
        for f, face in enumerate(self.faces):
            if len(set(face)) < len(face): return f"face {f} has a corner twice"
            for edge in zip(face, face[1:] + face[:1]):
                if edges.setdefault(edge, f) != f: return f"faces {edges[edge]} and {f} have an edge in one sense"
        for (p, q), f in edges.items():
            if (q, p) not in edges: return f"an edge of face {f} is of no other face"
        return ""

    # For each corner the first one of the list of the corners of its connected part of the surface.
    @functools.cached_property
    def parts(self):
        part = [[v] for v in range(len(self.points))]
        for p, q in ((face[0], v) for face in self.faces for v in face):
            small, large = sorted((part[p], part[q]), key=len)
            if small is not large:
                large += small
                for v in small: part[v] = large
        return [corners[0] for corners in part]


# Several bodies may have one mesh. finest: the least unit.
class Body:
    def __init__(self, text, mesh, solid):
        need(not (solid and mesh.flaw), f"{text} is no solid: {mesh.flaw}")
        self.mesh, self.faces, self.solid, self.unit, self.finest = mesh, mesh.faces, solid, 0, mesh.finest
        self.indices = functools.lru_cache(maxsize=None)(lambda begin, end: [   # of the different corners of a node
            *{v for f in self.order[begin:end] for v in self.faces[f]}])
        self.node = functools.lru_cache(maxsize=None)(lambda begin, end: [   # these corners
            self.corners[v] for v in self.indices(begin, end)])

    def read_order(self, reader, head):
        self.order = list(map(integer, reader.take(head, len(self.faces))))
        need(sorted(self.order) == list(range(len(self.faces))), "the order is no permutation of the faces")

    # The corners become integers. size is at least the length of each, also of those of a box around them.
    def fit(self, name, unit):
        self.name = name
        if unit != self.unit:
            self.unit, self.corners = unit, self.mesh.integers(unit)
            self.size = total([max(map(abs, x)) for x in zip(*self.corners)])
            self.node.cache_clear()


# Makes two bodies the moving and the fixed one, and returns a unit that divides their lengths and the numbers. For
# chains it is a small one, so that lengths may be rounded.
def fit(bodies, numbers, rounded):
    unit = max(finest(numbers), *(body.finest for body in bodies))
    if rounded:
        largest, = integers([max(body.mesh.largest for body in bodies)], unit)
        unit <<= max(0, BITS - largest.bit_length())
    for body, name in zip(bodies, NAMES): body.fit(name, unit)
    return unit


# --- screws and sweeps -----------------------------------------------------------------------------------------------

# Of a motion: count is the number of pieces, texts say what it is.
class Rigid:
    def __init__(self, reader, kind):
        self.count, self.knots = integer(reader.take("motion " + kind, 1)[0], 1), []
        self.centre = [real(word) for word in reader.take("centre", 3)] if kind == "sweep" else []
        size = 14 if len(reader.peek()) == 15 else 7
        while len(self.knots) <= self.count:
            row = [real(word) for word in reader.take("pose", size)] + [0, 0, 0, 1, 0, 0, 0][:14 - size]
            moving, fixed = quaternion(row), quaternion(row[7:])
            self.knots.append((row, fixed, product(conjugate(fixed), moving)))
            need(relative(self.knots[-2:][0][2], self.knots[-1][2])[0], "the piece is half a turn")
        self.texts = [f"motion: {kind} {'about ' * bool(self.centre)}{shown(self.centre)}".strip(),
                      *(f"{name} pose: {shown(self.knots[i][0][:size])}" for name, i in (("first", 0), ("last", -1)))]

    # All lengths.
    def numbers(self): return [x for row, *_ in self.knots for x in row[:3] + row[7:10]] + self.centre

    # Knot i as seen from the fixed body: the position, times a number, that number, and the quaternion.
    def knot(self, i, unit):
        row, fixed, q = self.knots[i]
        return rotate(conjugate(fixed), sub(integers(row[:3], unit), integers(row[7:10], unit))), norm(fixed), q

    def piece(self, i, unit, _): return Piece(self.knot(i, unit), self.knot(i + 1, unit), integers(self.centre, unit))


# What a screw or twist (no centre), a sweep or a velocity is from one pose (t / d, q) to the next: w, v, a number, and
# times that number t0, way and c, so that the motion takes b to t0 + c + tau way + S (R0 b - c), where S is a rotation
# about v. For a centre C, c is R0 C. Otherwise it is on the axis, c = (Q - v (v.Q) / v.v + w (v x Q) / v.v) / 2 with
# Q = t1 - t0, as v x across = v x Q (so m of the page is -a x c), and way is along.
def course(start, end, centre):
    (t0, d0, q0), (t1, d1, q1) = start, end
    (w, v), n0, n1 = relative(q0, q1), norm(q0), norm(q1)
    vv = dot(v, v)
    unit = d0 * d1 * n0 * (n1 if centre else 2 * (vv or 1))
    t0, q = scale(unit // d0, t0), sub(scale(unit // d1, t1), scale(unit // d0, t0))
    if centre:
        c = scale(unit // n0, rotate(q0, centre))
        return w, v, unit, t0, add(q, sub(scale(unit // n1, rotate(q1, centre)), c)), c
    along = floor(scale(dot(v, q), v), vv) if vv else q   # all divisions are without a remainder
    return w, v, unit, t0, along, floor(add(sub(q, along), floor(scale(w, cross(v, q)), vv or 1)), 2)


# The polynomials W p and W of a screw or sweep as matrices: row k has the factors of tau^k, times a positive number:
# three vectors for the coordinates of the corner, a constant vector, and a number for W; 13 integers. With z = R0 b,
#       W p = W (t0 + c + tau way) + f(z) - f(c)
# - Screw, both times w^2:   W = w^2 + tau^2 v.v
#                            f(z) = w^2 z + tau 2 w v x z + tau^2 (v.v z + 2 v x (v x z))
# - Sweep, with M = N^2 = w^2 + v.v and u = 2 (N w - M):   W = M + tau u - tau^2 u
#                            f(z) = M z + tau (u z + 2 N v x z) + tau^2 (-u z + 2 (w - N) v x z + 2 v x (v x z))
#   This is linear in N, and so is each condition on W p and W. So it holds if it does for both ends of the enclosure of
#   N: there are two matrices, unless N is an integer.
class Piece:
    def __init__(self, start, end, centre):
        # The length of q1 does not matter: for a sweep it makes N at least 2^(BITS - 1).
        if centre: end = *end[:2], [x << max(0, BITS - norm(end[2]).bit_length() // 2) for x in end[2]]
        w, v, unit, t0, way, c = course(start, end, centre)
        m, n0, self.matrices = w * w + dot(v, v), norm(start[2]), []
        least, kinds = math.isqrt(m), [((w * w, 0, dot(v, v), 0), (0, 2 * w, 0))]   # screw: factors of W, of v x z
        if centre:
            kinds = [((m, 2 * (n * w - m), 2 * (m - n * w), 0), (0, 2 * n, 2 * (w - n)))
                     for n in range(least, least + 1 + (least * least < m))]
        for weights, turns in kinds:
            columns = [powers(scale(unit // n0, rotate(start[2], e)), v, weights, turns) for e in AXES]
            moved = [add(scale(x, add(t0, c)), scale(y, way)) for x, y in zip(weights, (0, *weights))]
            rows = [(*x, *y, *z, *sub(a, b), unit * weight)
                    for x, y, z, a, b, weight in zip(*columns, moved, powers(c, v, weights, turns), weights)]
            common = math.gcd(*(x for row in rows for x in row))
            self.matrices.append([[x // common for x in row] for row in rows])

    # Sets the places of all corners at tau in the frame of the fixed body, and returns: a number that they are times
    # of; how much their coordinates may be too small or too great; the rotation (of any length), and its error.
    # A coordinate is a quotient of linear functions of N with a positive divisor, so it is between those of both ends.
    def place(self, tau, moving, fixed):
        found = [[sum(column) for column in zip(*stretched(rows, tau))] for rows in self.matrices]
        unit = math.prod(row[12] for row in found)
        maps = [[(scale(unit // row[12], row[i:9:3]), unit // row[12] * row[9 + i]) for i in range(3)] for row in found]
        sides = [[tuple([dot(row, p) + constant for row, constant in rows]) for p in moving.corners] for rows in maps]
        moving.places, fixed.places = sides[0], [scale(unit, p) for p in fixed.corners]
        error = max([abs(x) for p, q in zip(*sides) for x in sub(p, q)]) if sides[1:] else 0
        return unit, error, [row for row, _ in maps[0]], 0   # the rotation is asked for only at tau = 0: exact

    # A function that refuses a plane that is not below all corners on cell j of 2^depth equal ones of [0, end].
    def plane_test(self, end):
        columns = [column for rows in self.matrices for column in zip(*stretched(rows, end))]

        @functools.lru_cache(maxsize=1024)
        def cell(depth, j):   # the Bernstein coefficients, times a positive number
            found = []
            for c0, c1, c2, c3 in columns:   # first the powers of x - j, where the cell is [j, j + 1] of x
                c0, c1, c2 = c0 << 3 * depth, c1 << 2 * depth, c2 << depth
                c0, c1, c2 = ((c3 * j + c2) * j + c1) * j + c0, (3 * c3 * j + 2 * c2) * j + c1, 3 * c3 * j + c2
                found.append((3 * c0, 3 * c0 + c1, 3 * c0 + 2 * c1 + c2, 3 * (c0 + c1 + c2 + c3)))
            return [(row[0:3], row[3:6], row[6:9], row[9:12], row[12])
                    for k in range(0, len(found), 13) for row in zip(*found[k:k + 13])]

        def test(n, root, top, corners, depth, j):
            for ex, ey, ez, constant, weight in cell(depth, j):
                nx, ny, nz = dot(n, ex), dot(n, ey), dot(n, ez)
                least = min([nx * x + ny * y + nz * z for x, y, z in corners]) + dot(n, constant)
                need(least > top * weight, "the plane does not separate")

        return test


# The factors of the powers of tau in f(z).
def powers(z, v, weights, turns):
    turned = cross(v, z)
    first, second, third = [add(scale(x, z), scale(y, turned)) for x, y in zip(weights, turns)]
    return first, second, add(third, scale(2, cross(v, turned))), ZERO


# The factors of the powers of tau / end, times a positive number.
def stretched(rows, end):
    above, below = end.as_integer_ratio()
    return [[x * above ** k * below ** (3 - k) for x in row] for k, row in enumerate(rows)]


# --- chains ----------------------------------------------------------------------------------------------------------

# A link is a tuple: back, kind, its numbers, and those at each knot (if the chain has any). The outermost is the first.
class Chain:
    def __init__(self, count, links, texts=()):
        self.count, self.links, self.texts = count, links, ["motion: chain", *texts]

    # All lengths, in no order.
    def numbers(self): return [x for _, _, numbers, knots in self.links for row in (numbers, *knots) for x in row]

    def piece(self, i, unit, bodies):
        links = [(back, kind, *(integers(x, unit) for x in (numbers, *(knots[i:i + 2] or ((), ())))))
                 for back, kind, numbers, knots in self.links]
        return ChainPiece(links, unit, bodies[0].size)


# Reads the links of a chain. Links of the same numbers (those of known) become one object.
def read_chain(reader, count, size, known, pair=True):
    heads, rows, texts, width = [], [], [], 0
    while len(heads) < size:
        words = reader.take("link", max(1, len(reader.peek()) - 1))
        back = words[0] == "back"
        kind, numbers = "".join(words[back:back + 1]), [real(word) for word in words[back + 1:]]
        need(kind in LINKS and len(numbers) == LINKS[kind][0], "unknown link, or a wrong count of its numbers")
        need(kind != "turn" or any(numbers), "the axis is 0")
        if kind == "pose": quaternion(numbers)
        texts.append(f"link: {'back ' * back}{kind} {shown(numbers)}".strip())
        heads.append((back, kind, numbers, slice(width, width + LINKS[kind][1])))
        width += LINKS[kind][1]
    while len(rows) <= count and (pair or width):   # in a pair, poses alone have knots without numbers
        row = [real(word) for word in reader.take("knot", width)]
        if len(rows) in (0, count): texts.append(f"knot {len(rows)}: {shown(row)}".strip())
        rows.append(row)
        for _, kind, _, part in heads:
            if LINKS[kind][1] == 7:   # the first knot with itself
                start, end = (quaternion(numbers[part]) for numbers in (rows[-2:][0], rows[-1]))
                need(relative(start, end)[0], "the piece is half a turn")
    links = [known.setdefault((back, kind, *numbers, *(x for row in rows for x in row[part])),
                              (back, kind, numbers, [row[part] for row in rows]))
             for back, kind, numbers, part in heads]
    return Chain(count, links, texts)


# The motion of a body that moves by the first chain as seen from one that moves by the second.
def seen_from(chain, other):
    common = sum(1 for _ in itertools.takewhile(lambda links: links[0] is links[1], zip(chain.links, other.links)))
    links = [(not back, *rest) for back, *rest in reversed(other.links[common:])] + chain.links[common:]
    return Chain(chain.count, links or [(False, "pose", (0, 0, 0, 1, 0, 0, 0), ())])


# A vector is a pair (x, e): the true vector is within e of the integers x. Lengths are integers as they are; numbers
# without a unit (and vectors of them) are multiples of 2^-bits. Each rounding down of a vector adds less than 2 to e.
class ChainPiece:
    def __init__(self, links, unit, size):
        self.unit, self.size, self.bits = unit, size, BITS   # size: at least the length of each corner
        for w, v in (relative(start[3:], end[3:]) for _, kind, _, start, end in links if kind == "twist"):
            # The axis may be far away. Beyond 4096 bits nothing would be wrong, but more than needed is refused.
            if any(v): self.bits = min(4096, max(self.bits, BITS + w.bit_length() - total(v).bit_length()))
        self.links = [(link[0], *self.link(*link)) for link in reversed(links)]   # the innermost first

    # The row of the table: A0, V, R (with back its inverse; None: 1), B, k (None: no turn), theta0, omega, and a bound
    # of |omega|, which is 0 only if omega is. Of theta0 and omega less than 1 and 2 may be missing.
    def link(self, back, kind, numbers, start, end):
        zero, one = (ZERO, 0), 1 << self.bits
        if kind == "pose": return (numbers[:3], 0), zero, self.rotation(numbers[3:], back), zero, None, 0, 0, 0
        if kind in ("slide", "turn"): steps = start[0], end[0] - start[0]
        if kind == "slide": return *((floor(scale(s, numbers), self.unit), 2) for s in steps), None, zero, None, 0, 0, 0
        if kind == "turn":
            theta, omega = (one * s // self.unit for s in steps)
            turn = direction(numbers, self.bits), theta, omega, (abs(omega) + 2) * (start != end)
            return zero, zero, None, zero, *turn
        w, v, unit, t0, way, c = course(*((x[:3], 1, x[3:]) for x in (start, end)), numbers)
        a, way, b = ((floor(x, unit), 2) for x in (add(t0, c), way, scale(-1, c)))
        omega = double_angle(w, dot(v, v), self.bits)
        turn = (direction(v, self.bits), 0, omega, omega + 2) if any(v) else (None, 0, 0, 0)
        return a, way, self.rotation(start[3:], back), b, *turn

    # The rows of a matrix with errors below 1, which add at most 3 times the length of a vector that it is applied to.
    def rotation(self, q, back):
        q = conjugate(q) if back else q
        return list(zip(*(floor(scale(1 << self.bits, rotate(q, e)), norm(q)) for e in AXES))), 3

    # The rotation about k, which has errors below 2, by the angle, which has one below 4. With the errors 6 of cosine
    # and sine, those of s k are below 6 + 3, of (1 - c) k_i below 6 + 6, of its product with k_j below 12 + 5, and all
    # together with the cosine below 9 + 17 + 6 + 1 = 33; 3 times that for the length.
    def turn(self, k, angle):
        (c, s), one = cos_sin(angle, self.bits), 1 << self.bits
        rest = floor(scale(one - c, k), one)
        return list(zip(*(add(scale(c, e), floor(add(scale(s, cross(k, e)), scale(dot(rest, e), k)), one))
                          for e in AXES))), 100

    # The true rotation does not change e; the difference of the two is applied to x.
    def turned(self, rotation, vectors):
        if not rotation: return vectors
        return [(tuple([dot(row, x) >> self.bits for row in rotation[0]]),
                 e + (rotation[1] * total(x) >> self.bits) + 3) for x, e in vectors]

    # The maps at tau = num / 2^shift from the corner b: for each link that turns y, y', and o; at last x and x'.
    # A map is linear: it has the images of the three unit vectors, and the constant vector.
    def maps(self, num, shift):
        one, found, rate = 1 << self.bits, [], [(ZERO, 0)] * 4
        x = [(scale(one, e), 0) for e in AXES] + [(ZERO, 0)]
        for back, a, v, r, b, k, theta, omega, o in self.links:
            a, sign = plus(a, (floor(scale(num, v[0]), 1 << shift), v[1] + 2)), -1 if back else 1
            turn = k and self.turn(k, sign * (theta + (omega * num >> shift)))
            if back: x, rate = moved(x, a, -1), moved(rate, v, -1)
            else: x, rate = moved(self.turned(r, x), b), self.turned(r, rate)
            if o:
                found.append((self.rows(x), self.rows(rate), o))
                # k has errors below 2 and omega one below 2, so omega k one below 2 + 4 |omega|, and o >= |omega|
                spin, error = floor(scale(sign * omega, k), one), 4 * (o >> self.bits) + 8
                rate = [plus(y, (floor(cross(spin, z), one), (o * e + error * total(z) >> self.bits) + 3))
                        for y, (z, e) in zip(rate, x)]
            x, rate = self.turned(turn, x), self.turned(turn, rate)
            if back: x, rate = self.turned(r, moved(x, b, -1)), self.turned(r, rate)
            else: x, rate = moved(x, a), moved(rate, v)
        return found, self.rows(x), self.rows(rate), max(e for _, e in x[:3])

    # The rows of a map, and a bound of the error of the image of a corner, which is rounded down, too.
    def rows(self, columns):
        vectors, errors = zip(*columns)
        return list(zip(*vectors)), (self.size * max(errors[:3]) >> self.bits) + errors[3] + 3

    def image(self, rows, p):
        (x, y, z), bits = p, self.bits
        return tuple([(a * x + b * y + c * z >> bits) + d for a, b, c, d in rows])

    def place(self, tau, moving, fixed):
        num, den = tau.as_integer_ratio()
        _, (rows, error), _, row_error = self.maps(num, den.bit_length() - 1)
        moving.places, fixed.places = [self.image(rows, p) for p in moving.corners], fixed.corners
        return 1, error, [row[:3] for row in rows], row_error

    def plane_test(self, end):
        (num, den), maps = end.as_integer_ratio(), functools.lru_cache(maxsize=1 + 4096 // len(self.links))(self.maps)

        # The place of a corner at the middle of the cell, h times its rate, and how much more than their products with
        # n is to be taken off, as a multiple of |n|: h^2 g / 2 and the errors. All bounds are rounded up.
        @functools.lru_cache(maxsize=1 << 16)
        def corner(p, depth, j):
            shift, g = den.bit_length() + depth, 0   # h = num / 2^shift
            found, (place, error), (rate, rate_error), _ = maps(num * (2 * j + 1), shift)
            for (y, ey), (z, ez), o in found:
                f = math.isqrt(norm(self.image(z, p))) + 1 + ez - (-g * num >> shift)
                r = math.isqrt(norm(self.image(y, p))) + 1 + ey - (-f * num >> shift)
                g += ((2 * o * f << self.bits) + o * o * r >> 2 * self.bits) + 1
            rest = error + 2 - (-rate_error * num >> shift) - (-g * num * num >> 2 * shift + 1)
            return self.image(place, p), floor(scale(num, self.image(rate, p)), 1 << shift), rest

        # At each tau n . p is linear in the corner: what is above top at the corners of a box is so in all of it.
        def test(n, root, top, corners, depth, j):
            above = lambda points: all(dot(n, place) - abs(dot(n, way)) > top + root * rest
                                       for place, way, rest in (corner(p, depth, j) for p in points))
            box = itertools.product(*((min(x), max(x)) for x in zip(*corners)))
            need((len(corners) > 16 and above(box)) or above(corners), "the plane does not separate")

        return test


def plus(a, b, sign=1): return add(a[0], scale(sign, b[0])), a[1] + b[1]
def moved(columns, by, sign=1): return columns[:3] + [plus(columns[3], by, sign)]


# --- proof -----------------------------------------------------------------------------------------------------------

# Reads and checks the steps of one piece and returns their number. test() checks that a plane separates.
def prove(reader, test, moving, fixed, reach):
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
            test(n, root, top, moving.node(b, e), depth, j)
        elif word == "T" and depth < MAX_DEPTH: stack += [(b, e, f, g, depth + 1, 2 * j + half) for half in (1, 0)]
        elif word == "A" and e - b > 1: stack += ((b + e) // 2, e, f, g, depth, j), (b, (b + e) // 2, f, g, depth, j)
        elif word == "B" and g - f > 1: stack += (b, e, (f + g) // 2, g, depth, j), (b, e, f, (f + g) // 2, depth, j)
        else: raise Refused("the certificate is incomplete" if word == "?" else f"{word!r:.50} is not possible here")
    need(not reader.row, "words after the end of the proof")
    del WHERE["step"]
    return steps


# --- who is inside of whom -------------------------------------------------------------------------------------------

# How often the surface of the body winds around the start of the ray. The coordinates of places (and so of the start)
# and those of the ray may be too small or too great by the two errors. What is within its bound may be 0.
def winding(body, start, ray, error=0, ray_error=0):
    points, error = [sub(p, start) for p in body.places], 2 * error
    k = max(range(3), key=lambda k: abs(ray[k]))
    need(abs(ray[k]) > ray_error, "the direction is 0")
    i, j, longest, far = (k + 1) % 3, (k + 2) % 3, abs(ray[k]), (error or ray_error) and max(map(total, points))
    flat = [(ray[k] * p[i] - ray[i] * p[k], ray[k] * p[j] - ray[j] * p[k]) for p in points]   # seen along the ray
    flat_error, count = 2 * (longest * error + ray_error * far + ray_error * error), 0
    bound, height_bound = 8 * longest * far * flat_error + 2 * flat_error ** 2, 6 * ((far + error) ** 3 - far ** 3)
    for face in body.faces:
        for b, c in zip(face[1:], face[2:]):
            (ax, ay), (bx, by), (cx, cy) = flat[face[0]], flat[b], flat[c]
            areas = ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax   # ray[k] times ray . (a x b) and so on
            least, most = min(areas), max(areas)
            if least < -bound and most > bound: continue   # the line of the ray passes by
            need(least < -bound or most > bound, "the ray is in one plane with a triangle")
            height = dot(points[face[0]], cross(points[b], points[c]))   # point . normal
            leaves = (most > bound) == (ray[k] > 0)   # where the line meets it, areas have one sign: of ray . normal
            if abs(height) > height_bound and (height > 0) != leaves: continue   # the triangle is behind the start
            need(abs(height) > height_bound and min(map(abs, areas)) > bound,
                 "the ray meets the edge of a triangle, or starts on one")
            count += 1 if leaves else -1
    return count


# The body called so, the other one, and corner c of face f with the next one.
def find_edge(bodies, name, f, c):
    need(name in NAMES, f"{name!r:.50} is neither 'moving' nor 'fixed'")
    body, other = bodies if name == "moving" else bodies[::-1]
    face = body.faces[integer(f, 0, len(body.faces))]
    c = integer(c, 0, len(face))
    return body, other, face[c], face[(c + 1) % len(face)]


# How often the other body winds around a corner; the places are of tau = 0 of piece 0, start is what place() returned.
def winding_at_start(bodies, start, name, f, c, *ray):
    body, other, corner, _ = find_edge(bodies, name, f, c)
    need(other.solid, f"the {other.name} body is no solid")
    ray, (_, error, rotation, ray_error) = list(map(integer, ray)), start
    if name == "moving": return winding(other, body.places[corner], ray, error), body, corner
    turned, ray_error = [dot(row, ray) for row in rotation], ray_error * total(ray)   # like the moving body
    return winding(other, body.places[corner], turned, error, ray_error), body, corner


def check_outside(reader, bodies, start):
    parts, found = {body.name: body.mesh.parts for body in bodies}, set()
    while reader.peek()[:1] == ["outside"]:
        count, body, corner = winding_at_start(bodies, start, *reader.take("outside", 6))
        need(count <= 0, "the corner is inside of the other body")
        found.add((body.name, parts[body.name][corner]))
    for body, other in zip(bodies, bodies[::-1]):
        for f, face in enumerate(body.faces if other.solid else ()):
            need((body.name, parts[body.name][face[0]]) in found, f"no 'outside {body.name}' for the part of face {f}")


# --- witness ---------------------------------------------------------------------------------------------------------

# Enclosures of the places of some corners.
def enclosed(body, corners, error):
    return [tuple([Interval(x - error, x + error) for x in body.places[v]]) for v in corners]


# The corners of face f, which has to be convex (as it is in the frame of the body).
def convex(body, f):
    face = body.faces[integer(f, 0, len(body.faces))]
    points = [body.corners[v] for v in face]
    edges = [sub(q, p) for p, q in zip(points, points[1:] + points[:1])]
    fan = [cross(sub(p, points[0]), sub(q, points[0])) for p, q in zip(points[1:], points[2:])]
    normal, turns = functools.reduce(add, fan), [cross(p, q) for p, q in zip(edges, edges[1:] + edges[:1])]
    need(len(face) == 3 or (any(normal) and all(dot(normal, x) >= 0 for x in fan + turns)),
         "the face of the witness is not convex")
    return face


# The point (U a + V b + W c) / (U + V + W) of face f as its numerator and denominator.
def weighted(body, error, f, i, j, k, *weights):
    face, weights = convex(body, f), [integer(word, 0) for word in weights]
    i, j, k = (integer(word, 0, len(face)) for word in (i, j, k))
    need(i == 0 < j and k == j + 1 and any(weights), "corners other than 0, k, k + 1, or all weights are 0")
    return functools.reduce(add, map(scale, weights, enclosed(body, (face[0], face[j], face[k]), error))), sum(weights)


def check_witness(reader, bodies, piece, verdict, reach):
    kind = "".join(reader.peek()[1:2])
    need(kind in ("cross", "near") or (kind, verdict.kind) == ("inside", "start"),
         "a witness that fits is expected here")
    tau, *words = reader.take("witness " + kind, {"cross": 6, "near": 15, "inside": 6}[kind])
    if kind == "inside":
        count = winding_at_start(bodies, piece.place(0, *bodies), tau, *words)[0]   # the first word is no tau
        return need(count > 0, "the corner of the witness is not inside of the other body")
    need(verdict.lower <= real(tau) <= verdict.upper, "TAU of the witness does not fit the verdict")
    unit, error, *_ = piece.place(real(tau), *bodies)
    if kind == "cross":
        body, other, p, q = find_edge(bodies, *words[:3])
        face = convex(other, words[3])
        k = integer(words[4], 1, len(face) - 1)
        (p, q), triangle = enclosed(body, (p, q), error), enclosed(other, (face[0], face[k], face[k + 1]), error)
        normal = cross(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0]))
        sp, sq = dot(normal, sub(p, triangle[0])), dot(normal, sub(q, triangle[0]))
        if sp >= sq: p, q, sp, sq = q, p, sq, sp
        # sp = sq = 0 if the triangle has no area, or the edge is in its plane; all numbers are integers
        need(sp <= 0 and sq >= 0 and sq - sp >= 1, "the edge of the witness does not cross the plane of the triangle")
        unit, meet = sq - sp, sub(scale(sq, p), scale(sp, q))   # they meet at meet / unit
        sides = [cross(sub(b, a), sub(meet, scale(unit, a))) for a, b in zip(triangle, triangle[1:] + triangle[:1])]
        return need(all(dot(normal, x) >= 0 for x in sides), "the edge of the witness passes beside the triangle")
    (p, sp), (q, sq) = weighted(bodies[0], error, *words[:7]), weighted(bodies[1], error, *words[7:])
    gap = sub(scale(sq, p), scale(sp, q))
    need(dot(gap, gap) <= (reach * unit * sp * sq) ** 2, "the points of the witness are too far apart")


# --- certificate -----------------------------------------------------------------------------------------------------

# Of the pieces up to end all is proven that is below or at lower in the last one. pair: the bodies of a scene.
class Verdict:
    def __init__(self, reader, count, bodies=0):
        self.kind, *words = reader.take("verdict", max(1, len(reader.peek()) - 1))
        self.text, self.pair, size = self.kind, None, 2 if bodies else 0
        need((self.kind, len(words)) in (("clear", 0), ("contact", 3 + size), ("start", size)), "unknown verdict")
        self.end, self.lower, self.upper = (0, 0, 0) if self.kind == "start" else (count - 1, 1, 1)
        if self.kind == "contact":
            self.end, self.lower, self.upper = integer(words[0], 0, count), real(words[1]), real(words[2])
            need(0 <= self.lower <= self.upper <= 1, "0 <= LOWER <= UPPER <= 1 does not hold")
            self.text += f" in piece {self.end}, not up to tau {float(self.lower)}, but up to tau {float(self.upper)}"
        if words and bodies:
            i = integer(words[-2], 0, bodies)
            self.pair = i, integer(words[-1], i + 1, bodies)
            self.text += ", bodies %d and %d" % self.pair


# Reads and checks what proves that two bodies stay apart, and returns the number of steps.
def check_apart(reader, bodies, motion, unit, reach, verdict):
    steps, piece = 0, motion.piece(0, unit, bodies)
    check_outside(reader, bodies, piece.place(0, *bodies))
    for i in range(verdict.end + 1):
        reader.take(f"proof {i}", 0)
        piece = motion.piece(i, unit, bodies) if i else piece
        steps += prove(reader, piece.plane_test(verdict.lower if i == verdict.end else 1), *bodies, reach)
    return steps


# Checks the lines after the first one of a certificate and returns those that say what is proven.
def check_pair(reader, meshes):
    need(len(meshes) == 2, "a certificate of a pair is for two meshes, MOVING and FIXED")
    for mesh, name in zip(meshes, NAMES):
        words = [mesh.hash, str(len(mesh.faces))]
        need(reader.take(name, 2) == words, f"the mesh file has the hash {words[0]} and {words[1]} faces")
    solid = reader.take("solid", 1)[0]
    need(solid in NAMES + ("both", "none"), f"unknown word {solid!r:.50}")
    bodies = [Body(f"the {name} body", mesh, solid in (name, "both")) for mesh, name in zip(meshes, NAMES)]
    lengths = [real(word) for word in reader.take("radius", 2) + reader.take("margin", 1)]
    need(min(lengths) >= 0, "a radius or the margin is below 0")
    kind = "".join(reader.peek()[1:2])
    if kind == "chain": motion = read_chain(reader, *(integer(word, 1) for word in reader.take("motion chain", 2)), {})
    else: motion = Rigid(reader, "sweep" if kind == "sweep" else "screw")
    verdict = Verdict(reader, motion.count)

    # From here on all lengths are integers; those of chains are large ones.
    unit, steps = fit(bodies, lengths + motion.numbers(), kind == "chain"), 0
    reach = sum(integers(lengths, unit))
    if verdict.kind != "start":
        for body in bodies: body.read_order(reader, "order " + body.name)
        steps = check_apart(reader, bodies, motion, unit, reach, verdict)
    if verdict.kind != "clear":
        check_witness(reader, bodies, motion.piece(verdict.end, unit, bodies), verdict, reach)
    return [f"verdict: {verdict.text}", "margin: " + shown(lengths[2:]), "radii: " + shown(lengths[:2]), *motion.texts,
            f"solid: {solid}", f"pieces: {motion.count}", f"steps: {steps}"]


def check_scene(reader, meshes):
    size, count = (integer(word, least) for word, least in zip(reader.take("scene", 2), (2, 1)))
    bodies, known, texts, claims, steps, found = [], {}, [], {}, 0, {mesh.hash: mesh for mesh in meshes}
    need(len(found) == len(meshes), "two mesh files have the same faces")
    while len(bodies) < size:
        digest, faces, solid, radius, links = reader.take("body", 5)
        need(mesh := found.get(digest), f"no mesh file has the hash {digest!r:.70}")
        need(faces == str(len(mesh.faces)), f"the mesh file has {len(mesh.faces)} faces")
        need(solid in ("solid", "surface"), f"unknown word {solid!r:.50}")
        body = Body(f"body {len(bodies)}", mesh, solid == "solid")
        body.radius = real(radius)
        need(body.radius >= 0, "the radius is below 0")
        body.chain = read_chain(reader, count, integer(links, 0), known, False)
        body.finest = max(body.finest, finest([body.radius, *body.chain.numbers()]))
        body.read_order(reader, "order")
        texts += [f"body {len(bodies)}: {mesh.path} {solid}, radius {shown([body.radius])}", *body.chain.texts[1:]]
        bodies.append(body)
    for i, mesh in enumerate(meshes, 1): need(any(body.mesh is mesh for body in bodies), f"no body has mesh file {i}")
    verdict = Verdict(reader, count, size)

    # The two bodies, the motion of the first as seen from the second, the unit and the reach.
    def pair(i, j, margin):
        WHERE["pair"], two = f"{i} {j}", (bodies[i], bodies[j])
        unit = fit(two, [margin], True)
        return two, seen_from(*(body.chain for body in two)), unit, sum(
            integers([margin, *(body.radius for body in two)], unit))

    for i, j in [verdict.pair] if verdict.kind == "start" else itertools.combinations(range(size), 2):
        if reader.peek()[:1] == ["untested"] and (i, j) != verdict.pair:
            reader.take(f"untested {i} {j}", 0)
            claims.setdefault("untested", []).append(f"{i}-{j}")
            continue
        margin = real(reader.take(f"pair {i} {j}", 1)[0])
        need(margin >= 0, "the margin is below 0")
        claims.setdefault(f"with the margin {shown([margin])}", []).append(f"{i}-{j}")
        if (i, j) == verdict.pair: touching = i, j, margin
        if verdict.kind != "start":
            steps += check_apart(reader, *pair(i, j, margin), verdict)
            del WHERE["pair"]
    if verdict.kind != "clear":
        two, motion, unit, reach = pair(*touching)
        check_witness(reader, two, motion.piece(verdict.end, unit, two), verdict, reach)
        del WHERE["pair"]
    return [f"verdict: {verdict.text}", *texts,
            *(f"pairs {claim}: {' '.join(pairs)}" for claim, pairs in claims.items()),
            f"pieces: {count}", f"steps: {steps}"]


def shown(numbers): return " ".join(str(float(x)) for x in numbers)


# The exit status, and what to print.
def main(paths):
    *meshes, certificate = paths or [""]
    is_mesh = [path.lower().endswith((".obj", ".stl")) for path in paths]
    if not meshes or not all(is_mesh[:-1]) or is_mesh == [True, True]:   # two meshes lack a certificate
        return 2, "usage: verify.py MESH [MESH ...] CERTIFICATE (a pair: MOVING FIXED; meshes are .obj or .stl files)"
    try:
        WHERE.clear()
        names = [name + " mesh" for name in NAMES] if len(meshes) == 2 else map("mesh {}".format, itertools.count(1))
        meshes = [Mesh(name, path) for name, path in zip(names, meshes)]
        with open(certificate, "rb") as file:
            reader = Reader(file)
            reader.take("chasles certificate 1", 0)
            lines = (check_scene if reader.peek()[:1] == ["scene"] else check_pair)(reader, meshes)
            need(not reader.peek(), "nothing more is expected")
            return 0, "\n".join(["verified", *lines])
    except OSError as error:
        return 2, f"cannot be read: {error}"
    except Exception as error:   # whatever is not proven is refused, even if it is too large for this program
        reason = str(error) if isinstance(error, Refused) else f"the program failed ({type(error).__name__})"
        return 1, f"not verified: {', '.join(f'{key} {value}' for key, value in WHERE.items())}: {reason}"


if __name__ == "__main__":
    status, text = main(sys.argv[1:])
    print(text)
    sys.exit(status)
