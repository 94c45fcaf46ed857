"""An answer as a page of HTML to look at: both bodies, a slider for the time, the contact and its numbers."""

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
    **options: Any,
) -> FirstContact:
    """Answer as `first_contact` does, and write a page that shows it.

    The page is one file that needs no network; any browser with WebGL shows it.

    Parameters
    ----------
    moving, fixed, start, goal
        As for `first_contact`.
    out : path
        The page to write.
    title : str
        The head of the page.
    names : (str, str)
        What to call the moving and the fixed body.
    **options
        All others of `first_contact`.

    Returns
    -------
    FirstContact

    Raises
    ------
    InvalidInput
        As `first_contact`, or if the package was built without the viewer.
    """
    found = _core.first_contact(moving, fixed, start, goal, **options)
    write_page(found, out, title=title, names=names)
    return found


def write_page(
    found: FirstContact,
    out: str | os.PathLike[str] = "page.html",
    *,
    title: str = "Chasles",
    names: tuple[str, str] = ("moving", "fixed"),
) -> pathlib.Path:
    """Write a page that shows an answer; `found.view(out)` is the same. Returns the path of the page."""
    page = _core.view_page(found, title, *names)
    path = pathlib.Path(out)
    path.write_text(page, encoding="utf-8")
    return path
