// Answers from numbers, in the order in which javascript/src/numbers_out.cpp writes them. The objects have the keys of
// the command line's JSON, and `fixed_pose`.

const verdicts = ["unknown", "clear", "contact", "contact_at_start"];
/** With the kinds of both features. */
const contactKinds = ["vertex_face", "face_vertex", "edge_edge", "vertex_edge", "edge_vertex", "vertex_vertex"]
  .map((kind) => [kind, ...kind.split("_")]);
const motionKinds = ["screw", "sweep", "velocity", "twist"];
/** Those of a scene, and of a robot, in the order of UntestedReason. */
const untestedReasons = ["no_shapes", "at_rest", "adjacent", "disabled", "ignored", "touching_at_start"];
const dragStates = ["reached", "resting", "moving", "touching"];

/** Takes numbers one after another, from `at` on. */
export class Reader {
  #numbers;
  #at;

  constructor(numbers, at = 0) {
    this.#numbers = numbers;
    this.#at = at;
  }

  number() {
    return this.#numbers[this.#at++];
  }
  flag() {
    return this.number() === 1;
  }
  some(count) {
    const taken = [];
    for (let left = count; left > 0; --left) taken.push(this.number());
    return taken;
  }
  point() {
    return [this.number(), this.number(), this.number()];
  }
  pose() {
    return this.some(7);
  }
  list(read) {
    const items = [];
    for (let left = this.number(); left > 0; --left) items.push(read(this));
    return items;
  }
}

/** A vertex is a number, a face a list of one number, an edge a list of its two vertices. */
function feature(reader, kind) {
  const first = reader.number(), second = reader.number();
  return kind === "vertex" ? first : kind === "face" ? [first] : [first, second];
}

/** Adds a contact to an object. */
function addContact(object, reader) {
  const [kind, ofMoving, ofFixed] = contactKinds[reader.number()];
  object.kind = kind;
  object.moving_feature = feature(reader, ofMoving);
  object.fixed_feature = feature(reader, ofFixed);
  object.point = reader.point();
  object.normal = reader.point();
  object.gap = reader.number();
  object.approach_speed = reader.number();
  return object;
}

const contact = (reader) => addContact({}, reader);

/** Null if there is none. */
function overlap(reader) {
  if (!reader.flag()) return null;
  const edgeIsMoving = reader.flag();
  const edge = feature(reader, "edge");
  const face = feature(reader, "face");
  const [moving_feature, fixed_feature] = edgeIsMoving ? [edge, face] : [face, edge];
  return { moving_feature, fixed_feature, point: reader.point() };
}

/** Adds which body is inside of the other one, if one is. */
function addInside(answer, reader) {
  if (!reader.flag()) return;
  answer.inside = reader.flag() ? "moving" : "fixed";
  answer.inside_vertex = reader.number();
  answer.inside_point = reader.point();
}

function work(reader) {
  return {
    node_pairs: reader.number(),
    face_pairs: reader.number(),
    elementary_tests: reader.number(),
    root_brackets: reader.number(),
    refined: reader.number(),
    exact: reader.number(),
  };
}

function motion(reader) {
  const kind = motionKinds[reader.number()];
  const shown = { kind, angle: reader.number(), slide: reader.number(), axis_point: reader.point(), axis_direction: reader.point() };
  const displacement = reader.point();
  if (kind === "velocity") shown.displacement = displacement;
  return { hasTau: kind === "screw" || kind === "sweep", shown };
}

/** Adds what both kinds of answers have. Returns the work, which stands last in an answer. */
function addFound(answer, reader, hasTau) {
  answer.time = reader.number();
  answer.time_upper = reader.number();
  const tau = reader.number(), tau_upper = reader.number();
  if (hasTau) {
    answer.tau = tau;
    answer.tau_upper = tau_upper;
  }
  answer.certain = reader.flag();
  const isCut = reader.flag();
  answer.pose = reader.pose();
  answer.fixed_pose = reader.pose();
  answer.contacts = reader.list(contact);
  const found = overlap(reader);
  if (found) answer.overlap = found;
  addInside(answer, reader);
  if (isCut) answer.contacts_cut = true;
  return work(reader);
}

/** Adds an answer without its motion. Returns its work. */
function addContactAnswer(answer, reader, hasTau) {
  answer.verdict = verdicts[reader.number()];
  const found = answer.verdict === "clear" ? {} : answer;
  const counters = addFound(found, reader, hasTau);
  if (found.contacts_cut) answer.contacts_cut = true; // of a clear answer: the list of held contacts
  const held = reader.list(contact);
  if (held.length > 0) answer.held = held;
  answer.clear_until = reader.number();
  return counters;
}

export function firstContact(reader) {
  const { hasTau, shown } = motion(reader);
  const answer = {};
  const counters = addContactAnswer(answer, reader, hasTau);
  answer.motion = shown;
  answer.work = counters;
  return answer;
}

export function pathContact(reader) {
  const answer = firstContact(reader);
  answer.segment = reader.number();
  return answer;
}

export function leastDistance(reader) {
  const { hasTau, shown } = motion(reader);
  const answer = { distance: reader.number(), distance_upper: reader.number() };
  const counters = addFound(answer, reader, hasTau);
  answer.motion = shown;
  answer.work = counters;
  return answer;
}

const interval = (reader) => [reader.number(), reader.number()];

