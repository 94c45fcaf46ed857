"""Sweeps, poses of two bodies, and chains: what tools/verify.py verifies, and what it refuses with a reason."""
import math
import random
from fractions import Fraction as Q

import pytest

from certificates import *  # noqa: F403
from certificates import add, check, cross, dot, product_of, rotate, times, verify  # noqa: F401
from test_verify import after, drop, line, swap


# --- certificates ----------------------------------------------------------------------------------------------------

def in_world(pose, fixed):
    """Fourteen numbers for a pose of seven, seen from the one of the fixed body (of small integers)."""
    t, q = fixed[:3], fixed[3:]
    return (*map(float, (*add(t, rotate([Q(x) for x in q], pose[:3])), *product_of(q, pose[3:]))), *fixed)


LOW_ROOF = box((-9, 3.5, -9), (9, 4.5, 9))      # the tip of ARM meets it at sin(angle) = 0.7
ANGLE = math.asin(0.7)


def meets(tau, **more):
    """The verdict and the witness of ARM and LOW_ROOF."""
    low, high = tau - 2 ** -20, tau + 2 ** -20
    return {"moving": ARM, "fixed": LOW_ROOF, "verdict": ("contact", 0, low, high),
            "witness": f"cross {high.hex()} moving 0 2 2 1", **more}


# A sweep by a quarter turn: N = 2^(1/2) w, v = w z; tan(angle / 2) = tau / (N / w + tau (1 - N / w)).
SWEEP_TAU = math.tan(ANGLE / 2) * math.sqrt(2) / (1 + math.tan(ANGLE / 2) * (math.sqrt(2) - 1))
EVEN_TAU = ANGLE / (math.pi / 2)
SCREW_TAU = math.tan(ANGLE / 2)
WORLD = [(1, 2, 3, 1, 0, 2, 2), (-4, 0, 1, 2, 1, 0, 2)]
EIGHTH = (0, 0, 0, math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8))
EIGHTH_BACK = (0, 0, 0, math.cos(math.pi / 8), 0, 0, -math.sin(math.pi / 8))
PLANES = [["P -1 0 0"]]
SLIDES = {"moving": box(), "fixed": WALL, "poses": [(0,), (2,)], "kind": ("chain", [("slide", 1, 0, 0)]),
          "verdict": ("contact", 0, BELOW_HALF, math.nextafter(0.5, 1)), "steps": PLANES}
ROBOT = [("pose", 0, 0, -1, 1, 0, 0, 0), ("turn", 0, 0, 2), ("slide", 1, 0, 1), ("back turn", 1, -1, 0),
         ("pose", -0.5, 0.25, 0, 2, 0.5, 0, 0), ("back slide", 0, 1, 0)]
