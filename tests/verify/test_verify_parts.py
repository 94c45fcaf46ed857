"""Parts of tools/verify.py against other formulas; meshes, solids, and extreme numbers."""
import math
import random
import struct
import subprocess
import sys
from fractions import Fraction as Q

import pytest

from certificates import *  # noqa: F403
from certificates import add, check, cross, dot, times, verify  # noqa: F401


# --- the motion against the formulas of the page ---------------------------------------------------------------------

def integer_pose(pose, unit=1 << 60):
    return tuple(int(Q(x) * unit) for x in pose[:3]), 1, tuple(int(Q(x) * 2 ** 1074) for x in pose[3:])


def at_power(rows, tau): return [sum(column) for column in zip(*verify.stretched(rows, tau))]


def test_motion():
    draw = random.Random(1)
    for _ in range(20):
        pose = [[draw.randint(-99, 99) / 16 for _ in range(7)] for _ in range(2)]
        if draw.random() < 0.2: pose[1][3:] = pose[0][3:]
        tau, b, unit = Q(draw.randint(0, 64), 64), [draw.randint(-99, 99) / 8 for _ in range(3)], 1 << 60
        piece, motion = verify.Piece(*map(integer_pose, pose), ()), Motion(*pose)
        row = at_power(piece.matrices[0], tau)
        corner = [int(Q(x) * unit) for x in b]
        place = [Q(dot(row[i:9:3], corner) + row[9 + i], row[12] * unit) for i in range(3)]
        assert tuple(place) == at(motion.powers(b), tau)
        for end, value in ((0, pose[0]), (1, pose[1])):   # the ends are the poses
            value = [Q(x) for x in value]
            assert at(motion.powers(b), Q(end)) == add(value[:3], rotate(value[3:], [Q(x) for x in b]))


def test_bernstein():
    draw = random.Random(2)
    piece = verify.Piece(*(integer_pose([draw.randint(-9, 9) for _ in range(7)]) for _ in range(2)), ())
    power, = piece.matrices
    end, depth, j = Q(3, 4), 3, 5
    l, u = end * j / 8, end * (j + 1) / 8
    cell, = (part.cell_contents for part in piece.plane_test(end).__closure__)
    rows = cell(depth, j)
    flat = [[*a, *b, *c, *d, w] for a, b, c, d, w in rows]
    for column in range(13):
        c = [row[column] for row in power]
        f = lambda t: sum(x * t ** k for k, x in enumerate(c))
        g = lambda t: sum(k * x * t ** (k - 1) for k, x in enumerate(c) if k)
        ratio = flat[0][12] / sum(row[12] * l ** k for k, row in enumerate(power))
        want = [f(l), f(l) + (u - l) * g(l) / 3, f(u) - (u - l) * g(u) / 3, f(u)]
        assert ratio > 0 and [row[column] for row in flat] == [ratio * x for x in want]


def test_planes(check):
    """The verdict on one plane is that of the formulas of the page."""
    draw, count = random.Random(3), [0, 0]
    for _ in range(40):
        moving = tetra(*([draw.randint(-8, 8) / 8 for _ in range(3)] for _ in range(4)))
        fixed = moved(tetra(), (draw.choice((2, 3)), 0, 0))
        poses = [[draw.randint(-4, 4) / k for k in (4, 4, 4, 8, 8, 8)] for _ in range(2)]
        poses = [[*pose[:3], 1, *pose[3:]] for pose in poses]
        n, reach = (draw.randint(-9, -5), draw.randint(-3, 3), draw.randint(-3, 3)), draw.choice((0, 0.25))
        depth = draw.randint(0, 2)
        motion, wide = Motion(*poses), Q(1, 2 ** depth)
        corners = [tuple(map(Q, p)) for face in fixed for p in face]
        powers = [motion.powers(p) for p in {p for f in moving for p in f}]
        good = [separates(n, powers, corners, Q(reach), wide * j, wide * (j + 1)) for j in range(2 ** depth)]
        count[all(good)] += 1
        text = certify(moving, fixed, poses, "start", radius=(reach, 0)).replace("verdict start\n", "verdict clear\n")
        text += "order moving 3 1 0 2\norder fixed 0 1 2 3\nproof 0\n"
        text += {0: "{0}", 1: "T {0} {0}", 2: "T T {0} {0} T {0} {0}"}[depth].format("P %d %d %d" % n)
        assert check(moving, fixed, text)[0] == (not all(good))
    assert min(count) > 5


# --- winding numbers and witnesses against known answers -------------------------------------------------------------

class Solid(verify.Body):
    def __init__(self, faces):
        points = list(dict.fromkeys(p for face in faces for p in face))
        self.name, self.faces, self.places = "fixed", [[points.index(p) for p in face] for face in faces], points
        self.corners = points


