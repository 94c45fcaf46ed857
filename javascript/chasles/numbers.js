// Arguments as numbers, in the order in which javascript/src/numbers_in.cpp reads them. Functions that begin with "add" append to a
// list of numbers, and return it.
import { InvalidInput } from "./errors.js";
import { addPose, addPoses } from "./poses.js";
import { addCounted, checkOptions, isList, number, shown, text } from "./values.js";

const kinds = ["screw", "sweep", "velocity", "twist"];
const finds = ["first", "any", "first_with_all_contacts"];

export const queryOptions = ["margin", "hold", "timeTolerance", "find"];
export const motionOptions = ["motion", "centre", "maxTurn"];
export const fixedOptions = ["fixedStart", "fixedGoal", "fixedCentre"];
/** Those of a first contact. */
export const contactOptions = [...queryOptions, ...motionOptions, ...fixedOptions];

/** A flag, and the value behind it if there is one. */
function addOptional(numbers, value, add, name) {
  const isGiven = value !== undefined;
  numbers.push(isGiven ? 1 : 0);
  if (isGiven) add(numbers, value, name);
  return numbers;
}

const addNumber = (numbers, value, name) => numbers.push(number(value, name));

function oneOf(names, value, name) {
  const index = names.indexOf(value);
  if (index < 0) throw new InvalidInput(`${name}: ${shown(value)}: must be ${quoted(names)}`);
  return index;
}

const quoted = (names) => `${names.slice(0, -1).map((n) => `'${n}'`).join(", ")} or '${names.at(-1)}'`;

/** How a body goes from one pose to the next. */
export function addRule(numbers, { motion, centre, maxTurn }) {
  numbers.push(oneOf(kinds, motion ?? "screw", "motion"));
  addOptional(numbers, maxTurn, addNumber, "maxTurn");
  return addOptional(numbers, centre, addCounted, "centre");
}

export function find(value = "first") {
  return oneOf(finds, value, "find");
}

/** Margin, hold, tolerance and what to find. */
export function addQuery(numbers, options) {
  numbers.push(number(options.margin, "margin", 0));
  addOptional(numbers, options.hold, addNumber, "hold");
  numbers.push(number(options.timeTolerance, "timeTolerance", 1e-12), find(options.find));
  return numbers;
}

/** The motion of a query for two bodies. */
export function addMotion(numbers, start, goal, options) {
  const isFixedMoving = options.fixedStart !== undefined || options.fixedGoal !== undefined;
  if (!isFixedMoving && options.fixedCentre !== undefined)
    throw new InvalidInput("fixedCentre: is for a fixed body that moves, with fixedStart and fixedGoal");
  addRule(numbers, options);
  addPose(numbers, start, "start");
  addPose(numbers, goal, "goal");
  numbers.push(isFixedMoving ? 1 : 0);
  if (!isFixedMoving) return numbers;
  addPose(numbers, options.fixedStart, "fixedStart");
  addPose(numbers, options.fixedGoal, "fixedGoal");
  return addOptional(numbers, options.fixedCentre, addCounted, "fixedCentre");
}

const still = [0, 0, 0];

/** Refuses options of a first contact as the question itself does, before a batch begins. */
export function checkContactOptions(options) {
  checkOptions(options, contactOptions);
  addMotion(addQuery([], options), still, still, options);
}

const worldForms = { poses: 0, track: 1, spline: 2, b_spline: 3 };

/** How a body of a scene goes from pose to pose. */
export function addWorldRule(numbers, kind, centre) {
  if (kind === "screw" || kind === "sweep")
    throw new InvalidInput(
      `motion: ${kind} is the motion of one body as seen from another one; a scene takes velocity and twist`,
    );
  return addRule(numbers, { motion: kind, centre });
}

