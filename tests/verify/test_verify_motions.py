"""Sweeps, poses of two bodies, and chains: what tools/verify.py verifies and refuses; its formulas against others."""
import io
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
    text = f"motion chain 1 {len(links)}\n" + "".join(f"link {word} {hexes(row)}\n" for word, *row in links)
    chain = verify.Chain(verify.Reader(io.BytesIO((text + "".join(f"knot {hexes(x)}\n" for x in knots)).encode())))
    bodies = [type("Body", (), {"corners": [tuple(int(x * unit) for x in p) for p in corners]})() for _ in range(2)]
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