STEADY = ("chain", [("slide", 1, 2, 3), ("back turn", 1, 1, 0), ("velocity", 1, 0, 2)])
BIG = box((-9, -9, -9), (9, 9, 9))
CASES = {
    "sweep past a wall": dict(moving=box(), fixed=WALL, poses=[START, (0.25, 1, 0, 1, 0.1, 0.2, 0.3)], solid="both",
                              kind=("sweep", (0.5, 0.5, 0.5)), outside=(OUT_MOVING, OUT_FIXED)),
    "sweep in three pieces": dict(moving=tetra(), fixed=WALL, poses=[
        START, (0.5, 1, 0, 3, 1, 0, 0), (-1, 1, 0, 1, 0, 0, 1), (0.2, 1, 3, 0, 0, 1, 1)], kind=("sweep", (0, 0.25, 0))),
    "sweep without a turn": dict(SLIDES, poses=ARRIVE, kind=("sweep", (1, 2, 3)),
                                 verdict=("contact", 0, BELOW_HALF, 0.5), witness="cross 0x1p-1 moving 2 0 0 1"),
    "sweep meets a roof": meets(SWEEP_TAU, poses=TURN, kind=("sweep", (0, 0, 0))),
    "sweep with margin and radii": dict(moving=box(), fixed=WALL, poses=[START, (0.25, 0, 0, 5, 0, 0, 1)],
                                        radius=(0.25, 0.125), margin=0.25, kind=("sweep", (1, 0, 0))),
    "sweep starts in contact": dict(moving=box(), fixed=WALL, poses=[(1.25, 0, 0, 8, 0.5, 0, 0.25), ARRIVE[1]],
                                    verdict="start", kind=("sweep", (1, 1, 1)), witness="cross 0x0p+0 moving 2 2 0 1"),
    "sweep starts inside": dict(moving=box(), fixed=BIG, poses=[(0, 0, 0, 8, 1, 2, 3), ARRIVE[1]], verdict="start",
                                solid="fixed", kind=("sweep", (1, 1, 1)), witness="inside moving 0 0 7 1 2"),
    "two screws meet": meets(SCREW_TAU, poses=[in_world(*pair) for pair in zip(TURN, WORLD)]),
    "two sweeps meet": meets(SWEEP_TAU, poses=[in_world(*pair) for pair in zip(TURN, WORLD)],
                             kind=("sweep", (0, 0, 0))),
    "two screws": dict(moving=box(), fixed=WALL, poses=[in_world(*pair) for pair in zip(
        (START, (0.25, 1, -1, 8, 1, 0, 1), (0.5, 0, 0, 1, 0, 0, 0)), (*WORLD, START))], solid="both",
        outside=(OUT_MOVING, OUT_FIXED)),
    "velocity past a wall": dict(moving=box(), fixed=WALL, poses=[START, (0.25, 1, 0, 1, 0.1, 0.2, 0.3)], solid="both",
                                 kind=("chain", [("velocity", 0.5, 0.5, 0)]), outside=(OUT_MOVING, OUT_FIXED)),
    "twist past a wall": dict(moving=tetra(), fixed=WALL, poses=[START, (0.25, 1, 0, 1, 0.1, 0.2, 0.3),
                                                                 (0.5, 1, 0, -1, -0.1, -0.2, -0.3), START],
                              kind=("chain", [("twist",)])),
    "velocity meets a roof": meets(EVEN_TAU, poses=TURN, kind=("chain", [("velocity", 0, 0, 0)])),
    "twist meets a roof": meets(EVEN_TAU, poses=TURN, kind=("chain", [("twist",)])),
    "turn meets a roof": meets(EVEN_TAU, poses=[(0,), (math.pi / 2,)], kind=("chain", [("turn", 0, 0, 5)])),
    "two velocities meet": meets(EVEN_TAU, poses=[(*START, *START), (*EIGHTH_BACK, *EIGHTH)],
                                 kind=("chain", [("back velocity", 0, 0, 0), ("velocity", 0, 0, 0)])),
    "two twists meet": meets(EVEN_TAU, poses=[(*START, *START), (*EIGHTH_BACK, *EIGHTH)],
                             kind=("chain", [("back twist",), ("twist",)])),
    "a turn back meets": meets(EVEN_TAU, poses=[(0,), (-math.pi / 2,)], kind=("chain", [("back turn", 0, 0, 1)])),
    "a turn about another place": meets(EVEN_TAU, poses=[(0,), (math.pi / 2,)], kind=("chain", [
        ("pose", 1, 2, 3, 1, 2, 0, 1), ("pose", 0, 0, 0, 1, 0, 0, 0), ("back pose", 1, 2, 3, 1, 2, 0, 1),
        ("turn", 0, 0, 1)])),
    "slide meets a wall": dict(SLIDES, witness=f"cross {math.nextafter(0.5, 1).hex()} moving 2 2 0 1", solid="both",
                               outside=(OUT_MOVING, OUT_FIXED)),
    "slide meets its reach": dict(SLIDES, verdict=("contact", 0, math.nextafter(0.25, 0), math.nextafter(0.25, 1)),
                                  radius=(0.25, 0.125), margin=0.125, witness="near "
                                  + math.nextafter(0.25, 1).hex() + " 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "slide in the second piece": dict(SLIDES, poses=[(-1,), (0,), (2,)], verdict=(
        "contact", 1, BELOW_HALF, math.nextafter(0.5, 1)), steps=2 * PLANES,
        witness=f"cross {math.nextafter(0.5, 1).hex()} moving 2 2 0 1"),
    "contact not after 0": dict(SLIDES, verdict=("contact", 0, 0.0, 0.75), witness="cross 0x1.8p-1 moving 2 2 0 1"),
    "two slides": dict(SLIDES, poses=[(0.5, 0.5), (1.5, -0.5)], kind=("chain", [("slide", 1, 0, 0), (
        "back slide", 1, 0, 0)]), witness=f"cross {math.nextafter(0.5, 1).hex()} moving 2 2 0 1"),
    "robot": dict(moving=tetra(), fixed=WALL, poses=[(0, 0, 0, 0), (1, -0.5, 1, 0.25), (0.5, 0.25, -2, 0)],
                  kind=("chain", ROBOT), solid="both", outside=(OUT_MOVING, OUT_FIXED)),
    "chain of nothing": dict(moving=box(), fixed=WALL, poses=[(), ()], kind=("chain", [("pose", *START)])),
    "chain starts in contact": dict(moving=box(), fixed=WALL, poses=[(0.125, 0.125, 1, 0, 0, 8, 1, 0, 0)] * 2,
                                    kind=STEADY, verdict="start", witness="cross 0x0p+0 moving 2 0 0 1"),
    "chain starts near": dict(moving=box(), fixed=WALL, poses=[(0.125, 0.125, 0.5, 0, 0, 8, 1, 0, 0)] * 2,
                              radius=(1, 0), kind=STEADY, verdict="start",
                              witness="near 0x0p+0 1 0 1 2 1 0 0 0 0 1 2 18 0 18"),
    "chain starts inside": dict(moving=box(), fixed=BIG, poses=[(0.125, 0.125, 1, 0, 0, 8, 1, 0, 0)] * 2, solid="fixed",
                                kind=STEADY, verdict="start", witness="inside moving 0 0 7 1 2"),
    "chain with fixed inside": dict(moving=BIG, fixed=box(), poses=[(0.125, 0.125, 1, 0, 0, 8, 1, 0, 0)] * 2,
                                    kind=STEADY, solid="both", verdict="start", witness="inside fixed 0 0 7 1 2"),
}
TEXTS = {}


