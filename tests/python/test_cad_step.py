"""STEP files whose parts are in files of their own, whose parts are empty, and whose instances have no names."""

import os
import re

import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_shapes as cs  # noqa: E402
from chasles.cad_command import main  # noqa: E402
from test_cad_platforms import write_step  # noqa: E402

SHAPES = [("base", (1, 0, 0), cs.box(10, 10, 10), cs.matrix()), ("lid", (1, 0, 0), cs.box(5, 5, 5), cs.matrix((20, 0, 0)))]


@pytest.fixture
def external(tmp_path):
    """An assembly whose parts are in two files beside it."""
    write_step(tmp_path / "whole.step", SHAPES, external="part_")
    files = sorted(set(os.listdir(tmp_path)) - {"whole.step"})
    assert len(files) == 2 and not (tmp_path / "whole.step").read_text().count("ADVANCED_BREP")
    return tmp_path / "whole.step", files


def test_external_parts_are_read_from_any_folder(external, monkeypatch, tmp_path):
    path, _ = external
    for folder, name in ((tmp_path.parent, path), (tmp_path, "whole.step"), (tmp_path.parent, f"{tmp_path.name}/whole.step")):
        monkeypatch.chdir(folder)
        assembly = chasles.cad.load(name)
        assert len(assembly.parts) == 2 and not assembly.warnings
        least = chasles.cad.check(assembly).least
        assert least.lower <= 10 <= least.upper


def test_parts_in_files_that_are_not_there_are_named(external, capsys):
    path, files = external
    (path.parent / files[0]).unlink()
    with pytest.raises(chasles.InvalidInput, match=rf"whole.step: has parts in files that are not there: {files[0]}; put them"):
        chasles.cad.load(path)
    assert main([str(path)]) == 2 and files[0] in capsys.readouterr().err
    assert main([str(path), "--skip-empty"]) == 0 and "is empty, and is left out" in capsys.readouterr().out
    (path.parent / files[1]).unlink()
    with pytest.raises(chasles.InvalidInput, match=f"{files[0]}, {files[1]}; put them"):
        chasles.cad.load(path)
    with pytest.raises(chasles.InvalidInput, match="whole.step: has no parts: nothing in it has faces"):
        chasles.cad.load(path, skip_empty=True)


def test_files_that_external_files_name_are_looked_for(tmp_path):
    """An assembly of an assembly: the file of a part of a part is missing, and its name has an apostrophe."""
    write_step(tmp_path / "whole.step", SHAPES, external="part_")
    first, second = sorted(set(os.listdir(tmp_path)) - {"whole.step"})
    text = (tmp_path / first).read_text()
    emptied = re.sub(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('',\((#\d+),#\d+\)", r"SHAPE_REPRESENTATION('',(\1)", text)
    assert emptied != text
    (tmp_path / first).write_text(
        emptied.replace("ENDSEC;\nEND-ISO", "#9999=DOCUMENT_FILE('bob''s.stp','','',$,'',$);\nENDSEC;\nEND-ISO")
    )
    with pytest.raises(chasles.InvalidInput, match="not there: bob's.stp; put them"):
        chasles.cad.load(tmp_path / "whole.step")
    (tmp_path / "bob's.stp").write_text("")
    with pytest.raises(chasles.InvalidInput, match="is empty: its shape is not there"):
        chasles.cad.load(tmp_path / "whole.step")


def test_an_empty_part_is_refused_or_left_out(tmp_path):
    path = tmp_path / "whole.step"
    write_step(path, SHAPES)
    text = path.read_text()
    path.write_text(
        re.sub(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('',\((#\d+),#\d+\)", r"SHAPE_REPRESENTATION('',(\1)", text, count=1)
    )
    with pytest.raises(chasles.InvalidInput, match="base here: is empty: its shape is not there"):
        chasles.cad.load(path)
    assembly = chasles.cad.load(path, skip_empty=True)
    assert list(assembly.parts) == ["lid here"] and assembly.warnings == ["base here: is empty, and is left out"]


def test_instances_without_names_have_those_of_their_parts(tmp_path):
    path = tmp_path / "whole.step"
    write_step(path, SHAPES)
    named = path.read_text()
    path.write_text(re.sub(r"(OCCURRENCE\('[^']*',)'[^']*'", r"\1''", named))
    assert list(chasles.cad.load(path).parts) == ["base", "lid"]
    path.write_text(re.sub(r"(OCCURRENCE\()'[^']*','[^']*'", r"\1'7','7'", named, count=1))  # a name that is a number stays
    assert list(chasles.cad.load(path).parts) == ["7", "lid here"]
    path.write_text(re.sub(r"OCCURRENCE\('[^']*','lid here'", "OCCURRENCE('7',''", path.read_text()))  # it may be either's
    assert list(chasles.cad.load(path).parts) == ["7", "7_2"]
