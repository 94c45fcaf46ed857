"""Pages and plots exist and contain the answer. The tests in tests/view check how a page looks."""

import base64
import json
import os
import re

import numpy as np
import pytest
from cubes import pose
from motion_kinds import KINDS

import chasles

START, GOAL = [3, 0.2, 0.3, 1, 0, 0, 0], [-1, 0.2, 0.3, 0.9, 0.1, 0.2, 0.3]  # docs/command-line.md
AWAY = [5, 0, 0, 1, 0, 0, 0]
INSIDE = [0.5, 0.5, 0.5, 1, 0, 0, 0]


def scene_of(page):
    return json.loads(re.search(r'<script id="scene" type="application/json">(.*?)</script>', page.read_text())[1])


@pytest.fixture
def page(tmp_path):
    return tmp_path / "page.html"


@pytest.fixture(autouse=True)
def _viewer(request, tmp_path, cube):
    """Tests of pages are skipped if the package was built without the viewer, unless CHASLES_HAS_VIEWER is set."""
    if "page" in request.fixturenames:
        try:
            chasles.view(cube, cube, START, GOAL, out=tmp_path / "try.html")
        except chasles.InvalidInput as error:
            if "has no viewer" not in str(error) or os.environ.get("CHASLES_HAS_VIEWER"):
                raise
            pytest.skip(str(error))


def test_view_answers_and_writes_a_page(cube, page):
    found = chasles.view(cube, cube, START, GOAL, out=page, title="Cubes & co", names=("one", "other"))
    assert found.verdict == "contact"
    scene = scene_of(page)
    assert scene["title"] == "Cubes & co" and scene["moving"]["name"] == "one"
    assert scene["answer"]["time"] == found.time
    assert scene["answer"]["contacts"][0]["point"] == list(found.contacts[0].point)


def test_an_answer_writes_the_same_page(cube, page, tmp_path):
    found = chasles.view(cube, cube, START, GOAL, out=page)
    assert found.view(tmp_path / "again.html").read_text() == page.read_text()


def numbers(text):
    return np.frombuffer(base64.b64decode(text))


@pytest.mark.parametrize("motion", [None, chasles.Motion.hinge([0, 9, 0], [0, 0, 1], [0, 1])])
def test_a_page_shows_the_curve_of_the_distance(cube, page, motion):
    ends = () if motion is not None else (START, GOAL)
    found = chasles.first_contact(cube, cube, *ends, motion=motion, margin=0.25)
    found.view(page, curve=True)
    curve = scene_of(page)["curve"]
    profile = chasles.profile(cube, cube, *ends, motion=motion)
    for name in ("times", "lower", "upper"):
        np.testing.assert_array_equal(numbers(curve[name]), getattr(profile, name))
    assert curve["margins"] == [0.25] and curve["pairs"] == curve["nearest"] == []
    found.view(page)
    assert "curve" not in scene_of(page)


def test_pages_of_scenes_and_robots_show_curves(cube, page):
    scene = chasles.Scene()
    scene.add("post", cube, pose=pose(0, 4, 0))
    scene.add("cart", cube, pose=pose(-3, 0, 0), goal=pose(3, 0, 0))
    scene.view(scene.first_contact(), page, curve=True)
    curve, profile = scene_of(page)["curve"], scene.profile()
    np.testing.assert_array_equal(numbers(curve["upper"]), profile.upper)
    assert curve["pairs"] == [["cart", "post"]] and curve["nearest"] == profile.nearest
    robot = chasles.Robot(
        links=[{"name": "base"}, {"name": "cube", "collisions": [cube]}],
        joints=[{"name": "way", "type": "prismatic", "parent": "base", "child": "cube", "axis": [1, 0, 0]}],
    )
    chasles.write_robot_page(robot, [[-3], [0], [3]], page, scene=scene, curve=True)
    curve, profile = scene_of(page)["curve"], robot.profile([[-3], [0], [3]], scene=scene)
    np.testing.assert_array_equal(numbers(curve["times"]), profile.times)
    assert [tuple(pair) for pair in curve["pairs"]] == profile.pairs