def case(name):
    if name not in TEXTS: TEXTS[name] = certify(**CASES[name])
    return CASES[name]["moving"], CASES[name]["fixed"], TEXTS[name]


@pytest.mark.parametrize("name", CASES)
def test_true(check, name):
    moving, fixed, text = case(name)
    status, answer = check(moving, fixed, text)
    assert status == 0, answer
    kind = CASES[name].get("kind", ("screw",))
    assert f"motion: {kind[0]}" in answer and answer.count("link: ") == (len(kind[1]) if kind[0] == "chain" else 0)
    if kind[0] == "sweep": assert "about " + " ".join(str(float(x)) for x in kind[1]) in answer


def replaced(start, index, word):
    """The word in all lines that start so."""
    def change(text):
        rows = [row.split() for row in text.splitlines()]
        for row in rows:
            if row[0] == start: row[index] = word
        return "\n".join(map(" ".join, rows)) + "\n"
    return change


def later(start, new):
    """The last line that starts so, by another one."""
    def change(text):
        rows = text.splitlines()
        i = max(i for i, row in enumerate(rows) if row.startswith(start))
        return "\n".join([*rows[:i], *([new] if new else []), *rows[i + 1:]]) + "\n"
    return change


NEXT = math.nextafter(0.5, 1)
FALSE = [
    # sweeps and poses
    ("sweep past a wall", drop("centre"), "'centre' and 3 words are expected"),
    ("sweep past a wall", line("centre", "centre 0x0p+0 0x0p+0"), "'centre' and 3 words"),
    ("sweep past a wall", swap("motion sweep", "motion screw"), "'pose' and 7 words are expected, not centre"),
    ("sweep past a wall", swap("motion sweep 1", "motion sweep 1 1"), "'motion sweep' and 1 words"),
    ("sweep past a wall", swap("motion sweep 1", "motion sweep 0"), "not an integer that fits"),
    ("sweep past a wall", swap("motion sweep 1", "motion sweep 2"), "'pose' and 7 words are expected, not verdict"),
    ("sweep past a wall", later("pose", "pose " + hexes((0, 0, 0, 0, 1, 0, 0))), "half a turn"),
    ("sweep past a wall", later("pose", "pose " + hexes((0, 0, 0, 0, 0, 0, 0))), "quaternion is 0"),
    ("sweep past a wall", later("pose", "pose " + hexes((0, 0, 0, 0, 1, 0))), "'pose' and 7 words"),
    ("sweep past a wall", later("pose", "pose " + hexes(START + START)), "'pose' and 7 words"),
    ("sweep past a wall", later("pose", "pose " + hexes((1.25, 1, 0, 1, 0.1, 0.2, 0.3))), "does not separate"),
    ("sweep past a wall", drop("outside moving"), "no 'outside moving'"),
    ("sweep past a wall", later("P", "?"), "incomplete"),
    ("sweep in three pieces", later("P", None), "ends too early"),
    ("sweep in three pieces", line("centre", "centre " + hexes((0, 90, 0))), "does not separate"),
    ("sweep without a turn", swap(BELOW_HALF.hex(), "0x1p-1"), "does not separate"),
    ("sweep without a turn", swap("cross 0x1p-1", "cross " + BELOW_HALF.hex()), "does not cross"),
    ("sweep meets a roof", swap("motion sweep 1\n", "motion screw 1\n"), "'pose' and 7"),
    ("sweep meets a roof", lambda t: drop("centre")(t.replace("sweep", "screw")), "does not"),
    ("sweep meets a roof", replaced("centre", 1, "0x1p-9"), "does not"),
    ("sweep meets a roof", later("pose", "pose " + hexes((0, 0, 0, 1, 0, 0, -1))), "does not"),
    ("sweep meets a roof", later("pose", "pose " + hexes((0, 0, 0, 1, 0, 0, 0.99))), "does not"),
    ("sweep with margin and radii", swap("margin 0x1.0000000000000p-2", "margin 0x1.8p-1"), "does not separate"),
    ("sweep starts in contact", swap("pose 0x1.4000000000000p+0", "pose 0x1.4p-1"), "does not cross"),
    ("sweep starts inside", swap("7 1 2", "0 0 0"), "direction is 0"),
    ("sweep starts inside", swap("pose 0x0.0p+0", "pose 0x1.8p+3"), "not inside"),
    ("two screws meet", later("pose", "pose " + hexes(START)), "'pose' and 14 words"),
    ("two screws meet", later("pose", "pose " + hexes((*START, 0, 0, 0, 0, 0, 0, 0))), "quaternion is 0"),
    ("two screws meet", later("pose", "pose " + hexes((*START, 0, 0, 0, 0, 2, -2, 1))), "half a turn"),
    ("two screws meet", later("pose", "pose " + hexes((*in_world(TURN[1], WORLD[1])[:7], *WORLD[0]))), "does not"),
    ("two screws meet", later("pose", "pose " + hexes((*in_world(TURN[1], WORLD[1])[7:], *WORLD[1]))), "does not"),
    ("two screws meet", replaced("pose", 13, "-0x1p+0"), "does not"),
    ("two sweeps meet", replaced("pose", 13, "-0x1p+0"), "does not"),
    ("two screws", swap(OUT_FIXED, "outside fixed 0 0 0 0 0"), "direction is 0"),
    # the text of a chain
    ("robot", swap("chain 2 6", "chain 2 5"), "'knot' and 3 words are expected, not link"),
    ("robot", swap("chain 2 6", "chain 2 7"), "'link' and"),
    ("robot", swap("chain 2 6", "chain 2"), "'motion chain' and 2 words"),
    ("robot", swap("chain 2 6", "chain 2 0"), "not an integer that fits"),
    ("robot", swap("chain 2 6", "chain 0 6"), "not an integer that fits"),
    ("robot", swap("chain 2 6", "chain 1 6"), "'verdict' and"),
    ("robot", swap("chain 2 6", "chain 3 6"), "'knot' and 4 words are expected, not verdict"),
    ("robot", swap("chain 2 6", f"chain {999 * '9'} 6"), "'knot' and 4 words"),
    ("robot", swap("chain 2 6", f"chain 2 {999 * '9'}"), "'link' and"),
    ("robot", swap("link turn", "link spin"), "unknown link"),
    ("robot", swap("link turn", "link forth turn"), "'turn' is not a hexadecimal"),
    ("robot", swap("link turn", "link back back turn"), "is not a hexadecimal number"),
    ("robot", swap("link back turn", "link back"), "unknown link"),
    ("robot", line("link turn", "link back"), "unknown link"),
    ("robot", line("link turn", "link"), "'link' and 1 words"),
    ("robot", line("link turn", "link turn 0x1p+0 0x0p+0"), "wrong count"),
    ("robot", line("link turn", "link twist 0x1p+0"), "wrong count"),
    ("robot", line("link turn", "link turn 0x0p+0 0x0p+0 -0x0p+0"), "the axis is 0"),
    ("robot", line("link turn", "link turn 0x0p+0 0x0p+0 0x0p+0"), "the axis is 0"),
    ("robot", line("link turn", "link turn 0x0p+0 0x0p+0 inf"), "'inf' is not"),
    ("robot", line("link pose", "link pose " + hexes((1, 2, 3, 0, 0, 0, 0))), "quaternion is 0"),
    ("robot", later("knot", "knot " + hexes((0.5, 0.25, -2))), "'knot' and 4 words"),
    ("robot", later("knot", "knot " + hexes((0.5, 0.25, -2, 0, 0))), "'knot' and 4 words"),
    ("robot", later("knot", "pose " + hexes((0.5, 0.25, -2, 0))), "'knot' and 4 words"),
    ("robot", later("knot", "knot " + hexes((0.5, 2.5, -2, 0))), "does not separate"),
    ("robot", later("knot", "knot " + hexes((1e300, 0.25, -2, 0))), "an angle is too large"),
    ("robot", later("knot", "knot " + hexes((0.5, 1e300, -2, 0))), "does not separate"),
    ("robot", swap("link back turn", "link turn"), "does not separate"),
    ("robot", later("T", None), "does not separate"),
    ("robot", swap("margin 0x0.0p+0", "margin 0x1p+0"), "does not separate"),
    ("robot", drop("outside fixed"), "no 'outside fixed'"),
    ("two velocities meet", swap("link back", "link"), "does not"),
    ("two velocities meet", later("knot", "knot " + hexes((*EIGHTH, *EIGHTH))), "does not"),
    ("two velocities meet", later("knot", "knot " + hexes((*EIGHTH_BACK, 0, 0, 0, 0, 1, 2, 3))), "half a turn"),
    ("two velocities meet", later("knot", "knot " + hexes((*EIGHTH_BACK, 0, 0, 0, 0, 0, 0, 0))), "quaternion is 0"),
    ("two velocities meet", replaced("link", 2, "0x1p-4"), "unknown link"),
    ("two twists meet", swap("link back", "link"), "does not"),
    ("velocity meets a roof", replaced("link", 2, "0x1p-4"), "does not"),
    ("velocity meets a roof", later("knot", "knot " + hexes((0, 0, 0, 1, 0, 0, -1))), "does not"),
    ("velocity meets a roof", swap("knot 0x0.0p+0 0x0.0p+0", "knot 0x0.0p+0 0x1p-10"), "does not"),
    ("twist meets a roof", swap("knot 0x0.0p+0 0x0.0p+0", "knot 0x0.0p+0 -0x1p-10"), "does not"),
    ("turn meets a roof", later("knot", f"knot {(-math.pi / 2).hex()}"), "does not"),
    ("turn meets a roof", swap("link turn", "link back turn"), "does not"),
    ("turn meets a roof", swap("verdict contact 0", "verdict contact 1"), "not an integer that fits"),
    ("a turn back meets", swap("link back turn", "link turn"), "does not"),
    ("a turn about another place", swap("link back pose", "link pose"), "does not"),
    ("slide meets a wall", swap(BELOW_HALF.hex(), "0x1p-1"), "does not separate"),
    ("slide meets a wall", lambda t: t.replace(NEXT.hex(), "0x1p-1"), "does not cross"),
    ("slide meets a wall", swap("knot 0x0.0p+0", "knot 0x1p-50"), "does not separate"),
    ("slide meets a wall", swap("cross", "inside"), "a witness that fits"),
    ("slide meets a wall", line("verdict", "verdict clear"), "does not separate"),
    ("slide meets a wall", swap("moving 2 2 0 1", "moving 0 0 0 1"), "does not cross"),
    ("slide meets a wall", swap("moving 2 2 0 1", "moving 2 2 1 1"), "does not cross"),
    ("slide meets a wall", swap("moving 2 2 0 1", "moving 2 2 0 2"), "passes beside"),
    ("slide meets a wall", swap("moving 2 2 0 1", "moving 2 0 0 1"), "passes beside"),   # on an edge: undecided
    ("slide meets a wall", swap("moving 2 2 0 1", "moving 2 2 0 3"), "not an integer that fits"),
    ("slide meets its reach", swap("18 0 18", "19 0 18"), "too far apart"),
    ("slide meets its reach", lambda t: t.replace(math.nextafter(0.25, 1).hex(), "0x1p-2"), "too far apart"),
    ("slide in the second piece", swap("proof 1\n", ""), "'proof 1' and 0 words are expected, not P"),
    ("slide in the second piece", swap("contact 1", "contact 0"), "a witness that fits"),
    ("contact not after 0", swap("0x0.0p+0 0x1.8", "0x1p-1 0x1.8"), "does not separate"),
    ("chain of nothing", after("knot", "knot"), "'verdict' and"),
    ("chain starts near", swap("radius 0x1.0000000000000p+0", "radius 0x1p-8"), "too far apart"),
    ("chain starts inside", swap("7 1 2", "0 0 0"), "direction is 0"),
    ("chain starts inside", swap("solid fixed", "solid none"), "is no solid"),
    ("chain with fixed inside", swap("7 1 2", "0 0 0"), "direction is 0"),
    ("chain with fixed inside", swap("inside fixed", "inside moving"), "not inside"),
]


