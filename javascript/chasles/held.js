// Objects of the module that JavaScript holds: freed by hand, by `using`, or when nothing refers to them any more.
import { InvalidInput } from "./errors.js";

const registry = new FinalizationRegistry(({ border, kind, handle }) => border.free(kind, handle));

export const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

export class Held {
  #border;
  #kind;
  #handle;

  constructor(border, kind, handle) {
    this.#border = border;
    this.#kind = kind;
    this.#handle = handle;
    registry.register(this, { border, kind, handle }, this);
  }

  /** Gives the memory back. The object cannot be used any more; a second call has no effect. */
  free() {
    if (this.#handle === 0) return;
    registry.unregister(this);
    this.#border.free(this.#kind, this.#handle);
    this.#handle = 0;
  }

  [dispose]() {
    this.free();
  }

  /** The border of an object, and its handle in this instance. */
  static border(held) {
    return held.#border;
  }
  static handle(held, border, type, name) {
    if (!(held instanceof type)) throw new InvalidInput(`${name}: is no ${type.title}`);
    if (held.#handle === 0) throw new InvalidInput(`${name}: has been freed`);
    if (held.#border !== border) throw new InvalidInput(`${name}: belongs to another instance`);
    return held.#handle;
  }
}
