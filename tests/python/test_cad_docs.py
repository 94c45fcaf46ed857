"""The code of docs/cad.md runs with the printed results."""

import doctest

import pytest
from conftest import ROOT
from test_docs import code_of

pytest.importorskip("build123d")
pytest.importorskip("OCP")


def test_the_page_about_cad_tells_the_truth(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(code_of(ROOT / "docs" / "cad.md"), {}, "docs/cad.md", "docs/cad.md", 0)
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures and len(example.examples) > 15, "".join(failures)
