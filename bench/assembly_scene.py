#!/usr/bin/env python3
"""Writes a scene of twelve real parts on screws, sliders and hinges: 66 pairs for `chasles scene --matrix`.

Usage: assembly_scene.py FOLDER SCENE.json. FOLDER holds the meshes of the assembly data (assembly-factory). Both nuts
turn on their bolts, which turn the other way; both pegs leave their holes, which go down; a gear turns on its base, and two
more pegs pass by.
"""

import json
import math
import pathlib
import sys


def pose(x: float, y: float, z: float, turn: float = 0) -> list[float]:
    """About the z axis, radians."""
    return [x, y, z, math.cos(turn / 2), 0, 0, math.sin(turn / 2)]


def parts() -> list[tuple[str, str, list[float], list[float] | None]]:
    """Name, mesh, start and goal; of the base no goal. The nuts start where they are free on their bolts."""
    made: list[tuple[str, str, list[float], list[float] | None]] = []
    for size, mesh, x, pitch, raised in (("m16", "m16_loose", 0, 2e-3, 0.97), ("m12", "m12_tight", 0.05, 1.75e-3, 0.9275)):
        start, turn = raised * pitch, math.pi / 2
        made.append((f"bolt {size}", f"bolt_{mesh}", pose(x, 0, 0), pose(x, 0, 0, -turn / 2)))
        made.append((f"nut {size}", f"nut_{mesh}_subdiv_3x", pose(x, 0, start), pose(x, 0, start + pitch / 4, turn / 2)))
    made += [
        ("hole rect", "rectangular_hole_16mm_subdiv_3x", pose(0, 0.06, 0), pose(0, 0.06, -0.005)),
        ("peg rect", "rectangular_peg_16mm_loose_subdiv_3x", pose(0, 0.06, 0), pose(0, 0.06, 0.02)),
        ("hole round", "round_hole_16mm_subdiv_3x", pose(0.06, 0.06, 0), pose(0.06, 0.06, -0.005)),
        ("peg round", "round_peg_16mm_loose", pose(0.06, 0.06, 0), pose(0.06, 0.06, 0.03)),
        ("base", "gear_base_loose_space_5e-4_subdiv_4x", pose(0.15, 0, 0), None),
        ("gear", "gear_small_space_5e-4", pose(0.15, 0, 5e-4), pose(0.15, 0, 5e-4, 1.5)),
        ("peg rect 2", "rectangular_peg_16mm_tight_subdiv_3x", pose(0.1, 0.06, 0), pose(0, 0.1, 0.05)),
        ("peg round 2", "round_peg_16mm_tight", pose(0.12, 0.1, 0), pose(0.12, 0.02, 0.06)),
    ]
    return made


def main() -> None:
    folder, out = sys.argv[1:]
    bodies = []
    for name, mesh, start, goal in parts():
        body = {"name": name, "mesh": str(pathlib.Path(folder, f"factory_{mesh}.obj").resolve()), "pose": start}
        bodies.append(body | ({"goal": goal, "motion": "twist"} if goal else {}))
    pathlib.Path(out).write_text(json.dumps({"bodies": bodies}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
