// Arguments of any kind: checked, and refused in words.
import { InvalidInput, outOfMemory } from "./errors.js";

const limits =
  'only update(goal, seconds) of a dragged body has a limit; a question ends with the worker that it runs in: README, "Limits and cancelling"';
/** What is an option elsewhere, and how it is done here. */
const wayOutOf = { seconds: limits, signal: limits, timeout: limits, limit: limits };

/** Options are an object without other keys than these. Only `undefined` counts as left out. */
export function checkOptions(options, known, name = "options") {
  if (Object.prototype.toString.call(options) !== "[object Object]") throw new InvalidInput(`${name}: must be an object with ${known.join(", ")}`);
  for (const key of Object.keys(options)) {
    if (options[key] === undefined) continue;
    if (!known.includes(key)) {
      const wayOut = Object.hasOwn(wayOutOf, key) ? ` (${wayOutOf[key]})` : "";
      throw new InvalidInput(`${key}: is no option here${wayOut}; there are ${known.join(", ")}`);
    }
    if (options[key] === null) throw new InvalidInput(`${key}: is null, which is no value: leave it out, or give undefined`);
  }
}

/** A number, or the default if there is none. Its range is checked by the library. */
export function number(value, name, byDefault) {
  if (value === undefined && byDefault !== undefined) return byDefault;
  if (typeof value !== "number") throw new InvalidInput(`${name}: ${shown(value)} is not a number`);
  return value;
}

const optionOf = { max_turn: "maxTurn", time_tolerance: "timeTolerance", absolute_tolerance: "absoluteTolerance" };

/** A message of the library, which writes `max_turn` for `maxTurn` in front of its colon, and has stamps where a body of a scene has times. */
export const inJavaScript = (message) =>
  message
    .replace(/^((?:\w+: )?)(max_turn|time_tolerance|absolute_tolerance)(?=:)/, (_, asked, name) => asked + optionOf[name])
    .replace(/^timed poses: stamps: .*/s, (stamps) => stamps.replace("timed poses: stamps", "motion: times").replaceAll("stamp ", "time "));

export function text(value, name) {
  if (typeof value !== "string") throw new InvalidInput(`${name}: ${shown(value)} is not a text`);
  return value;
}

export const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** Also one of another realm: of a frame, or of Node.js in jsdom. */
export const isArrayBuffer = (value) => Object.prototype.toString.call(value) === "[object ArrayBuffer]";

/** The bytes of a buffer, or of a view of one, in place. */
export function asBytes(given, name) {
  try {
    if (isList(given)) Uint8Array.prototype.keys.call(given); // throws if its bytes are gone
    const { buffer, byteOffset, byteLength } = ArrayBuffer.isView(given) ? given : { buffer: given };
    return new Uint8Array(buffer, byteOffset, byteLength);
  } catch {
    const { maxByteLength, byteLength } = given.buffer ?? given; // 0 once it is detached
    const isShort = (maxByteLength ?? byteLength) > 0;
    throw new InvalidInput(
      isShort
        ? `${name}: lies beyond the end of its buffer, which was made shorter by resize`
        : `${name}: is detached: its bytes belong to another thread now, as after postMessage`,
    );
  }
}

/** What a point of three.js, or an object of Babylon.js, is to be given as. Quaternions and Eulers are no points. */
export function wayOut(value) {
  if (typeof value?.x === "number" && typeof value.y === "number" && value.w === undefined && !value.isEuler)
    return `: a Vector3 is given as v.${typeof value.asArray === "function" ? "asArray" : "toArray"}()`;
  if (typeof value?.computeWorldMatrix === "function") return ": a node of Babylon.js is given as { elements: node.computeWorldMatrix(true).asArray() }";
  return typeof value?.asArray === "function" ? ": a Matrix of Babylon.js is given as { elements: matrix.asArray() }" : "";
}

export function shown(value) {
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "string") return JSON.stringify(value);
  if (Array.isArray(value)) return "an array";
  try {
    return String(value).replace(/\s+/g, " ");
  } catch {
    return "an object"; // without a text, as a Proxy of a typed array
  }
}

/** A typed array of the entries. `from` of a typed array makes an Array of them first, and a long Array ends the process. */
export function converted(Type, list, convert) {
  const entries = new Type(list.length);
  for (let i = 0; i < list.length; ++i) entries[i] = convert(list[i], i);
  return entries;
}

const mostNumbers = 2 ** 29; // 4 GiB

/** A list of numbers of any length: engines end the process where an Array grows beyond 2^27 entries. */
export class Numbers {
  #room = new Float64Array(256);
  #count = 0;

  constructor(...numbers) {
    this.push(...numbers);
  }

  push(...numbers) {
    for (const entry of numbers) {
      if (this.#count === this.#room.length) this.#grow();
      this.#room[this.#count++] = entry;
    }
  }

  /** In place: to be used before the next push. */
  get all() {
    return this.#room.subarray(0, this.#count);
  }

  #grow() {
    if (this.#count === mostNumbers) throw outOfMemory();
    const larger = new Float64Array(2 * this.#room.length);
    larger.set(this.#room);
    this.#room = larger;
  }
}

/** A list of numbers. */
export function addNumbers(numbers, list, name) {
  if (!isList(list)) throw new InvalidInput(`${name}: ${shown(list)} is no array of numbers${wayOut(list)}`);
  for (let i = 0; i < list.length; ++i) {
    if (typeof list[i] !== "number") number(list[i], `${name}[${i}]`); // throws
    numbers.push(list[i]);
  }
  return numbers;
}

/** The same behind their count. */
export function addCounted(numbers, list, name) {
  numbers.push(list?.length);
  return addNumbers(numbers, list, name);
}

/** A point or a direction, behind the count of its numbers. */
export function addPoint(numbers, list, name) {
  if (isList(list) && list.length !== 3) throw new InvalidInput(`${name}: a point needs 3 numbers, and there are ${list.length}`);
  return addCounted(numbers, list, name);
}
