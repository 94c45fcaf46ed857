// The module in memory: arguments go in through two buffers, answers come out of one (javascript/src/border.h).
import { Reader } from "./answers.js";
import { InstanceStopped, InvalidInput, outOfMemory } from "./errors.js";
import { inJavaScript, Numbers } from "./values.js";

const refused = -1;
const memoryIsFull = -2;
const mostOfBuffer = 2 ** 32 - 1; // counts go in as 32 bits

const noText =
  'load: there are no TextEncoder and TextDecoder here, as in the environment jsdom of Jest: test in the environment "node", or set both of node:util as globals before';

/** What the module imports: a clock. Nothing in it reads or writes files; the rest stands for "not supported". */
function imports(module, memory) {
  const notSupported = () => 52;
  const given = {
    clock_time_get(_clock, _precision, address) {
      new DataView(memory().buffer).setBigUint64(address, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    proc_exit(code) {
      throw new Error(`the module ended itself with ${code}`);
    },
  };
  const named = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    (named[from] ??= {})[name] = given[name] ?? notSupported;
  return named;
}

/** One instance of the module. Every call goes through `call`, so that no fault of the module stays unnoticed. */
export class Border {
  #exports;
  #numbers = new Float64Array(); // the whole memory
  #stopped = null;

  constructor(module, exports) {
    this.module = module;
    this.#exports = exports;
    this.#enter("_initialize", []);
  }

  static async open(module) {
    if (typeof TextDecoder === "undefined" || typeof TextEncoder === "undefined") throw new InvalidInput(noText);
    let exports = null;
    const instance = await WebAssembly.instantiate(module, imports(module, () => exports.memory));
    exports = instance.exports;
    return new Border(module, exports);
  }

  /** Calls `chasles_NAME`. Returns its count or handle; throws what went wrong. */
  call(name, ...values) {
    const status = this.#enter(`chasles_${name}`, values);
    if (status >= 0) return status;
    if (status === refused) throw new InvalidInput(inJavaScript(this.#text()));
    if (status === memoryIsFull) throw outOfMemory();
    this.#stopped = new Error(this.#text());
    throw new InstanceStopped(this.#stopped);
  }

  /** Calls `chasles_NAME`, which answers with numbers. The array is a copy. */
  ask(name, ...values) {
    const count = this.call(name, ...values);
    const from = this.#address("answer") / 8;
    return this.#memory().slice(from, from + count);
  }

  /** Reads the answer of `chasles_NAME` in place: to be done before the next call. */
  read(name, ...values) {
    this.call(name, ...values);
    return new Reader(this.#memory(), this.#address("answer") / 8);
  }

  /** Writes numbers for the next call: an array, a typed array, or Numbers. */
  giveNumbers(given) {
    const numbers = given instanceof Numbers ? given.all : given;
    const address = this.#address("numbers", numbers.length);
    this.#memory().set(numbers, address / 8);
  }

  /** Writes byte arrays, one after another, for the next call. */
  giveBytes(...parts) {
    const size = parts.reduce((sum, part) => sum + part.length, 0);
    let address = this.#address("bytes", size);
    for (const part of parts) {
      new Uint8Array(this.#exports.memory.buffer, address, part.length).set(part);
      address += part.length;
    }
  }

  /** Frees an object; without effect in an instance that has stopped. */
  free(kind, handle) {
    if (!this.#stopped) this.call(`free_${kind}`, handle);
  }

  /** The address of a buffer, which has room for `count`. */
  #address(buffer, count = 0) {
    if (count > mostOfBuffer) throw outOfMemory();
    const address = this.#enter(`chasles_${buffer}`, [count]) >>> 0;
    if (address === 0 && count > 0) throw outOfMemory();
    return address;
  }

  /** All of the module's memory as numbers: a new array when it has grown. */
  #memory() {
    const { buffer } = this.#exports.memory;
    if (this.#numbers.buffer !== buffer) this.#numbers = new Float64Array(buffer);
    return this.#numbers;
  }

  /** Calls a function. A trap in it leaves the module in a state that nobody knows: the instance is not used again. */
  #enter(name, values) {
    if (this.#stopped) throw new InstanceStopped(this.#stopped);
    try {
      return this.#exports[name](...values);
    } catch (error) {
      this.#stopped = error;
      throw new InstanceStopped(error);
    }
  }

  #text() {
    const bytes = new Uint8Array(this.#exports.memory.buffer, this.#address("text"));
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }
}
