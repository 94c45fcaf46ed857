#!/usr/bin/env python3
"""The nut dragged by a restless mouse: how long frames and updates take, and that nothing goes through anything.

Usage: frames_test.py PAGE CHROMIUM CHASLES [FOLDER], see playground.py. CHASLES_LONG=1 in the environment: 10,000
updates instead of 300. What was recorded is proven by the native program, and poses of it are tested by code of its own (overlap.py).
"""

import json
import math
import os
import pathlib
import random
import re
import sys
import time

from overlap import do_cross, mesh_in, moved
from playground import SHIFT, PlaygroundTest, chasles, main, poses_in, quantile, run

UPDATES = 10_000 if os.environ.get("CHASLES_LONG") else 300
DRAG = 250  # mouse events of one drag
SAMPLES = 12  # poses that are tested for crossing triangles
FRAME = 1 / 60
NUT = "#nut&friction=0.3"  # which holds the nut on its bolt, where the mouse pulls it up


class Frames(PlaygroundTest):
    def restless(self, dice: random.Random, modifiers: int) -> None:
        """One drag: the mouse wanders around a place of the nut, in and out."""
        turn = dice.uniform(-0.9, 0.9)
        x, y = self.on_part([12 * math.sin(turn), -12 * math.cos(turn), 2])
        self.mouse("mouseMoved", x, y, button="none")
        self.mouse("mousePressed", x, y, modifiers=modifiers)
        phases = [dice.uniform(0, 2 * math.pi) for _ in range(4)]
        began = time.monotonic()
        for i in range(DRAG):
            at = i * FRAME
            right = 90 * math.sin(2.1 * at + phases[0]) + 40 * math.sin(5.3 * at + phases[1])
            down = 60 * math.sin(1.7 * at + phases[2]) + 30 * math.sin(6.1 * at + phases[3])
            self.mouse("mouseMoved", x + right, y + down, modifiers=modifiers)
            time.sleep(max(0.0, began + at - time.monotonic()))
        self.mouse("mouseReleased", x, y)
        self.wait_until("playground.app.hand.grip === undefined")
        self.evaluate("playground.atRest()")

    def test_a_restless_hand(self) -> None:
        """With all that a picture costs. Without a graphics card this is most of the time of two cores."""
        self.drag_restlessly(self.open(NUT))

    def test_where_drawing_costs_nothing(self) -> None:
        """As with a graphics card: all but the drawing itself."""
        ready = self.open(NUT)
        self.evaluate("(stage => { stage.drawNow = () => { stage.drawing = false } })(playground.app.view.stage)")
        self.drag_restlessly(ready)

    def drag_restlessly(self, ready: float) -> None:
        dice = random.Random(7)
        drags = 0
        while self.evaluate("playground.app.hand.session.goals.length") < UPDATES:
            self.restless(dice, SHIFT if drags % 3 == 1 else 0)
            drags += 1
            self.assertLess(drags, 20 + UPDATES, "the part can be taken")
        timings = self.evaluate("[playground.app.hand.timings.frames, playground.app.hand.timings.updates]")
        for name, values, limit in zip(["frame", "update"], timings, [17, 8]):
            within = sum(value <= limit for value in values) / len(values)
            parts = ", ".join(f"{share:g} of them within {quantile(values, share):.2f}" for share in (0.5, 0.9, 0.99, 1))
            print(f"  {len(values)} {name}s, ms: {parts}; {100 * within:.2f} % within {limit} ms")
        print(f"  ready after {ready:.0f} ms; {drags} drags")
        self.assertLess(quantile(timings[1], 0.5), 50, "an update, even on a busy machine")
        words = self.evaluate("playground.app.hand.timings.words")
        self.assertRegex(words, r"^\d+ frames a second · half of the updates take up to [\d.]+ ms, 99 % up to [\d.]+ ms$")
        half, most = map(float, re.findall(r"up to ([\d.]+)", words))
        self.assertLessEqual(half, most)
        self.check()

    def check(self) -> None:
        saved = self.saved()
        way, reached = (poses_in((saved / f"{name}.csv").read_text()) for name in ("way", "reached"))
        self.assertGreaterEqual(len(reached), UPDATES)
        self.check_samples(saved, reached)
        if not chasles:
            return
        began = time.monotonic()
        proof = json.loads(run("path", "nut.obj", "bolt.obj", "--poses", "way.csv", "--json", cwd=saved).stdout)
        print(f"  natively: {proof['verdict']} on {len(way) - 1} pieces, {time.monotonic() - began:.1f} s")
        self.assertEqual(proof["verdict"], "clear")

    def check_samples(self, saved: pathlib.Path, reached: list) -> None:
        vertices, triangles = mesh_in((saved / "nut.obj").read_text())
        bolt = mesh_in((saved / "bolt.obj").read_text())
        nut_at = lambda pose: ([moved(pose, vertex) for vertex in vertices], triangles)  # noqa: E731
        for pose in random.Random(1).sample(reached, min(SAMPLES, len(reached))):
            self.assertFalse(do_cross(nut_at(pose), bolt), pose)
        for push in ([0.9, 0, 0], [0, 0, 1.4]):  # what would be found
            wrong = [value + (push[i] if i < 3 else 0) for i, value in enumerate([0, 0, 12, 1, 0, 0, 0])]
            self.assertTrue(do_cross(nut_at(wrong), bolt), "the test sees a nut in its bolt")


if __name__ == "__main__":
    sys.exit(main())
