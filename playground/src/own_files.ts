// Mesh files of the user's own: read by a worker of their own, so that a large or broken one disturbs nothing.
import { Engine, EngineError } from "./engine";
import type { Pose } from "./poses";
import type { BodySpec, FileReport, Radii } from "./protocol";
import type { PlaygroundScene } from "./scenes";
import { counted, short } from "./words";

const mostTriangles = 200_000;
const mostBytes = 400e6;

export interface OwnFile {
  name: string;
  content: ArrayBuffer;
  report: FileReport;
}

/** Reads a file. Throws an Error that says what is wrong with it. */
export async function readOwnFile(file: File): Promise<OwnFile> {
  if (file.size > mostBytes) throw new Error(`${file.name}: has ${counted(Math.round(file.size / 1e6), "megabyte")}; this page reads files of up to ${mostBytes / 1e6}`);
  const content = await file.arrayBuffer().catch(() => {
    throw new Error(`${file.name}: cannot be read; a folder?`);
  });
  const engine = new Engine();
  try {
    const report = await engine.ask("read", { file: { name: file.name, content } });
    if (report.triangles > mostTriangles)
      throw new Error(`${file.name}: has ${counted(report.triangles, "triangle")}; this page drags bodies of up to ${mostTriangles.toLocaleString("en")}`);
    return { name: file.name, content, report };
  } catch (error) {
    throw error instanceof EngineError ? new Error(readable(error, file.name)) : error;
  } finally {
    engine.stop();
  }
}

/** Words of the library begin with the name of the file. The way out for points is code, which this page does not take. */
function readable({ message: given, isInput }: EngineError, name: string): string {
  const message = given.replace(/[.;] (As a cloud of points, )?chasles\.points\(.*$/s, "");
  if (isInput) return message.startsWith(name) ? message : `${name}: ${message}`;
  return `${name}: is too large for the memory of this page, or the library failed (${message})`;
}

export function warningAbout({ name, report }: OwnFile): string {
  if (report.isRoom) return `${name} is turned inwards: nothing in it is solid. If it should be, reverse its faces.`;
  return report.isClosed ? "" : `${name} is open: ${counted(report.boundaryEdges, "edge")} with one face only. It collides with both sides of its faces.`;
}

/** 0, for the default, or more for a body so far from the origin that its rounding needs it: the library asks for a quarter. */
function marginOf({ report: { lower, upper } }: OwnFile, start: Pose): number {
  const [x, y, z] = start;
  const diagonal = Math.hypot(...upper.map((value, k) => value - lower[k]));
  const least = 2 ** -26 * (Math.hypot(x, y, z) + Math.hypot(...lower) + Math.hypot(...upper));
  return least > 1e-4 * diagonal ? least : 0;
}

/** The first file stands, the last one is dragged and starts beside it. */
export function ownScene(files: OwnFile[]): PlaygroundScene {
  const moving = files.at(-1)!;
  const names = files.map(({ name }, index) => (files.findIndex((other) => other.name === name) < index ? `${name} (2)` : name));
  const bodies: BodySpec[] = files.map(({ name, content }, index) => ({ name: names[index], file: { name, content } }));
  const start = startBeside(moving, files.length > 1 ? files[0] : undefined);
  const spec = { moving: names.at(-1)!, bodies, start, margin: marginOf(moving, start), friction: 0, radii: [0, 0] satisfies Radii };
  const about = files.length > 1 ? `${names.at(-1)} is dragged, ${names[0]} stands. ` : `${names[0]} is alone: drop a second file to drag against. `;
  const sizes = files.map(({ report }, index) => `${names[index]}: ${counted(report.triangles, "triangle")}, ${extent(report)}.`).join(" ");
  return { id: "own", title: "Your own files", about: about + sizes, spec, handling: { isLoose: false }, glass: [], ground: [], view: [0.55, -1, 0.5], unit: "" };
}

const extent = ({ lower, upper }: FileReport) => upper.map((value, k) => short(value - lower[k])).join(" × ");

/** Beside the other body along x, with a gap, and at its height. */
function startBeside(moving: OwnFile, fixed?: OwnFile): Pose {
  if (!fixed) return [0, 0, 0, 1, 0, 0, 0];
  const [own, other] = [moving.report, fixed.report];
  const middle = ({ lower, upper }: FileReport, k: number) => (lower[k] + upper[k]) / 2;
  const size = Math.max(...[own, other].flatMap(({ lower, upper }) => upper.map((value, k) => value - lower[k])));
  const along = other.upper[0] - own.lower[0] + 0.15 * size;
  return [along, middle(other, 1) - middle(own, 1), middle(other, 2) - middle(own, 2), 1, 0, 0, 0];
}
