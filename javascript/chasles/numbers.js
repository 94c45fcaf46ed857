// Arguments as numbers, in the order in which javascript/src/numbers_in.cpp reads them. Functions that begin with "add" append to a
// list of numbers, and return it.
import { InvalidInput } from "./errors.js";
import { addPose, addPoses } from "./poses.js";
import { addCounted, addNumbers, addPoint, checkOptions, isList, number, shown, text } from "./values.js";

const kinds = ["screw", "sweep", "velocity", "twist"];
const finds = ["first", "any", "first_with_all_contacts"];

export const queryOptions = ["margin", "hold", "timeTolerance", "find"];
export const motionOptions = ["motion", "centre", "maxTurn"];
export const fixedOptions = ["fixedStart", "fixedGoal", "fixedCentre"];
export const leastOptions = ["tolerance", "timeTolerance", "find"];
export const profileOptions = ["tolerance", "absoluteTolerance", "margins", "timeTolerance"];
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

/** The place of a name in a list. `taken` are those that the question takes: a message names no others. */
function oneOf(names, value, name, taken = names) {
  const index = names.indexOf(value);
  if (index < 0) throw new InvalidInput(`${name}: ${shown(value)}: must be ${listed(taken, "or")}`);
  return index;
}

const listed = (names, last) => `${names.slice(0, -1).map((n) => `'${n}'`).join(", ")} ${last} '${names.at(-1)}'`;

/** How a body goes from one pose to the next. */
export function addRule(numbers, { motion, centre, maxTurn }) {
  numbers.push(oneOf(kinds, motion ?? "screw", "motion"));
  addOptional(numbers, maxTurn, addNumber, "maxTurn");
  return addOptional(numbers, centre, addPoint, "centre");
}

/** A question that lists everything refuses "any" in the words of the library. */
export function find(value = "first", listsAll = false) {
  return oneOf(finds, value, "find", listsAll ? finds.filter((name) => name !== "any") : finds);
}

/** Margin, hold, tolerance and what to find. */
export function addQuery(numbers, options, listsAll = false) {
  numbers.push(number(options.margin, "margin", 0));
  addOptional(numbers, options.hold, addNumber, "hold");
  numbers.push(number(options.timeTolerance, "timeTolerance", 1e-12), find(options.find, listsAll));
  return numbers;
}

/** Tolerances, and what to find. */
export function addLeast(numbers, { tolerance, timeTolerance, find: wanted }) {
  numbers.push(number(tolerance, "tolerance", 1e-6), number(timeTolerance, "timeTolerance", 1e-12), find(wanted, true));
  return numbers;
}

/** Tolerances and margins. */
export function addProfile(numbers, { tolerance, absoluteTolerance, timeTolerance, margins = [] }) {
  numbers.push(number(tolerance, "tolerance", 1e-2), number(absoluteTolerance, "absoluteTolerance", 0), number(timeTolerance, "timeTolerance", 1e-6));
  return addCounted(numbers, margins, "margins");
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
  return addOptional(numbers, options.fixedCentre, addPoint, "fixedCentre");
}

const still = [0, 0, 0];

/** Refuses options of a first contact as the question itself does, before a batch begins. */
export function checkContactOptions(options) {
  checkOptions(options, contactOptions);
  addMotion(addQuery([], options), still, still, options);
}

const worldForms = { poses: 0, track: 1, spline: 2, b_spline: 3 };
const evenKinds = ["velocity", "twist"];
const splineKinds = ["spline", "b_spline"];

/** How a body of a scene goes from pose to pose. */
export function addWorldRule(numbers, { motion = "velocity", centre }, taken = evenKinds) {
  if (motion === "screw" || motion === "sweep")
    throw new InvalidInput(`motion: ${motion} is the motion of one body as seen from another one; a scene takes ${listed(taken, "and")}`);
  oneOf(taken, motion, "motion");
  if (centre !== undefined && motion !== "velocity") throw new InvalidInput(`centre: is for the motion velocity, but the motion is a ${motion}`);
  return addRule(numbers, { motion: splineKinds.includes(motion) ? "velocity" : motion, centre });
}

