// The data of a page of many bodies, written by view/record_json.cpp.
import type { Curve } from "./curve";
import type { Nested, Overlap, PackedBody, PackedMesh, Point } from "./scene";
import { Track, unpackedNumbers } from "./track";

/** One pose if the body rests, otherwise one for each of its times, or of the record's times. */
export interface RecordedBody extends PackedBody {
  times?: string; // float64, ascending
}

/** A pair of bodies in contact. */
export interface RecordedContact extends Nested {
  time: number;
  time_upper: number;
  certain: boolean;
  pair: [number, number]; // the moving and the fixed body, as indices
  kind?: string;
  contacts: Point[];
  contacts_cut?: boolean; // there are more
  overlap?: Overlap;
}

/** How near two bodies come, as an event at this time: the bracket of their distance, {0, 0} if they touch. */
export interface PairDistance extends RecordedContact {
  distance: number;
  distance_upper: number;
}

/** Whether the event is a least distance above 0. */
export function isDistance(event: RecordedContact): event is PairDistance {
  return ((event as PairDistance).distance_upper ?? 0) > 0;
}

/** What an answer does not look at. */
export interface Untested {
  tested: number;
  pairs: number;
  reasons: { reason: string; count: number; pairs?: [string, string][]; links?: string[] }[];
}

export interface SceneRecord {
  format: 2;
  title: string;
  source: "first_contact" | "all_contacts" | "recording";
  margin: number;
  clear_until?: number; // no tested pair touches before this time
  until?: number; // contacts after this time were not asked for; absent: all were
  untested?: Untested;
  times: string; // float64, ascending
  meshes: PackedMesh[];
  bodies: RecordedBody[];
  events: RecordedContact[]; // in order of time
  curve?: Curve;
  matrix?: PairDistance[]; // of each tested pair; the contacts of pairs that touch are those of their events
}

/** The motion of each body, as the page plays it. */
export function tracksOf(record: SceneRecord): Track[] {
  const times = unpackedNumbers(record.times);
  return record.bodies.map((body) => new Track(unpackedNumbers(body.poses), body.times ? unpackedNumbers(body.times) : times));
}

/** "left on right" */
export function pairText({ bodies }: SceneRecord, { pair: [moving, fixed] }: RecordedContact): string {
  return `${bodies[moving].name} on ${bodies[fixed].name}`;
}
