"""Answers written back as GLB, read by trimesh and by hand, and the command line."""

import json
import os
import struct
import subprocess
import sys

import chasles
import chasles.gltf
import numpy as np
import pytest
from chasles.gltf_command import main

pytest.importorskip("scipy")
from gltf_files import Maker, Sampler  # noqa: E402
from test_gltf import jumper  # noqa: E402
from test_gltf_files import falling, skinned  # noqa: E402


@pytest.fixture
def file(tmp_path):
    return falling().write(tmp_path / "scene.glb")


def read_back(path):
    """A made file with the JSON and the bytes of a GLB."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    maker = Maker()
    maker.json = json.loads(data[20 : 20 + length])
    maker.binary = data[28 + length :]
    assert (
        struct.unpack_from("<4sII", data) == (b"glTF", 2, len(data))
        and len(maker.binary) == maker.json["buffers"][0]["byteLength"]
    )
    return maker


def test_a_marker_appears_at_the_time_of_the_contact(file, tmp_path):
    found = chasles.gltf.read(file).first_contact(find="first_with_all_contacts")
    before = file.read_bytes()
    out = chasles.gltf.mark(file, found, tmp_path / "marked.glb")
    maker = read_back(out)
    marks = [node for node in maker.json["nodes"] if "contact" in node["name"]]
    assert [mark["name"] for mark in marks][:2] == [
        "contact box on floor at 1.25 s",
        "contact box on floor at 1.25 s (2)",
    ]
    assert len(marks) == len(found.contacts) == 4 and len(maker.json["animations"]) == 1
    sampler = Sampler(maker)
    numbers = [maker.json["nodes"].index(mark) for mark in marks]
    assert all(np.all(sampler.world(1.249)[number][:3, :3] == 0) for number in numbers)
    for number, contact in zip(numbers, found.contacts):
        world = sampler.world(1.251)[number]
        np.testing.assert_allclose(world[:3, 3], contact.point, atol=1e-12)
        np.testing.assert_allclose(world[:3, 2], contact.normal, atol=1e-12)  # the arrow is along z
    extras = marks[0]["extras"]["chasles"]
    assert extras["pair"] == ["box", "floor"] and extras["time"] == found.time
    assert maker.json["asset"]["extras"]["chasles"][0]["verdict"] == "contact"
    assert file.read_bytes() == before and sorted(os.listdir(tmp_path)) == ["marked.glb", "scene.glb"]
    again = chasles.gltf.read(out, leave_out=[mark["name"] for mark in marks]).first_contact()
    assert again.time == found.time


def test_markers_are_no_bodies_and_a_second_answer_replaces_them(file, tmp_path, capsys):
    animation = chasles.gltf.read(file)
    marked = chasles.gltf.mark(file, animation.first_contact(find="first_with_all_contacts"), tmp_path / "marked.glb")
    again = chasles.gltf.read(marked)
    assert list(again.bodies) == list(animation.bodies) and again.duration == animation.duration
    (text,) = set(again.warnings) - set(animation.warnings)
    assert text.startswith(
        "left out, as markers of a former answer (chasles.gltf.mark): 'contact box on floor at 1.25 s', "
    )
    assert again.first_contact().as_json() | {"warnings": []} == animation.first_contact().as_json() | {"warnings": []}
    status, _, err = run(capsys, marked, "--margin", "1", "--mark", tmp_path / "second.glb")
    assert status == 1 and err.count("former answer") == 1
    second = read_back(tmp_path / "second.glb").json
    plain = read_back(chasles.gltf.mark(file, animation.first_contact(margin=1), tmp_path / "plain.glb")).json
    for part in (second["nodes"], plain["nodes"]):  # the meshes of former markers stay, so numbers differ
        del part[2]["mesh"]
    assert second["nodes"] == plain["nodes"] and second["scenes"] == plain["scenes"]
    channels = [[one["target"] for one in marks["animations"][0]["channels"]] for marks in (second, plain)]
    assert channels[0] == channels[1] and len(channels[0]) == 3
    clear = chasles.gltf.read(jumper(0, 6, 6).write(file)).first_contact()
    third = read_back(chasles.gltf.mark(marked, clear, tmp_path / "third.glb")).json
    assert len(third["nodes"]) == len(third["scenes"][0]["nodes"]) == 2 and len(third["animations"][0]["channels"]) == 2


def test_markers_between_other_nodes(file, tmp_path):
    """As after another program added a node: the numbers of nodes stay."""
    found = chasles.gltf.read(file).first_contact()
    maker = read_back(chasles.gltf.mark(file, found, tmp_path / "marked.glb"))
    maker.json["scenes"][0]["nodes"] = [0, 1]
    rack = maker.node("rack", children=[2])
    maker.animate(maker.node("late", mesh=0), "translation", [0, 2], [[9, 0, 0], [9, 3, 0]])
    again = chasles.gltf.read(maker.write(tmp_path / "edited.glb"))
    assert list(again.bodies) == ["floor", "box", "late"] and again.first_contact().time == found.time
    marked = read_back(chasles.gltf.mark(tmp_path / "edited.glb", again.first_contact(), tmp_path / "again.glb")).json
    assert marked["nodes"][2] == {} and marked["nodes"][rack] == {"name": "rack"}
    assert [node.get("name") for node in marked["nodes"][3:]] == ["rack", "late", "contact box on floor at 1.25 s"]
    assert [one["target"]["node"] for one in marked["animations"][0]["channels"]] == [1, 1, 4, 5]


def test_a_marker_makes_no_animation_longer(tmp_path):
    maker = falling()
    maker.animate(
        maker.node("door", mesh=0, translation=[9, 0, 0]), "translation", [0, 1], [[9, 0, 0], [9, 3, 0]], animation=1
    )
    maker.json["animations"].reverse()
    file = maker.write(tmp_path / "scene.glb")
    found = chasles.gltf.read(file, [0, 1]).first_contact()
    marked = chasles.gltf.mark(file, found, tmp_path / "marked.glb")
    assert found.time == pytest.approx(1.25, abs=1e-9) and chasles.gltf.read(marked, 0).duration == 1


@pytest.mark.parametrize("extras", [{"chasles": 1}, {"chasles": {}}, {"other": {"pair": []}}, "chasles"])
def test_other_extras_make_no_marker(extras, tmp_path):
    maker = falling()
    maker.json["nodes"][1]["extras"] = extras
    assert list(chasles.gltf.read(maker.write(tmp_path / "scene.glb")).bodies) == ["floor", "box"]


def test_trimesh_reads_what_was_marked(file, tmp_path):
    trimesh = pytest.importorskip("trimesh")
    found = chasles.gltf.read(file).all_contacts()
    scene = trimesh.load(chasles.gltf.mark(file, found, tmp_path / "marked.glb", size=2.5))
    (name,) = (name for name in scene.graph.nodes if str(name).startswith("contact"))
    matrix, geometry = scene.graph[name]
    np.testing.assert_allclose(matrix[:3, 3], found[0].contacts[0].point, atol=1e-6)
    mesh = scene.geometry[geometry]
    assert mesh.bounds[1][2] == pytest.approx(2.5) and mesh.volume > 0


def test_clear_answers_and_overlaps_are_written(file, tmp_path):
    clear = chasles.gltf.read(jumper(0, 6, 6).write(file)).first_contact()
    maker = read_back(chasles.gltf.mark(file, clear, tmp_path / "clear.glb"))
    assert len(maker.json["nodes"]) == 2 and maker.json["asset"]["extras"]["chasles"][0]["verdict"] == "clear"
    inside = chasles.gltf.read(jumper(0, 3.25, 3.25).write(file)).first_contact()
    maker = read_back(chasles.gltf.mark(file, inside, tmp_path / "inside.glb"))
    assert maker.json["nodes"][2]["name"] == "contact box on wall at 1 s"
    assert np.abs(np.array(maker.json["nodes"][2]["translation"]) - [3.25, 0, 0]).max() <= 0.75


def test_images_beside_the_file_stay_there(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "out").mkdir()
    maker = falling()
    maker.json["images"] = [
        {"uri": "a%20b.png"},
        {"uri": "data:image/png;base64,AA=="},
        {"bufferView": 0, "mimeType": "image/png"},
    ]
    file = maker.write(tmp_path / "in" / "scene.glb")
    found = chasles.gltf.read(file).first_contact()
    marked = read_back(chasles.gltf.mark(file, found, tmp_path / "out" / "marked.glb"))
    assert [image.get("uri") for image in marked.json["images"]] == [
        "../in/a%20b.png",
        "data:image/png;base64,AA==",
        None,
    ]


def test_no_input_is_written_over(file, tmp_path):
    found = chasles.gltf.read(file).first_contact()
    (tmp_path / "link.glb").symlink_to(file)
    for out, why in [
        (file, "is an input"),
        (tmp_path / "link.glb", "is an input"),
        (tmp_path / "marked.gltf", "must end in .glb"),
        (tmp_path / "none" / "marked.glb", "cannot be written"),
    ]:
        with pytest.raises(chasles.InvalidInput, match=why):
            chasles.gltf.mark(file, found, out)
    with pytest.raises(chasles.InvalidInput, match="another file"):
        chasles.gltf.mark(Maker().write(tmp_path / "empty.glb"), found, tmp_path / "marked.glb")
    assert "marked.glb" not in os.listdir(tmp_path) and not [name for name in os.listdir(tmp_path) if "part" in name]


def test_the_page_of_a_contact(file, tmp_path):
    animation = chasles.gltf.read(file)
    try:
        page = animation.view(animation.first_contact(), tmp_path / "page.html")
    except chasles.InvalidInput as error:
        pytest.skip(str(error))
    assert "box" in page.read_text("utf-8")


def run(capsys, *arguments):
    status = main([str(argument) for argument in arguments])
    text = capsys.readouterr()
    return status, text.out, text.err


def test_the_command_line(file, tmp_path, capsys):
    status, out, _ = run(capsys, file, "--json", "--mark", tmp_path / "marked.glb")
    answer = json.loads(out)
    assert (
        status == 1
        and answer["verdict"] == "contact"
        and answer["pair"] == ["box", "floor"]
        and (tmp_path / "marked.glb").exists()
    )
    assert (
        answer["time"] <= 1.25 <= answer["time_upper"] and answer["certain"] is True and answer["clear_until"] <= 1.25
    )
    assert answer["untested"] == {"tested": 1, "pairs": 0, "reasons": []} and answer["motion"]["kind"] == "linear"
    assert answer["contacts"][0]["kind"] in ("vertex_face", "edge_edge") and len(answer["pose"]) == 7
    status, out, err = run(capsys, file)
    assert (
        status == 1
        and out.startswith("CONTACT at 1.25 s of 2 s; animation 'take 0', linear\n  pair      box on floor\n")
        and "warning" in err
    )
    status, out, _ = run(capsys, file, "--all", "--all-contacts", "--margin", "0.5", "--json")
    events = json.loads(out)["events"]
    assert status == 1 and len(events) == 1 and len(events[0]["contacts"]) == 4
    status, out, _ = run(capsys, jumper(0, 6, 6).write(file))
    assert status == 0 and out.startswith("CLEAR: proven that no pair touches during the whole 2 s")
    assert run(capsys, file, "--json", "--ignore", "box", "wall")[0] == 0


def test_wrong_input_of_the_command_line(file, tmp_path, capsys):
    maker = falling()
    skinned(maker)
    for arguments, why in [
        ([tmp_path / "none.glb"], "No such file"),
        ([file, "--margin", "-1"], "margin"),
        ([file, "--animation", "walk"], "no animation 'walk'"),
        ([file, "--animation", "0", "--together"], "leave out"),
        ([file, "--seconds", "-1"], "positive"),
        ([maker.write(tmp_path / "skin.glb")], "skin"),
        ([file, "--mark", file], "is an input"),
        ([file, "--page", file], "is an input"),
    ]:
        status, out, err = run(capsys, *arguments)
        assert status == 2 and why in err and err.count("\n") == 1 and err.startswith("chasles: ") and not out, (
            arguments
        )
    for arguments in (["--nothing"], [], [str(file), "--margin", "x"], [str(file), "--marg", "1"]):
        with pytest.raises(SystemExit) as end:
            main(arguments)
        assert end.value.code == 2 and capsys.readouterr().err.startswith("chasles: animation: ")
    assert run(capsys, tmp_path / "skin.glb", "--leave-out", "box")[0] == 0
    status, out, _ = run(capsys, file, "--seconds", "1e-9", "--json")
    assert status == 3 and json.loads(out)["verdict"] == "unknown"


def test_the_module_is_a_program_and_the_package_does_not_import_it(file):
    done = subprocess.run(
        [sys.executable, "-m", "chasles.gltf_command", file, "--json"], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 1 and json.loads(done.stdout)["pair"] == ["box", "floor"]
    code = "import chasles, sys; sys.exit(any(name.startswith('chasles.gltf') for name in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0
