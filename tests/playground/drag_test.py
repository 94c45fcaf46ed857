#!/usr/bin/env python3
"""The playground in a headless Chromium: dragging by mouse, touch and keys, what it shows, proofs, recordings and links.

Usage: drag_test.py PAGE CHROMIUM CHASLES [FOLDER], see playground.py.
"""

import math
import sys
import time
import unittest

from playground import (
    SHIFT, SIZE, PlaygroundTest, angle, chasles, count, distance, is_contact_colour, is_hand_colour, is_moving_colour, main,
)

RIM = [10, -5, 2]  # a place on the nut
FRONT = [0, -12, 2]


class Dragging(PlaygroundTest):
    def stage(self, name: str) -> list:
        """The picture of the scene, without buttons and legend."""
        return [row[:260] for row in self.picture(name)[25:230]]

    def test_with_friction_a_pulled_nut_stays_on_its_bolt(self) -> None:
        self.open("#nut&friction=0.3")
        self.assertTrue(self.evaluate("document.getElementById('friction').checked"))
        before = self.stage("nut_before")
        start = self.pose()
        self.pull(RIM, 0, -150, release=False)
        self.assertIn("The nut rests: the bolt blocks it.", self.text("#status"))
        pulled = self.stage("nut_pulled")
        self.assertGreater(count(before, is_moving_colour), 3000, "the nut")
        self.assertEqual(count(before, is_contact_colour), 0)
        self.assertGreater(count(pulled, is_contact_colour), 150, "points, normals and forces")
        self.assertGreater(count(pulled, is_hand_colour), count(before, is_hand_colour) + 5, "the line of the hand")
        self.assertGreater(len(self.text("#contacts tbody").splitlines()), 1)
        self.assertLess(distance(self.pose(), start), 2, "mm, where the hand went far")
        self.mouse("mouseReleased", 10, 10)
        self.wait_until("document.getElementById('status').textContent.includes('stays where it is')")
        after = self.stage("nut_released")
        self.assertEqual(count(after, is_hand_colour), count(before, is_hand_colour), "no hand")

    def drag_up(self, down: float) -> None:
        """Pulls the nut, and does not wait for rest."""
        x, y = self.on_part(FRONT)
        self.mouse("mouseMoved", x, y, button="none")
        self.mouse("mousePressed", x, y)
        self.wait_until("playground.app.hand.grip !== undefined")
        for step in range(1, 11):
            self.mouse("mouseMoved", x, y + down * step / 10)

    def test_without_friction_a_pulled_nut_turns_itself_off_until_friction_holds_it(self) -> None:
        self.open("#nut")
        self.drag_up(-50)
        self.wait_until("playground.pose()[2] > 13.5")
        pose = self.pose()
        ahead = (pose[2] - 12) * 2 * math.pi / 6 - 2 * math.atan2(pose[6], pose[3])  # of the thread, 6 mm a turn
        self.assertGreater(math.cos(ahead), math.cos(0.9), "0.7 mm of play")
        self.mouse("mouseReleased", 10, 10)
        self.wait_until("playground.app.hand.grip === undefined")
        self.click("#friction")
        self.wait_until("playground.app.hand.scene.spec.friction === 0.3")
        self.pull(FRONT, 0, -120)
        held = self.pose()
        self.pull(FRONT, 0, -120)
        self.assertLess(distance(self.pose(), held), 0.02)
        self.assertIn("Proven clear", self.prove())
        self.press("f")
        self.wait_until("playground.app.hand.scene.spec.friction === 0")

    def test_shift_turns_the_nut_and_the_thread_lifts_it(self) -> None:
        self.open("#nut")
        start = self.pose()
        for _ in range(2):
            self.pull(FRONT, 150, 0, steps=40, modifiers=SHIFT)
        turned = angle(self.pose(), start)
        self.assertGreater(turned, 1)
        rise = 6 * turned / (2 * math.pi)
        self.assertAlmostEqual(self.pose()[2] - start[2], rise, delta=0.8, msg="6 mm a turn, and some play")
        by_mode = self.pose()
        self.click("#mode-turn + span")
        self.pull(FRONT, -150, 0, steps=40)
        self.assertGreater(angle(self.pose(), by_mode), 0.5, "the button turns, too")
        self.pull(FRONT, 0, 0, button="right")

    def test_a_free_peg_follows_and_reset_brings_it_back(self) -> None:
        self.open("#peg")
        self.pull([0, -8, 30], 400, 60)
        self.assertNotIn("rests", self.text("#status"))
        self.click("#reset")
        self.wait_until("playground.pose()[0] === -4")
        self.assertTrue(self.evaluate("document.getElementById('undo').disabled"))

    def test_the_camera_turns_where_no_part_is(self) -> None:
        self.open("#nut")
        start = self.pose()
        right = "playground.app.view.axes().right.x"
        before = self.evaluate(right)
        self.mouse("mousePressed", 30, 400)
        for x in range(30, 230, 20):
            self.mouse("mouseMoved", x, 400)
        self.mouse("mouseReleased", 230, 400)
        self.assertGreater(abs(self.evaluate(right) - before), 0.1)
        self.assertEqual(self.pose(), start)
        self.assertEqual(self.evaluate("playground.app.hand.session.goals.length"), 0)

    def test_a_finger_drags_and_a_second_one_does_not_disturb(self) -> None:
        self.open("#gears")
        start = self.pose()
        x, y = self.on_part([0, 0, 8])
        touch = lambda kind, *points: self.browser.call(  # noqa: E731
            "Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        )
        touch("touchStart", (x, y))
        self.wait_until("playground.app.hand.grip !== undefined")
        for step in range(1, 15):
            touch("touchMove", (x + 8 * step, y))
        touch("touchStart", (x + 112, y), (40, 40))
        touch("touchMove", (x + 120, y), (40, 60))
        self.evaluate("playground.atRest()")
        touch("touchEnd")
        self.wait_until("playground.app.hand.grip === undefined")
        self.assertGreater(self.pose()[0] - start[0], 10)

    def test_keys_move_turn_undo_and_prove(self) -> None:
        self.open("#peg")
        start = self.pose()
        self.evaluate("document.getElementById('canvas').focus()")
        for _ in range(3):
            self.press("ArrowRight")
            self.evaluate("playground.atRest()")
        moved = self.pose()
        self.assertGreater(distance(moved, start), 3)
        self.assertEqual(angle(moved, start), 0)
        self.press("PageUp")
        self.wait_until("playground.app.hand.grip === undefined")
        self.assertGreater(distance(self.pose(), moved), 1, "away")
        before_turn = self.pose()
        self.press("ArrowLeft", SHIFT)
        self.evaluate("playground.atRest()")
        self.assertGreater(angle(self.pose(), before_turn), 0.05)
        self.wait_until("playground.app.hand.grip === undefined")
        view = self.evaluate("playground.app.view.axes().right.x")
        self.press("d")
        self.assertNotEqual(self.evaluate("playground.app.view.axes().right.x"), view)
        self.press("p")
        self.wait_until("document.getElementById('proof').innerText.includes('Proven clear')")
        for _ in range(self.evaluate("playground.app.hand.session.count")):
            self.press("u")
            self.wait_until("document.getElementById('proof').children.length === 0")
            time.sleep(0.1)
        self.wait_for_pose(start)

    def test_walls_turn_the_key(self) -> None:
        self.open("#maze")
        start = self.pose()
        self.pull([3, -5, 9.6], 260, -30, steps=50)
        self.assertGreater(angle(self.pose(), start), 0.3)
        self.assertIn("Proven clear", self.prove())


class Proofs(PlaygroundTest):
    def test_what_the_hand_asked_for_is_told_from_what_the_part_did(self) -> None:
        self.open("#nut")
        self.assertIn("has not been dragged", self.prove())
        self.pull(RIM, 30, -120)
        words = self.prove()
        self.assertIn("Proven clear", words)
        self.assertIn("would have hit the bolt", words)
        self.pull([10, -5, 2], 0, 0, steps=2)
        self.assertEqual(self.text("#proof"), "", "an old proof says nothing about a new way")

    def test_a_way_without_contact(self) -> None:
        self.open("#peg")
        self.pull([0, -8, 30], 0, -20)
        words = self.prove()
        self.assertIn("Proven clear", words)
        self.assertIn("would have touched nothing either", words)

    def test_a_wrong_way_is_found(self) -> None:
        self.open("#nut")
        self.pull(RIM, 0, -20)
        self.evaluate("playground.app.hand.session.drags[0].way.push([0, 0, 40, 1, 0, 0, 0], [30, 0, 8, 1, 0, 0, 0])")
        words = self.prove()
        self.assertIn("Contact", words)
        self.assertIn("touches the bolt on piece", words)


@unittest.skipUnless(chasles, "no native program")
class Recordings(PlaygroundTest):
    def test_a_saved_hand_runs_by_the_native_program(self) -> None:
        self.open("#peg")
        self.pull([0, -8, 30], 60, 60)
        self.pull([0, -8, 30], -20, -30)
        reached, out = self.replayed("peg", ["plate", "table"])
        worst = max(distance(a, b) for a, b in zip(reached, out))
        self.assertLess(worst, 0.5, "mm: the native way is nearly that of the page")

    def test_a_recording_after_an_undo(self) -> None:
        self.open("#gears")
        self.pull([0, 0, 8], 0, -60)
        kept = self.pose()
        self.pull([0, 0, 8], 60, 0)
        self.click("#undo")
        self.wait_for_pose(kept)
        self.replayed("planet gear", ["sun-gear", "ground"])


class Links(PlaygroundTest):
    def test_a_link_keeps_scene_and_pose_to_the_last_bit(self) -> None:
        self.open("#gears")
        self.pull([0, 0, 8], 20, -60)
        pose = self.pose()
        self.click("#share")
        self.wait_until("location.hash.includes('pose=')")
        fragment = self.evaluate("location.hash")
        self.open(fragment)
        self.assertEqual(self.pose(), pose)
        self.assertEqual(self.evaluate("document.getElementById('scene').value"), "gears")
        self.click("#reset")
        self.wait_until("playground.pose()[2] === 0.2")

    def test_links_that_cannot_be_used_say_why(self) -> None:
        for fragment, why in [
            ("#nowhere", 'no scene "nowhere"'),
            ("#nut&pose=1,2,3", "not seven numbers"),
            ("#nut&pose=0,0,8,0,0,0,0", "no turn"),
            ("#nut&pose=0,0,8,x,0,0,0", "not seven numbers"),
            ("#nut&pose=3,0,8,1,0,0,0", "overlap"),
        ]:
            self.open(fragment)
            self.assertIn(why, self.text("#trouble-text"), fragment)
            self.assertTrue(self.text("#trouble-text").startswith("This link cannot be used: "), fragment)
            self.assertEqual(self.evaluate("playground.app.hand.scene.id"), "nut")
            self.click("#dismiss")
            self.assertTrue(self.is_hidden("#trouble"))


class Appearance(PlaygroundTest):
    def tab(self, modifiers: int = 0) -> None:
        for kind in ["keyDown", "keyUp"]:
            self.browser.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9, modifiers=modifiers)

    def test_every_control_has_a_name_and_a_visible_focus(self) -> None:
        self.open("#robot")
        nameless = self.evaluate(
            "[...document.querySelectorAll('button, select, input, canvas, a, summary')].filter(e => !(e.labels?.length || "
            "e.getAttribute('aria-label') || e.innerText?.trim())).map(e => e.outerHTML)"
        )
        self.assertEqual(nameless, [])
        focused = set()
        for _ in range(20):
            self.tab()
            name, outline = self.evaluate(
                "(e => [e.id || e.tagName, getComputedStyle(e.type === 'radio' ? e.nextElementSibling : e).outlineStyle])(document.activeElement)"
            )
            focused.add(name)
            if name != "BODY":
                self.assertEqual(outline, "solid", name)
        self.assertLessEqual({"canvas", "mode-move", "scene", "joint", "reset", "files", "prove", "share", "friction", "SUMMARY"}, focused)
        self.assertEqual(self.evaluate("document.getElementById('status').getAttribute('aria-live')"), "polite")

    def test_narrow_windows_and_the_dark(self) -> None:
        self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.browser.resize(390, 780)
        try:
            self.open("#maze")
            self.assertEqual(self.evaluate("document.documentElement.scrollWidth"), 390)
            picture = self.picture("narrow_dark")
            self.assertLess(max(picture[60][3]), 60, "the background")
            self.assertGreater(count(picture, is_moving_colour), 150)
        finally:
            self.browser.call("Emulation.setEmulatedMedia", features=[])
            self.browser.resize(*SIZE)

    def test_what_has_the_focus_is_in_view_in_narrow_and_low_windows(self) -> None:
        """Also below the picture, which stays in view where there is room for it."""
        in_view = (
            "(e => { const {left, top, width, height} = (e.type === 'radio' ? e.nextElementSibling : e).getBoundingClientRect();"
            "const at = document.elementFromPoint(left + width / 2, top + Math.min(height / 2, 20));"
            "return [e.id || e.tagName, top > -1 && (at === e || e.contains(at) || at.contains(e) && at !== document.body"
            " || e.parentElement.contains(at)), at?.id ?? ''] })(document.activeElement)"
        )
        try:
            for size in [(320, 640), (640, 320), (360, 500), (800, 600)]:
                self.browser.resize(*size)
                self.open("#robot")
                focused = set()
                for modifiers in [0] * 24 + [SHIFT] * 24:
                    self.tab(modifiers)
                    name, is_seen, above = self.evaluate(in_view)
                    self.assertTrue(is_seen or name == "BODY", f"{name} below {above} at {size}")
                    focused.add(name)
                self.assertLessEqual({"canvas", "scene", "prove", "share", "SUMMARY"}, focused)
        finally:
            self.browser.resize(*SIZE)


if __name__ == "__main__":
    sys.exit(main())
