"""Writes the inputs of all questions: small ones, ones with large outputs, and slow ones. They have the same names."""

import json
from collections.abc import Callable
from pathlib import Path

import meshes
from meshes import Mesh

AT_ONE_MOTION = ["--start", "3,0.2,0.3", "--goal", "0,0.2,3"]
# The sheets slide past each other at a billionth of their size.
SLIDE = ["--start", "0,0.1,1e-9", "--goal", "0.4 0.1 1e-9 0.92 0 0 0.39", "--motion", "velocity"]
MOTION = {"small": AT_ONE_MOTION, "large": AT_ONE_MOTION, "slow": SLIDE}

POSE = "x,y,z,qw,qx,qy,qz"
MOTIONS_HEADER = "id," + ",".join(f"{column}{end}" for end in "01" for column in POSE.split(","))
SLOW_ROW = "0,0.1,1e-9,1,0,0,0,0.4,0.1,1e-9,0.92,0,0,0.39"


def body(name: str, mesh: str, *pose: float, **more: object) -> dict:
    return {"name": name, "mesh": mesh, "pose": pose, **more}


# Of two cubes of `meshes.cube()`, whose digests are in them.
CERTIFICATES = [path.read_bytes() for path in sorted((Path(__file__).parent / "certificates").iterdir())]

FIXTURE = {"name": "fixture", "urdf": "fixture.urdf", "pose": [9, -9, 0]}


def write_meshes(folder: Path, moving: Mesh, other: Mesh) -> None:
    files = {
        "moving.obj": meshes.obj(moving),
        "fixed.stl": meshes.binary_stl(moving),
        "part.gltf": json.dumps(meshes.gltf_json(other, "part.bin")).encode(),
        "part.bin": meshes.gltf_buffer(other),
        "fixture.3mf": meshes.threemf(other),
        "in_robot.dae": meshes.dae(other),
        "attached.ply": meshes.binary_ply(other),
        "proof.txt": CERTIFICATES[0],
        "packages/parts/meshes/in_package.off": meshes.off(other),
    }
    (folder / "packages/parts/meshes").mkdir(parents=True)
    for name, content in files.items():
        (folder / name).write_bytes(content)


def shape(file: str) -> str:
    return f'<collision><geometry><mesh filename="{file}"/></geometry></collision>'


def joint(number: int, parent: str, child: str) -> str:
    return (
        f'<joint name="joint{number}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        '<origin xyz="3 0 0"/><axis xyz="0 0 1"/><limit lower="-0.01" upper="0.01" effort="1" velocity="1"/></joint>'
    )


def chain(links: int) -> str:
    """A robot of links in a row, which barely turn."""
    names = ["base", *(f"link{i}" for i in range(1, links))]
    files = ["in_robot.dae", *["package://parts/meshes/in_package.off"] * (links - 1)]
    text = "".join(f'<link name="{name}">{shape(file)}</link>' for name, file in zip(names, files))
    text += "".join(joint(i, *pair) for i, pair in enumerate(zip(names, names[1:])))
    return f'<robot name="chain">{text}</robot>'


def write_robot(folder: Path, links: int, rows: int) -> None:
    (folder / "arm.urdf").write_text(chain(links))
    (folder / "arm.srdf").write_text('<robot name="chain"><group_state name="home" group="all"/></robot>')
    (folder / "fixture.urdf").write_text(f'<robot name="fixture"><link name="body">{shape("fixture.3mf")}</link></robot>')
    turns = [f"{0.01 * (i % 2)},{-0.01 * (i % 3) / 2}\n" for i in range(rows)]
    (folder / "path.csv").write_text("joint0,joint1\n" + "".join(turns))
    (folder / "cell.json").write_text(json.dumps({"bodies": [body("table", "fixed.stl", 9, 9, 9), FIXTURE]}))


def write_scenes(folder: Path) -> None:
    table, part = body("table", "fixed.stl", 0, 0, 0), body("part", "part.gltf", 5, 0, 0)
    falling = body("box", "moving.obj", 0.2, 0.3, 3, goal=[0.2, 0.3, 1.5])
    turning = {**part, "goal": [5, 0, 1, 1, 0, 0, 0.3]}
    scenes = {
        "scene.json": [table, falling, turning, FIXTURE],
        "rest.json": [table, body("box", "moving.obj", 0.2, 0.3, 3), part],
    }
    for name, bodies in scenes.items():
        (folder / name).write_text(json.dumps({"bodies": bodies}, indent=1))


