// Poses as numbers, and what the objects of three.js say about them. A pose has no scale: what an object has beyond a pose is
// refused by name, never dropped.
import { InvalidInput } from "./errors.js";
import { addCounted, isList, shown, wayOut } from "./values.js";

const tolerance = 1e-5; // of an entry of R^T R: that of the library for matrices

/** The 16 numbers of a Matrix4, row by row: three.js stores columns. */
export function rowsOf({ elements }) {
  return Array.from({ length: 16 }, (_, i) => elements[4 * (i % 4) + Math.floor(i / 4)]);
}

/**
 * Brings the matrices of an Object3D and its parents up to date, as a renderer would before it draws them: from the top down, whatever
 * three.js believes to be up to date (its `updateWorldMatrix` passes over what does not update itself).
 */
export function updateWorld(object) {
  if (object.parent) updateWorld(object.parent);
  if (object.matrixAutoUpdate) object.updateMatrix();
  if (object.matrixWorldAutoUpdate === false) return;
  if (object.parent) object.matrixWorld.multiplyMatrices(object.parent.matrixWorld, object.matrix);
  else object.matrixWorld.copy(object.matrix);
}

/** The matrix of an Object3D, or of what is like one, in the world, with its parents as they are now. */
export function worldRows(object) {
  if (object.isObject3D) updateWorld(object);
  else object.updateWorldMatrix?.(true, false);
  return rowsOf(object.matrixWorld);
}