@pytest.mark.parametrize("faces, start, ray, count", [
    (box((0, 0, 0), (4, 4, 4)), (1, 1, 1), (3, 1, 2), 1),
    (box((0, 0, 0), (4, 4, 4), True), (1, 1, 1), (3, 1, 2), -1),
    (box((0, 0, 0), (4, 4, 4)), (-1, -1, -1), (5, 4, 3), 0),
    (box((0, 0, 0), (4, 4, 4)), (-1, 1, 2), (-5, 1, 2), 0),
    (box((0, 0, 0), (9, 9, 9)) + box((1, 1, 1), (5, 5, 5)), (2, 2, 3), (-1, -5, -3), 2),
    (box((0, 0, 0), (9, 9, 9)) + box((1, 1, 1), (5, 5, 5), True), (2, 2, 3), (-1, -5, -3), 0),
    (tetra((0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9)), (1, 1, 2), (0, 0, -1), 1),
    (box((0, 0, 0), (4, 4, 4)), (1, 1, 1), (0, 0, 1), "edge"),              # a diagonal
    (box((0, 0, 0), (4, 4, 4)), (-1, 0, 0), (1, 0, 0), "edge"),             # along an edge
    (tetra((0, 1, 0), (9, 1, 0), (0, 9, 0), (0, 1, 9)), (0, 1, -9), (1, 0, 0), "plane"),
    (box((0, 0, 0), (4, 4, 4)), (0, 1, 2), (1, 3, 7), "starts"),            # on a face
    (box((0, 0, 0), (4, 4, 4)), (-4, -4, -4), (1, 1, 1), "edge"),           # through a corner
    (box((0, 0, 0), (4, 4, 4)), (1, 1, 1), (0, 0, 0), "direction"),
])
def test_winding(faces, start, ray, count):
    if isinstance(count, str):
        with pytest.raises(verify.Refused, match=count): verify.winding(Solid(faces), start, ray)
    else:
        assert verify.winding(Solid(faces), start, ray) == count


def test_random_winding():
    draw, decided = random.Random(4), 0
    bodies = [(box((-3, -3, -3), (3, 3, 3)), lambda p: max(map(abs, p)) < 3, lambda p: max(map(abs, p)) == 3),
              (tetra((-4, -4, -4), (8, -4, -4), (-4, 8, -4), (-4, -4, 8)), lambda p: min(p) > -4 and sum(p) < 0,
               lambda p: min(p) == -4 and sum(p) <= 0 or sum(p) == 0 and min(p) >= -4)]
    for i in range(600):
        faces, inside, on = bodies[i % 2]
        p, ray = [[draw.randint(-5, 5) for _ in range(3)] for _ in range(2)]
        try: count = verify.winding(Solid(faces), p, ray)
        except verify.Refused: continue
        assert count == inside(p) and not on(p)
        decided += 1
    assert decided > 300


@pytest.mark.parametrize("points, good", [
    ([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)], True),
    ([(0, 0, 0), (4, 0, 0), (1, 1, 0), (0, 4, 0)], False),               # an arrow, seen from its tail
    ([(1, 1, 0), (0, 4, 0), (0, 0, 0), (4, 0, 0)], False),
    ([(0, 0, 0), (4, 4, 0), (4, 0, 0), (0, 4, 0)], False),               # a bow tie: its areas cancel
    ([(0, 4, 0), (2, -3, 0), (-4, 1, 0), (4, 1, 0), (-2, -3, 0)], False),   # a pentagram
    ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], False),               # no area at all
    ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], True),                           # a triangle may have none
    ([(0, 0, 0), (2, 0, 0), (4, 0, 0), (4, 4, 0)], True),                # a corner on an edge
])
def test_convex(points, good):
    solid = Solid([points])
    if good: assert verify.convex(solid, "0") == list(range(len(points)))
    else:
        with pytest.raises(verify.Refused, match="not convex"): verify.convex(solid, "0")


def test_no_solids(check):
    """Surfaces that are not closed, not in one sense, or have an edge of three faces."""
    whole = box((-9, -9, -9), (9, 9, 9))
    bodies = {"of no other face": whole[1:],
              "in one sense": [whole[0][::-1]] + whole[1:],
              "a corner twice": [whole[0] + whole[0][:1]] + whole[1:],
              "have an edge": whole + [whole[0]]}
    for reason, faces in bodies.items():
        text = certify(box(), faces, ARRIVE, "start", "fixed", witness="inside moving 0 0 7 1 2")
        status, answer = check(box(), faces, text)
        assert status == 1 and reason in answer and "line 4" in answer
    text = certify(whole, box()[1:], ARRIVE, "start", "fixed", witness="inside moving 0 0 7 1 2")
    assert "of no other face" in check(whole, box()[1:], text)[1]


