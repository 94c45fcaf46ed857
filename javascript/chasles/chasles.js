// One instance of the library: everything is asked from here.
import { firstContact, leastDistance, pathContact } from "./answers.js";
import { Border } from "./border.js";
import { InvalidInput } from "./errors.js";
import { Held } from "./held.js";
import {
  addMotion, addPoses, addQuery, addRule, checkBatch, checkOptions, find, fixedOptions, motionOptions, number, queryOptions,
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
    const asked = addQuery(this.#bodies(moving, fixed), options);
    this.#border.giveNumbers(addMotion(asked, start, goal, options));
    return firstContact(this.#border.read("first_contact"));
  }

  /** True if it is proven that no contact occurs on the whole motion. */
  isClear(moving, fixed, start, goal, options = {}) {
    checkOptions(options, allOptions.filter((key) => key !== "find"));
    return this.firstContact(moving, fixed, start, goal, { ...options, find: "any" }).verdict === "clear";
  }

  firstContactOnPath(moving, fixed, path, options = {}) {
    checkOptions(options, [...queryOptions, ...motionOptions]);
    const asked = addQuery(this.#bodies(moving, fixed), options);
    this.#border.giveNumbers(addPoses(addRule(asked, options), path, "poses"));
    return pathContact(this.#border.read("first_contact_on_path"));
  }

  leastDistance(moving, fixed, start, goal, options = {}) {
    checkOptions(options, ["tolerance", "timeTolerance", "find", ...motionOptions, ...fixedOptions]);
    const { tolerance, timeTolerance } = options;
    const asked = this.#bodies(moving, fixed);
    asked.push(number(tolerance, "tolerance", 1e-6), number(timeTolerance, "timeTolerance", 1e-12), find(options.find));
    this.#border.giveNumbers(addMotion(asked, start, goal, options));
    return leastDistance(this.#border.read("least_distance"));
  }

  /** Where the moving body is at a time in [0, 1]. */
  poseAt(start, goal, time, options = {}) {
    checkOptions(options, [...motionOptions, ...fixedOptions]);
    this.#border.giveNumbers(addMotion([number(time, "time")], start, goal, options));
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
}
