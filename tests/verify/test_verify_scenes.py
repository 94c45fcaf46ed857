"""Scenes: certificates of many bodies. What tools/verify.py verifies, and what it refuses with a reason."""
import itertools
import math
import random

import pytest

from certificates import *  # noqa: F403
from certificates import verify  # noqa: F401
from test_verify import after, drop, line, swap
from test_verify_motions import CASES as MOTIONS, case as motion_case


# --- scenes, put together by the rules of the page -------------------------------------------------------------------

class Part:
    """A body of a scene: links as for certify(), and for each the numbers at all knots (none for a pose)."""
    def __init__(self, faces, *links, solid=False, radius=0):
        self.faces, self.links, self.solid, self.radius = faces, links, solid, radius

    def lines(self, count):
        rows = [sum((knots[i] for _, *knots in self.links if knots), ()) for i in range(count + 1)]
        return [f"body {digest(self.faces)} {len(self.faces)} {'solid' if self.solid else 'surface'} "
                f"{float(self.radius).hex()} {len(self.links)}",
                *(f"link {link[0]} {hexes(link[1:])}".rstrip() for link, *_ in self.links),
                *("knot " + hexes(row) for row in rows if row), "order " + " ".join(map(str, range(len(self.faces))))]


def turned_back(link):
    (word, *numbers), *knots = link
    return ((word[5:] if word.startswith("back ") else "back " + word, *numbers), *knots)


def composed(a, b):
    """The chain of a as seen from b: links, and the numbers of all of them at a knot."""
    a, b = list(a.links), list(b.links)
    while a and b and a[0] == b[0]: del a[0], b[0]
    chain = [turned_back(link) for link in b[::-1]] + a
    return ([link for link, *_ in chain] or [("pose", *START)],
            lambda i: sum((tuple(knots[i]) for _, *knots in chain if knots), ()))


def scene(parts, count=1, verdict="clear", witness=None, margins={}, untested=(), outside={}):
    """A verdict is as for certify(), with the two bodies at the end. Solid bodies have one connected part each."""
    lines = ["chasles certificate 1", f"scene {len(parts)} {count}"]
    for part in parts: lines += part.lines(count)
    kind, *numbers = verdict if isinstance(verdict, tuple) else (verdict,)
    last, upper = (numbers[0], numbers[1]) if kind == "contact" else (count - 1, 1)
    lines.append(" ".join(["verdict", kind, *(x.hex() if isinstance(x, float) else str(x) for x in numbers)]))
    for i, j in itertools.combinations(range(len(parts)), 2):
        a, b, margin = parts[i], parts[j], margins.get((i, j), 0)
        if kind == "start" and [i, j] != numbers: continue
        lines.append(f"untested {i} {j}" if (i, j) in untested else f"pair {i} {j} {float(margin).hex()}")
        if kind == "start" or (i, j) in untested: continue
        lines += outside.get((i, j), b.solid * [OUT_MOVING] + a.solid * [OUT_FIXED])
        chain, knot = composed(a, b)
        for piece in range(last + 1):
            steps = prove(a.faces, b.faces, knot(piece), knot(piece + 1), upper if piece == last else 1,
                          sum(map(Q, (a.radius, b.radius, margin))), ("chain", chain))
            assert steps, "the naive prover fails"
            lines += [f"proof {piece}", *steps]
    if witness: lines.append("witness " + witness)
    return "\n".join(lines) + "\n"


@pytest.fixture
def run(tmp_path):
    def run(meshes, text):
        paths = []
        for i, mesh in enumerate(meshes):
            paths.append(tmp_path / f"{i}.obj")
            paths[-1].write_text(obj(mesh) if isinstance(mesh, list) else mesh, "latin-1")
        paths.append(tmp_path / "certificate")
        paths[-1].write_bytes(text.encode("latin-1"))
        status, answer = verify.main(list(map(str, paths)))
        assert "the program failed" not in answer and (status == 1) == answer.startswith("not verified: ")
        return status, answer
    return run


# --- what is true is verified ----------------------------------------------------------------------------------------

