// Scenes: what their answers say, and what they refuse.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "chasles";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const { vertices, faces } = box();
const cube = chasles.polyhedron(vertices, faces);

/** A plate of 40 by 40 and of 2 n^2 triangles, the higher the farther from its middle. */
function bowedPlate(n, height, bow) {
  const indices = Array.from({ length: n + 1 }, (_, i) => i);
  const places = indices.map((i) => (40 * i) / n - 20);
  const corner = (i, k) => i * (n + 1) + k;
  const squares = indices.slice(1).flatMap((i) => indices.slice(1).map((k) => [corner(i - 1, k - 1), corner(i, k - 1), corner(i, k), corner(i - 1, k)]));
  return chasles.polyhedron(
    places.flatMap((x) => places.map((y) => [x, y, height + (bow * (x * x + y * y)) / 800])),
    squares.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]),
  );
}

test("a list of contacts that is cut says so, in every answer that has one", () => {
  const [lower, upper] = [bowedPlate(60, 0, 0.49), bowedPlate(60, 2, 0.5)];
  const [start, goal] = [[0, 0, 0], [0, 0, 1]];
  const scene = chasles.scene();
  scene.add("lower", lower);
  scene.add("upper", upper, { pose: start, goal });
  const options = { margin: 2.3, find: "first_with_all_contacts" };
  for (const found of [...scene.allContacts(options).events, scene.firstContact(options), chasles.firstContact(upper, lower, start, goal, options)])
    assert.deepEqual([found.contacts_cut, found.contacts.length > 500], [true, true]);
  const held = chasles.firstContact(upper, lower, start, goal, { ...options, hold: 1 });
  assert.deepEqual([held.verdict, held.contacts_cut, held.held.length > 500], ["clear", true, true]);
  const few = chasles.scene();
  few.add("lower", cube);
  few.add("upper", cube, { pose: [0, 0, 3], goal: [0, 0, 0] });
  assert.ok(!("contacts_cut" in few.allContacts(options).events[0]));
});

test("a wrong name is answered with the names that the call takes", () => {
  const [pose, goal] = [[0, 0, 0], [1, 0, 0]];
  const scene = chasles.scene();
  scene.add("a", cube);
  const all = "must be 'velocity', 'twist', 'spline' or 'b_spline'";
  assert.equal(refusal(() => scene.add("b", cube, { pose, goal, motion: "linear" })), `motion: "linear": ${all}`);
  assert.equal(refusal(() => scene.move("a", { poses: [pose, goal], times: [0, 1], motion: "bspline" })), `motion: "bspline": ${all}`);
  assert.match(refusal(() => scene.add("b", cube, { pose, goal, motion: "sweep" })), /a scene takes 'velocity', 'twist', 'spline' and 'b_spline'$/);
  for (const motion of ["spline", "xx"]) assert.equal(refusal(() => scene.moveAll([pose], [goal], { motion })), `motion: "${motion}": must be 'velocity' or 'twist'`);
  assert.match(refusal(() => scene.moveAll([pose], [goal], { motion: "sweep" })), /a scene takes 'velocity' and 'twist'$/);
  for (const [motion, more] of [["twist", { pose, goal }], ["twist", { poses: [pose, goal], times: [0, 1] }], ["b_spline", { poses: [pose, goal] }]])
    assert.equal(refusal(() => scene.move("a", { ...more, motion, centre: [0, 0, 0] })), `centre: is for the motion velocity, but the motion is a ${motion}`);
  const lists = [(find) => scene.allContacts({ find }), (find) => scene.clearUntil({ find }), (find) => chasles.leastDistance(cube, cube, [5, 0, 0], goal, { find })];
  for (const ask of lists) assert.equal(refusal(() => ask("all")), "find: \"all\": must be 'first' or 'first_with_all_contacts'");
});

test("halves of a surrogate pair, which UTF-8 does not tell apart, are refused in every name", () => {
  const scene = chasles.scene();
  scene.add("\u{1f980}", cube, { group: "\ufffd" }); // whole characters are names
  assert.deepEqual(scene.names, ["\u{1f980}"]);
  for (const half of ["\ud800", "a\udc01b"]) {
    const shown = JSON.stringify(half);
    const calls = {
      name: [() => scene.add(half, cube), () => scene.remove(half), () => scene.move(half, { pose: [0, 0, 0] }), () => scene.poseAt(half, 0), () => chasles.draggedBody(scene, half)],
      group: [() => scene.add("b", cube, { group: half })],
      a: [() => scene.ignore(half, "b"), () => scene.ignoreGroups(half, "b"), () => scene.setMargin(half, "b", 1)],
      b: [() => scene.ignore("\u{1f980}", half)],
    };
    for (const [name, list] of Object.entries(calls))
      for (const call of list) assert.equal(refusal(call), `${name}: ${shown} has half of a surrogate pair, which is no character`);
  }
});

test("a body that stands still takes no options of a motion", () => {
  const scene = chasles.scene();
  const still = (name) => `${name}: is for a body that moves; without a goal or poses it stands still`;
  for (const more of [{}, { pose: [0, 0, 0] }]) {
    assert.equal(refusal(() => scene.add("a", cube, { ...more, motion: "twist" })), still("motion"));
    assert.equal(refusal(() => scene.add("a", cube, { ...more, centre: [NaN, 0, 0] })), still("centre"));
  }
  scene.add("a", cube, { pose: [0, 0, 0], motion: undefined, centre: undefined });
  assert.equal(refusal(() => scene.move("a", { pose: [0, 0, 0], motion: "velocity" })), still("motion"));
  assert.match(refusal(() => scene.move("a", { pose: [0, 0, 0], goal: [1, 0, 0], centre: [NaN, 0, 0] })), /NaN|finite/);
});

