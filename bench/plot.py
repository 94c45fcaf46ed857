#!/usr/bin/env python3
"""Plots of the benchmark results.

Usage: plot.py RESULTS. Reads peers_bench.csv and scaling_bench.json in this folder and writes into the same folder

    peers.png     median time by case, one mark per peer; hollow if the peer missed contacts or reported false ones
    growth.png    time against triangles: for Chasles alone, and for all peers in cases that differ only in size

Missing measurements are omitted. Colours (M. Okabe, K. Ito, 2002) distinguish libraries, shapes distinguish their
queries.
"""

import csv
import json
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

COLOURS = {
    "Chasles": "#000000",
    "FCL": "#0072B2",
    "python-fcl": "#56B4E9",
    "Coal": "#D55E00",
    "Parry": "#009E73",
    "Bullet": "#CC79A7",
}
SHAPES = ["o", "s", "^", "D"]


def library(peer: str) -> str:
    return peer.split(",")[0]


def read_peers(folder: pathlib.Path) -> list[dict]:
    """The rows with a time, in the table's order."""
    path = folder / "peers_bench.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["median ms"]]


def in_order(names) -> list[str]:
    return list(dict.fromkeys(names))


def styles(rows: list[dict]) -> dict[str, tuple[str, str]]:
    """The colour (by library) and the shape (by query) of each peer."""
    found: dict[str, tuple[str, str]] = {}
    for peer in in_order(row["peer"] for row in rows):
        brothers = sum(library(other) == library(peer) for other in found)
        found[peer] = (COLOURS.get(library(peer), "#999999"), SHAPES[brothers % len(SHAPES)])
    return found


def read_unanswered(folder: pathlib.Path) -> list[tuple[str, str, float]]:
    """Case, peer and time limit in milliseconds of each query that reached the limit."""
    path = folder / "peers_bench.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8") as file:
        rows = [(row["case"], row["peer"]) for row in csv.DictReader(file)]
    found = [(case, re.fullmatch(r"(.*) \(no answer within (\S+) s\)", peer)) for case, peer in rows]
    return [(case, words[1], 1e3 * float(words[2])) for case, words in found if words]


def fills(rows: list[dict]) -> None:
    """Sets the fill of each mark: white for wrong answers, grey if a slow peer ran no query with a contact."""
    with_contacts = {row["case"] for row in rows if int(row["contacts"])}
    for row in rows:
        is_wrong = int(row["missed"]) + int(row["false alarms"]) > 0
        is_untried = row["case"] in with_contacts and int(row["contacts"]) == 0
        row["fill"] = "white" if is_wrong else "#cccccc" if is_untried else COLOURS.get(library(row["peer"]), "#999999")


def milliseconds_axis(axis, which: str) -> None:
    """Plain numbers with their units instead of powers of ten."""
    names = {1e-4: "100 ns", 1e-3: "1 us", 1e-2: "10 us", 0.1: "100 us", 1: "1 ms", 10: "10 ms", 100: "100 ms"}
    names |= {1e3: "1 s", 1e4: "10 s"}
    low, high = axis.get_xlim() if which == "x" else axis.get_ylim()
    ticks = [tick for tick in names if low <= tick <= high]
    (axis.set_xticks if which == "x" else axis.set_yticks)(ticks, [names[tick] for tick in ticks])


def legend_of(style: dict[str, tuple[str, str]], has_unanswered: bool) -> list[Line2D]:
    marks = [
        Line2D([], [], color=colour, marker=shape, linestyle="", markersize=7, label=peer)
        for peer, (colour, shape) in style.items()
    ]
    notes = {"hollow: misses or false alarms": ("o", "white"), "grey: too slow for a query with a contact": ("o", "#cccccc")}
    if has_unanswered:
        notes["cross: no answer within this time"] = ("x", "white")
    marks += [
        Line2D([], [], color="#555555", marker=shape, linestyle="", markersize=7, markerfacecolor=fill, label=label)
        for label, (shape, fill) in notes.items()
    ]
    return marks


def plot_peers(rows: list[dict], unanswered: list[tuple[str, str, float]], target: pathlib.Path) -> None:
    cases = in_order(row["case"] for row in rows)
    style = styles(rows)
    lanes = {peer: (i + 0.5) / len(style) for i, peer in enumerate(style)}
    figure, axis = plt.subplots(figsize=(11, 1.5 + 0.62 * len(cases)), layout="constrained")
    for row in rows:
        colour, shape = style[row["peer"]]
        height = cases.index(row["case"]) + 0.08 + 0.84 * lanes[row["peer"]]
        median, worst = float(row["median ms"]), float(row["worst ms"])
        axis.plot([median, worst], [height, height], color=colour, linewidth=0.8, alpha=0.6, zorder=2)
        axis.plot(median, height, shape, color=colour, markerfacecolor=row["fill"], markersize=5.5, zorder=3)
    for case, peer, limit in unanswered:
        if case in cases and peer in style:
            axis.plot(limit, cases.index(case) + 0.08 + 0.84 * lanes[peer], "x", color=style[peer][0], markersize=6)
    for i in range(0, len(cases), 2):
        axis.axhspan(i, i + 1, color="#f2f2f2", zorder=0)
    axis.set_xscale("log")
    axis.set_ylim(len(cases), 0)
    axis.set_yticks([i + 0.5 for i in range(len(cases))], cases)
    axis.tick_params(axis="y", length=0)
    milliseconds_axis(axis, "x")
    axis.grid(axis="x", color="#cccccc", linewidth=0.6, zorder=1)
    axis.set_xlabel("time per query: median, and a line to the worst")
    axis.set_title("Time per query by case, library and kind of query", loc="left")
    for side in ("top", "right", "left"):
        axis.spines[side].set_visible(False)
    figure.legend(handles=legend_of(style, bool(unanswered)), loc="outside right upper", frameon=False, fontsize=9)
    figure.savefig(target, dpi=130)
    plt.close(figure)


