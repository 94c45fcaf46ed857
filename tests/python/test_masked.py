"""Masked entries of NumPy's arrays, and entries that are None, are no numbers: they are refused by name, wherever arrays come in."""

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, pose
from public_objects import configurations, cube, robot

import chasles

START, GOAL = pose(3, 0, 0), pose(2, 0, 0)


def masked(array, dtype=float):
    """The array, whose last entry is masked."""
    array = np.array(array, dtype)
    hidden = np.zeros(array.shape, bool)
    hidden.flat[-1] = True
    return np.ma.array(array, mask=hidden)


def scene():
    world = chasles.Scene()
    world.add("box", cube())
    return world


def checker():
    return chasles.RobotChecker(robot())


ONE, OTHER = configurations(2)
CALLS = {
    "start": lambda: chasles.first_contact(cube(), cube(), masked(START), GOAL),
    "goal": lambda: chasles.least_distance(cube(), cube(), START, masked(np.eye(4))),
    "start of rows": lambda: chasles.first_contact(cube(), cube(), list(masked(np.eye(4))), GOAL),
    "pose of a scene": lambda: scene().add("other", cube(), masked(START)),
    "centre": lambda: chasles.SweepMotion.between(START, GOAL, masked([0, 0, 0])),
    "vertices": lambda: chasles.Polyhedron(masked(CUBE_VERTICES), CUBE_FACES),
    "vertices in a list": lambda: chasles.Polyhedron([*CUBE_VERTICES[:-1], masked(CUBE_VERTICES[-1])], CUBE_FACES),
    "faces": lambda: chasles.Polyhedron(CUBE_VERTICES, masked(CUBE_FACES, int)),
    "faces in place": lambda: chasles.Polyhedron(CUBE_VERTICES, masked(CUBE_FACES, np.uint32)),
    "faces of different lengths": lambda: chasles.Polyhedron(CUBE_VERTICES, [[0, 1, 3, 2], masked([4, 6, 7], int)]),
    "points": lambda: chasles.points(masked(CUBE_VERTICES), 0.1),
    "margins": lambda: chasles.profile(cube(), cube(), START, GOAL, margins=masked([0.1, 0.2])),
    "poses": lambda: chasles.TimedPoses.through([0, 1], masked([START, GOAL])),
    "starts": lambda: chasles.first_contact_batch(cube(), cube(), masked([START]), [GOAL]),
    "goals": lambda: chasles.least_distance_batch(cube(), cube(), [START], [masked(GOAL)]),
    "goals marked": lambda: chasles.first_contact_batch(cube(), cube(), [START], masked([GOAL]), errors="mark"),
    "path": lambda: chasles.first_contact_on_path(cube(), cube(), masked([START, GOAL])),
    "paths": lambda: chasles.path_is_clear_batch(cube(), cube(), masked([[START, GOAL]])),
    "paths in a list": lambda: chasles.path_is_clear_batch(cube(), cube(), [[START, GOAL], masked([START, GOAL])]),
    "starts of a scene": lambda: scene().move_all(masked([START]), [GOAL]),
    "goal of a hand": lambda: chasles.DraggedBody(scene(), "box").update(masked(GOAL)),
    "transform": lambda: chasles.CollisionManager().add_object("a", cube(), masked(np.eye(4))),
    "start of an edge": lambda: robot().first_contact(masked(ONE), OTHER),
    "goal of an edge": lambda: checker().is_clear(ONE, masked(OTHER)),
    "configurations": lambda: robot().first_contact_on_path(masked([ONE, OTHER])),
    "times": lambda: robot().first_contact_on_path([ONE, OTHER], masked([0, 1])),
    "starts of edges": lambda: chasles.first_contacts_on_edges(checker(), masked([ONE]), [OTHER]),
    "goals of edges": lambda: chasles.first_contacts_on_edges(checker(), [ONE], masked([OTHER]), errors="mark"),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_masked_entry_is_refused_by_name(name):
    with pytest.raises(chasles.InvalidInput) as error:
        CALLS[name]()
    assert "is masked, which leaves no number; give one by array.filled(...)" in str(error.value), error.value
    assert str(error.value).startswith((name.split()[0], "poses" if "path" in name else "paths", "faces[1]")), error.value


def test_a_masked_array_that_hides_nothing_is_an_array():
    plain = chasles.first_contact(cube(), cube(), START, pose(0, 0, 0))
    found = chasles.first_contact(cube(), cube(), np.ma.array(START), np.ma.array(pose(0, 0, 0), mask=False))
    assert found.verdict == "contact" and found.time == plain.time
    assert chasles.Polyhedron(np.ma.array(CUBE_VERTICES), CUBE_FACES).vertices.tolist() == cube().vertices.tolist()


def test_the_first_masked_entry_is_named():
    with pytest.raises(chasles.InvalidInput, match=r"^start: the entry \[6\] is masked"):
        chasles.first_contact(cube(), cube(), masked(START), GOAL)
    with pytest.raises(chasles.InvalidInput, match=r"^vertices: the entry \[7, 2\] is masked"):
        chasles.Polyhedron(masked(CUBE_VERTICES), CUBE_FACES)


def test_none_is_named_with_its_place():
    holed = np.array(CUBE_VERTICES, object)
    holed[5, 1] = None
    for vertices in (holed, holed.tolist()):
        with pytest.raises(chasles.InvalidInput, match=r"^vertices: an array of object .*: the entry \[5, 1\] is None$"):
            chasles.Polyhedron(vertices, CUBE_FACES)
    with pytest.raises(chasles.InvalidInput, match=r"^start: .*: the entry \[0\] is None$"):
        chasles.first_contact(cube(), cube(), [None, *START[1:]], GOAL)
    with pytest.raises(chasles.InvalidInput, match=r"^start: .* is not an array of real numbers \(of Decimal\)"):
        import decimal

        chasles.first_contact(cube(), cube(), [decimal.Decimal(1), *START[1:]], GOAL)


def test_numbers_as_objects_are_told_the_way_out():
    for row in (np.array(START, object), np.array([np.float64(0), np.int64(1), np.float32(2)], object)):
        with pytest.raises(chasles.InvalidInput, match=r"^start: an array of object is not an array of real numbers; "
                           r"its entries are numbers, and array\.astype\(float\) makes one$"):
            chasles.first_contact(cube(), cube(), row, GOAL)
    found = chasles.first_contact(cube(), cube(), np.array(START, object).astype(float), GOAL)
    assert found.verdict == "clear"
    with pytest.raises(chasles.InvalidInput, match=r"^faces: .* of whole numbers; .* array\.astype\(int\) makes one$"):
        chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES.astype(object))


def test_a_list_in_itself_is_refused():
    endless = []
    endless.append(endless)
    with pytest.raises(chasles.InvalidInput, match="^start: "):
        chasles.first_contact(cube(), cube(), endless, GOAL)