test("rules of groups may be set before the groups have bodies, and holds before margins", () => {
  const scene = chasles.scene();
  scene.setGroupMargin("walls", "parts", 0.1);
  scene.setGroupHold("walls", "parts", 0.02);
  scene.ignoreGroups("walls", "walls");
  scene.add("table", cube, { group: "walls" });
  scene.add("box", cube, { group: "parts", pose: [0, 0, 2.05], goal: [0.5, 0, 2.05] });
  scene.add("base", cube, { group: "walls", pose: [0, 0, -1], goal: [0, 0, -1.5] });
  assert.equal(scene.firstContact().verdict, "clear");
  scene.setHold("box", "table", 0.2); // not less than the margin: without effect
  assert.equal(scene.firstContact().verdict, "contact_at_start");
  scene.setMargin("box", "table", 0.3);
  assert.equal(scene.firstContact().verdict, "clear");
});

const stepAt = ({ times }, time) => Math.max(0, Math.min(times.findLastIndex((t) => t <= time), times.length - 2));

test("profiles bound the distance at every time, and tell zones and free times", () => {
  const profile = chasles.profile(cube, cube, [-5, 2.5, 0], [5, 2.5, 0], { motion: "velocity", margins: [1] });
  assert.ok(profile.certain);
  for (let i = 0; i <= 500; ++i) {
    const distance = Math.hypot(Math.max(Math.abs(10 * (i / 500) - 5) - 2, 0), 0.5), step = stepAt(profile, i / 500);
    assert.ok(profile.lower[step] <= distance + 1e-12 && profile.upper[step] >= distance - 1e-12);
  }
  const [{ margin, inside, doubt }] = profile.zones;
  assert.deepEqual([margin, inside.length, profile.free], [1, 1, [[0, 1]]]);
  assert.ok(Math.abs(inside[0][0] - (0.5 - (2 + Math.sqrt(0.75)) / 10)) < 2e-6 && doubt.every(([from, to]) => to - from < 2e-6));
  assert.match(refusal(() => chasles.profile(cube, cube, [-5, 2.5, 0], [5, 2.5, 0], { absoluteTolerance: -1 })), /^query: absoluteTolerance: /);
  assert.match(refusal(() => chasles.profile(cube, cube, [-5, 2.5, 0], [5, 2.5, 0], { margins: 1 })), /^margins: 1 is no array/);
});

test("a scene has the least distance of each two bodies", () => {
  const scene = chasles.scene();
  assert.deepEqual(scene.leastDistances().pairs, []);
  scene.add("post", cube, { pose: [0, 2.5, 0] });
  scene.add("wall", cube, { pose: [3, 0.2, 0.1] });
  scene.add("cart", cube, { pose: [-4, 0, 0], goal: [4, 0, 0] });
  scene.add("lid", cube, { pose: [-4, 9, 0], goal: [4, 9, 0] });
  scene.ignore("wall", "lid");
  const { pairs, untested } = scene.leastDistances({ tolerance: 1e-9 });
  assert.deepEqual(pairs.map(({ pair }) => pair), [["cart", "post"], ["lid", "post"], ["cart", "wall"], ["cart", "lid"]]);
  const distances = [0.5, 4.5, 0, 7];
  pairs.forEach(({ distance, distance_upper, certain }, i) => {
    assert.ok(certain);
    assert.ok(distance <= distances[i] + 1e-12 && distance_upper >= distances[i] - 1e-12, `${distance} ${distance_upper}`);
    assert.ok(distance_upper - distance < 1e-7);
  });
  assert.ok(pairs[2].distance_upper === 0 && Math.abs(pairs[2].time - 5 / 8) < 1e-9);
  assert.deepEqual([untested.tested, untested.pairs], [4, 2]);
  const nearest = pairs.filter(({ distance }) => distance > 0).sort((a, b) => a.distance - b.distance)[0];
  scene.ignore("cart", "wall");
  assert.equal(scene.leastDistance({ tolerance: 1e-9 }).distance_upper, nearest.distance_upper);
  assert.match(refusal(() => scene.leastDistances({ margin: 1 })), /^margin: is no option/);
});

test("a scene names the two bodies that are nearest, and when", () => {
  const scene = chasles.scene();
  assert.equal(scene.leastDistance(), null);
  assert.deepEqual(Array.from(scene.profile().lower), [Infinity, Infinity]);
  scene.add("left", cube, { pose: [-6, 0, 0] });
  scene.add("right", cube, { pose: [6.25, 0, 0] });
  scene.add("cart", cube, { pose: [-2, 0, 0], goal: [2, 0, 0] });
  const near = scene.leastDistance();
  assert.deepEqual([near.pair, near.certain, near.untested.pairs], [["cart", "left"], true, 1]);
  assert.ok(near.distance <= 2 && near.distance_upper >= 2 && near.distance_upper - near.distance <= 2e-6);
  const profile = scene.profile({ margins: [2.5] });
  assert.deepEqual([profile.pairs, profile.nearest[0], profile.nearest.at(-1)], [[["cart", "left"], ["cart", "right"]], 0, 1]);
  assert.equal(profile.nearest.length, profile.times.length - 1);
  for (let i = 0; i <= 300; ++i) {
    const time = i / 300, step = stepAt(profile, time), distance = Math.min(2 + 4 * time, 6.25 - 4 * time);
    assert.ok(profile.lower[step] <= distance + 1e-12 && profile.upper[step] >= distance - 1e-12);
  }
  assert.ok(Math.abs(profile.zones[0].inside[0][1] - 0.125) < 2e-6 && Math.abs(profile.zones[0].inside[1][0] - 0.9375) < 2e-6);
});
