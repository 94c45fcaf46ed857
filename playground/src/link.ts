// The state of the page in its address: "#nut&start=...&pose=..." with the scene and both poses, to the last digit.
import type { Pose } from "./poses";

export interface Shared {
  scene: string;
  start?: Pose;
  pose?: Pose;
}

function poseIn(text: string | null): Pose | undefined {
  if (text === null) return undefined;
  const numbers = text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  if (numbers.length !== 7 || !numbers.every(Number.isFinite)) throw new Error("the link's poses are not seven numbers each");
  if (numbers.slice(3).every((part) => part === 0)) throw new Error("the link's poses have no turn");
  return numbers;
}

export function fragmentOf({ scene, start, pose }: Shared): string {
  const poses = [start && `start=${start.join(",")}`, pose && `pose=${pose.join(",")}`].filter((part) => part !== undefined);
  return `#${[scene, ...poses].join("&")}`;
}

/** Throws an Error that says what is wrong. */
export function sharedIn(fragment: string): Shared | undefined {
  const [scene, ...rest] = decodeURIComponent(fragment.replace(/^#/, "")).split("&");
  if (scene === "") return undefined;
  const values = new URLSearchParams(rest.join("&").replaceAll("+", "%2B"));
  return { scene, start: poseIn(values.get("start")), pose: poseIn(values.get("pose")) };
}
