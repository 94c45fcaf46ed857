#!/usr/bin/env python3
"""The IPC Toolkit's Tight-Inclusion as a peer of bench/translations_bench.cpp.

Usage: translations.py CONSERVATIVE_RESCALING

The protocol has lines as in bench/process_peer.h. The numbers are points; the last one is the translation of the moving
feature:

    vertex_face VERTEX A B C WAY             answer TOUCHES TIME SECONDS
    edge_edge MOVING_A MOVING_B A B WAY      answer TOUCHES TIME SECONDS
    call vertex_face | edge_edge             answer 0 - SECONDS, the time of a nearly empty call
"""

import sys
import time

import protocol

try:
    import ipctk
    import numpy as np
except ImportError as error:
    protocol.absent(str(error))
    sys.exit(0)

BUDGET = 4e-3  # seconds per problem
TIMINGS = 5


def least_seconds(call, *arguments):
    """The minimum of several timings, each of as many calls as the budget allows, and the result of the call."""
    start = time.perf_counter()
    answer = call(*arguments)
    first = time.perf_counter() - start
    repeats = max(1, min(50, int(BUDGET / TIMINGS / first)))
    least = first
    for _ in range(TIMINGS if first < BUDGET else 1):
        start = time.perf_counter()
        for _ in range(repeats):
            call(*arguments)
        least = min(least, (time.perf_counter() - start) / repeats)
    return least, answer


def main() -> None:
    detector = ipctk.TightInclusionCCD(conservative_rescaling=float(sys.argv[1]))

    def ask(call, moving: int, text: str) -> str:
        *points, way = np.array(text.split(), dtype=float).reshape(5, 3)
        ends = [point + way for point in points[:moving]] + points[moving:]
        seconds, (touches, when) = least_seconds(call, *points, *ends)
        return protocol.answer(touches, when if touches else None, seconds)

    def cost_of_a_call(kind: str) -> str:
        points = list(np.arange(12, dtype=float).reshape(4, 3))
        call = {"vertex_face": ipctk.point_triangle_aabb_ccd, "edge_edge": ipctk.edge_edge_aabb_ccd}[kind]
        return protocol.answer(False, None, least_seconds(call, *points, *points, 0.0)[0])

    protocol.serve(
        {
            "vertex_face": lambda text: ask(detector.point_triangle_ccd, 1, text),
            "edge_edge": lambda text: ask(detector.edge_edge_ccd, 2, text),
            "call": cost_of_a_call,
        }
    )


if __name__ == "__main__":
    main()
