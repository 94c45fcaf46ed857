"""A small naive prover of certificates, and cases. Only pytest and the standard library are needed."""
import functools
import hashlib
import math
from pathlib import Path
import sys
import struct
from fractions import Fraction as Q
from itertools import product

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
import verify  # noqa: E402


# --- meshes ----------------------------------------------------------------------------------------------------------

def box(low=(0, 0, 0), high=(1, 1, 1), inward=False):
    """Six rectangles that look outwards (or inwards: a cavity)."""
    p = [tuple(float((low, high)[bit][k]) for k, bit in enumerate(bits)) for bits in product((0, 1), repeat=3)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [[p[i] for i in (face[::-1] if inward else face)] for face in faces]


def tetra(a=(0, 0, 0), b=(1, 0, 0), c=(0, 1, 0), d=(0, 0, 1)):
    a, b, c, d = (tuple(map(float, p)) for p in (a, b, c, d))
    return [[a, c, b], [a, b, d], [b, c, d], [c, a, d]]


def moved(faces, by):
    return [[tuple(x + y for x, y in zip(p, by)) for p in face] for face in faces]


def digest(faces):
    data = b"".join(struct.pack("<I", len(face)) + b"".join(struct.pack("<3d", *(x + 0.0 for x in p)) for p in face)
                    for face in faces)
    return hashlib.sha256(data).hexdigest()


def obj(faces):
    points = list(dict.fromkeys(p for face in faces for p in face))
    return "".join(["v %r %r %r\n" % p for p in points]
                   + ["f " + " ".join(str(points.index(p) + 1) for p in face) + "\n" for face in faces])


# --- a naive prover, written from the formulas of the page -----------------------------------------------------------

def dot(a, b): return sum(x * y for x, y in zip(a, b))
def add(*vs): return tuple(map(sum, zip(*vs)))
def times(s, a): return tuple(s * x for x in a)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def product_of(p, q):
    (a, *u), (b, *v) = p, q
    return (a * b - dot(u, v), *add(times(a, v), times(b, u), cross(u, v)))


def rotate(q, p):
    result = product_of(product_of(q, (0, *p)), (q[0], -q[1], -q[2], -q[3]))
    return times(1 / dot(q, q), result[1:])


def inverse(q): return times(1 / dot(q, q), (q[0], -q[1], -q[2], -q[3]))


def seen(pose):
    """A pose of seven or fourteen numbers in the frame of the fixed body."""
    t, q, tf, qf = (tuple(map(Q, part)) for part in (pose[:3], pose[3:7], pose[7:10], pose[10:]))
    if not qf: return t, q
    return rotate(inverse(qf), add(t, times(-1, tf))), product_of(inverse(qf), q)


class Motion:
    def __init__(self, start, end):
        start, end = ([*t, *q] for t, q in map(seen, (start, end)))
        self.t0, self.q0, t1, q1 = start[:3], start[3:], end[:3], end[3:]
        w, *v = product_of(q1, times(1 / dot(self.q0, self.q0), (self.q0[0], *times(-1, self.q0[1:]))))
        q = add(t1, times(-1, self.t0))
        self.a = times(1 / w, v)
        self.along = times(dot(v, q) / dot(v, v), v) if any(v) else q
        across = add(q, times(-1, self.along))
        self.m = times(Q(1, 2), add(across, times(-1, cross(self.a, across))))

    def powers(self, b):
        """Factors of the powers of tau in W p, and in W."""
        y, aa = rotate(self.q0, [Q(x) for x in b]), dot(self.a, self.a)
        s = add(cross(self.a, y), self.m)
        return ([add(self.t0, y), add(self.along, times(2, s)),
                 add(times(aa, add(self.t0, y)), times(2, cross(self.a, s))), times(aa, self.along)], [1, 0, aa, 0])


def at(powers, tau):
    ps, ws = powers
    return times(1 / sum(w * tau ** k for k, w in enumerate(ws)), add(*(times(tau ** k, p) for k, p in enumerate(ps))))


def root_of(x, bits=400):
    """A fraction close to the square root."""
    return Q(math.isqrt((x.numerator << 2 * bits) // x.denominator), 1 << bits)


class Sweep:
    def __init__(self, start, end, centre):
        (self.t0, self.q0), (t1, q1) = map(seen, (start, end))
        w, *v = product_of(q1, inverse(self.q0))
        self.w, self.v = (w, v) if w > 0 else (-w, times(-1, v))
        self.centre = tuple(map(Q, centre))
        self.n = root_of(w * w + dot(v, v))
        self.c0 = add(self.t0, rotate(self.q0, self.centre))
        self.way = add(t1, rotate(q1, self.centre), times(-1, self.c0))

    def powers(self, b):
        y = rotate(self.q0, add(map(Q, b), times(-1, self.centre)))
        e = [self.n, self.w - self.n]
        w = [e[0] ** 2, 2 * e[0] * e[1], e[1] ** 2 + dot(self.v, self.v)]
        vy = cross(self.v, y)
        base = add(self.c0, y)
        return ([times(w[0], base), add(times(w[1], base), times(w[0], self.way), times(2 * e[0], vy)),
                 add(times(w[2], base), times(w[1], self.way), times(2 * e[1], vy), times(2, cross(self.v, vy))),
                 times(w[2], self.way)], [*w, 0])


def turn(k, angle, x):
    """The rotation of x about the unit vector k (Rodrigues)."""
    c, s = math.cos(angle), math.sin(angle)
    return add(times(c, x), times(s, cross(k, x)), times((1 - c) * dot(k, x), k))


def length(x): return math.sqrt(dot(x, x))


class Chain:
    """In floating point, corner by corner. Links are tuples: a kind, perhaps with 'back ', and numbers."""
    SIZES = {"pose": 0, "slide": 1, "turn": 1, "velocity": 7, "twist": 7}

    def __init__(self, start, end, links):
        self.links, start, end = [], list(start), list(end)
        for word, *numbers in links:
            back, kind = word.startswith("back "), word.removeprefix("back ")
            size = self.SIZES[kind]
            self.links.append((back, *self.link(kind, numbers, start[:size], end[:size])))
            del start[:size], end[:size]
        assert not start and not end

    @staticmethod
    def link(kind, numbers, s, e):
        """A0, V, k, theta0, omega, the function R, B"""
        zero, same = (0, 0, 0), lambda x, back=False: x
        if kind == "pose":
            return numbers[:3], zero, None, 0, 0, Chain.rotation(numbers[3:]), zero
        if kind == "slide": return times(s[0], numbers), times(e[0] - s[0], numbers), None, 0, 0, same, zero
        if kind == "turn": return zero, zero, times(1 / length(numbers), numbers), s[0], e[0] - s[0], same, zero
        t0, q0, t1, q1 = s[:3], s[3:], e[:3], e[3:]
        w, *v = product_of(q1, inverse(q0))
        if w < 0: w, v = -w, times(-1, v)
        k, omega = (times(1 / length(v), v), 2 * math.atan2(length(v), w)) if any(v) else (None, 0)
        q = add(t1, times(-1, t0))
        if kind == "velocity":
            c0, c1 = (add(t, rotate(x, numbers)) for t, x in ((t0, q0), (t1, q1)))
            return c0, add(c1, times(-1, c0)), k, 0, omega, Chain.rotation(q0), times(-1, rotate(q0, numbers))
        along, c = q, zero
        if k:
            a = times(1 / w, v)
            along = times(dot(v, q) / dot(v, v), v)
            across = add(q, times(-1, along))
            c = times(0.5, add(across, times(1 / dot(a, a), cross(a, across))))
        return add(t0, c), along, k, 0, omega, Chain.rotation(q0), times(-1, c)

    @staticmethod
    def rotation(q): return lambda x, back=False: rotate(inverse(q) if back else q, x)

    def bound(self, b, middle, half):
        """The place, its rate, and a bound of the second derivative in the cell."""
        x, rate, g = b, (0, 0, 0), 0
        for back, a, v, k, theta, omega, rotated, shift in reversed(self.links):
            a = add(a, times(middle, v))
            s = (lambda x, sign=1: turn(k, sign * (theta + middle * omega), x)) if k else (lambda x, sign=1: x)
            spin = times(omega, k) if k else (0, 0, 0)
            if back: y, yy = add(x, times(-1, a)), add(rate, times(-1, v))
            else: y, yy = add(rotated(x), shift), rotated(rate)
            f = length(yy) + half * g
            r = length(y) + half * f
            if back:
                x = rotated(add(s(y, -1), times(-1, shift)), True)
                rate = rotated(s(add(yy, times(-1, cross(spin, y))), -1), True)
            else: x, rate = add(a, s(y)), add(v, s(add(yy, cross(spin, y))))
            g += 2 * abs(omega) * f + omega ** 2 * r
        return x, rate, g

    def at(self, b, tau): return self.bound(b, tau, 0)[0]

    def separates(self, n, points, corners, reach, l, u):
        s = math.isqrt(dot(n, n))
        s += s * s < dot(n, n)
        d, half = float(max(dot(n, c) for c in corners) + s * reach), float(u - l) / 2
        for b in points:
            x, rate, g = self.bound(b, float(l + u) / 2, half)
            if dot(n, x) - half * abs(dot(n, rate)) - s * g * half ** 2 / 2 <= d + 1e-12 * s: return False
        return True


NORMALS = [n for n in product((-2, -1, 0, 1, 2), repeat=3) if math.gcd(*n) == 1]


def separates(n, powers, corners, reach, l, u):
    s = math.isqrt(dot(n, n))
    s += s * s < dot(n, n)
    offset, h = max(dot(n, c) for c in corners) + s * reach, u - l
    for ps, ws in powers:
        c = [dot(n, x) - offset * w for x, w in zip(ps, ws)]
        f = lambda t: c[0] + t * (c[1] + t * (c[2] + t * c[3]))
        g = lambda t: c[1] + t * (2 * c[2] + 3 * t * c[3])
        if f(l) <= 0 or f(u) <= 0 or f(l) + h * g(l) / 3 <= 0 or f(u) - h * g(u) / 3 <= 0: return False
    return True


def motion_of(start, end, kind):
    """Functions: what separates() needs for corners, and the place of a corner."""
    if kind[0] == "chain":
        chain = Chain(start, end, kind[1])
        return chain.separates, lambda b, tau: chain.at(b, float(tau))
    motion = Sweep(start, end, kind[1]) if kind[0] == "sweep" else Motion(start, end)
    powers = functools.lru_cache(maxsize=None)(motion.powers)
    return (lambda n, points, *rest: separates(n, [powers(b) for b in points], *rest),
            lambda b, tau: at(powers(b), tau))


def prove(moving, fixed, start, end, upper, reach, kind=("screw",)):
    """Steps that prove that the bodies are apart from 0 to upper, or None."""
    apart, place = motion_of(start, end, kind)
    fixed = [[tuple(map(Q, p)) for p in face] for face in fixed]

    def steps(a, b, l, u, depth):
        middle = (l + u) / 2
        near = {p for f in a for p in moving[f]}
        corners = {p for f in b for p in fixed[f]}
        way = add(*(place(p, middle) for p in moving[a[0]]), *(times(-1, p) for p in fixed[b[0]]))
        way = tuple(map(float, way))
        best = sorted(NORMALS, key=lambda n: -dot(n, way) / math.sqrt(dot(n, n)))
        for n in [n for n in best[:60] if dot(n, n) == 1] + best[:8]:
            if apart(n, near, corners, Q(reach), l, u): return ["P %d %d %d" % n]
        if depth > 15: return None
        h, k = len(a) // 2, len(b) // 2
        if k and (len(b) < 12 or depth):
            word, *parts = "B", (a, b[:k], l, u), (a, b[k:], l, u)
        elif h and (depth % 2 or k):
            word, *parts = "A", (a[:h], b, l, u), (a[h:], b, l, u)
        else:
            word, *parts = "T", (a, b, l, middle), (a, b, middle, u)
        first = steps(*parts[0], depth + 1)
        second = first and steps(*parts[1], depth + 1)
        return second and [word] + first + second

    return steps(tuple(range(len(moving))), tuple(range(len(fixed))), Q(0), Q(upper), 0)


START, WALL = (0, 0, 0, 1, 0, 0, 0), box((2, -3, -3), (3, 3, 3))


def hexes(numbers): return " ".join(float(x).hex() for x in numbers)


def certify(moving, fixed, poses, verdict="clear", solid="none", radius=(0, 0), margin=0, outside=(), witness=None,
            kind=("screw",), steps=None):
    """The text of a certificate, with a proof in the plain order of the faces; kind may be ("sweep", the centre) or
    ("chain", the links)."""
    lines = ["chasles certificate 1", f"moving {digest(moving)} {len(moving)}", f"fixed {digest(fixed)} {len(fixed)}",
             f"solid {solid}", "radius " + " ".join(float(x).hex() for x in radius), f"margin {float(margin).hex()}",
             f"motion {kind[0]} {len(poses) - 1}" + (f" {len(kind[1])}" if kind[0] == "chain" else "")]
    if kind[0] == "sweep": lines.append("centre " + hexes(kind[1]))
    if kind[0] == "chain": lines += [f"link {word} {hexes(numbers)}".rstrip() for word, *numbers in kind[1]]
    lines += [f"{'knot' if kind[0] == 'chain' else 'pose'} {hexes(pose)}".rstrip() for pose in poses]
    last, upper, text = len(poses) - 2, 1, verdict
    if isinstance(verdict, tuple):
        _, last, upper, end = verdict
        text = f"contact {last} {float(upper).hex()} {float(end).hex()}"
    lines.append(f"verdict {text}")
    if verdict != "start":
        lines += ["order moving " + " ".join(map(str, range(len(moving)))),
                  "order fixed " + " ".join(map(str, range(len(fixed)))), *outside]
        for i in range(last + 1):
            found = steps[i] if steps else prove(moving, fixed, *poses[i:i + 2], upper if i == last else 1,
                                                 sum(map(Q, (*radius, margin))), kind)
            assert found, "the naive prover fails"
            lines += [f"proof {i}", *found]
    if witness: lines.append(f"witness {witness}")
    return "\n".join(lines) + "\n"


@pytest.fixture
def check(tmp_path):
    """Runs the checker on meshes (faces, text or bytes) and the text of a certificate."""
    written = {}

    def run(moving, fixed, text, kind="obj"):
        paths = [tmp_path / f"moving.{kind}", tmp_path / f"fixed.{kind}", tmp_path / "certificate"]
        for path, content in zip(paths, (moving, fixed, text)):
            if isinstance(content, list): content = obj(content)
            if written.get(path) != content:
                path.write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))
                written[path] = content
        status, answer = verify.main(list(map(str, paths)))
        assert "the program failed" not in answer and (status == 1) == answer.startswith("not verified: ")
        return status, answer
    return run


# --- what is true is verified ----------------------------------------------------------------------------------------

BELOW_HALF = math.nextafter(0.5, 0)
ARRIVE = [START, (2, 0, 0, 1, 0, 0, 0)]                 # a unit cube that meets the wall at tau = 1/2
TURN = [(0, 0, 0, 1, 0, 0, 0), (0, 0, 0, 1, 0, 0, 1)]       # a quarter turn: sin(angle) = 2 tau / (1 + tau^2)
ARM = tetra((0, 0, 0), (5, 0, 0), (4, -1, 0), (4, 0, 1))    # its tip (5, 0, 0) is at y = 4 for tau = 1/2
ROOF = box((-9, 4, -9), (9, 5, 9))
OUT_MOVING, OUT_FIXED = "outside moving 0 0 -7 1 2", "outside fixed 0 0 7 1 2"

CASES = {
    "translation past": (box(), WALL, [START, (0.5, 3, 1, 1, 0, 0, 0)]),
    "turn and translation": (box(), WALL, [START, (0.25, 1, -1, 1, 0.25, -0.125, 0.5)]),
    "long quaternions": (box(), WALL, [(0, 0, 0, -8, 0, 0, 0), (0.25, 0, 0, 1e-3, 0, 1e-4, 0)]),
    "three pieces": (tetra(), WALL, [START, (0.5, 1, 0, 3, 1, 0, 0), (-1, 1, 0, 1, 0, 0, 1), (0.2, 1, 3, 0, 0, 1, 1)]),
    "tetrahedra that pass closely": (tetra(), tetra((1, 1, 0), (2, 1, 0), (1, 2, 0), (1, 1, 1)),
                                     [(0.25, 0, 0, 1, 0, 0, 0), (0.25, -0.25, 0.5, 4, 1, 0, 1)]),
    "orbit": (box((2, -1, -1), (3, 1, 1)) + box((-3, -1, -1), (-2, 1, 1)), box((-1, -1, -1), (1, 1, 1)), TURN),
    "a ring around a pin": (box((-5, 1, -1), (5, 2, 1)) + box((-5, -2, -1), (5, -1, 1)),
                            box((-1, -.75, -5), (1, .75, 5)), [START, (1, 0, 2, 1, 0, 0, 0)]),
    "margin and radii": (box(), WALL, [START, (0.25, 0, 0, 1, 0, 0, 0)], "clear", "none", (0.25, 0.125), 0.25),
    "both solid": (box(), WALL, [START, (0.5, 0, 0, 1, 0, 0, 0)], "clear", "both", (0, 0), 0,
                   (OUT_MOVING, OUT_FIXED)),
    "in a cavity": (box(), box((-9, -9, -9), (9, 9, 9)) + box((-4, -4, -4), (4, 4, 4), True),
                    [START, (1, 1, 1, 4, 1, 0, 0)], "clear", "fixed", (0, 0), 0, (OUT_MOVING,)),
    "in a surface": (box(), box((-9, -9, -9), (9, 9, 9)), [START, (1, 1, 1, 1, 0, 0, 0)]),
    "two parts": (box() + moved(box(), (-3, 0, 0)), WALL, [START, (0.5, 0, 0, 1, 0, 0, 0)], "clear", "fixed",
                  (0, 0), 0, (OUT_MOVING, "outside moving 7 2 -7 1 2")),
    "turned and solid": (box(), WALL, [(0, 0, 0, 1, 1, 0, 0), (0, 0, 0, 3, 1, 1, 0)], "clear", "moving",
                         (0, 0), 0, (OUT_FIXED,)),
    "meets a wall": (box(), WALL, ARRIVE, ("contact", 0, BELOW_HALF, 0.5), "both", (0, 0), 0, (OUT_MOVING, OUT_FIXED),
                     "near 0x1p-1 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "meets it with an edge": (box(), WALL, ARRIVE, ("contact", 0, BELOW_HALF, 0.5), "none", (0, 0), 0, (),
                              "cross 0x1p-1 moving 2 0 0 1"),
    "meets its reach": (box(), WALL, ARRIVE, ("contact", 0, math.nextafter(0.25, 0), 0.25), "none", (0.25, 0.125),
                        0.125, (), "near 0x1p-2 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "in the second piece": (box(), WALL, [(-1, 0, 0, 1, 0, 0, 0), *ARRIVE], ("contact", 1, BELOW_HALF, 0.5), "none",
                            (0, 0), 0, (), "cross 0x1p-1 moving 2 0 0 1"),
    "a tip meets a roof": (ARM, ROOF, TURN, ("contact", 0, BELOW_HALF, 0.5), "none", (0, 0), 0, (),
                           "cross 0x1p-1 moving 0 2 2 1"),
    "contact from the first moment": (box(), WALL, [(1, 0, 0, 1, 0, 0, 0), ARRIVE[1]], "start", "none", (0, 0), 0, (),
                                      "cross 0x0p+0 moving 2 0 0 1"),
    "near at the start": (box(), WALL, ARRIVE, "start", "none", (0.5, 0.25), 0.25, (),
                          "near 0x0p+0 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "inside at the start": (box(), box((-9, -9, -9), (9, 9, 9)), ARRIVE, "start", "fixed", (0, 0), 0, (),
                            "inside moving 0 0 7 1 2"),
    "fixed inside at the start": (box((-9, -9, -9), (9, 9, 9)), box(), [(0, 0, 0, 3, 1, 0, 2), ARRIVE[1]], "start",
                                  "both", (0, 0), 0, (), "inside fixed 0 0 7 1 2"),
}
TEXTS = {}


def case(name):
    if name not in TEXTS: TEXTS[name] = certify(*CASES[name])
    return CASES[name][0], CASES[name][1], TEXTS[name]
