"""A plot of the range of two joints with matplotlib: the boxes that are proven clear or in contact, and open ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import ClearBox, InvalidInput, RobotRange
from .plot import new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Colours of Okabe and Ito.
CLEAR, IN_CONTACT, OPEN, BOX = "#a6d5f2", "#d55e00", "#f0e442", "#0072b2"


def plot_range(found: RobotRange, axes: Axes | None = None, *, clear_box: ClearBox | None = None) -> Axes:
    """Draw the boxes over both joints.

    Parameters
    ----------
    found : RobotRange
        Of two joints.
    axes : Axes, optional
        The axes to draw on. By default, new axes in a new figure.
    clear_box : ClearBox, optional
        A box of the same joints, which is drawn as a dashed line.

    Returns
    -------
    Axes

    Raises
    ------
    InvalidInput
        For a range of another number of joints.
    """
    if len(found.joints) != 2:
        raise InvalidInput(f"plot: draws ranges of two joints, and this one has {len(found.joints)}")
    axes = axes or new_axes(6)
    for boxes, colour, share, label in (
        (found.boxes, CLEAR, found.clear_share, "clear"),
        (found.contact_boxes, IN_CONTACT, found.contact_share, "contact"),
        (found.open_boxes, OPEN, found.open_share, "open"),
    ):
        _draw(axes, boxes, colour, f"{label} {100 * share:.1f} %")
    if clear_box is not None:
        _draw_outline(axes, found, clear_box)
    moving = found.lower < found.upper
    (left, low), (right, high) = found.lower[moving], found.upper[moving]
    axes.set(xlabel=found.joints[0], ylabel=found.joints[1], xlim=(left, right), ylim=(low, high))
    axes.legend(loc="upper right")
    return axes


def _draw(axes: Axes, boxes: Any, colour: str, label: str) -> None:
    from matplotlib.collections import PolyCollection

    lower, upper = boxes[:, 0], boxes[:, 1]
    corners = np.stack(
        [lower, np.column_stack([upper[:, 0], lower[:, 1]]), upper, np.column_stack([lower[:, 0], upper[:, 1]])], axis=1
    )
    axes.add_collection(PolyCollection(corners, facecolors=colour, edgecolors=colour, linewidths=0.2, label=label))


def _draw_outline(axes: Axes, found: RobotRange, box: ClearBox) -> None:
    moving = found.lower < found.upper
    (left, low), (right, high) = box.lower[moving], box.upper[moving]
    axes.plot([left, right, right, left, left], [low, low, high, high, low], color=BOX, linestyle="--", label="clear box")