def test_witness_not_convex(check):
    dent = [[(2., -3., -3.), (2., 3., -3.), (2., 0., -1.), (2., -3., 3.)]]     # an arrow around (2, 0, -1)
    text = certify(box(), dent, ARRIVE, ("contact", 0, BELOW_HALF, 0.5), witness="cross 0x1p-1 moving 2 0 0 1")
    assert "not convex" in check(box(), dent, text)[1]
    flat = [[(2., -3., -3.), (2., 3., 3.), (2., 1., 1.)]]
    text = certify(box(), flat, ARRIVE, ("contact", 0, BELOW_HALF, 0.5), witness="cross 0x1p-1 moving 2 0 0 1")
    assert "does not cross the plane" in check(box(), flat, text)[1]
    text = text[:text.index("witness")] + "witness near 0x1p-1 1 0 1 2 1 0 0 0 0 1 2 1 1 0\n"   # no area, but near
    assert check(box(), flat, text)[0] == 0
    away = [[(2., 2., -3.), (2., 3., 3.), (2., 3., 0.)]]
    text = certify(box(), away, ARRIVE, ("contact", 0, BELOW_HALF, 0.5), witness="cross 0x1p-1 moving 2 0 0 1")
    assert "passes beside" in check(box(), away, text)[1]


# --- mesh files ------------------------------------------------------------------------------------------------------

def binary_stl(faces):
    return b"solid but binary".ljust(80) + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", *(3 * [math.nan]), *(x for p in face for x in p), 7) for face in faces)


def ascii_stl(faces):
    return "solid vertex endloop\n" + "".join("  FACET normal 0 0 1\nouter loop\n" + "".join(
        "   vertex %r %r %r\n" % p for p in face) + "endloop\r\nendfacet\n" for face in faces) + "endsolid\n"


def test_stl(check):
    moving, fixed = tetra(), tetra((3, 0, -0.0), (4, 0, 0), (3, 1, 0), (3, 0, 1))
    text = certify(moving, fixed, [START, (1, 0, 0, 1, 0, 0, 0)])
    for write in (binary_stl, ascii_stl):
        assert check(write(moving), write(fixed), text, "stl") [0] == 0
        assert check(write(moving), write(fixed)[:-60], text, "stl")[0] == 1
    tenth = moved(moving, (0.1, 0, 0))                          # 0.1 is another number in single precision
    single = [[tuple(struct.unpack("<f", struct.pack("<f", x))[0] for x in p) for p in face] for face in tenth]
    for write, faces, other in ((binary_stl, single, tenth), (ascii_stl, tenth, single)):
        assert check(write(tenth), write(fixed), certify(faces, fixed, [START, START]), "stl")[0] == 0
        assert check(write(tenth), write(fixed), certify(other, fixed, [START, START]), "stl")[0] == 1
    for old, new, reason in (("vertex 0.0", "vertex 1e999", "not finite"),
                             ("vertex 0.0", "vertex nan", "three decimal"),
                             ("outer loop\n   vertex 0.0 0.0 0.0\n", "outer loop\n", "three corners"),
                             ("endloop\r\n", "", "three corners"), ("endfacet", "facette", "unknown keyword"),
                             ("vertex 0.0 0.0 0.0", "vertex 0.0 0.0", "three decimal")):
        status, answer = check(ascii_stl(moving).replace(old, new, 1), ascii_stl(fixed), text, "stl")
        assert status == 1 and reason in answer and "moving mesh, line" in answer
    infinite = binary_stl(moving)[:96] + struct.pack("<f", math.inf) + binary_stl(moving)[100:]
    assert "face 0 is not finite" in check(infinite, binary_stl(fixed), text, "stl")[1]


def test_obj(check):
    moving, fixed, text = case("translation past")
    n = 8
    written = obj(moving)
    faces = [[int(i) for i in row.split()[1:]] for row in written.splitlines() if row[0] == "f"]
    vertices = written[:written.index("f")]
    for corner in ("{0}/7", "{0}//-7", "{0}/1/2", "{1}", "{1}/-1/-2"):
        lines = ["f " + " ".join(corner.format(i, i - n - 1) for i in face) for face in faces]
        mesh = "# a cube\nmtllib \xfc.mtl\n" + vertices + "vn 0 0 1\ng a\n" + "\n".join(lines)
        assert check(mesh, fixed, text)[0] == 0
    assert check(written.replace("f 1 ", "f 1 \\\r\n "), fixed, text)[0] == 0
    assert check("\n".join(sorted(written.splitlines(), key=lambda row: row[0])) + " # end", fixed, text)[0] == 0
    assert check(written.replace("0.0", "-0"), fixed, text)[0] == 0
    for old, new, reason in (("f 1 ", "f 9 ", "missing"), ("f 1 ", "f 0 ", "missing"), ("f 1 ", "f -9 ", "missing"),
                             ("f 1 ", "f 1/ ", "a, a/b"), ("f 1 ", "f 1/2/3/4 ", "a, a/b"),
                             ("f 1 ", "f 1.0 ", "a, a/b"),
                             ("v 0.0 ", "v 0x0 ", "three decimal"), ("v 0.0 ", "v 0_0 ", "three decimal"),
                             ("v 0.0 ", "v ", "three decimal"), ("v 0.0 ", "v inf ", "three decimal"),
                             ("v 0.0 ", "v 1e400 ", "not finite"), ("f 1 2 3 4", "f 1 2", "three corners"),
                             (written, "", "there are no faces"), (vertices, "", "missing"),
                             ("f 1 2 3 4\n", "", "has the hash"), ("v 0.0 ", "v 1e-320 ", "has the hash")):
        assert old in written
        status, answer = check(written.replace(old, new, 1), fixed, text)
        assert status == 1 and reason in answer, answer


