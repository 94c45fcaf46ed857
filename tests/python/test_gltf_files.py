"""Files of glTF with animations: all ways to store numbers, and one clear error for what is damaged or not supported."""

import base64
import copy
import json
import random

import chasles
import chasles.gltf
import numpy as np
import pytest

pytest.importorskip("scipy")
from gltf_files import Maker, Rotation, random_scene  # noqa: E402


@pytest.fixture
def file(tmp_path):
    return tmp_path / "scene.glb"


def falling():
    """A box that falls on a floor after 1.25 s, and turns."""
    maker = Maker()
    mesh = maker.mesh()
    maker.node("floor", mesh=mesh, scale=[8, 1, 8], translation=[0, -0.5, 0])
    box = maker.node("box", mesh=mesh)
    maker.animate(box, "translation", [0, 2], [[0, 3, 0], [0, -1, 0]])
    maker.animate(box, "rotation", [0, 1, 2], [[0, 0, 0, 1], [0, 1, 0, 0], [0, 0, 0, -1]])
    return maker


def time_of(path, **options):
    return chasles.gltf.read(path, **options).first_contact().time


def test_buffers_are_in_the_file_beside_it_or_embedded(file, tmp_path):
    maker = falling()
    times = [time_of(maker.write(file))]
    for name, uri in [
        ("beside.gltf", "a%20b.bin"),
        ("embedded.gltf", "data:application/octet-stream;base64," + base64.b64encode(maker.binary).decode()),
    ]:
        (tmp_path / "a b.bin").write_bytes(maker.binary)
        buffers = [{"byteLength": len(maker.binary), "uri": uri}]
        (tmp_path / name).write_text(json.dumps(maker.json | {"buffers": buffers}), "utf-8")
        times.append(time_of(tmp_path / name))
    assert times[0] == times[1] == times[2] == pytest.approx(1.25, abs=1e-9)


def test_several_buffers_become_one(tmp_path):
    maker = falling()
    cut = maker.json["bufferViews"][2]["byteOffset"]
    for view in maker.json["bufferViews"][2:]:
        view |= {"buffer": 1, "byteOffset": view["byteOffset"] - cut}
    parts = maker.binary[:cut], maker.binary[cut:]
    uris = ["data:;base64," + base64.b64encode(part).decode() for part in parts]
    maker.json["buffers"] = [{"byteLength": len(part), "uri": uri} for part, uri in zip(parts, uris)]
    (tmp_path / "two.gltf").write_text(json.dumps(maker.json), "utf-8")
    assert time_of(tmp_path / "two.gltf") == pytest.approx(1.25, abs=1e-9)
    found = chasles.gltf.read(tmp_path / "two.gltf").first_contact()
    assert (
        time_of(
            chasles.gltf.mark(tmp_path / "two.gltf", found, tmp_path / "one.glb"),
            leave_out=["contact box on floor at 1.25 s"],
        )
        == found.time
    )


def test_normalized_integers_and_sparse_values(file):
    maker = falling()
    turns = maker.json["accessors"][5]
    assert turns["type"] == "VEC4"
    short = maker.accessor([[0, 0, 0, 32767], [0, 32767, 0, 0], [0, 0, 0, -32767]], 5122, normalized=True)
    maker.json["animations"][0]["samplers"][1]["output"] = short
    places = maker.json["animations"][0]["samplers"][0]["output"]
    item = maker.json["accessors"][places]
    indices, values = maker.accessor([1], 5125), maker.accessor([[0, -5, 0]])
    item["sparse"] = {
        "count": 1,
        "indices": {"bufferView": maker.json["accessors"][indices]["bufferView"], "componentType": 5125},
        "values": {"bufferView": maker.json["accessors"][values]["bufferView"]},
    }
    animation = chasles.gltf.read(maker.write(file))
    assert animation.first_contact().time == pytest.approx(0.625, abs=1e-9)
    np.testing.assert_allclose(animation.poses(1)["box"][:3, :3], np.diag([-1, 1, -1]), atol=1e-15)