/** The motion of a body in a scene. `place` is where it starts if the options do not say so. */
export function addWorldMotion(numbers, options, place) {
  addWorldRule(numbers, options, [...evenKinds, ...splineKinds]);
  if (options.poses !== undefined || splineKinds.includes(options.motion)) return addTrack(numbers, options);
  if (options.times !== undefined) throw new InvalidInput("times: are for poses, and there are none");
  const pose = options.pose ?? place;
  if (pose === undefined) throw new InvalidInput("pose: is missing, and a body that moves anew keeps no place: scene.poseAt(name, 0) gives where it started");
  for (const name of ["motion", "centre"])
    if (options[name] !== undefined && options.goal === undefined) throw new InvalidInput(`${name}: is for a body that moves; without a goal or poses it stands still`);
  numbers.push(worldForms.poses);
  addPose(numbers, pose, "pose");
  return addOptional(numbers, options.goal, addPose, "goal");
}

function addTrack(numbers, options) {
  numbers.push(worldForms[options.motion] ?? worldForms.track);
  addPlaces(numbers, options);
  if (options.motion !== "b_spline") return addTimes(numbers, options);
  if (options.times !== undefined) throw new InvalidInput("times: a b_spline has none");
  return numbers;
}

const needed = {
  spline: "a spline goes through two or more poses, and has a time for each",
  b_spline: "a b_spline goes near two or more poses, and has no times",
};

function addPlaces(numbers, { pose, goal, poses, motion }) {
  if (poses === undefined) throw new InvalidInput(`poses: are missing: ${needed[motion]}`);
  if (pose !== undefined || goal !== undefined) throw new InvalidInput("poses: stand instead of pose and goal");
  return addPoses(numbers, poses, "poses");
}

/** As many times as there are poses. */
function addTimes(numbers, options) {
  if (options.times === undefined) throw new InvalidInput('times: are missing: one for each pose, ascending from 0 to 1; only the motion "b_spline" has none');
  addNumbers(numbers, options.times, "times");
  if (options.times.length !== options.poses.length)
    throw new InvalidInput(`times: there are ${options.times.length} for ${options.poses.length} poses`);
  return numbers;
}

// Dragged bodies.
/** What each kind of lock has. */
const lockParts = { free: [], hinge: ["direction", "point"], slider: ["direction"], cylinder: ["direction", "point"], plane: ["direction"] };

/** How a dragged body may move at all. */
function addLock(numbers, given) {
  checkOptions(given, ["kind", "direction", "point"], "lock");
  const kind = Object.keys(lockParts).indexOf(text(given.kind, "lock.kind"));
  if (kind < 0)
    throw new InvalidInput(`drag: lock: the kind must be free, hinge, slider, cylinder or plane, not ${given.kind}`);
  numbers.push(kind);
  for (const part of ["direction", "point"]) {
    if (given[part] !== undefined && !lockParts[given.kind].includes(part)) throw new InvalidInput(`lock.${part}: says nothing about a lock of the kind ${given.kind}`);
    addOptional(numbers, given[part], addPoint, `lock.${part}`);
  }
  return numbers;
}

/** A centre, and the moments of inertia per mass: 9 numbers, or 3 rows. */
function addMass(numbers, given) {
  checkOptions(given, ["centre", "inertia"], "mass");
  const refuseOther = (count) => {
    if (count !== 9) throw new InvalidInput(`mass.inertia: a matrix needs 9 numbers, and there are ${count}`);
  };
  const rows = Array.isArray(given.inertia) ? given.inertia : [given.inertia];
  const count = rows.reduce((sum, row) => sum + (isList(row) ? row.length : 1), 0);
  if (count > 9) refuseOther(count); // before any copy
  const flat = Array.from(rows, (row) => (isList(row) ? Array.from({ length: row.length }, (_, k) => row[k]) : row)).flat();
  const inertia = addNumbers([], isList(given.inertia) ? flat : given.inertia, "mass.inertia");
  refuseOther(inertia.length);
  addOptional(numbers, given.centre, addPoint, "mass.centre");
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