def write_alike(folder: Path) -> None:
    """Bodies of one shape: a scene, and a robot without joints."""
    bodies = [body("low", "moving.obj", 0, 0, 0), body("high", "moving.obj", 0.2, 0.3, 3, goal=[0.2, 0.3, 1.5])]
    (folder / "alike.json").write_text(json.dumps({"bodies": bodies}))
    (folder / "post.urdf").write_text(f'<robot name="post"><link name="post">{shape("moving.obj")}</link></robot>')


def write_tables(folder: Path, goals: int, motions: int) -> None:
    rows = [f"{i},0.2,{0.3 + 0.1 * (i % 5)},{3 - 0.2 * (i % 9)},1,0,0,0\n" for i in range(goals)]
    (folder / "goals.csv").write_text(f"t,{POSE}\n" + "".join(rows))
    rows = [f"row {i},0.2,0.3,{3 + i % 7},1,0,0,0,0.2,0.3,{-1 - i % 3},1,0,0,{0.1 * (i % 4)}\n" for i in range(motions)]
    (folder / "motions.csv").write_text(f"{MOTIONS_HEADER}\n" + "".join(rows))
    (folder / "motion.csv").write_text(f"{MOTIONS_HEADER}\nclear,0.2,0.3,3,1,0,0,0,0.2,0.3,1.5,1,0,0,0\n")
    (folder / "poses.csv").write_text(f"{POSE}\n3,0,0,1,0,0,0\n3,3,0,1,0,0,0\n0.25,3,2,1,0,0,0\n")


def write_small(folder: Path) -> None:
    write_meshes(folder, meshes.cube(), meshes.cube())
    write_robot(folder, links=3, rows=3)
    write_scenes(folder)
    write_alike(folder)
    write_tables(folder, goals=4, motions=4)


def write_large(folder: Path) -> None:
    write_meshes(folder, meshes.sheet(50), meshes.cube())
    write_robot(folder, links=12, rows=30)
    write_scenes(folder)
    write_alike(folder)
    write_tables(folder, goals=2000, motions=400)


def sliding_arm() -> str:
    """Two sheets on a slider and a hinge, at the gap of `SLIDE`."""
    box = '<collision><origin xyz="0 0 5"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision>'
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    return (
        f'<robot name="arm"><link name="base">{shape("moving.obj")}</link><link name="between">{box}</link>'
        f'<link name="upper">{shape("moving.obj")}</link><joint name="joint0" type="prismatic"><parent link="base"/>'
        f'<child link="between"/><origin xyz="0 0.1 1e-9"/><axis xyz="1 0 0"/>{limit}</joint>'
        '<joint name="joint1" type="revolute"><parent link="between"/><child link="upper"/>'
        f'<axis xyz="0 0 1"/>{limit}</joint></robot>'
    )


def write_slow(folder: Path) -> None:
    write_meshes(folder, meshes.sheet(300), meshes.cube())
    write_robot(folder, links=3, rows=3)
    write_alike(folder)
    table = body("table", "moving.obj", 0, 0, 0)
    sliding = body("box", "moving.obj", 0, 0.1, 1e-9, goal=[0.4, 0.1, 1e-9, 0.92, 0, 0, 0.39])
    (folder / "scene.json").write_text(json.dumps({"bodies": [table, sliding]}))
    (folder / "rest.json").write_text(json.dumps({"bodies": [table, body("box", "moving.obj", 0, 0.1, 1e-4)]}))
    (folder / "cell.json").write_text(json.dumps({"bodies": [body("table", "fixed.stl", 9, 9, 9)]}))
    (folder / "arm.urdf").write_text(sliding_arm())
    (folder / "arm.srdf").write_text('<robot name="arm"><enable_collisions link1="base" link2="upper"/></robot>')
    (folder / "path.csv").write_text("joint0,joint1\n0,0\n0.4,0.8\n")
    slides = [f"{0.1 + 0.01 * (i % 40)},0.1,-0.1,1,0,0,{0.02 * (i % 40)}\n" for i in range(20000)]
    (folder / "goals.csv").write_text(f"{POSE}\n" + "".join(slides))
    (folder / "motions.csv").write_text(f"{MOTIONS_HEADER}\nquick,0,0,9,1,0,0,0,0,0,8,1,0,0,0\n" + f"slow,{SLOW_ROW}\n" * 40)
    (folder / "motion.csv").write_text(f"{MOTIONS_HEADER}\nslow,{SLOW_ROW}\n")
    (folder / "poses.csv").write_text(f"{POSE}\n0,0.1,1e-9,1,0,0,0\n0.4,0.1,1e-9,0.92,0,0,0.39\n")
    (folder / "big.obj").write_bytes(meshes.obj(meshes.sheet(500)))


WORLDS: dict[str, Callable[[Path], None]] = {"small": write_small, "large": write_large, "slow": write_slow}
