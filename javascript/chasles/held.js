// Objects of the module that JavaScript holds: freed by hand, by `using`, or when nothing refers to them any more.
import { Border } from "./border.js";
import { InvalidInput } from "./errors.js";

/** Frees the object, and tells those who follow it. */
function release(own) {
  own.border.free(own.kind, own.handle);
  own.handle = 0;
  own.kept.clear();
  for (const work of own.followers.splice(0)) work();
}

const registry = new FinalizationRegistry(release);

export const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

/** Members that work without the object in front of them, and behind a Proxy of it, which has no private members. */
export function bindMembers(object, type) {
  for (const [name, { value, get }] of Object.entries(Object.getOwnPropertyDescriptors(type.prototype)))
    if (name !== "constructor") Object.defineProperty(object, name, get ? { get: get.bind(object) } : { value: value.bind(object) });
}

/** `border`, for a constructor. Only the package has one. */
export function given(border, title, maker) {
  if (!(border instanceof Border)) throw new InvalidInput(`${title}: is made by ${maker}, not by new ${title}()`);
  return border;
}

export class Held {
  #own; // what outlives this object, for the registry

  constructor(border, kind, handle) {
    this.#own = { border, kind, handle, followers: [], kept: new Map() };
    registry.register(this, this.#own, this);
  }

  /** Gives the memory back. The object cannot be used any more; a second call has no effect. */
  free() {
    const own = Held.#of(this, "object");
    if (own.handle === 0) return;
    registry.unregister(this);
    release(own);
  }

  [dispose]() {
    this.free();
  }

  /** Vue and Alpine.js make no Proxy of an object that names its class so. */
  get [Symbol.toStringTag]() {
    return this.constructor.title;
  }

  static #of(held, name) {
    if (#own in held) return held.#own;
    throw new InvalidInput(`${name}: is a Proxy of a ${held.constructor.title}: give the object itself (Vue: toRaw), and keep it in a reactive state by markRaw or shallowRef (Vue) or ref (Valtio)`);
  }

  /** The border of an object, and its handle in it. */
  static own(held, type, name) {
    if (!(held instanceof type)) throw new InvalidInput(`${name}: is no ${type.title}${held?.body instanceof type ? ", but has one: give its body" : ""}`);
    const own = Held.#of(held, name);
    if (own.handle === 0) throw new InvalidInput(`${name}: has been freed`);
    return own;
  }
  /** The handle of an object in this instance. */
  static handle(held, border, type, name) {
    const own = Held.own(held, type, name);
    if (own.border !== border) throw new InvalidInput(`${name}: belongs to another instance`);
    return own.handle;
  }

  /** Calls `work` when the object is freed, by hand or because nothing refers to it. `work` must not refer to it, either. */
  static follow(held, work) {
    held.#own.followers.push(work);
  }
}