def test_pages_of_pairs_and_scenes_show_a_short_stroke(cube, page):
    """The stroke lasts a thousandth of the motion."""
    stamps, heights = [0, 0.4445, 0.445, 0.4455, 1], [60, 60, 10, 60, 60]
    stroke = chasles.TimedPoses.through(stamps, [pose(0, 0, z) for z in heights])
    scene = chasles.Scene()
    scene.add("punch", cube, motion=stroke)
    scene.add("die", cube)
    chasles.first_contact(cube, cube, motion=stroke).view(page)
    pair = scene_of(page)
    scene.view(scene.first_contact(), page)
    for bodies in (pair["bodies"], scene_of(page)["bodies"]):
        drawn = dict(zip(numbers(bodies[0]["times"]), numbers(bodies[0]["poses"]).reshape(-1, 7)[:, 2], strict=True))
        assert [drawn.get(time) for time in stamps] == heights


def test_a_swapped_answer_writes_the_same_page(cube, page, tmp_path):
    found = chasles.view(cube, cube, START, GOAL, out=page, names=("one", "other"))
    again = found.swapped().view(tmp_path / "again.html", names=("other", "one"))
    assert again.read_text() == page.read_text()


def test_a_page_needs_no_network(cube, page):
    chasles.view(cube, cube, START, GOAL, out=page)
    text = re.sub(r"<!--.*?-->", "", page.read_text("utf-8"), flags=re.DOTALL)
    assert "Content-Security-Policy" in text
    assert not re.search(r"""<(link|script|img|iframe)[^>]*\b(src|href)=(?!["']?data:)""", text)


def test_a_path_is_seen_by_its_segment(cube, page):
    chasles.first_contact_on_path(cube, cube, [AWAY, START, GOAL]).view(page)
    assert scene_of(page)["answer"]["time"] == chasles.first_contact(cube, cube, START, GOAL).time


def test_options_reach_query_and_page(cube, page):
    motion = chasles.SweepMotion.between(START, GOAL)
    chasles.view(cube, cube, motion=motion, time_tolerance=1e-6, out=page)
    assert scene_of(page)["is_sweep"]
    with pytest.raises(TypeError):
        chasles.view(cube, cube, START, GOAL, out=page, colour="red")


@pytest.fixture
def plt():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    yield plt
    plt.close("all")


def colours_of(figure):
    figure.canvas.draw()
    return {tuple(colour) for colour in np.asarray(figure.canvas.buffer_rgba())[..., :3].reshape(-1, 3)}


CONTACT_COLOUR = (0xD4, 0x14, 0x7F)


def test_plot_shows_the_contact(cube, plt):
    axes = chasles.first_contact(cube, cube, START, GOAL).plot()
    assert axes.get_title() == "contact at time 0.465661545123"
    assert CONTACT_COLOUR in colours_of(axes.figure)
    sizes = [np.ptp(limits) for limits in (axes.get_xlim(), axes.get_ylim(), axes.get_zlim())]
    np.testing.assert_allclose(axes._box_aspect / np.linalg.norm(axes._box_aspect), sizes / np.linalg.norm(sizes))


def test_plot_of_a_clear_motion_and_of_an_overlap(cube, plt):
    clear = chasles.first_contact(cube, cube, START, AWAY).plot()
    assert clear.get_title().startswith("clear") and CONTACT_COLOUR not in colours_of(clear.figure)
    overlap = chasles.first_contact(cube, cube, INSIDE, GOAL).plot()
    assert overlap.get_title() == "contact at the start" and CONTACT_COLOUR in colours_of(overlap.figure)


