// The data of the page, written by view/scene_json.cpp.
import type { Curve } from "./curve";

export type Vector = [number, number, number];
export type PoseRow = ArrayLike<number>; // x, y, z, qw, qx, qy, qz
/** A vertex is a number, a face a list of one number, an edge a list of its two vertices. */
export type Feature = number | [number] | [number, number];

/** A point of contact. A contact of a recording has no kind, features and approach speed. */
export interface Point {
  kind?: string;
  moving_feature?: Feature;
  fixed_feature?: Feature;
  point: Vector;
  normal: Vector;
  gap: number;
  approach_speed?: number;
}

export type Contact = Required<Point>;

export interface Overlap {
  moving_feature: Feature;
  fixed_feature: Feature;
  point: Vector;
}

/** A body inside of the other one at time 0. */
export interface Nested {
  inside?: "moving" | "fixed";
  inside_vertex?: number;
  inside_point?: Vector;
}

/**
 * The object that `chasles check --json` prints. When clear, time, tau, certain, pose, contacts and overlap are absent.
 * Constant velocity and constant twist have no tau; displacement belongs to constant velocity.
 */
export interface Answer extends Nested {
  verdict: "clear" | "contact" | "contact_at_start";
  time?: number;
  time_upper?: number;
  tau?: number;
  tau_upper?: number;
  certain?: boolean;
  clear_until: number; // the motion is safe until this time
  pose?: number[];
  contacts?: Contact[];
  contacts_cut?: boolean; // there are more contacts than `contacts` or `held` lists
  held?: Contact[]; // contacts within the margin at time 0
  overlap?: Overlap;
  motion: { angle: number; slide: number; axis_point: Vector; axis_direction: Vector; displacement?: Vector };
  work: Record<string, number>;
}

/** Packed arrays are their little-endian bytes in base64. */
export interface PackedMesh {
  origin: Vector;
  vertices: string; // float32, relative to the origin
  triangles: string; // uint32
  creases: string; // uint32
  drawn?: string; // "20000 of 100000 points"; absent: all
}

/** " Not all is drawn: 20000 of 100000 points of cloud." */
export function drawnText(meshes: PackedMesh[], bodies: PackedBody[]): string {
  const parts = bodies.filter(({ mesh }) => meshes[mesh].drawn).map(({ name, mesh }) => `${meshes[mesh].drawn} of ${name}`);
  return parts.length > 0 ? ` Not all is drawn: ${parts.join("; ")}.` : "";
}

export interface PackedBody {
  name: string;
  mesh: number;
  poses: string; // float64, seven numbers per pose, at equal time steps
}

export interface Scene {
  format: 1;
  title: string;
  margin: number;
  motion: "screw" | "sweep" | "velocity" | "twist";
  is_in_world: boolean; // the numbers of the motion are those of the moving body in the world; the fixed one moves too
  meshes: PackedMesh[];
  moving: PackedBody;
  fixed: PackedBody;
  fixed_pose: number[]; // at the time of the contact
  answer: Answer;
  curve?: Curve;
}

export function unpacked(text: string): ArrayBuffer {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
}

/** The time at which the motion stops: the time of the contact, or 1 if the motion is clear. */
export function stopOf(answer: Answer): number {
  return answer.verdict === "clear" ? 1 : answer.time!;
}

/** The contacts of an answer or of one pair of bodies. */
export interface Marked extends Nested {
  contacts?: Point[];
  contacts_cut?: boolean; // there are more than `contacts` (or `held`) lists
  overlap?: Overlap;
}

/** All marked points, in the world at the time of the contact. */
export function markedPoints(answer: Marked): Vector[] {
  const points = (answer.contacts ?? []).map((contact) => contact.point);
  return [...points, ...(answer.overlap ? [answer.overlap.point] : []), ...(answer.inside_point ? [answer.inside_point] : [])];
}
