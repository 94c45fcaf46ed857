# %% [markdown]
# # A tessellated pin in a tessellated bore
# A mesh of a round part differs from the part by its tessellation error e, here the sagitta of a side of a polygon. If the
# clearance of the true parts is smaller than e, an answer about the meshes proves nothing about the true parts. With e as
# the radius of both bodies, "clear" is a proof for the true parts.

# %%
import math

import numpy as np

import chasles

BORE, PLAY = 5.0, 0.003  # millimetres; the true pin is thinner or thicker than the bore by the play
LENGTH, DEPTH, TURN = 12.0, 8.0, math.radians(2)
COARSE, FINE = 64, 192  # sides


def circle(radius: float, sides: int, z: float) -> np.ndarray:
    angles = 2 * math.pi * np.arange(sides) / sides
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(sides, z)])


def pin(radius: float, sides: int, e: float = 0) -> chasles.Polyhedron:
    """Its vertices lie on the true pin, so the mesh is the thinner one."""
    i = np.arange(sides)
    walls = np.column_stack([i, (i + 1) % sides, (i + 1) % sides + sides, i + sides]).tolist()
    faces = [i[::-1].tolist(), (i + sides).tolist(), *walls]
    return chasles.Polyhedron(np.vstack([circle(radius, sides, 0), circle(radius, sides, LENGTH)]), faces, radius=e)


def block(sides: int, has_vertices_on_bore: bool, e: float = 0) -> chasles.Polyhedron:
    """A round block with a bore. The sides of the polygon are chords of the bore or touch it from outside."""
    hole = BORE if has_vertices_on_bore else BORE / math.cos(math.pi / sides)
    rings = [circle(radius, sides, z) for radius, z in ((hole, 0), (12, 0), (12, DEPTH), (hole, DEPTH))]
    faces = []
    for ring in range(4):
        for i in range(sides):
            a, b, j = ring * sides, (ring + 1) % 4 * sides, (i + 1) % sides
            faces.append([a + i, b + i, b + j, a + j])
    return chasles.Polyhedron(np.vstack(rings), faces, radius=e)


def error(sides: int) -> float:
    """No point of the true pin, and none of the true block, is farther than this from its mesh. Rounded up."""
    return (BORE + PLAY) * (1 - math.cos(math.pi / sides)) * (1 + 1e-9)


def insert(radius: float, sides: int, has_vertices_on_bore: bool, e: float = 0) -> chasles.FirstContact:
    """The pin comes from above, and turns by two degrees until it is through."""
    goal = np.eye(4)
    goal[:2, :2] = [[math.cos(TURN), -math.sin(TURN)], [math.sin(TURN), math.cos(TURN)]]
    goal[2, 3] = -2
    start = [0, 0, DEPTH + 5, 1, 0, 0, 0]
    return chasles.first_contact(pin(radius, sides, e), block(sides, has_vertices_on_bore, e), start, goal)


def turn(found: chasles.FirstContact) -> float:
    return math.atan2(found.pose[1, 0], found.pose[0, 0])


print(f"e = {error(COARSE):.5f} with {COARSE} sides and {error(FINE):.5f} with {FINE}; the play is {PLAY}")
assert 4 * error(FINE) < PLAY < error(COARSE)

# %% [markdown]
# ## A pin that fits, and meshes that do not
# The polygons of pin and bore are aligned at the start. The sides of the bore are chords, and their middles are nearer to
# the axis than the vertices of the pin. The meshes lock after 0.82 degrees. The true parts do not touch.


# %%
def locks_after(radius: float, inner: float) -> float:
    """The turn that brings vertices of the pin onto sides of a hole whose sides are `inner` from the axis."""
    return math.pi / COARSE - math.acos(inner / radius)


fits, is_too_thick = BORE - PLAY, BORE + PLAY
found = insert(fits, COARSE, True)
print("fits, meshes alone:", found)
assert found.verdict == chasles.Verdict.contact  # not true of the parts
assert abs(turn(found) - locks_after(fits, BORE * math.cos(math.pi / COARSE))) < 1e-9

# %% [markdown]
# ## A pin that is too thick, and meshes that fit
# Here the sides of the bore touch the true bore from outside. The meshes enter and lock after 0.83 degrees, 3.6 mm deep.
# Without the turn they are clear. The true pin does not enter.

# %%
found = insert(is_too_thick, COARSE, False)
print("too thick, meshes alone:", found)
assert found.pose[2, 3] < DEPTH - 1  # not true of the parts
assert abs(turn(found) - locks_after(is_too_thick, BORE)) < 1e-9
way = [0, 0, DEPTH + 5, 1, 0, 0, 0], [0, 0, -2, 1, 0, 0, 0]
meshes = chasles.first_contact(pin(is_too_thick, COARSE), block(COARSE, False), *way)
print("too thick, without a turn, meshes alone:", meshes)
assert meshes.verdict == chasles.Verdict.clear  # not true of the parts

# %% [markdown]
# ## The error as radius
# Now the bodies contain the true parts. "Clear" holds for the true parts, whichever side of the true bore the polygon is
# on. "Contact" says that the true parts come within 4 e: the bodies touch, so the meshes are within 2 e, and each mesh is
# within e of its true part. The pin that is too thick is stopped at the block, at most 2 e too early. The pin that fits has
# contact with coarse meshes, which cannot tell, and is proven clear with fine ones.

# %%
for has_vertices_on_bore in (True, False):
    for sides in (COARSE, FINE):
        e = error(sides)
        thick = insert(is_too_thick, sides, has_vertices_on_bore, e)
        fit = insert(fits, sides, has_vertices_on_bore, e)
        print(f"{sides} sides: too thick {thick.verdict} at z = {thick.pose[2, 3]:.4f}; fits {fit.verdict}")
        assert thick.verdict == chasles.Verdict.contact and 0 <= thick.pose[2, 3] - DEPTH <= 2 * e + 1e-9
        assert (fit.verdict == chasles.Verdict.clear) == (sides == FINE)