/** From times[i] to times[i + 1] the distance is from lower[i] to upper[i]. `nearest` counts the pairs of a scene. */
function addProfile(answer, reader) {
  const numbers = () => Float64Array.from(reader.some(reader.number()));
  Object.assign(answer, { times: numbers(), lower: numbers(), upper: numbers(), certain: reader.flag() });
  answer.zones = reader.list(() => ({ margin: reader.number(), inside: reader.list(interval), doubt: reader.list(interval) }));
  answer.free = reader.list(interval);
  const nearest = reader.some(reader.number());
  return { nearest, work: work(reader) };
}

export function profile(reader) {
  const { shown } = motion(reader);
  const answer = {};
  const counters = addProfile(answer, reader).work;
  answer.motion = shown;
  answer.work = counters;
  return answer;
}

const pairOf = (reader, names) => [names[reader.number()], names[reader.number()]];

/** Of a pair of a scene, and its work, which stands last in an answer. */
function pairDistance(reader, names) {
  const answer = { pair: pairOf(reader, names), distance: reader.number(), distance_upper: reader.number() };
  return { answer, counters: addFound(answer, reader, false) };
}

/** Of each tested pair of a scene. */
export function sceneDistances(reader, names) {
  const pairs = reader.list(() => {
    const { answer, counters } = pairDistance(reader, names);
    return { ...answer, work: counters };
  });
  return { pairs, untested: untested(reader, names) };
}

/** Of the nearest pair of a scene, or null if no two bodies are tested. */
export function sceneDistance(reader, names) {
  if (!reader.flag()) return null;
  const { answer, counters } = pairDistance(reader, names);
  answer.untested = untested(reader, names);
  answer.work = counters;
  return answer;
}

export function sceneProfile(reader, names) {
  const answer = {};
  const { nearest, work: counters } = addProfile(answer, reader);
  answer.pairs = reader.list(() => pairOf(reader, names));
  answer.nearest = nearest;
  answer.untested = untested(reader, names);
  answer.work = counters;
  return answer;
}

/** Contacts of a scene, with the names of their bodies. */
function sceneContacts(reader, names) {
  return reader.list(() => {
    const pair = [names[reader.number()], names[reader.number()]];
    const answer = {};
    addContactAnswer(answer, reader, false);
    return { pair, answer };
  });
}

/** What is not tested, by reason, with the names of pairs; of each reason at most 100. */
function untested(reader, names) {
  const tested = reader.number();
  const counts = reader.list((list) => list.number());
  const named = reader.list((list) => ({ reason: list.number(), pair: [names[list.number()], names[list.number()]] }));
  const reasons = [];
  counts.forEach((count, index) => {
    const pairs = named.filter(({ reason }) => reason === index).map(({ pair }) => pair);
    if (count > 0) reasons.push({ reason: untestedReasons[index], count, pairs });
  });
  return { tested, pairs: counts.reduce((sum, count) => sum + count, 0), reasons };
}

export function sceneContact(reader, names) {
  const verdict = verdicts[reader.number()];
  const clear_until = reader.number();
  const [first, ...others] = sceneContacts(reader, names);
  const ends = { work: work(reader), untested: untested(reader, names) };
  if (!first) return { verdict, clear_until, ...ends };
  const { verdict: _, clear_until: __, ...found } = first.answer;
  const simultaneous = others.length > 0 ? { simultaneous: others.map(({ pair }) => pair) } : {};
  return { verdict, clear_until, pair: first.pair, ...found, ...simultaneous, ...ends };
}

/** What an event may have beside contacts. */
const besideContacts = ["overlap", "inside", "inside_vertex", "inside_point", "contacts_cut"];

export function sceneEvents(reader, names) {
  reader.some(2); // the verdict and the time of the first contact, which the events say too
  const events = sceneContacts(reader, names).map(({ pair, answer }) => {
    const { time, time_upper, certain, contacts } = answer;
    const event = { time, time_upper, certain, pair, contacts };
    for (const key of besideContacts) if (key in answer) event[key] = answer[key];
    return event;
  });
  return { events, work: work(reader), untested: untested(reader, names) };
}

export function dragStep(reader, names) {
  const name = () => names[reader.number()];
  return {
    pose: reader.pose(),
    state: dragStates[reader.number()],
    contacts: reader.list(() => addContact({ body: name(), force: reader.number(), friction: reader.point() }, reader)),
    events: reader.list(() => addContact({ body: name(), begins: reader.flag() }, reader)),
    wrench: reader.some(6),
    distance: reader.number(),
    blocking: reader.list(name),
    touching: reader.list(name),
    pieces: reader.list(() => ({
      start: reader.pose(),
      goal: reader.pose(),
      until: reader.number(),
      clearance: reader.number(),
    })),
    intrusions: reader.list(() => ({ body: name(), time: reader.number() })),
    work: work(reader),
  };
}

export function meshReport(reader) {
  const names = ["vertices", "distinct_vertices", "faces", "triangles", "polygons", "edges", "boundary_edges"];
  const report = {};
  for (const name of [...names, "nonmanifold_edges", "dropped_faces", "segments"]) report[name] = reader.number();
  report.closed = reader.flag();
  for (const name of ["unpaired_edges", "surface_parts", "solid_parts", "inward_parts", "volume", "radius", "moved_inwards"]) report[name] = reader.number();
  return Object.freeze({ ...report, lower: Object.freeze(reader.point()), upper: Object.freeze(reader.point()) });
}
