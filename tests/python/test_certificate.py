"""Certificates of the package, checked by tools/verify.py, which shares nothing with it, and by chasles.verify."""
import pathlib
import sys

import numpy as np
import pytest

import chasles

TOOLS = pathlib.Path(__file__).parents[2] / "tools"
if not (TOOLS / "verify.py").exists():
    pytest.skip("the checker is in the folder tools of the project", allow_module_level=True)
sys.path.insert(0, str(TOOLS))
import verify  # noqa: E402


def block(rng):
    """A box with its corners moved: six of its faces are two triangles each."""
    low, high = -rng.uniform(0.1, 1, 3), rng.uniform(0.1, 1, 3)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    vertices = np.where(corners, high, low) + rng.uniform(-0.05, 0.05, (8, 3))
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return vertices, [[q[i] for i in corner] for q in quads for corner in ((0, 1, 2), (0, 2, 3))]


def pose(rng, size):
    return [*rng.uniform(-size, size, 3), *rng.normal(size=4)]


def write(path, vertices, faces):
    rows = ["v " + " ".join(repr(float(x)) for x in v) for v in vertices]
    path.write_text("\n".join(rows + ["f " + " ".join(str(i + 1) for i in face) for face in faces]) + "\n")
    return str(path)


def pair(rng, folder):
    """The files of two blocks, and the bodies."""
    files = write(folder / "a.obj", *block(rng)), write(folder / "b.obj", *block(rng))
    return files, [chasles.load(file) for file in files]


def checked(moving, fixed, text, folder):
    (folder / "a.cert").write_text(text)
    return verify.main([moving, fixed, str(folder / "a.cert")])


def test_random_answers_are_verified_by_both(tmp_path):
    rng = np.random.default_rng(47)
    count = {"clear": 0, "contact": 0, "contact_at_start": 0}
    for _ in range(60):
        a, b = block(rng), block(rng)
        radii = rng.uniform(0, 0.2, 2) * rng.integers(0, 2)
        files = write(tmp_path / "a.obj", *a), write(tmp_path / "b.obj", *b)
        bodies = chasles.load(files[0], radius=radii[0]), chasles.load(files[1], radius=radii[1])
        motion = chasles.ScrewMotion.between(pose(rng, 2), pose(rng, 2))
        found = chasles.first_contact(*bodies, motion=motion, margin=rng.uniform(0, 0.2) * rng.integers(0, 2))
        text = found.certificate()
        status, answer = checked(*files, text, tmp_path)
        assert status == 0, answer
        said = answer.splitlines()[1]
        assert {"clear": "clear", "contact": "contact in piece", "contact_at_start": "start"}[str(found.verdict)] in said
        assert str(found.verdict).removeprefix("contact_at_") in chasles.verify(*bodies, motion, text)
        count[str(found.verdict)] += 1
    assert min(count.values()) > 5, count


