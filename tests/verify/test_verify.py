"""What tools/verify.py verifies, and what it refuses with a reason."""
import math
from fractions import Fraction as Q

import pytest

from certificates import *  # noqa: F403
from certificates import add, check, cross, dot, times, verify  # noqa: F401


@pytest.mark.parametrize("name", CASES)
def test_true(check, name):
    moving, fixed, text = case(name)
    status, answer = check(moving, fixed, text)
    assert status == 0, answer
    verdict = CASES[name][3] if len(CASES[name]) > 3 else "clear"
    lines = answer.splitlines()
    assert lines[0] == "verified"
    assert lines[1].startswith("verdict: " + (verdict if isinstance(verdict, str) else "contact in piece"))
    names = ["verdict", "margin", "radii", "motion", "first pose", "last pose", "solid", "pieces", "steps"]
    assert [line.split(":")[0] for line in lines[1:]] == names
    assert lines[-1] == f"steps: {sum(line.split()[0] in ('T', 'A', 'B', 'P') for line in text.splitlines())}"


def test_what_is_printed(check):
    status, answer = check(*case("meets its reach"))
    assert answer == ("verified\nverdict: contact in piece 0, not up to tau 0.24999999999999997, but up to tau 0.25\n"
                      "margin: 0.125\nradii: 0.25 0.125\nmotion: screw\nfirst pose: 0.0 0.0 0.0 1.0 0.0 0.0 0.0\n"
                      "last pose: 2.0 0.0 0.0 1.0 0.0 0.0 0.0\nsolid: none\npieces: 1\nsteps: 1")


# --- what is false or malformed is refused, with the reason ----------------------------------------------------------

def swap(old, new, count=1):
    def change(text):
        assert old in text, text
        return text.replace(old, new, count)
    return change


def drop(start):
    return lambda text: "".join(line for line in text.splitlines(True) if not line.startswith(start))


def after(start, extra):
    return lambda text: "".join(row + (extra + "\n" if row.startswith(start) else "") for row in text.splitlines(True))


def line(start, new):
    def change(text):
        assert any(row.startswith(start) for row in text.splitlines())
        return "".join(new + "\n" if row.startswith(start) else row for row in text.splitlines(True))
    return change


