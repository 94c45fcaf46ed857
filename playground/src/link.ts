// The state of the page in its address: "#nut&start=...&pose=..." with the scene and both poses, to the last digit, and with
// friction and radii where they are not 0; for an arm the joint in the hand, and turn and slide of each joint.
import type { JointValue } from "./arm";
import type { Pose } from "./poses";
import type { Radii } from "./protocol";

export interface Shared {
  scene: string;
  start?: Pose;
  pose?: Pose;
  friction?: number;
  radii?: Radii;
  arm?: { active: number; values: JointValue[] };
}

const numbersIn = (text: string) => text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));

function poseIn(text: string | null): Pose | undefined {
  if (text === null) return undefined;
  const numbers = numbersIn(text);
  if (numbers.length !== 7 || !numbers.every(Number.isFinite)) throw new Error("the link's poses are not seven numbers each");
  if (numbers.slice(3).every((part) => part === 0)) throw new Error("the link's poses have no turn");
  return numbers;
}

/** One or two numbers. */
function radiiIn(text: string | null): Radii | undefined {
  if (text === null) return undefined;
  const [moving, standing = 0, ...more] = numbersIn(text);
  if (more.length > 0 || ![moving, standing].every(Number.isFinite)) throw new Error("the link's radii are not two numbers");
  return [moving, standing];
}

function armIn(text: string | null): Shared["arm"] {
  if (text === null) return undefined;
  const [active, ...numbers] = numbersIn(text);
  if (!Number.isInteger(active) || numbers.length % 2 !== 0 || !numbers.every(Number.isFinite)) throw new Error("the link's joints are not numbers");
  return { active, values: Array.from({ length: numbers.length / 2 }, (_, i) => ({ turn: numbers[2 * i], slide: numbers[2 * i + 1] })) };
}

export function fragmentOf({ scene, start, pose, friction, radii, arm }: Shared): string {
  const joints = arm && [arm.active, ...arm.values.flatMap(({ turn, slide }) => [turn, slide])];
  const values = { start, pose, joints, friction: friction ? [friction] : undefined, radius: radii?.some((radius) => radius !== 0) ? radii : undefined };
  const parts = Object.entries(values).flatMap(([name, numbers]) => (numbers ? [`${name}=${numbers.join(",")}`] : []));
  return `#${[scene, ...parts].join("&")}`;
}

/** Throws an Error that says what is wrong. */
export function sharedIn(fragment: string): Shared | undefined {
  const [scene, ...rest] = decodeURIComponent(fragment.replace(/^#/, "")).split("&");
  if (scene === "") return undefined;
  const values = new URLSearchParams(rest.join("&").replaceAll("+", "%2B"));
  const friction = Number(values.get("friction") ?? 0);
  const [start, pose] = ["start", "pose"].map((name) => poseIn(values.get(name)));
  return { scene, start, pose, arm: armIn(values.get("joints")), friction, radii: radiiIn(values.get("radius")) };
}
