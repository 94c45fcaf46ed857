// Bodies in a hand, with friction, mass and locks, against closed forms.
import assert from "node:assert/strict";
import { test } from "node:test";
import { InvalidInput, load } from "chasles";
import { nativeAnswers, skip } from "./native.mjs";
import { box, potato, randomNumbers, randomPose } from "./shapes.mjs";

const chasles = await load();
const margin = 1e-4;
const body = (...sizes) => chasles.polyhedron(box(...sizes).vertices, box(...sizes).faces);
const unit = body(0.5);
const near = (value, expected, tolerance, words = "") =>
  assert.ok(Math.abs(value - expected) <= tolerance, `${words}: ${value} instead of ${expected}`);
const times = (count, work) => Array.from({ length: count }, work).at(-1);
const about = (angle) => [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)]; // z
const angleOf = (pose) => 2 * Math.atan2(pose[6], pose[3]);

/** A box of side 1 on a table whose surface is z = 0. */
function boxOnTable(options, height = 0.5 + margin) {
  const scene = chasles.scene();
  scene.add("table", body(9, 9, 0.5), { pose: [0, 0, -0.5] });
  scene.add("box", unit, { pose: [0, 0, height] });
  return chasles.draggedBody(scene, "box", { margin, ...options });
}

function refusal(work) {
  try {
    work();
  } catch (error) {
    assert.ok(error instanceof InvalidInput, `${error.name}: ${error.message}`);
    return error.message;
  }
  return assert.fail("nothing was refused");
}

test("a box that is pressed by d and pulled by e lags by mu d", () => {
  for (const friction of [0, 0.2, 0.7]) {
    const hand = boxOnTable({ friction });
    const pressed = 0.3;
    const lag = friction * (pressed + margin);
    let reached = 0;
    for (const pulled of [0.5 * lag, 0.99 * lag, 0.4, 0.6, 0.55, 0.1]) {
      const step = times(4, () => hand.update([0.6 * pulled, 0.8 * pulled, 0.5 - pressed]));
      reached = Math.min(Math.max(reached, pulled - lag), pulled + lag); // the hand drags it along at the end of its lag
      assert.equal(step.state, "resting");
      [0.6 * reached, 0.8 * reached, 0.5 + margin].forEach((place, k) => near(step.pose[k], place, 1e-6, `mu ${friction}, ${pulled}`));
      const sum = (k) => step.contacts.reduce((total, contact) => total + contact.friction[k], 0);
      [0.6, 0.8].forEach((part, k) => near(sum(k), part * (reached - pulled), 1e-6, "friction"));
      [0.6 * (reached - pulled), 0.8 * (reached - pulled), pressed + margin, 0, 0, 0].forEach((part, k) => near(step.wrench[k], part, 1e-6, "wrench"));
      for (const { force, friction: across, normal } of step.contacts) {
        assert.ok(Math.hypot(...across) <= friction * force * (1 + 1e-9));
        near(across.reduce((dot, part, k) => dot + part * normal[k], 0), 0, 1e-12);
      }
    }
    hand.free();
  }
});

test("the force for another goal, without an update", () => {
  const hand = boxOnTable({ stiffness: 20 });
  const step = times(3, () => hand.update([0, 0, 0.2]));
  hand.force([0, 0, 0.2]).forEach((part, k) => near(part, step.wrench[k], 1e-9));
  for (const depth of [0.1, 0.3, 0.45]) near(hand.force([0.2, 0, 0.5 - depth])[2], 20 * (depth + margin), 1e-6, depth);
  assert.deepEqual(hand.force([0, 0, 2]), [0, 0, 0, 0, 0, 0]); // the table does not pull
  assert.deepEqual(hand.pose, step.pose);
  assert.match(refusal(() => hand.force([1])), /^goal: 1 number found/);
});

const point = [1, 2, 0];
const random = randomNumbers(11);

/** A lever that ends in a hinge at `point` and lies along x, and what it may run into. */
function lever(lock, options = {}) {
  const scene = chasles.scene();
  scene.add("lever", body(1, 0.05, 0.1), { pose: [2, 2, 0] });
  scene.add("wall", body(2, 0.5, 0.5), { pose: [2, 3.7, 0] }); // its lower side is at y = 3.2
  return chasles.draggedBody(scene, "lever", { margin, lock, ...options });
}