def read_growth(folder: pathlib.Path) -> dict[str, list[tuple[int, float]]]:
    """Triangles of a body and milliseconds (medians of the repetitions), by kind of query."""
    path = folder / "scaling_bench.json"
    if not path.exists():
        return {}
    found: dict[str, list[tuple[int, float]]] = {}
    to_milliseconds = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}
    for run in json.loads(path.read_text(encoding="utf-8"))["benchmarks"]:
        name = re.fullmatch(r"growth/(\w+)/(\d+)", run["run_name"])
        if name and run.get("aggregate_name") == "median":
            time = run["real_time"] * to_milliseconds[run["time_unit"]]
            found.setdefault(name[1], []).append((int(name[2]), time))
    return found


def growth_of_peers(rows: list[dict]) -> dict[str, list[tuple[float, dict]]]:
    """Triangles of a body and rows, by peer, for the cases of one shape in several sizes."""
    found: dict[str, list[tuple[float, dict]]] = {}
    for row in rows:
        if size := re.fullmatch(r"near: torus ([\d.]+)k", row["case"]):
            found.setdefault(row["peer"], []).append((1000 * float(size[1]), row))
    return found


def finish_growth(axis, title: str) -> None:
    axis.set_xscale("log")
    axis.set_yscale("log")
    milliseconds_axis(axis, "y")
    names = {1e3: "1k", 1e4: "10k", 1e5: "100k", 1e6: "1M"}
    low, high = axis.get_xlim()
    ticks = [tick for tick in names if low <= tick <= high]
    axis.set_xticks(ticks, [names[tick] for tick in ticks])
    axis.grid(color="#dddddd", linewidth=0.6)
    axis.set_xlabel("triangles of each body")
    axis.set_title(title, loc="left", fontsize=11)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)


def plot_alone(axis, growth: dict[str, list[tuple[int, float]]]) -> None:
    names = {"first": ("first contact", "o"), "any": ("yes or no", "s"), "clear": ("clear", "^")}
    for kind, points in growth.items():
        label, shape = names.get(kind, (kind, "D"))
        axis.plot(*zip(*sorted(points)), marker=shape, color="black", linewidth=1, markersize=5, label=label)
    if points := sorted(growth.get("first", [])):
        (least, time), most = points[0], points[-1][0]
        ends = [time, time * (most / least) ** 0.5]
        axis.plot([least, most], ends, "--", color="#999999", linewidth=1, label="square root, for comparison")
    axis.legend(frameon=False, fontsize=9)
    finish_growth(axis, "Chasles: the same relative motion at every size")


def plot_beside(axis, rows: list[dict]) -> list[str]:
    """The peers that occur in the points."""
    style = styles(rows)
    series = growth_of_peers(rows)
    for peer, points in series.items():
        colour, shape = style[peer]
        times = [(size, float(row["median ms"])) for size, row in points]
        axis.plot(*zip(*times), color=colour, linewidth=1)
        for (size, time), (_, row) in zip(times, points):
            axis.plot(size, time, shape, color=colour, markerfacecolor=row["fill"], markersize=6)
    finish_growth(axis, "All peers: short motions beside a torus, medians")
    return list(series)


def plot_growth(growth: dict[str, list[tuple[int, float]]], rows: list[dict], target: pathlib.Path) -> None:
    has_peers = bool(growth_of_peers(rows))
    count = int(bool(growth)) + int(has_peers)
    if count == 0:
        return
    figure, axes = plt.subplots(1, count, figsize=(3 + 5 * count, 5.2), layout="constrained", squeeze=False)
    if growth:
        plot_alone(axes[0][0], growth)
    if has_peers:
        style = styles(rows)
        shown = {peer: style[peer] for peer in plot_beside(axes[0][-1], rows)}
        figure.legend(handles=legend_of(shown, False), loc="outside right upper", frameon=False, fontsize=9)
    figure.savefig(target, dpi=130)
    plt.close(figure)


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    rows = read_peers(folder)
    fills(rows)
    growth = read_growth(folder)
    if rows:
        plot_peers(rows, read_unanswered(folder), folder / "peers.png")
    plot_growth(growth, rows, folder / "growth.png")


if __name__ == "__main__":
    main()
