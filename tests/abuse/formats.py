"""The formats that are read: whole files of each, and the questions that read them."""

import json
from dataclasses import dataclass, field
from pathlib import Path

import damages
import meshes
from damages import Damage
from inputs import CERTIFICATES, MOTIONS_HEADER, POSE, SLOW_ROW, chain, shape
from questions import BODIES, PART, ROBOT

ROOT = Path(__file__).parent.parent.parent  # of the project
CORPUS = ROOT / "tests/fuzz/corpus"

MESHES = ("in_robot.dae", "packages")  # of the robot
ARM = ("arm.urdf", "arm.srdf", *MESHES)


@dataclass(frozen=True)
class Format:
    """`FILE` stands for the damaged file, and `NEW` for an output."""

    name: str
    file: str  # its name
    wholes: list[bytes]
    questions: list[tuple[str, ...]]
    inputs: tuple[str, ...]  # of the small world
    companions: dict[str, bytes] = field(default_factory=dict)  # further files
    damage: Damage = damages.damaged
    of_options: tuple[str, ...] = ()  # parts of errors that name an option which does not fit to the file, instead of the file


def mesh_companions(file: str) -> dict[str, bytes]:
    bodies = [{"name": "a", "mesh": file}, {"name": "b", "mesh": "moving.obj", "pose": [5, 0, 0], "goal": [-5, 0, 0]}]
    return {
        "of_mesh.json": json.dumps({"bodies": bodies}).encode(),
        "of_mesh.urdf": f'<robot name="r"><link name="a">{shape(file)}</link></robot>'.encode(),
    }


def mesh_format(ending: str) -> Format:
    file = "damaged." + ending
    wholes = [write(mesh) for write in meshes.WRITERS[ending] for mesh in (meshes.cube(), meshes.sheet(3))]
    wholes += [path.read_bytes() for path in sorted((CORPUS / "mesh_files").glob(f"[a-z]*.{ending}"))]
    motion = ("--start", "5,0,0", "--goal", "-5,0,0")
    questions = [
        ("info", "FILE"),
        ("info", "FILE", "--json", "--triangulate"),
        ("check", "FILE", "moving.obj", *motion, "--triangulate", "--json"),
        ("check", "moving.obj", "FILE", *motion, "--motion", "velocity"),
        ("scene", "of_mesh.json", "--all"),
        ("robot", "of_mesh.urdf"),
    ]
    damage = {"3mf": damages.damaged_zip, "glb": damages.damaged_glb, "gltf": damages.damaged_tree}
    how = damage.get(ending, damages.damaged)
    return Format(ending, file, wholes, questions, ("moving.obj",), mesh_companions(file), how)


def scene_formats() -> list[Format]:
    shipped = (ROOT / "examples/scene/three_cubes.json").read_bytes().replace(b"cube.obj", b"moving.obj")
    bodies = [
        {"name": "a", "mesh": "moving.obj", "scale": 2.0, "pose": [0, 0, 0, 1, 0, 0, 0], "group": "still"},
        {"name": "b", "mesh": "part.gltf", "part": "part", "poses": [{"t": 0, "pose": [4, 0, 0]}, {"t": 1, "pose": [0, 0, 0]}]},
        {"name": "c", "urdf": "fixture.urdf", "pose": [1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1], "group": "still"},
        {"name": "d", "mesh": "fixed.stl", "pose": [9, 9, 9], "goal": [-9, 9, 9], "motion": "twist"},
    ]
    whole = {"bodies": bodies, "ignore": [["a", "c"]], "ignore_groups": [["still", "still"]], "margin": 0.1, "hold": 0.05}
    wholes = [shipped, json.dumps({**whole, "ignore_touching_at_start": True}).encode()]
    rest = [{"name": "box", "mesh": "moving.obj", "pose": [0, 0, 3]}, {"name": "table", "mesh": "fixed.stl"}]
    at_rest = [json.dumps({"bodies": rest}).encode()]
    questions = [
        ("scene", "FILE", "--json"),
        ("scene", "FILE", "--all", "--page", "NEW"),
        ("robot", *ROBOT, "--path", "path.csv", "--scene", "FILE"),
    ]
    drag = [("drag", "FILE", "--body", "box", "--goals", "goals.csv", "--out", "NEW")]
    files = (*BODIES, *PART, "fixture.urdf", "fixture.3mf", *ARM, "path.csv", "goals.csv")
    of_options = ("scene: box: ", "drag: margin: ")
    return [
        Format("scene", "damaged.json", wholes, questions, files, {}, damages.damaged_tree),
        Format("scene-at-rest", "damaged.json", at_rest, drag, files, {}, damages.damaged_tree, of_options),
    ]


