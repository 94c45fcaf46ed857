"""The examples run unchanged. They assert their own claims."""

import importlib.metadata
import importlib.util
import subprocess
import sys

import pytest
from conftest import ROOT

EXAMPLES = sorted((ROOT / "examples" / "python").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda file: file.stem)
def test_example(example, tmp_path):
    text = example.read_text("utf-8")
    if "example_robot_data" in text:
        try:
            importlib.metadata.distribution("example_robot_data")
        except importlib.metadata.PackageNotFoundError:
            pytest.skip("no robots: example_robot_data is not installed")
    for package in ("build123d", "coal", "matplotlib", "mujoco", "ompl", "pinocchio", "pydrake.geometry"):
        if f"import {package}" in text or f"from {package} import" in text:
            pytest.importorskip(package)
    for package in ("jax", "torch"):  # not imported here: they keep objects of other tests until the process ends
        if f"import {package}" in text and importlib.util.find_spec(package) is None:
            pytest.skip(f"no {package}")
    done = subprocess.run(
        [sys.executable, example, tmp_path / "picture.png"], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    if "savefig" in text:
        assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


def test_there_are_examples():
    assert len(EXAMPLES) >= 5
