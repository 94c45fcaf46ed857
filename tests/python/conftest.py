"""Bodies and data that the tests share."""

import os
import pathlib

import pytest
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles

ROOT = pathlib.Path(__file__).parents[2]


@pytest.fixture(scope="session")
def cube() -> chasles.Polyhedron:
    """The unit cube of docs/command-line.md."""
    return chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)


@pytest.fixture(scope="session")
def data() -> pathlib.Path:
    """External data. Tests that need it are skipped if it is missing."""
    folder = pathlib.Path(os.environ.get("CHASLES_DATA_DIR", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip("no data beside the project (CHASLES_DATA_DIR)")
    return folder