def table_formats() -> list[Format]:
    poses = f"t,{POSE}\n0,3,0,0,1,0,0,0\n1,3,3,0,1,0,0,0.5\n2.5,0.2,3,2,1,0,0,0\n"
    named = "# a path\npose.position.x;pose.position.y;pose.position.z;orientation_x;orientation_y;orientation_z;orientation_w\n"
    named += "3;0;0;0;0;0;1\n3;3;0;0;0;0.3;1\n"
    tum = "# timestamp tx ty tz qx qy qz qw\n0.5 3 0 0 0 0 0 1\n1.5 3 3 0 0 0 0 1\n2.25 0.2 3 2 0.1 0 0 1\n"
    moves = f"{MOTIONS_HEADER}\na,3,0,0,1,0,0,0,0,0,3,1,0,0,0\nb,0,0,3,1,0,0,0,0,0,-3,1,0,0.2,0\n" + '"c, d",' + SLOW_ROW + "\n"
    turns = "t,joint0,joint1\n0,0,0\n1,0.01,-0.01\n2.5,0,0.005\n"
    path_of = ("path", "moving.obj", "fixed.stl", "--poses", "FILE")
    drag = ("drag", "rest.json", "--body", "box", "--goals", "FILE", "--out", "NEW")
    questions = [path_of, (*path_of, "--motion", "twist", "--json"), drag]
    batch = [("batch", "moving.obj", "fixed.stl", "--motions", "FILE", "--out", "NEW")]
    robot = [("robot", *ROBOT, "--path", "FILE", "--json")]
    files = (*BODIES, *PART, "rest.json")
    return [
        Format("poses", "damaged.csv", texts(poses, named), questions, files),
        Format("tum", "damaged.tum", texts(tum, tum[tum.index("\n") + 1 :]), questions, files),
        Format("motions", "damaged.csv", texts(moves), batch, BODIES),
        Format("joints", "damaged.csv", texts(turns, turns.replace(",", " ").replace("joint0", "joint0_deg")), robot, ARM),
    ]


def texts(*wholes: str) -> list[bytes]:
    return [whole.encode() for whole in wholes]


def trajectory_formats() -> list[Format]:
    points = [{"positions": [0.0, 0.01 * i], "time_from_start": {"sec": i, "nanosec": 5}} for i in range(3)]
    message = {"joint_names": ["joint0", "joint1"], "points": points}
    yaml = """joint_trajectory:
  header: {stamp: {secs: 0, nsecs: 0}, frame_id: ''}
  joint_names: &n [joint0, "joint1"]
  points:
  - positions: &p [0.0, 0.005]
    velocities: []
    time_from_start: {secs: 0, nsecs: 0}
  - positions:
    - 0.01
    - -0.01
    time_from_start:
      secs: 1
      nsecs: 500000000
  - {positions: *p, time_from_start: {secs: 2, nsecs: 0}}
---
"""
    wholes = [json.dumps(message).encode(), json.dumps({"trajectory": message}, indent=1).encode()]
    robot = [("robot", *ROBOT, "--path", "FILE")]
    return [
        Format("trajectory-json", "damaged.json", wholes, robot, ARM, damage=damages.damaged_tree),
        Format("trajectory-yaml", "damaged.yaml", texts(yaml), robot, ARM),
    ]


def robot_formats() -> list[Format]:
    arm = (ROOT / "examples/robot/arm.urdf").read_bytes()
    still = f'<robot name="s"><link name="a">{shape("fixture.3mf")}</link></robot>'.encode()
    around = {"name": "a", "urdf": "damaged.urdf"}, {"name": "b", "mesh": "moving.obj"}
    turns = b"waist,elbow,joint0,joint1\n0,0,0,0\n0.1,0.1,0,0.01\n"
    companions = {"around.json": json.dumps({"bodies": around}).encode(), "turns.csv": turns}
    questions = [
        ("info", "FILE", "--packages", "parts=packages/parts"),
        ("info", "FILE", "--packages", "parts=packages/parts", "--json"),
        ("acm", "FILE", "--packages", "parts=packages/parts", "--seconds", "0.2"),
        ("robot", "FILE", "--packages", "parts=packages/parts", "--path", "turns.csv"),
    ]
    in_scene = [("scene", "around.json", "--until", "0"), ("robot", "FILE"), ("info", "FILE")]
    disabled = """<?xml version="1.0"?><robot name="chain"><!-- pairs --><group name="all"><link name="base"/><joint name="joint0"/>
<chain base_link="base" tip_link="link2"/></group>
<group_state name="home" group="all"><joint name="joint0" value="0"/></group_state>
<disable_default_collisions link="link1"/><enable_collisions link1="base" link2="link1"/>
<disable_collisions link1="base" link2="link2" reason="Never"/>
<virtual_joint name="world" type="fixed" parent_frame="world" child_link="base"/></robot>"""
    with_srdf = ("arm.urdf", "--srdf", "FILE", "--packages", "parts=packages/parts")
    acm = ("acm", *with_srdf, "--seconds", "0.2", "--out", "NEW")
    srdf = [("robot", *with_srdf, "--path", "path.csv"), ("info", *with_srdf), acm]
    return [
        Format("urdf", "damaged.urdf", [arm, chain(3).encode()], questions, MESHES, companions, of_options=("turns.csv: ",)),
        Format("urdf-at-rest", "damaged.urdf", [still], in_scene, ("fixture.3mf", "moving.obj"), companions),
        Format("srdf", "damaged.srdf", texts(disabled), srdf, ("arm.urdf", *MESHES, "path.csv")),
    ]


def rows_format(rows: bytes) -> Format:
    """The rows that a cut batch has left are read by `--resume`."""
    batch = ("batch", "moving.obj", "fixed.stl", "--motions", "motions.csv", "--motion", "velocity", "--out", "damaged", "--resume")
    cut = rows[: rows.rindex(b"\n", 0, -1) + 1]
    return Format("rows", "damaged.part", [rows, cut], [batch], (*BODIES, "motions.csv"))


def certificate_format() -> Format:
    return Format("certificate", "damaged.txt", CERTIFICATES, [("verify", *BODIES, "FILE")], BODIES)


def all_formats(rows: bytes) -> dict[str, Format]:
    """`rows` are those of the batch of the small world."""
    found = [mesh_format(ending) for ending in meshes.WRITERS]
    found += [*scene_formats(), *table_formats(), *trajectory_formats(), *robot_formats(), rows_format(rows), certificate_format()]
    return {each.name: each for each in found}


NAMES = list(all_formats(b"\n\n"))