/** The motion of a body in a scene. `place` is where it starts if the options do not say so. */
export function addWorldMotion(numbers, options, place) {
  const kind = options.motion ?? "velocity";
  if (kind === "spline" || kind === "b_spline") return addSpline(numbers, kind, options);
  addWorldRule(numbers, kind, options.centre);
  if (options.poses !== undefined) {
    numbers.push(worldForms.track);
    addPlaces(numbers, options);
    return addTimes(numbers, options);
  }
  if (options.times !== undefined) throw new InvalidInput("times: are for poses, and there are none");
  const pose = options.pose ?? place;
  if (pose === undefined) throw new InvalidInput("pose: is missing, and a body that moves anew keeps no place: scene.poseAt(name, 0) gives where it started");
  numbers.push(worldForms.poses);
  addPose(numbers, pose, "pose");
  return addOptional(numbers, options.goal, addPose, "goal");
}

function addSpline(numbers, kind, options) {
  if (options.centre !== undefined) throw new InvalidInput(`centre: is for the motion velocity, but the motion is a ${kind}`);
  addWorldRule(numbers, "velocity");
  numbers.push(worldForms[kind]);
  addPlaces(numbers, options);
  if (kind === "spline") return addTimes(numbers, options);
  if (options.times !== undefined) throw new InvalidInput("times: a b_spline has none");
  return numbers;
}

function addPlaces(numbers, { pose, goal, poses }) {
  if (pose !== undefined || goal !== undefined) throw new InvalidInput("poses: stand instead of pose and goal");
  return addPoses(numbers, poses, "poses");
}

/** As many times as there are poses. */
function addTimes(numbers, options) {
  const [count, ...times] = addCounted([], options.times, "times");
  if (count !== options.poses.length)
    throw new InvalidInput(`times: there are ${count} for ${options.poses.length} poses`);
  for (const time of times) numbers.push(time);
  return numbers;
}

// Dragged bodies.
const lockKinds = ["free", "hinge", "slider", "cylinder", "plane"];

/** How a dragged body may move at all. */
function addLock(numbers, given) {
  checkOptions(given, ["kind", "direction", "point"], "lock");
  const kind = lockKinds.indexOf(text(given.kind, "lock.kind"));
  if (kind < 0)
    throw new InvalidInput(`drag: lock: the kind must be free, hinge, slider, cylinder or plane, not ${given.kind}`);
  numbers.push(kind);
  addOptional(numbers, given.direction, addCounted, "lock.direction");
  return addOptional(numbers, given.point, addCounted, "lock.point");
}

/** A centre, and the moments of inertia per mass: 9 numbers, or 3 rows. */
function addMass(numbers, given) {
  checkOptions(given, ["centre", "inertia"], "mass");
  const flat = (rows) => Array.from(rows, (row) => (isList(row) ? Array.from(row) : row)).flat();
  const [count, ...inertia] = addCounted([], isList(given.inertia) ? flat(given.inertia) : given.inertia, "mass.inertia");
  if (count !== 9) throw new InvalidInput(`mass.inertia: a matrix needs 9 numbers, and there are ${count}`);
  addOptional(numbers, given.centre, addCounted, "mass.centre");
  numbers.push(...inertia);
  return numbers;
}

const mostRounds = 2 ** 30; // of javascript/src/hands.cpp
export const dragOptions = ["margin", "reach", "stiffness", "rounds", "friction", "mass", "lock"];

/** How a body is dragged. */
export function addDrag(numbers, options) {
  const { margin, reach, stiffness, rounds, friction } = options;
  if (!Number.isInteger(rounds ?? 8) || rounds > mostRounds) throw new InvalidInput(`rounds: must be a whole number up to ${mostRounds}`);
  numbers.push(
    number(margin, "margin", 0),
    number(reach, "reach", 0),
    number(stiffness, "stiffness", 1),
    Math.max(number(rounds, "rounds", 8), 0),
    number(friction, "friction", 0),
  );
  addOptional(numbers, options.mass, addMass);
  return addLock(numbers, options.lock ?? { kind: "free" });
}

/** Two lists of poses of one length. */
export function checkBatch(starts, goals) {
  for (const [list, name] of [[starts, "starts"], [goals, "goals"]])
    if (!isList(list)) throw new InvalidInput(`${name}: must be an array of poses`);
  if (starts.length !== goals.length)
    throw new InvalidInput(`starts, goals: ${starts.length} and ${goals.length} poses`);
}
