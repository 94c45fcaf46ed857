#!/usr/bin/env python3
"""The page in a headless Chromium: it draws, moves, stops at the contact, and makes no network requests.

Usage: page_in_browser_test.py CHASLES CHROMIUM [FOLDER]. Screenshots are kept in FOLDER, if given. Exit status 77 means
skipped, because there is no browser or the build has no viewer.
"""

import json
import sys

from page_tests import PageTest, count, folder, is_contact_colour, is_moving_colour, main, run

TURNING_PAST = ["--start", "3 0.2 0.3", "--goal", "-1 0.2 0.3 0.9 0.1 0.2 0.3"]
BOTH_AT_VELOCITY = ["--motion", "velocity", "--fixed-start", "0 0 0", "--fixed-goal", "0.5 0 0.2 1 0 0 0.4"]
TITLE = "Two cubes </script><script>document.title = 'broken out'</script>"


def numbers_in(text: str) -> set:
    found = set()
    for word in text.split():
        try:
            found.add(float(word))
        except ValueError:
            pass
    return found


class Page(PageTest):
    @classmethod
    def write_pages(cls) -> None:
        cls.answer = json.loads(run("check", "cube.obj", "cube.obj", *TURNING_PAST, "--json").stdout)
        run("view", "cube.obj", "cube.obj", *TURNING_PAST, "--title", TITLE, "--out", "contact.html")
        run("view", "cube.obj", "cube.obj", *TURNING_PAST, "--margin", "0.25", "--out", "margin.html")
        run("view", "cube.obj", "cube.obj", "--start", "3 0 0", "--goal", "3 5 0", "--out", "clear.html")
        run("view", "cube.obj", "cube.obj", "--start", ".5 .5 .5", "--goal", "3 5 0", "--out", "start.html")
        sliding = ["--start", ".25 0 1.25", "--goal", ".75 0 1.25", "--margin", "0.25"]
        run("view", "cube.obj", "cube.obj", *sliding, "--out", "doubt.html")
        passing = ["--start", "3 1.25 0", "--goal", "-3 1.25 0", "--margin", "0.25"]
        run("view", "cube.obj", "cube.obj", *passing, "--out", "passing.html")
        resting, on = ["--start", "0 0 1.05"], ["--margin", "0.1", "--hold", "0.02"]
        run("view", "cube.obj", "cube.obj", *resting, "--goal", "3 0 1.05", *on, "--out", "slide.html")
        run("view", "cube.obj", "cube.obj", *resting, "--goal", "0 0 0.95", *on, "--out", "push.html")
        run("view", "cube.obj", "cube.obj", *TURNING_PAST, "--any", "--out", "any.html")
        run("view", "cube.obj", "cube.obj", *TURNING_PAST, *BOTH_AT_VELOCITY, "--out", "velocity.html")
        run("view", "cube.obj", "cube.obj", *TURNING_PAST, "--motion", "twist", "--out", "twist.html")

    def test_the_slider_moves_the_body_and_stops_at_the_contact(self) -> None:
        self.open("contact.html")
        self.assertEqual(self.time(), 0)
        before = self.picture("before")
        self.slide(0.3)
        self.assertAlmostEqual(self.time(), 0.3, delta=0.02)
        self.slide(0.95)
        self.assertEqual(self.time(), self.answer["time"], "to the last bit")
        self.assertIn(f"{self.answer['time']:.12f}", self.text("#time-text"))
        after = self.picture("at_contact")
        changed = sum(a != b for above, below in zip(before, after) for a, b in zip(above, below))
        self.assertGreater(changed, 2000)
        self.assertGreater(count(after, is_contact_colour), count(before, is_contact_colour) + 50, "marker and normal")
        self.assertGreater(count(after, is_moving_colour), 800)

    def test_it_goes_through_when_told_to(self) -> None:
        self.open("contact.html")
        self.click("#through")
        self.slide(0.9)
        self.assertAlmostEqual(self.time(), 0.9, delta=0.02)
        self.slide(self.answer["time"] + 0.004)
        self.assertEqual(self.time(), self.answer["time"], "it snaps to the contact")
        self.slide(0.9)
        self.click("#through")
        self.assertEqual(self.time(), self.answer["time"])

    def test_keys_step_and_play(self) -> None:
        self.open("contact.html")
        self.browser.press("ArrowRight")
        self.browser.press("ArrowRight")
        self.browser.press("ArrowLeft")
        self.assertAlmostEqual(self.time(), 0.01)
        self.browser.press("End")
        self.assertEqual(self.time(), self.answer["time"])
        self.browser.press("Home")
        self.assertEqual(self.time(), 0)
        self.browser.press(" ")
        self.browser.evaluate(
            "new Promise(done => { const wait = () => document.querySelector('.is-playing') ? setTimeout(wait, 20) "
            ": done(true); wait(); })"
        )
        self.assertEqual(self.time(), self.answer["time"], "playing ends at the contact")

    def test_it_shows_the_numbers_of_the_answer(self) -> None:
        self.open("contact.html")
        self.assertEqual(self.browser.evaluate("document.title"), TITLE + " \u2013 Chasles")
        self.assertEqual(self.text("h1"), TITLE)
        self.assertEqual(self.text("#verdict"), "Contact")
        shown = numbers_in(self.text("#numbers"))
        contact = self.answer["contacts"][0]
        numbers = [self.answer[name] for name in ["time", "time_upper", "tau", "tau_upper"]]
        numbers += [*contact["point"], *contact["normal"], contact["gap"], contact["approach_speed"]]
        numbers += self.answer["work"].values()
        self.assertEqual([number for number in numbers if number not in shown], [])

    def test_even_motions_have_no_tau(self) -> None:
        names = {"velocity": "constant velocity", "twist": "constant twist"}
        for motion, name in names.items():
            options = BOTH_AT_VELOCITY if motion == "velocity" else ["--motion", "twist"]
            answer = json.loads(run("check", "cube.obj", "cube.obj", *TURNING_PAST, *options, "--json").stdout)
            self.browser.events.clear()
            self.open(f"{motion}.html")
            text = self.text("#numbers")
            self.assertIn(name, text)
            self.assertNotIn("tau", text)
            self.assertNotIn("undefined", text)
            self.assertEqual("the fixed one moves too" in text, motion == "velocity")
            numbers = [answer["time"], answer["time_upper"], *answer["motion"].get("displacement", [])]
            self.assertEqual([number for number in numbers if number not in numbers_in(text)], [])
            self.slide(1)
            self.assertEqual(self.time(), answer["time"], "it stops at the contact")
            self.assertGreater(count(self.picture(motion), is_contact_colour), 50)

    def test_a_margin_keeps_a_gap(self) -> None:
        self.open("margin.html")
        self.slide(1)
        self.assertLess(self.time(), self.answer["time"])
        self.assertIn("within 0.25", self.text("#meaning"))
        self.assertTrue([number for number in numbers_in(self.text("#numbers")) if abs(number - 0.25) < 1e-9], "the gap")
        self.assertGreater(count(self.picture("margin"), is_contact_colour), 60)

    def test_what_is_held_goes_on(self) -> None:
        self.open("slide.html")
        self.assertEqual(self.text("#verdict"), "Clear")
        self.assertIn("the bodies keep the hold distance", self.text("#meaning"))
        self.assertIn("held at the start", self.text("#numbers").lower())

    def test_what_is_held_may_come_nearer(self) -> None:
        self.open("push.html")
        self.assertEqual(self.text("#verdict"), "Contact")
        self.assertIn("The bodies come to the hold distance", self.text("#meaning"))

    def test_any_contact_need_not_be_the_first(self) -> None:
        self.open("any.html")
        self.assertIn("and perhaps earlier", self.text("#meaning"))

    def test_a_clear_motion_runs_to_its_end(self) -> None:
        self.open("clear.html")
        self.assertEqual(self.text("#verdict"), "Clear")
        self.slide(1)
        self.assertEqual(self.time(), 1)
        self.assertEqual(count(self.picture("clear"), is_contact_colour), 0)

    def test_bodies_that_overlap_do_not_move(self) -> None:
        self.open("start.html")
        self.assertEqual(self.text("#verdict"), "Contact at the start")
        self.slide(0.7)
        self.assertEqual(self.time(), 0)
        self.assertGreater(count(self.picture("start"), is_contact_colour), 15, "the point of the overlap")

    def test_a_start_that_is_not_certain_claims_no_contact(self) -> None:
        self.open("doubt.html")
        self.assertIn("come within 0.25 at the start could not be told from a miss", self.text("#meaning"))

    def test_an_answer_that_is_not_certain_claims_no_contact(self) -> None:
        self.open("passing.html")
        self.assertIn("come within 0.25 inside the bracket could not be told from a miss", self.text("#meaning"))
        self.assertIn("They do not before its lower end.", self.text("#meaning"))

    def test_narrow_windows_and_the_dark(self) -> None:
        background = self.dark_and_narrow("contact.html", "narrow")[30][3]
        self.assertLess(max(background), 60)


if __name__ == "__main__":
    sys.exit(main())
