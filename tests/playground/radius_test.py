#!/usr/bin/env python3
"""The radii of the playground: they hold the bodies apart, are drawn, saved and kept in the link, and wrong ones are refused.

Usage: radius_test.py PAGE CHROMIUM CHASLES [FOLDER], see playground.py.
"""

import json
import sys
import unittest

from playground import PlaygroundTest, chasles, main

TOP = 14  # mm; of the plate


class Radii(PlaygroundTest):
    def fields(self) -> list:
        return self.evaluate("['radius-moving', 'radius-standing'].map((id) => document.getElementById(id).value)")

    def choose(self, field: str, value: str, is_refused: bool = False) -> None:
        """As a hand does: types, and leaves the field."""
        element = f"document.getElementById('radius-{field}')"
        self.evaluate(f"({element}.focus(), {element}.select())")
        self.browser.call("Input.insertText", text=value)
        self.evaluate(f"{element}.blur()")
        if is_refused:
            self.wait_until("!document.getElementById('trouble').hidden")
        else:
            index = ["moving", "standing"].index(field)
            self.wait_until(f"playground.app.hand.scene.spec.radii[{index}] === {float(value or 0)}")

    def height_on_plate(self) -> float:
        """Straight down, by updates as a drag asks for them."""
        ask = "playground.app.hand.engine.ask('update', {goal: [-4, -22, 5, 1, 0, 0, 0], seconds: 1})"
        for _ in range(20):
            height = self.evaluate(f"{ask}.then(({{ pose }}) => pose[2])")
        return height

    def test_radii_hold_the_peg_above_the_plate(self) -> None:
        self.open("#peg")
        self.assertEqual(self.fields(), ["0", "0"])
        bare = self.height_on_plate()
        self.assertAlmostEqual(bare, TOP, delta=0.1)
        self.click("#reset")
        self.choose("moving", "1")
        self.choose("standing", "0.5")
        self.assertEqual(self.evaluate("playground.app.hand.scene.spec.radii"), [1, 0.5])
        self.picture("round_peg")
        self.assertAlmostEqual(self.height_on_plate() - bare, 1.5, delta=0.02)
        self.click("#reset")
        self.pull([0, -8, 30], 20, 40)
        self.assertIn("Proven clear", self.prove())

    def test_round_bodies_are_drawn_round(self) -> None:
        box = (
            "(() => { const g = playground.app.view.bodies.find(({ shape }) => shape.name === 'peg').mesh.geometry; g.computeBoundingBox();"
            " const { min, max } = g.boundingBox; return [max.x - min.x, max.y - min.y, max.z - min.z]; })()"
        )
        self.open("#peg")
        bare = self.evaluate(box)
        self.open("#peg&radius=2")
        for side, before in zip(self.evaluate(box), bare):
            self.assertAlmostEqual(side, before + 4, places=4)
        self.open("#peg&radius=-1")
        self.assertAlmostEqual(self.evaluate(box)[2], bare[2] - 2, places=4)

    def test_a_link_keeps_the_radii(self) -> None:
        self.open("#robot")
        self.choose("moving", "0.25")
        self.choose("standing", "-0.01")
        self.click("#share")
        self.wait_until("location.hash.includes('radius=0.25,-0.01')")
        fragment = self.evaluate("location.hash")
        self.open(fragment)
        self.assertEqual(self.fields(), ["0.25", "-0.01"])
        self.assertTrue(self.is_hidden("#trouble"))
        self.evaluate("document.getElementById('scene').value = 'peg', document.getElementById('scene').dispatchEvent(new Event('change'))")
        self.wait_until("playground.app.hand.scene.id === 'peg'")
        self.assertEqual(self.fields(), ["0", "0"], "of another scene")
        self.click("#share")
        self.wait_until("location.hash.includes('pose=')")
        self.assertNotIn("radius", self.evaluate("location.hash"))

    def test_radii_that_do_not_fit_are_refused(self) -> None:
        self.open("#nut")
        self.choose("moving", "0.05")
        self.assertTrue(self.is_hidden("#trouble"))
        for value, why in [("2", "overlap"), ("-9", "nut: mesh: radius: -9 turns face"), ("1e31", "radius")]:
            self.choose("moving", value, is_refused=True)
            self.assertIn("These radii cannot be used here: ", self.text("#trouble-text"))
            self.assertIn(why, self.text("#trouble-text"))
            self.assertEqual(self.fields(), ["0.05", "0"])
            self.click("#dismiss")
        self.choose("moving", "")
        self.assertEqual(self.fields(), ["0", "0"])
        start = self.pose()
        self.pull([10, -5, 2], 0, -20)
        self.assertNotEqual(self.pose(), start)
        for fragment in ("#nut&radius=1,2,3", "#nut&radius=x", "#nut&radius="):
            self.open(fragment)
            self.assertIn("the link's radii are not two numbers", self.text("#trouble-text"))

    @unittest.skipUnless(chasles, "no native program")
    def test_a_saved_hand_has_the_radii(self) -> None:
        self.open("#peg&radius=-0.25,0.5")
        self.pull([0, -8, 30], 20, 60)
        reached, out = self.replayed("peg", ["plate", "table"])
        self.assertLess(abs(reached[-1][2] - out[-1][2]), 0.5)
        (scene,) = [json.loads(file.read_text()) for file in self.saved().glob("scene.json")]
        self.assertEqual({body["name"]: body.get("radius") for body in scene["bodies"]}, {"peg": None, "plate": 0.5, "table": 0.5})


if __name__ == "__main__":
    sys.exit(main())