# --- hostile files ---------------------------------------------------------------------------------------------------

def test_extreme_numbers(check):
    tiny = moved(tetra(), (0, 1e-300, 0))
    far = moved(tetra(), (1e30, 5e-324, 0))
    far = [[(x, 3 * y, z) for x, y, z in face] for face in far]
    text = certify(tiny, far, [START, (1e29, 1e-308, 1, 1, 1e-200, 0, 0)], solid="none", margin=5e-324)
    assert check(tiny, far, text)[0] == 0
    huge = moved(box(), (1e307, 0, 0))
    assert check(box(), huge, certify(box(), huge, [START, (9e306, 9, 0, 1, 0, 0, 0)]))[0] == 0


def test_deep_cells(check):
    """2000 halvings, down both sides."""
    moving, fixed, text = case("both solid")
    for deep in (2000 * ["T"] + 2001 * ["P -1 0 0"], 2000 * ["T", "P -1 0 0"] + ["P -1 0 0"]):
        assert check(moving, fixed, text.replace("P -1 0 0", "\n".join(deep)))[0] == 0
    assert "the file ends too early" in check(moving, fixed, text.replace("P -1 0 0", "T " * 4000))[1]


def test_lower_at_zero(check):
    """A cell that is only one point."""
    poses = [START, (4, 0, 0, 1, 0, 0, 0)]
    text = certify(box(), WALL, poses, ("contact", 0, 0.0, 0.25), witness="cross 0x1p-2 moving 2 0 0 1")
    assert check(box(), WALL, text)[0] == 0
    assert check(box(), WALL, text.replace("P -1 0 0", "T T P -1 0 0 P -1 0 0 P -1 0 0"))[0] == 0


@pytest.mark.parametrize("name", ["meets a wall", "fixed inside at the start", "orbit"])
def test_random_changes(check, name):
    """No change of some bytes makes the checker fail, and no part of a certificate is one."""
    draw = random.Random(name)
    moving, fixed, text = case(name)
    for _ in range(20):
        changed = list(text)
        for _ in range(draw.choice((1, 1, 1, 3))):
            i = draw.randrange(len(changed))
            any_byte, likely = chr(draw.randrange(256)), draw.choice("0123456789-xp. \nTABP?#")
            changed[i] = draw.choice(("", changed[i] * 2, any_byte, likely))
        status, answer = check(moving, fixed, "".join(changed))
        assert status in (0, 1)
        assert check(moving, fixed, text[:draw.randrange(len(text) - 1)])[0] == 1
    mesh = obj(moving)
    for _ in range(25):
        i = draw.randrange(len(mesh))
        status, answer = check(mesh[:i] + draw.choice("0123456789-ef. \n\\#/") + mesh[i + 1:], fixed, text)
        assert status in (0, 1)


def test_program(tmp_path):
    moving, fixed, text = case("translation past")
    paths = [tmp_path / "a.obj", tmp_path / "b.OBJ", tmp_path / "c"]
    for path, content in zip(paths, (obj(moving), obj(fixed), text)): path.write_text(content)
    command = [sys.executable, verify.__file__]
    run = lambda *arguments: subprocess.run([*command, *arguments], capture_output=True, text=True)
    done = run(*paths)
    assert done.returncode == 0 and done.stdout.startswith("verified\nverdict: clear\n") and not done.stderr
    done = run(paths[1], paths[0], paths[2])
    assert done.returncode == 1 and done.stdout.count("\n") == 1 and not done.stderr
    done = run(*paths[:2])
    assert done.returncode == 2 and done.stdout.count("\n") == 1 and not done.stderr
    for arguments in ((), (*paths, paths[0]), (paths[0], paths[2], paths[2]), (*paths[:2], tmp_path / "none"),
                      (tmp_path / "none.stl", *paths[1:]), (*paths[:2], tmp_path)):
        assert verify.main(list(map(str, arguments)))[0] == 2
