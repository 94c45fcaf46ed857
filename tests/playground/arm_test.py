#!/usr/bin/env python3
"""The arm of the playground in a headless Chromium: its joints, links to it, and recordings.

Usage: arm_test.py PAGE CHROMIUM CHASLES [FOLDER], see playground.py.
"""

import math
import sys
import unittest

from playground import SHIFT, PlaygroundTest, angle, chasles, count, is_moving_colour, main

ELBOW, WRIST = [160, 0, 240], [300, 0, 240]  # where the arm is stretched along x
ON_FOREARM, ON_UPPER_ARM, ON_QUILL = [220, 0, 255], [60, 0, 229], [300, 0, 344]
RING = (150, 190)


def carried(pose: list, point: list) -> list:
    """A point of a link, which turns about z only."""
    turn = 2 * math.atan2(pose[6], pose[3])
    x, y, z = point
    return [pose[0] + x * math.cos(turn) - y * math.sin(turn), pose[1] + x * math.sin(turn) + y * math.cos(turn), pose[2] + z]


def joints_above(x: float, y: float) -> str:
    """The link of the page that has the quill above a place, with the elbow in the hand: by the law of cosines."""
    elbow = math.acos((x * x + y * y - 160**2 - 140**2) / (2 * 160 * 140))
    shoulder = math.atan2(y, x) - math.atan2(140 * math.sin(elbow), 160 + 140 * math.cos(elbow))
    return f"#robot&joints=1,{shoulder!r},0,{elbow!r},0,0,0"