def test_a_scale_that_stays_is_no_animation(file):
    maker = falling()
    maker.animate(1, "scale", [0, 1, 2], [[1, 2, 1]] * 3)
    assert time_of(maker.write(file)) == pytest.approx(1, abs=1e-9)


def test_a_scale_that_hardly_changes_is_a_warning(file):
    """Exporters sample scales in single precision."""
    maker = falling()
    still = [[0, 0, 0], [1, 1.0000001, 1], [1e-7, 0, 0]]
    maker.animate(1, "scale", [0, 2], still + still, "CUBICSPLINE")
    animation = chasles.gltf.read(maker.write(file))
    assert animation.first_contact().time == pytest.approx(1.25, abs=1e-6)
    assert any("is taken as constant" in text for text in animation.warnings)
    maker = falling()
    maker.animate(1, "scale", [0, 2], [[0, 0, 0], [1, 1, 1], [1, 0, 0]] * 2, "CUBICSPLINE")
    with pytest.raises(chasles.InvalidInput, match="its scale is animated"):
        chasles.gltf.read(maker.write(file))


def test_a_matrix_in_single_precision_above_a_node_that_moves(file):
    maker = falling()
    turn = np.eye(4)
    turn[:3, :3] = -2 * Rotation.from_rotvec([0.3, -0.4, 0.5]).as_matrix()  # a mirror, too
    matrix = turn.astype(np.float32).astype(float).T.ravel()
    maker.json["nodes"].append({"name": "hall", "matrix": matrix.tolist(), "children": [0, 1]})
    maker.json["scenes"][0]["nodes"] = [2]
    animation = chasles.gltf.read(maker.write(file))
    assert animation.first_contact().time == pytest.approx(1.25, abs=1e-6)
    assert any("scales evenly but for" in text for text in animation.warnings)


def test_bodies_with_a_radius(file):
    assert time_of(falling().write(file), radius=0.25) == pytest.approx(1, abs=1e-9)
    assert time_of(file, radius=-0.05) == pytest.approx(1.3, abs=1e-9)


def test_without_scenes_all_roots_are_read(file):
    maker = falling()
    del maker.json["scenes"], maker.json["scene"]
    assert time_of(maker.write(file)) == pytest.approx(1.25, abs=1e-9)


def skinned(maker):
    maker.json["nodes"][1]["skin"] = maker.add("skins", {"joints": [1]})


def under_a_squeeze(maker):
    maker.json["nodes"].append({"name": "press", "scale": [1, 2, 1], "children": [1]})
    maker.json["scenes"][0]["nodes"] = [0, 2]


def with_matrix(maker):
    maker.json["nodes"][1]["matrix"] = np.eye(4).ravel().tolist()


def pointed(maker):
    pointer = {"extensions": {"KHR_animation_pointer": {"pointer": "/nodes/1/rotation"}}, "path": "pointer"}
    maker.json["animations"][0]["channels"][0]["target"] = pointer


def sampler(**change):
    return lambda maker: maker.json["animations"][0]["samplers"][0].update(change)


def channel(**change):
    return lambda maker: maker.json["animations"][0]["channels"][0]["target"].update(change)


def keys(stamps):
    def change(maker):
        maker.json["animations"][0]["samplers"][0]["input"] = maker.accessor(np.array(stamps, float))

    return change


