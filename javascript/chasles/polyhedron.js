// Bodies: from arrays, and from the content of a file.
import { meshReport, Reader } from "./answers.js";
import { InvalidInput } from "./errors.js";
import { given, Held } from "./held.js";
import { asBytes, checkOptions, converted, isArrayBuffer, isList, number, shown, text, wayOut } from "./values.js";

const parts = { report: 0, vertices: 1, faces: 2, triangles: 3, sourceFaces: 4 };
const solids = ["automatic", "yes", "no"];
const largestIndex = 2 ** 32 - 1;

/** A polyhedral surface. It never changes. */
export class Polyhedron extends Held {
  static title = "Polyhedron"; // in messages, also where a bundler renames classes

  constructor(border, handle) {
    super(given(border, "Polyhedron", "chasles.polyhedron(vertices, faces), fromFile, fromBufferGeometry and fromObject3D"), "body", handle);
  }

  get report() {
    return kept(this, "report", (numbers) => meshReport(new Reader(numbers)));
  }
  get vertices() {
    return kept(this, "vertices", (numbers) => numbers);
  }
  get triangles() {
    return kept(this, "triangles", (numbers) => new Uint32Array(numbers));
  }
  get sourceFaces() {
    return kept(this, "sourceFaces", (numbers) => new Uint32Array(numbers));
  }
  get faces() {
    return kept(this, "faces", (numbers) => {
      const reader = new Reader(numbers);
      return Object.freeze(reader.some(reader.number()).map((corners) => Object.freeze(reader.some(corners))));
    });
  }

  /** The arrays that make the same body, with the same ids, in another instance. */
  static copy(body) {
    const { solid_parts, inward_parts, radius, moved_inwards } = body.report;
    const faces = part(body, "faces");
    const sizes = new Uint32Array(faces.subarray(1, 1 + faces[0]));
    const corners = new Uint32Array(faces.subarray(1 + faces[0]));
    const solid = solids.indexOf(solid_parts + inward_parts > 0 ? "automatic" : "no");
    return { vertices: part(body, "vertices"), sizes, corners, ids: new Uint32Array(part(body, "sourceFaces")), options: [solid, radius, moved_inwards] };
  }
  static ofCopy(border, { vertices, sizes, corners, ids, options }) {
    border.giveNumbers(vertices);
    border.giveBytes(asBytes(sizes, "faces"), asBytes(corners, "faces"), asBytes(ids, "faces"));
    return new Polyhedron(border, border.call("body_again", sizes.length, ...options));
  }
}

function part(body, name) {
  const { border, handle } = Held.own(body, Polyhedron, "polyhedron");
  return border.ask("body_part", handle, parts[name]);
}

/** Made at the first read, and given by all later ones. Typed arrays cannot be frozen: one that was sent to a worker is made anew. */
function kept(body, name, make) {
  const { kept: parts } = Held.own(body, Polyhedron, "polyhedron");
  const isSent = ArrayBuffer.isView(parts.get(name)) && parts.get(name).length === 0;
  if (!parts.has(name) || isSent) parts.set(name, make(part(body, name)));
  return parts.get(name);
}

/** As numbers: whether to triangulate, what is solid, and the radius. */
function bodyOptions(options) {
  checkOptions(options, ["triangulate", "solid", "radius"]);
  const { triangulate = false, solid = "automatic", radius = 0 } = options;
  if (typeof triangulate !== "boolean") throw new InvalidInput("triangulate: must be true or false");
  if (!solids.includes(solid)) throw new InvalidInput('solid: must be "automatic", "yes" or "no"');
  return [triangulate ? 1 : 0, solids.indexOf(solid), number(radius, "radius")];
}

/** Typed arrays that cannot be read: their bytes are gone, or no entry is a number. */
function refuseUnreadable(array, name) {
  if (!ArrayBuffer.isView(array)) return;
  asBytes(array, name);
  const kind = Object.prototype.toString.call(array).slice(8, -1);
  if (kind.startsWith("Big")) throw new InvalidInput(`${name}: a ${kind} holds no numbers: Float64Array.from(${name}, Number) makes them`);
}

