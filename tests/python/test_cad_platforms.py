"""STEP files, build123d and CadQuery: names, colours, places, joints, their own kinematics and collision; and the command."""

import importlib.util
import itertools
import json
import os
import subprocess
import sys

import numpy as np
import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_shapes as cs  # noqa: E402
from chasles.cad_command import main  # noqa: E402
from chasles.cad_tree import matrix_of  # noqa: E402

LONG = bool(os.environ.get("CHASLES_LONG"))
needs_build123d = pytest.mark.skipif(importlib.util.find_spec("build123d") is None, reason="no build123d")
needs_cadquery = pytest.mark.skipif(importlib.util.find_spec("cadquery") is None, reason="no cadquery")


def write_step(path, shapes, external=None):
    """An assembly of (name, colour, shape, pose) by OCCT's writer; with `external`, each part in a file of a name that begins so."""
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopLoc import TopLoc_Location
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool, colours = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()), XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    root = tool.NewShape()
    TDataStd_Name.Set_s(root, TCollection_ExtendedString("gripper"))
    for name, colour, shape, pose in shapes:
        part = tool.AddShape(shape, False)
        TDataStd_Name.Set_s(part, TCollection_ExtendedString(name))
        colours.SetColor(
            part, Quantity_Color(*colour, Quantity_TypeOfColor.Quantity_TOC_RGB), XCAFDoc_ColorType.XCAFDoc_ColorSurf
        )
        instance = tool.AddComponent(root, part, TopLoc_Location(cs.trsf(pose)))
        TDataStd_Name.Set_s(instance, TCollection_ExtendedString(f"{name} here"))
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.SetColorMode(True)
    writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs, *([] if external is None else [external]))
    writer.Write(str(path))


@pytest.fixture(scope="module")
def step(tmp_path_factory):
    path = tmp_path_factory.mktemp("step") / "gripper.step"
    block, pin = cs.box(10, 20, 30), cs.cylinder(2, 40)
    poses = [cs.matrix((1, 2, 3), (1, 1, 0), 30), cs.matrix((60, 0, 0), (0, 1, 0), 90), cs.matrix((0, 50, 0))]
    shapes = [("block", (1, 0, 0), block, poses[0]), ("pin", (0, 0, 1), pin, poses[1]), ("pin", (0, 0, 1), pin, poses[2])]
    write_step(path, shapes)
    return path, poses


def test_step_keeps_names_colours_and_places(step):
    path, poses = step
    assembly = chasles.cad.load(path)
    assert assembly.name == "gripper" and list(assembly.parts) == ["block here", "pin here", "pin here_2"]
    for part, pose in zip(assembly.parts.values(), poses):
        assert np.abs(part.place - pose).max() < 1e-12
    assert [tuple(np.round(part.colour, 6)) for part in assembly.parts.values()] == [(1, 0, 0), (0, 0, 1), (0, 0, 1)]
    assert assembly.parts["block here"].bound == 0 and assembly.parts["pin here"].kinds == {"cylinder": 1, "plane": 2}


def test_step_of_several_solids_and_of_curves(tmp_path):
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    for shape in (cs.box(1, 1, 1), cs.box(1, 1, 1, (3, 0, 0))):
        builder.Add(whole, shape)
    wire = TopoDS_Compound()
    builder.MakeCompound(wire)
    builder.Add(wire, next(cs.explored(cs.box(1, 1, 1), cs.TopAbs_ShapeEnum.TopAbs_EDGE)))
    root = chasles.cad_tree.Node(
        "all", children=[chasles.cad_tree.Node("two", shape=whole), chasles.cad_tree.Node("wire", shape=wire)]
    )
    chasles.cad_tree.split(root.children[0])
    assembly = chasles.cad.Assembly(root)
    assert list(assembly.parts) == ["two/solid 1", "two/solid 2"] and "wire: has no faces" in assembly.warnings[0]
    report = chasles.cad.check(assembly)
    assert report.least.lower <= 2 <= report.least.upper and "left out" in str(report)


def test_the_command(step, tmp_path, capsys):
    path, _ = step
    assert main([str(path), "--out", str(tmp_path / "report.json"), "--page", str(tmp_path / "page.html")]) == 0
    assert (
        json.loads((tmp_path / "report.json").read_text())["verdict"] == "clear"
        and (tmp_path / "page.html").stat().st_size > 1000
    )
    assert "3 parts" in capsys.readouterr().out
    assert main([str(path), "--intended", "pin:nothing"]) == 2 and "no part" in capsys.readouterr().err
    assert main([str(path), "--page", str(path)]) == 2 and "is an input; write to another file" in capsys.readouterr().err
    assert main(["missing.step"]) == 2 and capsys.readouterr().err.startswith("chasles: missing.step: is no file")
    (tmp_path / "broken.step").write_text("ISO-10303-21; nothing")
    assert main([str(tmp_path / "broken.step")]) == 2


