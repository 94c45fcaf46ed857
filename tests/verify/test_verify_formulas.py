"""The formulas of tools/verify.py for motions and enclosures against others: matrices, dense sampling, more digits."""
import io
import math
import random
from fractions import Fraction as Q

import pytest

from certificates import *  # noqa: F403
from certificates import add, check, cross, dot, times, verify  # noqa: F401


# --- the formulas against matrices -----------------------------------------------------------------------------------

def times_matrix(a, b): return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def exponential(a, tau=1.0):
    """The exponential function of a square matrix: Taylor's series for a / 1024, squared ten times."""
    size = range(len(a))
    result = term = [[float(i == j) for j in size] for i in size]
    for k in range(1, 12):
        term = [[x * tau / 1024 / k for x in row] for row in times_matrix(term, a)]
        result = [[x + y for x, y in zip(*rows)] for rows in zip(result, term)]
    for _ in range(10): result = times_matrix(result, result)
    return result


def hat(w, v=(0, 0, 0)):
    return [[0, -w[2], w[1], v[0]], [w[2], 0, -w[0], v[1]], [-w[1], w[0], 0, v[2]], [0, 0, 0, 0]]


def unitary(pose):
    """4 x 4 of a pose: the images of the axes by conjugation of 2 x 2 complex matrices."""
    x, y, z, *q = pose
    w, i, j, k = times(1 / math.sqrt(dot(q, q)), q)
    u = [[complex(w, i), complex(j, k)], [complex(-j, k), complex(w, -i)]]
    columns = []
    for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        m = [[complex(0, e[0]), complex(e[1], e[2])], [complex(-e[1], e[2]), complex(0, -e[0])]]
        m = times_matrix(times_matrix(u, m), [[u[0][0].conjugate(), u[1][0].conjugate()],
                                              [u[0][1].conjugate(), u[1][1].conjugate()]])
        columns.append((m[0][0].imag, m[0][1].real, m[0][1].imag, 0))
    return [list(row) for row in zip(*columns, (x, y, z, 1))]


def inverted(m):
    r = [list(row) for row in zip(*(row[:3] for row in m[:3]))]
    return [[*row, -dot(row, [line[3] for line in m])] for row in r] + [[0, 0, 0, 1]]


def turn_vector(m):
    """The axis times the angle, of the rotation m, which is below pi."""
    w = times(0.5, (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]))
    sine = math.sqrt(dot(w, w))
    return times(math.atan2(sine, (m[0][0] + m[1][1] + m[2][2] - 1) / 2) / sine if sine else 1, w)


