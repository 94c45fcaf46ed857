// Objects of the module that JavaScript holds: freed by hand, by `using`, or when nothing refers to them any more.
import { InvalidInput } from "./errors.js";

/** Frees the object, and tells those who follow it. */
function release(own) {
  own.border.free(own.kind, own.handle);
  own.handle = 0;
  for (const work of own.followers.splice(0)) work();
}

const registry = new FinalizationRegistry(release);

export const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

export class Held {
  #own; // what outlives this object, for the registry

  constructor(border, kind, handle) {
    this.#own = { border, kind, handle, followers: [] };
    registry.register(this, this.#own, this);
  }

  /** Gives the memory back. The object cannot be used any more; a second call has no effect. */
  free() {
    if (this.#own.handle === 0) return;
    registry.unregister(this);
    release(this.#own);
  }

  [dispose]() {
    this.free();
  }

  /** The border of an object, and its handle in this instance. */
  static border(held) {
    return held.#own.border;
  }
  static handle(held, border, type, name) {
    if (!(held instanceof type)) throw new InvalidInput(`${name}: is no ${type.title}${held?.body instanceof type ? ", but has one: give its body" : ""}`);
    if (held.#own.handle === 0) throw new InvalidInput(`${name}: has been freed`);
    if (held.#own.border !== border) throw new InvalidInput(`${name}: belongs to another instance`);
    return held.#own.handle;
  }

  /** Calls `work` when the object is freed, by hand or because nothing refers to it. `work` must not refer to it, either. */
  static follow(held, work) {
    held.#own.followers.push(work);
  }
}
