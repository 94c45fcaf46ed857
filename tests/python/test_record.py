"""Pages of many bodies: they hold the answer or the recording, and wrong input gets one clear error."""

import base64
import copy
import json
import os
import pickle
import re

import numpy as np
import pytest
from cubes import pose

import chasles


def data_of(page):
    return json.loads(re.search(r'<script id="scene" type="application/json">(.*?)</script>', page.read_text())[1])


def numbers(packed):
    return np.frombuffer(base64.b64decode(packed))


@pytest.fixture
def scene(cube):
    scene = chasles.Scene()
    scene.add("left", cube, pose(-4, 0, 0), pose(0, 0, 0))
    scene.add("right", cube, pose(4, 0.25, 0.25), pose(0, 0.25, 0.25), motion="twist")
    scene.add("floor", cube, pose(0, 0, -9))
    return scene


TIMES = [0.0, 1.5, 2.0]
CONTACT = {"time": 1.75, "pair": (1, "one"), "points": [[1, 2, 3]], "normals": [[0, 0, 1]], "kind": "impact"}


@pytest.fixture
def poses():
    rows = np.zeros((3, 2, 7))
    rows[:, :, 3] = 2  # a quaternion of any length
    rows[:, 1, 2] = [5, 1, 3]
    return rows


@pytest.fixture
def page(tmp_path, cube):
    """Skips if the package was built without the viewer, unless CHASLES_HAS_VIEWER is set."""
    try:
        return chasles.recording_page(tmp_path / "page.html", [cube], [0], np.array([[pose(0, 0, 0)]]))
    except chasles.InvalidInput as error:
        if "has no viewer" not in str(error) or os.environ.get("CHASLES_HAS_VIEWER"):
            raise
        pytest.skip(str(error))


def test_a_scene_writes_the_page_of_its_first_contact(scene, page):
    found = scene.first_contact()
    assert scene.view(found, page, title="Three </script> cubes") == page
    data = data_of(page)
    assert data["source"] == "first_contact" and data["title"] == "Three </script> cubes"
    assert [body["name"] for body in data["bodies"]] == ["left", "right", "floor"]
    assert len(data["meshes"]) == 1, "all bodies share one cube"
    (event,) = data["events"]
    assert event["pair"] == [0, 1] and event["time"] == found.time and event["time_upper"] == found.time_upper
    assert event["contacts"][0]["point"] == list(found.contacts[0].point)
    assert data["clear_until"] == found.clear_until
    assert len(numbers(data["bodies"][2]["poses"])) == 7, "the floor rests"


def test_a_scene_writes_the_page_of_all_contacts(scene, page):
    scene.move("floor", pose(0, 0, -9), pose(0, 0, 0.5))
    found = scene.all_contacts(margin=0.01)
    assert len(found) > 1
    scene.view(found, page)
    data = data_of(page)
    assert data["source"] == "all_contacts" and data["margin"] == 0.01
    assert [event["time"] for event in data["events"]] == [contact.time for contact in found]
    scene.view(scene.all_contacts(until=0.1), page)
    assert data_of(page)["events"] == []


def test_simultaneous_contacts_are_on_the_page(scene, page):
    scene.move("right", pose(0, 0, -4.75), pose(0, 0, -4.75))
    scene.move("left", pose(0, 0, -0.5), pose(0, 0, -7.5))
    scene.move("floor", pose(0, 0, -9), pose(0, 0, -2))
    found = scene.first_contact()
    assert len(found.simultaneous) == 1
    scene.view(found, page)
    assert len(data_of(page)["events"]) == 2


def test_a_clear_scene_has_a_page(scene, page):
    scene.view(scene.first_contact(until=0.5), page)
    assert data_of(page)["events"] == [] and data_of(page)["clear_until"] == 0.5