SPINNING = (("turn", 0.125, 0.25, 1), (0,), (100,), (-50,))          # what carries bodies and needs no proof
DRIVING = (("velocity", 1, 2, 3), START, (5, 1, 2, 2, 1, 0, 1), (9, 9, 9, 1, -1, 0.5, 0))
SLIDE = (("slide", 1, 0, 0), (0,), (2,), (2,))
AWAY = (("pose", 0, 9, 0, 1, 0, 0, 0),)
BEFORE, NEXT, FLOOR = 0.5 - 2 ** -30, math.nextafter(0.5, 1), box((-20, -20, -9), (20, 20, -8))
TETRA = tetra()
HIT = f"cross {NEXT.hex()} moving 2 2 0 1"
SCENES = {
    "clear": dict(parts=[
        Part(box(), (("velocity", 0.5, 0.5, 0), START, (0.25, 1, 0, 1, 0.1, 0.2, 0.3)), solid=True),
        Part(WALL, solid=True), Part(TETRA, AWAY, (("turn", 1, 2, 0), (0,), (2,)), solid=True)],
        margins={(0, 1): 0.125, (1, 2): 0.25}),
    "pieces": dict(parts=[
        Part(TETRA, (("twist",), START, (0.25, 1, 0, 1, 0.1, 0.2, 0.3), (0.5, 1, 0, -1, -0.1, -0.2, -0.3)),
             radius=0.125), Part(WALL), Part(FLOOR, (("slide", 0, 0, 1), (0,), (1,), (-1,)))], count=2),
    "contact": dict(parts=[
        Part(TETRA, AWAY), Part(box(), SLIDE[:3]), Part(WALL), Part(FLOOR, (("pose", *START),))],
        verdict=("contact", 0, BEFORE, NEXT, 1, 2), witness=HIT),
    "contact in the second piece": dict(parts=[
        Part(WALL, (("slide", 1, 0, 0), (1,), (0,), (-2,), (9,)), solid=True), Part(box(), solid=True), Part(FLOOR)],
        count=3, verdict=("contact", 1, BEFORE, NEXT, 0, 1), witness=HIT.replace("moving", "fixed")),
    "contact at a reach": dict(parts=[
        Part(box(), SLIDE[:3], radius=0.25), Part(WALL, radius=0.125), Part(FLOOR, radius=1)], margins={(0, 1): 0.125},
        verdict=("contact", 0, 0.25 - 2 ** -30, math.nextafter(0.25, 1), 0, 1),
        witness="near " + math.nextafter(0.25, 1).hex() + " 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "start": dict(parts=[Part(FLOOR), Part(box(), (("slide", 1, 0, 0), (1.5,), (0,))), Part(FLOOR), Part(WALL)],
                  verdict=("start", 1, 3), witness="cross 0x0p+0 moving 2 2 0 1"),
    "start with a margin": dict(parts=[Part(FLOOR), Part(box()), Part(WALL, radius=0.5)], margins={(1, 2): 0.625},
                                verdict=("start", 1, 2), witness="near 0x0p+0 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "start inside": dict(parts=[Part(FLOOR, solid=True), Part(TETRA), Part(box((-9, -9, -9), (9, 9, 9)), solid=True)],
                         verdict=("start", 1, 2), witness="inside moving 0 0 7 1 2"),
    "untested": dict(parts=[Part(box()), Part(box(), (("slide", 1, 0, 0), (0.5,), (0.75,))), Part(WALL)],
                     untested=[(0, 1)], margins={(0, 2): 0.25}),
    "all untested": dict(parts=[Part(box()), Part(box())], untested=[(0, 1)]),
    "carried": dict(parts=[
        Part(box(), DRIVING, SPINNING), Part(WALL, DRIVING, SPINNING), Part(TETRA, DRIVING, SPINNING, AWAY),
        Part(TETRA, DRIVING, SPINNING, (("back pose", 0, 12, 0, 1, 0, 0, 0),), (("turn", 0, 0, 1), (0,), (1,), (0,)))],
        count=2),
    "carried in part": dict(parts=[
        Part(box(), SPINNING, AWAY, SLIDE), Part(WALL, SPINNING, AWAY, (("slide", 1, 0, 0), (0,), (1.5,), (1.5,))),
        Part(FLOOR, SPINNING)], count=2),
    "at rest": dict(parts=[Part(box()), Part(box(), AWAY), Part(TETRA, (("back pose", 0, 3, 0, 1, 1, 0, 0),)),
                           Part(WALL)], count=4),
    "one mesh": dict(parts=[Part(TETRA, (("pose", 3 * i, 0, 0, 2, i, 0, 0),), (("turn", 0, 0, 1), (0,), (i,)),
                                 solid=i % 2 == 0, radius=i / 8) for i in range(5)]),
    "one mesh meets itself": dict(parts=[
        Part(box(), SLIDE), Part(TETRA, AWAY), Part(box(), (("pose", 2, -0.25, -0.5, 1, 0, 0, 0),))], count=2,
        verdict=("contact", 0, BEFORE, NEXT, 0, 2), witness=f"cross {NEXT.hex()} moving 2 0 0 1"),
    "an arm": dict(parts=[
        Part(FLOOR, solid=True), Part(box(), (("turn", 0, 0, 1), (0,), (0.5,), (1,)), solid=True),
        Part(TETRA, (("turn", 0, 0, 1), (0,), (0.5,), (1,)), (("pose", 1.5, 0, 0, 1, 0, 0, 0),),
             (("turn", 0, 1, 0), (0,), (-0.5,), (0.25,)), solid=True),
        Part(ARM, (("turn", 0, 0, 1), (0,), (0.5,), (1,)), (("pose", 1.5, 0, 0, 1, 0, 0, 0),),
             (("turn", 0, 1, 0), (0,), (-0.5,), (0.25,)), (("slide", 1, 0, 0), (2,), (2,), (3,)), radius=0.25)],
        count=2),
}
TEXTS = {}