test("a lever on a hinge stays on its circle, and stops where its corner meets the wall", () => {
  const hand = lever({ kind: "hinge", direction: [0, 0, 3], point: [...point.slice(0, 2), 7] });
  let hits = 0;
  for (let i = 0; i < 400; ++i) {
    const step = hand.update(randomPose(random, 4));
    const [x, y, z, , turnX, turnY] = step.pose;
    const angle = angleOf(step.pose);
    [x - 1 - Math.cos(angle), y - 2 - Math.sin(angle), z, turnX, turnY].forEach((off) => near(off, 0, 1e-12, "off the circle"));
    hits += step.blocking.length;
  }
  assert.ok(hits > 40, `${hits} of 400 updates are blocked`);
  const open = lever({ kind: "hinge", point });
  const step = times(6, () => open.update([1, 3, 0, ...about(Math.PI / 2)]));
  assert.deepEqual([step.state, step.blocking], ["resting", ["wall"]]);
  // The corner at (2, 0.05) of the lever turns until it is at the margin from the height 1.2 above the hinge.
  const radius = Math.hypot(2, 0.05);
  near(angleOf(step.pose), Math.asin((1.2 - margin) / radius) - Math.asin(0.05 / radius), margin / 100);
});

test("sliders, cylinders and planes keep to their lines and planes", () => {
  for (let i = 0; i < 100; ++i) {
    const goal = [...randomPose(random, 0.5).slice(0, 3), 1, ...randomPose(random, 0.3).slice(0, 3)];
    const slid = lever({ kind: "slider", direction: [1, -1, 0] }).update(goal).pose;
    near(slid[0] - 2, 2 - slid[1], 1e-12, "slider");
    assert.deepEqual(slid.slice(2), [0, 1, 0, 0, 0]);
    const way = (goal[0] - 2 - (goal[1] - 2)) / 2; // of the goal along the line
    near(slid[0], 2 + way, 1e-9, "the nearest place on the line");
    const [x, y, , , turnX, turnY] = lever({ kind: "cylinder", point }).update(goal).pose;
    [Math.hypot(x - 1, y - 2) - 1, turnX, turnY].forEach((off) => near(off, 0, 1e-12, "cylinder"));
    const flat = lever({ kind: "plane", direction: [0, 1, 0] }).update(goal).pose;
    [flat[1] - 2, flat[4], flat[6]].forEach((off) => near(off, 0, 1e-12, "plane"));
  }
});

test("mass says how hard turning is against shifting", () => {
  // Turned by a, the middle of the lever is at (cos a, sin a) from its hinge. A goal that is shifted by t, and not turned, stretches
  // the spring by 1/2 |(1, t) - (cos a, sin a)|^2 + 1/2 I a^2: the slope is sin a - t cos a + I a.
  for (const inertia of [0.05, 0.4, 3]) {
    const t = 0.6;
    let [lower, upper] = [0, 1];
    for (let i = 0; i < 60; ++i) {
      const middle = (lower + upper) / 2;
      if (Math.sin(middle) - t * Math.cos(middle) + inertia * middle < 0) lower = middle;
      else upper = middle;
    }
    const rows = [[inertia, 0, 0], [0, inertia, 0], [0, 0, inertia]];
    for (const mass of [{ inertia: rows }, { centre: [0, 0, 0], inertia: Float64Array.from(rows.flat()) }]) {
      const hand = lever({ kind: "hinge", point }, { mass });
      near(angleOf(times(4, () => hand.update([2, 2 + t, 0])).pose), lower, 1e-6, inertia);
    }
  }
});

