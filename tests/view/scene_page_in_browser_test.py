#!/usr/bin/env python3
"""The page of many bodies in a headless Chromium: it lists the contacts, shows the chosen one, and moves all bodies.

Usage: scene_page_in_browser_test.py CHASLES CHROMIUM [FOLDER] (tests/view/page_tests.py).
"""

import base64
import json
import re
import struct
import sys

from page_tests import PageTest, count, folder, is_contact_colour, is_moving_colour, main, run

SCENE = {
    "bodies": [
        {"name": "floor", "mesh": "cube.obj", "scale": 10, "pose": [-5, -5, -10]},
        {"name": "falling", "mesh": "cube.obj", "pose": [0, 0, 3, 1, 0.1, 0.2, 0], "goal": [0, 0, -1, 1, 0.5, 0, 0.3]},
        {"name": "thrown", "mesh": "cube.obj", "pose": [-4, 0.2, 1], "goal": [3, 0.2, 2, 1, 0, 1, 0], "motion": "twist"},
        {"name": "walking", "mesh": "cube.obj", "pose": [4, 4, 1], "goal": [0, 0, 1]},
        {"name": "<b>far</b>", "mesh": "cube.obj", "pose": [9, 9, 9], "goal": [9, 9, 4]},
    ]
}
ROWS = 400
# A ball that slides along x from -3, towards the table of `doubt`, which begins at 0.
SLIDE = """<robot name="slide"><link name="base"/><link name="ball"><collision><origin xyz="-3 0.5 0.5"/><geometry>
<sphere radius="0.5"/></geometry></collision></link><joint name="x" type="prismatic"><parent link="base"/><child link="ball"/>
<axis xyz="1 0 0"/><limit lower="-9" upper="9"/></joint></robot>"""


def packed(numbers: list) -> str:
    return base64.b64encode(struct.pack(f"<{len(numbers)}d", *numbers)).decode()


def recording(page: str, contacts: int) -> str:
    """The page with a recording instead of its scene: a tower of cubes, and stamps from 10 to 90."""
    data = json.loads(re.search(r'<script id="scene"[^>]*>(.*?)</script>', page)[1])
    cube = data["meshes"][data["bodies"][1]["mesh"]]
    times = [10, 20, 25, 90]
    bodies = [{"name": "base", "mesh": 0, "poses": packed([0, 0, 0, 1, 0, 0, 0])}]
    for i in range(1, 30):
        rows = [number for height in (5, 2, 1, 1) for number in (0, 0, height * i, 1, 0, 0, 0)]
        bodies.append({"name": f"box {i}", "mesh": 0, "poses": packed(rows)})
    point = {"point": [0.5, 0.5, 1], "normal": [0, 0, 1], "gap": 0}
    events = [
        {"time": 25 + i / 8, "time_upper": 25 + i / 8, "certain": i != 1, "pair": [i % 29 + 1, i % 29], "kind": "impact"}
        | {"contacts": [point]}
        for i in range(contacts)
    ]
    record = {"format": 2, "title": "A tower", "source": "recording", "margin": 0, "times": packed(times)}
    record |= {"meshes": [cube], "bodies": bodies, "events": events}
    return re.sub(r'(<script id="scene"[^>]*>).*?(</script>)', lambda m: m[1] + json.dumps(record) + m[2], page)


