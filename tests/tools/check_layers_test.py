#!/usr/bin/env python3
"""The layer check can fail: each test breaks one rule in a small tree."""

import unittest

from small_tree import SmallTree

import check_layers  # in the folder that small_tree adds

SOUND = {
    "chasles/chasles.h": '#include "chasles/query/first_contact.h"\n',
    "chasles/base/invalid_input.h": "#include <string>\n",
    "chasles/algebra/bernstein.h": "#include <array>\n",
    "chasles/motion/pose.h": '#include "chasles/algebra/bernstein.h"\n#include "chasles/base/invalid_input.h"\n',
    "chasles/elementary/plane.h": '#include "chasles/motion/pose.h"\n',
    "chasles/mesh/box.h": "#include <vector>\n",
    "chasles/mesh/box.cpp": '#include "chasles/mesh/box.h"\n',
    "chasles/query/first_contact.h": '#include "chasles/mesh/box.h"\n#include "chasles/motion/pose.h"\n',
    "chasles/io/file.h": '#include "chasles/mesh/box.h"\n',
    "scenes/bolt.h": '#include "chasles/mesh/box.h"\n',
    "examples/shapes.h": "#include <chasles/chasles.h>\n",
    "playground/shapes.cpp": '#include "examples/shapes.h"\n#include "scenes/bolt.h"\n',
    "cli/main.cpp": '#include "chasles/chasles.h"\n#include "scenes/bolt.h"\n',
    "tests/mesh/box_test.cpp": '#include "chasles/io/file.h"\n#include <gtest/gtest.h>\n',
}


class CheckLayers(SmallTree):
    sound = SOUND
    check = check_layers

    def test_sound_tree_passes(self):
        self.assertEqual(self.violations_with(), [])

    def test_upward_include_is_found_with_its_line(self):
        text = '#include <array>\n#include "chasles/motion/pose.h"\n'
        self.assert_violation("chasles/algebra/bernstein.h", text, "algebra must not know of motion")
        self.assertIn(":2:", self.violations_with(**{"chasles/algebra/bernstein.h": text})[0])

    def test_mesh_knows_nothing_of_motion(self):
        self.assert_violation("chasles/mesh/box.cpp", '#include "chasles/motion/pose.h"\n', "mesh must not know of motion")

    def test_io_knows_nothing_of_queries(self):
        self.assert_violation("chasles/io/file.h", '#include "chasles/query/first_contact.h"\n', "io must not know")

    def test_library_knows_nothing_of_its_faces(self):
        text = SOUND["chasles/query/first_contact.h"] + '#include "scenes/bolt.h"\n'
        self.assert_violation("chasles/query/first_contact.h", text, "query must not know of scenes")

    def test_playground_knows_nothing_of_files(self):
        self.assert_violation("playground/shapes.cpp", '#include "chasles/io/file.h"\n', "playground must not know of io")

    def test_layers_do_not_include_the_whole_surface(self):
        self.assert_violation("chasles/io/file.h", '#include "chasles/chasles.h"\n', "whole surface")

    def test_relative_include_is_found(self):
        self.assert_violation("chasles/mesh/box.cpp", '#include "box.h"\n', "not a file of the project")

    def test_own_header_in_angle_brackets_is_found(self):
        self.assert_violation("chasles/mesh/box.cpp", "#include <chasles/mesh/box.h>\n", "in quotes")

    def test_missing_header_is_found_in_tests_too(self):
        self.assert_violation("tests/mesh/box_test.cpp", '#include "chasles/mesh/ball.h"\n', "not a file of the project")

    def test_unknown_layer_is_found(self):
        self.assert_violation("chasles/magic/wand.h", '#include "chasles/mesh/box.h"\n', '"magic" is not a layer')

    def test_indented_include_is_found(self):
        self.assert_violation("chasles/mesh/box.cpp", '  #  include "chasles/motion/pose.h"\n', "must not know")

    def test_what_a_layer_may_include_is_closed(self):
        """No layer learns of a layer through another one: what mine may include, I may include. Faces learn less."""
        for layer, allowed in check_layers.MAY_INCLUDE.items():
            for below in allowed if layer not in check_layers.FACES else []:
                self.assertLessEqual(set(check_layers.MAY_INCLUDE[below]), set(allowed), f"{layer} -> {below}")


if __name__ == "__main__":
    unittest.main()