def logarithm(m):
    """w and v with exponential(hat(w, v)) = m: v from columns of the translations that unit vectors make."""
    w = turn_vector(m)
    columns = [[row[3] for row in exponential(hat(w, e))[:3]] for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    det = dot(columns[0], cross(columns[1], columns[2]))
    t = [row[3] for row in m[:3]]
    return w, [dot(t, cross(columns[(i + 1) % 3], columns[(i + 2) % 3])) / det for i in range(3)]


def image(m, b): return tuple(dot(row, (*b, 1)) for row in m[:3])


def dense(links, start, end):
    """The motion of a chain as a function of a corner and tau."""
    start, end, parts = list(start), list(end), []
    for word, *numbers in links:
        kind, size = word.split()[-1], Chain.SIZES[word.split()[-1]]
        s, e = start[:size], end[:size]
        del start[:size], end[:size]
        unit = times(1 / math.hypot(*numbers[:3]), numbers[:3]) if kind == "turn" else numbers
        if kind == "pose": part = lambda tau, m=unitary(numbers): m
        elif kind == "slide": part = lambda tau, u=unit, s=s, e=e: exponential(hat(
            (0, 0, 0), times(s[0] + tau * (e[0] - s[0]), u)))
        elif kind == "turn": part = lambda tau, u=unit, s=s, e=e: exponential(hat(times(s[0] + tau * (e[0] - s[0]), u)))
        else:
            first, last = unitary(s), unitary(e)
            if kind == "twist":
                wv = logarithm(times_matrix(last, inverted(first)))
                part = lambda tau, wv=wv, m=first: times_matrix(exponential(hat(*wv), tau), m)
            else:
                def part(tau, first=first, last=last, c=numbers):
                    w = turn_vector(times_matrix(last, inverted(first)))
                    m = times_matrix(exponential(hat(w), tau), first)
                    way = [(1 - tau) * x + tau * y for x, y in zip(image(first, c), image(last, c))]
                    turned = [dot(row[:3], c) for row in m[:3]]
                    return [[*row[:3], a - b] for row, a, b in zip(m, way, turned)] + [[0, 0, 0, 1]]
        parts.append((word.startswith("back "), part))

    def place(b, tau):
        for back, part in reversed(parts): b = image(inverted(part(tau)) if back else part(tau), b)
        return b
    return place


def random_chain(draw, most=1):
    numbers = lambda count: [draw.randint(-9, 9) / 8 for _ in range(count)]
    pose = lambda: numbers(3) + [draw.choice((-2, 2))] + numbers(3)
    links = []
    for _ in range(draw.randint(1, 4)):
        kind = draw.choice(("pose", "slide", "turn", "velocity", "twist"))
        own = {"pose": pose(), "slide": numbers(2) + [1], "turn": [1] + numbers(2), "velocity": numbers(3), "twist": []}
        links.append((draw.choice(("", "back ")) + kind, *own[kind]))
    sizes = [Chain.SIZES[word.split()[-1]] for word, *_ in links]
    knots = [[x for size in sizes for x in {0: [], 1: times(most, numbers(1)), 7: pose()}[size]] for _ in range(2)]
    return links, knots


def chain_piece(links, knots, corners, unit):
    """The checker's own piece, and bodies with the corners."""
    text = "".join(f"link {word} {hexes(row)}\n" for word, *row in links)
    text += "".join(f"knot {hexes(x)}\n" for x in knots)
    chain = verify.read_chain(verify.Reader(io.BytesIO(text.encode())), 1, len(links), {})
    corners = [tuple(int(x * unit) for x in p) for p in corners]
    bodies = [type("Body", (), {"corners": corners, "size": max(map(verify.total, corners))})() for _ in range(2)]
    return chain.piece(0, unit, bodies), bodies


def corner_function(piece, end):
    return next(part.cell_contents for part in piece.plane_test(end).__closure__ if callable(part.cell_contents))


def test_chains_and_matrices():
    """Places, and the second-order bound, against a dense sample of other formulas."""
    draw, unit = random.Random(11), 1 << 200
    for _ in range(25):
        links, knots = random_chain(draw)
        corners = [tuple(draw.randint(-9, 9) / 4 for _ in range(3)) for _ in range(2)]
        place, (piece, bodies) = dense(links, *knots), chain_piece(links, knots, corners, unit)
        for tau in (0, Q(3, 8), 1):
            one, error, *_ = piece.place(Q(tau), *bodies)
            assert one == 1 and error < unit >> 170
            for p, b in zip(bodies[0].places, corners):
                assert max(abs(x / unit - y) for x, y in zip(p, place(b, float(tau)))) < 1e-9
        for depth, j in ((0, 0), (3, 5)):
            corner, half = corner_function(piece, Q(3, 4)), 0.75 / 2 ** (depth + 1)
            for p, b in zip(bodies[0].corners, corners):
                x, way, rest = corner(p, depth, j)
                way, rest = [y / unit for y in way], rest / unit
                middle, ratio = place(b, half * (2 * j + 1)), 0
                for i in range(-8, 9):
                    gap = add(place(b, half * (2 * j + 1 + i / 8)), times(-1, middle), times(-i / 8, way))
                    assert math.hypot(*gap) <= rest * (i / 8) ** 2 + 1e-9
                    ratio = max(ratio, math.hypot(*gap))
                assert rest < 60 * ratio + 1e-6 or depth == 0      # it is no senseless bound


def test_bounds_of_errors(monkeypatch):
    """With few bits the errors are large, and within their bounds."""
    draw, worst = random.Random(12), 0
    for _ in range(120):
        links, knots = random_chain(draw, draw.choice((1, 100)))
        corners, depth, j = [tuple(draw.randint(-9, 9) / 4 for _ in range(3)) for _ in range(3)], 2, draw.randint(0, 3)
        n = [draw.randint(-9, 9) for _ in range(3)]
        found = []
        for bits in (20, 300):
            monkeypatch.setattr(verify, "BITS", bits)
            piece, bodies = chain_piece(links, knots, corners, unit := 1 << bits)
            found.append([])
            for tau in (Q(0), Q(3, 7 + 1)):
                _, error, rotation, rotation_error = piece.place(tau, *bodies)
                found[-1].append([[Q(x, unit) for row in rotation for x in row], Q(rotation_error, unit)])
                for p in bodies[0].places: found[-1].append([[Q(x, unit) for x in p], Q(error, unit)])
            corner = corner_function(piece, 1)
            for p in bodies[0].corners:
                x, way, rest = corner(p, depth, j)
                length = root_of(Q(dot(n, n)))
                found[-1].append([[], Q(dot(n, x) - abs(dot(n, way)), unit) - length * Q(rest, unit)])
        for (low, bound), (high, _) in zip(*found):
            if low and bound:
                assert all(abs(x - y) <= bound for x, y in zip(low, high))
                worst = max(worst, max(abs(x - y) for x, y in zip(low, high)) / bound)
        for (low, bound), (_, best) in zip(*found):
            if not low: assert 0 <= best - bound < (1 + abs(best)) / 5
    assert worst > 0.01


@pytest.mark.parametrize("kind", ["screw", "sweep"])
def test_screws_and_sweeps(kind):
    """The turn is that of complex numbers, the error that of N; and both bodies move."""
    draw, unit = random.Random(13), 1 << 300
    for i in range(40):
        size = draw.choice((7, 14))
        poses = [[draw.randint(-9, 9) / 8 for _ in range(size)] for _ in range(2)]
        for pose in poses:
            for k in (3, -4): pose[k] = pose[k] or 1.0
        if i % 5 == 0: poses[1][3:7], poses[1][10:] = poses[0][3:7], poses[0][10:]
        centre, b = ([draw.randint(-9, 9) / 4 for _ in range(3)] for _ in range(2))
        text = f"motion {kind} 1\n" + ("centre " + hexes(centre) + "\n" if kind == "sweep" else "")
        text += "".join(f"pose {hexes(pose)}\n" for pose in poses)
        piece = verify.Rigid(verify.Reader(io.BytesIO(text.encode())), kind).piece(0, unit, None)
        bodies = [type("Body", (), {"corners": [tuple(int(x * unit) for x in b)]})() for _ in range(2)]
        powers = (Sweep(*poses, centre) if kind == "sweep" else Motion(*poses)).powers(b)
        first, last = (times_matrix(inverted(unitary(pose[7:])), unitary(pose[:7])) if pose[7:] else unitary(pose)
                       for pose in poses)
        vector, shift = logarithm(times_matrix(last, inverted(first)))
        whole = math.hypot(*vector)
        for tau in (Q(0), Q(3, 16), Q(5, 8), Q(1)):
            one, error, _, rotation_error = piece.place(tau, *bodies)
            p = [Q(x, one * unit) for x in bodies[0].places[0]]
            assert Q(error, one) < Q(unit, 1 << 170) and rotation_error == 0 and (error == 0 or tau and kind == "sweep")
            assert max(abs(x - y) for x, y in zip(p, at(powers, tau))) <= Q(error + 1, one * unit) + Q(1, 1 << 350)
            tau = float(tau)
            if kind == "sweep":
                angle = 2 * math.atan2(tau * math.sin(whole / 2), 1 - tau * (1 - math.cos(whole / 2)))
                m = times_matrix(exponential(hat(times(angle / whole if whole else 0, vector))), first)
                way = [(1 - tau) * x + tau * y for x, y in zip(image(first, centre), image(last, centre))]
                want = add(way, [dot(row[:3], add(b, times(-1, centre))) for row in m[:3]])
            else:
                angle = 2 * math.atan(tau * math.tan(whole / 2))
                along = times(dot(vector, shift) / whole ** 2, vector) if whole else shift
                turn = hat(vector, add(shift, times(-1, along)))
                m = times_matrix(exponential(turn, angle / whole if whole else 0), first)
                want = add(image(m, b), times(tau, along))
            assert max(abs(x - y) for x, y in zip(p, want)) < 1e-9


# --- enclosures ------------------------------------------------------------------------------------------------------

def test_cosine_and_sine():
    draw = random.Random(15)
    for _ in range(200):
        bits = draw.choice((20, 192))
        angle = draw.choice((draw.randint(-9 << bits, 9 << bits), draw.randint(-9, 9), 1 << bits + draw.randint(0, 62)))
        found, best = verify.cos_sin(angle, bits), verify.cos_sin(angle << 200, bits + 200)
        assert all(abs(Q(y, 1 << 200) - x) < 2 for x, y in zip(found, best))
        if abs(angle) < 10 << bits:
            x, series = Q(angle, 1 << bits), [Q(0), Q(0)]
            term = Q(1)
            for k in range(40 if bits == 20 else 0):
                series[k % 2] += term * (1, 1, -1, -1)[k % 4]
                term *= x / (k + 1)
            if bits == 20: assert all(abs(y * (1 << bits) - x) < 2.01 for x, y in zip(found, series))
            assert abs(found[0] / 2 ** bits - math.cos(x)) < 2.5 / 2 ** bits + 1e-15
            assert abs(found[1] / 2 ** bits - math.sin(x)) < 2.5 / 2 ** bits + 1e-15
    with pytest.raises(verify.Refused, match="too large"): verify.cos_sin(1 << 260, 192)


def test_angle_and_direction():
    draw = random.Random(16)
    for _ in range(200):
        bits = draw.choice((20, 192))
        w = draw.choice((1, draw.randint(1, 1 << 90), 1 << draw.randint(0, 2000)))
        vv = draw.choice((0, 1, draw.randint(1, 1 << 180), 1 << draw.randint(0, 4000)))
        found, best = verify.double_angle(w, vv, bits), verify.double_angle(w, vv, bits + 200)
        assert abs(Q(best, 1 << 200) - found) < 2
        if max(w.bit_length(), vv.bit_length()) < 900:
            assert abs(found / 2 ** bits - 2 * math.atan2(math.sqrt(vv), w)) < 2.5 / 2 ** bits + 1e-15
        c, s = verify.cos_sin(found, bits)   # the cosine of the double angle is (w^2 - vv) / (w^2 + vv)
        assert abs(c - Q((w * w - vv) << bits, w * w + vv)) < 5
        v = [draw.randint(-99, 99) * 10 ** draw.randint(0, 40) for _ in range(2)] + [1]
        u, fine = verify.direction(v, bits), verify.direction(v, bits + 200)
        assert all(abs(Q(y, 1 << 200) - x) < 2 for x, y in zip(u, fine))
        assert abs(dot(u, u) - (1 << 2 * bits)) < 8 << bits


def test_intervals():
    draw = random.Random(17)
    for _ in range(300):
        pairs = [sorted(draw.randint(-5, 5) for _ in range(2)) for _ in range(2)]
        a, b = (verify.Interval(*pair) for pair in pairs)
        k = draw.randint(-3, 3)
        inside = [(x, y) for x in range(pairs[0][0], pairs[0][1] + 1) for y in range(pairs[1][0], pairs[1][1] + 1)]
        for found, values in ((a + b, [x + y for x, y in inside]), (a - b, [x - y for x, y in inside]),
                              (a * b, [x * y for x, y in inside]), (k * a, [k * x for x, _ in inside]),
                              (a + k, [x + k for x, _ in inside]), (a - k, [x - k for x, _ in inside])):
            assert (found.low, found.high) == (min(values), max(values))
        assert (a >= b) == all(x >= y for x, y in inside) and (a <= b) == all(x <= y for x, y in inside)
        assert (a >= k) == all(x >= k for x, _ in inside) and (a <= k) == all(x <= k for x, _ in inside)


def test_winding_with_errors():
    """What holds with errors holds for all places within them; with small errors, all is as without."""
    draw, kept = random.Random(18), 0
    faces = box((-3000, -3000, -3000), (3000, 3000, 3000))
    solid = type("Solid", (), {})()
    points = [tuple(map(int, p)) for p in dict.fromkeys(p for face in faces for p in face)]
    solid.faces = [[points.index(tuple(map(int, p))) for p in face] for face in faces]
    for _ in range(3000):
        error, ray_error = draw.choice(((0, 0), (1, 0), (200, 0), (0, 1), (0, 40), (200, 40)))
        start = [draw.randint(-5000, 5000) for _ in range(3)]
        end = [draw.choice((-3000, 3000, draw.randint(-3000, 3000))) for _ in range(3)]   # on a face, edge or corner
        near = draw.choice((1, 5, 500))
        if draw.random() < 0.3: start = end
        start = [x + draw.randint(-near, near) for x in start]
        ray = [x - y + draw.randint(-near, near) for x, y in zip(end, start)]
        solid.places = points
        try: count = verify.winding(solid, start, ray, error, ray_error)
        except verify.Refused: continue
        kept += 1
        for _ in range(5):
            off = lambda p, e: tuple(x + draw.choice((-e, e)) for x in p)
            solid.places = [off(p, error) for p in points]
            assert verify.winding(solid, off(start, error), off(ray, ray_error)) == count
    assert kept > 500


def test_error_of_a_turned_ray():
    bodies = [type("Body", (), {"name": name, "solid": True, "faces": [[0, 1, 2]]})() for name in ("moving", "fixed")]
    for body in bodies: body.places = [(9, 9, 0), (9, 10, 0), (10, 9, 0)]
    identity = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    with pytest.raises(verify.Refused, match="direction is 0"):
        verify.winding_at_start(bodies, (1, 0, identity, 1), "fixed", "0", "0", "1", "1", "1")
