#!/usr/bin/env python3
"""Files dropped on the playground: good ones are dragged, bad ones are told apart in words, and the page goes on.

Usage: files_test.py PAGE CHROMIUM CHASLES [FOLDER], see playground.py.
"""

import json
import pathlib
import struct
import sys
import time
import zlib

from playground import SIZE, PlaygroundTest, chasles, count, folder, is_moving_colour, main, poses_in, run

CUBE = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
OPEN = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n"


def picture_file() -> bytes:
    """A PNG of one pixel."""
    part = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))  # noqa: E731
    head = struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + part(b"IDAT", zlib.compress(b"\0\0\0\0")) + part(b"IEND", b"")


def million_triangles() -> bytes:
    """A binary STL of a wavy surface of 1000 by 500 squares."""
    rows, columns = 500, 1000
    height = [[(x * 7 + y * 13) % 5 * 0.1 for x in range(columns + 1)] for y in range(rows + 1)]
    parts = [b"\0" * 80, struct.pack("<I", 2 * rows * columns)]
    for y in range(rows):
        low, high = height[y], height[y + 1]
        for x in range(columns):
            a, b = (x, y, low[x]), (x + 1, y, low[x + 1])
            c, d = (x + 1, y + 1, high[x + 1]), (x, y + 1, high[x])
            parts.append(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) + struct.pack("<12fH", 0, 0, 0, *a, *c, *d, 0))
    return b"".join(parts)


def write(name: str, content: str | bytes) -> pathlib.Path:
    file = folder / name
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    return file


