// What is read from objects of the package: made once, and of no effect when it is written to.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "chasles";
import { SphereGeometry } from "three";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const { vertices, faces } = box();
const arrays = ["vertices", "triangles", "sourceFaces"];
const parts = [...arrays, "faces", "report"];

/** Members that are computed when they are read, by the objects of the package that have them. */
function gettersOf(object) {
  const names = [];
  for (let type = Object.getPrototypeOf(object); type !== Object.prototype; type = Object.getPrototypeOf(type))
    for (const [name, { get }] of Object.entries(Object.getOwnPropertyDescriptors(type))) if (get) names.push(name);
  return names;
}

test("every array that a member gives is the same at each read, or as short as a pose", () => {
  const body = chasles.fromBufferGeometry(new SphereGeometry(1, 16, 8));
  const scene = chasles.scene();
  for (let i = 0; i < 50; ++i) scene.add(`body ${i}`, body, { pose: [3 * i, 0, 0] });
  const hand = chasles.draggedBody(scene, "body 0");
  let compared = 0;
  for (const object of [body, scene, hand])
    for (const name of gettersOf(object)) {
      const value = object[name];
      const isSmall = typeof value !== "object" || value.length <= 7;
      assert.ok(isSmall || value === object[name], name);
      compared += isSmall ? 0 : 1;
    }
  assert.equal(compared, parts.length + 1); // and scene.names
});

test("loops over arrays of a body take time as long as the arrays", () => {
  const body = chasles.fromBufferGeometry(new SphereGeometry(1, 128, 64));
  const begin = performance.now();
  let sum = 0;
  for (let i = 0; i < body.triangles.length; ++i) sum += body.triangles[i];
  for (let i = 0; i < body.vertices.length; ++i) sum += body.vertices[i];
  for (let i = 0; i < body.faces.length; ++i) sum += body.faces[i].length + body.sourceFaces[i] + body.report.faces;
  assert.ok(performance.now() - begin < 3000 && sum !== 0); // half a minute when each read made an array
});

test("what is written to an array changes nothing of its body", async () => {
  const body = chasles.polyhedron(vertices, faces);
  for (const name of ["report", "faces"]) assert.ok(Object.isFrozen(body[name]), name);
  for (const inner of [body.faces[0], body.report.lower, body.report.upper]) assert.ok(Object.isFrozen(inner));
  const far = [5, 0, 0];
  const expected = chasles.firstContact(body, body, far, [0, 0, 0]);
  for (const name of arrays) body[name].fill(0);
  assert.equal(body.vertices[0], 0);
  assert.deepEqual(chasles.firstContact(body, body, far, [0, 0, 0]), expected);
  const workers = await chasles.workers({ count: 1 });
  assert.deepEqual(await workers.firstContactBatch(body, body, [far], [[0, 0, 0]]), [expected]);
  workers.stop();
});

test("an array that was sent to a worker is made anew", () => {
  const body = chasles.polyhedron(vertices, faces);
  for (const name of arrays) {
    const expected = body[name].slice();
    structuredClone(body[name], { transfer: [body[name].buffer] });
    assert.deepEqual(body[name], expected, name);
  }
});

test("arrays are released with their body, and refused after that", async () => {
  const body = chasles.polyhedron(vertices, faces);
  const kept = parts.map((name) => new WeakRef(body[name]));
  body.free();
  for (const name of parts) assert.match(refusal(() => body[name]), /^polyhedron: has been freed/);
  for (let i = 0; i < 20 && kept.some((ref) => ref.deref()); ++i) {
    await new Promise((resolve) => setTimeout(resolve, 5));
    globalThis.gc();
  }
  assert.ok(kept.every((ref) => ref.deref() === undefined));
});

test("names of a scene are another array after each change, and frozen", () => {
  const scene = chasles.scene();
  const body = chasles.polyhedron(vertices, faces);
  const seen = [scene.names];
  for (const name of ["a", "b", "c"]) {
    scene.add(name, body);
    seen.push(scene.names);
  }
  scene.remove("a");
  seen.push(scene.names);
  assert.deepEqual(seen, [[], ["a"], ["a", "b"], ["a", "b", "c"], ["c", "b"]]);
  assert.ok(seen.every(Object.isFrozen));
});

