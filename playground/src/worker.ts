// A worker with an instance of the library: reads files, drags, and proves ways.
import { type Chasles, type DraggedBody, InvalidInput, load, type Polyhedron, type Scene } from "chasles";
import { shapes } from "shapes";
import type { Pose } from "./poses";
import {
  type BodyShape, type BodySpec, type FileReport, type Opened, type Proof, type Question, type SceneSpec, standing, type Step, type Tasks,
  type WayContact,
} from "./protocol";

const mostContacts = 64;
const segmentsAtOnce = 64;

/** A scene in the library, with the hand in it. */
class OpenScene {
  private readonly bodies: Map<string, Polyhedron>;
  private readonly fixed: string[];
  private readonly scene: Scene;
  private hand: DraggedBody;

  constructor(
    private readonly chasles: Chasles, private readonly spec: SceneSpec, made: [string, Polyhedron][], readonly moving: Polyhedron, pose: Pose,
  ) {
    this.bodies = new Map(made);
    this.scene = chasles.scene();
    this.fixed = standing(spec);
    this.scene.add(spec.moving, moving, { pose });
    for (const name of this.fixed) this.scene.add(name, this.bodies.get(name)!);
    this.refuseOverlap(pose);
    this.hand = this.newHand();
  }

  get margin(): number {
    return this.hand.margin;
  }

  place(pose: Pose): void {
    this.hand.free();
    this.scene.move(this.spec.moving, { pose });
    this.hand = this.newHand();
  }

  update(goal: Pose, seconds: number): Step {
    const begin = performance.now();
    const step = this.hand.update(goal, seconds);
    const milliseconds = performance.now() - begin;
    const { pose, state, wrench, distance, blocking, touching } = step;
    const contacts = step.contacts.slice(0, mostContacts).map(({ body, point, normal, gap, force, friction }) => ({ body, point, normal, gap, force, friction }));
    const way = step.pieces.length === 0 ? [] : [...step.pieces.slice(1).map(({ start }) => start), pose];
    return { pose, state, contacts, wrench, distance, blocking: [...new Set([...blocking, ...touching])], way, milliseconds };
  }

  /** The first contact of the moving body on a way from pose to pose. `onPart` hears of every few segments. */
  firstContact(way: Pose[], onPart: (segments: number) => void): WayContact | undefined {
    for (let from = 0; from < way.length - 1; from += segmentsAtOnce) {
      const part = way.slice(from, from + segmentsAtOnce + 1);
      const found = this.fixed.map((body) => this.contactWith(body, part)).filter((contact) => contact !== undefined);
      found.sort((a, b) => a.segment + a.time - (b.segment + b.time));
      if (found.length > 0) return { ...found[0], segment: from + found[0].segment };
      onPart(part.length - 1);
    }
    return undefined;
  }

  free(): void {
    this.hand.free();
    this.scene.free();
    for (const body of [this.moving, ...this.bodies.values()]) body.free();
  }

  private contactWith(body: string, way: Pose[]): WayContact | undefined {
    const found = this.chasles.firstContactOnPath(this.moving, this.bodies.get(body)!, way);
    if (found.verdict === "clear") return undefined;
    return { body, segment: found.segment, time: found.time ?? 0, atStart: found.verdict === "contact_at_start" };
  }

  private newHand(): DraggedBody {
    const { moving, margin, friction, lock } = this.spec;
    return this.chasles.draggedBody(this.scene, moving, { margin, friction, lock });
  }
  /** Bodies that stand may overlap each other: their radii make them do so. */
  private refuseOverlap(pose: Pose): void {
    const { moving } = this.spec;
    const overlapped = this.fixed.find((body) => this.chasles.firstContact(this.moving, this.bodies.get(body)!, pose, pose).verdict !== "clear");
    if (overlapped) throw new InvalidInput(`${moving} and ${overlapped}: overlap`);
  }
}

let chasles: Promise<Chasles> | undefined;
let open: OpenScene | undefined;

const library = () => (chasles ??= load());

async function made({ shape, file, at }: BodySpec, radius = 0): Promise<Polyhedron> {
  const instance = await library();
  if (file) return instance.fromFile(new Uint8Array(file.content), file.name, { triangulate: true, radius });
  const { vertices, faces } = (await shapes())[shape!];
  return instance.polyhedron(at ? vertices.map((vertex) => carriedTo(at, vertex)) : vertices, faces, { radius });
}

