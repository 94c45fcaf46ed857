"""Draws tables of the documents as plots for the site, so that a figure is written down once.

A plot is SVG that stands in the page itself: its colours are those of the page, light or dark, and its words are text.
"""

import html
import math
import pathlib
import re
from collections.abc import Callable
from dataclasses import dataclass

WIDTH, LABELS, RIGHT, ROW, TOP = 860, 262, 236, 34, 12


@dataclass
class Mark:
    """A row of a plot: a point at `value` and a line from `least` to `most`, on a logarithmic axis."""

    label: str
    value: float
    least: float
    most: float
    note: str = ""
    is_ours: bool = False


def table(document: pathlib.Path, head: str) -> list[list[str]]:
    """The cells of the table whose first line begins with `head`."""
    lines = document.read_text(encoding="utf-8").splitlines()
    starts = [number for number, line in enumerate(lines) if line.startswith(head)]
    if len(starts) != 1:
        raise SystemExit(f"site/plots.py: {document.name} has {len(starts)} tables that begin with '{head}'")
    rows = []
    for line in lines[starts[0] + 2 :]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip().replace("*", "").replace("`", "") for cell in line.strip().strip("|").split("|")])
    return rows


def number(text: str) -> float:
    """The first number of a text: "3.5 million" is one, and "2,200"."""
    found = re.search(r"([\d,]*\.?\d+)( million)?", text)
    if not found:
        raise SystemExit(f"site/plots.py: no number in '{text}'")
    return float(found[1].replace(",", "")) * (1e6 if found[2] else 1)


def peer(cells: list[str]) -> Mark:
    """A row of the table beside other libraries."""
    name, missed, false_alarms, time = cells
    label = re.split(r"[,`]", name)[0] + (", 10 samples" if "samples" in name else "")
    label += ", conservative advancement" if "advancement" in name else ""
    wrong = f"{missed.split(';')[0]} missed, {false_alarms} false"
    if name == "Chasles":
        return Mark(name, 1, 1, 1, wrong, True)
    between = re.search(r"\((.*?) to (.*?)\)", time)
    value = number(time)
    least, most = (number(between[1]), number(between[2])) if between else (value, value)
    return Mark(label, value, least, most, wrong)


def least_distance(cells: list[str]) -> list[Mark]:
    """A row of the table of least distances: Chasles, and FCL's samples."""
    ours, samples = number(cells[1]), number(cells[3])
    return [Mark(cells[0], ours, ours, ours, "", True), Mark("FCL, 100 poses", samples, samples, samples, f"too far: {cells[4]}")]


def shown(value: float) -> str:
    if value >= 1e6:
        return f"{value / 1e6:g} million"
    return f"{value:,.0f}" if value >= 1 else f"{value:g}"


def plot(title: str, axis: str, marks: list[Mark]) -> str:
    """An SVG with one row for each mark."""
    low = math.floor(math.log10(min(mark.least for mark in marks)))
    high = math.ceil(math.log10(max(mark.most for mark in marks)))
    right = WIDTH - RIGHT
    height = TOP + ROW * len(marks) + 50

    def x(value: float) -> float:
        return LABELS + (math.log10(value) - low) / (high - low) * (right - LABELS)

    parts = [f'<div class="plot-frame" tabindex="0"><svg class="plot" viewBox="0 0 {WIDTH} {height}" role="img"><title>{html.escape(title)}</title>']
    for power in range(low, high + 1):
        at = x(10.0**power)
        parts.append(f'<line class="grid" x1="{at:.1f}" x2="{at:.1f}" y1="{TOP - 8}" y2="{height - 46}"/>')
        if (power - low) % (2 if high - low > 6 else 1) == 0:
            parts.append(f'<text class="tick" x="{at:.1f}" y="{height - 28}">{shown(10.0**power)}</text>')
    parts.append(f'<text class="tick" x="{(LABELS + right) / 2}" y="{height - 8}">{html.escape(axis)}</text>')
    for index, mark in enumerate(marks):
        y = TOP + ROW * index + ROW / 2
        kind = "ours" if mark.is_ours else "other"
        parts.append(f'<text class="label" x="{LABELS - 12}" y="{y + 4}">{html.escape(mark.label)}</text>')
        parts.append(f'<line class="range {kind}" x1="{x(mark.least):.1f}" x2="{x(mark.most):.1f}" y1="{y}" y2="{y}"/>')
        parts.append(f'<circle class="{kind}" cx="{x(mark.value):.1f}" cy="{y}" r="6"/>')
        parts.append(f'<text class="note" x="{right + 12}" y="{y + 4}">{html.escape(mark.note)}</text>')
    return "\n".join([*parts, "</svg></div>\n"])


def peers_plot(root: pathlib.Path) -> str:
    marks = [peer(cells) for cells in table(root / "docs" / "performance.md", "| library |")]
    return plot("Times of other libraries, over a first contact by Chasles", "time, over a first contact by Chasles", marks)


def least_distance_plot(root: pathlib.Path) -> str:
    rows = table(root / "docs" / "performance.md", "| passes nearby |")
    marks = [mark for cells in rows for mark in least_distance(cells)]
    return plot("Times of least distances by Chasles and by 100 poses of FCL", "milliseconds", marks)


PLOTS: dict[str, Callable[[pathlib.Path], str]] = {"peers": peers_plot, "least-distance": least_distance_plot}


def write(root: pathlib.Path, out: pathlib.Path) -> None:
    out.mkdir(parents=True, exist_ok=True)
    for name, draw in PLOTS.items():
        (out / f"{name}.svg").write_text(draw(root), encoding="utf-8")