def case(name):
    if name not in TEXTS: TEXTS[name] = scene(**SCENES[name])
    return list({digest(part.faces): part.faces for part in SCENES[name]["parts"]}.values()), TEXTS[name]


@pytest.mark.parametrize("name", SCENES)
def test_true(run, name):
    meshes, text = case(name)
    for order in (meshes, meshes[::-1]):
        status, answer = run(order, text)
        assert status == 0, answer
    assert answer.count("\nbody ") == len(SCENES[name]["parts"])


def test_what_is_printed(run):
    meshes, text = case("contact at a reach")
    lines = run(meshes, text)[1].splitlines()
    assert [line.split(": ")[0] for line in lines[1:]] == [
        "verdict", "body 0", "link", "knot 0", "knot 1", "body 1", "body 2", "pairs with the margin 0.125",
        "pairs with the margin 0.0", "pieces", "steps"]
    assert lines[1].endswith(", but up to tau 0.25000000000000006, bodies 0 and 1")
    assert lines[2].endswith("0.obj surface, radius 0.25")
    assert lines[8].endswith(": 0-1") and lines[9].endswith(": 0-2 1-2")
    assert lines[-1] == f"steps: {sum(row.split()[0] in ('T', 'A', 'B', 'P') for row in text.splitlines())}"
    assert "\npairs untested: 0-1\n" in run(*case("untested"))[1]
    assert run(*case("all untested"))[1].endswith("\npairs untested: 0-1\npieces: 1\nsteps: 0")


CHAINS = [name for name, row in MOTIONS.items() if row.get("kind", ("screw",))[0] == "chain"]


def from_pair(row, text, at, carriers):
    """The pair certificate as one of a scene: the first links are those of the fixed body, and carriers are before."""
    chain, first, count = [], 0, len(row["poses"]) - 1
    for link in row["kind"][1]:
        size = Chain.SIZES[link[0].split()[-1]]
        chain.append((link, *[pose[first:first + size] for pose in row["poses"] if size]))
        first += size
    carriers = [(link, *knots[:1] * (count + 1)) for link, *knots in carriers]
    parts = [Part(row["moving"], *carriers, *chain[at:]),
             Part(row["fixed"], *carriers, *map(turned_back, chain[:at][::-1]))]
    for name, part, radius in zip(("moving", "fixed"), parts, row.get("radius", (0, 0))):
        part.radius, part.solid = radius, row.get("solid") in (name, "both")
    verdict, *rest = text[text.index("verdict"):].splitlines()
    return "\n".join(["chasles certificate 1", f"scene 2 {count}", *parts[0].lines(count), *parts[1].lines(count),
                      verdict + (" 0 1" if verdict != "verdict clear" else ""),
                      f"pair 0 1 {float(row.get('margin', 0)).hex()}",
                      *(row for row in rest if not row.startswith("order"))]) + "\n", parts


