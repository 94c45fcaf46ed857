"""Docstrings are plain text with names in single backticks: this makes reStructuredText of them, which Sphinx reads."""

import re
from typing import Any

PARTS = re.compile(r"(``[^`]+``|`[^`]+`)")


def escaped(text: str) -> str:
    """Outside of backticks nothing is markup; a name in backticks is code."""
    parts = PARTS.split(text)
    for index in range(0, len(parts), 2):
        parts[index] = re.sub(r"([*|\\])|(?<=\w)_(?!\w)", lambda match: "\\" + match[0], parts[index])
    for index in range(1, len(parts), 2):
        parts[index] = f"``{parts[index].strip('`')}``"
    return "".join(parts)


def as_text(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """An indented block below a paragraph and an empty line is code; everything else is text."""
    done: list[str] = []
    is_code = False
    last = ""  # the last line that is not empty
    for line in lines:
        is_indented = line.startswith("    ")
        if line.strip():
            starts_code = is_indented and bool(done) and not done[-1].strip() and not last.startswith(" ")
            if starts_code and not is_code:
                done += ["::", ""]
            is_code = is_indented and (is_code or starts_code)
            last = line
        done.append(line if is_code else escaped(line))
    lines[:] = done


def setup(app: Any) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", as_text, priority=400)  # before napoleon, which makes markup
    return {"parallel_read_safe": True}
