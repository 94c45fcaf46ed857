// Answers from numbers, in the order in which javascript/src/numbers_out.cpp writes them. The objects have the keys of
// the command line's JSON.

const verdicts = ["unknown", "clear", "contact", "contact_at_start"];
const contactKinds = ["vertex_face", "face_vertex", "edge_edge", "vertex_edge", "edge_vertex", "vertex_vertex"];
const motionKinds = ["screw", "sweep", "velocity", "twist"];
const dragStates = ["reached", "resting", "moving", "touching"];

/** Takes numbers one after another. */
export class Reader {
  #numbers;
  #at = 0;

  constructor(numbers) {
    this.#numbers = numbers;
  }

  number() {
    return this.#numbers[this.#at++];
  }
  flag() {
    return this.number() === 1;
  }
  some(count) {
    const taken = new Array(count);
    for (let i = 0; i < count; ++i) taken[i] = this.#numbers[this.#at++];
    return taken;
  }
  point() {
    return this.some(3);
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
function feature(kind, first, second) {
  return kind === "vertex" ? first : kind === "face" ? [first] : [first, second];
}

export function contact(reader) {
  const kind = contactKinds[reader.number()];
  const [ofMoving, ofFixed] = kind.split("_");
  const moving = reader.some(2);
  const fixed = reader.some(2);
  return {
    kind,
    moving_feature: feature(ofMoving, ...moving),
    fixed_feature: feature(ofFixed, ...fixed),
    point: reader.point(),
    normal: reader.point(),
    gap: reader.number(),
    approach_speed: reader.number(),
  };
}

function overlap(reader) {
  if (!reader.flag()) return null;
  const edgeIsMoving = reader.flag();
  const edge = feature("edge", ...reader.some(2));
  const face = feature("face", ...reader.some(2));
  const [moving_feature, fixed_feature] = edgeIsMoving ? [edge, face] : [face, edge];
  return { moving_feature, fixed_feature, point: reader.point() };
}

export function work(reader) {
  const [node_pairs, face_pairs, elementary_tests, root_brackets, refined, exact] = reader.some(6);
  return { node_pairs, face_pairs, elementary_tests, root_brackets, refined, exact };
}

function motion(reader) {
  const kind = motionKinds[reader.number()];
  const shown = { angle: reader.number(), slide: reader.number(), axis_point: reader.point(), axis_direction: reader.point() };
  const displacement = reader.point();
  if (kind === "velocity") shown.displacement = displacement;
  return { hasTau: kind === "screw" || kind === "sweep", shown };
}

/** What both kinds of answers have. `keys` are those of an answer, in order; `rest` is for the caller. */
function contactParts(reader, hasTau) {
  const [time, time_upper, tau, tau_upper] = reader.some(4);
  const certain = reader.flag();
  const isCut = reader.flag();
  const pose = reader.pose();
  const fixed_pose = reader.pose();
  const contacts = reader.list(contact);
  const found = overlap(reader);
  const times = { time, time_upper, ...(hasTau ? { tau, tau_upper } : {}), certain };
  const places = { pose, fixed_pose, contacts, ...(found ? { overlap: found } : {}) };
  return { keys: { ...times, ...places }, cut: isCut ? { contacts_cut: true } : {}, work: work(reader) };
}

/** An answer without motion, and its work apart. */
function contactAnswer(reader, hasTau) {
  const verdict = verdicts[reader.number()];
  const parts = contactParts(reader, hasTau);
  const held = reader.list(contact);
  const clear_until = reader.number();
  const found = verdict === "clear" ? {} : { ...parts.keys, ...parts.cut };
  return { answer: { verdict, ...found, ...(held.length > 0 ? { held } : {}), clear_until }, work: parts.work };
}

export function firstContact(reader) {
  const { hasTau, shown } = motion(reader);
  const { answer, work } = contactAnswer(reader, hasTau);
  return { ...answer, motion: shown, work };
}

export function pathContact(reader) {
  const answer = firstContact(reader);
  return { ...answer, segment: reader.number() };
}

export function leastDistance(reader) {
  const { hasTau, shown } = motion(reader);
  const [distance, distance_upper] = reader.some(2);
  const parts = contactParts(reader, hasTau);
  return { distance, distance_upper, ...parts.keys, ...parts.cut, motion: shown, work: parts.work };
}

/** Contacts of a scene, with the names of their bodies. */
function sceneContacts(reader, names) {
  return reader.list(() => ({
    pair: [names[reader.number()], names[reader.number()]],
    answer: contactAnswer(reader, false).answer,
  }));
}

export function sceneContact(reader, names) {
  const verdict = verdicts[reader.number()];
  const clear_until = reader.number();
  const [first, ...others] = sceneContacts(reader, names);
  const counters = work(reader);
  if (!first) return { verdict, clear_until, work: counters };
  const { verdict: _, clear_until: __, ...found } = first.answer;
  const simultaneous = others.length > 0 ? { simultaneous: others.map(({ pair }) => pair) } : {};
  return { verdict, clear_until, pair: first.pair, ...found, ...simultaneous, work: counters };
}

export function sceneEvents(reader, names) {
  reader.some(2); // the verdict and the time of the first contact, which the events say too
  const events = sceneContacts(reader, names).map(({ pair, answer }) => {
    const { time, time_upper, certain, contacts } = answer;
    return { time, time_upper, certain, pair, contacts };
  });
  return { events, work: work(reader) };
}

export function dragStep(reader, names) {
  const name = () => names[reader.number()];
  return {
    pose: reader.pose(),
    state: dragStates[reader.number()],
    contacts: reader.list(() => ({ body: name(), force: reader.number(), friction: reader.point(), ...contact(reader) })),
    events: reader.list(() => ({ body: name(), begins: reader.flag(), ...contact(reader) })),
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
  return { ...report, closed: reader.flag(), lower: reader.point(), upper: reader.point() };
}
