"""Assemblies whose answers are closed formulas, for the tests of `chasles.cad`."""

import numpy as np
import cad_shapes as cs

INFINITE = dict(lower=-np.inf, upper=np.inf)


def hinge():
    """A leaf 2 mm thick turns until its face meets an edge of a stop at (30, 20)."""
    made = cs.assembly(leaf=cs.box(40, 2, 10), stop=cs.box(10, 5, 10, (20, 20, 0)))
    made.add_joint("hinge", "revolute", "world", "leaf", lower=0, upper=np.pi / 2)
    return made, (None, np.arctan2(20, 30) - np.arcsin(2 / np.hypot(30, 20)))


def slider():
    """A block between two walls, 25 and 7 mm away."""
    made = cs.assembly(block=cs.box(10, 10, 10), left=cs.box(2, 30, 30, (-9, -10, -10)), right=cs.box(2, 30, 30, (35, -10, -10)))
    made.add_joint("rail", "prismatic", "world", "block", axis=(1, 0, 0), lower=-20, upper=50)
    return made, (-7.0, 25.0)


def four_bar():
    """Parallel cranks of 20 mm: the coupler, 1 mm to each side, rises to a stop at a height of 15."""
    made = cs.assembly(
        crank=cs.box(20, 2, 1, (0, -1, 0)),
        rocker=cs.box(20, 2, 1, (50, -1, 0)),
        coupler=cs.box(50, 2, 1, (20, -1, 2)),
        stop=cs.box(60, 5, 1, (0, 15, 2)),
    )
    made.add_joint("crank", "revolute", "world", "crank", lower=0, upper=np.pi / 2)
    made.add_joint("coupler", "revolute", "crank", "coupler", point=(20, 0, 0), follows=("crank", -1.0, 0.0))
    made.add_joint("rocker", "revolute", "world", "rocker", point=(50, 0, 0), follows=("crank", 1.0, 0.0))
    return made, (None, np.arcsin(14 / 20))


def gears():
    """Two wheels of one radius with a pin of 1 mm each, that come from a quarter turn to where 20 (1 - cos t) = 2."""
    made = cs.assembly(left=cs.cylinder(1, 5, (0, 10, 0)), right=cs.cylinder(1, 5, (20, 10, 0)), deflection=0.001)
    made.add_joint("left", "revolute", "world", "left", lower=0, upper=np.pi / 2, value=np.pi / 2)
    made.add_joint("right", "revolute", "world", "right", point=(20, 0, 0), follows=("left", -1.0, np.pi / 2))
    return made, (np.arccos(0.9), None)


def pin_in_clevis(radius=4.9):
    """A pin in a bore of 5 mm."""
    eye = cs.cut(cs.box(20, 20, 8, (-10, -10, 0)), cs.cylinder(5, 8))
    made = cs.assembly(clevis=eye, pin=cs.cylinder(radius, 12, (0, 0, -2)), deflection=0.01)
    made.add_joint("pin", "revolute", "world", "pin")
    return made, (None, None)


def socket():
    """A ball of 4.9 mm in a socket of 5 mm, with three turns."""
    cup = cs.cut(cs.box(14, 14, 7, (-7, -7, -7)), cs.ball(5))
    made = cs.assembly(cup=cup, ball=cs.fuse(cs.ball(4.9), cs.cylinder(1, 12)), deflection=0.02)
    for number, (axis, parent, child) in enumerate(
        [((1, 0, 0), "world", "first"), ((0, 1, 0), "first", "second"), ((0, 0, 1), "second", "ball")]
    ):
        made.add_joint("xyz"[number], "revolute", parent, child, axis=axis, lower=-0.5, upper=0.5)
    return made, (None, None)


def valve():
    """A cone of 45 degrees, 5 mm above its seat, that comes down to it."""
    seat = cs.cut(cs.box(40, 40, 10, (-20, -20, 0)), cs.cone(5, 15, 10))
    made = cs.assembly(seat=seat, plug=cs.cone(5, 14, 9, (0, 0, 5)), deflection=0.005)
    made.add_joint("stem", "prismatic", "world", "plug", lower=-2, upper=20, value=5)
    return made, (0.0, None)


def ring():
    """A torus on a shaft slides to a shoulder of 9 mm, whose rim meets the circle of the torus."""
    shaft = cs.fuse(cs.cylinder(7, 40), cs.cylinder(9, 5, (0, 0, -5)))
    made = cs.assembly(shaft=shaft, ring=cs.torus(10, 2, (0, 0, 10)), deflection=0.01)
    made.add_joint("slide", "prismatic", "world", "ring", lower=0, upper=30, value=10)
    return made, (np.sqrt(3), None)


def slot():
    """A pin of 2 mm in a slot whose round ends of 2.5 mm have their middles at -10 and 10."""
    hole = cs.fuse(cs.box(20, 5, 4, (-10, -2.5, 0)), cs.cylinder(2.5, 4, (-10, 0, 0)), cs.cylinder(2.5, 4, (10, 0, 0)))
    made = cs.assembly(plate=cs.cut(cs.box(40, 20, 4, (-20, -10, 0)), hole), pin=cs.cylinder(2, 8, (0, 0, -2)), deflection=0.001)
    made.add_joint("slot", "prismatic", "world", "pin", axis=(1, 0, 0), lower=-15, upper=15)
    return made, (-10.5, 10.5)


def discs():
    """Two discs of 1 mm on lines that cross: in contact where a^2 + b^2 < 4, which is pi / 25 of all pairs of places."""
    made = cs.assembly(a=cs.cylinder(1, 2, (-5, 0, 0)), b=cs.cylinder(1, 2, (0, -5, 0)), deflection=0.002)
    made.add_joint("a", "prismatic", "world", "a", axis=(1, 0, 0), lower=-5, upper=5, value=-5)
    made.add_joint("b", "prismatic", "world", "b", axis=(0, 1, 0), lower=-5, upper=5, value=-5)
    return made, (None, None)


def rotor():
    """Six blades in a housing, and stator rods between them: clear over the whole turn, by 1 mm."""
    blades = [cs.moved(cs.box(28, 3, 10, (1, -1.5, 0)), (0, 0, 0), (0, 0, 1), 60 * number) for number in range(6)]
    housing = cs.cut(cs.cylinder(36, 16, (0, 0, -3)), cs.cylinder(30 + 1.0 - 2.0, 16, (0, 0, -3)))
    turning = cs.fuse(cs.cylinder(6, 10), *[cs.common(blade, cs.cylinder(28, 10)) for blade in blades])
    made = cs.assembly(housing=housing, rotor=turning, shaft=cs.cylinder(2, 30, (0, 0, 11)), deflection=0.01)
    made.add_joint("rotor", "revolute", "world", "rotor", lower=0, upper=2 * np.pi)
    return made, (None, None)


STOPS = {"hinge": hinge, "slider": slider, "four-bar": four_bar, "gears": gears, "valve": valve, "ring": ring, "slot": slot}
CLEARANCES = {"pin in clevis": (pin_in_clevis, 0.1), "ball in socket": (socket, 0.1), "rotor": (rotor, 1.0)}
