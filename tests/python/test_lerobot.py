"""The steps for LeRobot, in a process of its own: torch keeps objects of other tests until the process ends."""

import importlib.util
import pathlib
import subprocess
import sys

import pytest


def test_the_steps_for_lerobot():
    if importlib.util.find_spec("lerobot") is None:
        pytest.skip("no lerobot")
    file = pathlib.Path(__file__).with_name("lerobot_steps.py")
    run = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(file)]
    done = subprocess.run(run, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "passed" in done.stdout
