"""No answer has a truth value: `if found:` raises, whatever the question was."""

import pytest
from public_objects import configurations, cube, pose, robot, scene

import chasles
from chasles.not_pickled import _WAYS_OUT

PARTS = {"Contact", "DragContact", "DragEvent", "MeshReport", "Overlap", "StepEvent", "UntestedPairs", "Work"}
START, GOAL = pose(3, 0, 0), pose(2, 0, 0)


def dragged():
    world = chasles.Scene()
    world.add("box", cube())
    return chasles.DraggedBody(world, "box", margin=1e-3).update(pose(0.1, 0, 0))


ANSWERS = {
    "ClearBox": lambda: robot().clear_box(*robot().box_of_joints(["turn"])),
    "DistanceMatrix": lambda: scene().least_distances(),
    "DistanceProfile": lambda: chasles.profile(cube(), cube(), START, GOAL),
    "DragStep": dragged,
    "FirstContact": lambda: chasles.first_contact(cube(), cube(), START, GOAL),
    "LeastDistance": lambda: chasles.least_distance(cube(), cube(), START, GOAL),
    "PairProof": lambda: robot().prove_pairs(seconds=0.1)[0],
    "PathContact": lambda: chasles.first_contact_on_path(cube(), cube(), [START, GOAL]),
    "RobotClearance": lambda: robot().least_distance(*configurations(2)),
    "RobotContact": lambda: robot().first_contact(*configurations(2)),
    "RobotRange": lambda: robot().range(*robot().box_of_joints(["turn"])),
    "SceneContact": lambda: scene().first_contact(),
}


def test_all_answers_are_asked():
    answers = next(kinds for way_out, kinds in _WAYS_OUT.items() if "answer" in way_out)
    assert {kind.__name__ for kind in answers} - PARTS == set(ANSWERS)


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_has_no_truth_value(name):
    found = ANSWERS[name]()
    assert type(found).__name__ == name
    with pytest.raises(TypeError, match="^an answer has no truth value: compare its .*, as in `.*`$"):
        bool(found)
    attribute = str(found.__class__.__bool__.__closure__[0].cell_contents).split()[1].strip(",")
    assert hasattr(found, {"bounds": "lower"}.get(attribute, attribute)), "what the message names"