test("random hands with friction and locks go as the native ones do", { skip }, (t) => {
  const shapes = [box(), potato(random, 3, 6), box(0.5, 1, 2)];
  const bodies = shapes.map(({ vertices, faces }) => chasles.polyhedron(vertices, faces));
  const kinds = ["free", "hinge", "slider", "cylinder", "plane"];
  const questions = Array.from({ length: 150 }, (_, i) => {
    const kind = kinds[i % kinds.length];
    const [direction, point] = [randomPose(random, 1).slice(0, 3), randomPose(random, 2).slice(0, 3)];
    const lock = { kind, direction, ...(kind === "hinge" || kind === "cylinder" ? { point } : {}) };
    const walls = [1, 2].map((shape) => ({ name: `wall ${shape}`, shape, pose: randomPose(random, 1.5) }));
    const hand = { name: "hand", shape: 0, pose: [0, 0, 4] };
    const goal = [...randomPose(random, 1).slice(0, 3), 1, random(), random(), random()];
    return { ask: "drag", bodies: [hand, ...walls], body: "hand", goals: [goal], friction: random(), ...(kind === "free" ? {} : { lock }) };
  });
  const expected = nativeAnswers([...shapes, ...questions]);
  let touching = 0;
  questions.forEach(({ bodies: members, goals, friction, lock }, i) => {
    const scene = chasles.scene();
    for (const { name, shape, pose } of members) scene.add(name, bodies[shape], { pose });
    const { pose, contacts } = chasles.draggedBody(scene, "hand", { friction, lock }).update(goals[0]);
    assert.deepEqual(pose, expected[i][0].pose, `hand ${i}`); // the same bits
    assert.deepEqual(contacts.map((contact) => contact.friction), expected[i][0].contacts.map((contact) => contact.friction));
    touching += contacts.some((contact) => Math.hypot(...contact.friction) > 0) ? 1 : 0;
  });
  t.diagnostic(`${touching} of ${questions.length} hands have friction, seed 11`);
  assert.ok(touching > 30, touching);
});

test("wrong options are refused in the words of the library", () => {
  const refused = (options) => refusal(() => boxOnTable(options));
  assert.equal(refused({ friction: -1 }), "drag: friction: must be in [0, 100]");
  assert.equal(refused({ friction: NaN }), "drag: friction: must be in [0, 100]");
  assert.equal(refused({ stiffness: 0 }), "drag: stiffness: must be in (0, 1e30]");
  assert.equal(refused({ reach: 1e-6 }), "drag: reach: must be at least 1.25 times the margin, and at most 1e30");
  assert.equal(refused({ lock: { kind: "screw" } }), "drag: lock: the kind must be free, hinge, slider, cylinder or plane, not screw");
  assert.equal(refused({ lock: { kind: "plane", direction: [0, 0, 0] } }), "drag: lock: the direction must be finite and not zero");
  assert.equal(refused({ lock: { kind: "hinge", point: [0, NaN, 0] } }), "drag: lock: the point must be finite, and no component beyond 1e30");
  assert.equal(refused({ mass: { inertia: [1, 2, 0, 0, 1, 0, 0, 0, 1] } }), "drag: mass: the inertia must be symmetric and positive definite");
  assert.equal(refused({ mass: { inertia: [1, 0, 0, 0, Infinity, 0, 0, 0, 1] } }), "drag: mass: a number is not finite");
  assert.equal(refused({ mass: { inertia: [1, 0, 0] } }), "mass.inertia: a matrix needs 9 numbers, and there are 3");
  assert.match(refused({ mass: { centre: [0, 0], inertia: [1, 0, 0, 0, 1, 0, 0, 0, 1] } }), /^mass\.centre: a point needs 3 numbers, and there are 2/);
  assert.match(refused({ mass: {} }), /^mass\.inertia: undefined is no array/);
  assert.match(refused({ lock: { kind: "hinge", axis: [0, 0, 1] } }), /^axis: is no option here; there are kind, direction, point/);
  assert.match(refused({ lock: { kind: "hinge", direction: [1, 2] } }), /^lock\.direction: a point needs 3 numbers/);
  for (const kind of ["free", "slider", "plane"])
    assert.equal(refused({ lock: { kind, point: [0, 0, 0] } }), `lock.point: says nothing about a lock of the kind ${kind}`);
  assert.equal(refused({ lock: { kind: "free", direction: [0, 0, 1] } }), "lock.direction: says nothing about a lock of the kind free");
  assert.match(refused({ lock: "hinge" }), /^lock: must be an object/);
  assert.match(refused({ lock: {} }), /^lock\.kind: undefined is not a text/);
  assert.equal(boxOnTable({ lock: { kind: "free" }, friction: 100 }).update([0, 0, 5]).state, "reached");
});