REFUSED = {
    "node 'box' has a skin": skinned,
    "node 'box' is morphed": lambda maker: maker.animate(1, "weights", [0, 1], [0, 1]),
    "node 1 ('box'): its scale is animated (from 1 to 2)": lambda maker: maker.animate(
        1, "scale", [0, 1], [[1, 1, 1], [1, 2, 1]]
    ),
    "node 1 ('box') turns below a scale that is not the same": under_a_squeeze,
    "node 1 has a matrix": with_matrix,
    "animates '/nodes/1/rotation'": pointed,
    "the translation of node 1 is animated twice": lambda maker: maker.animate(
        1, "translation", [0, 1], [[0, 0, 0]] * 2
    ),
    "'BEZIER' is none of LINEAR": sampler(interpolation="BEZIER"),
    "2 times and 2 values; it needs 3": sampler(interpolation="CUBICSPLINE"),
    "there is no accessor 99": sampler(input=99),
    "type: must be SCALAR, not VEC3": sampler(input=3),
    "there is no node 7": channel(node=7),
    "'colour' is none of": channel(path="colour"),
    "time 1: must be from 0 on and increase, but is 0": keys([0, 0]),
    "time 0: must be from 0 on and increase, but is -1": keys([-1, 2]),
    "NaN, infinity": keys([0, np.inf]),
    "rotation 0: is no unit quaternion": lambda maker: maker.animate(0, "rotation", [0, 1], [[0, 0, 0, 0]] * 2),
    "node 1 ('box') is below two nodes, or contains itself": lambda maker: maker.json["nodes"][1].update(children=[1]),
    "announces 5 elements, which are more": lambda maker: maker.json["accessors"][3].update(count=5),
    "ends behind the end of its buffer": lambda maker: maker.json["bufferViews"][3].update(byteLength=9999),
    "componentType: 5129 is none": lambda maker: maker.json["accessors"][3].update(componentType=5129),
    "is glTF 1.0": lambda maker: maker.json["asset"].update(version="1.0"),
    "has no animation": lambda maker: maker.json.pop("animations"),
    "has no duration": keys([0]),
    "needs the extension 'KHR_draco_mesh_compression'": lambda maker: maker.json.update(
        extensionsRequired=["KHR_draco_mesh_compression"]
    ),
}


@pytest.mark.parametrize("why", REFUSED)
def test_is_refused_by_name(file, why):
    maker = falling()
    if why == "has no duration":
        maker.json["animations"][0] = {"samplers": [], "channels": []}
        maker.animate(1, "translation", [0], [[0, 0, 0]])
    else:
        REFUSED[why](maker)
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.gltf.read(maker.write(file))
    text = str(error.value)
    assert why in text and text.startswith(str(file)) and "\n" not in text


def test_large_numbers_and_deep_trees(file, tmp_path):
    maker = falling()
    (tmp_path / "half.bin").write_bytes(maker.binary)
    buffers = [{"byteLength": len(maker.binary), "uri": "half.bin"}, {"byteLength": 2**31, "uri": "half.bin"}]
    (tmp_path / "large.gltf").write_text(json.dumps(maker.json | {"buffers": buffers}), "utf-8")
    with pytest.raises(chasles.InvalidInput, match="at most 2147483648 are read"):
        chasles.gltf.read(tmp_path / "large.gltf")
    maker = falling()
    maker.json["nodes"][0]["translation"] = [10**400, 0, 0]
    with pytest.raises(chasles.InvalidInput, match="translation: must be 3 numbers below"):
        chasles.gltf.read(maker.write(file))
    maker = falling()
    below = 1
    for _ in range(1001):
        below = maker.node(None, below)
    with pytest.raises(chasles.InvalidInput, match="more than 1000 nodes above it"):
        chasles.gltf.read(maker.write(file))


def test_what_deforms_can_be_left_out(file):
    maker = falling()
    skinned(maker)
    animation = chasles.gltf.read(maker.write(file), leave_out=["box"])
    assert list(animation.bodies) == ["floor"] and "no pair is tested" in str(animation.first_contact())
    with pytest.raises(
        chasles.InvalidInput, match="leave_out: no node with faces has the name 'dog'; there are 'box', 'floor'"
    ):
        chasles.gltf.read(file, leave_out=["dog"])


def test_what_moves_nothing_is_a_warning(file):
    maker = falling()
    found = maker.json["animations"][0]
    pointer = {"extensions": {"KHR_animation_pointer": {"pointer": "/materials/0/emissiveFactor"}}, "path": "pointer"}
    found["channels"] += [{"sampler": 0, "target": pointer}, {"sampler": 0, "target": {"path": "translation"}}]
    maker.json["extensionsRequired"] = ["KHR_animation_pointer"]
    animation = chasles.gltf.read(maker.write(file))
    assert any("/materials/0" in text for text in animation.warnings) and any(
        "names no node" in text for text in animation.warnings
    )
    assert any("half turn" in text for text in animation.warnings)
    assert animation.first_contact().time == pytest.approx(1.25, abs=1e-9)


