// An arm whose joints are moved one at a time: the link in the hand carries all links beyond it, and the others stand.
import { Quaternion, Vector3 } from "three";
import { angleAbout, carried, poseOf, type Pose, product, relative } from "./poses";
import type { BodySpec, SceneSpec } from "./protocol";

const upright = new Vector3(0, 0, 1); // the axis of every joint

export interface Joint {
  name: string;
  link: string; // the body that it moves
  kind: "hinge" | "cylinder";
  point: number[]; // on its axis, where all joints are at 0
}

/** Where a joint is: its turn in radians, and its slide, which is 0 for a hinge. */
export interface JointValue {
  turn: number;
  slide: number;
}

/** The joints, from the pedestal on, and the one in the hand. */
export interface Arm {
  joints: Joint[];
  values: JointValue[];
  active: number;
}

/** The poses of all links. */
function linkPoses({ joints, values }: Arm): Pose[] {
  let before: Pose = [0, 0, 0, 1, 0, 0, 0];
  return joints.map(({ point }, index) => (before = product(before, moved(point, values[index]))));
}

function moved([x, y, z]: number[], { turn, slide }: JointValue): Pose {
  const rotation = new Quaternion().setFromAxisAngle(upright, turn);
  const point = new Vector3(x, y, z);
  const place = point.clone().sub(point.clone().applyQuaternion(rotation)).addScaledVector(upright, slide);
  return poseOf(place, rotation);
}

/** The same arm where its active link is at a pose, which its joint has led it to. */
export function armAt(arm: Arm, pose: Pose): Arm {
  const { joints, values, active } = arm;
  const before = active === 0 ? [0, 0, 0, 1, 0, 0, 0] : linkPoses(arm)[active - 1];
  const step = relative(before, pose);
  const turn = angleAbout(upright, new Quaternion(step[4], step[5], step[6], step[3]));
  const slide = joints[active].kind === "cylinder" ? step[2] : 0;
  return { ...arm, values: values.map((value, index) => (index === active ? { turn, slide } : value)) };
}

/** The scene of the active joint: its link is dragged, links before it stand, and links beyond it are a part of it. */
export function armSpec(spec: SceneSpec, arm: Arm): SceneSpec {
  const { joints, active } = arm;
  const poses = linkPoses(arm);
  const bodies = spec.bodies.map(({ name, shape }): BodySpec => {
    const index = joints.findIndex(({ link }) => link === name);
    if (index < 0 || index === active) return { name, shape };
    return index < active ? { name, shape, at: poses[index] } : { name, shape, at: relative(poses[active], poses[index]), isPart: true };
  });
  const { link, kind, point } = joints[active];
  const place = carried(poses[active], new Vector3(...point));
  return { ...spec, moving: link, bodies, start: poses[active], lock: { kind, direction: upright.toArray(), point: place.toArray() } };
}
