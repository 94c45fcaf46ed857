// Many bodies in one world, and a body in a hand.
import { dragStep, sceneContact, sceneDistance, sceneDistances, sceneEvents, sceneProfile } from "./answers.js";
import { InvalidInput } from "./errors.js";
import { given, Held } from "./held.js";
import { addDrag, addLeast, addProfile, addQuery, addWorldMotion, addWorldRule, dragOptions, leastOptions, profileOptions } from "./numbers.js";
import { Polyhedron } from "./polyhedron.js";
import { addPose, addPoses } from "./poses.js";
import { checkOptions, Numbers, number, shown, text } from "./values.js";

const motionKeys = ["pose", "goal", "motion", "centre", "poses", "times"];
const questions = { firstContact: 0, allContacts: 1, clearUntil: 2, leastDistance: 3, profile: 4, leastDistances: 5 };
const rules = { ignore: 0, ignoreGroups: 1, setMargin: 2, setGroupMargin: 3, setHold: 4, setGroupHold: 5 };

/** A name in UTF-8, in which all halves of characters would be one. */
function encode(value, name) {
  if (/\p{Surrogate}/u.test(text(value, name))) throw new InvalidInput(`${name}: ${shown(value)} has half of a surrogate pair, which is no character`);
  return new TextEncoder().encode(value);
}

/** Many bodies in one world, each with its own motion over the time [0, 1]. */
export class Scene extends Held {
  static title = "Scene";
  #names = []; // in the order of the bodies
  #shown = null; // the same, frozen: made at the first read after a change

  constructor(border) {
    super(border, "scene", given(border, "Scene", "chasles.scene()").call("scene"));
  }

  get names() {
    ownOfScene(this); // a freed scene is refused
    return Scene.namesOf(this);
  }