@pytest.mark.parametrize("name", CHAINS)
def test_pairs_as_scenes(run, name):
    """However the links are shared out, what is proven of the chain is proven of the scene."""
    moving, fixed, text = motion_case(name)
    for at in range(len(MOTIONS[name]["kind"][1]) + 1):
        for carriers in ((), (SPINNING, AWAY, (("back twist",), *DRIVING[1:]))):
            changed, parts = from_pair(MOTIONS[name], text, at, carriers)
            if any(part.links[len(carriers):] for part in parts) and composed(*parts)[0] == MOTIONS[name]["kind"][1]:
                status, answer = run([fixed, moving], changed)
                assert status == 0, answer


# --- what is false or malformed is refused, with the reason ----------------------------------------------------------

def at_pair(i, j, change):
    """The change, only in the lines of a pair."""
    def changed(text):
        rows = text.splitlines(True)
        first = next(k for k, row in enumerate(rows) if row.startswith(f"pair {i} {j} "))
        end = first + 1
        while end < len(rows) and rows[end].split()[0] not in ("pair", "untested", "witness"): end += 1
        return "".join(rows[:first]) + change("".join(rows[first:end])) + "".join(rows[end:])
    return changed


def at_body(i, change):
    def changed(text):
        starts = [k for k in range(len(text)) if text.startswith("\nbody ", k)] + [text.index("\nverdict")]
        return text[:starts[i] + 1] + change(text[starts[i] + 1:starts[i + 1] + 1]) + text[starts[i + 1] + 1:]
    return changed


def exchanged(a, b):
    """The lines of two pairs that follow each other."""
    def changed(text):
        i, j = text.index(f"pair {a[0]} {a[1]} "), text.index(f"pair {b[0]} {b[1]} ")
        end = min(k for k in (text.find(word, j + 1) for word in ("pair ", "untested ", "witness")) if k > 0)
        return text[:i] + text[j:end] + text[i:j] + text[end:]
    return changed


def nothing(text): return ""
def until(word): return lambda text: text[:text.index(word)]
def both(*changes): return lambda text: changes[1](changes[0](text))