NEAR = "near 0x1p-1 1 0 1 2 1 0 0 0 0 1 2 18 0 18"
FALSE = [
    # the head
    ("both solid", swap("chasles", "Chasles"), "line 1: 'chasles certificate 1'"),
    ("both solid", swap("certificate 1", "certificate 2"), "certificate 1"),
    ("both solid", swap("certificate 1", "certificate 1 1"), "line 1"),
    ("both solid", lambda t: "", "line 0: 'chasles certificate 1' and 0 words are expected, not the end"),
    ("both solid", lambda t: t.replace(digest(box())[:9], digest(box())[:8] + "x"), "line 2: the mesh file has"),
    ("both solid", lambda t: t.replace(digest(box()), digest(box()).upper()), "line 2: the mesh file"),
    ("both solid", swap(" 6\n", " 7\n"), "line 2: the mesh file"),
    ("both solid", lambda t: t.replace("moving " + digest(box()), "moving " + digest(WALL)), "line 2: the mesh file"),
    ("both solid", drop("fixed"), "line 3: 'fixed'"),
    ("both solid", swap("solid both", "solid all"), "unknown word 'all'"),
    ("both solid", swap("solid both", "solid"), "'solid' and 1 words"),
    ("both solid", swap("solid both", "solid both both"), "'solid' and 1 words"),
    ("both solid", swap("solid both", "solid none"), "is no solid"),
    ("both solid", swap("radius 0x0.0p+0", "radius -0x1p-3"), "below 0"),
    ("both solid", swap("radius 0x0.0p+0", "radius nan"), "'nan' is not a hexadecimal number"),
    ("both solid", swap("radius 0x0.0p+0", "radius 0.125"), "'0.125' is not a hexadecimal number"),
    ("both solid", swap("radius 0x0.0p+0", "radius inf"), "'inf' is not"),
    ("both solid", swap("radius 0x0.0p+0", "radius 0x1p+1024"), "not a finite double"),
    ("both solid", swap("radius 0x0.0p+0", "radius 0x1.00000000000001p-3"), "not a finite double"),
    ("both solid", swap("radius 0x0.0p+0", "radius 0x1p-1075"), "not a finite double"),
    ("both solid", swap("radius 0x0.0p+0", "radius"), "'radius' and 2 words"),
    ("both solid", swap("margin 0x0.0p+0", "margin -0x1p-1074"), "below 0"),
    ("both solid", drop("margin"), "'margin' and 1 words are expected"),
    ("both solid", swap("motion screw", "motion linear"), "'motion screw'"),
    ("both solid", swap("screw 1", "screw 0"), "'0' is not an integer that fits"),
    ("both solid", swap("screw 1", "screw 2"), "'pose' and 7 words are expected, not verdict"),
    ("both solid", swap("screw 1", "screw " + 999 * "9"), "'pose' and 7 words"),
    ("both solid", swap("screw 1", "screw -1"), "not an integer"),
    ("three pieces", swap("screw 3", "screw 2"), "'verdict' and"),
    ("both solid", line("pose 0x1.0", "pose 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0 0x0p+0"), "half a turn"),
    ("both solid", line("pose 0x1.0", "pose 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0 -0x0p+0"), "quaternion is 0"),
    ("both solid", line("pose 0x1.0", "pose 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0 0x0p+0"), "'pose' and 7 words"),
    ("both solid", line("verdict", "verdict"), "'verdict' and 1 words"),
    ("both solid", line("verdict", "verdict free"), "unknown verdict"),
    ("both solid", line("verdict", "verdict clear 0"), "unknown verdict"),
    ("both solid", line("verdict", "verdict contact 0 0x1p+0"), "unknown verdict"),
    ("both solid", after("solid", "colour red"), "'radius' and 2 words are expected, not colour"),
    # the order
    ("both solid", line("order moving", "order moving 0 1 2 3 4 4"), "no permutation"),
    ("both solid", line("order moving", "order moving 0 1 2 3 4 6"), "no permutation"),
    ("both solid", line("order moving", "order moving 0 1 2 3 4 -5"), "no permutation"),
    ("both solid", line("order moving", "order moving 0 1 2 3 4"), "6 words are expected"),
    ("both solid", line("order moving", "order moving 0 1 2 3 4 5 0"), "6 words are expected"),
    ("both solid", line("order moving", "order moving 0 1 2 3 4 0x5"), "'0x5' is not an integer"),
    ("both solid", drop("order fixed"), "'order fixed'"),
    ("a ring around a pin", line("order moving", "order moving 0 6 1 7 2 8 3 9 4 10 5 11"), "does not separate"),
    # outside
    ("both solid", drop("outside moving"), "no 'outside moving' for the part of face 0"),
    ("both solid", drop("outside fixed"), "no 'outside fixed' for the part of face 0"),
    ("two parts", swap("outside moving 7", "outside moving 1"), "no 'outside moving' for the part of face 6"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 0 0 0 0"), "direction is 0"),
    ("both solid", swap(OUT_MOVING, "outside moving 6 0 -7 1 2"), "'6' is not an integer that fits"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 4 -7 1 2"), "'4' is not an integer that fits"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 0 -7 1"), "'outside' and 6 words"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 0 -7 1 0.5"), "'0.5' is not an integer"),
    ("both solid", swap(OUT_MOVING, "outside cube 0 0 -7 1 2"), "'cube' is neither"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 0 1 0 0"), "edge"),
    ("both solid", swap(OUT_MOVING, "outside moving 0 0 2 3 3"), "edge"),
    ("translation past", after("order fixed", OUT_MOVING), "the fixed body is no solid"),
    ("in a surface", lambda t: after("order fixed", OUT_MOVING)(t.replace("solid none", "solid fixed")), "is inside"),
    ("in a surface", swap("solid none", "solid fixed"), "no 'outside moving'"),
    # the proof
    ("both solid", line("P", "?"), "step 1: the certificate is incomplete"),
    ("both solid", line("P", "Q"), "step 1: 'Q' is not possible here"),
    ("both solid", line("P", "P 0 0 0"), "the normal is 0"),
    ("both solid", line("P", "P -1 0"), "the file ends too early"),
    ("both solid", line("P", "P -1 0 0 0"), "words after the end of the proof"),
    ("both solid", line("P", "P -1 0 0.0"), "not an integer"),
    ("both solid", line("P", "P -1 0 +0"), "not an integer"),
    ("both solid", line("P", "P 1 0 0"), "step 1: the plane does not separate"),
    ("both solid", line("P", "P -1 0 " + 5000 * "1"), "not an integer"),
    ("both solid", drop("P"), "the file ends too early"),
    ("both solid", after("P", "P -1 0 0"), "nothing more is expected"),
    ("both solid", after("P", "witness " + NEAR), "nothing more is expected"),
    ("both solid", line("proof 0", "proof 1"), "'proof 0'"),
    ("both solid", line("proof 0", "proof 0 T"), "'proof 0' and 0 words"),
    ("both solid", after("P", "proof 1\nP -1 0 0"), "nothing more is expected"),
    ("both solid", line("P", "A A A A P -1 0 0"), "step 3: 'A' is not possible here"),
    ("both solid", line("P", "B B B B P -1 0 0"), "step 3: 'B' is not possible here"),
    ("both solid", line("P", 5001 * "T "), "step 4001: 'T' is not possible here"),
    ("three pieces", drop("proof 2"), "'proof"),
    ("three pieces", lambda t: t[:t.index("proof 2")], "'proof 2' and 0 words are expected, not the end"),
    ("margin and radii", swap("radius 0x1.0000000000000p-2", "radius 0x1.8000000000000p-2"), "does not separate"),
    ("margin and radii", swap("margin 0x1.0000000000000p-2", "margin 0x1.8000000000000p-2"), "does not separate"),
    # the poses and the contact
    ("both solid", swap("pose 0x1.0000000000000p-1", "pose 0x1.0000000000000p+0"), "does not separate"),
    ("meets a wall", lambda t: drop("witness")(line("verdict", "verdict clear")(t)), "does not separate"),
    ("meets a wall", swap(f"contact 0 {BELOW_HALF.hex()}", "contact 0 0x1p-1"), "does not separate"),
    ("meets a wall", swap("contact 0", "contact 1"), "'1' is not an integer that fits"),
    ("meets a wall", line("verdict", "verdict contact 0 0x1p-1 0x1p-2"), "LOWER <= UPPER"),
    ("meets a wall", line("verdict", "verdict contact 0 -0x1p-1 0x1p-1"), "LOWER <= UPPER"),
    ("meets a wall", line("verdict", "verdict contact 0 0x0p+0 0x1.8p+0"), "LOWER <= UPPER"),
    ("meets a wall", line("verdict", f"verdict contact 0 0x0p+0 {BELOW_HALF.hex()}"), "TAU of the witness"),
    ("in the second piece", swap("contact 1", "contact 0"), "a witness that fits"),
    ("in the second piece", lambda t: t.replace("proof 0\nP -1 0 0\n", ""), "'proof 0'"),
    ("a tip meets a roof", swap("pose 0x0.0p+0 0x0.0p+0", "pose 0x0.0p+0 0x1.0000000000000p-50"), "does not separate"),
    # the witness
    ("meets a wall", drop("witness"), "a witness that fits is expected"),
    ("meets a wall", after("witness", "witness " + NEAR), "nothing more"),
    ("meets a wall", swap(NEAR, NEAR + " 0"), "15 words are expected"),
    ("meets a wall", swap(NEAR, "inside moving 0 0 1 2 3"), "a witness that fits is expected"),
    ("meets a wall", swap("near 0x1p-1", f"near {BELOW_HALF.hex()}"), "too far apart"),
    ("meets a wall", swap("near 0x1p-1", "near 0x1.8p-1"), "TAU of the witness"),
    ("meets a wall", swap("near 0x1p-1", "near 0.5"), "'0.5' is not a hexadecimal"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "1 0 1 3 1 0 0 0"), "0, k, k + 1"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "1 1 2 3 1 0 0 0"), "0, k, k + 1"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "1 0 3 4 1 0 0 0"), "'4' is not an integer that fits"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "6 0 1 2 1 0 0 0"), "'6' is not an integer that fits"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "1 0 1 2 0 0 0 0"), "all weights are 0"),
    ("meets a wall", swap("1 0 1 2 1 0 0 0", "1 0 1 2 2 -1 0 0"), "'-1' is not an integer that fits"),
    ("meets a wall", swap("18 0 18", "19 0 18"), "too far apart"),
    ("meets its reach", swap("18 0 18", "19 0 18"), "too far apart"),
    ("meets it with an edge", swap("moving 2 0 0 1", "moving 0 0 0 1"), "does not cross the plane"),
    ("meets it with an edge", swap("moving 2 0 0 1", "moving 2 1 0 1"), "does not cross the plane"),    # in the plane
    ("meets it with an edge", swap("moving 2 0 0 1", "moving 2 0 1 1"), "does not cross the plane"),
    ("meets it with an edge", swap("moving 2 0 0 1", "moving 2 0 0 0"), "'0' is not an integer that fits"),
    ("meets it with an edge", swap("moving 2 0 0 1", "moving 2 0 0 3"), "'3' is not an integer that fits"),
    ("meets it with an edge", swap("moving 2 0 0 1", "fixed 2 0 0 1"), "does not cross the plane"),
    ("meets it with an edge", swap("cross 0x1p-1", f"cross {BELOW_HALF.hex()}"), "does not cross the plane"),
    ("near at the start", swap("near 0x0p+0", "near 0x1p-1"), "TAU of the witness"),
    ("near at the start", swap("radius 0x1.0000000000000p-1", f"radius {BELOW_HALF.hex()}"), "too far apart"),
    ("contact from the first moment", after("verdict", "order moving 0 1 2 3 4 5"), "a witness that fits"),
    ("contact from the first moment", swap("pose 0x1.0000000000000p+0", "pose 0x1.fffffffffffffp-1"), "does not cross"),
    ("inside at the start", swap("solid fixed", "solid none"), "is no solid"),
    ("inside at the start", swap("inside moving", "inside fixed"), "is no solid"),
    ("inside at the start", swap("pose 0x0.0p+0", "pose 0x1.4p+3"), "not inside"),
    ("inside at the start", swap("0 0 7 1 2", "0 0 1 1 1"), "edge"),
    ("fixed inside at the start", swap("inside fixed", "inside moving"), "not inside"),
    ("fixed inside at the start", swap("0 0 7 1 2", "0 0 1 1 1"), "edge"),     # a corner, seen from the turned body
    # the text
    ("both solid", lambda t: t.replace("solid", "s\xf6lid", 1), "not printable ASCII"),
    ("both solid", lambda t: t.replace("\nsolid", "\rsolid", 1), "not printable ASCII"),
    ("both solid", lambda t: t.replace("\nsolid", "\n\0solid", 1), "not printable ASCII"),
    ("both solid", lambda t: t.replace("solid both", "solid #both", 1), "'solid' and 1 words"),
]


