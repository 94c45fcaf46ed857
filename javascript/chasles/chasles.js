// One instance of the library: everything is asked from here.
import { firstContact, leastDistance, pathContact, Reader } from "./answers.js";
import { Border } from "./border.js";
import { InvalidInput } from "./errors.js";
import { Held } from "./held.js";
import {
  checkBatch, checkOptions, find, fixedOptions, motion, motionOptions, number, poses, query, queryOptions, rule,
} from "./numbers.js";
import { fromArrays, fromBufferGeometry, fromFile, Polyhedron } from "./polyhedron.js";
import { DraggedBody, Scene } from "./scene.js";
import { Workers } from "./workers.js";

const allOptions = [...queryOptions, ...motionOptions, ...fixedOptions];

/** What `load` returns. */
export class Chasles {
  #border;

  constructor(border) {
    this.#border = border;
  }

  static async of(module) {
    return new Chasles(await Border.open(module));
  }

  polyhedron(vertices, faces, options = {}) {
    return fromArrays(this.#border, vertices, faces, options);
  }
  fromFile(content, name, options = {}) {
    return fromFile(this.#border, content, name, options);
  }
  fromBufferGeometry(geometry, options = {}) {
    return fromBufferGeometry(this.#border, geometry, options);
  }
  scene() {
    return new Scene(this.#border);
  }
  draggedBody(scene, name, options = {}) {
    return new DraggedBody(this.#border, scene, name, options);
  }

  firstContact(moving, fixed, start, goal, options = {}) {
    checkOptions(options, allOptions);
    this.#border.giveNumbers([...this.#bodies(moving, fixed), ...query(options), ...motion(start, goal, options)]);
    return firstContact(this.#ask("first_contact"));
  }

  /** True if it is proven that no contact occurs on the whole motion. */
  isClear(moving, fixed, start, goal, options = {}) {
    checkOptions(options, allOptions.filter((key) => key !== "find"));
    return this.firstContact(moving, fixed, start, goal, { ...options, find: "any" }).verdict === "clear";
  }

  firstContactOnPath(moving, fixed, path, options = {}) {
    checkOptions(options, [...queryOptions, ...motionOptions]);
    const bodies = this.#bodies(moving, fixed);
    this.#border.giveNumbers([...bodies, ...query(options), ...rule(options), ...poses(path, "poses")]);
    return pathContact(this.#ask("first_contact_on_path"));
  }

  leastDistance(moving, fixed, start, goal, options = {}) {
    checkOptions(options, ["tolerance", "timeTolerance", "find", ...motionOptions, ...fixedOptions]);
    const { tolerance, timeTolerance } = options;
    const numbers = [number(tolerance, "tolerance", 1e-6), number(timeTolerance, "timeTolerance", 1e-12)];
    const asked = [...numbers, find(options.find), ...motion(start, goal, options)];
    this.#border.giveNumbers([...this.#bodies(moving, fixed), ...asked]);
    return leastDistance(this.#ask("least_distance"));
  }

  /** Where the moving body is at a time in [0, 1]. */
  poseAt(start, goal, time, options = {}) {
    checkOptions(options, [...motionOptions, ...fixedOptions]);
    this.#border.giveNumbers([number(time, "time"), ...motion(start, goal, options)]);
    return Array.from(this.#border.ask("pose_at"));
  }

  /** One answer a motion, in order. */
  firstContactBatch(moving, fixed, starts, goals, options = {}) {
    checkBatch(starts, goals);
    return Array.from(starts, (start, i) => {
      try {
        return this.firstContact(moving, fixed, start, goals[i], options);
      } catch (error) {
        throw error instanceof InvalidInput ? new InvalidInput(`motion ${i}: ${error.message}`) : error;
      }
    });
  }

  /** Workers with an instance each, for batches. */
  workers(options = {}) {
    return Workers.start(this.#border.module, options);
  }

  /** How many objects are not freed. */
  get held() {
    const count = (kind) => this.#border.call("held", kind);
    return { polyhedra: count(0), scenes: count(1), draggedBodies: count(2) };
  }

  /** A body that another instance sent. */
  // For the package itself.
  static adopt(chasles, copy) {
    return Polyhedron.ofCopy(chasles.#border, copy);
  }

  #bodies(moving, fixed) {
    const handle = (body, name) => Held.handle(body, this.#border, Polyhedron, name);
    return [handle(moving, "moving"), handle(fixed, "fixed")];
  }
  #ask(name) {
    return new Reader(this.#border.ask(name));
  }
}
