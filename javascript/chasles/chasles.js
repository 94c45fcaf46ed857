// One instance of the library: everything is asked from here.
import { firstContact, leastDistance, pathContact, profile } from "./answers.js";
import { Border } from "./border.js";
import { InvalidInput } from "./errors.js";
import { bindMembers, given, Held } from "./held.js";
import { fromBufferGeometry, fromObject3D } from "./geometry.js";
import {
  addLeast, addMotion, addProfile, addQuery, addRule, checkBatch, checkContactOptions, contactOptions, fixedOptions, leastOptions, motionOptions, profileOptions, queryOptions,
} from "./numbers.js";
import { capsule, fromArrays, fromFile, pointsBody, Polyhedron } from "./polyhedron.js";
import { addPoses } from "./poses.js";
import { DraggedBody, Scene } from "./scene.js";
import { checkOptions, Numbers, number } from "./values.js";
import { Workers } from "./workers.js";

/** What `load` returns. */
export class Chasles {
  #border;
  #newWorker;

  constructor(border, newWorker) {
    this.#border = given(border, "Chasles", "load()");
    this.#newWorker = newWorker;
    bindMembers(this, Chasles); // const { firstContact } = chasles
  }

  /** `newWorker` makes the workers of a build. */
  static async of(module, newWorker) {
    return new Chasles(await Border.open(module), newWorker);
  }

  polyhedron(vertices, faces, options = {}) {
    return fromArrays(this.#border, vertices, faces, options);
  }
  sphere(radius) {
    return pointsBody(this.#border, [0, 0, 0], radius);
  }
  capsule(radius, length) {
    return capsule(this.#border, radius, length);
  }
  points(points, radius) {
    return pointsBody(this.#border, points, radius);
  }
  fromFile(content, name, options = {}) {
    return fromFile(this.#border, content, name, options);
  }
  fromBufferGeometry(geometry, options = {}) {
    return fromBufferGeometry(this.#border, geometry, options);
  }
  /** A body of a Mesh of three.js as it is drawn, with scale, shear and mirroring in it, and where it is: `{ body, pose }`. */
  fromObject3D(mesh, options = {}) {
    return fromObject3D(this.#border, mesh, options);
  }
  scene() {
    return new Scene(this.#border);
  }
  draggedBody(scene, name, options = {}) {
    return new DraggedBody(this.#border, scene, name, options);
  }

  firstContact(moving, fixed, start, goal, options = {}) {
    checkOptions(options, contactOptions);
    const asked = addQuery(this.#bodies(moving, fixed), options);
    this.#border.giveNumbers(addMotion(asked, start, goal, options));
    return firstContact(this.#border.read("first_contact"));
  }

  /** True if it is proven that no contact occurs on the whole motion. */
  isClear(moving, fixed, start, goal, options = {}) {
    checkOptions(options, contactOptions.filter((key) => key !== "find"));
    return this.firstContact(moving, fixed, start, goal, { ...options, find: "any" }).verdict === "clear";
  }

  firstContactOnPath(moving, fixed, path, options = {}) {
    checkOptions(options, [...queryOptions, ...motionOptions]);
    const asked = addQuery(new Numbers(...this.#bodies(moving, fixed)), options);
    this.#border.giveNumbers(addPoses(addRule(asked, options), path, "poses"));
    return pathContact(this.#border.read("first_contact_on_path"));
  }

  leastDistance(moving, fixed, start, goal, options = {}) {
    checkOptions(options, [...leastOptions, ...motionOptions, ...fixedOptions]);
    const asked = addLeast(this.#bodies(moving, fixed), options);
    this.#border.giveNumbers(addMotion(asked, start, goal, options));
    return leastDistance(this.#border.read("least_distance"));
  }

  profile(moving, fixed, start, goal, options = {}) {
    checkOptions(options, [...profileOptions, ...motionOptions, ...fixedOptions]);
    const asked = addProfile(new Numbers(...this.#bodies(moving, fixed)), options);
    this.#border.giveNumbers(addMotion(asked, start, goal, options));
    return profile(this.#border.read("profile"));
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
    checkContactOptions(options);
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
    return Workers.start(this.#border, this.#newWorker, options);
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