CHANGES = {
    "moved": lambda scene, cube: scene.move("left", pose(0, 0, -0.5), pose(0, 0, -7.5)),
    "moved at once": lambda scene, cube: scene.move_all(*[[pose(0, 0, -9 * i) for i in range(3)]] * 2),
    "added": lambda scene, cube: scene.add("other", cube, pose(9, 0, 0)),
    "removed": lambda scene, cube: scene.remove("left"),
    "ignored": lambda scene, cube: scene.ignore("left", "floor"),
    "ignored as groups": lambda scene, cube: scene.ignore_groups("a", "b"),
    "ignored by touch": lambda scene, cube: scene.ignore_touching_at_start(),
    "margin": lambda scene, cube: scene.set_margin("left", "floor", 1),
    "hold": lambda scene, cube: scene.set_group_hold("a", "b", 1),
}
ANOTHER = "found: is the answer of another scene, or of this one before it was changed; ask this scene again"


@pytest.mark.parametrize("change", CHANGES)
def test_an_answer_is_shown_with_the_scene_as_it_was(scene, page, cube, change):
    answers = [scene.first_contact(), scene.first_contact(until=0.1), scene.all_contacts(), scene.least_distances()]
    empty = scene.all_contacts(until=0.1)
    for found in [*answers, empty]:
        scene.view(found, page)
    CHANGES[change](scene, cube)
    for found in [*answers, empty]:
        with pytest.raises(chasles.InvalidInput, match=ANOTHER):
            scene.view(found, page)
    scene.view(scene.first_contact(), page)
    scene.view(scene.least_distances(), page)


def test_an_answer_is_shown_with_its_own_scene_and_with_copies(scene, page, cube):
    found, matrix = scene.first_contact(), scene.least_distances()
    with pytest.raises(chasles.InvalidInput):
        scene.add("left", cube)  # a change that is refused changes nothing
    with pytest.raises(chasles.InvalidInput):
        scene.move("none", pose(0, 0, 0))
    for shown in (scene, copy.copy(scene)):
        shown.view(found, page)
        shown.view(matrix, page)
    for other in (pickle.loads(pickle.dumps(scene)), chasles.Scene()):
        for answer in (found, matrix):
            with pytest.raises(chasles.InvalidInput, match=ANOTHER):
                other.view(answer, page)
    again = copy.copy(scene)
    again.move("left", pose(0, 0, 9))
    with pytest.raises(chasles.InvalidInput, match=ANOTHER):
        scene.view(again.first_contact(), page)


def test_a_part_of_an_answer_is_no_answer(scene, page, cube):
    with pytest.raises(chasles.InvalidInput, match="is an empty list, but all_contacts of this scene has given none"):
        scene.view([], page)
    scene.move("floor", pose(0, 0, -9), pose(0, 0, 0.5))
    found = scene.all_contacts(margin=0.01, until=0.99)
    assert len(found) > 1
    scene.view(tuple(found), page)
    assert data_of(page)["until"] == 0.99
    count = len(found)
    for part in (found[:-1], found[1:], [found[0]] * count, found[0]):
        with pytest.raises(chasles.InvalidInput, match=f"found: has . of the {count} contacts that all_contacts has found"):
            scene.view(part, page)
    stepper = chasles.Stepper(scene, margin=1e-3)
    event = stepper.advance()
    for mixed in (found[:1] + scene.all_contacts()[1:], [scene.first_contact()], event.contacts, event.contacts[0]):
        with pytest.raises(chasles.InvalidInput, match="found: must be an answer of first_contact, or the list that all_contacts"):
            scene.view(mixed, page)


def test_what_is_no_answer_of_a_scene_is_a_type_error(scene, page, cube):
    with pytest.raises(TypeError, match="found: must be a chasles.SceneContact"):
        scene.view(chasles.first_contact(cube, cube, pose(3, 0, 0), pose(0, 0, 0)), page)


def test_a_recording_holds_what_was_given(cube, poses, page):
    other = chasles.Polyhedron(2 * np.asarray(cube.vertices), cube.faces)
    chasles.recording_page(page, {"one": cube, "two": other}, TIMES, poses, [CONTACT], title="Fall")
    data = data_of(page)
    assert data["source"] == "recording" and data["title"] == "Fall" and len(data["meshes"]) == 2
    np.testing.assert_array_equal(numbers(data["times"]), TIMES)
    assert len(numbers(data["bodies"][0]["poses"])) == 7, "it rests"
    rows = numbers(data["bodies"][1]["poses"]).reshape(3, 7)
    np.testing.assert_array_equal(rows[:, 2], [5, 1, 3])
    np.testing.assert_array_equal(rows[:, 3:], [[1, 0, 0, 0]] * 3)
    assert data["events"] == [
        {
            "time": 1.75,
            "time_upper": 1.75,
            "certain": True,
            "pair": [1, 0],
            "contacts": [{"point": [1, 2, 3], "normal": [0, 0, 1], "gap": 0}],
            "kind": "impact",
        }
    ]