def test_what_moves_outside_of_the_scene_is_a_warning(file):
    maker = falling()
    for number in range(12):
        maker.animate(
            maker.add("nodes", {"name": f"lost {number}", "mesh": 0}), "translation", [0, 2], [[0, 3, 0], [0, -1, 0]]
        )
    maker.animate(maker.add("nodes", {"mesh": 0}), "weights", [0, 1], [0, 1])
    animation = chasles.gltf.read(maker.write(file))
    (text,) = (text for text in animation.warnings if "half turn" not in text)
    assert text.startswith(
        "animated, but outside of the scene, and ignored: node 2 ('lost 0'), node 3 ('lost 1'), node 4"
    )
    assert text.endswith("node 11 ('lost 9'), ...") and list(animation.bodies) == ["floor", "box"]
    maker.json["scenes"][0]["nodes"] += range(2, 14)
    assert "animated, but outside of the scene, and ignored: node 14" in chasles.gltf.read(maker.write(file)).warnings


def test_the_version_of_a_glb_is_tested_first(file):
    """The first version has its length elsewhere, and is often cut, too."""
    for data in (b"glTF\1\0\0\0", b"glTF\1\0\0\0" + b"\xff" * 12, b"glTF\1\0\0\0" + b"\xff" * 8):
        file.write_bytes(data)
        with pytest.raises(chasles.InvalidInput, match="is GLB of version 1; only version 2 is read"):
            chasles.gltf.read(file)


@pytest.mark.parametrize(
    "data", [b"", b"{", b"[]", b"glTF", b"glTF" + b"\0" * 30, b"version https://git-lfs", b"\xff\xfe" * 9, b"[" * 99999]
)
def test_what_is_no_gltf(file, data):
    file.write_bytes(data)
    with pytest.raises(chasles.InvalidInput, match="scene.glb: "):
        chasles.gltf.read(file)


def test_cut_files(file, tmp_path):
    data = falling().bytes()
    for length in [*range(0, len(data), 61), len(data) - 1]:
        file.write_bytes(data[:length])
        with pytest.raises(chasles.InvalidInput):
            chasles.gltf.read(file)
    with pytest.raises(chasles.InvalidInput, match="No such file"):
        chasles.gltf.read(tmp_path / "none.glb")
    with pytest.raises(chasles.InvalidInput, match="cannot read"):
        chasles.gltf.read(tmp_path)


JUNK = [
    None,
    -1,
    0,
    2,
    7,
    1e300,
    -0.5,
    2**53,
    "x",
    "",
    [],
    {},
    [0],
    {"a": 1},
    True,
    [1, 2, 3],
    [0, 0, 0, 0],
    "STEP",
    "CUBICSPLINE",
]


def places_in(item, path=()):
    for key in item if isinstance(item, dict) else range(len(item)) if isinstance(item, list) else ():
        yield (*path, key)
        yield from places_in(item[key], (*path, key))


def test_damaged_json_gets_one_clear_error(file, tmp_path):
    """Whatever is wrong is an InvalidInput of one line, and whatever is not can be asked about and marked."""
    chance, refused = random.Random(5), 0
    for number in range(160):
        maker = random_scene(
            np.random.default_rng(number % 5), bodies=2, kinds=[["LINEAR"], ["STEP"], ["CUBICSPLINE"]][number % 3]
        )
        if number % 2:  # what `mark` made
            marker = maker.node("marker", mesh=0, extras={"chasles": {"pair": ["a", "b"]}})
            maker.animate(marker, "scale", [0, 1], [[0, 0, 0], [1, 1, 1]], "STEP")
        path = chance.choice(list(places_in(maker.json)))
        item = maker.json
        for key in path[:-1]:
            item = item[key]
        item[path[-1]] = copy.deepcopy(chance.choice(JUNK))
        try:
            with chasles.Limit(0.5):
                found = chasles.gltf.read(maker.write(file)).first_contact()
            chasles.gltf.mark(file, found, tmp_path / "marked.glb")
        except chasles.InvalidInput as error:
            refused += 1
            assert "\n" not in str(error) and len(str(error)) < 600
    assert 80 < refused < 158