class ScenePage(PageTest):
    @classmethod
    def write_pages(cls) -> None:
        (folder / "scene.json").write_text(json.dumps(SCENE))
        cls.events = json.loads(run("scene", "scene.json", "--all", "--json", "--page", "all.html").stdout)["events"]
        cls.first = json.loads(run("scene", "scene.json", "--json", "--page", "first.html").stdout)
        run("scene", "scene.json", "--all", "--until", "0.1", "--page", "clear_scene.html")
        run("scene", "scene.json", "--until", "0", "--page", "start_scene.html")
        run("scene", "scene.json", "--all", "--until", "0.6", "--page", "limited.html")
        sliding = {"name": "slider", "mesh": "cube.obj", "pose": [0.25, 0, 1.25], "goal": [0.75, 0, 1.25]}
        doubt = {"margin": 0.25, "bodies": [{"name": "table", "mesh": "cube.obj"}, sliding]}
        (folder / "doubt.json").write_text(json.dumps(doubt))
        run("scene", "doubt.json", "--page", "doubt_scene.html")
        rising = {"name": "slider", "mesh": "cube.obj", "pose": [0, 0, 1.5], "goal": [0, 0, 1.9]}
        between = {"bodies": [{"name": "low", "mesh": "cube.obj"}, {"name": "high", "mesh": "cube.obj", "pose": [0, 0, 3.1]}, rising]}
        (folder / "between.json").write_text(json.dumps(between))
        run("scene", "between.json", "--margin", "0.1", "--page", "curve.html", "--curve")
        cls.matrix = json.loads(run("scene", "scene.json", "--matrix", "--json").stdout)["pairs"]
        run("scene", "scene.json", "--matrix", "--page", "matrix.html", "--title", "Matrix")
        run("scene", "between.json", "--matrix", "--page", "matrix_clear.html")
        (folder / "empty.json").write_text('{"bodies": []}')
        run("scene", "empty.json", "--page", "empty.html")
        cloud = "".join(f"{i % 150} {i // 150} -9\n" for i in range(150 * 150))
        (folder / "cloud.xyz").write_text(cloud)
        large = {"name": "cloud", "points": "cloud.xyz", "radius": 0.25}
        (folder / "cloud.json").write_text(json.dumps({"bodies": [large, sliding]}))
        cls.cloud = run("scene", "cloud.json", "--page", "cloud.html").stdout
        (folder / "slide.urdf").write_text(SLIDE)
        for name, path in [("robot_clear", "t,x\n10,0\n12,1\n"), ("robot_contact", "t,x\n10,0\n12,4\n")]:
            (folder / "path.csv").write_text(path)
            run("robot", "slide.urdf", "--path", "path.csv", "--scene", "doubt.json", "--margin", "0", "--page", f"{name}.html")
        (folder / "path.csv").write_text("t,x\n10,3.5\n12,0\n")
        run("robot", "slide.urdf", "--path", "path.csv", "--scene", "doubt.json", "--margin", "0", "--page", "robot_start.html")
        for name, contacts in [("recording", ROWS), ("silent", 0)]:
            (folder / f"{name}.html").write_text(recording((folder / "all.html").read_text(), contacts))

    def rows(self) -> list[str]:
        return self.browser.evaluate("[...document.querySelectorAll('#rows > div')].map(row => row.innerText)")

    def choose(self, row: int) -> None:
        self.click(f"#rows > div:nth-child({row + 1})")

    def filter(self, text: str) -> None:
        self.browser.evaluate(
            f"(field => {{ field.value = {json.dumps(text)}; field.dispatchEvent(new Event('input')); }})"
            "(document.getElementById('filter'))"
        )

    def test_the_curve_says_how_far_apart_the_nearest_pair_is(self) -> None:
        at = lambda time: self.browser.evaluate(f"window.chasles.setTime({time}), document.getElementById('distance-text').textContent")
        self.open("curve.html")
        number, pair = r"distance (\S+) to (\S+) ", r" slider and (\S+)"
        for time, distance, name in [(0, 0.5, "low"), (0.1, 0.54, "low"), (0.25, 0.5, "high"), (1, 0.2, "high")]:
            lower, upper, fixed = re.fullmatch(number + pair, at(time)).groups()
            self.assertTrue(float(lower) <= distance + 1e-3 and float(upper) >= distance - 1e-3, (time, lower, upper))
            self.assertEqual(fixed, name)
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#curve path').length"), 2)
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#curve .margin').length"), 1)
        box = "document.getElementById('curve').getBoundingClientRect()"
        self.assertGreater(self.browser.evaluate(f"{box}.width * {box}.height"), 5000)

    def cell(self, row: str, column: str) -> int:
        """The number of a cell in the table, from 0."""
        names = [body["name"] for body in SCENE["bodies"]]
        return names.index(row) * len(names) + names.index(column)

    def on_cell(self, row: str, column: str, does: str) -> object:
        return self.browser.evaluate(f"(cell => {does})(document.querySelectorAll('#matrix tbody td')[{self.cell(row, column)}])")

    def test_a_cell_of_the_matrix_shows_its_pair_at_its_time(self) -> None:
        self.open("matrix.html")
        self.assertEqual(self.text("h1"), "Matrix")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#matrix tbody td').length"), 25)
        touching = 0
        for pair in self.matrix:
            (moving, fixed), touches = pair["pair"], pair["distance_upper"] == 0
            touching += touches
            for row, column in [(moving, fixed), (fixed, moving)]:
                self.browser.press("Escape")
                self.on_cell(row, column, "cell.click()")
                self.assertEqual(self.time(), pair["time"], "to the last bit")
                self.assertIn(f"{moving} on {fixed}", self.text("#numbers"))
                self.assertIn(f"moving: {moving}", self.text("#legend"))
                said = self.text("#matrix-text").removeprefix(f"{moving} on {fixed}: ")
                if touches:
                    self.assertIn("contact at time", said)
                else:
                    self.assertAlmostEqual(float(said.split()[0]), pair["distance"], delta=1e-3 * pair["distance"])
                self.assertEqual(self.on_cell(row, column, "cell.className.includes('touches')"), touches)
                self.assertEqual(self.browser.evaluate("document.querySelectorAll('#matrix [aria-selected=true]').length"), 2)
            numbers = self.as_numbers(self.text("#numbers").split())
            shown = [pair["time"]] + ([] if touches else [pair["distance"], pair["distance_upper"]])
            self.assertEqual([number for number in shown if number not in numbers], [])
        self.assertEqual(self.text("#verdict"), f"{touching} pairs touch")
        self.assertGreater(touching, 1)
        self.assertGreater(len(self.matrix), touching + 1)
        picture = self.picture("matrix_chosen")
        self.assertGreater(count(picture, is_contact_colour), 60, "markers and cells")
        self.assertGreater(count(picture, is_moving_colour), 500, "the pair is framed")
        self.browser.press("Escape")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#matrix [aria-selected=true]').length"), 0)

    def test_the_matrix_is_used_by_keys(self) -> None:
        self.open("matrix.html")
        self.on_cell("floor", "falling", "cell.focus()")
        for key in ("ArrowDown", "ArrowRight", "ArrowDown", "ArrowUp", "End", "Home", "ArrowLeft"):
            self.browser.press(key)
        self.assertEqual(self.time(), 0, "the slider does not move")
        self.assertTrue(self.on_cell("falling", "floor", "document.activeElement === cell"))
        self.browser.press("Enter")
        (pair,) = [pair for pair in self.matrix if set(pair["pair"]) == {"falling", "floor"}]
        self.assertEqual(self.time(), pair["time"])
        self.browser.press("Enter")
        self.assertEqual(self.text("#numbers"), "", "a second time ends the choice")

    def test_a_matrix_of_bodies_that_stay_apart(self) -> None:
        self.open("matrix_clear.html")
        self.assertEqual(self.text("#verdict"), "Clear")
        self.assertIn("2 pairs over the whole motion. Proven: all keep 0.19", self.text("#meaning"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#matrix .untested').length"), 2)
        self.browser.evaluate("document.querySelectorAll('#matrix tbody td')[1].click()")  # not tested
        self.assertEqual(self.text("#numbers"), "")
        self.browser.evaluate("document.querySelectorAll('#matrix tbody td')[5].click()")
        self.assertIn("nearest", self.text("#legend"))
        self.assertAlmostEqual(self.time(), 1)
        self.assertGreater(count(self.picture("matrix_clear"), is_contact_colour), 60, "the nearest points")

    def test_the_matrix_in_a_narrow_window(self) -> None:
        self.dark_and_narrow("matrix.html", "matrix_narrow")

    def test_a_page_without_a_matrix_has_no_table(self) -> None:
        self.open("first.html")
        self.assertEqual(self.browser.evaluate("document.getElementById('distances').getBoundingClientRect().height"), 0)

    def test_a_page_without_a_curve_has_no_room_for_it(self) -> None:
        self.open("first.html")
        self.assertEqual(self.browser.evaluate("document.getElementById('distance').getBoundingClientRect().height"), 0)

    def test_it_lists_the_contacts_in_order(self) -> None:
        self.open("all.html")
        self.assertGreaterEqual(len(self.events), 3)
        self.assertEqual(self.text("#verdict"), f"{len(self.events)} pairs touch")
        self.assertIn("5 bodies, 1 at rest", self.text("#meaning"))
        expected = [[f"{event['time']:.6f}", " on ".join(event["pair"])] for event in self.events]
        self.assertEqual([row.split("\n") for row in self.rows()], expected)
        self.assertEqual(self.time(), 0)
        self.assertLess(count(self.picture("scene"), is_moving_colour), 60, "the thumb of the slider; nothing is chosen")

    def test_a_click_shows_the_contact(self) -> None:
        self.open("all.html")
        for row, event in enumerate(self.events):
            self.choose(row)
            self.assertEqual(self.time(), event["time"], "to the last bit")
            numbers = self.text("#numbers").split()
            shown = [event["time"], event["time_upper"], *event["contacts"][0]["point"], *event["contacts"][0]["normal"]]
            self.assertEqual([number for number in shown if number not in self.as_numbers(numbers)], [])
            self.assertIn(" on ".join(event["pair"]), self.text("#numbers"))
            self.assertIn(f"moving: {event['pair'][0]}", self.text("#legend"))
            picture = self.picture(f"scene_contact_{row}")
            self.assertGreater(count(picture, is_contact_colour), 60, "marker, normal")
            self.assertGreater(count(picture, is_moving_colour), 500, "the pair is framed")

    @staticmethod
    def as_numbers(words: list[str]) -> list[float]:
        return [float(word) for word in words if re.fullmatch(r"-?[\d.]+(e-?\d+)?", word)]

    def test_the_other_bodies_can_be_hidden(self) -> None:
        self.open("all.html")
        self.choose(0)
        pictures = {}
        for look in ("dim", "solid", "hidden"):
            self.click(f"#others [value={look}]")
            pictures[look] = self.picture(f"scene_{look}")
        background = pictures["hidden"][100][5]
        empty = {look: count(rows, lambda pixel: pixel == background) for look, rows in pictures.items()}
        self.assertGreater(empty["hidden"], empty["dim"])
        self.assertNotEqual(pictures["dim"], pictures["solid"])

    def test_bodies_move(self) -> None:
        self.open("all.html")
        before = self.picture("scene_start")
        self.slide(0.6)
        self.assertAlmostEqual(self.time(), 0.6, delta=0.02)
        self.assertNotEqual(self.picture("scene_later"), before)
        self.browser.press("End")
        self.assertEqual(self.time(), 1, "nothing is chosen, and contacts do not stop the slider")

    def test_escape_and_a_second_click_end_the_choice(self) -> None:
        self.open("all.html")
        self.choose(1)
        self.browser.press("Escape")
        self.assertEqual(self.text("#numbers"), "")
        self.choose(1)
        self.choose(1)
        self.assertEqual(self.text("#numbers"), "")
        self.click("#next")
        self.assertEqual(self.time(), self.events[0]["time"])
        self.click("#next")
        self.assertEqual(self.time(), self.events[1]["time"])
        self.click("#previous")
        self.assertEqual(self.time(), self.events[0]["time"])

    def test_the_first_contact_is_chosen(self) -> None:
        self.open("first.html")
        self.assertEqual(self.text("#verdict"), "First contact")
        self.assertEqual(self.time(), self.first["time"])
        self.assertEqual(len(self.rows()), 1)
        self.assertGreater(count(self.picture("scene_first"), is_contact_colour), 60)

    def test_a_clear_scene_has_no_list(self) -> None:
        self.open("clear_scene.html")
        self.assertEqual(self.text("#verdict"), "Clear")
        self.assertIn("no tested pair touches before time 0.1", self.text("#meaning"))
        self.assertEqual(self.browser.evaluate("document.getElementById('events').offsetHeight"), 0)

    def test_it_names_the_start(self) -> None:
        self.open("start_scene.html")
        self.assertIn("no tested pair touches at the start", self.text("#meaning"))

    def test_it_names_the_limit_of_the_time(self) -> None:
        self.open("limited.html")
        self.assertIn("Contacts after time 0.6 were not asked for.", self.text("#meaning"))

    def test_an_answer_that_is_not_certain_claims_no_contact(self) -> None:
        self.open("doubt_scene.html")
        self.assertIn("a pair comes within 0.25 at the start could not be told from a miss", self.text("#meaning"))

    def test_a_scene_may_be_empty(self) -> None:
        self.open("empty.html")
        self.assertIn("0 bodies", self.text("#meaning"))

    def test_a_robot_that_is_clear_is_proven_so(self) -> None:
        self.open("robot_clear.html")
        self.assertEqual(self.text("#verdict"), "Clear")
        self.assertIn("Proven: no tested pair touches before time 12.", self.text("#meaning"))

    def test_a_robot_has_a_first_contact(self) -> None:
        self.open("robot_contact.html")
        self.assertEqual(self.text("#verdict"), "First contact")
        self.assertIn("The first pair touches inside the bracket, and not before its lower end.", self.text("#meaning"))
        self.assertAlmostEqual(self.time(), 11.25)

    def test_a_robot_may_touch_at_the_start(self) -> None:
        self.open("robot_start.html")
        self.assertEqual(self.text("#verdict"), "Contact at the start")

    def test_it_says_how_much_of_a_cloud_is_drawn(self) -> None:
        self.open("cloud.html")
        self.assertIn("Not all is drawn: 20000 of 22500 points of cloud.", self.text("#meaning"))
        self.assertIn("  drawn     20000 of 22500 points of cloud\n", self.cloud)

    def test_a_recording_has_its_own_times(self) -> None:
        self.open("recording.html")
        self.assertEqual(self.text("#verdict"), f"{ROWS} contacts")
        self.assertEqual(self.time(), 10)
        self.browser.press("End")
        self.assertEqual(self.time(), 90)
        self.choose(1)
        self.assertEqual(self.time(), 25.125)
        self.assertIn("box 2 on box 1", self.text("#numbers"))
        self.assertIn("impact", self.text("#numbers"))
        self.assertIn("no: the bodies may just miss each other", self.text("#numbers"))
        self.assertIn("(not certain)", self.rows()[1])
        self.assertGreater(count(self.picture("recording"), is_contact_colour), 30)

    def test_a_recording_without_contacts_does_not_count_them(self) -> None:
        self.open("silent.html")
        self.assertEqual(self.text("#verdict"), "Recording")
        self.assertIn("No contacts were recorded. Between the recorded times", self.text("#meaning"))
        self.browser.press("End")
        self.assertEqual(self.time(), 90)

    def test_a_long_list_has_few_elements(self) -> None:
        self.open("recording.html")
        self.assertLess(len(self.rows()), 60)
        self.browser.evaluate("document.getElementById('events').focus()")
        self.browser.press("End")
        self.assertEqual(self.time(), 25 + (ROWS - 1) / 8)
        self.assertIn(f"{25 + (ROWS - 1) / 8:.4f}", self.rows()[-1])
        self.browser.press("ArrowUp")
        self.assertEqual(self.time(), 25 + (ROWS - 2) / 8)

    def test_the_list_is_filtered_by_names(self) -> None:
        self.open("recording.html")
        self.filter("BOX 1")
        self.assertTrue(all("box 1" in row for row in self.rows()))
        self.assertTrue(any("box 11" in row for row in self.rows()))
        self.filter("box 1")
        self.assertTrue(all(re.search(r"box 1( on|$|,)", row) for row in self.rows()), "the full name")
        self.filter("no such")
        self.assertEqual(self.rows(), [])
        self.assertIn("No contact", self.text("#none"))

    def test_a_click_on_a_body_filters_the_list(self) -> None:
        self.open("all.html")
        self.choose(0)
        self.click("#others [value=hidden]")
        left, top, width, height = self.browser.evaluate(
            "(({left, top, width, height}) => [left, top, width, height])(document.getElementById('canvas').getBoundingClientRect())"
        )
        moving = [
            (x, y)
            for y, row in enumerate(self.picture("scene_pick"))
            for x, pixel in enumerate(row)
            if is_moving_colour(pixel) and 2 * x < width and 2 * y < height
        ]
        x, y = moving[len(moving) // 2]
        mouse = {"x": 2 * x, "y": 2 * y, "button": "left", "clickCount": 1}
        self.browser.call("Input.dispatchMouseEvent", type="mousePressed", **mouse)
        self.browser.call("Input.dispatchMouseEvent", type="mouseReleased", **mouse)
        picked = self.browser.evaluate("document.getElementById('filter').value")
        self.assertIn(picked, self.events[0]["pair"])

    def test_narrow_windows_and_the_dark(self) -> None:
        background = self.dark_and_narrow("first.html", "scene_narrow")[200][1]
        self.assertLess(max(background), 60)


if __name__ == "__main__":
    sys.exit(main())
