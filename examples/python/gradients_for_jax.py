# %% [markdown]
# # The least distance over a motion as a function of jax
# The least distance has a gradient by the goal of the motion. A few lines make it a function that jax differentiates. It
# needs the package `jax`.

# %%
import jax
import numpy as np

import chasles

jax.config.update("jax_enable_x64", True)
cube = chasles.Polyhedron(
    np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) - 0.5,
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
)
START = np.array([-4, 1.8, 0.2, 1, 0, 0, 0])
TURNED = np.array([0.9, 0.1, 0.2, 0.3])  # the goal's quaternion

# %% [markdown]
# ## The wrapper
# The place of the goal (3,) is the argument. `gradient[:3]` is the derivative by it.


# %%
def ask(place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    near = chasles.least_distance(cube, cube, START, np.concatenate([place, TURNED]))
    slope = np.zeros(3) if near.gradient is None else near.gradient[:3]
    return np.float64(near.distance_upper), slope


SHAPES = (jax.ShapeDtypeStruct((), np.float64), jax.ShapeDtypeStruct((3,), np.float64))


@jax.custom_vjp
def distance(place: jax.Array) -> jax.Array:
    return jax.pure_callback(ask, SHAPES, place)[0]


distance.defvjp(lambda place: jax.pure_callback(ask, SHAPES, place), lambda slope, outer: (outer * slope,))

# %% [markdown]
# ## Its derivative, and a goal that is 0.7 away

# %%
place = np.array([3.0, 2.2, 0.4])
slope = jax.grad(distance)(place)
step = 1e-5 * np.eye(3)
expected = [(distance(place + s) - distance(place - s)) / 2e-5 for s in step]
print(f"distance {distance(place):.6f}, gradient {slope}")
assert np.linalg.norm(slope - np.array(expected)) < 1e-4

for _ in range(20):  # Newton's method along the gradient
    slope = jax.grad(distance)(place)
    place = place + slope * (0.7 - distance(place)) / (slope @ slope)
print(f"goal {place}, distance {distance(place):.6f}")
assert abs(distance(place) - 0.7) < 1e-5
