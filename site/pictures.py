#!/usr/bin/env python3
"""Lets the project's own programs write pages, takes their pictures in a browser, and writes the page that shows them.

Usage: pictures.py BUILD MADE. BUILD has the programs. Pages go to MADE/extra/pages, pictures, in light and in dark, and the
page of the site to MADE/source. A page is written again only if its program is newer.
"""

import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "view"))
from devtools import Browser  # noqa: E402

SIZE = (960, 560)
THEMES = ["light", "dark"]


@dataclass
class Example:
    """A page: how it is made, and which part of its time the picture shows."""

    name: str
    title: str
    text: str
    command: list[str]  # "OUT" stands for the file of the page
    part: float = 1.0
    folder: str = "examples/scene"  # where the command runs; "" for the folder with the demo's meshes


EXAMPLES = [
    Example(
        "nut", "A contact", "A nut on its way onto a bolt touches the thread. The slider stops at the contact.",
        ["chasles", "view", "nut.obj", "bolt.obj", "--start", "26 -14 46 0.8 0.5 -0.1 0.4", "--goal", "0 0 22",
         "--title", "A nut on its way onto a bolt", "--out", "OUT"], 1.0, "",
    ),
    Example(
        "pulled_nut", "A nut on its thread",
        "A hand pulls a nut straight up. The thread turns the nut, and so the nut comes off.", ["pulled_nut", "OUT"], 0.45,
    ),
    Example(
        "key_in_maze", "A key in a maze", "A hand pulls a key straight to the exit. The walls turn the key and lead it out.",
        ["key_in_maze", "OUT"], 0.4,
    ),
    Example(
        "piano_through_door", "A piano and a door", "A hand carries a piano through a door, which it fits only by turning.",
        ["piano_through_door", "OUT"], 0.45,
    ),
    Example(
        "turning_gears", "Gears", "A hand turns one gear on its axle. The teeth push the second gear.", ["turning_gears", "OUT"], 0.5,
    ),
    Example(
        "three_cubes", "A scene", "Four bodies move, and the page lists which pairs touch, in order of time.",
        ["chasles", "scene", "three_cubes.json", "--all", "--page", "OUT"], 0.49,
    ),
    Example(
        "robot", "A robot", "A robot follows a path in joint space until a finger touches the table.",
        ["chasles", "robot", "arm.urdf", "--path", "path.csv", "--scene", "cell.json", "--page", "OUT"], 1.0, "examples/robot",
    ),
    Example(
        "dominoes", "Dominoes", "A simulation that steps from contact to contact: nothing goes through anything.",
        ["dominoes", "OUT"], 0.5,
    ),
]  # fmt: skip


def write_page(example: Example, build: pathlib.Path, pages: pathlib.Path) -> pathlib.Path:
    program = build / "bin" / example.command[0]
    out = pages / f"{example.name}.html"
    if out.is_file() and out.stat().st_mtime > program.stat().st_mtime:
        return out
    folder = ROOT / example.folder if example.folder else pages.parent.parent / "meshes"
    arguments = [str(out) if word == "OUT" else word for word in example.command[1:]]
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    if not out.is_file():
        raise SystemExit(f"site/pictures.py: {' '.join(example.command)} wrote no page:\n{done.stdout}{done.stderr}")
    return out


def take_pictures(browser: Browser, example: Example, page: pathlib.Path, pictures: pathlib.Path) -> None:
    for theme in THEMES:
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": theme}])
        browser.open(page.as_uri(), "!!window.chasles")
        browser.evaluate("window.chasles.ready")
        browser.evaluate(
            "(({min, max}) => chasles.setTime(Number(min) + (Number(max) - Number(min)) * %g))(document.getElementById('time'))"
            % example.part
        )
        (pictures / f"{example.name}-{theme}.png").write_bytes(browser.screenshot())


def section(example: Example) -> str:
    shown = " ".join("page.html" if word == "OUT" else f'"{word}"' if " " in word else word for word in example.command)
    pictures = "\n".join(
        f"```{{image}} pictures/{example.name}-{theme}.png\n:alt: {example.text}\n:class: only-{theme}\n:target: pages/{example.name}.html\n```" for theme in THEMES
    )
    return (
        f"## {example.title}\n\n{example.text} <a href=\"pages/{example.name}.html\">Open the page</a>.\n\n{pictures}\n\n"
        f"    {shown}\n"
    )


INTRODUCTION = """# Pictures to turn

The programs of the project wrote these pages. Each page is one file that needs no network: drag to turn, scroll to zoom, and
play the motion with the space key. The line below a picture is the command; `chasles demo --save .` writes the nut and the
bolt, and the other files are in `examples/`.
"""


def main() -> int:
    build, made = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    pages, pictures, meshes = made / "extra" / "pages", made / "source" / "pictures", made / "meshes"
    for folder in (pages, pictures, meshes):
        folder.mkdir(parents=True, exist_ok=True)
    if not (meshes / "nut.obj").is_file():
        subprocess.run([build / "bin" / "chasles", "demo", "--save", meshes], stdout=subprocess.DEVNULL, check=True)
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        raise SystemExit("site/pictures.py: there is no chromium to take pictures with")
    with Browser(chromium, *SIZE, patience=120) as browser:
        for example in EXAMPLES:
            take_pictures(browser, example, write_page(example, build, pages), pictures)
    text = "\n".join([INTRODUCTION, *map(section, EXAMPLES)])
    (made / "source" / "gallery.md").write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