/** Points as one array of numbers: a typed array, which is used in place, or an array of numbers or of points. */
function flatPoints(vertices, name = "vertices") {
  if (!isList(vertices)) throw new InvalidInput(`${name}: must be an array of numbers or of points`);
  refuseUnreadable(vertices, name);
  if (ArrayBuffer.isView(vertices)) return vertices;
  if (typeof vertices[0] === "number") return converted(Float64Array, vertices, (x, i) => number(x, `${name}[${i}]`));
  const numbers = new Float64Array(3 * vertices.length);
  for (let i = 0; i < vertices.length; ++i) {
    const point = vertices[i]; // by index: forEach leaves out the holes of an array
    if (!isList(point) || point.length !== 3)
      throw new InvalidInput(`${name}[${i}]: ${isList(point) ? `${point.length} numbers are` : `${shown(point)} is`} no point of 3 numbers${wayOut(point)}`);
    for (let k = 0; k < 3; ++k) numbers[3 * i + k] = number(point[k], `${name}[${i}][${k}]`);
  }
  return numbers;
}

/** The number of a vertex; `place` says where it stands. */
function index(value, ...place) {
  if (Number.isInteger(value) && value >= 0 && value <= largestIndex) return value;
  const name = `faces[${place.join("][")}]`;
  throw new InvalidInput(typeof value === "number" ? `${name}: there is no vertex ${value}` : `${name}: ${shown(value)} is not a number, but vertices are named by numbers`);
}

/** Faces as the numbers of their corners, and all corners. */
function flatFaces(faces) {
  if (!isList(faces)) throw new InvalidInput("faces: must be an array of indices or of faces");
  if (ArrayBuffer.isView(faces)) asBytes(faces, "faces");
  if (!ArrayBuffer.isView(faces) && isList(faces[0])) return polygonFaces(faces);
  if (faces.length % 3 !== 0)
    throw new InvalidInput(`faces: ${faces.length} indices are no triangles of 3 corners each`);
  const corners = faces instanceof Uint32Array ? faces : converted(Uint32Array, faces, (value, i) => index(value, i));
  return { sizes: new Uint32Array(faces.length / 3).fill(3), corners };
}

function polygonFaces(faces) {
  const sizes = converted(Uint32Array, faces, (face, i) => {
    if (!isList(face)) throw new InvalidInput(`faces[${i}]: ${shown(face)} is no list of indices`);
    return face.length;
  });
  const corners = new Uint32Array(sizes.reduce((sum, size) => sum + size, 0));
  let at = 0;
  for (let i = 0; i < faces.length; ++i)
    for (let k = 0; k < sizes[i]; ++k) corners[at++] = index(faces[i][k], i, k);
  return { sizes, corners };
}

export function fromArrays(border, vertices, faces, options) {
  const numbers = bodyOptions(options);
  const points = flatPoints(vertices);
  const { sizes, corners } = flatFaces(faces);
  border.giveNumbers(points);
  border.giveBytes(asBytes(sizes, "faces"), asBytes(corners, "faces"));
  return new Polyhedron(border, border.call("body_from_arrays", sizes.length, ...numbers));
}

function positive(value, name) {
  if (!(number(value, name) > 0)) throw new InvalidInput(`${name}: must be positive, and is ${String(value)}`);
  return value;
}

export function pointsBody(border, points, radius) {
  const vertices = flatPoints(points, "points");
  if (vertices.length === 0) throw new InvalidInput("points: there are none; a body needs at least one");
  if (vertices.length % 3 !== 0) throw new InvalidInput(`points: ${vertices.length} numbers are no points of 3 numbers each`);
  const corners = new Uint32Array(vertices.length);
  for (let i = 0; i < corners.length; ++i) corners[i] = Math.floor(i / 3);
  return fromArrays(border, vertices, corners, { radius: positive(radius, "radius") });
}

export function capsule(border, radius, length) {
  if (length === 0) throw new InvalidInput("length: must be positive, and is 0: sphere(radius) is the ball");
  const half = positive(length, "length") / 2;
  return fromArrays(border, [0, 0, -half, 0, 0, half], [0, 1, 1], { radius: positive(radius, "radius") });
}

export function fromFile(border, content, name, options) {
  const numbers = bodyOptions(options);
  if (!isArrayBuffer(content) && !ArrayBuffer.isView(content)) throw new InvalidInput("content: must be a Uint8Array or an ArrayBuffer");
  const bytes = asBytes(content, "content");
  const nameBytes = new TextEncoder().encode(text(name, "name"));
  border.giveBytes(nameBytes, bytes);
  return new Polyhedron(border, border.call("body_from_file", nameBytes.length, ...numbers));
}
