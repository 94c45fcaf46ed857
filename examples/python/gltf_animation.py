# %% [markdown]
# # What no frame shows
# An animation has keys, and a viewer shows frames. A fast part may pass through another one between two frames. This example makes
# an animation of a fan and a rod that comes near, as a file of glTF. No frame shows a contact, but there are some. The
# contact is written back into the file, for Blender and three.js.

# %%
import json
import pathlib
import struct
import sys

import numpy as np

import chasles
import chasles.gltf

FRAMES, RATE, STEP = 49, 24, np.radians(100)  # the fan turns by 100 degrees from frame to frame
OUT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "fan.glb")

# %% [markdown]
# ## The file
# A blade turns about z, and a rod comes towards it.

# %%
corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], "<f4")
sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
triangles = np.array([[side[0], side[i], side[i + 1]] for side in sides for i in (1, 2)], "<u2")
times = np.arange(FRAMES, dtype="<f4") / RATE
angles = STEP * np.arange(FRAMES) / 2
turns = np.column_stack([0 * angles, 0 * angles, np.sin(angles), np.cos(angles)]).astype("<f4")
direction = np.array([np.cos(np.radians(10)), np.sin(np.radians(10)), 0])
ways = np.outer(np.linspace(1.6, 0.8, FRAMES), direction).astype("<f4")

views, accessors, data = [], [], b""
for array, kind, component in [
    (corners, "VEC3", 5126), (triangles.ravel(), "SCALAR", 5123), (times, "SCALAR", 5126), (turns, "VEC4", 5126), (ways, "VEC3", 5126),
]:  # fmt: skip
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
    rows = array.reshape(len(array), -1)
    bounds = {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
    accessors.append({"bufferView": len(accessors), "componentType": component, "count": len(array), "type": kind, **bounds})
    data += array.tobytes() + b"\0" * (-array.nbytes % 4)
scene = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0, 2]}],
    "nodes": [
        {"name": "fan", "children": [1]},
        {"name": "blade", "mesh": 0, "translation": [0.5, 0, 0], "scale": [1, 0.12, 0.02]},
        {"name": "rod", "mesh": 0, "scale": [0.02, 0.02, 0.6]},
    ],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "animations": [
        {
            "name": "spin",
            "samplers": [{"input": 2, "output": 3}, {"input": 2, "output": 4}],
            "channels": [
                {"sampler": 0, "target": {"node": 0, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 2, "path": "translation"}},
            ],
        }
    ],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(data)}],
}
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
file = OUT.with_suffix(".glb")
file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)

# %% [markdown]
# ## What the frames show

# %%
animation = chasles.gltf.read(file)
frames_in_contact = 0
for time in times:
    manager = chasles.CollisionManager()
    for name, pose in animation.poses(float(time)).items():
        manager.add_object(name, animation.bodies[name], pose)
    frames_in_contact += manager.in_collision_internal()
print(f"{frames_in_contact} of {FRAMES} frames show a contact")

# %% [markdown]
# ## What is proven

# %%
found = animation.first_contact()
print(found)
assert frames_in_contact == 0 and found.verdict == "contact" and found.certain and found.pair == ("blade", "rod")
assert animation.first_contact(margin=0.001).time < found.time

# %% [markdown]
# ## The contact in the file
# The marked file opens in Blender and in viewers by three.js: an arrow appears at the time and at the place of the contact.

# %%
marked = chasles.gltf.mark(file, found, OUT.with_name(OUT.stem + "_marked.glb"))
page = animation.view(found, OUT.with_suffix(".html"))
print("open", marked, "or", page)