@pytest.mark.parametrize("name, change, reason", FALSE, ids=[f"{i}-{row[0]}" for i, row in enumerate(FALSE)])
def test_false(check, name, change, reason):
    moving, fixed, text = case(name)
    changed = change(text)
    assert changed != text
    status, answer = check(moving, fixed, changed)
    assert status == 1 and reason in answer and "\n" not in answer, answer
    assert "certificate, line " in answer


@pytest.mark.parametrize("name", [name for name in CASES if "meets" in name and "slide" not in name])
def test_moved_corner(check, name):
    """The tip is a little longer, and meets the roof before LOWER; or shorter, and does not yet at UPPER."""
    moving, fixed, text = case(name)
    for by, reason in ((2 ** -15, "does not separate"), (-2 ** -15, "does not cross")):
        other = [[(p[0] + by, *p[1:]) if p[0] == 5 else p for p in face] for face in moving]
        status, answer = check(other, fixed, text.replace(digest(moving), digest(other)))
        assert status == 1 and reason in answer


@pytest.mark.parametrize("name", ["robot", "twist past a wall", "two velocities meet", "sweep in three pieces"])
def test_steps(check, name):
    """No step can be left out, and no plane can be turned around."""
    moving, fixed, text = case(name)
    rows = text.splitlines()
    for i in [i for i, row in enumerate(rows) if row.split()[0] in ("T", "A", "B", "P")][::7]:
        changes = [[], ["?"], ["P 0 0 0"], [rows[i].lower()]]
        if rows[i][0] == "P": changes.append(["P " + " ".join(str(-int(x)) for x in rows[i].split()[1:])])
        for new in changes: assert check(moving, fixed, "\n".join(rows[:i] + new + rows[i + 1:]))[0] == 1


