# %% [markdown]
# # A gripper that jams
# The two jaws of a gripper turn in opposite directions on pins. This example builds it with build123d, checks it, finds that a rib of
# one jaw stops it early, makes the rib smaller, and proves that the jaws are then clear over their whole range. It needs the package
# `build123d`.

# %%
import math
import pathlib
import sys

from build123d import Axis, Box, Color, Compound, Cylinder, Pos, RevoluteJoint, RigidJoint

import chasles.cad

OPENING = 40  # degrees


def gripper(rib: float) -> Compound:
    """A frame with two pins, and two jaws whose bores have a play of 0.1 mm; one jaw has a rib."""
    frame = Box(60, 30, 4)
    for x in (-15, 15):
        frame += Pos(x, 0, 7) * Cylinder(3, 10)
    frame += Pos(0, 7, 6) * Box(4, 4, 8)  # a post between the jaws
    frame.label, frame.color = "frame", Color("gray")
    jaws = []
    for name, side in (("left", -1), ("right", 1)):
        jaw = Pos(0, 0, 2) * Cylinder(6, 4) + Pos(0, 18, 2) * Box(5, 30, 4) - Pos(0, 0, 2) * Cylinder(3.1, 5)
        if side < 0:
            jaw += Pos(rib / 2 + 5, -3, 2) * Box(rib, 3, 4)
        jaw.label, jaw.color = name, Color("orange")
        limits = (0, OPENING) if side < 0 else (-OPENING, 0)
        hinge = RevoluteJoint(name, frame, axis=Axis((15 * side, 0, 2.5), (0, 0, 1)), angular_range=limits)
        hinge.connect_to(RigidJoint("bore", jaw), angle=0)
        jaws.append(jaw)
    return Compound(label="gripper", children=[frame, *jaws])


# %% [markdown]
# ## As designed
# Each joint moves from where it is mounted to its limits; then both move together.

# %%
report = chasles.cad.check(chasles.cad.load(gripper(rib=10), deflection=0.05), tolerance=0.4, seconds=20)
print(report)
assert report.verdict == "contact" and report.is_proven
stops = [stop for joint in report.joints for stop in joint.stops if stop is not None]
print(f"a jaw stops between {math.degrees(stops[0].clear_until):.4f} and {math.degrees(stops[0].touches_by):.4f} degrees")

# %% [markdown]
# ## With a smaller rib
# The whole range is proven clear, with the play of the bores as least clearance.

# %%
mended = chasles.cad.check(chasles.cad.load(gripper(rib=6), deflection=0.05), tolerance=0.4, seconds=20)
print(mended)
assert mended.verdict == "clear" and mended.is_proven

# %% [markdown]
# ## The page
# Each joint goes to its ends and back, with the contacts to click. The report is JSON for continuous integration.

# %%
page = report.view(
    pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "gripper.html").with_suffix(".html"), title="A gripper that jams"
)
print("open", page)