class RobotArm(PlaygroundTest):
    def joint(self) -> str:
        return self.evaluate("document.getElementById('joint').selectedOptions[0].innerText")

    def values(self) -> list:
        return self.evaluate("playground.app.present.arm.values.flatMap(({turn, slide}) => [turn, slide])")

    def assert_near(self, found: list, expected: list, tolerance: float = 1e-9) -> None:
        self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), tolerance, f"{found} instead of {expected}")

    def test_every_link_is_dragged_by_its_joint(self) -> None:
        self.open("#robot")
        self.assertEqual(self.joint(), "Elbow: the forearm")
        self.assertTrue(self.evaluate("document.getElementById('loose').disabled"))
        start = self.pose()
        self.pull(ON_FOREARM, 90, -50)
        self.assertGreater(angle(self.pose(), start), 0.1)
        self.assert_near(carried(self.pose(), ELBOW), carried(start, ELBOW))
        before = self.values()
        x, y = self.on_part(WRIST)
        self.click("#joint")  # opens the list, which the keyboard then uses
        self.press("Escape")
        self.evaluate("playground.app.chooseJoint(0)")
        self.assertEqual(self.joint(), "Shoulder: the upper arm")
        self.pull(ON_UPPER_ARM, 60, -10)
        self.assert_near([*self.pose()[:3], *self.pose()[4:6]], [0, 0, 0, 0, 0])
        after = self.values()
        self.assertGreater(abs(after[0] - before[0]), 0.1)
        self.assert_near(after[1:], before[1:])
        self.assertGreater(math.dist(self.on_part([0, 0, 0]), (x, y)), 1)

    def test_a_link_that_is_grabbed_takes_its_joint_into_the_hand(self) -> None:
        self.open("#robot")
        view = self.evaluate("playground.app.view.axes().right.x")
        start = self.values()
        self.pull(ON_QUILL, 0, -60)
        self.assertEqual(self.joint(), "Quill: the quill")
        self.assertGreater(self.values()[5], 10)
        self.assert_near(self.values()[:5], start[:5])
        self.assertIn("Proven clear", self.prove())
        self.assertEqual(self.evaluate("playground.app.view.axes().right.x"), view)
        self.click("#reset")
        self.wait_until("playground.app.present.arm.values[2].slide === 0")
        self.assert_near(self.values(), start)

    def test_hasty_hands_leave_a_whole_arm(self) -> None:
        """Links that are grabbed before the one before them is in the hand."""
        self.open("#robot")
        places = [self.on_part(point) for point in (ON_QUILL, ON_FOREARM)] + [(330, 190)]
        for i in range(12):
            x, y = places[i % 3]
            self.mouse("mousePressed", x, y)
            self.mouse("mouseMoved", x + 5, y - 5)
            if i % 4 == 0:
                self.press("j")
            self.mouse("mouseReleased", x + 5, y - 5)
        self.wait_until("playground.app.hand.grip === undefined")
        moving, named, pose, lock, here = self.evaluate(
            """(async () => {
                 for (let seen; seen !== playground.app.opening; await new Promise((after) => setTimeout(after, 300))) {
                   seen = playground.app.opening;  // a joint that waits for the hand to let go opens another scene later
                   await seen.then(() => playground.atRest());
                 }
                 const { opened, scene: { spec }, pose } = playground.app.hand;
                 return [opened.moving.name, spec.moving, pose, spec.lock.point, spec.start];
               })()""")
        self.assertEqual(moving, named)
        back = [lock[0] - here[0], lock[1] - here[1], 0]
        turn = 2 * math.atan2(here[6], here[3])
        point = [back[0] * math.cos(turn) + back[1] * math.sin(turn), back[1] * math.cos(turn) - back[0] * math.sin(turn), 0]
        self.assert_near(carried(pose, point)[:2], lock[:2])
        self.assertTrue(all(math.isfinite(value) for value in self.values()))
        self.assertEqual(self.text("#trouble-text"), "")

    def test_the_quill_fits_into_the_ring_which_then_holds_the_arm(self) -> None:
        self.open(joints_above(*RING))
        self.assert_near(carried(self.pose(), WRIST), [*RING, 240])
        self.evaluate("playground.app.chooseJoint(2)")
        self.pull(ON_QUILL, 0, 200)
        self.assertEqual(self.text("#status"), "The quill stays where it is, at the forearm.")
        self.assert_near(self.values()[5:], [330 - 269.5], 121)
        self.assertLess(self.values()[5], -60, "the lower end is at 36, the ring is 70 high")
        self.assertIn("Proven clear", self.prove())
        free = self.values()
        self.evaluate("playground.app.chooseJoint(0)")
        self.pull(ON_UPPER_ARM, 120, 60, release=False)
        self.assertIn("the ring blocks it.", self.text("#status"))
        moved = abs(self.values()[0] - free[0]) * math.hypot(*RING)
        self.assertLess(moved, 2.3, "mm of the quill, which has 2 mm of play in the facets of the ring")
        self.mouse("mouseReleased", 10, 10)
        self.wait_until("playground.app.hand.grip === undefined")

    def test_keys_choose_a_joint_and_move_it(self) -> None:
        self.open("#robot")
        self.evaluate("document.getElementById('canvas').focus()")
        start = self.values()
        for key, modifiers in [("ArrowUp", 0), ("ArrowLeft", SHIFT)]:
            before = self.values()
            self.press(key, modifiers)
            self.evaluate("playground.atRest()")
            self.assertGreater(abs(self.values()[2] - before[2]), 0.05)
        self.wait_until("playground.app.hand.grip === undefined")
        self.press("j")
        self.wait_until("playground.app.hand.scene.arm.active === 2")
        self.press("ArrowUp")
        self.evaluate("playground.atRest()")
        self.assertGreater(self.values()[5], 2)
        self.assertEqual(self.values()[:2], start[:2])

    def test_a_link_keeps_the_joints(self) -> None:
        self.open("#robot")
        self.pull(ON_FOREARM, 60, -30)
        values = self.values()
        self.click("#share")
        self.wait_until("location.hash.includes('joints=')")
        self.open(self.evaluate("location.hash"))
        self.assertEqual(self.values(), values)
        for fragment, why in [
            ("#robot&joints=1,0,0", "joints are not those of the robot arm"),
            ("#robot&joints=7,0,0,0,0,0,0", "joints are not those of the robot arm"),
            ("#robot&joints=1,x,0,0,0,0,0", "joints are not numbers"),
            ("#robot&joints=2,0,0,0,0,0,140", "overlap"),
            ("#robot&friction=-1", "friction is no number from 0 to 100"),
        ]:
            self.open(fragment)
            self.assertIn(why, self.text("#trouble-text"), fragment)

    def test_in_the_dark(self) -> None:
        self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        try:
            self.open("#robot")
            picture = self.picture("robot_dark")
            self.assertLess(max(picture[150][10]), 60, "the background")
            self.assertGreater(count(picture, is_moving_colour), 800, "forearm and quill")
        finally:
            self.browser.call("Emulation.setEmulatedMedia", features=[])

    @unittest.skipUnless(chasles, "no native program")
    def test_a_saved_joint_runs_by_the_native_program(self) -> None:
        self.open("#robot&friction=0.3")
        self.evaluate("playground.app.chooseJoint(0)")
        self.pull(ON_UPPER_ARM, 200, 0)
        self.assertIn("at the posts", self.text("#status"))
        reached, out = self.replayed("upper arm", ["pedestal", "posts", "ring"])
        command = (self.saved() / "README.txt").read_text()
        self.assertIn('--friction 0.3 --lock hinge --lock-axis "0 0 1" --lock-point "0 0 0"', command)
        for pose in out:
            self.assertLess(max(abs(part) for part in [*pose[:3], *pose[4:6]]), 1e-9, "natively on its hinge, too")
        self.assertLess(max(angle(a, b) for a, b in zip(reached, out)), 0.01)


if __name__ == "__main__":
    sys.exit(main())