@pytest.mark.parametrize("name", ["robot", "two twists meet", "two sweeps meet", "chain with fixed inside"])
def test_random_changes(check, name):
    draw = random.Random(name)
    moving, fixed, text = case(name)
    for _ in range(30):
        changed, head = list(text), text.index("\nverdict")
        for _ in range(draw.choice((1, 1, 3))):
            i = draw.randrange(text.index("\nmotion"), head if draw.random() < 0.7 else len(text))
            changed[i] = draw.choice(("", changed[i] * 2, chr(draw.randrange(256)), draw.choice("0123456789-xp. \n#")))
        assert check(moving, fixed, "".join(changed))[0] in (0, 1)
        assert check(moving, fixed, text[:draw.randrange(len(text) - 1)])[0] == 1


def test_extreme_numbers(check):
    """Huge ranges of exponents take no time, and an axis that is far away does no harm."""
    apart = dict(moving=box(), fixed=WALL, steps=PLANES)
    for kind, knots in (
            ([("twist",)], [START, (0.25, 0, 0, 1, 1e-30, 0, 1e-300)]),
            ([("twist",)], [START, (0.25, 0, 0, 1e300, 0, 5e-324, 0)]),
            ([("velocity", 1e-300, 0, 5e-324)], [START, (0.25, 5e-324, 0, 1, 1e-200, 0, 0)]),
            ([("turn", 1e300, 5e-324, 1e-300), ("slide", 5e-324, 0, 0)], [(1e-308, 5e-324), (0, 0.25)]),
            ([("turn", 0, 0, 1), ("back turn", 0, 0, 1)], [(1e15, 1e15), (1e15, 1e15)]),
            ([("slide", 1, 0, 0), ("back slide", 1, 0, 0)], [(1e18, 1e18), (1e18, 1e18)])):
        text = certify(**apart, poses=knots, kind=("chain", kind))
        status, answer = check(box(), WALL, text)
        assert status == 0, answer
        assert check(box(), WALL, text.replace("P -1 0 0", "T " * 2000 + "P -1 0 0 " * 2001))[0] == 0
        assert "does not" in check(box(), WALL, text.replace("margin 0x0.0p+0", "margin 0x1.0p+0"))[1]
    far = [[(x + 1e30, y, z) for x, y, z in face] for face in box()]
    for kind, knots in ((("chain", [("turn", 1, 0, 0)]), [(0,), (1,)]), (("sweep", (1e300, 0, 1e-300)), [START, START]),
                        (("sweep", (0, 0, 0)), [START, (0, 0, 1e-300, 1e300, 1e-300, 0, 0)])):
        text = certify(box(), far, knots, kind=kind, steps=PLANES)
        assert check(box(), far, text)[0] == 0


def test_many_corners(check):
    """Eight corners of a box may do for many, but what they miss is not refused."""
    stairs = [face for i in range(3) for face in box((-i, i, 0), (1 - i, i + 1, 1))]
    for ends, normal, status in (((0, 0.875), "-1 -1 0", 0), ((0, 1), "-1 -1 0", 1), ((-1, -0.25), "-1 0 0", 0),
                                 ((-1, -0.25), "-1 -1 0", 0), ((0, 0.875), "-2 -1 0", 0), ((0, 0.875), "-1 -9 0", 1)):
        text = certify(stairs, box((2, 2, 0), (3, 3, 1)), [ends[:1], ends[1:]], kind=("chain", [("slide", 1, 1, 0)]),
                       steps=[["P " + normal]])
        assert check(stairs, box((2, 2, 0), (3, 3, 1)), text)[0] == status
