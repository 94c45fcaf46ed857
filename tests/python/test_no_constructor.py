"""What is made by functions with names says so when its type is called."""

import re

import pytest
from cubes import pose
from public_objects import robot

import chasles

MADE = ["ConstantTwist", "ConstantVelocity", "JointPath", "Motion", "ScrewMotion", "Spline", "SweepMotion", "TimedPoses"]


@pytest.mark.parametrize("name", MADE)
def test_a_call_of_the_type_names_its_makers(name):
    kind = getattr(chasles, name)
    for arguments in ((), (pose(3, 0, 0), pose(0, 0, 0))):
        with pytest.raises(TypeError, match=f"^chasles.{name} has no constructor: {name}[.]") as error:
            kind(*arguments)
    makers = re.findall(rf" {name}[.](\w+)", str(error.value))
    assert makers and all(callable(getattr(kind, maker)) for maker in makers), "what the message names"


def test_all_types_with_makers_are_asked():
    motions = [getattr(chasles, name) for name in chasles.__all__]
    made = {kind.__name__ for kind in motions if isinstance(kind, type) and "has no constructor" in refusal(kind)}
    assert made == set(MADE)


def refusal(kind):
    try:
        kind()
    except Exception as error:
        return str(error)
    return ""


@pytest.mark.parametrize("of", [robot, lambda: chasles.RobotChecker(robot())])
def test_a_question_about_an_edge_refuses_a_path(of):
    path = chasles.JointPath.straight(robot(), [robot().neutral(), robot().neutral()])
    asked = of()
    questions = [asked.first_contact, asked.least_distance, *([asked.is_clear] if hasattr(asked, "is_clear") else [])]
    for question in questions:
        with pytest.raises(chasles.InvalidInput, match="^start: is a JointPath, .*first_contact_on_path"):
            question(path)
    with pytest.raises(TypeError, match="^goal: is missing; an edge goes from a start to a goal$"):
        asked.first_contact(robot().neutral())


def test_what_an_extra_installs_is_named(monkeypatch):
    import sys

    for name in ("pyarrow", "chasles.distributed", "chasles.partitions", "chasles.questions"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(ModuleNotFoundError, match=r'^chasles.distributed needs pyarrow.*: pip install "chasles\[distributed\]"$'):
        import chasles.distributed  # noqa: F401


def test_the_version_is_that_of_the_package():
    import importlib.metadata

    assert chasles.__version__ == importlib.metadata.version("chasles")
