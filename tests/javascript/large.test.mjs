// Arguments of many million numbers, and memory that is full.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";
import { load } from "chasles";
import { box, refusal } from "./shapes.mjs";

/**
 * The messages of calls with long arguments, of which each is refused by its first number. Node.js has a heap in which no Array of so many
 * numbers finds room, and ends where one is made.
 */
const script = `
  import { load } from "chasles";
  const chasles = await load();
  const ball = chasles.sphere(1);
  const scene = chasles.scene();
  scene.add("ball", ball);
  const [many, indices, poses] = [new Float32Array(8e6), new Uint16Array(8e6), new Array(1e6).fill([NaN, 0, 0, 1, 0, 0, 0])];
  many[0] = NaN;
  const corner = [0, 0, 0, 1, 0, 0, 0, 1, 0];
  const at = { position: { count: 3, itemSize: 3, getX: (i) => i % 2, getY: (i) => i % 3, getZ: () => NaN } };
  const calls = {
    vertices: () => chasles.polyhedron(many, [0, 1, 2]),
    points: () => chasles.points(many, 1),
    "whole numbers": () => chasles.polyhedron([NaN, ...corner.slice(1)], indices),
    indices: () => chasles.polyhedron([NaN, ...corner.slice(1)], new Uint32Array(8e6)),
    "a face": () => chasles.polyhedron([NaN, ...corner.slice(1)], [new Uint32Array(8e6)]),
    geometry: () => chasles.fromBufferGeometry({ attributes: at, index: { count: 8e6, getX: (i) => i % 3 } }),
    pose: () => chasles.firstContact(ball, ball, many, corner),
    centre: () => chasles.isClear(ball, ball, [0, 0, 0], [1, 0, 0], { motion: "sweep", centre: many }),
    path: () => chasles.firstContactOnPath(ball, ball, poses),
    margins: () => chasles.profile(ball, ball, [9, 0, 0], [5, 0, 0], { margins: many }),
    starts: () => scene.moveAll(poses, poses),
    track: () => scene.move("ball", { poses, times: new Float64Array(1e6) }),
    inertia: () => chasles.draggedBody(scene, "ball", { mass: { inertia: many } }),
  };
  const messages = {};
  for (const [name, call] of Object.entries(calls))
    try {
      call();
    } catch (error) {
      messages[name] = error.name + ": " + error.message;
    }
  console.log(JSON.stringify(messages));
`;

test("typed arrays and long lists are read where they are: no Array is made of them", () => {
  const { status, stdout, stderr } = spawnSync(process.execPath, ["--max-old-space-size=40", "--input-type=module", "-e", script], { encoding: "utf8", timeout: 120_000 });
  assert.equal(status, 0, stderr);
  const messages = JSON.parse(stdout);
  assert.equal(Object.keys(messages).length, 13);
  for (const [name, message] of Object.entries(messages)) assert.match(message, /^InvalidInput: /, name);
  assert.match(messages.pose, /start: 8000000 numbers found; a pose has 3/);
  assert.match(messages.path, /poses\[0\]: /);
});

test("typed arrays of every kind make the same body", async () => {
  const chasles = await load();
  const { vertices } = box();
  const corners = [0, 1, 3, 0, 3, 2];
  const expected = chasles.polyhedron(vertices, corners);
  for (const Vertices of [Float64Array, Float32Array, Int32Array, Int8Array])
    for (const Faces of [Uint32Array, Uint16Array, Uint8Array, Int32Array, Float64Array]) {
      const given = [Vertices.from(vertices.flat()), Faces.from(corners)];
      const body = chasles.polyhedron(...given);
      for (const numbers of given) numbers.fill(1); // the body has its own numbers
      for (const part of ["vertices", "triangles"]) assert.deepEqual(body[part], expected[part]);
    }
  assert.equal(refusal(() => chasles.polyhedron(BigInt64Array.from(vertices.flat(), BigInt), corners)), "vertices: a BigInt64Array holds no numbers: Float64Array.from(vertices, Number) makes them");
  for (const [faces, wrong] of [[Float64Array.of(0, 1, 2.5), "2.5"], [Int32Array.of(0, 1, -1), "-1"], [Uint32Array.of(0, 1, 8), "8"]])
    assert.match(refusal(() => chasles.polyhedron(vertices, faces)), new RegExp(`^face.*vertex.* ${wrong}( |$)`));
});

test("memory that is full throws RangeError by name: free() makes room, and the instance goes on", async () => {
  const chasles = await load();
  const ball = chasles.sphere(1);
  const full = (call) => assert.throws(call, (error) => error instanceof RangeError && /^chasles: out of memory: .*free\(\)/.test(error.message));
  full(() => chasles.polyhedron(new Uint8Array(6e8), [0, 1, 2])); // 4.8 GB in the module
  assert.equal(chasles.firstContact(ball, ball, [5, 0, 0], [0, 0, 0]).verdict, "contact");
});
