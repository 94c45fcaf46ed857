"""A plot of the least distances of all pairs with matplotlib: bodies by bodies, in colours by distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ._core import DistanceMatrix
from .plot import new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

IN_CONTACT, UNTESTED = "#d4147f", "#eeeeee"
MOST_WITH_NUMBERS = 15  # bodies


def plot_matrix(matrix: DistanceMatrix, axes: Axes | None = None) -> Axes:
    """Draw the lower ends of all distances, on a logarithmic scale. Pairs that touch have the colour of contacts.

    Up to 15 bodies have a number in each cell: the distance, or `t` and the time of the first contact.

    Parameters
    ----------
    matrix : DistanceMatrix
    axes : Axes, optional
        The axes to draw on. By default, new axes in a new figure.

    Returns
    -------
    Axes
    """
    from matplotlib.colors import LogNorm

    axes = axes or new_axes(6.5)
    lower, count = matrix.lower, len(matrix.names)
    apart = np.ma.masked_where(~(lower > 0), lower)
    axes.set_facecolor(UNTESTED)
    if apart.count():
        image = axes.imshow(apart, cmap="Blues_r", norm=LogNorm(apart.min(), max(apart.max(), apart.min() * (1 + 1e-9))))
        axes.figure.colorbar(image, ax=axes, label="least distance")
    touching = np.ma.masked_where(matrix.upper != 0, np.ones_like(lower))
    if touching.count():
        from matplotlib.colors import ListedColormap

        axes.imshow(touching, cmap=ListedColormap([IN_CONTACT]))
    end = max(count, 1) - 0.5
    axes.set(xlim=(-0.5, end), ylim=(end, -0.5))
    axes.set_xticks(range(count), matrix.names, rotation=90)
    axes.set_yticks(range(count), matrix.names)
    if count <= MOST_WITH_NUMBERS:
        _write_numbers(matrix, axes)
    return axes


def _write_numbers(matrix: DistanceMatrix, axes: Axes) -> None:
    index = {name: i for i, name in enumerate(matrix.names)}
    middle = np.sqrt(np.nanmin(_positive(matrix)) * np.nanmax(_positive(matrix))) if _positive(matrix).size else 0
    for found in matrix.pairs:
        row, column = (index[name] for name in found.pair or ())
        touches = found.distance_upper == 0
        text = f"t {found.time:.2g}" if touches else f"{found.distance:.2g}" if found.distance > 0 else "?"
        colour = "white" if touches or 0 < found.distance < middle else "black"
        for x, y in ((column, row), (row, column)):
            axes.text(x, y, text, ha="center", va="center", color=colour, fontsize=8)


def _positive(matrix: DistanceMatrix) -> np.ndarray:
    lower = matrix.lower
    return lower[lower > 0]
