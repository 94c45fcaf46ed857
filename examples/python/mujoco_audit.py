# %% [markdown]
# # What a simulation did not notice
# MuJoCo looks for contacts at its states, one after each time step. What is fast or thin may pass through something between
# two of them, and no state shows it. This example throws balls at a thin plate and turns a rod against a post, and asks
# who passed through whom. It needs the package `mujoco`.

# %%
import pathlib
import sys

import mujoco
import numpy as np

import chasles.mujoco

STARTS = {2: -0.03, 8: -0.05, 20: -0.08, 40: -0.12, 60: -0.18}  # of each ball, by its speed, in m/s
BALLS = "".join(
    f'<body name="ball {speed}" pos="{x} {0.15 * i - 0.35} 0.6"><freejoint/><geom size="0.02" mass="0.05"/></body>'
    for i, (speed, x) in enumerate(STARTS.items())
)
MODEL = f"""<mujoco><option timestep="0.002"/><worldbody>
<geom name="floor" type="plane" size="1 1 0.1"/>
<geom name="plate" type="box" pos="0 0 0.5" size="0.001 0.5 0.4"/>
<geom name="post" type="cylinder" pos="0.5 0.3 0.4" size="0.015 0.4"/>
<body name="rotor" pos="0.5 0 0.5"><joint name="shaft" axis="0 0 1"/>
 <geom name="rod" type="capsule" fromto="0 0 0 0.4 0 0" size="0.01" mass="0.2"/></body>
{BALLS}</worldbody></mujoco>"""

model = mujoco.MjModel.from_xml_string(MODEL)
data = mujoco.MjData(model)
data.joint("shaft").qvel = 140
for i, speed in enumerate(STARTS):
    data.qvel[1 + 6 * i] = speed

# %% [markdown]
# ## The simulation
# Each state is recorded, and how deep its contacts are.

# %%
states, deepest = [data.qpos.copy()], 0.0
for _ in range(60):
    mujoco.mj_step(model, data)
    states.append(data.qpos.copy())
    deepest = max([deepest, *(-contact.dist for contact in data.contact)])
print(f"the deepest contact of MuJoCo: {1000 * deepest:.2f} mm")

# %% [markdown]
# ## The audit
# Contacts of MuJoCo are soft, so some overlap is allowed. Between two states all joints move evenly.

# %%
found = chasles.mujoco.audit(model, states, allowed_overlap=0.0015, times=0.002 * np.arange(len(states)))
print(found)

passed = [(row["first"], row["second"]) for row in found.table if row["what"] == "passes" and row["certain"]]
assert any("ball 60/" in first and "plate" in second for first, second in passed)
assert any("rod" in first and "post" in second for first, second in passed)
assert not any("ball 2/" in first and "plate" in second for first, second in passed), "the slow ball bounces"

# %% [markdown]
# ## The page
# All geoms on their way, with a list of the contacts to click.

# %%
page = found.view(
    pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "audit.html").with_suffix(".html"), title="Who passed"
)
print("open", page)
