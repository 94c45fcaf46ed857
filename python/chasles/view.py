"""An answer as a page of HTML: both bodies, a slider for the time, the contacts and all numbers."""

import os
import pathlib
from typing import Any

import numpy.typing as npt

from . import _core
from ._core import FirstContact, Polyhedron


def view(
    moving: Polyhedron,
    fixed: Polyhedron,
    start: npt.ArrayLike | None = None,
    goal: npt.ArrayLike | None = None,
    *,
    out: str | os.PathLike[str] = "page.html",
    title: str = "Chasles",
    names: tuple[str, str] = ("moving", "fixed"),
    curve: bool = False,
    **options: Any,
) -> FirstContact:
    """Run the query of `first_contact` and write a page of HTML that shows the answer.

    The page is one file and needs no network. Any browser with WebGL can open it.

    Parameters
    ----------
    moving, fixed, start, goal
        As for `first_contact`.
    out : path
        The file to write.
    title : str
        The title of the page.
    names : (str, str)
        The names of the moving body and the fixed body.
    curve : bool
        Whether the page shows the distance over time below the slider. It takes the time of `profile`.
    **options
        All other arguments of `first_contact`.

    Returns
    -------
    FirstContact

    Raises
    ------
    InvalidInput
        If `first_contact` raises it, or if the package was built without the viewer.
    """
    found = _core.first_contact(moving, fixed, start, goal, **options)
    write_page(found, out, title=title, names=names, curve=curve)
    return found


def write_page(
    found: FirstContact,
    out: str | os.PathLike[str] = "page.html",
    *,
    title: str = "Chasles",
    names: tuple[str, str] = ("moving", "fixed"),
    curve: bool = False,
) -> pathlib.Path:
    """Write a page of HTML that shows an answer, and return its path. `found.view(out)` is the same.

    The page shows a swapped answer as the query had it. With `curve`, it shows the distance over time below the slider.
    """
    if found.is_swapped:
        found, names = found.swapped(), (names[1], names[0])
    page = _core.view_page(found, title, *names, curve)
    path = pathlib.Path(out)
    path.write_text(page, encoding="utf-8")
    return path