def test_the_command_runs_programs(step, tmp_path, capsys):
    script = tmp_path / "model.py"
    text = f"import chasles.cad\nassembly = chasles.cad.load({str(step[0])!r})\n"
    text += "assembly.add_joint('turn', 'revolute', 'world', 'pin here', point=(45, 0, 0), lower=-3, upper=3)\n"
    script.write_text(text)
    assert main([str(script), "--json"]) == 1
    read = json.loads(capsys.readouterr().out)
    assert read["verdict"] == "contact" and ["block here", "pin here"] in [
        stop and stop["pair"] for stop in read["joints"][0]["stops"]
    ]
    script.write_text("import cad_cases\nassembly = cad_cases.discs()[0]\n")
    assert main([str(script), "--seconds", "0.000001"]) == 3
    script.write_text("raise KeyboardInterrupt\n")
    assert main([str(script)]) == 130
    script.write_text("1 / 0\n")
    assert main([str(script)]) == 2 and "ZeroDivisionError" in capsys.readouterr().err
    script.write_text("x = 1\n")
    assert main([str(script)]) == 2 and "leaves 0 assemblies" in capsys.readouterr().err


def test_the_package_does_not_import_ocp():
    code = "import sys, chasles, chasles.cad_command; sys.exit('OCP' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def arm():
    """Parts of build123d with all kinds of joints, and what moves them."""
    from build123d import (
        Axis,
        BallJoint,
        Box,
        Color,
        Compound,
        Cylinder,
        CylindricalJoint,
        LinearJoint,
        Location,
        RevoluteJoint,
        RigidJoint,
        Sphere,
    )

    sizes = {
        "base": Box(60, 40, 5),
        "leaf": Box(40, 20, 4),
        "cart": Box(5, 5, 5),
        "knob": Sphere(3),
        "rod": Cylinder(2, 30),
        "cap": Box(3, 3, 3),
    }
    for name, part in sizes.items():
        part.label = name
    sizes["leaf"].color = Color("red")
    base, leaf, cart, knob, rod, cap = sizes.values()
    joints = {
        "hinge": RevoluteJoint("hinge", base, axis=Axis((30, 0, 2.5), (0, 1, 0.2)), angular_range=(0, 170)),
        "rail": LinearJoint("rail", leaf, axis=Axis((0, 3, 1.9), (1, 0.3, 0)), linear_range=(-10, 20)),
        "tube": CylindricalJoint(
            "tube", base, axis=Axis((-10, 0, 2.5), (0.3, 0, 1)), linear_range=(0, 50), angular_range=(0, 360)
        ),
        "socket": BallJoint("socket", base, joint_location=Location((0, 20, 3), (10, 20, 30))),
    }
    ends = {
        "hinge": RigidJoint("r", leaf, Location((-19.9, 0, -1.9))),
        "rail": RigidJoint("r", cart, Location((0, 0, -2.5))),
        "tube": RigidJoint("r", rod, Location((0, 0, -15))),
        "socket": RigidJoint("r", knob, Location((0, 0, -3), (0, 40, 0))),
    }
    RigidJoint("top", rod, Location((0, 0, 15))).connect_to(RigidJoint("r", cap))

    def move(hinge, rail, position, angle, x, y, z):
        joints["hinge"].connect_to(ends["hinge"], angle=hinge)
        joints["rail"].connect_to(ends["rail"], position=rail)
        joints["tube"].connect_to(ends["tube"], position=position, angle=angle)
        joints["socket"].connect_to(ends["socket"], angles=(x, y, z))
        rod.joints["top"].connect_to(cap.joints["r"])

    move(35, 5, 12, 77, 10, 20, 30)
    return Compound(label="arm", children=list(sizes.values())), sizes, move


NAMES = ["base.hinge", "leaf.rail", "base.tube.position", "base.tube.angle", "base.socket.x", "base.socket.y", "base.socket.z"]