@pytest.mark.parametrize("name, change, reason", FALSE, ids=[f"{i}-{row[2][:30]}" for i, row in enumerate(FALSE)])
def test_false(check, name, change, reason):
    moving, fixed, text = case(name)
    changed = change(text)
    assert changed != text
    status, answer = check(moving, fixed, changed)
    assert status == 1 and reason in answer and "\n" not in answer, answer
    assert "certificate, line " in answer


def test_leaves_and_cells(check):
    """A step left out, doubled, or another one in its place."""
    moving, fixed, text = case("orbit")
    head, steps = text[:text.index("proof 0\n") + 8], text[text.index("proof 0\n") + 8:].splitlines()
    assert {step[0] for step in steps} == {"T", "A", "B", "P"} and len(steps) > 5
    for i, step in list(enumerate(steps))[::9]:
        for new in ([], [step, step], ["?"], ["T"], [step[0].lower()]):
            if new != ["T"] or step[0] == "P":   # in the place of A or B it may do
                assert check(moving, fixed, head + "\n".join(steps[:i] + new + steps[i + 1:]))[0] == 1
        if step[0] == "P":
            x, y, z = map(int, step.split()[1:])
            assert check(moving, fixed, head + "\n".join(steps[:i] + [f"P {-x} {-y} {-z}"] + steps[i + 1:]))[0] == 1
    assert check(moving, fixed, head + " ".join(steps).replace(" ", " # a comment\r\n\n\t") + " ")[0] == 0