  /** Also of a freed scene, which a dragged body keeps. */
  static namesOf(scene) {
    return (scene.#shown ??= Object.freeze([...scene.#names]));
  }

  add(name, shape, options = {}) {
    const { border, handle } = ownOfScene(this);
    checkOptions(options, [...motionKeys, "group"]);
    const body = Held.handle(shape, border, Polyhedron, "shape");
    const nameBytes = encode(name, "name");
    border.giveNumbers(addWorldMotion(new Numbers(), options, [0, 0, 0]));
    border.giveBytes(nameBytes, encode(options.group ?? "", "group"));
    border.call("scene_add", handle, body, nameBytes.length);
    this.#names.push(name);
    this.#shown = null;
    return name;
  }

  /** The last body takes the place of the removed one in `names`. */
  remove(name) {
    const { border, handle } = ownOfScene(this);
    border.giveBytes(encode(name, "name"));
    const index = border.call("scene_remove", handle);
    const last = this.#names.pop();
    this.#shown = null;
    if (index < this.#names.length) this.#names[index] = last;
  }

  move(name, options = {}) {
    const { border, handle } = ownOfScene(this);
    checkOptions(options, motionKeys);
    border.giveNumbers(addWorldMotion(new Numbers(), options));
    border.giveBytes(encode(name, "name"));
    border.call("scene_move", handle);
  }

  /** All bodies at once, in the order of `names`. */
  moveAll(starts, goals, options = {}) {
    const { border, handle } = ownOfScene(this);
    checkOptions(options, ["motion"]);
    const rule = addWorldRule(new Numbers(), options);
    border.giveNumbers(addPoses(addPoses(rule, starts, "starts"), goals, "goals"));
    border.call("scene_move_all", handle);
  }

  /** Where a body is at a time in [0, 1]. */
  poseAt(name, time) {
    const { border, handle } = ownOfScene(this);
    border.giveNumbers([number(time, "time")]);
    border.giveBytes(encode(name, "name"));
    return Array.from(border.ask("scene_pose", handle));
  }

  ignore(a, b) {
    setRule(this, "ignore", a, b);
  }
  ignoreGroups(a, b) {
    setRule(this, "ignoreGroups", a, b);
  }
  setMargin(a, b, margin) {
    setRule(this, "setMargin", a, b, number(margin, "margin"));
  }
  setGroupMargin(a, b, margin) {
    setRule(this, "setGroupMargin", a, b, number(margin, "margin"));
  }
  setHold(a, b, hold) {
    setRule(this, "setHold", a, b, number(hold, "hold"));
  }
  setGroupHold(a, b, hold) {
    setRule(this, "setGroupHold", a, b, number(hold, "hold"));
  }

  firstContact(options = {}) {
    return sceneContact(ask(this, "firstContact", options), this.#names);
  }
  allContacts(options = {}) {
    return sceneEvents(ask(this, "allContacts", options), this.#names);
  }
  clearUntil(options = {}) {
    const reader = ask(this, "clearUntil", options);
    return Object.fromEntries(this.#names.map((name) => [name, reader.number()]));
  }
  leastDistance(options = {}) {
    checkOptions(options, leastOptions);
    return sceneDistance(answer(this, "leastDistance", addLeast([], options)), this.#names);
  }
  leastDistances(options = {}) {
    checkOptions(options, leastOptions);
    return sceneDistances(answer(this, "leastDistances", addLeast([], options)), this.#names);
  }
  profile(options = {}) {
    checkOptions(options, profileOptions);
    return sceneProfile(answer(this, "profile", addProfile(new Numbers(), options)), this.#names);
  }
}

// No private methods: those of a Proxy fail without a word of ours.
const ownOfScene = (scene) => Held.own(scene, Scene, "scene");

function setRule(scene, rule, a, b, distance = 0) {
  const { border, handle } = ownOfScene(scene);
  const first = encode(a, "a");
  border.giveBytes(first, encode(b, "b"));
  border.call("scene_rule", handle, rules[rule], first.length, distance);
}

function ask(scene, question, options) {
  checkOptions(options, ["margin", "hold", "until", "timeTolerance", "find"]);
  return answer(scene, question, [...addQuery([], options, question !== "firstContact"), number(options.until, "until", 1)]);
}

function answer(scene, question, numbers) {
  const { border, handle } = ownOfScene(scene);
  border.giveNumbers(numbers);
  return border.read("scene_question", handle, questions[question]);
}

/** A body of a scene in a hand: it stops at contacts, slides along them and lifts off, and never goes through. */
export class DraggedBody extends Held {
  static title = "DraggedBody";
  #scene;
  #name;

  constructor(border, scene, name, options = {}) {
    given(border, "DraggedBody", "chasles.draggedBody(scene, name)");
    checkOptions(options, dragOptions);
    const handle = Held.handle(scene, border, Scene, "scene");
    border.giveNumbers(addDrag([], options));
    border.giveBytes(encode(name, "name"));
    super(border, "hand", border.call("hand", handle));
    this.#scene = scene;
    this.#name = name;
  }

  get name() {
    ownOfHand(this);
    return this.#name;
  }

  update(goal, seconds = 0) {
    const { border, handle } = ownOfHand(this);
    border.giveNumbers(addPose([], goal, "goal"));
    if (Number.isNaN(seconds)) throw new InvalidInput("seconds: NaN is not a number; 0 is no bound");
    return dragStep(border.read("hand_update", handle, number(seconds, "seconds")), Scene.namesOf(this.#scene));
  }

  /** Force and torque on the hand for another goal, from the contacts that the last update ended with. */
  force(goal) {
    const { border, handle } = ownOfHand(this);
    border.giveNumbers(addPose([], goal, "goal"));
    return Array.from(border.ask("hand_force", handle));
  }

  get pose() {
    return state(this).slice(0, 7);
  }
  get margin() {
    return state(this)[7];
  }
  get reach() {
    return state(this)[8];
  }
}

const ownOfHand = (hand) => Held.own(hand, DraggedBody, "dragged body");

function state(hand) {
  const { border, handle } = ownOfHand(hand);
  return Array.from(border.ask("hand_state", handle));
}