test("arrays of a body make the same body, and the turned one", () => {
  const inwards = chasles.polyhedron(vertices, faces.map((face) => [...face].reverse()));
  const copy = chasles.polyhedron(inwards.vertices, inwards.faces);
  assert.deepEqual(copy.report, inwards.report);
  const turned = chasles.polyhedron(copy.vertices, copy.faces.map((face) => [...face].reverse()));
  assert.deepEqual(turned.report, chasles.polyhedron(vertices, faces).report);
});

test("a handle that is sent or saved is empty, and its arrays make the body again, as the README says", () => {
  const body = chasles.polyhedron(vertices, faces);
  assert.deepEqual([JSON.stringify(body), Object.keys(structuredClone(body))], ["{}", []]);
  const sent = structuredClone({ vertices: body.vertices, faces: body.faces });
  assert.deepEqual(chasles.polyhedron(sent.vertices, sent.faces).report, body.report);
});

const near = vertices.map((point, i) => (i === 7 ? point.map((x) => x + 1e-6) : point));
const bent = vertices.map((point, i) => (i === 7 ? [point[0] + 0.3, point[1], point[2] - 0.2] : point));
const gap = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 0, 0]];
const gapFaces = [[0, 2, 1], [0, 4, 3], [4, 1, 3], [0, 1, 4], [0, 3, 2], [1, 2, 3]]; // [0, 1, 4] has no area
const kinds = {
  gap: [gap, gapFaces, { solid: "yes" }],
  "round gap": [gap, gapFaces, { radius: 1e-3 }],
  "surface with a gap": [gap, gapFaces, { solid: "no" }],
  "gap and segment": [[...gap, [5, 5, 5], [6, 5, 5]], [[5, 6, 6], ...gapFaces]],
  "nearly planar": [near, faces],
  cut: [bent, faces, { triangulate: true }],
  "cut and round": [bent, faces, { triangulate: true, radius: 0.01 }],
  moved: [vertices, faces, { radius: -1e-3 }],
  "cut and moved": [bent, faces, { triangulate: true, radius: -1e-3 }],
};

test("a body that is made again, from its arrays or in a worker, is the same body", async () => {
  const small = box(0.01);
  const speck = chasles.polyhedron(small.vertices, small.faces);
  const places = Array.from({ length: 20 }, (_, i) => [0.3 + 0.03 * i, 0.3, 0.1 * i - 0.9, 1, 0.2 * i, 0.1, 0]);
  const starts = [[0.3, 0.3, 0.3], ...places];
  const goals = [[0.31, 0.3, 0.3], ...places.map(([, ...rest]) => [-3, ...rest])];
  const workers = await chasles.workers({ count: 1 });
  try {
    for (const [name, given] of Object.entries(kinds)) {
      const body = chasles.polyhedron(...given);
      const { report } = body;
      const isSolid = name !== "surface with a gap";
      assert.equal(report.solid_parts, isSolid ? 1 : 0, name);
      const again = chasles.polyhedron(body.vertices, body.faces, { solid: isSolid ? "automatic" : "no", radius: report.radius });
      for (const part of ["solid_parts", "volume", "closed", "faces", "segments", "radius"]) assert.equal(again.report[part], report[part], `${name}: ${part}`);
      assert.deepEqual(again.faces, body.faces, name);
      assert.equal(body.sourceFaces.length, body.faces.length, name);
      const answers = chasles.firstContactBatch(speck, body, starts, goals);
      assert.equal(answers[0].verdict, isSolid ? "contact_at_start" : "clear", name);
      assert.ok(answers.filter(({ verdict }) => verdict !== "clear").length > 4, name);
      assert.deepEqual(await workers.firstContactBatch(speck, body, starts, goals), answers, name); // with the same ids
      const seen = ({ verdict, time, inside }) => [verdict, time, inside];
      assert.deepEqual(chasles.firstContactBatch(speck, again, starts, goals).map(seen), answers.map(seen), name);
    }
  } finally {
    workers.stop();
  }
});