@needs_build123d
def test_poses_are_those_of_build123d():
    model, parts, move = arm()
    assembly = chasles.cad.load(model)
    robot = assembly.robot()
    assert (
        set(robot.variables) == set(NAMES) and assembly.parts["leaf"].colour == (1, 0, 0) and assembly.parts["rod"].colour is None
    )
    at_rest = dict(zip(robot.variables, assembly.rest))
    assert [round(at_rest[name], 9) for name in NAMES] == [
        round(v, 9) for v in [*np.radians([35]), 5, 12, *np.radians([77, 10, 20, 30])]
    ]
    random, worst = np.random.default_rng(5), 0.0
    for _ in range(1000 if LONG else 100):
        values = random.uniform([0, -10, 0, 0, 1, 1, 1], [170, 20, 50, 360, 80, 80, 80])
        try:
            move(*values)
        except ValueError:  # build123d compares the angles of a ball after a change of frames
            move(*values[:4], 10, 20, 30)
            values[4:] = 10, 20, 30
        radians = np.where([0, 1, 1, 0, 0, 0, 0], values, np.radians(values))
        poses = assembly.poses(robot, [dict(zip(NAMES, radians))[name] for name in robot.variables])
        worst = max(worst, *(np.abs(poses[name] - matrix_of(part.location.wrapped)).max() for name, part in parts.items()))
    assert worst < 1e-8


@needs_build123d
def test_occt_refutes_nothing_at_random_poses():
    """Pairs that OCCT finds in contact are in contact, and pairs that it finds apart by more than the bounds are not."""
    model, _, _ = arm()
    assembly = chasles.cad.load(model, deflection=0.02)
    robot = assembly.robot()
    pairs = {frozenset(pair) for pair in itertools.combinations(assembly.parts, 2)} - {frozenset(("rod", "cap"))}  # rigid
    assert {frozenset(pair) for pair in robot.tested_pairs()} == pairs
    checker, random, seen = chasles.RobotChecker(robot), np.random.default_rng(6), 0
    joints = {joint.name: joint for joint in assembly.joints}
    lower, upper = np.array([(joints[name].lower, joints[name].upper) for name in robot.variables]).T
    for _ in range(1000 if LONG else 15):
        row = random.uniform(lower, upper)
        poses = assembly.poses(robot, row)
        shapes = {name: cs.placed(part.shape, poses[name]) for name, part in assembly.parts.items()}
        found = {frozenset(pair) for pair in checker.pairs_in_contact(row)}
        for first, second in robot.tested_pairs():
            distance = cs.distance(shapes[first], shapes[second])
            bounds = 2 * (assembly.parts[first].bound + assembly.parts[second].bound)
            assert distance > 1e-6 or {first, second} in found, (first, second, distance)
            assert distance < bounds + 1e-6 or {first, second} not in found, (first, second, distance)
            seen += distance == 0
    assert seen > (500 if LONG else 8)


@needs_build123d
def test_parts_of_several_solids_are_assemblies():
    from build123d import Box, BuildPart, Compound, Edge, Locations, Pos, RevoluteJoint, RigidJoint

    cut = Box(10, 1, 1) - Box(1, 2, 2)  # two boxes, 1 mm apart
    with BuildPart() as builder, Locations((0, 0, 0), (2, 0, 0)):
        Box(1, 1, 1)
    for source in (
        cut,
        Box(1, 1, 1) + Pos(2, 0, 0) * Box(1, 1, 1),
        builder,
        Compound([Box(1, 1, 1), Pos(2, 0, 0) * Box(1, 1, 1)]),
    ):
        assembly = chasles.cad.load(source)
        report = chasles.cad.check(assembly)
        assert list(assembly.parts) == ["solid 1", "solid 2"] and report.least.lower <= 1 <= report.least.upper
    cut.label = "two"
    other = Pos(0, 0, 5) * Box(1, 1, 1)
    other.label = "other"
    hinge = RevoluteJoint("hinge", other, angular_range=(0, 90))
    hinge.connect_to(RigidJoint("r", cut), angle=10)
    assembly = chasles.cad.load(Compound(label="all", children=[cut, other, Edge.make_line((0, 0, 0), (1, 0, 0))]))
    assert list(assembly.parts) == ["two/solid 1", "two/solid 2", "other"] and "no faces" in assembly.warnings[0]
    assert [(joint.name, joint.child) for joint in assembly.joints] == [("other.hinge", "two")]
    assert {frozenset(pair) for pair in assembly.robot().tested_pairs()} == {
        frozenset(("other", f"two/solid {n}")) for n in (1, 2)
    }


@needs_build123d
def test_what_has_no_shape_is_refused():
    from build123d import Box, BuildPart, Compound, Part, ShapeList

    for source in (Compound(label="q", children=[]), BuildPart(), Part(), ShapeList([Box(1, 1, 1)])):
        with pytest.raises(chasles.InvalidInput, match=r"has no shape; an assembly is a Compound\(children="):
            chasles.cad.load(source)
    with pytest.raises(chasles.InvalidInput, match="is empty"):
        chasles.cad.load(Box(1, 1, 1) - Box(2, 2, 2))


