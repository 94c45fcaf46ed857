"""The code of the index page, platform by platform, as far as they are installed."""

import doctest
import re

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


@pytest.mark.parametrize("name", PACKAGES)
def test_the_code_of_a_platform(name, monkeypatch):
    if not PAGE.is_file():
        pytest.skip("the page is not here: tests of a source distribution")
    for package in PACKAGES[name]:
        pytest.importorskip(package)
    monkeypatch.chdir(ROOT)
    example = doctest.DocTestParser().get_doctest(sections()[name], {}, name, str(PAGE), 0)
    assert 5 <= len(example.examples) <= 12
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)


def test_each_platform_is_on_the_page():
    if PAGE.is_file():
        assert list(sections()) == list(PACKAGES)
