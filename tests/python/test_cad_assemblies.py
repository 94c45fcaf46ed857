"""Assemblies with closed formulas: what is found is right to the error that it states. OCCT's distances at samples refute nothing."""

import functools
import json
import os
import time

import numpy as np
import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_cases as cases  # noqa: E402
import cad_shapes as cs  # noqa: E402

LONG = bool(os.environ.get("CHASLES_LONG"))


def poses_at(assembly, name, value):
    """Poses of all parts with one joint at a value."""
    robot = assembly.robot()
    row = assembly.rest
    row[robot.variables.index(name)] = value
    return assembly.poses(robot, row)


def least_by_occt(assembly, pairs, poses):
    shapes = {name: cs.placed(assembly.parts[name].shape, poses[name]) for name in assembly.parts}
    return min(cs.distance(shapes[a], shapes[b]) for a, b in pairs)


@functools.cache
def checked(name):
    assembly, true = cases.STOPS[name]()
    return assembly, true, chasles.cad.check(assembly)


@pytest.mark.parametrize("name", cases.STOPS)
def test_joints_stop_where_the_formula_says(name):
    assembly, true, report = checked(name)
    found = report.joints[0]
    assert not report.touching and len(report.joints) == 1 and report.verdict == found.verdict == "contact" and report.is_proven
    for side, (stop, value, end) in enumerate(zip(found.stops, true, (found.lower, found.upper))):
        if value is None:
            assert stop is None and found.clear[side] == end
            continue
        ends = sorted([stop.clear_until, stop.touches_by])
        assert ends[0] - 1e-9 <= value <= ends[1] + 1e-9, (ends, value)
        assert ends[1] - ends[0] <= 0.03 * (1 + abs(value)), ends
        away = 1e-6 * (1 if side else -1)
        poses = poses_at(assembly, found.name, stop.touches_by + away)
        assert least_by_occt(assembly, [stop.pair], poses) <= 1e-6


@pytest.mark.parametrize("name", cases.STOPS)
def test_nothing_is_clear_that_occt_finds_in_contact(name):
    assembly, _, report = checked(name)
    found = report.joints[0]
    pairs = assembly.robot().tested_pairs()
    samples = np.linspace(*found.clear, 150 if LONG else 8)[1:-1]
    least = [least_by_occt(assembly, pairs, poses_at(assembly, found.name, value)) for value in samples]
    assert min(least) > 0


@pytest.mark.parametrize("name", cases.CLEARANCES)
def test_the_least_clearance_is_that_of_the_formula(name):
    make, true = cases.CLEARANCES[name]
    assembly, _ = make()
    report = chasles.cad.check(assembly, pairs=False, least_seconds=10 if LONG else 1)
    assert report.verdict == "clear" and report.is_proven and report.exit_status == 0
    bounds = sum(part.bound for part in assembly.parts.values())
    for joint in report.joints:
        assert joint.least.lower <= true <= joint.least.upper <= true + 4 * bounds
        assert name != "rotor" or not LONG or joint.least.lower >= 0.4 * true  # where all facets are as near, time may end first
        samples = np.linspace(joint.lower, joint.upper, 60 if LONG else 3)
        least = [least_by_occt(assembly, [joint.least.pair], poses_at(assembly, joint.name, value)) for value in samples]
        assert min(least) >= joint.least.lower


def test_the_share_of_two_joints():
    assembly, _ = cases.discs()
    report = chasles.cad.check(assembly, tolerance=0.003)
    found, true = report.pairs[0], np.pi / 25
    assert found.contact_share <= true + 1e-3 and found.clear_share <= 1 - true and found.open_share <= 0.003
    assert found.contact_share >= true - 0.004 and found.verdict == report.verdict == "contact"
    a, b = found.witness["a"], found.witness["b"]
    assert a * a + b * b <= 4.02 and found.pair == ("a", "b")
    assert [joint.verdict for joint in report.joints] == ["clear", "clear"]


