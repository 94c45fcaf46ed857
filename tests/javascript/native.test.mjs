// The answers of the native library, bit for bit: the known answers, and random questions of every kind
// (docs/decisions/0082-which-bits-are-the-same.md).
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";
import { InvalidInput, load } from "chasles";
import { asCommandLine, nativeAnswers, optionsOf, skip } from "./native.mjs";
import { box, potato, randomNumbers, randomPose } from "./shapes.mjs";

const queries = 10000;

/** Answers lines as the native program does. */
class Answerer {
  #bodies = [];

  constructor(chasles) {
    this.chasles = chasles;
  }

  answer(line) {
    if (line.vertices) return void this.#bodies.push(this.chasles.polyhedron(line.vertices, line.faces));
    try {
      return this[line.ask](line);
    } catch (error) {
      if (error instanceof InvalidInput) return { error: error.message };
      throw error;
    }
  }

  first_contact(line) {
    return asCommandLine(this.chasles.firstContact(...this.#pair(line), line.start, line.goal, optionsOf(line)));
  }
  path(line) {
    return asCommandLine(this.chasles.firstContactOnPath(...this.#pair(line), line.poses, optionsOf(line)));
  }
  least_distance(line) {
    return asCommandLine(this.chasles.leastDistance(...this.#pair(line), line.start, line.goal, optionsOf(line)));
  }
  scene(line) {
    const scene = this.#scene(line);
    const answer = line.all ? scene.allContacts(optionsOf(line)) : scene.firstContact(optionsOf(line));
    scene.free();
    return asCommandLine(answer);
  }
  drag(line) {
    const hand = this.chasles.draggedBody(this.#scene(line), line.body);
    return line.goals.map((goal) => {
      const { pose, distance, contacts, wrench, events, pieces } = hand.update(goal);
      return { pose, distance, contacts, wrench, events: events.length, pieces: pieces.length };
    });
  }

  #pair(line) {
    return [this.#bodies[line.moving], this.#bodies[line.fixed]];
  }
  #scene(line) {
    const scene = this.chasles.scene();
    for (const { name, shape, ...options } of line.bodies) scene.add(name, this.#bodies[shape], options);
    return scene;
  }
}

/** Calls `differs(key, a, b)` for each pair of leaves that are not the same bits. */
function walk(a, b, key, differs) {
  if (typeof a !== "object" || typeof b !== "object" || !a || !b) return void (Object.is(a, b) || differs(key, a, b));
  for (const name of new Set([...Object.keys(a), ...Object.keys(b)]))
    walk(a[name], b[name], Number.isNaN(Number(name)) ? name : key, differs);
}

/** Counts the leaves of an answer whose bits are not those of the native one, by their keys. */
function judge(question, answer, expected, wrong) {
  walk(answer, expected, "", (key, a, b) => {
    wrong[key] = (wrong[key] ?? 0) + 1;
    if (wrong[key] <= 2) console.error(`${key}: ${a} instead of ${b} in ${JSON.stringify(question)}`);
  });
}

/** Asserts that the answers to all lines are those of the native library, bit for bit. Returns them. */
async function compare(lines) {
  const answerer = new Answerer(await load());
  const expected = nativeAnswers(lines);
  const questions = lines.filter((line) => line.ask);
  const answers = lines.map((line) => answerer.answer(line)).filter((answer) => answer !== undefined);
  assert.equal(answers.length, expected.length);
  const wrong = {};
  answers.forEach((answer, i) => {
    if (answer.error) assert.ok(answer.error.endsWith(expected[i].error), `${answer.error}, not ${expected[i].error}`);
    else judge(questions[i], answer, expected[i], wrong);
  });
  assert.deepEqual(wrong, {}, "numbers of other bits");
  return answers;
}

const share = (answers, test) => answers.filter(test).length / answers.length;

export function knownAnswers(folder) {
  const cases = gunzipSync(readFileSync(`${folder}/screw-known-answers/cases.jsonl.gz`)).toString().trimEnd().split("\n");
  return cases.map((line) => JSON.parse(line)).flatMap(({ moving, fixed, start, goal }, i) => [
    { vertices: moving.v, faces: moving.f },
    { vertices: fixed.v, faces: fixed.f },
    { ask: "first_contact", moving: 2 * i, fixed: 2 * i + 1, start, goal, max_turn: Math.PI },
  ]);
}

const data = process.env.CHASLES_DATA_DIR;
const hasData = data && existsSync(`${data}/screw-known-answers`);

test("the known answers", { skip: skip || (!hasData && "skipped: no folder screw-known-answers of real inputs") }, async () => {
  const answers = await compare(knownAnswers(data));
  assert.equal(answers.length, 2036);
});

const random = randomNumbers(22);
const pick = (list) => list[Math.floor(random() * list.length)];
const maybe = (chance, object) => (random() < chance ? object : {});

function bodies() {
  const shapes = [box(), box(0.5, 1, 2), box(3, 3, 0.1)];
  for (let i = 0; i < 9; ++i) shapes.push(potato(random, 1 + (i % 4), 3 + i));
  return shapes;
}

function motionOptions() {
  const motion = pick(["screw", "sweep", "velocity", "twist"]);
  const movesStraight = motion === "sweep" || motion === "velocity";
  return {
    motion,
    ...maybe(movesStraight ? 0.5 : 0, { centre: [random(), random(), random()] }),
    ...maybe(motion === "screw" ? 0.3 : 0, { max_turn: 0.05 + 2 * random() }),
  };
}

function queryOptions() {
  const margin = pick([0, 0, 0.01, 0.3]);
  return {
    margin,
    ...maybe(margin > 0 ? 0.3 : 0, { hold: margin / 2 }),
    find: pick(["first", "any", "first_with_all_contacts"]),
  };
}

function question(count) {
  const pair = { moving: Math.floor(random() * count), fixed: Math.floor(random() * count) };
  const flat = random() < 0.3; // straight at a box: many features touch at once
  const pose = (distance) => (flat ? [5 * (random() - 0.5), 0, pick([2, 3, 0])] : randomPose(random, distance));
  const motion = motionOptions();
  const fixed = maybe(0.2, { fixed_start: randomPose(random, 1), fixed_goal: randomPose(random, 1) });
  return { ask: "first_contact", ...pair, start: pose(3), goal: pose(3), ...motion, ...fixed, ...queryOptions() };
}

test("random questions about two bodies", { skip }, async (t) => {
  const shapes = bodies();
  const lines = [...shapes, ...Array.from({ length: queries }, () => question(shapes.length))];
  const answers = await compare(lines);
  const shares = ["clear", "contact", "contact_at_start"].map((verdict) => share(answers, (a) => a.verdict === verdict));
  t.diagnostic(`${queries} questions, seed 22: ${shares.map((s) => `${(100 * s).toFixed(1)} %`).join(", ")} clear, contact, at start`);
  const hits = {
    refined: share(answers, (a) => a.work?.refined > 0),
    exact: share(answers, (a) => a.work?.exact > 0),
    several: share(answers, (a) => a.contacts?.length > 1),
    overlaps: share(answers, (a) => a.overlap),
    held: share(answers, (a) => a.held),
  };
  t.diagnostic(`shares: ${JSON.stringify(hits)}, refused ${share(answers, (a) => a.error)}`);
  for (const each of shares) assert.ok(each > 0.1, `verdicts: ${shares}`);
  for (const [name, hit] of Object.entries(hits)) assert.ok(hit > 0.002, `${name}: ${hit}`);
});

test("random paths, least distances, scenes, hands and refused questions", { skip }, async (t) => {
  const shapes = bodies();
  const pair = () => ({ moving: Math.floor(random() * shapes.length), fixed: Math.floor(random() * shapes.length) });
  const lines = [...shapes];
  const many = Math.ceil(queries / 20);
  for (let i = 0; i < many; ++i) {
    const poses = Array.from({ length: 2 + Math.floor(4 * random()) }, () => randomPose(random, 4));
    lines.push({ ask: "path", ...pair(), poses, ...motionOptions(), ...queryOptions() });
    const [start, goal] = [randomPose(random, 5), randomPose(random, 5)];
    lines.push({ ask: "least_distance", ...pair(), start, goal, ...motionOptions(), tolerance: pick([1e-6, 1e-3]) });
    const members = Array.from({ length: 6 }, (_, k) => ({
      name: `body ${k}`, shape: Math.floor(random() * shapes.length), pose: randomPose(random, 6),
      goal: randomPose(random, 6), motion: pick(["velocity", "twist"]),
    }));
    lines.push({ ask: "scene", bodies: members, margin: pick([0, 0.1]), all: random() < 0.5, until: pick([1, 0.5]) });
    const zero = [0, 0, 0, 0, 0, 0, 0];
    lines.push({ ask: "first_contact", ...pair(), start: random() < 0.5 ? zero : [1], goal: [0, 0, 0], margin: -1 });
  }
  for (let i = 0; i < Math.ceil(many / 10); ++i) {
    const members = [
      { name: "hand", shape: 0, pose: [0, 0, 6] },
      ...[1, 2, 3].map((k) => ({ name: `wall ${k}`, shape: k, pose: randomPose(random, 2) })),
    ];
    const goals = Array.from({ length: 10 }, () => [...randomPose(random, 1).slice(0, 3), 1, random(), random(), random()]);
    lines.push({ ask: "drag", bodies: members, body: "hand", goals });
  }
  const answers = await compare(lines);
  t.diagnostic(`${answers.length} questions`);
  assert.ok(share(answers, (a) => a.error) > 0.2 && share(answers, (a) => a.segment > 0) > 0.02);
  assert.ok(share(answers, (a) => a.distance > 0) > 0.05 && share(answers, (a) => a.pair || a.events) > 0.1);
  assert.ok(answers.some((a) => Array.isArray(a) && a.some((step) => step.contacts.length > 0)));
});
