"""Models and states that the tests of chasles.mujoco share. They are written here; none is MuJoCo's own."""

import mujoco
import numpy as np

ALL_JOINTS = """<mujoco><worldbody>
<geom name="floor" type="plane" size="1 1 1" pos="0 0 -4" euler="5 -3 0"/>
<body name="base" pos="1 2 3" euler="10 20 30"><geom name="base" type="box" size=".2 .3 .1" pos=".1 0 0" euler="0 0 40"/>
 <body name="arm" pos=".5 0 .1" quat="1 .2 .3 -.4">
  <joint name="a" type="hinge" axis="1 2 -2" pos=".1 -.2 .05" ref="25" range="-90 60"/>
  <joint name="b" type="slide" axis="0 3 4" ref=".2"/>
  <joint name="c" type="hinge" axis="0 0 1" pos="0 .3 0"/>
  <geom type="capsule" fromto="0 0 0 .4 .1 .2" size=".07"/>
  <body name="hand" pos=".3 .2 -.1" euler="0 90 0">
   <joint name="d" type="ball" pos="0 0 .2"/><geom name="fist" type="sphere" size=".15"/>
   <body pos="0 0 .3"><geom name="nail" type="cylinder" size=".05 .1" pos="0 0 1e-7" euler=".00003 0 0"/></body></body></body></body>
<body name="free" pos="0 0 1"><freejoint name="root"/><geom name="egg" type="ellipsoid" size=".2 .3 .4"/>
 <body name="tail" pos="0 .2 .5"><joint name="e" type="slide" axis="1 0 0"/><joint name="f" type="slide" axis="0 1 0" range="-1 2"/>
  <geom name="tail" type="box" size=".1 .1 .3"/></body></body>
<body name="hook" mocap="true" pos="-1 0 0" euler="0 0 45"><geom name="hook" type="box" size=".2 .2 .2"/>
 <body name="on hook" pos="0 0 .5"><joint name="g"/><geom name="sign" type="box" size=".3 .05 .2"/></body></body>
</worldbody></mujoco>"""

HUMANOID = """<mujoco><option timestep="0.002"/><default><geom solref=".004 1"/><joint damping="2" stiffness="20" armature=".02"/></default>
<worldbody><geom name="floor" type="plane" size="9 9 .1"/>
<body name="torso" pos="0 0 1.22"><freejoint name="root"/>
 <geom name="chest" type="capsule" fromto="0 -.08 0 0 .08 0" size=".09"/><geom name="head" type="sphere" pos="0 0 .24" size=".09"/>
 <body name="pelvis" pos="0 0 -.26"><joint name="waist" axis="0 1 0" range="-60 30"/>
  <geom name="pelvis" type="capsule" fromto="0 -.07 0 0 .07 0" size=".09"/>{legs}</body>{arms}</body>
</worldbody></mujoco>"""
LEG = """<body name="{s}_thigh" pos="0 {y}.1 -.1"><joint name="{s}_hip" type="ball"/>
 <geom name="{s}_thigh" type="capsule" fromto="0 0 -.05 0 0 -.3" size=".055"/>
 <body name="{s}_shin" pos="0 0 -.38"><joint name="{s}_knee" axis="0 1 0" range="0 140"/>
  <geom name="{s}_shin" type="capsule" fromto="0 0 0 0 0 -.27" size=".045"/>
  <body name="{s}_foot" pos="0 0 -.36"><joint name="{s}_ankle" axis="0 1 0" range="-40 40"/>
   <geom name="{s}_foot" type="box" size=".1 .04 .025" pos=".04 0 -.02"/></body></body></body>"""
ARM = """<body name="{s}_upper" pos="0 {y}.2 .05"><joint name="{s}_shoulder" type="ball"/>
 <geom name="{s}_upper" type="capsule" fromto="0 {y}.03 -.02 0 {y}.08 -.22" size=".04"/>
 <body name="{s}_lower" pos="0 {y}.09 -.28"><joint name="{s}_elbow" axis="0 1 0" range="-130 0"/>
  <geom name="{s}_lower" type="capsule" fromto="0 0 0 0 0 -.2" size=".035"/></body></body>"""

PLATE = """<mujoco><option timestep=".01" gravity="0 0 0"/><worldbody><geom name="plate" type="box" size=".5 .5 .0005"/>
<body name="ball" pos="0 0 1"><freejoint/><geom name="ball" type="sphere" size=".02"/></body></worldbody></mujoco>"""
ROD = """<mujoco><worldbody><geom name="wall" type="box" pos=".6 .5 0" size=".02 .3 .3"/>
<body name="rod"><joint axis="0 0 1"/><geom name="rod" type="capsule" fromto="0 0 0 .9 0 0" size=".02"/></body></worldbody></mujoco>"""


def model_of(xml):
    return mujoco.MjModel.from_xml_string(xml)


def humanoid():
    sides = [("left", ""), ("right", "-")]
    parts = {name: "".join(part.format(s=s, y=y) for s, y in sides) for name, part in (("legs", LEG), ("arms", ARM))}
    return model_of(HUMANOID.format(**parts))


def simulated(model, steps, velocity=None):
    """The states of a simulation (steps + 1, nq), and the deepest overlap that MuJoCo reports in any of them."""
    data, deepest = mujoco.MjData(model), 0.0
    if velocity is not None:
        data.qvel[:] = velocity
    states = [data.qpos.copy()]
    for _ in range(steps):
        mujoco.mj_step(model, data)
        states.append(data.qpos.copy())
        deepest = max([deepest, *(-dist for dist in distances_of(model, data, states[-1]).values())])
    return np.array(states), deepest


def distances_of(model, data, qpos, mocap=None):
    """The signed distance of each pair of geoms for which MuJoCo makes a contact."""
    data.qpos[:] = qpos
    if mocap is not None:
        data.mocap_pos[:], data.mocap_quat[:] = mocap[:, :3], mocap[:, 3:]
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    found = {}
    for contact in data.contact:
        pair = frozenset((int(contact.geom1), int(contact.geom2)))
        found[pair] = min(found.get(pair, np.inf), contact.dist)
    return found


def random_state(random, model):
    """Hinges and slides within their limits, quaternions of any length."""
    qpos = np.zeros(model.nq)
    for joint in range(model.njnt):
        at, kind = model.jnt_qposadr[joint], model.jnt_type[joint]
        if kind == mujoco.mjtJoint.mjJNT_FREE:
            qpos[at : at + 7] = random.normal(size=7)
        elif kind == mujoco.mjtJoint.mjJNT_BALL:
            qpos[at : at + 4] = random.normal(size=4)
        else:
            qpos[at] = random.uniform(*(model.jnt_range[joint] if model.jnt_limited[joint] else (-3, 3)))
    return qpos


def between(model, start, goal, part):
    """MuJoCo's own way from state to state."""
    velocity, qpos = np.zeros(model.nv), start.copy()
    mujoco.mj_differentiatePos(model, velocity, 1.0, start, goal)
    mujoco.mj_integratePos(model, qpos, velocity, part)
    return qpos