def test_a_geneva_drive_keeps_its_play():
    """A pin of 2 mm in a slot of 4.4 mm: 0.2 mm at each side, while the wheel follows the crank through a quarter turn."""
    crank, middle = 20.0, 20.0 * np.sqrt(2)
    slot = cs.box(30, 4.4, 5, (-30, -2.2, 0))
    wheel = cs.moved(cs.cut(cs.cylinder(18, 5), cs.moved(slot, (-3, 0, 0))), (middle, 0, 0))
    made = cs.assembly(driver=cs.cylinder(2, 5, (crank, 0, 0)), wheel=wheel, deflection=0.01)
    made.add_joint("driver", "revolute", "world", "driver", lower=-1, upper=1)
    made.add_joint("wheel", "revolute", "world", "wheel", point=(middle, 0, 0), lower=-1, upper=1)
    robot = made.robot()
    angles = np.linspace(-0.7, 0.7, 401)
    path = np.column_stack([angles, -np.arctan2(np.sin(angles), np.sqrt(2) - np.cos(angles))])
    near = chasles.RobotChecker(robot).least_distance_on_path(
        chasles.JointPath.natural_spline(robot, angles, path), tolerance=0.02
    )
    bounds = 2 * sum(part.bound for part in made.parts.values()) + 1e-3
    assert 0.2 - bounds <= near.distance <= near.distance_upper <= 0.2 + bounds


def test_intended_contacts_and_overlaps():
    assembly, _ = cases.pin_in_clevis(5.0)
    touching = chasles.cad.check(assembly, least_seconds=0)
    assert (
        touching.verdict == "contact" and [t.pair for t in touching.touching] == [("clevis", "pin")] and touching.exit_status == 1
    )
    for options in (dict(intended=[("pin", "cle*")]), dict(ignore_touching=True), dict(allowed_overlap=0.02)):
        report = chasles.cad.check(assembly, least_seconds=0, **options)
        assert report.verdict == "clear" and report.joints[0].verdict == "clear", options
    pressed, _ = cases.pin_in_clevis(5.02)
    assert chasles.cad.check(pressed, least_seconds=0).touching[0].is_proven
    assert chasles.cad.check(pressed, least_seconds=0, allowed_overlap=0.005).verdict == "contact"
    assert chasles.cad.check(pressed, least_seconds=0, allowed_overlap=0.05).verdict == "clear"


def test_a_rotor_is_proven_at_once():
    assembly, _ = cases.rotor()
    seconds = []
    for _ in range(3):
        began = time.perf_counter()
        assert chasles.cad.check(assembly, least_seconds=0).verdict == "clear"
        seconds.append(time.perf_counter() - began)
    assert min(seconds) < 1.0, seconds  # docs/cad.md has the figure; this is for a machine with other work


def test_the_report_is_json_and_a_page(tmp_path):
    assembly, _ = cases.slot()
    report = chasles.cad.check(assembly)
    read = json.loads(report.to_json())
    assert (
        read["verdict"] == "contact"
        and read["about"] == "the true parts"
        and read["joints"][0]["stops"][0]["pair"] == ["plate", "pin"]
    )
    assert "stopped by plate | pin" in str(report)
    page = report.view(tmp_path / "page.html")
    assert "plate" in page.read_text("utf-8")


def test_time_ends_the_search():
    assembly, _ = cases.discs()
    report = chasles.cad.check(assembly, seconds=1e-6)
    assert report.verdict == "unknown" and report.exit_status == 3


def test_what_is_refused():
    assembly, _ = cases.slider()
    for joint in (
        dict(name="rail", type="prismatic", parent="world", child="left"),
        dict(name="x", type="screw", parent="world", child="left"),
        dict(name="x", type="revolute", parent="lever", child="left"),
        dict(name="x", type="revolute", parent="world", child="block"),
        dict(name="x", type="revolute", parent="world", child="left", axis=(0, 0, 0)),
        dict(name="x", type="revolute", parent="world", child="left", lower=1, upper=0),
        dict(name="x", type="revolute", parent="world", child="left", lower=1, upper=2),
    ):
        with pytest.raises(chasles.InvalidInput, match="joint"):
            assembly.add_joint(**joint)
    with pytest.raises(chasles.InvalidInput, match="no part"):
        chasles.cad.check(assembly, intended=[("lever", "block")])
    with pytest.raises(chasles.InvalidInput, match="allowed_overlap"):
        chasles.cad.check(assembly, allowed_overlap=-1)
    with pytest.raises(TypeError, match="STEP"):
        chasles.cad.load(3)
    with pytest.raises(chasles.InvalidInput, match="no file"):
        chasles.cad.load("missing.step")
    assembly.joints[0].child = "lever"
    with pytest.raises(chasles.InvalidInput, match="carries none"):
        assembly.robot()
    assembly.joints[0].child, assembly.joints[0].upper = "block", 2000
    with pytest.raises(chasles.InvalidInput, match="narrower"):
        chasles.cad.check(assembly)
