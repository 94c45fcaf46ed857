"""Animations of glTF beside others: the poses of three.js, collisions of FCL at dense samples, and Khronos' validator of files.

three.js and the validator run in Node. They are looked for in CHASLES_NODE_MODULES, a folder `node_modules`, and in the builds of the
viewer. CHASLES_BPY is a Python with the module bpy, for Blender.
"""

import json
import os
import pathlib
import shutil
import subprocess
from itertools import combinations

import chasles
import chasles.gltf
import numpy as np
import pytest
from conftest import ROOT

pytest.importorskip("scipy")
from gltf_files import CUBE, Maker, Sampler, random_scene  # noqa: E402

IS_LONG = bool(os.environ.get("CHASLES_LONG"))
VALIDATE = """const { validateBytes } = require("gltf-validator");
const { readFileSync } = require("fs");
(async () => { for (const file of process.argv.slice(2)) {
  const { issues } = await validateBytes(new Uint8Array(readFileSync(file)));
  console.log(JSON.stringify([issues.numErrors, issues.numWarnings, issues.messages]));
} })();"""

IN_BLENDER = """import bpy, json, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[1])
scene, seen = bpy.context.scene, []
(marker,) = (thing for thing in scene.objects if thing.name.startswith("contact"))
for time in map(float, sys.argv[2:]):
    frame = time * scene.render.fps / scene.render.fps_base
    scene.frame_set(int(frame), subframe=frame - int(frame))
    matrix = marker.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
    seen.append([list(matrix.translation), list(matrix.to_scale())])
print(json.dumps(seen))"""


def modules_with(package):
    folders = [os.environ.get("CHASLES_NODE_MODULES", ""), *map(str, ROOT.glob("build/*/viewer/node_modules"))]
    for folder in folders:
        if folder and pathlib.Path(folder, package).is_dir():
            return pathlib.Path(folder)
    pytest.skip(f"no {package} for Node (CHASLES_NODE_MODULES)")


def node(tmp_path, package, script, *arguments, text=""):
    """What a script in Node prints, with the package beside it."""
    if shutil.which("node") is None:
        pytest.skip("no Node")
    link = tmp_path / "node_modules"
    if not link.exists():
        link.symlink_to(modules_with(package).resolve())
    done = subprocess.run(
        ["node", tmp_path / script, *arguments], input=text, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout


def by_three(tmp_path, file, times):
    shutil.copy(pathlib.Path(__file__).with_name("gltf_by_three.mjs"), tmp_path)
    return json.loads(node(tmp_path, "three", "gltf_by_three.mjs", file, text=json.dumps(list(times))))


def test_bodies_are_where_three_js_has_them(tmp_path):
    """Single precision: three.js keeps places and turns so, and coordinates are below 40."""
    random, worst, count = np.random.default_rng(9), 0.0, 0
    for _ in range(60 if IS_LONG else 4):
        maker = random_scene(random)
        animation = chasles.gltf.read(maker.write(tmp_path / "scene.glb"))
        times = random.uniform(0, animation.duration, 50)
        numbers = {item["name"]: str(index) for index, item in enumerate(maker.json["nodes"])}
        for time, matrices in zip(times, by_three(tmp_path, tmp_path / "scene.glb", times)["matrices"]):
            poses = animation.poses(time)
            for name, body in animation.bodies.items():
                matrix = np.array(matrices[numbers[name]]).reshape(4, 4).T
                theirs = CUBE[0] @ matrix[:3, :3].T + matrix[:3, 3]
                ours = body.vertices @ poses[name][:3, :3].T + poses[name][:3, 3]
                worst, count = max(worst, float(np.abs(theirs - ours).max())), count + 1
    assert count >= 1000 and worst < 1e-5, worst


def test_half_turns_go_the_way_of_three_js(tmp_path):
    maker = Maker()
    mesh = maker.mesh()
    ways = [
        [[0, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]],
        [[0, 0, 0, 1], [0, 0, -1, 0], [0, 0, 0, -1]],
        [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1]],
    ]
    for number, keys in enumerate(ways):
        maker.animate(maker.node(f"cube {number}", mesh=mesh), "rotation", [0, 1, 2], keys)
    animation = chasles.gltf.read(maker.write(tmp_path / "scene.glb"))
    times = np.linspace(0.05, 1.95, 20)
    for time, matrices in zip(times, by_three(tmp_path, tmp_path / "scene.glb", times)["matrices"]):
        poses = animation.poses(time)
        for number in range(len(ways)):
            theirs = np.array(matrices[str(number)]).reshape(4, 4).T[:3, :3]
            np.testing.assert_allclose(poses[f"cube {number}"][:3, :3], theirs, atol=1e-6)


def test_markers_appear_in_three_js_when_bodies_touch(tmp_path):
    animation, found, out = first_answer(tmp_path)
    theirs = by_three(tmp_path, out, [found.time - 1e-3, found.time + 1e-3, animation.duration])
    (number,) = (number for number, name in theirs["names"].items() if name.startswith("contact"))
    before, after, end = (np.array(matrices[number]).reshape(4, 4).T for matrices in theirs["matrices"])
    assert np.all(before[:3, :3] == 0) and abs(np.linalg.det(after) - 1) < 1e-9 and np.array_equal(after, end)
    np.testing.assert_allclose(after[:3, 3], found.contacts[0].point, atol=1e-12)
    np.testing.assert_allclose(after[:3, 2], found.contacts[0].normal, atol=1e-12)
    assert theirs["animations"] == [["take 0", pytest.approx(animation.duration)]]


