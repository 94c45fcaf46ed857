"""The code of the index page, platform by platform, as far as they are installed."""

import base64
import doctest
import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import ROOT

PAGE = ROOT / "docs" / "where-you-work.md"
PACKAGES = {
    "CAD": ["build123d", "chasles.cad"],
    "Policies": [],
    "MuJoCo": ["mujoco", "scipy"],
    "Animations": ["chasles.gltf"],
    "ROS": [],
    "Drake": ["pydrake.all"],
    "Pinocchio": ["pinocchio"],
}


def sections() -> dict[str, str]:
    text = PAGE.read_text("utf-8") if PAGE.is_file() else ""  # a source distribution has no documents
    parts = (part.split("\n", 1) for part in text.split("\n## ")[1:])
    return {name: "\n".join(re.findall(r"^```python\n(.*?)^```", code, re.DOTALL | re.MULTILINE)) for name, code in parts}


def write_animation(file):
    """A box that falls on a floor; its places after 0 and 2 s."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "<f4") / 2
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([[s[0], s[i], s[i + 1]] for s in sides for i in (1, 2)], "<u4").ravel()
    arrays = [corners, triangles, np.array([0, 2], "<f4"), np.array([[0, 3, 0], [0, -1, 0]], "<f4")]
    kinds = [("VEC3", 5126), ("SCALAR", 5125), ("SCALAR", 5126), ("VEC3", 5126)]
    data = [base64.b64encode(array).decode() for array in arrays]
    animation = {
        "samplers": [{"input": 2, "output": 3}],
        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
    }
    content = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": "floor", "mesh": 0, "translation": [0, -0.5, 0]}, {"name": "box", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "animations": [animation],
        "accessors": [
            {"bufferView": i, "type": t, "componentType": c, "count": len(arrays[i])} for i, (t, c) in enumerate(kinds)
        ],
        "bufferViews": [{"buffer": i, "byteLength": array.nbytes} for i, array in enumerate(arrays)],
        "buffers": [
            {"byteLength": array.nbytes, "uri": f"data:application/octet-stream;base64,{text}"}
            for array, text in zip(arrays, data, strict=True)
        ],
    }
    file.write_text(json.dumps(content))


@pytest.mark.parametrize("name", PACKAGES)
def test_the_code_of_a_platform(name, monkeypatch, tmp_path):
    if not PAGE.is_file():
        pytest.skip("the page is not here: tests of a source distribution")
    for package in PACKAGES[name]:
        pytest.importorskip(package)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    write_animation(tmp_path / "fall.gltf")
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(sections()[name], {}, name, str(PAGE), 0)
    assert 5 <= len(example.examples) <= 12
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)


def test_each_platform_is_on_the_page():
    if PAGE.is_file():
        assert list(sections()) == list(PACKAGES)


def test_package_xml_has_the_version_of_the_project():
    """And is valid, as far as the parser of ROS says, where that is installed."""
    file = ROOT / "package.xml"
    if not file.is_file():
        pytest.skip("package.xml is not here: tests of a source distribution")
    package = ElementTree.parse(file).getroot()
    version = re.search(r"^  VERSION ([0-9.]+)$", (ROOT / "CMakeLists.txt").read_text("utf-8"), re.MULTILINE)[1]
    assert (package.get("format"), package.findtext("name"), package.findtext("version")) == ("3", "chasles", version)
    assert package.findtext("export/build_type") == "cmake"
    pytest.importorskip("catkin_pkg.package").parse_package(str(file)).validate()