const column = (rows, k) => [rows[k], rows[k + 4], rows[k + 8]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export function determinant(rows) {
  return dot(column(rows, 0), cross(column(rows, 1), column(rows, 2)));
}

/** What a matrix has beyond a pose, in words; empty if that is nothing. */
export function beyondPose(rows) {
  const columns = [0, 1, 2].map((k) => column(rows, k));
  if (determinant(rows) < 0) return "mirrored";
  if (columns.some((a) => !(Math.abs(dot(a, a) - 1) <= tolerance)))
    return `scaled by ${columns.map((a) => Number(Math.sqrt(dot(a, a)).toPrecision(6))).join(" ")}`;
  const [a, b, c] = columns;
  return [dot(a, b), dot(b, c), dot(a, c)].every((product) => Math.abs(product) <= tolerance) ? "" : "sheared";
}

function objectRows(object, name) {
  const rows = worldRows(object);
  const beyond = beyondPose(rows);
  if (beyond !== "")
    throw new InvalidInput(
      `${name}: the object is ${beyond} in the world, which no pose is: fromObject3D(object) gives a body with that in it, and its pose`,
    );
  return rows;
}

/** An array that a matrix column by column would be: row by row, its last row is 0 0 0 1. */
function refuseColumns(list, name) {
  const isColumns = list[15] === 1 && [3, 7, 11].every((i) => list[i] === 0) && [12, 13, 14].some((i) => list[i] !== 0);
  if (isColumns)
    throw new InvalidInput(`${name}: 16 numbers column by column; a pose has them row by row: give the Matrix4 itself, or { elements: numbers }`);
}

const aPose =
  "a pose is a place with a turn: { position: { x, y, z }, quaternion: { x, y, z, w } }, an Object3D, a Matrix4, or 3, 7 (x y z qw qx qy qz) or 16 numbers";

/** An object that has the parts of an Object3D, but no matrix in the world. */
function plainParts({ position, quaternion, scale }, name) {
  const numbersOf = (part, letters, partName) =>
    [...letters].map((letter) => {
      if (typeof part[letter] === "number") return part[letter];
      throw new InvalidInput(`${name}: ${partName}.${letter}: ${shown(part[letter])} is not a number: ${aPose}`);
    });
  const factors = scale ? numbersOf(scale, "xyz", "scale") : [];
  if (factors.some((factor) => factor !== 1)) throw new InvalidInput(`${name}: the object is scaled by ${factors.join(" ")}, which no pose is`);
  return [...numbersOf(position, "xyz", "position"), ...numbersOf(quaternion, "wxyz", "quaternion")];
}

/** What is no pose, and how it becomes a part of one. */
function refuseOther(value, name) {
  const isEuler = value?.isEuler || (isList(value) && value.length === 4 && typeof value[3] === "string");
  if (isEuler) throw new InvalidInput(`${name}: an Euler is no pose: ${aPose}; quaternion.setFromEuler(euler) makes the turn`);
  if (typeof value?.w === "number" && typeof value.x === "number") throw new InvalidInput(`${name}: a quaternion or a vector of 4 numbers is no pose: ${aPose}`);
  if (isList(value) && value.length === 4) throw new InvalidInput(`${name}: 4 numbers found, as of a quaternion alone: ${aPose}`);
  if (!isList(value)) throw new InvalidInput(`${name}: ${shown(value)} is no array of numbers${wayOut(value) || `: ${aPose}`}`);
  if (value.length > 16)
    throw new InvalidInput(`${name}: ${value.length} numbers found; a pose has 3 (x y z), 7 (x y z qw qx qy qz) or 16 (4x4, row by row)`);
}

/** The numbers of a pose, as they go into the module: 3, 7, or 16 row by row. */
export function poseNumbers(value, name) {
  if (value?.matrixWorld?.elements?.length === 16) return objectRows(value, name);
  if (value?.position && value?.quaternion) return plainParts(value, name);
  if (value?.elements?.length === 16) return rowsOf(value);
  if (isList(value) && value.length === 16) refuseColumns(value, name);
  refuseOther(value, name);
  return value;
}

/** A pose: 3, 7 or 16 numbers, or an object of three.js: a Matrix4, or an Object3D. */
export function addPose(numbers, value, name) {
  return addCounted(numbers, poseNumbers(value, name), name);
}

export function addPoses(numbers, list, name) {
  if (!isList(list)) throw new InvalidInput(`${name}: ${shown(list)} is no array of poses`);
  numbers.push(list.length);
  for (let i = 0; i < list.length; ++i) addPose(numbers, list[i], `${name}[${i}]`);
  return numbers;
}

/** A pose as an array that goes to a worker. */
export function copiedPose(value, name) {
  return addPose([], value, name).slice(1);
}

/**
 * A matrix in the world as a pose, and the rest: what is left of the matrix where the body does not turn and is not shifted.
 * The rest is upper triangular; it holds scale, shear and mirroring.
 */
export function separated(rows) {
  const unit = (a) => a.map((x) => x / Math.sqrt(dot(a, a)));
  const [a, b] = [column(rows, 0), column(rows, 1)];
  const first = unit(a);
  const second = unit(b.map((x, k) => x - first[k] * dot(first, b)));
  const axes = [first, second, cross(first, second)];
  const rest = axes.flatMap((axis, i) => [0, 1, 2].map((k) => (k < i ? 0 : dot(axis, column(rows, k)))));
  return { pose: posed(axes, rows), rest };
}

/** The pose of an object whose matrix has this rest, or undefined if its rest is another one. */
export function poseWithRest(rows, rest) {
  const [a, b, c] = [0, 1, 2].map((k) => column(rows, k));
  const [s, t, u, , v, w, , , x] = rest;
  const first = a.map((entry) => entry / s);
  const second = b.map((entry, k) => (entry - first[k] * t) / v);
  const third = c.map((entry, k) => (entry - first[k] * u - second[k] * w) / x);
  const pose = posed([first, second, third], rows);
  return beyondPose(pose) === "" ? pose : undefined;
}

/** 16 numbers of three columns, and of the translation of another matrix. */
function posed([a, b, c], rows) {
  return [0, 1, 2].flatMap((i) => [a[i], b[i], c[i], rows[4 * i + 3]]).concat([0, 0, 0, 1]);
}