KINDS = {
    "sweep": lambda rng: chasles.SweepMotion.between(pose(rng, 2), pose(rng, 2), centre=rng.uniform(-1, 1, 3)),
    "sweep of two": lambda rng: chasles.SweepMotion.relative(*(pose(rng, 2) for _ in range(4))),
    "screw of two": lambda rng: chasles.ScrewMotion.relative(*(pose(rng, 2) for _ in range(4))),
    "velocity": lambda rng: chasles.ConstantVelocity.between(pose(rng, 2), pose(rng, 2), centre=rng.uniform(-1, 1, 3)),
    "twist": lambda rng: chasles.ConstantTwist.between(pose(rng, 2), pose(rng, 2)),
    "track": lambda rng: chasles.TimedPoses.through([0, 1, 3], [pose(rng, 2) for _ in range(3)]),
    "of two": lambda rng: chasles.relative(KINDS["velocity"](rng), KINDS["twist"](rng)),
    "joints": lambda rng: (
        chasles.Motion.at_rest(pose(rng, 1))
        * chasles.Motion.hinge(rng.uniform(-1, 1, 3), rng.normal(size=3), [0.25, 1.5])
        * chasles.Motion.slider(rng.normal(size=3), [0, -0.75])
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_motion_is_verified_by_both(kind, tmp_path):
    rng = np.random.default_rng(50)
    verdicts = set()
    for _ in range(16):
        files, bodies = pair(rng, tmp_path)
        motion = KINDS[kind](rng)
        found = chasles.first_contact(*bodies, motion=motion, margin=rng.uniform(0, 0.2))
        text = found.certificate()
        status, answer = checked(*files, text, tmp_path)
        assert status == 0, answer
        assert str(found.verdict).removeprefix("contact_at_") in chasles.verify(*bodies, motion, text)
        verdicts.add(str(found.verdict))
    assert len(verdicts) > 1


@pytest.mark.parametrize("motion", ["screw", "sweep", "velocity", "twist"])
def test_paths_are_verified_by_both(motion, tmp_path):
    rng = np.random.default_rng(51)
    segments = set()
    for _ in range(12):
        files, bodies = pair(rng, tmp_path)
        poses = np.array([pose(rng, 3) for _ in range(4)])
        found = chasles.first_contact_on_path(*bodies, poses, motion=motion)
        text = found.certificate()
        status, answer = checked(*files, text, tmp_path)
        assert status == 0, answer
        between = {"screw": chasles.ScrewMotion, "sweep": chasles.SweepMotion}.get(motion)
        between = between or {"velocity": chasles.ConstantVelocity, "twist": chasles.ConstantTwist}[motion]
        path = [between.between(*ends) for ends in zip(poses[:-1], poses[1:], strict=True)]
        assert str(found.verdict).removeprefix("contact_at_") in chasles.verify(*bodies, path, text)
        with pytest.raises(chasles.InvalidInput, match="about another motion"):
            chasles.verify(*bodies, path[:-1], text)
        segments.add((found.segment, str(found.verdict)))
    assert len(segments) > 2


def test_both_checkers_agree_on_what_is_altered(tmp_path):
    rng = np.random.default_rng(49)
    files, bodies = pair(rng, tmp_path)
    motion = chasles.ScrewMotion.between([3, 0.1, 0.2, 1, 0, 0, 0], [0.3, 0, 0, 0.9, 0.1, 0.3, 0])
    text = chasles.first_contact(*bodies, motion=motion).certificate()
    accepted = 0
    for _ in range(400):
        at = rng.integers(text.index("solid"), len(text))
        altered = text[:at] + rng.choice(list("0123456789-PTAB \n")) + text[at + 1 :]
        status, answer = checked(*files, altered, tmp_path)
        try:
            chasles.verify(*bodies, motion, altered)
            holds = True
        except chasles.InvalidInput as refusal:
            holds = "another motion" in str(refusal) and status == 0  # a pose that changed within what is still clear
        assert holds == (status == 0), answer
        accepted += holds
    assert 0 < accepted < 200


def test_what_is_about_something_else_is_refused(tmp_path):
    rng = np.random.default_rng(48)
    bodies = [chasles.Polyhedron(*block(rng)) for _ in range(2)]
    motion = chasles.ScrewMotion.between([5, 0, 0, 1, 0, 0, 0], [3, 0, 0, 1, 0, 0, 0])
    text = chasles.first_contact(*bodies, motion=motion).certificate()
    assert "clear" in chasles.verify(*bodies, motion, text)
    with pytest.raises(chasles.InvalidInput, match="about another motion"):
        chasles.verify(*bodies, chasles.ScrewMotion.between([5, 0, 0, 1, 0, 0, 0], [2, 0, 0, 1, 0, 0, 0]), text)
    with pytest.raises(chasles.InvalidInput, match="not verified: .*hash"):
        chasles.verify(*bodies[::-1], motion, text)
    with pytest.raises(chasles.InvalidInput, match="not verified: "):
        chasles.verify(*bodies, motion, text.replace("P", "?", 1))
    with pytest.raises(chasles.InvalidInput, match="certificate: the motion is none of those that are certified"):
        chasles.first_contact(*bodies, motion=chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 0, 1])).certificate()
    with pytest.raises(chasles.InvalidInput, match="answers with `hold` are not certified"):
        chasles.first_contact(*bodies, motion=motion, margin=1, hold=0.5).certificate()
    with pytest.raises(chasles.InvalidInput, match="swapped"):
        chasles.first_contact(*bodies, motion=motion).swapped().certificate()


def test_a_limit_ends_it():
    """No certificate of an answer that is not there yet: two sheets of triangles slide past each other at a small gap."""
    steps = np.linspace(0, 1, 81)
    vertices = np.array([[x, y, 0] for x in steps for y in steps])
    corners = [81 * i + j for i in range(80) for j in range(80)]
    faces = [f for c in corners for f in ((c, c + 81, c + 82), (c, c + 82, c + 1))]
    sheet = chasles.Polyhedron(vertices, np.array(faces, np.uint32))
    found = chasles.first_contact(sheet, sheet, [0, 0.1, 1e-6, 1, 0, 0, 0], [0.4, 0.1, 1e-6, 0.92, 0, 0, 0.39])
    with chasles.Limit(1e-9), pytest.raises(chasles.Cancelled):
        found.certificate()


def test_what_is_missing_is_said():
    """A face that is not convex is no witness."""
    corner = chasles.Polyhedron([[0, 0, 0], [4, 0, 0], [4, 1, 0], [1, 1, 0], [1, 4, 0], [0, 4, 0]], [[0, 1, 2, 3, 4, 5]])
    tip = chasles.Polyhedron([[0, 0, 0], [0.1, 0, 1], [0, 0.1, 1]], [[0, 1, 2]])
    found = chasles.first_contact(tip, corner, [2, 0.5, 1, 1, 0, 0, 0], [2, 0.5, -0.5, 1, 0, 0, 0])
    with pytest.raises(chasles.InvalidInput, match="certificate: not proven: the contact: no edge"):
        found.certificate()
