"""What `chasles-animation` and `chasles-cad` share: files may be pipes, which are read once, and long work shows signs of life."""

import json
import os
import subprocess
import sys
import threading
import time

import chasles
import chasles.gltf
import pytest
from chasles import program, read_file

pytest.importorskip("scipy")
from test_gltf_files import falling  # noqa: E402

has_pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")


def pipe_with(path, data):
    """A named pipe into which the bytes are written once."""
    os.mkfifo(path)
    threading.Thread(target=path.write_bytes, args=[data], daemon=True).start()
    return path


def asked(module, *arguments, **options):
    return subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True, timeout=100, **options)


@has_pipes
def test_an_animation_in_a_pipe_is_read_once(tmp_path):
    data = falling().bytes()
    (tmp_path / "scene.glb").write_bytes(data)
    more = ["--json", "--mark"]
    plain = asked("chasles.gltf_command", tmp_path / "scene.glb", *more, tmp_path / "plain.glb")
    assert json.loads(plain.stdout)["pair"] == ["box", "floor"]
    pipe = pipe_with(tmp_path / "pipe.glb", data)
    for number, (file, options) in enumerate([(pipe, {}), ("/dev/stdin", {"input": data})]):
        out = tmp_path / f"marked {number}.glb"
        done = asked("chasles.gltf_command", file, *more, out, **options)
        assert (done.returncode, done.stdout) == (1, plain.stdout), done.stderr
        assert out.read_bytes() == (tmp_path / "plain.glb").read_bytes()


@has_pipes
def test_a_step_file_in_a_pipe(tmp_path):
    build123d = pytest.importorskip("build123d")
    file = tmp_path / "box.step"
    build123d.export_step(build123d.Box(1, 2, 3), file)
    plain = asked("chasles.cad_command", file)
    for name, options in [
        (pipe_with(tmp_path / "pipe.step", file.read_bytes()), {}),
        ("/dev/stdin", {"input": file.read_bytes()}),
    ]:
        done = asked("chasles.cad_command", name, **options)
        assert done.returncode == plain.returncode == 0 and b"1 part" in done.stdout, done.stderr


@has_pipes
def test_input_that_need_not_end(tmp_path, monkeypatch):
    with pytest.raises(chasles.InvalidInput, match="/dev/null: is a device, which need not end; give a file or a pipe"):
        chasles.gltf.read("/dev/null")
    os.mkfifo(tmp_path / "silent.glb")
    monkeypatch.setattr(read_file, "LONGEST_WAIT", 0)
    with pytest.raises(
        chasles.InvalidInput, match="silent.glb: is a pipe into which nothing was written for 0 seconds"
    ):
        chasles.gltf.read(tmp_path / "silent.glb")
    monkeypatch.setattr(read_file, "LONGEST_WAIT", 30)
    monkeypatch.setattr(read_file, "MOST_FROM_PIPE", 1 << 20)
    whole = pipe_with(tmp_path / "whole", bytes(1 << 20))
    assert read_file.read_file(whole) == bytes(1 << 20)
    longer = pipe_with(tmp_path / "longer", bytes((1 << 20) + 1))
    with pytest.raises(
        chasles.InvalidInput, match="longer: is a pipe that does not end within 1 MiB; write it to a file first"
    ):
        read_file.read_file(longer)


def test_long_work_shows_signs_of_life(monkeypatch, capsys):
    """As the commands in C++ do: tests/cli/limit_test.cpp."""
    assert (program.FIRST_LINE, program.BETWEEN_LINES) == (5, 10)
    monkeypatch.setattr(program, "FIRST_LINE", 0.05)
    monkeypatch.setattr(program, "BETWEEN_LINES", 0.05)
    parser = program.Parser(prog="chasles test")
    assert program.run(parser, [], lambda _: time.sleep(0.5) or program.CONTACT) == program.CONTACT
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) >= 2 and set(lines) <= {
        "chasles: progress: at work for 0 s",
        "chasles: progress: at work for 1 s",
    }
    running = threading.active_count()
    assert program.run(parser, [], lambda _: program.CLEAR) == program.CLEAR
    assert threading.active_count() == running and not capsys.readouterr().err