def test_contacts_of_a_recording_are_put_in_order(cube, poses, page):
    contacts = [{"time": time, "pair": (0, 1), "time_upper": 2, "certain": False} for time in (1, 0, 0.5)]
    chasles.recording_page(page, [cube, cube], TIMES, poses, contacts)
    data = data_of(page)
    assert [event["time"] for event in data["events"]] == [0, 0.5, 1]
    assert data["events"][0]["time_upper"] == 2 and not data["events"][0]["certain"]
    assert [body["name"] for body in data["bodies"]] == ["body 0", "body 1"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"times": [[0, 1, 2]]}, "times: the shape is (1, 3); times have (n,)"),
        ({"times": [0, 2, 2]}, "record: times[2]: must be after the time before it"),
        ({"times": [0, np.nan, 2]}, "record: times[1]: must be a finite number"),
        ({"times": [0, 1]}, "poses: the shape is (3, 2, 7); 2 times and 2 bodies need (2, 2, 7)"),
        ({"poses": np.zeros((3, 2, 4, 4))}, "poses: the shape is (3, 2, 4, 4); 3 times and 2 bodies need (3, 2, 7)"),
        ({"poses": np.full((3, 2, 7), np.nan)}, "poses[0, 0]: "),
        ({"poses": np.zeros((3, 2, 7))}, "poses[0, 0]: "),
        ({"contacts": [CONTACT, CONTACT | {"pair": (0, 2)}]}, "contacts[1]: pair: there is no body 2, only 2 from 0"),
        ({"contacts": [CONTACT | {"pair": (0, -1)}]}, "contacts[0]: pair: there is no body -1, only 2 from 0"),
        ({"contacts": [CONTACT | {"pair": ("one", "three")}]}, "contacts[0]: pair: there is no body 'three'"),
        ({"contacts": [CONTACT | {"pair": (0, 0)}]}, "record: contacts[0]: a body does not touch itself"),
        ({"contacts": [CONTACT | {"pair": (0, 1, 2)}]}, "contacts[0]: pair: 3 bodies; a pair has 2"),
        ({"contacts": [CONTACT | {"time": 3}]}, "record: contacts[0]: the time must be within the times of the record"),
        ({"contacts": [CONTACT | {"time_upper": 1}]}, "record: contacts[0]: the bracket must not end before it begins"),
        ({"contacts": [CONTACT | {"colour": "red"}]}, "contacts[0]: unknown key 'colour'"),
        ({"contacts": [{"pair": (0, 1)}]}, "contacts[0]: time is missing"),
        ({"contacts": [CONTACT | {"normals": []}]}, "contacts[0]: 1 points, 0 normals and 0 gaps"),
        ({"contacts": [CONTACT | {"points": [[1, 2]]}]}, "contacts[0]: points: the shape is (1, 2); vectors have (n, 3)"),
        ({"contacts": [CONTACT | {"points": [[1, 2, np.inf]]}]}, "record: contacts[0]: points, normals and gaps must be"),
    ],
)
def test_wrong_recordings_are_refused(cube, poses, tmp_path, change, message):
    arguments = {"times": TIMES, "poses": poses, "contacts": [CONTACT]} | change
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.recording_page(tmp_path / "no.html", {"one": cube, "two": cube}, **arguments)
    assert str(error.value).startswith(message)
    assert not (tmp_path / "no.html").exists()


def test_shapes_have_to_be_polyhedra(poses, tmp_path):
    with pytest.raises(TypeError, match=re.escape("bodies[0]: must be a chasles.Polyhedron")):
        chasles.recording_page(tmp_path / "no.html", [1, 2], TIMES, poses)
