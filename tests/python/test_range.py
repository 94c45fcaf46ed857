"""Ranges of robots: proven boxes hold for samples, and answers have the form that is documented."""

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, pose

import chasles

RANDOM = np.random.default_rng(40)


@pytest.fixture
def arm(tmp_path):
    link = '<link name="{0}"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>'
    joint = (
        '<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/><origin xyz="{3} 0 0"/><axis xyz="0 0 1"/>'
        '<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>'
    )
    (tmp_path / "arm.urdf").write_text(
        '<robot name="arm"><link name="base"/>' + link.format("upper") + link.format("lower")
        + joint.format("shoulder", "base", "upper", 0) + joint.format("elbow", "upper", "lower", 1) + "</robot>"
    )  # fmt: skip
    return chasles.Robot.load(tmp_path / "arm.urdf")


@pytest.fixture
def scene():
    world = chasles.Scene()
    world.add("cube", chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES), pose=pose(1, 0.5, -0.5))
    return world


def samples(boxes, count):
    chosen = boxes[RANDOM.integers(len(boxes), size=count)]
    return RANDOM.uniform(chosen[:, 0], chosen[:, 1])


def test_samples_refute_no_box(arm, scene):
    found = arm.range(*arm.box_of_joints(["shoulder", "elbow"]), scene)
    assert found.verdict == "contact" and found.open_share <= 0.01
    assert found.joints == ["shoulder", "elbow"]
    assert found.clear_share + found.contact_share + found.open_share == pytest.approx(1, abs=1e-12)
    checker = chasles.RobotChecker(arm, scene)
    assert all(checker.is_clear(q) for q in samples(found.boxes, 500))
    assert not any(checker.is_clear(q) for q in samples(found.contact_boxes, 500))
    assert checker.pairs_in_contact(found.witness) != [] and found.pair == ("lower", "cube")
    volumes = np.prod(found.boxes[:, 1] - found.boxes[:, 0], axis=1)
    assert np.all(np.diff(volumes) <= 1e-12) and volumes.sum() / 36 == pytest.approx(found.clear_share)
    assert "contact; " in repr(found) and found.untested.tested > 0


def test_a_clear_box_is_around_its_configuration(arm, scene):
    box = arm.box_of_joints(["shoulder", "elbow"])
    found = arm.clear_box(*box, scene, around=[-1, 0.1])
    assert found.verdict == "clear" and found.is_maximal and 0.1 < found.share < 1
    assert np.all(found.lower <= [-1, 0.1]) and np.all(found.upper >= [-1, 0.1])
    checker = chasles.RobotChecker(arm, scene)
    assert all(checker.is_clear(q) for q in RANDOM.uniform(found.lower, found.upper, size=(300, 2)))
    in_contact = arm.range(*box, scene).witness
    assert arm.clear_box(*box, scene, around=in_contact).verdict == "contact"
    assert arm.clear_box(*box).share == 1, "around the middle, with the robot alone"


def test_an_allowed_overlap_is_a_radius_below_zero(arm):
    """A pin that fills its hole: what overlaps by less than both radii is no contact."""
    box = arm.box_of_joints(["elbow"], [0, 0])
    floor = chasles.Scene()
    floor.add("floor", chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES), pose=pose(1, -0.5, -1.0499))
    assert arm.range(*box, floor).verdict == "contact"
    floor = chasles.Scene()
    floor.add("floor", chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=-0.001), pose=pose(1, -0.5, -1.0499))
    assert arm.range(*box, floor).verdict == "clear"
    arm.ignore_in_scene("lower", "floor")
    arm.ignore_in_scene("upper", "floor")
    assert arm.range(*box, floor).verdict == "clear"


def test_other_variables_stand_still(arm, scene):
    lower, upper = arm.box_of_joints(["elbow"], [1.2, 0])
    assert lower.tolist() == [1.2, -3] and upper.tolist() == [1.2, 3]
    found = arm.range(lower, upper, scene)
    assert found.boxes.shape[1:] == (2, 1) and found.joints == ["elbow"]


def test_a_limit_leaves_the_rest_open(arm, scene):
    box = arm.box_of_joints(["shoulder", "elbow"])
    found = arm.range(*box, scene, tolerance=0, seconds=0.2)
    assert found.open_share > 0 and found.clear_share > 0
    few = arm.range(*box, scene, most_cells=3)
    assert few.cells == 3
    with chasles.Limit(0.1):
        assert arm.range(*box, scene, tolerance=0).open_share > 0


def test_threads_change_nothing(arm, scene):
    box = arm.box_of_joints(["shoulder", "elbow"])
    one, two = (arm.range(*box, scene, threads=threads, tolerance=0.03) for threads in (1, 2))
    assert np.array_equal(one.boxes, two.boxes) and np.array_equal(one.witness, two.witness)


def test_what_is_no_box_is_refused(arm, scene):
    with pytest.raises(chasles.InvalidInput, match="^range: elbow: its lower end is above its upper end$"):
        arm.range([0, 1], [1, 0])
    with pytest.raises(chasles.InvalidInput, match="^range: box: no variable"):
        arm.range([0, 1], [0, 1])
    with pytest.raises(chasles.InvalidInput, match="there is no such variable"):
        arm.box_of_joints(["wrist"])
    base = chasles.Robot(
        links=[{"name": "ground"}, {"name": "base"}],
        joints=[{"name": "floor", "type": "planar", "parent": "ground", "child": "base"}],
    )
    with pytest.raises(
        chasles.InvalidInput,
        match="^range: floor/x: has no limits; give the ends of its range: leave it out here, and set them in the arrays "
        "lower and upper that come back$",
    ):
        base.box_of_joints(["floor/x"])
    with pytest.raises(chasles.InvalidInput, match="^range: around: shoulder is 2, outside of the box, from 0 to 1$"):
        arm.clear_box([0, 0], [1, 1], around=[2, 0])
    moving = chasles.Scene()
    moving.add("cart", chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES), pose=pose(3, 0, 0), goal=pose(4, 0, 0))
    with pytest.raises(chasles.InvalidInput, match="^range: cart: moves"):
        arm.range([0, 0], [1, 1], moving)


def test_a_plot_shows_the_boxes(arm, scene):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    box = arm.box_of_joints(["shoulder", "elbow"])
    found = arm.range(*box, scene, tolerance=0.05)
    axes = found.plot(clear_box=arm.clear_box(*box, scene, around=[-1, 0.1]))
    assert axes.get_xlabel() == "shoulder" and len(axes.collections) == 3
    assert axes.get_xlim() == (-3, 3)
    with pytest.raises(chasles.InvalidInput, match="two joints"):
        arm.range(*arm.box_of_joints(["elbow"]), scene).plot()