@needs_build123d
def test_build123d_refusals():
    from build123d import Box, Compound, RevoluteJoint, RigidJoint

    base, other = Box(1, 1, 1), Box(1, 1, 1)
    base.label, other.label = "base", "other"
    hinge, end = RevoluteJoint("hinge", base), RigidJoint("r", other)
    hinge.connect_to(end, angle=10)
    with pytest.raises(chasles.InvalidInput, match="'other' is no part of the assembly"):
        chasles.cad.load(Compound(children=[base]))
    other.position += (0, 0, 5)
    with pytest.raises(chasles.InvalidInput, match="not where it connects"):
        chasles.cad.load(Compound(children=[base, other]))


def door():
    import cadquery as cq

    base = cq.Workplane().box(40, 20, 4).faces(">Z").workplane().hole(6)
    model = cq.Assembly(name="door", color=cq.Color(1, 0, 0))
    model.add(base, name="base", color=cq.Color(0, 0, 1))
    model.add(cq.Workplane().circle(2.9).extrude(30), name="pin", loc=cq.Location((5, 5, 50)))
    model.add(cq.Workplane().box(5, 5, 5), name="block", loc=cq.Location((50, 5, 50)))
    model.constrain("base", "Fixed")
    model.constrain("base@faces@<Z", "pin@faces@<Z", "Axis", param=0)
    model.constrain("base@faces@<Z", "pin@faces@<Z", "Point")
    model.constrain("block@faces@<Z", "base@faces@>Z", "Axis")
    model.constrain("block@faces@<Z", "base@faces@>Z", "PointInPlane", param=0.5)
    model.constrain("block@faces@>X", "base@faces@>X", "Axis", param=0)
    model.constrain("block@faces@<Y", "base@faces@<Y", "PointInPlane", param=1)
    return model.solve()


@needs_cadquery
def test_joints_are_what_constraints_leave():
    model = door()
    assembly = chasles.cad.load(model)
    kinds = {joint.name: (joint.type, joint.child, np.abs(joint.axis).round(6).tolist()) for joint in assembly.joints}
    assert kinds == {"pin": ("revolute", "pin", [0, 0, 1]), "block": ("prismatic", "block", [1, 0, 0])}
    assert assembly.parts["pin"].colour == pytest.approx((1, 0, 0)) and assembly.parts["base"].colour == pytest.approx((0, 0, 1))
    for name, part in assembly.parts.items():
        assert np.abs(part.place - matrix_of(model.objects[name].loc.wrapped)).max() < 1e-12
    report = chasles.cad.check(assembly, least_seconds=0)
    assert report.verdict == "clear" and report.least.lower <= 0.1 <= report.least.upper


@needs_cadquery
def test_the_constraints_hold_along_the_joints():
    """CadQuery's own constraints at 1,000 poses."""
    from chasles.cad_cadquery import _Constraint

    model = door()
    assembly = chasles.cad.load(model)
    robot, random = assembly.robot(), np.random.default_rng(7)
    constraints = [_Constraint(tuple(c.objects), pod) for c in model.constraints if c.kind != "Fixed" for pod in c.toPODs()]
    for row in random.uniform([-3, -20], [3, 20], (1000, 2)):
        poses = assembly.poses(robot, [dict(pin=row[0], block=row[1])[name] for name in robot.variables])
        assert max(np.abs(c.off(poses)).max() for c in constraints) < 1e-5


@needs_cadquery
def test_step_files_of_cadquery_have_its_names(tmp_path):
    """It writes a part that comes twice once, and later instances without names."""
    import cadquery as cq

    pair = cq.Assembly(name="pair")
    for name, place in (("pin", 0), ("hub", 5)):
        pair.add(cq.Workplane().box(2, 2, 2), name=name, loc=cq.Location((place, 0, 0)))
    top = cq.Assembly(name="top")
    for name, place in (("left", 0), ("right", 9)):
        top.add(pair, name=name, loc=cq.Location((0, place, 0)))
    top.export(str(tmp_path / "top.step"))
    assert list(chasles.cad.load(tmp_path / "top.step").parts) == list(chasles.cad.load(top).parts)


@needs_cadquery
def test_cadquery_refusals():
    import cadquery as cq

    model = cq.Assembly(name="pile")
    for name in "abc":
        model.add(cq.Workplane().box(1, 1, 1), name=name)
    model.constrain("a", "Fixed")
    model.constrain("a@faces@>Z", "b@faces@<Z", "PointInPlane")
    with pytest.raises(chasles.InvalidInput, match="'b' keeps 5 freedoms"):
        chasles.cad.load(model)
