// Bodies with a radius: round ones, and parts that touch by design.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "chasles";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const cube = chasles.polyhedron(box().vertices, box().faces);
const side = Math.max(...cube.vertices) - Math.min(...cube.vertices);

test("round bodies meet at the sum of their radii", () => {
  const ball = chasles.sphere(0.5);
  for (const other of [chasles.capsule(0.25, 2), chasles.points([[0, 0, 0], [0, 0, 5]], 0.25)]) {
    const found = chasles.firstContact(ball, other, [4.75, 0, 0], [0.7, 0, 0]);
    assert.equal(found.verdict, "contact");
    assert.ok(Math.abs(found.time * 4.05 - 4) < 1e-9);
    assert.ok(Math.abs(found.contacts[0].point[0] - 0.25) < 1e-9);
    assert.ok(Math.abs(found.contacts[0].gap) < 1e-9);
  }
  assert.equal(ball.report.radius, 0.5);
  assert.deepEqual([...ball.report.upper], [0.5, 0.5, 0.5]);
});

test("a radius below 0 lets bodies touch", () => {
  const block = chasles.polyhedron(box().vertices, box().faces, { radius: -1e-6 });
  assert.deepEqual([block.report.radius, block.report.moved_inwards], [0, 1e-6]);
  assert.equal(chasles.firstContact(cube, cube, [side, 0, 0], [side, 0.1, 0]).verdict, "contact_at_start");
  assert.equal(chasles.firstContact(block, cube, [side, 0, 0], [side, 0.1, 0]).verdict, "clear");
  assert.equal(chasles.firstContact(block, cube, [side, 0, 0], [0, 0, 0]).verdict, "contact");
});

test("scenes of round bodies", () => {
  const scene = chasles.scene();
  scene.add("ball", chasles.sphere(1), { pose: [0, 0, 0] });
  scene.add("other", chasles.sphere(1), { pose: [4, 0, 0], goal: [0, 0, 0] });
  assert.ok(Math.abs(scene.firstContact().time - 0.5) < 1e-11);
});

test("messages name the argument once", () => {
  assert.match(refusal(() => chasles.scene().add("a", cube, { pose: [0, 0, 0, 0, 0, 0, 0] })), /^pose: quaternion: /);
  assert.match(refusal(() => chasles.firstContact(cube, cube, [0, 0, 0, 0, 0, 0, 0], [0, 0, 0])), /^start: pose: quaternion: /);
});

test("sizes that no body has are refused", () => {
  assert.match(refusal(() => chasles.sphere(0)), /radius: must be positive, and is 0/);
  assert.match(refusal(() => chasles.capsule(1, -1)), /length: must be positive/);
  assert.match(refusal(() => chasles.points([[1, 2]], 1)), /points\[0\]: 2 numbers are no point of 3 numbers/);
  assert.match(refusal(() => chasles.polyhedron(box().vertices, box().faces, { radius: "1" })), /radius/);
  assert.match(refusal(() => chasles.polyhedron(box().vertices, box().faces, { radius: -100 })), /turns face/);
});
