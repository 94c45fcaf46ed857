// The messages between the page and its workers. The library runs in the workers only.
import type { Pose } from "./poses";

/** A body of a scene: a shape that the page brings along, or the content of a file. */
export interface BodySpec {
  name: string;
  shape?: string;
  file?: { name: string; content: ArrayBuffer };
  at?: Pose; // where its vertices are carried to at first, in its own frame
  isPart?: boolean; // of the moving body, and in its frame
}

/** The moving body only turns about an upright line, or slides along it as well. */
export interface Lock {
  kind: "hinge" | "cylinder";
  direction: number[]; // of length one
  point: number[];
}

export interface SceneSpec {
  moving: string;
  bodies: BodySpec[]; // the moving one among them
  start: Pose;
  margin: number; // 0: the library's own
  friction: number;
  radii: Radii;
  lock?: Lock;
}

/** Of the moving body with its parts, and of the bodies that stand. Below 0, faces move inwards. */
export type Radii = [moving: number, standing: number];

/** The bodies that stand. */
export const standing = ({ moving, bodies }: SceneSpec) => bodies.filter(({ name, isPart }) => name !== moving && !isPart).map(({ name }) => name);

/** A body as it is drawn and saved. */
export interface BodyShape {
  name: string;
  vertices: Float64Array;
  triangles: Uint32Array;
  faces: readonly (readonly number[])[];
  lower: readonly number[];
  upper: readonly number[];
  isClosed: boolean;
  radius: number; // above 0: all points within it belong to the body
}

export interface Opened {
  bodies: BodyShape[];
  moving: BodyShape; // with all its parts
  margin: number;
}

export interface ContactShown {
  body: string;
  point: number[];
  normal: number[];
  gap: number;
  force: number; // along the normal
  friction: number[];
}

export type State = "reached" | "resting" | "moving" | "touching";

export interface Step {
  pose: Pose;
  state: State;
  contacts: ContactShown[];
  wrench: number[];
  distance: number;
  blocking: string[];
  way: Pose[]; // the ends of the proven pieces of this update
  milliseconds: number; // of the update alone
}

/** The first contact of a way, or undefined if the way is proven clear. */
export interface WayContact {
  body: string;
  segment: number; // from 0
  time: number; // within the segment
  atStart: boolean;
}

export interface Proof {
  segments: number;
  contact?: WayContact;
}

export interface FileReport {
  triangles: number;
  isClosed: boolean;
  isRoom: boolean; // closed parts are turned inwards, and no part is solid
  boundaryEdges: number;
  lower: readonly number[];
  upper: readonly number[];
}

export interface Tasks {
  load: { ask: Record<string, never>; answer: true };
  read: { ask: { file: { name: string; content: ArrayBuffer } }; answer: FileReport };
  open: { ask: { scene: SceneSpec; pose?: Pose }; answer: Opened };
  place: { ask: { pose: Pose }; answer: true };
  update: { ask: { goal: Pose; seconds: number }; answer: Step };
  prove: { ask: { ways: Pose[][] }; answer: Proof };
}

export type Task = keyof Tasks;

export interface Question {
  id: number;
  task: Task;
  ask: unknown;
}

export type Reply =
  | { id: number; answer: unknown }
  | { id: number; error: string; isInput: boolean }
  | { id: number; part: number }; // how much of the task is done