FALSE = [
    # the head and the bodies
    ("clear", swap("scene 3 1", "scene 2 1"), "no body has mesh file 3"),
    ("clear", swap("scene 3 1", "scene 4 1"), "'body' and 5 words are expected, not verdict"),
    ("clear", swap("scene 3 1", "scene 1 1"), "'1' is not an integer that fits"),
    ("clear", swap("scene 3 1", "scene 3 0"), "'0' is not an integer that fits"),
    ("clear", swap("scene 3 1", "scene 3 2"), "'knot' and 7 words are expected, not order"),
    ("clear", swap("scene 3 1", "scene 3 1 1"), "'scene' and 2 words"),
    ("clear", swap("scene 3 1", f"scene {999 * '9'} 1"), "'body' and 5 words"),
    ("at rest", swap("scene 4 4", f"scene 4 {999 * '9'}"), "'proof 4' and 0 words are expected, not pair"),
    ("clear", swap("scene 3 1", "scenes 3 1"), "a certificate of a pair is for two meshes"),
    ("clear", at_body(1, nothing), "'body' and 5 words are expected, not verdict"),
    ("clear", at_body(1, swap(digest(WALL)[:9], "012345678")), "no mesh file has the hash"),
    ("clear", at_body(1, swap(digest(WALL), digest(WALL).upper())), "no mesh file has the hash"),
    ("clear", at_body(1, swap(digest(WALL), digest(box()))), "no body has mesh file 2"),
    ("clear", at_body(2, swap(" 4 solid", " 6 solid")), "the mesh file has 4 faces"),
    ("clear", at_body(2, swap(" 4 solid", " 04 solid")), "the mesh file has 4 faces"),
    ("clear", at_body(1, swap("solid", "both")), "unknown word 'both'"),
    ("clear", at_body(1, swap("solid 0x0.0p+0", "solid -0x1p+0")), "below 0"),
    ("clear", at_body(1, swap("solid 0x0.0p+0", "solid nan")), "'nan' is not"),
    ("clear", at_body(1, swap("0x0.0p+0 0", "0x0.0p+0 -1")), "'-1' is not an integer that fits"),
    ("clear", at_body(1, swap("0x0.0p+0 0", "0x0.0p+0 1")), "'link' and 6 words are expected, not order"),
    ("clear", at_body(2, swap("0x0.0p+0 2", "0x0.0p+0 1")), "'order' and 4 words are expected, not link"),
    ("clear", at_body(2, swap("0x0.0p+0 2", "0x0.0p+0 3")), "'link' and"),
    ("clear", at_body(2, drop("link pose")), "'link' and"),
    ("clear", at_body(2, after("link pose", "link pose " + hexes(START))), "'order' and 4 words are expected"),
    ("clear", at_body(2, line("link pose", "link pose " + hexes((1, 2, 3, 0, 0, 0, 0)))), "quaternion is 0"),
    ("clear", at_body(0, line("knot", "knot " + hexes((0, 0, 0, 0, 0, 0, 0)))), "quaternion is 0"),
    ("clear", at_body(0, swap("0x1.0000000000000p+0 0x1.9", "0x0p+0 0x1.9")), "half a turn"),
    ("clear", at_body(1, after("body", "knot")), "'order' and 6 words are expected, not knot"),
    ("at rest", at_body(1, after("link", 4 * "knot\n" + "knot")), "'order' and 6 words are expected, not knot"),
    ("clear", at_body(1, drop("order")), "'order' and 6 words are expected, not body"),
    ("clear", at_body(1, line("order", "order 0 1 2 3 4 4")), "no permutation"),
    ("clear", after("verdict", "order 0 1 2 3 4 5"), "'pair 0 1' and 1 words are expected, not order"),
    # the verdict
    ("clear", line("verdict", "verdict clear 0 1"), "unknown verdict"),
    ("clear", line("verdict", "verdict start"), "unknown verdict"),
    ("clear", line("verdict", "verdict start 0 1"), "a witness that fits"),
    ("contact", line("verdict", "verdict clear"), "does not separate"),
    ("contact", line("verdict", "verdict contact 0 0x1p-2 0x1p-1"), "unknown verdict"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " 2 1"), "'1' is not an integer that fits"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " 1 1"), "'1' is not an integer that fits"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " 1 4"), "'4' is not an integer that fits"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " -1 2"), "'-1' is not an integer that fits"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " 1 3"), "pair 1 3: the edge of the witness does not cross"),
    ("contact", swap(NEXT.hex() + " 1 2", NEXT.hex() + " 2 3"), "pair 2 3: "),
    ("contact", swap(BEFORE.hex(), "0x1.8p-1"), "LOWER <= UPPER"),
    ("contact", swap(BEFORE.hex(), NEXT.hex()), "pair 1 2, step 1: the plane does not separate"),
    ("contact", swap("contact 0", "contact 1"), "'1' is not an integer that fits"),
    ("contact in the second piece", swap("contact 1", "contact 0"), "'pair 0 2' and 1 words are expected, not proof"),
    ("contact in the second piece", swap("contact 1", "contact 2"), "pair 0 1, step 1: the plane does not separate"),
    ("contact in the second piece", at_pair(1, 2, until("proof 1")), "pair 1 2: 'proof 1' and 0 words"),
    ("contact in the second piece", at_pair(0, 2, until("proof 1")), "pair 0 2: 'proof 1' and 0 words"),
    ("start", swap("start 1 3", "start 1 2"), "'pair 1 2' and 1 words are expected, not pair 1 3"),
    ("start", both(swap("start 1 3", "start 1 2"), swap("pair 1 3", "pair 1 2")), "pair 1 2: the edge"),
    ("start", both(swap("start 1 3", "start 0 3"), swap("pair 1 3", "pair 0 3")), "pair 0 3: the edge"),
    ("start", drop("pair"), "'pair 1 3' and 1 words are expected, not witness"),
    ("start", line("pair", "untested 1 3"), "'pair 1 3' and 1 words are expected, not untested"),
    ("start", after("pair", "proof 0\nP -1 0 0"), "a witness that fits"),
    ("start", after("pair", OUT_MOVING), "a witness that fits"),
    ("start", after("verdict", "pair 0 1 0x0p+0"), "'pair 1 3' and 1 words"),
    ("start", at_body(1, swap("0x1.8000000000000p+0", "0x1.8p-1")), "does not cross"),
    ("start", at_body(1, swap("link slide", "link back slide")), "does not cross"),
    ("start with a margin", swap("pair 1 2 0x1.4", "pair 1 2 0x1.0"), "pair 1 2: the points of the witness"),
    ("start with a margin", at_body(2, swap("surface 0x1.0000000000000p-1", "surface 0x1p-2")), "too far"),
    ("start inside", at_body(2, swap("solid", "surface")), "is no solid"),
    ("start inside", swap("inside moving", "inside fixed"), "is no solid"),
    # the pairs
    ("clear", at_pair(0, 1, nothing), "'pair 0 1' and 1 words are expected, not pair 0 2"),
    ("clear", at_pair(0, 2, nothing), "'pair 0 2' and 1 words are expected, not pair 1 2"),
    ("clear", at_pair(1, 2, nothing), "'pair 1 2' and 1 words are expected, not the end"),
    ("contact", at_pair(2, 3, nothing), "'pair 2 3' and 1 words are expected, not witness"),
    ("contact", exchanged((0, 1), (0, 2)), "'pair 0 1' and 1 words are expected, not pair 0 2"),
    ("contact", exchanged((1, 3), (2, 3)), "'pair 1 3' and 1 words are expected, not pair 2 3"),
    ("clear", swap("pair 0 1", "pair 1 0"), "'pair 0 1' and 1 words"),
    ("clear", swap("pair 0 1", "pair 00 1"), "'pair 0 1' and 1 words"),
    ("clear", at_pair(0, 1, lambda t: t + t), "'pair 0 2' and 1 words are expected, not pair 0 1"),
    ("clear", lambda t: t + "pair 1 3 0x0p+0\n", "nothing more is expected"),
    ("clear", lambda t: t + "witness inside moving 0 0 7 1 2\n", "nothing more is expected"),
    ("contact", drop("witness"), "a witness that fits"),
    ("contact", at_pair(1, 2, lambda t: "untested 1 2\n"), "'pair 1 2' and 1 words are expected, not untested"),
    ("untested", swap("untested 0 1", "untested 1 0"), "'untested 0 1' and 0 words"),
    ("untested", swap("untested 0 1", "untested 0 2"), "'untested 0 1' and 0 words"),
    ("untested", swap("untested 0 1", "untested 0 1 0x0p+0"), "'untested 0 1' and 0 words"),
    ("untested", swap("untested 0 1", "tested 0 1"), "'pair 0 1' and 1 words"),
    ("untested", after("untested", "proof 0\nP -1 0 0"), "'pair 0 2' and 1 words are expected, not proof"),
    ("clear", swap("pair 0 1 0x1.0000000000000p-3", "pair 0 1"), "'pair 0 1' and 1 words"),
    ("clear", swap("pair 0 1 0x1.0000000000000p-3", "pair 0 1 -0x1p-3"), "the margin is below 0"),
    ("clear", swap("pair 0 1 0x1.0000000000000p-3", "pair 0 1 0x1p+1"), "pair 0 1, step "),
    ("untested", swap("pair 0 2 0x1.0000000000000p-2", "pair 0 2 0x1p+0"), "pair 0 2, step 1: the plane does not"),
    ("clear", at_pair(0, 2, drop("outside moving")), "pair 0 2: no 'outside moving' for the part of face 0"),
    ("clear", at_pair(1, 2, drop("outside fixed")), "pair 1 2: no 'outside fixed' for the part of face 0"),
    ("clear", at_body(0, swap("solid", "surface")), "pair 0 1: the moving body is no solid"),
    ("contact", at_pair(0, 1, after("pair", OUT_MOVING)), "pair 0 1: the fixed body is no solid"),
    ("contact", at_pair(1, 3, line("P", "?")), "pair 1 3, step 1: the certificate is incomplete"),
    ("contact", at_pair(1, 2, line("P", "P 1 0 0")), "pair 1 2, step 1: the plane does not separate"),
    ("contact", at_pair(0, 1, line("P", "T P 0 1 0")), "pair 0 1, step 3: 'pair' is not possible here"),
    ("contact", at_pair(2, 3, lambda t: t + "P -1 0 0\n"), "a witness that fits"),
    # the motions
    ("carried", at_body(1, swap("link turn", "link back turn")), "pair 0 1, step 1: the plane does not separate"),
    ("carried", at_body(1, swap("0x1.9000000000000p+6", "0x1.9000000000001p+6")), "pair 0 1, step 1: "),
    ("carried", at_body(2, swap("link pose 0x0.0p+0 0x1.2", "link back pose 0x0.0p+0 0x1.2")), "step 1: "),
    ("contact", at_body(1, swap("link slide", "link back slide")), "the edge of the witness does not cross"),
    ("contact", at_body(0, swap("0x1.2000000000000p+3", "0x1.0p-1")), "pair 0 1, step 1: the plane does not separate"),
    ("at rest", at_body(2, swap("link back pose", "link pose")), "step 1: "),
    ("pieces", at_body(1, lambda t: t.replace("surface 0x0.0p+0", "surface 0x1p+2")), "pair 0 1, step "),
    ("an arm", at_body(3, swap("link slide", "link back slide")), "pair "),
    ("an arm", at_body(3, line("order", "order 0 3 1 2")), "pair "),
    ("an arm", at_body(2, line("link turn", "link back turn 0x0p+0 0x0p+0 0x1p+0")), "pair "),
]


