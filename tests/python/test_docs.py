"""The code of the documents runs with the printed results, and every public name is documented."""

import doctest
import inspect
import pathlib
import pydoc
import re

import numpy as np
import pytest
from conftest import ROOT

import chasles

PUBLIC = [name for name in chasles.__all__ if name != "__version__"]


def code_of(document: pathlib.Path) -> str:
    if not document.is_file():
        pytest.skip(f"{document.name} is not here: tests of a source distribution")
    return "\n".join(re.findall(r"^```python\n(.*?)^```", document.read_text("utf-8"), re.DOTALL | re.MULTILINE))


def gap(corners, others):
    """The widest gap of two unit cubes along the 15 directions that can separate them; negative if they overlap."""
    edges = [[cube[4] - cube[0], cube[2] - cube[0], cube[1] - cube[0]] for cube in (corners, others)]
    axes = [*edges[0], *edges[1], *(np.cross(a, b) for a in edges[0] for b in edges[1])]
    units = [axis / np.linalg.norm(axis) for axis in axes if np.linalg.norm(axis) > 1e-9]
    spans = [(corners @ axis, others @ axis) for axis in units]
    return max(max(a.min() - b.max(), b.min() - a.max()) for a, b in spans)


def test_the_quick_start_can_be_pasted(tmp_path, monkeypatch, capsys):
    """The printed times enclose the time at which the gap of both cubes closes, on the pieces that a query follows."""
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(compile(code_of(ROOT / "README.md"), "README.md", "exec"), names)
    (line,) = capsys.readouterr().out.splitlines()
    lower, upper, *point = map(float, re.findall(r"[-+.e\d]*\d\.?[-+.e\d]*", line))
    assert re.match(r"between \S+ and \S+, at \[.*\]$", line) and 0 < upper - lower <= 1e-12
    corners, pieces = names["vertices"], names["found"].motion.pieces()

    def gap_at(time):
        piece = min(int(time * len(pieces)), len(pieces) - 1)
        pose = pieces[piece].pose_at(time * len(pieces) - piece)
        return gap(corners @ pose[:3, :3].T + pose[:3, 3], corners)

    assert all(gap_at(time) > 0 for time in np.linspace(0, lower - 1e-9, 100)) and gap_at(upper + 1e-9) < 0
    assert point[:2] == [1, 1] and 0 < point[2] < 1  # on an edge of the cube at rest


@pytest.mark.parametrize("document", ["docs/python.md", "docs/guide/python.md"])
def test_the_guides_tell_the_truth(document, tmp_path, monkeypatch):
    pytest.importorskip("pyarrow")
    monkeypatch.chdir(tmp_path)
    code = code_of(ROOT / document)
    example = doctest.DocTestParser().get_doctest(code, {}, document, document, 0)
    assert len(example.examples) > 20
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)


def test_the_page_about_policies_tells_the_truth():
    """Without its section about LeRobot, which lerobot_steps.py runs."""
    code = code_of(ROOT / "docs" / "policy.md")
    plain = code[: code.index("from lerobot")].rpartition(">>> import math")[0]
    example = doctest.DocTestParser().get_doctest(plain, {}, "docs/policy.md", "docs/policy.md", 0)
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures and len(example.examples) > 15, "".join(failures)


@pytest.mark.parametrize("name", PUBLIC)
def test_every_name_is_documented(name):
    thing = getattr(chasles, name)
    if isinstance(thing, np.dtype):
        return
    assert thing.__doc__ and thing.__doc__.strip()
    for member, value in inspect.getmembers(thing) if inspect.isclass(thing) else []:
        if not member.startswith("_") and (isinstance(value, property) or callable(value)) and member not in dir(str):
            assert member in dir(BaseException) or value.__doc__, f"{name}.{member}"


def test_help_reads_well():
    text = pydoc.plain(pydoc.render_doc(chasles.first_contact))
    for part in (
        "When do two polyhedra first touch",
        "margin : float\n",
        "Returns\n",
        "InvalidInput",
        "'any': yes or no",
    ):
        assert part in text
    assert "::" not in text
    body = text.split("When do two", 1)[1]
    assert max(map(len, body.splitlines())) <= 110


@pytest.mark.parametrize(
    "function",
    [chasles.first_contact, chasles.first_contact_on_path, chasles.least_distance, chasles.Polyhedron.__init__],
)
def test_parameters_are_laid_out(function):
    parameters = re.search(r"----------\n(.*?)(\n\n|\Z)", inspect.cleandoc(function.__doc__), re.DOTALL)[1]
    for line in parameters.splitlines():
        assert line.startswith("    ") or re.match(r"[\w, ]+ : ", line), line


def test_stubs_are_shipped():
    folder = pathlib.Path(chasles.__file__).parent
    if not (folder / "_core.pyi").is_file():
        pytest.skip("run from a build folder, not installed")
    stubs = (folder / "_core.pyi").read_text("utf-8")
    compile(stubs, "_core.pyi", "exec")
    for name in ("class Polyhedron", "def first_contact(", "def least_distance(", "def verdict(self) -> chasles.enums.Verdict"):
        assert name in stubs
    assert (folder / "py.typed").is_file()