def test_plot_says_what_was_asked(cube, plt):
    def title(goal, **options):
        return chasles.first_contact(cube, cube, [0, 0, 1.05, 1, 0, 0, 0], goal, **options).plot().get_title()

    assert title([0, 0, 3, 1, 0, 0, 0], margin=0.01) == "clear: nothing comes within 0.01 during the whole motion"
    assert title([0, 0, 3, 1, 0, 0, 0], margin=0.1) == "contact within 0.1 at the start"
    assert title([0, 0, 0, 1, 0, 0, 0], margin=0.01).startswith("contact within 0.01 at time 0.0380")
    held = title([3, 0, 1.05, 1, 0, 0, 0], margin=0.1, hold=0.02)
    assert held == "clear: the hold distance is kept, or that of the start if it is less"


def test_plot_draws_into_axes_that_are_given(cube, plt):
    axes = plt.figure().add_subplot(1, 2, 1, projection="3d")
    assert chasles.first_contact(cube, cube, START, GOAL).plot(axes) is axes


def test_plot_draws_large_meshes_coarsely(plt):
    from chasles.plot import MOST_TRIANGLES, _polygons

    around, along = 240, 60
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, around, endpoint=False), np.linspace(-1, 1, along), indexing="ij")
    vertices = np.stack([np.cos(u), np.sin(u), v], axis=-1).reshape(-1, 3)
    i, j = (index.reshape(-1) for index in np.meshgrid(range(around), range(along - 1), indexing="ij"))
    corner = [i * along + j, (i + 1) % around * along + j, (i + 1) % around * along + j + 1, i * along + j + 1]
    faces = np.concatenate([np.stack(corner[:3], axis=1), np.stack([corner[0], *corner[2:]], axis=1)])
    tube = chasles.Polyhedron(vertices, faces)
    drawn = np.concatenate(_polygons(tube))
    assert 1000 < len(drawn) / 3 <= MOST_TRIANGLES < len(faces)
    np.testing.assert_allclose(np.ptp(drawn, axis=0), [2, 2, 2], atol=0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_motions_of_all_kinds_are_viewed(kind, cube, page):
    found = chasles.first_contact(cube, cube, motion=KINDS[kind]())
    text = found.view(page).read_text("utf-8")
    if found.contacts:
        assert repr(float(found.contacts[0].point[1])) in text or "scene" in text
    assert "Content-Security-Policy" in text and len(text) > 10000
    renamed = text.replace('"name":"moving"', '"name":"?"').replace('"name":"fixed"', '"name":"moving"')
    renamed = renamed.replace('"name":"?"', '"name":"fixed"')
    assert found.swapped().view(page).read_text("utf-8") in (text, renamed)


@pytest.mark.parametrize("kind", KINDS)
def test_motions_of_all_kinds_are_plotted(kind, cube, plt):
    found = chasles.first_contact(cube, cube, motion=KINDS[kind]())
    title = found.plot().get_title()
    assert title.startswith("clear" if found.verdict == "clear" else "contact")
    assert found.swapped().plot().get_title() == title


def test_answers_of_scenes_and_paths_are_viewed_and_plotted(cube, page, plt):
    scene = chasles.Scene()
    scene.add("hinge", cube, motion=KINDS["hinge"]())
    scene.add("post", cube, [2.5, 2.5, 0, 1, 0, 0, 0])
    found = scene.first_contact()
    assert found.pair == ("hinge", "post")
    assert "plot" in dir(found) and found.plot().get_title().startswith("contact")
    assert "Content-Security-Policy" in found.view(page, names=found.pair).read_text("utf-8")
    assert "Content-Security-Policy" in scene.view(found, page).read_text("utf-8")
    path = chasles.first_contact_on_path(cube, cube, [AWAY, START, GOAL])
    assert path.plot().get_title().startswith("contact") and path.view(page)


def test_the_answer_of_a_clear_scene_names_the_way_out(cube, page, plt):
    scene = chasles.Scene()
    scene.add("a", cube)
    clear = scene.first_contact()
    for call in (lambda: clear.view(page), clear.plot):
        with pytest.raises(chasles.InvalidInput, match=r"the scene is clear.*scene\.view\(found\)"):
            call()
    assert "Content-Security-Policy" in scene.view(clear, page).read_text("utf-8")
