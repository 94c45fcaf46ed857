"""The command `chasles-cad`, which `chasles cad` runs: an assembly is checked, and the exit status says what was found.

Exit status: 0 clear, 1 contact, 2 wrong input, 3 out of time, 130 interrupted.
"""

from __future__ import annotations

import argparse
import pathlib
import runpy
import sys
from typing import Any

from ._core import InvalidInput
from .program import Parser, answers_alone, beside, refuse_input, run

_OF_CHECK = ("intended", "allowed_overlap", "deflection", "angle", "least_seconds", "tolerance", "seconds")

_DESCRIPTION = "Clashes of an assembly as mounted, over the range of each joint, and over the ranges of each two joints."
_EPILOG = "Exit status: 0 clear, 1 contact, 2 wrong input, 3 out of time, 130 interrupted. The guide is docs/cad.md."


def main(arguments: list[str] | None = None) -> int:
    """Run the command, and return its exit status."""
    return run(_parser(), arguments, _checked)


def _checked(options: argparse.Namespace) -> int:
    outputs = [out for out in (options.page, options.out) if out is not None]
    for out in outputs:
        refuse_input(out, [pathlib.Path(options.model)])
    if len({pathlib.Path(out).resolve() for out in outputs}) < len(outputs):
        raise InvalidInput(f"{options.out}: is the name of two outputs")
    try:
        with answers_alone():
            report = _report(options)
    except InvalidInput as error:
        name, colon, what = str(error).partition(":")
        if name not in _OF_CHECK:
            raise
        raise InvalidInput(f"--{name.replace('_', '-')}{colon}{what}") from error
    if options.page is not None:
        with beside(options.page, [pathlib.Path(options.model)]) as file:
            report.view(file, title=options.title)
    if options.out is not None:
        with beside(options.out, [pathlib.Path(options.model)]) as file:
            file.write_text(report.to_json(), encoding="utf-8")
    print(report.to_json() if options.json else report, end="" if options.json else "\n")
    return report.exit_status


def _report(options: argparse.Namespace) -> Any:
    try:
        from . import cad, cad_intended  # here: --help works without OCP

        source = _of_script(options.model) if options.model.endswith(".py") else options.model
        assembly = cad.load(source, deflection=options.deflection, angle=options.angle, skip_empty=options.skip_empty)
    except (ModuleNotFoundError, OSError, TypeError) as error:
        raise InvalidInput(str(error)) from error
    return cad.check(
        assembly,
        intended=[cad_intended.split(assembly.parts, text) for text in options.intended],
        ignore_touching=options.ignore_touching,
        allowed_overlap=options.allowed_overlap,
        pairs=not options.no_pairs,
        least_seconds=options.least_seconds,
        tolerance=options.tolerance,
        seconds=options.seconds,
    )


def _parser() -> Parser:
    parser = Parser(prog="chasles cad", description=_DESCRIPTION, epilog=_EPILOG)
    add = parser.add_argument
    add(
        "model",
        metavar="MODEL",
        help="a STEP file; or a program in Python that leaves an assembly of build123d, CadQuery or chasles.cad",
    )
    add(
        "--intended",
        metavar="A:B",
        action="append",
        default=[],
        help="two parts whose contacts are intended; * stands for any letters, and ? for one",
    )
    add("--ignore-touching", action="store_true", help="all contacts as mounted are intended")
    add("--allowed-overlap", metavar="MM", type=float, default=0.0, help="two parts that overlap by so much do not touch yet")
    add(
        "--deflection",
        metavar="MM",
        type=float,
        help="how far triangles may be from curved faces (default: a part in 2000 of the size)",
    )
    add(
        "--angle",
        metavar="RADIANS",
        type=float,
        default=0.3,
        help="between neighbouring triangles of a curved face (default: 0.3)",
    )
    add("--skip-empty", action="store_true", help="leave out parts whose shape is not there, instead of refusing them")
    add("--no-pairs", action="store_true", help="do not move each two joints together")
    add(
        "--least-seconds",
        metavar="SECONDS",
        type=float,
        default=2.0,
        help="for the least clearance over the range of each joint (default: 2)",
    )
    add(
        "--tolerance",
        metavar="SHARE",
        type=float,
        default=0.01,
        help="of two joints: how much may stay open once a contact is known",
    )
    add("--seconds", type=float, default=60.0, help="what is not decided then is unknown (default: 60)")
    add("--json", action="store_true", help="print the report as JSON")
    add("--out", metavar="FILE", help="write the report as JSON")
    add("--page", metavar="FILE", help="write a page to look at")
    add("--title", help="of the page")
    return parser


def _of_script(path: str) -> Any:
    """What a program calls `assembly`, or its only assembly."""
    from . import cad

    if not pathlib.Path(path).is_file():
        raise InvalidInput(f"{path}: is no file")
    sys.path.insert(0, str(pathlib.Path(path).resolve().parent))  # as Python does for a program
    try:
        names = runpy.run_path(path)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever a program raises, exit() included
        raise InvalidInput(f"{path}: {type(error).__name__}: {error}") from error
    if "assembly" in names:
        return names["assembly"]
    found = [thing for name, thing in names.items() if not name.startswith("_") and cad.is_assembly(thing)]
    if len(found) != 1:
        raise InvalidInput(f"{path}: leaves {len(found)} assemblies; call the one to check `assembly`")
    return found[0]


if __name__ == "__main__":
    sys.exit(main())