/** What the library refuses gets the name of the body in front. */
async function madeByName(spec: BodySpec, radius: number): Promise<Polyhedron> {
  try {
    return await made(spec, radius);
  } catch (error) {
    if (!(error instanceof InvalidInput) || error.message.startsWith(spec.name)) throw error;
    throw new InvalidInput(`${spec.name}: ${error.message}`);
  }
}

/** Like `carried`, without three.js, which is not in the workers. */
function carriedTo([x, y, z, w, ...axis]: Pose, point: number[]): number[] {
  const twice = cross(axis, point).map((part) => 2 * part);
  const turned = cross(axis, twice);
  return [x, y, z].map((place, k) => place + point[k] + w * twice[k] + turned[k]);
}

const cross = (a: number[], b: number[]) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Several surfaces as one body. Their radius is the same. */
async function joined(bodies: Polyhedron[]): Promise<Polyhedron> {
  const vertices: number[] = [];
  const faces: number[][] = [];
  for (const body of bodies) {
    const first = vertices.length / 3;
    faces.push(...body.faces.map((face) => face.map((corner) => first + corner)));
    vertices.push(...body.vertices);
  }
  return (await library()).polyhedron(vertices, faces, { radius: bodies[0].report.radius });
}

function shapeOf(name: string, body: Polyhedron): BodyShape {
  const { vertices, triangles, faces, report } = body;
  return { name, vertices, triangles, faces, lower: report.lower, upper: report.upper, isClosed: report.closed, radius: report.radius };
}

const tasks: { [Name in keyof Tasks]: (ask: Tasks[Name]["ask"], onPart: (part: number) => void) => Promise<Tasks[Name]["answer"]> } = {
  async load() {
    await library();
    return true;
  },

  async read({ file }): Promise<FileReport> {
    const body = await made({ name: file.name, file });
    const { triangles, closed, solid_parts, inward_parts, boundary_edges, lower, upper } = body.report;
    body.free();
    return { triangles, isClosed: closed, isRoom: solid_parts === 0 && inward_parts > 0, boundaryEdges: boundary_edges, lower, upper };
  },

  async open({ scene, pose }): Promise<Opened> {
    const bodies: [string, Polyhedron][] = [];
    const isMoving = ({ name, isPart }: BodySpec) => name === scene.moving || isPart;
    for (const spec of scene.bodies) bodies.push([spec.name, await madeByName(spec, scene.radii[isMoving(spec) ? 0 : 1])]);
    const parts = scene.bodies.flatMap((spec, index) => (isMoving(spec) ? [bodies[index][1]] : []));
    const moving = parts.length > 1 ? await joined(parts) : parts[0];
    const next = new OpenScene(await library(), scene, bodies, moving, pose ?? scene.start);
    open?.free();
    open = next;
    const shown = bodies.map(([name, body]) => shapeOf(name, body));
    return { bodies: shown, moving: shapeOf(scene.moving, moving), margin: open.margin };
  },

  async place({ pose }) {
    open!.place(pose);
    return true;
  },

  async update({ goal, seconds }) {
    return open!.update(goal, seconds);
  },

  async prove({ ways }, onPart): Promise<Proof> {
    const all = ways.reduce((sum, way) => sum + Math.max(0, way.length - 1), 0);
    let done = 0;
    for (const way of ways) {
      const before = done;
      const contact = open!.firstContact(way, (segments) => onPart((done += segments) / all));
      if (contact) return { segments: all, contact: { ...contact, segment: before + contact.segment } };
    }
    return { segments: all };
  },
};

async function answered({ id, task, ask }: Question): Promise<unknown> {
  try {
    const work = tasks[task] as (ask: unknown, onPart: (part: number) => void) => Promise<unknown>;
    return { id, answer: await work(ask, (part) => postMessage({ id, part })) };
  } catch (error) {
    return { id, error: error instanceof Error ? error.message : String(error), isInput: error instanceof InvalidInput };
  }
}

// One task after another: a message that comes while a task waits for the library has to wait, too.
let last: Promise<void> = Promise.resolve();
onmessage = ({ data }: MessageEvent<Question>) => {
  last = last.then(async () => postMessage(await answered(data)));
};