def test_bodies_exchanged(check):
    moving, fixed, text = case("both solid")
    status, answer = check(fixed, moving, text)
    assert status == 1 and "line 2: the mesh file has the hash" in answer


@pytest.mark.parametrize("toward, reason", [(9, "too far apart"), (0, "does not separate")])
def test_one_unit_in_the_last_place(check, toward, reason):
    """The wall is farther, and is not met at 1/2 any more; or nearer, and is met before LOWER."""
    moving, fixed, text = case("meets a wall")
    other = [[(math.nextafter(2.0, toward) if p[0] == 2 else p[0], *p[1:]) for p in face] for face in fixed]
    status, answer = check(moving, other, text.replace(digest(fixed), digest(other)))
    assert status == 1 and reason in answer


def test_equality_is_no_distance(check):
    """At a distance of just the reach the bodies touch."""
    reach = [START, START[:1] + (3,) + START[2:]]
    text = certify(box(), WALL, reach, margin=math.nextafter(1, 0))
    assert check(box(), WALL, text)[0] == 0
    text = text.replace(math.nextafter(1, 0).hex(), "0x1p+0")
    assert "does not separate" in check(box(), WALL, text)[1]
    near = [[(math.nextafter(2, 0), *p[1:]) if p == WALL[0][0] else p for p in face] for face in WALL]   # one vertex
    text = certify(box(), WALL, reach, margin=math.nextafter(1, 0)).replace(digest(WALL), digest(near))
    assert "does not separate" in check(box(), near, text)[1]


def test_rounded_root_whole_pieces_and_gap(check):
    order, other = "order moving 0 1 2 3 4 5\norder fixed 0 1 2 3 4 5\n", box((3, 3, 0), (4, 4, 1))
    for margin, status in ((1.5, 0), (2, 1), (3, 1)):   # the distance is 8^(1/2); the root of 2 counts as 2
        text = certify(box(), other, [START, START], "start", margin=margin).replace("verdict start", "verdict clear")
        assert check(box(), other, text + order + "proof 0\nP -1 -1 0\n")[0] == status
    text = certify(box(), WALL, [START, (1.5, 0, 0, 1, 0, 0, 0), (1, 0, 0, 1, 0, 0, 0)], "start")
    text = text.replace("verdict start", "verdict contact 1 0x1p-3 0x1p+0") + order + "proof 0\nP -1 0 0\n"
    assert "line 15, step 1: the plane does not" in check(box(), WALL, text)[1]   # they touch at the end of piece 0
    text = certify(box(), WALL, [START, START], "start", witness="near 0x0p+0 1 0 1 2 1 0 0 0 0 1 2 18 0 18")
    assert "too far apart" in check(box(), WALL, text)[1]