@pytest.mark.parametrize("name, change, reason", FALSE, ids=[f"{i}-{row[0]}" for i, row in enumerate(FALSE)])
def test_false(run, name, change, reason):
    meshes, text = case(name)
    changed = change(text)
    assert changed != text
    status, answer = run(meshes, changed)
    assert status == 1 and reason in answer and "\n" not in answer, answer
    assert "certificate, line " in answer


@pytest.mark.parametrize("name, change", [
    ("carried", at_body(0, swap("knot 0x0.0p+0", "knot -0x0.0p+0"))),
    ("carried", at_body(0, swap("link turn 0x1.0000000000000p-3", "link turn 0x1p-3"))),
    ("carried in part", at_body(2, swap("0x1.9000000000000p+6", "0x1.9p+6"))),
])
def test_other_words_of_a_number_are_the_same_link(run, name, change):
    meshes, text = case(name)
    assert change(text) != text and run(meshes, change(text))[0] == 0


def test_meshes(run):
    """Each different mesh once: none is missing, none is too much, none comes twice, and none is another one."""
    meshes, text = case("contact")
    for given, reason in ((meshes[1:], "no mesh file has the hash"), (meshes[:-1], "no mesh file has the hash"),
                          (meshes + [tetra((0, 0, 0), (2, 0, 0))], "no body has mesh file 5"),
                          (meshes + meshes[:1], "two mesh files have the same faces"),
                          ([moved(meshes[0], (2 ** -40, 0, 0)), *meshes[1:]], "no mesh file has the hash"),
                          ([meshes[0][1:], *meshes[1:]], "no mesh file has the hash"),
                          ([*meshes[:2], obj(meshes[2]) + "f 1 2\n", *meshes[3:]], "file mesh 3, line 15: a face has")):
        status, answer = run(given, text)
        assert status == 1 and reason in answer, answer
    meshes, text = case("clear")
    assert "body 1 is no solid: an edge of face 1" in run([meshes[0], WALL[1:], meshes[2]], text.replace(
        f"{digest(WALL)} 6", f"{digest(WALL[1:])} 5"))[1]
    pair = certify(box(), WALL, [START, START])
    assert run([box(), WALL], pair)[0] == 0
    for given in ([box()], [box(), WALL, TETRA]): assert "is for two meshes" in run(given, pair)[1]


@pytest.mark.parametrize("name", ["clear", "contact in the second piece", "an arm", "one mesh"])
def test_damage(run, name):
    """No line can be left out or come twice, no part is a scene, and no changed bytes make the checker fail."""
    meshes, text = case(name)
    draw, rows = random.Random(name), text.splitlines(True)
    for i in range(0, len(rows), 1 + len(rows) // 40):
        for new in ([], 2 * rows[i:i + 1]):
            if new and new[0].startswith("outside"): continue   # at least one is needed
            assert run(meshes, "".join(rows[:i] + new + rows[i + 1:]))[0] == 1, rows[i]
    for _ in range(40):
        changed = list(text)
        for _ in range(draw.choice((1, 1, 3))):
            i = draw.randrange(len(text))
            likely = draw.choice("0123456789-xp. \nTABP?#")
            changed[i] = draw.choice(("", changed[i] * 2, chr(draw.randrange(256)), likely))
        assert run(meshes, "".join(changed))[0] in (0, 1)
        assert run(meshes, text[:draw.randrange(len(text) - 1)])[0] == 1
