"""Least distances, names, budgets and what is complete, of `chasles.cad.check`."""

import itertools
import json
import time

import numpy as np
import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_cases as cases  # noqa: E402
import cad_shapes as cs  # noqa: E402

OVERLAPS = (0.0, 0.02, 0.5, 2.0)


@pytest.mark.parametrize("allowed", OVERLAPS)
@pytest.mark.parametrize("gap", (10.0, 0.25, 0.0))
def test_an_allowed_overlap_changes_no_distance(gap, allowed):
    """Two boxes with a gap, also while one of them moves; where they touch, they are 0 apart."""
    made = cs.assembly(a=cs.box(10, 10, 10), b=cs.box(10, 10, 10, (10 + gap, 0, 0)))
    made.add_joint("y", "prismatic", "world", "b", axis=(1, 0, 0), lower=-0.6 * gap, upper=3)
    report = chasles.cad.check(made, allowed_overlap=allowed, least_seconds=0.5)
    if gap == 0 and allowed == 0:
        assert report.verdict == "contact" and report.least is None
        return
    assert report.verdict == "clear"
    assert 0.99 * gap <= report.least.lower <= gap <= report.least.upper <= gap + 1e-9
    least, true = report.joints[0].least, 0.4 * gap
    assert 0.98 * true <= least.lower <= true <= least.upper <= true + 1e-9
    assert 10 - 1e-9 <= report.least.point[0] <= 10 + gap + 1e-9  # the place is one of the true parts


@pytest.mark.parametrize("allowed", OVERLAPS)
def test_occt_refutes_no_distance_with_an_allowed_overlap(allowed):
    """Sharp corners move inwards by far more than faces."""
    random = np.random.default_rng(11)
    for _ in range(6):
        places = random.uniform(-7, 7, (3, 3))
        made = cs.assembly(
            0.005,
            box=cs.moved(cs.box(6, 5, 4), places[0], (1, 2, 3), 40),
            cone=cs.moved(cs.cone(4, 0, 12), places[1], random.normal(size=3), 200),
            rod=cs.moved(cs.cylinder(2.5, 9), places[2], random.normal(size=3), 100),
        )
        report = chasles.cad.check(made, allowed_overlap=allowed)
        touching = {frozenset(touch.pair) for touch in report.touching}
        apart = [pair for pair in itertools.combinations(made.parts, 2) if frozenset(pair) not in touching]
        if not apart:
            continue
        true = min(cs.distance(made.parts[a].shape, made.parts[b].shape) for a, b in apart)
        assert report.least.lower - 1e-9 <= true <= report.least.upper + 1e-9, (allowed, true, report)
        assert report.least.upper - true <= 4 * sum(part.bound for part in made.parts.values()) + 0.01 * true + 1e-9


@pytest.mark.parametrize("allowed", OVERLAPS[:3])
def test_the_clearance_of_a_pin_stays_with_an_allowed_overlap(allowed):
    assembly, _ = cases.pin_in_clevis()
    report = chasles.cad.check(assembly, allowed_overlap=allowed, least_seconds=0.5)
    assert report.least.lower <= 0.1 <= report.least.upper and report.joints[0].least.lower <= 0.1 <= report.joints[0].least.upper


NAMES = {"plate": 0, "bolt1": 1, "bolt[1]": 2, "a\nb": 3, "x.y": 4}


@pytest.mark.parametrize(
    "pattern, names",
    [
        ("bolt[1]", {"bolt[1]"}),
        ("bolt?", {"bolt1"}),
        ("bolt*", {"bolt1", "bolt[1]"}),
        ("x?y", {"x.y"}),
        ("a*b", {"a\nb"}),
        ("*", set(NAMES)),
        ("xzy", None),
        ("bolt[!1]", None),
    ],
)
def test_only_stars_and_question_marks_are_wildcards(pattern, names):
    made = cs.assembly(base=cs.box(1, 1, 1, (-9, 0, 0)), **{name: cs.box(1, 1, 1, (3 * at, 0, 0)) for name, at in NAMES.items()})
    if names is None:
        with pytest.raises(chasles.InvalidInput, match="is no part; the parts are base, plate"):
            chasles.cad.check(made, intended=[("base", pattern)])
        return
    found = chasles.cad.check(made, intended=[("base", pattern)]).intended
    assert {name for pair in found for name in pair} - {"base"} == names


def chain(count):
    """Plates above each other, each with a joint to the one below."""
    made = cs.assembly(
        **{f"p{i}": cs.cut(cs.box(20, 4, 2, (-10, -2, 3 * i)), cs.cylinder(1, 9, (0, 0, 3 * i - 1))) for i in range(count)}
    )
    for i in range(count):
        above = f"p{i - 1}" if i else "world"
        made.add_joint(f"j{i}", "revolute", above, f"p{i}", point=(8 * (-1) ** i, 0, 3 * i), lower=-3, upper=3)
    return made


@pytest.mark.parametrize("seconds", (1e-6, 0.1, 1.0))
def test_the_time_is_kept_and_what_is_open_is_said(seconds):
    made, took = chain(14), []
    for _ in range(3):
        began = time.monotonic()
        report = chasles.cad.check(made, seconds=seconds)
        took.append(time.monotonic() - began)
    assert min(took) <= 1.1 * seconds + 0.5, took
    read = json.loads(report.to_json())
    assert (report.verdict, report.exit_status, read["is_complete"]) == ("unknown", 3, False)
    if seconds < 0.01:
        return
    assert len(report.joints) == 14 and len(report.pairs) == 91
    last = report.pairs[-1]
    assert last.verdict == "unknown" and (last.clear_share, last.contact_share, last.open_share) == (0, 0, 1)
    assert all(joint.clear[0] <= joint.value <= joint.clear[1] for joint in report.joints)


def test_an_answer_is_complete_if_time_sufficed():
    made, _ = cases.discs()
    whole = chasles.cad.check(made, tolerance=0.05, least_seconds=0)
    assert whole.is_complete and whole.verdict == "contact"
    cut = chasles.cad.check(made, tolerance=1e-5, least_seconds=0, seconds=1.5)
    assert cut.verdict == "contact" and cut.pairs[0].open_share > 1e-5 and not cut.is_complete


@pytest.mark.parametrize(
    "name, value, range_",
    [
        ("allowed_overlap", -1, "at least 0 and finite"),
        ("allowed_overlap", np.inf, "at least 0 and finite"),
        ("tolerance", 3, r"in \(0, 1\]"),
        ("seconds", 0, "above 0"),
        ("least_seconds", np.nan, "at least 0"),
    ],
)
def test_numbers_out_of_range_are_named(name, value, range_):
    made = cs.assembly(a=cs.box(1, 1, 1))
    with pytest.raises(chasles.InvalidInput, match=f"^{name}: must be {range_}, not {value}$"):
        chasles.cad.check(made, **{name: value})
