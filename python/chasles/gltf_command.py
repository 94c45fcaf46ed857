"""The program `chasles-animation`, which `chasles animation` runs: questions about animations of glTF files."""

from __future__ import annotations

import argparse
import contextlib
import json
import pathlib
import sys
from collections.abc import Sequence
from typing import Any

from . import gltf
from ._core import InvalidInput, Limit
from .enums import Verdict
from .gltf_answer import AnimationContact, untested_json
from .gltf_file import Document
from .gltf_marks import write_marked
from .program import CLEAR, CONTACT, OUT_OF_TIME, Parser, refuse_input, run


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program, and return its exit status: 0 clear, 1 contact, 2 wrong input, 3 the time was over, 130 interrupted."""
    return run(_parser(), arguments, _answer_in_time)


def _answer_in_time(options: argparse.Namespace) -> int:
    with Limit(options.seconds) if options.seconds is not None else contextlib.nullcontext():
        return _answer(options)


def _parser() -> Parser:
    parser = Parser(
        prog="chasles animation",
        description="Proves what touches first in an animation of a glTF file.",
        allow_abbrev=False,
    )
    add: Any = parser.add_argument
    add("file", metavar="SCENE.glb", help="a file .glb or .gltf")
    add(
        "--animation",
        metavar="NAME",
        action="append",
        help="the name of an animation, or its number from 0; several are played at the same time",
    )
    add("--together", action="store_true", help="play all animations of the file at the same time")
    add("--margin", metavar="D", type=float, default=0.0, help="distance that counts as contact (default 0)")
    add("--all", action="store_true", help="list the first contact of each pair")
    add("--all-contacts", action="store_true", help="list every feature pair at the time of a contact")
    add(
        "--ignore",
        metavar=("A", "B"),
        nargs=2,
        action="append",
        default=[],
        help="two bodies that are not tested against each other",
    )
    add("--ignore-touching-at-start", action="store_true", help="leave out pairs that touch at the start")
    add("--leave-out", metavar="NAME", action="append", default=[], help="a node whose mesh is no body")
    add(
        "--solid",
        choices=["automatic", "yes", "no"],
        default="automatic",
        help="whether closed meshes are solid, as of all commands",
    )
    add(
        "--radius",
        metavar="R",
        type=float,
        default=0.0,
        help="the radius of all bodies; below 0: an overlap that is allowed",
    )
    add("--mark", metavar="OUT.glb", help="write a copy of the file with a marker at each contact")
    add("--page", metavar="OUT.html", help="write a page that shows the animation and the contacts")
    add("--seconds", metavar="T", type=float, help="end after this time, with what is proven by then")
    add("--threads", metavar="N", type=int, default=0, help="at most so many (default: all cores)")
    add("--json", action="store_true", help="print one JSON object on one line")
    return parser


def _answer(options: argparse.Namespace) -> int:
    if options.together and options.animation:
        raise InvalidInput("--together plays all animations; leave out --animation")
    document = Document(options.file)  # once: it may be a pipe
    names = gltf.names_of(document)
    chosen = list(range(len(names))) if options.together else [_number(name, names) for name in options.animation or []]
    shapes: dict[str, Any] = {"solid": options.solid, "radius": options.radius, "threads": options.threads}
    animation = gltf.animation_of(document, chosen or None, leave_out=options.leave_out, **shapes)
    for out in (options.mark, options.page):
        if out is not None:
            refuse_input(out, animation.files)
    question: dict[str, Any] = {
        "margin": options.margin,
        "ignore": options.ignore,
        "ignore_touching_at_start": options.ignore_touching_at_start,
    }
    details: dict[str, Any] = {
        "find": "first_with_all_contacts" if options.all_contacts else "first",
        "threads": options.threads,
    }
    if options.all:
        found = animation.all_contacts(**question, **details)
        _print_all(animation, found, animation.untested(**question), options.json)
        has_contact, is_over = bool(found), False
    else:
        first = animation.first_contact(**question, **details)
        _print_first(first, options.json)
        found = [first]
        has_contact, is_over = first.pair is not None, first.verdict == Verdict.unknown
    sys.stdout.flush()
    if options.mark:
        write_marked(document, found, pathlib.Path(options.mark), None)
    if options.page:
        animation.view(found, options.page)
    return OUT_OF_TIME if is_over else CONTACT if has_contact else CLEAR


def _number(name: str, names: list[str]) -> str | int:
    return int(name) if name not in names and name.isdecimal() else name


def _print_first(found: AnimationContact, as_json: bool) -> None:
    if as_json:
        print(json.dumps(found.as_json()))
        return
    print(found)
    for warning in found.warnings:
        print(f"chasles: warning: {warning}", file=sys.stderr)


def _print_all(
    animation: gltf.Animation, found: list[AnimationContact], untested: gltf.Untested, as_json: bool
) -> None:
    motion = {"kind": animation.kinds, "animations": animation.animations, "duration": animation.duration}
    if as_json:
        answer = {"events": [one.event() for one in found], "untested": untested_json(untested)}
        print(json.dumps(answer | {"warnings": animation.warnings, "motion": motion}))
        return
    touch = "touches" if len(found) == 1 else "touch"
    print(
        f"{len(found)} pair{'s' * (len(found) != 1)} {touch}; animation {', '.join(map(repr, animation.animations))}, {animation.kinds}"
    )
    for one in found:
        print(f"  {one.time:<12.9g} {' on '.join(one.pair or ())}{'' if one.certain else ' (not certain)'}")
    if untested.pairs:
        print(f"  untested  {untested}")
    for warning in animation.warnings:
        print(f"chasles: warning: {warning}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
