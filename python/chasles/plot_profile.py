"""A plot of the distance over time with matplotlib: the band between both bounds, and margins."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ._core import DistanceProfile
from .plot import new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BAND, MARGIN = "#3f8fc8", "#d4147f"


def plot_profile(profile: DistanceProfile, axes: Axes | None = None, *, margins: Sequence[float] = ()) -> Axes:
    """Draw both bounds over the time.

    Parameters
    ----------
    profile : DistanceProfile
    axes : Axes, optional
        The axes to draw on. By default, new axes in a new figure.
    margins : sequence of floats
        Distances that are drawn as lines, mesh unit.

    Returns
    -------
    Axes
    """
    axes = axes or new_axes(4.5)
    axes.fill_between(profile.times, profile.lower, profile.upper, step="post", color=BAND, linewidth=1.2)
    for margin in margins:
        axes.axhline(margin, color=MARGIN, linestyle="--", linewidth=1)
    begin, end = profile.times[0], profile.times[-1]
    label = "time" if (begin, end) != (0, 1) else "time, as a part of the motion"
    axes.set(xlabel=label, ylabel="distance", xlim=(begin, end), ylim=(0, None))
    return axes
