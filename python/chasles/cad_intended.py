"""Pairs of parts whose contacts are intended, by patterns of their names, for `chasles.cad`."""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection

from ._core import InvalidInput


def matching(parts: Collection[str], intended: Collection[tuple[str, str]]) -> set[tuple[str, str]]:
    """Pairs of parts by patterns, in the order of the parts."""
    found = set()
    for patterns in intended:
        if isinstance(patterns, str) or len(patterns) != 2:
            raise InvalidInput(f"intended: {patterns!r} is no pair of names")
        ends = [_named(parts, pattern) for pattern in patterns]
        for pattern, names in zip(patterns, ends, strict=True):
            if not names:
                raise InvalidInput(f"intended: {pattern!r} is no part; the parts are {', '.join(parts)}")
        two = itertools.combinations(parts, 2)
        found |= {(a, b) for a, b in two if (a in ends[0] and b in ends[1]) or (b in ends[0] and a in ends[1])}
    return found


def split(parts: Collection[str], text: str) -> tuple[str, str]:
    """Two patterns from a text "A:B". Where names have colons, too, the colon that has names of parts at both sides counts."""
    cuts = [number for number, letter in enumerate(text) if letter == ":" and 0 < number < len(text) - 1]
    two = [(text[:cut], text[cut + 1 :]) for cut in cuts]
    if not two:
        raise InvalidInput(f"--intended {text}: two names with a colon between them are needed")
    if len(two) == 1:
        return two[0]
    named = [(first, second) for first, second in two if _named(parts, first) and _named(parts, second)]
    if len(named) == 1:
        return named[0]
    what = f"{len(named)} of its colons have" if named else "none of its colons has"
    raise InvalidInput(
        f"--intended {text}: {what} names of parts at both sides; write ? for a colon of a name. The parts are {', '.join(parts)}"
    )


def _named(parts: Collection[str], pattern: str) -> set[str]:
    """The parts with a name that has any letters in place of each *, and any letter in place of each ?."""
    letters = re.compile("".join({"*": ".*", "?": "."}.get(letter, re.escape(letter)) for letter in pattern), re.DOTALL)
    return {name for name in parts if letters.fullmatch(name)}
