"""Certificates of scenes and robots, checked by tools/verify.py, which shares nothing with the package."""
import pathlib
import sys

import numpy as np
import pytest
import seven_joints

import chasles

TOOLS = pathlib.Path(__file__).parents[2] / "tools"
if not (TOOLS / "verify.py").exists():
    pytest.skip("the checker is in the folder tools of the project", allow_module_level=True)
sys.path.insert(0, str(TOOLS))
import verify  # noqa: E402


def block(size):
    """The file of a box, and the box."""
    corners = [[x * size[0], y * size[1], z * size[2]] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    rows = ["v " + " ".join(map(repr, corner)) for corner in corners]
    text = "\n".join(rows + ["f " + " ".join(str(i + 1) for i in quad) for quad in quads]) + "\n"
    return text, chasles.Polyhedron(corners, [q for quad in quads for q in (quad[:3], [quad[0], *quad[2:]])])


def test_scenes_are_verified_by_both(tmp_path):
    rng = np.random.default_rng(51)
    verdicts = set()
    for _ in range(12):
        scene, files = chasles.Scene(), []
        for i in range(4):
            size = rng.uniform(0.1, 0.8, 3).tolist()
            text, body = block(size)
            corners, faces = np.asarray(body.vertices), np.asarray(body.faces)
            rows = ["v " + " ".join(repr(float(x)) for x in v) for v in corners]
            rows += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
            files.append(str(tmp_path / f"{i}.obj"))
            pathlib.Path(files[-1]).write_text("\n".join(rows) + "\n")
            poses = [[*rng.uniform(-2.5, 2.5, 3), *rng.normal(size=4)] for _ in range(2)]
            if i > 0:
                scene.add(f"body {i}", body, *poses, motion=str(rng.choice(["velocity", "twist"])))
            else:
                scene.add("body at rest", body, poses[0])
        proof = scene.certificate(margin=0.0625)
        (tmp_path / "scene.cert").write_text(proof)
        status, answer = verify.main([*files, str(tmp_path / "scene.cert")])
        assert status == 0, answer
        found = scene.first_contact(margin=0.0625)
        word = str(found.verdict).removeprefix("contact_at_")
        assert answer.splitlines()[1].startswith(f"verdict: {word}")
        assert word in scene.verify(proof, margin=0.0625).splitlines()[0]
        verdicts.add(word)
    assert verdicts == {"clear", "contact", "start"}


def test_a_certificate_of_another_scene_or_margin_is_refused():
    scene = chasles.Scene()
    _, cube = block([0.5, 0.5, 0.5])
    scene.add("a", cube, [0, 0, 0, 1, 0, 0, 0], [1, 0, 0, 1, 0, 0, 0])
    scene.add("b", cube, [0, 3, 0, 1, 0, 0, 0])
    proof = scene.certificate()
    assert scene.verify(proof).startswith("verified")
    with pytest.raises(chasles.InvalidInput, match="verify: the certificate is about another scene or another margin"):
        scene.verify(proof, margin=0.5)
    with pytest.raises(chasles.InvalidInput):
        scene.verify(proof.rstrip().rsplit("\n", 1)[0])
    scene.ignore("a", "b")
    with pytest.raises(chasles.InvalidInput, match="another scene"):
        scene.verify(proof)


def test_paths_of_robots_are_verified():
    robot = seven_joints.arm()
    scene = chasles.Scene()
    scene.add("post", block([0.05, 0.05, 1.0])[1], [0.6, 0.3, 0.5, 1, 0, 0, 0])
    checker = chasles.RobotChecker(robot, scene)
    rng = np.random.default_rng(52)
    verdicts = set()
    for _ in range(20):
        path = np.vstack([np.zeros(7), np.cumsum(rng.uniform(-0.8, 0.8, (2, 7)), axis=0)])
        proof = checker.certificate(path)
        found = checker.first_contact_on_path(path)
        word = str(found.verdict).removeprefix("contact_at_")
        assert checker.verify(path, proof).splitlines()[0].startswith(f"verified: {word}")
        verdicts.add(word)
        with pytest.raises(chasles.InvalidInput, match="another robot, scene, path or margin"):
            checker.verify(path + 0.125, proof)
    assert {"clear", "contact"} <= verdicts


def test_rows_of_a_batch_have_the_certificates_of_their_answers():
    rng = np.random.default_rng(53)
    _, cube = block([0.5, 0.5, 0.5])
    starts = [[3, 0.2, 0.3, 1, 0, 0, 0]] * 4
    goals = [[*rng.uniform(-3, 3, 3), *rng.normal(size=4)] for _ in starts]
    for motion in ("screw", "velocity"):
        proofs = chasles.certificate_batch(cube, cube, starts, goals, motion=motion, margin=0.125)
        for start, goal, proof in zip(starts, goals, proofs, strict=True):
            assert proof == chasles.first_contact(cube, cube, start, goal, motion=motion, margin=0.125).certificate()
    half_turn = [3, 0.2, 0.3, 0, 0, 0, 1]
    with pytest.raises(chasles.InvalidInput, match=r"motions\[1\]: "):
        chasles.certificate_batch(cube, cube, starts[:2], [goals[0], half_turn], motion="twist")
    marked = chasles.certificate_batch(cube, cube, starts[:2], [goals[0], half_turn], motion="twist", errors="mark")
    assert marked[0].startswith("chasles certificate 1") and marked[1] is None