class Files(PlaygroundTest):
    def refused(self, *files: pathlib.Path, seconds: float = 60) -> str:
        """Drops files, and returns what the page says against them. Then the scene before is dragged on."""
        before = self.evaluate("playground.app.hand.scene.id")
        self.evaluate("document.getElementById('dismiss').click()")
        self.drop(*files)
        self.wait_until("!document.getElementById('trouble').hidden", seconds)
        words = self.text("#trouble-text")
        self.assertEqual(self.evaluate("playground.app.hand.scene.id"), before)
        self.goes_on()
        return words

    def goes_on(self) -> None:
        start = self.pose()
        self.pull(self.evaluate("playground.app.hand.inertia.centre.toArray()"), 12, -8, steps=4)
        self.assertNotEqual(self.pose(), start)
        self.evaluate("playground.app.undo()")
        self.assertEqual(self.pose(), start)

    def test_files_that_are_no_meshes(self) -> None:
        self.open("#peg")
        for file, words in [
            (write("broken.obj", CUBE[:30] + "v 1 zwei 3\n"), ["broken.obj", "line 4"]),
            (write("cut.stl", million_triangles()[:100]), ["cut.stl"]),
            (write("index.obj", CUBE + "f 1 2 9\n"), ["index.obj", "9"]),
            (write("nan.obj", CUBE.replace("v 1 1 1", "v 1 nan 1")), ["nan.obj", "line 7"]),
            (write("photo.png", picture_file()), ["photo.png"]),
            (write("photo.obj", picture_file()), ["photo.obj"]),
            (write("empty.ply", ""), ["empty.ply"]),
            (write("notes.txt", "hello"), ["notes.txt"]),
            (write("points.obj", "v 0 0 0\nv 1 0 0\n"), ["points.obj: has no face; a mesh needs at least one"]),
            (write("cloud.xyz", "0 0 0\n"), ["cloud.xyz: is a cloud of points, not a mesh"]),
        ]:
            said = self.refused(file)
            self.assertNotIn("chasles.points", said)
            for word in words:
                self.assertIn(word, said)
            print(f"  {said}")

    def test_a_million_triangles(self) -> None:
        self.open("#peg")
        file = write("million.stl", million_triangles())
        self.drop(file)
        self.goes_on()  # while the file is being read
        self.wait_until("!document.getElementById('trouble').hidden", 180)
        words = self.text("#trouble-text")
        self.assertIn("million.stl: has 1,000,000 triangles; this page drags bodies of up to 200,000", words)
        self.goes_on()
        file.unlink()

    def test_two_files_are_dragged(self) -> None:
        self.open("#nut")
        self.drop(write("my cube.obj", CUBE), write("tetrahedron.off", TETRAHEDRON))
        self.wait_until("playground.app.hand.scene.id === 'own'")
        self.assertEqual(self.evaluate("location.hash"), "", "the address does not name the scene before")
        self.assertIn("tetrahedron.off is dragged, my cube.obj stands", self.text("#about"))
        self.assertTrue(self.is_hidden("#trouble"))
        start = self.pose()
        self.assertGreater(start[0], 1)
        self.assertGreater(count(self.picture("own"), is_moving_colour), 300)
        self.pull([0.3, 0.2, 0.2], -250, 0, release=False)
        self.assertIn("The tetrahedron.off rests: the my cube.obj blocks it.", self.text("#status"))
        self.mouse("mouseReleased", 10, 10)
        self.assertIn("Proven clear", self.prove())
        if chasles:
            self.check_saved()
        self.click("#swap")
        self.wait_until("playground.app.hand.scene.spec.moving === 'my cube.obj'")
        self.click("#share")
        self.assertIn("cannot hold your files", self.text("#kept"))

    def check_saved(self) -> None:
        saved = self.saved()
        self.assertEqual((saved / "my-cube.obj").read_text(), CUBE)
        self.assertEqual((saved / "tetrahedron.off").read_text(), TETRAHEDRON)
        command = next(line for line in (saved / "README.txt").read_text().splitlines() if line.startswith("chasles drag "))
        self.assertIn("--triangulate", command)
        margin = command.split("--margin ")[1].split()[0]
        more = ["--goals", "hand.csv", "--out", "out.csv", "--margin", margin, "--triangulate", "--json"]
        replay = run("drag", "scene.json", "--body", "tetrahedron.off", *more, cwd=saved)
        self.assertEqual(replay.returncode, 1, replay.stderr)
        self.assertGreater(json.loads(replay.stdout)["in_contact"], 0)
        self.assertEqual(len(poses_in((saved / "hand.csv").read_text())), json.loads(replay.stdout)["updates"])

    def test_one_file_waits_for_another_and_an_open_one_is_named(self) -> None:
        self.open("#nut")
        self.drop(write("cube.obj", CUBE))
        self.wait_until("playground.app.hand.scene.id === 'own'")
        self.assertIn("drop a second file", self.text("#about"))
        self.goes_on()
        self.assertIn("nothing to touch", self.prove())
        self.drop(write("cube.obj", CUBE))
        self.wait_until("playground.app.hand.scene.spec.bodies.length === 2")
        self.assertEqual(self.evaluate("playground.app.hand.scene.spec.moving"), "cube.obj (2)")
        self.drop(write("open.obj", OPEN))
        self.wait_until("playground.app.hand.scene.spec.moving === 'open.obj'")
        self.assertIn("open.obj is open", self.text("#trouble-text"))
        turned = [" ".join(["f", *line.split()[:0:-1]]) if line.startswith("f") else line for line in CUBE.splitlines()]
        self.drop(write("room.obj", "\n".join(turned) + "\n"))
        self.wait_until("playground.app.hand.scene.spec.moving === 'room.obj'")
        self.assertIn("room.obj is turned inwards: nothing in it is solid", self.text("#trouble-text"))

    def test_a_page_of_320_pixels(self) -> None:
        """Nothing lies on anything else, and nothing is wider than the page, also with long names of files."""
        self.open("#nut")
        name = "a_rather_long_name_without_any_space_in_it.obj"
        self.drop(write(name, CUBE), write(f"{name[:-3]}off", TETRAHEDRON))
        self.wait_until("playground.app.hand.scene.id === 'own'")
        self.pull([0.3, 0.2, 0.2], -250, 0)
        try:
            for width, height in [(320, 568), (360, 640), (568, 320), (821, 400)]:
                self.browser.resize(width, height)
                self.picture(f"narrow_{width}")
                wide = "[...document.querySelectorAll('body *')].filter((e) => !e.closest('table') && e.getBoundingClientRect().right > innerWidth + 0.5).map((e) => e.id)"
                self.assertEqual(self.evaluate(wide), [])
                self.assertEqual(self.evaluate("document.documentElement.scrollWidth"), width)
                boxes = self.evaluate(
                    "['#modes', '#views', '#legend'].map((id) => { const { left, top, right, bottom } = document.querySelector(id).getBoundingClientRect(); return [left, top, right, bottom]; })"
                )
                for i, first in enumerate(boxes):
                    for second in boxes[:i]:
                        self.assertTrue(first[0] >= second[2] or second[0] >= first[2] or first[1] >= second[3] or second[1] >= first[3], f"{width}: {boxes}")
                self.click("#mode-turn + span")
                self.click("#look-front")
        finally:
            self.browser.resize(*SIZE)

    def test_a_worker_that_stops_is_replaced(self) -> None:
        self.open("#nut")
        self.pull([0, -12, 2], 10, 0)
        pose = self.pose()
        self.evaluate("playground.app.hand.engine.worker.onerror({message: 'stack overflow'})")
        x, y = self.on_part([0, -12, 2])
        self.evaluate("playground.app.hand.engine.ask = () => Promise.reject(new Error('out of stack'))")
        self.mouse("mousePressed", x, y)
        self.mouse("mouseMoved", x + 5, y)
        self.wait_until("!document.getElementById('trouble').hidden")
        self.mouse("mouseReleased", x, y)
        self.assertIn("out of stack", self.text("#trouble-text"))
        self.assertEqual(self.pose(), pose)
        time.sleep(0.1)
        self.pull([0, -12, 2], 60, 0, modifiers=8)
        self.assertNotEqual(self.pose(), pose)
        self.assertIn("Proven clear", self.prove())


if __name__ == "__main__":
    sys.exit(main())