def first_answer(tmp_path):
    """An animation with a contact on its way."""
    found, seed = None, 0
    while found is None or found.pair is None or found.time == 0 or not found.contacts:
        seed += 1
        maker = random_scene(np.random.default_rng(seed), kinds=["LINEAR"], spread=2)
        animation = chasles.gltf.read(maker.write(tmp_path / "scene.glb"))
        found = animation.first_contact()
    return animation, found, chasles.gltf.mark(tmp_path / "scene.glb", found, tmp_path / "marked.glb")


def test_markers_appear_in_blender_when_bodies_touch(tmp_path):
    """CHASLES_BPY is a Python that has Blender as the module bpy. Blender turns y up into z up, and shows whole frames."""
    if "CHASLES_BPY" not in os.environ:
        pytest.skip("no Blender (CHASLES_BPY)")
    _, found, out = first_answer(tmp_path)
    (tmp_path / "in_blender.py").write_text(IN_BLENDER, "utf-8")
    done = subprocess.run(
        [os.environ["CHASLES_BPY"], tmp_path / "in_blender.py", out, *map(str, (found.time - 0.05, found.time + 0.05))],
        capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    before, after = json.loads(done.stdout.splitlines()[-1])
    x, y, z = found.contacts[0].point
    assert before[1] == [0, 0, 0] and np.allclose(after[1], 1, atol=1e-5)
    np.testing.assert_allclose(after[0], [x, -z, y], atol=1e-5)


def test_marked_files_are_valid(tmp_path):
    modules_with("gltf-validator")
    files = []
    for seed in range(12 if IS_LONG else 4):
        file = random_scene(np.random.default_rng(seed), bodies=4, kinds=["LINEAR", "STEP"], spread=1.5).write(
            tmp_path / f"{seed}.glb"
        )
        answers = chasles.gltf.read(file).all_contacts(find="first_with_all_contacts")
        marked = chasles.gltf.mark(file, answers, tmp_path / f"marked {seed}.glb")
        files += [file, marked, chasles.gltf.mark(marked, answers, tmp_path / f"marked again {seed}.glb")]
    (tmp_path / "validate.cjs").write_text(VALIDATE, "utf-8")
    results = [json.loads(line) for line in node(tmp_path, "gltf-validator", "validate.cjs", *files).splitlines()]
    assert len(results) == len(files)
    for errors, warnings, messages in results:
        assert errors == warnings == 0, messages


class Fcl:
    """Both questions to FCL, about the triangles of bodies where the nodes are at a time."""

    def __init__(self, sampler, numbers, time):
        self.fcl = pytest.importorskip("fcl")
        self.objects, world = {}, sampler.world(time)
        for name, number in numbers.items():
            vertices = CUBE[0] @ world[number][:3, :3].T + world[number][:3, 3]
            model = self.fcl.BVHModel()
            model.beginModel(len(CUBE[1]), 8)
            model.addSubModel(vertices, CUBE[1])
            model.endModel()
            self.objects[name] = (
                self.fcl.CollisionObject(model, self.fcl.Transform()),
                vertices.min(axis=0),
                vertices.max(axis=0),
            )

    def collisions(self):
        for a, b in combinations(self.objects, 2):
            (first, *box), (second, *other) = self.objects[a], self.objects[b]
            near = (box[0] <= other[1]).all() and (other[0] <= box[1]).all()
            if near and self.fcl.collide(first, second, self.fcl.CollisionRequest(), self.fcl.CollisionResult()):
                yield frozenset((a, b))

    def distance(self, a, b):
        return max(
            0.0,
            self.fcl.distance(
                self.objects[a][0], self.objects[b][0], self.fcl.DistanceRequest(), self.fcl.DistanceResult()
            ),
        )


@pytest.mark.parametrize("kinds", [["LINEAR"], ["LINEAR", "STEP"], ["LINEAR", "CUBICSPLINE"]], ids="-".join)
def test_fcl_finds_nothing_before_the_first_contact(tmp_path, kinds):
    """At 1,000 random times (20,000 with CHASLES_LONG=1) of each kind; samples can only refute. At each contact both bodies are near."""
    pytest.importorskip("fcl")
    random, hits, contacts = np.random.default_rng(2), 0, 0
    for _ in range(40 if IS_LONG else 4):
        maker = random_scene(random, bodies=4 if "CUBICSPLINE" in kinds else 6, kinds=kinds, spread=2)
        animation = chasles.gltf.read(maker.write(tmp_path / "scene.glb"))
        found = {frozenset(answer.pair): answer for answer in animation.all_contacts()}
        names = [item["name"] for item in maker.json["nodes"]]
        still = {frozenset(pair) for pair in animation.untested().named.get("at_rest", [])}
        sampler, numbers = Sampler(maker), {name: names.index(name) for name in animation.bodies}
        for time in random.uniform(0, animation.duration, 500 if IS_LONG else 250):
            for pair in set(Fcl(sampler, numbers, time).collisions()) - still:
                assert pair in found and found[pair].time <= time, (pair, time, found.get(pair))
                hits += 1
        for answer in found.values():
            if answer.certain and answer.verdict == "contact" and not answer.at_jump:
                assert Fcl(sampler, numbers, answer.time).distance(*answer.pair) < 1e-6, answer
                contacts += 1
    assert hits > 100 and contacts >= 3, (hits, contacts)
