"""The command `chasles-cad`: its options, its streams, and its exit status."""

import json
import subprocess
import sys

import pytest

import chasles

pytest.importorskip("OCP")
import cad_shapes as cs  # noqa: E402
import chasles.cad  # noqa: E402
from chasles import program  # noqa: E402
from chasles.cad_command import main  # noqa: E402

MODEL = """
import ctypes, os, sys
sys.path.insert(0, {folder!r})
import cad_shapes as cs
print("printed")
os.write(1, b"written\\n")
ctypes.CDLL(None).puts(b"put by C")
os.system("echo a child")
assembly = cs.assembly(**{shapes})
"""
SHAPES = "{'shaft:1': cs.box(2, 2, 2), 'hub:1': cs.box(2, 2, 2, (1, 0, 0)), 'a': cs.box(1, 1, 1, (9, 0, 0))}"


@pytest.fixture
def model(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(MODEL.format(folder=cs.__file__.rpartition("/")[0], shapes=SHAPES))
    return path


def run(*words, **options):
    return subprocess.run(
        [sys.executable, "-m", "chasles.cad_command", *map(str, words)], capture_output=True, text=True, **options
    )


def test_standard_output_has_the_answer_alone(model, tmp_path):
    found = run(model, "--json", cwd=tmp_path)
    assert json.loads(found.stdout)["verdict"] == "contact" and found.returncode == 1
    for line in ("printed", "written", "put by C", "a child"):
        assert line in found.stderr.splitlines()
    closed = subprocess.run(
        f"'{sys.executable}' -m chasles.cad_command '{model}' --json 2>&-",
        shell=True,
        capture_output=True,
        text=True,
        check=False,
    )
    assert json.loads(closed.stdout)["verdict"] == "contact"


@pytest.mark.parametrize(
    "text, intended",
    [
        ("shaft:1:hub:1", ["shaft:1", "hub:1"]),
        ("hub:1:shaft:1", ["shaft:1", "hub:1"]),
        ("shaft?1:hub*", ["shaft:1", "hub:1"]),
        ("a:hub:1", ["hub:1", "a"]),
        ("s*:1:hub:1", ["shaft:1", "hub:1"]),
    ],
)
def test_names_with_colons(model, capsys, text, intended):
    main([str(model), "--json", "--intended", text])
    assert json.loads(capsys.readouterr().out)["intended"] == [intended]


@pytest.mark.parametrize(
    "text, message",
    [
        ("shaft:2:hub:1", "--intended shaft:2:hub:1: none of its colons has names of parts at both sides; write ? for a colon"),
        ("*:*:*", "2 of its colons have names of parts at both sides; write ? for a colon"),
        ("shaft", "--intended shaft: two names with a colon between them are needed"),
        ("shaft:hub", "--intended: 'shaft' is no part; the parts are shaft:1, hub:1, a"),
    ],
)
def test_what_names_no_pair_is_refused(model, capsys, text, message):
    assert main([str(model), "--intended", text]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    "option, value",
    [
        ("--allowed-overlap", "-1.0"),
        ("--tolerance", "3.0"),
        ("--seconds", "0.0"),
        ("--least-seconds", "nan"),
        ("--angle", "5.0"),
        ("--deflection", "-2.0"),
    ],
)
def test_errors_name_the_option_and_its_value(model, tmp_path, capsys, option, value):
    step = tmp_path / "box.step"
    from test_cad_platforms import write_step

    write_step(step, [("a", (1, 0, 0), cs.box(1, 1, 1), cs.matrix())])
    assert main([str(step), option, value]) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"chasles: {option}: must be ") and error.endswith(f", not {value}\n")


@pytest.mark.parametrize(
    "fault", [AttributeError("no 'joints'"), AssertionError(), KeyError("x"), RuntimeError("OCCT"), MemoryError()]
)
def test_a_fault_of_the_program_is_no_contact(fault, monkeypatch, model, capsys):
    def check(*_, **__):
        raise fault

    monkeypatch.setattr(chasles.cad, "check", check)
    assert main([str(model)]) == program.WRONG_INPUT
    error = capsys.readouterr().err
    assert "chasles: not enough memory" in error or ("nothing is proven" in error and type(fault).__name__ in error)
