"""Writes the pages of the C++ reference from the XML that Doxygen makes of the public headers.

A page is a topic: its headers in the given order, and in each header every documented declaration in the order of its
source. The directives are those of breathe. A public header that belongs to no topic is an error.
"""

import pathlib
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

SURFACE = "chasles/chasles.h"
OTHERS = ["chasles/ompl.h"]  # public, but not included by the surface
NOTHING_TO_SAY = {"chasles/base/export.h", SURFACE}

TOPICS: dict[str, tuple[str, list[str]]] = {
    "bodies": ("Bodies", ["mesh/polyhedron.h", "mesh/polyhedron_parts.h", "mesh/primitives.h", "base/invalid_input.h"]),
    "motions": ("Poses and motions", ["motion/pose.h", "motion/motion.h", "motion/timed_poses.h", "motion/own_trajectory.h"]),
    "first-contact": (
        "The first contact",
        ["query/first_contact.h", "certificate/certificate.h", "search/find.h", "algebra/bracket.h", "contact/contact.h", "contact/constraint_rows.h",
         "memory/pair_memory.h"],
    ),
    "paths-and-batches": ("Paths, batches and limits", ["query/path.h", "query/batch.h", "base/limit.h"]),
    "least-distance": ("The least distance, and the distance over time", ["query/least_distance.h", "query/distance_gradient.h", "query/profile.h"]),
    "scenes": ("Scenes", ["scene/scene.h", "scene/untested_pairs.h", "scene/stepper.h"]),
    "dragged-bodies": (
        "Dragged bodies",
        ["manipulation/dragged_body.h", "manipulation/drag_options.h", "manipulation/drag_lock.h", "manipulation/mass_properties.h"],
    ),
    "robots": ("Robots", ["robot/robot.h", "robot/robot_description.h", "robot/joint_path.h", "robot/pair_proof.h",
                          "robot/range.h"]),
    "ompl": ("Planners of OMPL", ["ompl.h"]),
}  # fmt: skip

DIRECTIVES = {"function": "doxygenfunction", "enum": "doxygenenum", "variable": "doxygenvariable", "typedef": "doxygentypedef"}
INCLUDE = re.compile(r'^#include "(chasles/[^"]+)"', re.MULTILINE)


@dataclass
class Entry:
    """One declaration at namespace level."""

    header: str
    line: int
    title: str
    directive: str  # of breathe, with its argument
    is_class: bool = False


def public_headers(root: pathlib.Path) -> list[str]:
    """The headers that the surface includes, directly or indirectly, and those beside it."""
    found: list[str] = []
    waiting = [SURFACE]
    while waiting:
        header = waiting.pop()
        if header not in found:
            found.append(header)
            waiting += INCLUDE.findall((root / header).read_text(encoding="utf-8"))
    return sorted(found) + OTHERS


def headers_of_topics(root: pathlib.Path) -> list[str]:
    topics = [f"chasles/{header}" for _, headers in TOPICS.values() for header in headers]
    missing = [header for header in public_headers(root) if header not in topics and header not in NOTHING_TO_SAY]
    if missing:
        raise SystemExit(f"site/reference_cpp.py: no topic has {', '.join(missing)}")
    return topics


def run_doxygen(root: pathlib.Path, out: pathlib.Path) -> pathlib.Path:
    """Returns the folder with the XML."""
    settings = (root / "site" / "Doxyfile").read_text(encoding="utf-8")
    settings += f"OUTPUT_DIRECTORY = {out}\nINPUT = {' '.join(headers_of_topics(root))}\n"
    out.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=root, capture_output=True, check=True)
    if done.stderr.strip():
        raise SystemExit(f"site/reference_cpp.py: doxygen says:\n{done.stderr}")
    return out / "xml"


def text_of(element: ElementTree.Element, tag: str) -> str:
    found = element.find(tag)
    return "" if found is None else "".join(found.itertext())


def place_of(element: ElementTree.Element) -> tuple[str, int]:
    location = element.find("location")
    assert location is not None
    return location.get("file", ""), int(location.get("line", "0"))


def class_entry(definition: ElementTree.Element) -> Entry:
    name, kind = text_of(definition, "compoundname"), definition.get("kind", "class")
    header, line = place_of(definition)
    return Entry(header, line, name.removeprefix("chasles::"), f"doxygen{kind}:: {name}", True)


def member_entry(scope: str, member: ElementTree.Element) -> Entry:
    kind, name = member.get("kind", ""), text_of(member, "name")
    header, line = place_of(member)
    arguments = text_of(member, "argsstring") if kind == "function" else ""
    title = f"{scope}::{name}".removeprefix("chasles::")
    return Entry(header, line, title, f"{DIRECTIVES[kind]}:: {scope}::{name}{arguments}")


def entries(xml: pathlib.Path) -> list[Entry]:
    """Every class and every function, constant, enumeration and alias of a namespace, in order of the source."""
    found: list[Entry] = []
    for file in sorted(xml.glob("*.xml")):
        for definition in ElementTree.parse(file).getroot().findall("compounddef"):
            if definition.get("kind") in ("class", "struct") and definition.get("prot") == "public":
                if "::" in text_of(definition, "compoundname").removeprefix("chasles::").removeprefix("ompl::"):
                    continue  # a part of its class
                found.append(class_entry(definition))
            elif definition.get("kind") == "namespace":
                scope = text_of(definition, "compoundname")
                members = definition.iter("memberdef")
                found += [member_entry(scope, member) for member in members if member.get("kind") in DIRECTIVES]
    return sorted(found, key=lambda entry: (entry.header, entry.line))


def first_comment(header: pathlib.Path) -> str:
    """What the header says about itself: the comment at its head."""
    lines = []
    for line in header.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        lines.append(line.removeprefix("//").removeprefix(" "))
    text = " ".join(line for line in lines if not line.startswith("    ")).strip()
    return re.split(r" Source: ", text)[0]


def page(root: pathlib.Path, title: str, headers: list[str], found: list[Entry]) -> str:
    lines = [f"# {title}", ""]
    for header in headers:
        of_header = [entry for entry in found if entry.header == f"chasles/{header}"]
        lines += [f"**`chasles/{header}`**: {first_comment(root / 'chasles' / header)}", ""]
        title = ""
        for entry in of_header:
            if entry.title != title:  # overloads have one title
                lines += [f"## {entry.title}", ""]
            title = entry.title
            options = [":members:", ":undoc-members:"] if entry.is_class else []
            lines += ["```{eval-rst}", f".. {entry.directive}", *(f"   {option}" for option in options), "```", ""]
    return "\n".join(lines)


def write(root: pathlib.Path, xml: pathlib.Path, out: pathlib.Path) -> None:
    found = entries(xml)
    out.mkdir(parents=True, exist_ok=True)
    for name, (title, headers) in TOPICS.items():
        (out / f"{name}.md").write_text(page(root, title, headers, found), encoding="utf-8")
