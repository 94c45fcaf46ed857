// The scenes that the page brings along. Lengths are millimetres.
import { places } from "places";
import { type Arm, armSpec, type Joint } from "./arm";
import type { Pose } from "./poses";
import type { Radii, SceneSpec } from "./protocol";

/** How a scene is dragged. */
export interface Handling {
  isLoose: boolean; // the contacts may turn the part while it is dragged
  axis?: number[]; // the part is turned about it, and not freely
  plane?: number[]; // the normal of the plane that the pointer moves in; without: parallel to the picture
}

export interface PlaygroundScene {
  id: string;
  title: string;
  about: string;
  spec: SceneSpec;
  handling: Handling;
  glass: string[]; // bodies that are drawn transparent
  ground: string[]; // bodies that are drawn paler
  view: number[]; // from where it is looked at
  unit: string; // of lengths
  arm?: Arm;
}

/** Of the switch: beyond what holds a nut of the first scene by itself. */
export const usualFriction = 0.3;

const z = [0, 0, 1];
const at = (x: number, y: number, height: number, angle = 0): Pose => [x, y, height, Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)];

function ready(
  id: string,
  title: string,
  about: string,
  bodies: string[],
  start: Pose,
  more: { margin: number; handling: Handling; glass?: string[]; ground?: string[]; view?: number[] },
): PlaygroundScene {
  const spec = { moving: bodies[0], bodies: bodies.map((name) => ({ name, shape: name })), start, margin: more.margin, friction: 0, radii: [0, 0] satisfies Radii };
  const { handling, glass = [], ground = [], view = [0.55, -1, 0.5] } = more;
  return { id, title, about, spec, handling, glass, ground, view, unit: "mm" };
}

const [keyX, keyY, , keyAngle] = places.key;
const [planetX, planetAngle] = places.planet;

const joints: Joint[] = [
  { name: "Shoulder", link: "upper arm", kind: "hinge", point: [0, 0, 0] },
  { name: "Elbow", link: "forearm", kind: "hinge", point: [160, 0, 0] },
  { name: "Quill", link: "quill", kind: "cylinder", point: [300, 0, 0] },
];
const degrees = Math.PI / 180;
const arm: Arm = { joints, values: [-50, 70, 0].map((turn) => ({ turn: turn * degrees, slide: 0 })), active: 1 };

/** A scene with an arm as it stands. */
export function withArm(scene: PlaygroundScene, arm: Arm): PlaygroundScene {
  const isHinge = arm.joints[arm.active].kind === "hinge";
  return { ...scene, arm, spec: armSpec(scene.spec, arm), handling: { isLoose: false, axis: z, plane: isHinge ? z : undefined } };
}

export const readyScenes: PlaygroundScene[] = [
  ready(
    "nut",
    "Nut and bolt",
    "A steep thread with real flanks: 16 mm wide, 6 mm a turn, 0.7 mm of play. Pull the nut: it turns itself off, for nothing rubs. With friction it holds. Drag its rim around the bolt, or turn it with Shift: the thread carries it up and down.",
    ["nut", "bolt"],
    at(0, 0, 2 * places.nut),
    { margin: 0.003, handling: { isLoose: true, axis: z } },
  ),
  ready(
    "peg",
    "Peg and hole",
    "The hole is 0.16 mm wider than the peg. Find it: press the peg on the plate and slide until it drops in.",
    ["peg", "plate", "table"],
    at(-4, -22, 24),
    { margin: 0.01, handling: { isLoose: false }, ground: ["table"] },
  ),
  ready(
    "maze",
    "Key in a maze",
    "The bit is too long to turn in a corridor. Pull the key by its bow to the way out on the right; the walls turn it.",
    ["key", "maze", "lid"],
    at(keyX, keyY, 0, keyAngle),
    { margin: 0.02, handling: { isLoose: true, axis: z, plane: z }, glass: ["lid"], view: [0.1, -0.75, 1] },
  ),
  ready(
    "gears",
    "Planet gear",
    "Nothing but teeth connects the two gears. Drag the small one around the large one: it has to roll.",
    ["planet gear", "sun gear", "ground"],
    at(planetX + 0.3, 0, 0.2, planetAngle),
    { margin: 0.02, handling: { isLoose: true, axis: z, plane: z }, ground: ["ground"], view: [0.15, -0.9, 1] },
  ),
  withArm(
    ready(
      "robot",
      "Robot arm",
      "Shoulder and elbow turn, the quill slides and turns, and nothing else moves: each joint is a lock. Drag any link; all beyond it go along. Bring the quill over the posts and down into the ring: 2 mm are left on each side.",
      ["forearm", "pedestal", "upper arm", "quill", "ring", "posts", "cell floor"],
      at(0, 0, 0),
      { margin: 0.05, handling: { isLoose: false }, ground: ["cell floor"], view: [0.75, -0.7, 0.75] },
    ),
    arm,
  ),
];

export const sceneNamed = (id: string) => readyScenes.find((scene) => scene.id === id);
