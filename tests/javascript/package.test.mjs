// What the package does with good and bad input; no other program is needed.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { test } from "node:test";
import * as plain from "chasles";
import * as inline from "chasles/inline";
import { BoxGeometry, IcosahedronGeometry, Matrix4, Mesh, Object3D, Vector3 } from "three";
import { box, potato, randomNumbers, randomPose } from "./shapes.mjs";

const { InvalidInput, InstanceStopped, load } = plain;
const chasles = await load();
const cube = chasles.polyhedron(box().vertices, box().faces);
const far = [5, 0, 0];
const near = [0.5, 0, 0, 1, 0.2, 0.1, 0];

/** The message of the InvalidInput that `work` throws. */
function refusal(work) {
  try {
    work();
  } catch (error) {
    assert.ok(error instanceof InvalidInput, `${error.name}: ${error.message}`);
    assert.equal(error.name, "InvalidInput");
    assert.ok(!error.message.includes("\n"));
    return error.message;
  }
  return assert.fail("nothing was refused");
}

test("both builds, and every way to the module, give the same answer", async () => {
  const url = new URL(import.meta.resolve("chasles/chasles.wasm"));
  const bytes = await readFile(url);
  const ways = [{ wasm: url }, { wasm: bytes }, { wasm: new Uint8Array(bytes).buffer }, { wasm: new WebAssembly.Module(bytes) }];
  const instances = [await inline.load(), await inline.load({ wasm: bytes })];
  for (const way of ways) instances.push(await load(way));
  const expected = chasles.firstContact(cube, cube, far, near);
  for (const instance of instances) {
    const body = instance.polyhedron(box().vertices, box().faces);
    assert.deepEqual(instance.firstContact(body, body, far, near), expected);
  }
  assert.equal(inline.InvalidInput, InvalidInput);
});

test("bodies from all kinds of arrays are the same", () => {
  const { vertices, faces } = potato(randomNumbers(1), 3, 5);
  const bodies = [
    chasles.polyhedron(vertices, faces),
    chasles.polyhedron(vertices.flat(), faces.flat()),
    chasles.polyhedron(Float64Array.from(vertices.flat()), Uint32Array.from(faces.flat())),
    chasles.polyhedron(vertices.map((v) => Float64Array.from(v)), Uint16Array.from(faces.flat())),
    chasles.polyhedron(vertices, faces.map((f) => Uint32Array.from(f))),
  ];
  for (const body of bodies) {
    assert.deepEqual([...body.vertices], vertices.flat());
    assert.deepEqual(body.faces, faces);
    assert.deepEqual([...body.triangles], faces.flat());
    assert.deepEqual(body.report, bodies[0].report);
    assert.ok(body.report.closed);
  }
});

test("polygons are cut into triangles that cover them, and ids stay those of the input", () => {
  assert.equal(cube.triangles.length, 36);
  assert.deepEqual([...cube.sourceFaces], [0, 1, 2, 3, 4, 5]);
  const bent = [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]];
  assert.match(refusal(() => chasles.polyhedron(bent, [[0, 1, 2, 3]])), /^face 0: .*planar/);
  assert.deepEqual([...chasles.polyhedron(bent, [[0, 1, 2, 3]], { triangulate: true }).sourceFaces], [0, 0]);
});

const files = {
  "cube.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
  "cube.OFF": "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
  "cube.ply":
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 4\n" +
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
  "cube.stl": `solid a\n${[[[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
    [[0, 0, 0], [0, 0, 1], [0, 1, 0]], [[1, 0, 0], [0, 1, 0], [0, 0, 1]]]
    .map((t) => `facet normal 0 0 0\nouter loop\n${t.map((v) => `vertex ${v.join(" ")}`).join("\n")}\nendloop\nendfacet`)
    .join("\n")}\nendsolid a\n`,
};

test("the four formats give the same body", () => {
  for (const [name, text] of Object.entries(files)) {
    const { vertices: _, ...report } = chasles.fromFile(new TextEncoder().encode(text), name).report;
    assert.deepEqual([report.distinct_vertices, report.faces, report.edges, report.closed], [4, 4, 6, true], name);
  }
});

test("a map of OctoMap is the cubes of its occupied cells", () => {
  const header = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.5\ndata\n";
  const bytes = new Uint8Array([...new TextEncoder().encode(header), 2, 0]); // the first of eight children is occupied
  const { faces, closed, volume, lower, upper } = chasles.fromFile(bytes, "map.bt").report;
  assert.deepEqual([faces, closed, volume], [6, true, 16384 ** 3]);
  assert.deepEqual([[...lower], [...upper]], [[-16384, -16384, -16384], [0, 0, 0]]);
});

test("files that cannot be read are refused with their name, the line and the reason", () => {
  const read = (text, name) => refusal(() => chasles.fromFile(new TextEncoder().encode(text), name));
  assert.equal(read("v 0 0 nan\n", "a.obj").slice(0, 13), "a.obj: line 1");
  assert.match(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a.obj"), /^a\.obj: line 4: /);
  assert.match(read("", "a.obj"), /^a\.obj: is empty/);
  assert.match(read("solid", "picture.png"), /^picture\.png: no reader for the extension '\.png'; \.obj, /);
  assert.match(read("v 0 0 0\n", "two\nlines.obj"), /has no face/);
  assert.match(refusal(() => chasles.fromFile("text", "a.obj")), /^content: /);
  const random = randomNumbers(2);
  for (let i = 0; i < 300; ++i) {
    // Broken files: some bytes of a good one are random.
    const [name, text] = Object.entries(files)[i % 4];
    const bytes = new TextEncoder().encode(text);
    for (let k = 0; k < 3; ++k) bytes[Math.floor(random() * bytes.length)] = Math.floor(random() * 256);
    try {
      chasles.fromFile(bytes.subarray(0, Math.ceil(bytes.length * (0.5 + random()))), name).free();
    } catch (error) {
      assert.ok(error instanceof InvalidInput, error.message);
    }
  }
});

test("geometries of three.js: with and without an index, and with vertices that stand for one", () => {
  const geometry = new BoxGeometry(2, 2, 2);
  const [indexed, loose] = [chasles.fromBufferGeometry(geometry), chasles.fromBufferGeometry(geometry.toNonIndexed())];
  for (const body of [indexed, loose]) {
    const { distinct_vertices, faces, closed } = body.report;
    assert.deepEqual([distinct_vertices, faces, closed], [8, 12, true]);
    const found = chasles.firstContact(body, body, far, near);
    const { time, time_upper } = chasles.firstContact(cube, cube, far, near);
    assert.ok(Math.abs(found.time - time) < 1e-12 && Math.abs(found.time_upper - time_upper) < 1e-12);
  }
  assert.ok(chasles.fromBufferGeometry(new IcosahedronGeometry(1)).report.closed);
  assert.match(refusal(() => chasles.fromBufferGeometry({ attributes: {} })), /^geometry: has no attribute position/);
  assert.match(refusal(() => chasles.fromBufferGeometry(null)), /^geometry: /);
});

test("poses: 3, 7 and 16 numbers, matrices and objects of three.js", () => {
  const object = new Object3D();
  object.position.set(0.5, 0, 0);
  object.quaternion.set(0.2, 0.1, 0, 1).normalize();
  object.updateMatrix();
  const expected = chasles.firstContact(cube, cube, far, near);
  const ways = [object, object.matrix, new Matrix4().copy(object.matrix).transpose().toArray()];
  for (const goal of ways) {
    const found = chasles.firstContact(cube, cube, far, goal);
    assert.ok(Math.abs(found.time - expected.time) < 1e-12);
  }
  assert.equal(chasles.firstContact(cube, cube, Float64Array.from(far), near).time, expected.time);
});

test("wrong arguments are refused in words, and the instance goes on", () => {
  const ask = (start, goal, options) => refusal(() => chasles.firstContact(cube, cube, start, goal, options));
  assert.match(ask([1, 2], near), /^start: 2 numbers found; a pose has 3/);
  assert.match(ask(far, [0, 0, 0, 0, 0, 0, 0]), /^goal: pose: /);
  assert.match(ask([NaN, 0, 0], near), /^start: pose: .*NaN/);
  assert.match(ask([Infinity, 0, 0], near), /^start: pose: /);
  assert.match(ask(["1", 0, 0], near), /^start\[0\]: "1" is not a number/);
  assert.match(ask(undefined, near), /^start: undefined is no array/);
  assert.match(ask(far, near, { margn: 1 }), /^margn: is no option here/);
  assert.match(ask(far, near, { margin: -1 }), /^query: margin: must be in/);
  assert.match(ask(far, near, { margin: NaN }), /^query: margin: must be in/);
  assert.match(ask(far, near, { hold: 2, margin: 1 }), /hold/);
  assert.match(ask(far, near, { timeTolerance: 0 }), /^query: timeTolerance: must be/);
  assert.match(ask(far, near, { find: "all" }), /^find: "all": must be 'first', 'any' or 'first_with_all_contacts'/);
  assert.match(ask(far, near, { motion: "spiral" }), /^motion: "spiral": must be 'screw'/);
  assert.match(ask(far, near, { centre: [0, 0, 0] }), /^centre: is for the motions sweep and velocity/);
  assert.match(ask(far, near, { motion: "velocity", maxTurn: 1 }), /^maxTurn: is for the motion screw, but the motion is a velocity/);
  assert.match(ask(far, near, { motion: "sweep", centre: [0, 0] }), /^centre: a point needs 3 numbers/);
  assert.match(ask(far, near, { maxTurn: 0 }), /^motion: maxTurn: must be/);
  assert.match(ask(far, near, { fixedStart: far }), /^fixedGoal: undefined/);
  assert.match(ask(far, near, { fixedCentre: [0, 0, 0] }), /^fixedCentre: is for a fixed body/);
  assert.match(ask(far, near, null), /^options: must be an object/);
  assert.match(refusal(() => chasles.firstContact({}, cube, far, near)), /^moving: is no Polyhedron/);
  assert.match(refusal(() => chasles.firstContactOnPath(cube, cube, [far])), /^poses: a path needs at least two/);
  assert.match(refusal(() => chasles.firstContactOnPath(cube, cube, [far, [1]])), /^poses\[1\]: 1 number found/);
  assert.match(refusal(() => chasles.leastDistance(cube, cube, far, near, { margin: 1 })), /^margin: is no option/);
  assert.match(refusal(() => chasles.leastDistance(cube, cube, far, near, { tolerance: 2 })), /tolerance/);
  assert.match(refusal(() => chasles.firstContactBatch(cube, cube, [far], [])), /^starts, goals: 1 and 0 poses/);
  assert.match(refusal(() => chasles.firstContactBatch(cube, cube, [far, [1]], [near, near])), /^motion 1: start: 1 number/);
  const mesh = (vertices, faces, options) => refusal(() => chasles.polyhedron(vertices, faces, options));
  assert.match(mesh(box().vertices, [[0, 1, 8]]), /^face 0: vertex index 8 is out of range/);
  assert.match(mesh(box().vertices, [[0, 1, -1]]), /^faces\[0\]\[2\]: there is no vertex -1/);
  assert.match(mesh(box().vertices, [[0, 1, 1.5]]), /^faces\[0\]\[2\]: there is no vertex 1.5/);
  assert.match(mesh(box().vertices, [0, 1]), /^faces: 2 indices are no triangles/);
  assert.match(mesh(box().vertices, [[0, 1]]), /^face 0: /);
  assert.match(mesh(box().vertices, []), /face/);
  assert.match(mesh([1, 2], [0, 1, 2]), /^vertices: 2 numbers are no points/);
  assert.match(mesh([[0, 0]], [0, 1, 2]), /^vertices\[0\]: 2 numbers are no point/);
  assert.match(mesh([[0, 0, NaN], [1, 0, 0], [0, 1, 0]], [0, 1, 2]), /vertex 0/);
  assert.match(mesh(box().vertices, box().faces, { triangulate: 1 }), /^triangulate: /);
  assert.equal(chasles.firstContact(cube, cube, far, near).verdict, "contact");
});

test("freed bodies are refused, and what uses them goes on", () => {
  const before = chasles.held;
  const body = chasles.polyhedron(box().vertices, box().faces);
  const scene = chasles.scene();
  scene.add("a", body, { pose: far });
  scene.add("b", body);
  const hand = chasles.draggedBody(scene, "a");
  body.free();
  body.free();
  assert.match(refusal(() => chasles.firstContact(body, cube, far, near)), /^moving: has been freed/);
  assert.match(refusal(() => body.report), /^polyhedron: has been freed/);
  assert.match(refusal(() => scene.add("c", body)), /^shape: has been freed/);
  assert.equal(scene.firstContact().verdict, "clear");
  scene[Symbol.dispose ?? Symbol.for("Symbol.dispose")]();
  assert.match(refusal(() => scene.firstContact()), /^scene: has been freed/);
  assert.match(refusal(() => scene.names), /^scene: has been freed/);
  assert.equal(hand.update([0, 0, 0]).state, "resting");
  hand.free();
  for (const name of ["name", "pose", "margin", "reach"]) assert.match(refusal(() => hand[name]), /^dragged body: has been freed/, name);
  for (const name of ["report", "vertices", "faces", "triangles", "sourceFaces"]) assert.match(refusal(() => body[name]), /^polyhedron: has been freed/, name);
  assert.match(refusal(() => hand.update(far)), /^dragged body: has been freed/);
  assert.deepEqual(chasles.held, before);
});

test("functions of an instance may be taken out of it", () => {
  const { firstContact, isClear, scene } = chasles;
  assert.equal(firstContact(cube, cube, far, near).verdict, "contact");
  assert.equal(isClear(cube, cube, far, near), false);
  assert.deepEqual(scene().names, []);
  assert.deepEqual(Object.keys(chasles), [], "they are not listed");
});

test("what stands beside the right argument is refused with the way out", () => {
  const part = chasles.fromObject3D(new Mesh(new BoxGeometry(1, 1, 1)));
  const point = new Vector3(5, 0, 0);
  assert.match(refusal(() => chasles.firstContact(part, cube, far, near)), /^moving: is no Polyhedron, but has one: give its body$/);
  assert.match(refusal(() => chasles.scene().add("a", part)), /^shape: is no Polyhedron, but has one: give its body$/);
  assert.match(refusal(() => chasles.firstContact(cube, cube, point, near)), /^start: .* is no array of numbers: a Vector3 is given as v\.toArray\(\)$/);
  assert.match(refusal(() => chasles.poseAt(far, near, 0, { motion: "sweep", centre: point })), /^centre: .* v\.toArray\(\)$/);
  assert.match(refusal(() => chasles.polyhedron([point, point, point], [[0, 1, 2]])), /^vertices\[0\]: .* is no point of 3 numbers: .* v\.toArray\(\)$/);
  const scene = chasles.scene();
  scene.add("a", cube);
  for (const rounds of [1e10, 2 ** 30 + 1, 1.5, Infinity])
    assert.match(refusal(() => chasles.draggedBody(scene, "a", { rounds })), /^rounds: must be a whole number up to 1073741824$/);
});

test("the fixed body of a screw or a sweep follows the constant twist between its poses", () => {
  const random = randomNumbers(8);
  const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
  let found = 0, apart = 0;
  for (let i = 0; i < 60; ++i) {
    const [fixedStart, fixedGoal] = [randomPose(random, 2), randomPose(random, 2)];
    for (const motion of ["screw", "sweep"]) {
      const options = { motion, fixedStart, fixedGoal };
      const answer = chasles.firstContact(cube, cube, [9, 0, 0], randomPose(random, 1), options);
      if (answer.verdict === "clear" || answer.time === 0) continue;
      const twist = chasles.poseAt(fixedStart, fixedGoal, answer.time, { motion: "twist" });
      const sign = twist[3] * answer.fixed_pose[3] < 0 ? -1 : 1; // q and -q are one turn
      assert.ok(distance(twist.map((x, k) => (k > 2 ? sign * x : x)), answer.fixed_pose) < 1e-12, `${motion} ${i}`);
      ++found;
      apart += distance(chasles.poseAt(fixedStart, fixedGoal, answer.time, { motion }).slice(0, 3), answer.fixed_pose.slice(0, 3)) > 1e-9 ? 1 : 0;
    }
  }
  assert.ok(found > 50 && apart > 25, `${found} contacts, ${apart} where the fixed body is not on a motion of the same kind`);
  const fixed = { fixedStart: far, fixedGoal: near, fixedCentre: [1, 0, 0] };
  for (const motion of ["screw", "sweep", "twist"]) assert.match(refusal(() => chasles.firstContact(cube, cube, far, near, { ...fixed, motion })), /centre.* velocity/i);
  chasles.firstContact(cube, cube, far, near, { ...fixed, motion: "velocity" });
});

test("bodies that nothing refers to are freed", { skip: globalThis.gc ? false : "skipped: no --expose-gc" }, async () => {
  const before = chasles.held.polyhedra;
  (() => Array.from({ length: 50 }, () => chasles.polyhedron(box().vertices, box().faces)))();
  assert.equal(chasles.held.polyhedra, before + 50);
  for (let i = 0; i < 50 && chasles.held.polyhedra > before; ++i) {
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
  assert.ok(chasles.held.polyhedra <= before);
});

test("bodies of another instance are refused", async () => {
  const other = await load();
  const body = other.polyhedron(box().vertices, box().faces);
  assert.match(refusal(() => chasles.firstContact(cube, body, far, near)), /^fixed: belongs to another instance/);
});

test("what is out of memory throws RangeError, and the instance goes on", async () => {
  const instance = await load();
  const body = instance.polyhedron(box().vertices, box().faces);
  assert.throws(() => instance.fromFile(new Uint8Array(2 ** 31 - 1), "a.obj"), (error) => error instanceof RangeError || error instanceof InvalidInput);
  assert.equal(instance.firstContact(body, body, far, near).verdict, "contact");
});

test("a trap stops the instance, and nothing else", async () => {
  const require = createRequire(import.meta.resolve("chasles"));
  const { Border } = await import(require.resolve("chasles").replace(/index\.js$/, "border.js"));
  const bytes = Uint8Array.from([0, 97, 115, 109, 1, 0, 0, 0, 1, 8, 2, 96, 0, 0, 96, 0, 1, 127, 3, 3, 2, 0, 1, 7, 28, 2, 11,
    95, 105, 110, 105, 116, 105, 97, 108, 105, 122, 101, 0, 0, 10, 99, 104, 97, 115, 108, 101, 115, 95, 103, 111, 0, 1, 10, 8,
    2, 2, 0, 11, 3, 0, 0, 11]); // _initialize does nothing; chasles_go runs into `unreachable`
  const border = await Border.open(new WebAssembly.Module(bytes));
  for (let i = 0; i < 2; ++i) assert.throws(() => border.call("go"), (error) => error instanceof InstanceStopped && /unreachable/.test(error.message));
  border.free("body", 1); // a finalizer may come later: no effect
});

test("contacts are empty only with an overlap at the start", () => {
  const random = randomNumbers(5);
  const seen = { overlaps: 0, empty: 0, contacts: 0 };
  for (let i = 0; i < 600; ++i) {
    const options = { find: ["first", "any", "first_with_all_contacts"][i % 3], margin: i % 2 === 0 ? 0 : 0.3 };
    const found = chasles.firstContact(cube, cube, randomPose(random, 2.5), randomPose(random, 2.5), options);
    if (found.verdict === "clear") continue;
    seen.overlaps += found.overlap ? 1 : 0;
    seen.empty += found.contacts.length === 0 ? 1 : 0;
    seen.contacts += found.verdict === "contact" ? 1 : 0;
    assert.ok(found.contacts.length > 0 || found.overlap, `${i}`);
    assert.ok(!found.overlap || found.verdict === "contact_at_start");
  }
  assert.ok(Object.values(seen).every((count) => count > 50), JSON.stringify(seen));
});

test("scenes: adding, moving, removing, rules", () => {
  const scene = chasles.scene();
  scene.add("a", cube, { pose: far, goal: [-5, 0, 0] });
  scene.add("b", cube, { group: "static" });
  scene.add("c", cube, { poses: [[0, 9, 0], [0, 8, 0], [0, 5, 0]], times: [0, 0.5, 1], group: "static" });
  const found = scene.firstContact();
  assert.deepEqual([found.verdict, found.pair], ["contact", ["a", "b"]]);
  assert.ok(Math.abs(found.time - 0.3) < 1e-9 && found.time <= 0.3 && found.time_upper >= 0.3);
  assert.deepEqual(scene.allContacts().events.map((event) => event.pair), [["a", "b"]]);
  assert.deepEqual(Object.keys(scene.clearUntil()), ["a", "b", "c"]);
  assert.equal(scene.clearUntil().c, 1);
  assert.equal(scene.firstContact({ until: 0.2 }).verdict, "clear");
  scene.setMargin("a", "b", 1);
  assert.ok(Math.abs(scene.firstContact().time - 0.2) < 1e-9);
  scene.setGroupMargin("static", "static", 4);
  scene.ignore("a", "b");
  assert.deepEqual(scene.firstContact().pair, ["c", "b"]);
  scene.ignoreGroups("static", "static");
  assert.equal(scene.firstContact().verdict, "clear");
  scene.remove("a");
  assert.deepEqual(scene.names, ["c", "b"]);
  assert.deepEqual(Object.keys(scene.clearUntil()), ["c", "b"]);
  scene.move("c", { pose: [0, 1, 0] });
  assert.match(refusal(() => scene.add("b", cube)), /^scene: b: /);
  assert.match(refusal(() => scene.add("", cube)), /^scene: /);
  assert.match(refusal(() => scene.add(7, cube)), /^name: 7 is not a text/);
  assert.match(refusal(() => scene.add("d", cube, { motion: "screw" })), /^motion: screw is the motion of one body/);
  assert.match(refusal(() => scene.add("d", cube, { poses: [far, near], times: [0] })), /^times: there are 1 for 2/);
  assert.match(refusal(() => scene.add("d", cube, { poses: [far, near], times: [0, 2] })), /^times: must run from 0 to 1/);
  assert.match(refusal(() => scene.add("d", cube, { poses: [far], pose: far })), /^poses: stand instead/);
  assert.match(refusal(() => scene.remove("x")), /^scene: x: is not in the scene/);
  assert.match(refusal(() => scene.firstContact({ hold: 9 })), /^query: hold: .*margin/);
  assert.deepEqual(scene.names, ["c", "b"]);
});

test("scenes: what is not tested, by reason and by name", () => {
  const scene = chasles.scene();
  const names = ["a", "b", "c", "d"];
  for (const name of names) scene.add(name, cube); // all at one place
  const nothing = { tested: 6, pairs: 0, reasons: [] };
  assert.deepEqual(scene.firstContact({ until: 0 }).untested, nothing, "at time 0 bodies at rest are tested, too");
  const pairs = [["a", "b"], ["a", "c"], ["a", "d"], ["b", "c"], ["b", "d"], ["c", "d"]];
  const resting = scene.firstContact();
  assert.deepEqual([resting.verdict, resting.untested], ["clear", { tested: 0, pairs: 6, reasons: [{ reason: "at_rest", count: 6, pairs }] }]);
  scene.move("a", { pose: far, goal: [0, 0, 0] });
  scene.ignore("a", "c");
  scene.add("e", cube, { pose: [0, 9, 0], group: "left out" });
  scene.ignoreGroups("", "left out");
  const expected = {
    tested: 2,
    pairs: 8,
    reasons: [
      { reason: "at_rest", count: 3, pairs: [["b", "c"], ["b", "d"], ["c", "d"]] },
      { reason: "ignored", count: 5, pairs: [["a", "c"], ["a", "e"], ["b", "e"], ["c", "e"], ["d", "e"]] },
    ],
  };
  for (const answer of [scene.firstContact(), scene.allContacts()]) assert.deepEqual(answer.untested, expected);
  assert.ok(scene.firstContact().work.node_pairs >= 0);
  scene.remove("b"); // the last body takes its index
  assert.deepEqual(scene.firstContact().untested.reasons[0], { reason: "at_rest", count: 1, pairs: [["c", "d"]] });
  const many = chasles.scene();
  for (let i = 0; i < 20; ++i) many.add(`body ${i}`, cube);
  const [{ count, pairs: named }] = many.firstContact().untested.reasons;
  assert.deepEqual([count, named.length], [190, 100]);
});

test("scenes: a body is moved from a pose that is given, never from the origin by default", () => {
  const scene = chasles.scene();
  scene.add("a", cube, { pose: far });
  for (const ask of [() => scene.move("a"), () => scene.move("a", { goal: near }), () => scene.move("a", { motion: "twist", goal: near }), () => scene.move("a", { pose: undefined })])
    assert.match(refusal(ask), /^pose: is missing, .* scene\.poseAt\(name, 0\)/);
  assert.deepEqual(scene.poseAt("a", 1).slice(0, 3), far, "nothing has moved");
  scene.move("a", { pose: scene.poseAt("a", 0), goal: [0, 5, 0] });
  assert.deepEqual([scene.poseAt("a", 0).slice(0, 3), scene.poseAt("a", 1).slice(0, 3)], [far, [0, 5, 0]]);
});

test("scenes: what rests on a table may slide", () => {
  const scene = chasles.scene();
  scene.add("table", cube);
  scene.add("box", cube, { pose: [0, 0, 2.05], goal: [0.5, 0, 2.05] });
  assert.equal(scene.firstContact({ margin: 0.1 }).verdict, "contact_at_start");
  assert.equal(scene.firstContact({ margin: 0.1, hold: 0.02 }).verdict, "clear");
  scene.setGroupHold("", "", 0.02);
  assert.equal(scene.firstContact({ margin: 0.1 }).verdict, "clear");
  scene.setHold("box", "table", 0.2); // not less than the margin
  assert.equal(scene.firstContact({ margin: 0.1 }).verdict, "contact_at_start");
});

test("scenes: splines through poses, and where bodies are", () => {
  const scene = chasles.scene();
  const poses = [[0, 0, 0], [2, 4, 0], [4, 0, 0]];
  scene.add("spline", cube, { motion: "spline", poses, times: [0, 0.5, 1] });
  // The natural cubic spline through heights 0, 4, 0 at the times 0, 1/2, 1 is 4 (3 t - 4 t^3) for t up to 1/2.
  for (const time of [0, 0.1, 0.25, 0.4, 0.5]) {
    const [x, y, z, ...turn] = scene.poseAt("spline", time);
    assert.ok(Math.abs(x - 4 * time) < 1e-12 && Math.abs(y - 4 * (3 * time - 4 * time ** 3)) < 1e-12 && z === 0);
    assert.deepEqual(turn, [1, 0, 0, 0]);
  }
  scene.add("floor", cube, { pose: [2, 7, 0] }); // its lower side is at y = 6, which the upper one of the first meets at y = 5
  assert.equal(scene.firstContact().verdict, "clear");
  scene.move("floor", { pose: [2, 4.5, 0] }); // at the height 2.5 where 3 t - 4 t^3 = 5/8
  const found = scene.firstContact();
  const t = (found.time + found.time_upper) / 2;
  assert.ok(Math.abs(3 * t - 4 * t ** 3 - 0.625) < 1e-9, String(t));
  // A B-spline of positions on a line stays on it, and starts and ends at its ends.
  scene.move("spline", { motion: "b_spline", poses: [[-3, 0, 0], [-3, 0, 1, 1, 0, 0, 1], [-3, 0, 5]] });
  const heights = [0, 0.2, 0.4, 0.6, 0.8, 1].map((time) => scene.poseAt("spline", time)[2]);
  assert.ok(heights.every((height, i) => i === 0 || height > heights[i - 1]) && Math.abs(heights[5] - 5) < 1e-12 && heights[0] === 0);
  assert.match(refusal(() => scene.poseAt("spline", 1.5)), /^time: must be in \[0, 1\]/);
  assert.match(refusal(() => scene.poseAt("none", 0)), /^scene: none: is not in the scene/);
  const refused = (options) => refusal(() => scene.move("spline", { motion: "spline", ...options }));
  assert.match(refused({ poses }), /^times: are missing: one for each pose, ascending from 0 to 1; only the motion "b_spline" has none$/);
  assert.match(refusal(() => scene.add("track", cube, { poses })), /^times: are missing: one for each pose/);
  assert.match(refused({ pose: far }), /^poses: are missing: a spline goes through two or more poses, and has a time for each$/);
  assert.match(refusal(() => scene.move("spline", { motion: "b_spline", pose: far })), /^poses: are missing: a b_spline goes near two or more poses, and has no times$/);
  assert.match(refused({ poses, times: [0, 1, 1] }), /ascend/);
  assert.match(refused({ poses: [far], times: [0] }), /two/);
  assert.match(refused({ pose: far, poses }), /^poses: stand instead/);
  assert.match(refused({ poses, times: [0, 0.5, 1], centre: [0, 0, 0] }), /^centre: is for the motion velocity/);
  assert.match(refusal(() => scene.move("spline", { motion: "b_spline", poses, times: [0, 0.5, 1] })), /^times: a b_spline has none/);
  assert.match(refusal(() => scene.move("spline", { motion: "b_spline", poses: [far] })), /two/);
});

test("scenes: all bodies moved at once, or none", () => {
  const scene = chasles.scene();
  for (const name of ["a", "b", "c"]) scene.add(name, cube, { pose: [9, 9, 9] });
  const starts = [[0, 0, 0], [4, 0, 0], [0, 9, 0]];
  const goals = [[0, 0, 0], [1, 0, 0], [0, 8, 0, 1, 1, 0, 0]];
  scene.moveAll(starts, goals);
  assert.deepEqual(scene.poseAt("b", 0.5), [2.5, 0, 0, 1, 0, 0, 0]);
  assert.ok(Math.abs(scene.firstContact().time - 2 / 3) < 1e-9);
  assert.match(refusal(() => scene.moveAll(starts.slice(1), goals)), /^starts, goals: 2 and 3 poses for 3 bodies/);
  assert.match(refusal(() => scene.moveAll(starts, [far, far, [1]])), /^goals\[2\]: 1 number found/);
  assert.match(refusal(() => scene.moveAll(starts, goals, { motion: "screw" })), /^motion: screw is the motion of one body/);
  assert.deepEqual(scene.poseAt("b", 0.5), [2.5, 0, 0, 1, 0, 0, 0]);
});

test("where the moving body of a question is", () => {
  const half = [0, 0, 0, Math.SQRT1_2, 0, 0, Math.SQRT1_2]; // a quarter turn about z
  // A screw slides by tan(turn / 2); cut into nine pieces of ten degrees, it does so within each of them.
  const tan = (degrees) => Math.tan((degrees * Math.PI) / 180);
  const heights = { sweep: 1, velocity: 1, twist: 1, screw: (2 / 9) * (4 + tan(2.5) / tan(5)), uncut: (2 * tan(22.5)) / tan(45) };
  for (const [motion, height] of Object.entries(heights)) {
    const options = motion === "uncut" ? { maxTurn: Math.PI } : { motion };
    const [x, y, z, w, , , turn] = chasles.poseAt([0, 0, 0], [0, 0, 2, ...half.slice(3)], 0.5, options);
    assert.ok(Math.hypot(x, y, z - height) < 1e-12 && Math.abs(2 * Math.atan2(turn, w) - Math.PI / 4) < 1e-12, motion);
  }
  const found = chasles.firstContact(cube, cube, far, near);
  chasles.poseAt(far, near, found.time).forEach((part, k) => assert.ok(Math.abs(part - found.pose[k]) < 1e-12));
  assert.match(refusal(() => chasles.poseAt(far, near, NaN)), /^time: must be in \[0, 1\]/);
  assert.match(refusal(() => chasles.poseAt(far, near, "0")), /^time: "0" is not a number/);
});

test("a dragged body stops at contacts, slides, and lifts off", () => {
  const scene = chasles.scene();
  const table = chasles.polyhedron(box(20, 20, 1).vertices, box(20, 20, 1).faces);
  scene.add("table", table, { pose: [0, 0, -2] });
  scene.add("cube", cube, { pose: [0, 0, 3] });
  const hand = chasles.draggedBody(scene, "cube", { rounds: 16 });
  let step = hand.update([0, 0, -4]);
  assert.deepEqual([step.state, step.blocking], ["resting", ["table"]]);
  assert.ok(step.events.every((event) => event.begins && event.body === "table") && step.events.length > 0);
  assert.ok(step.contacts.reduce((sum, contact) => sum + contact.force, 0) > 0 && step.wrench[2] > 0);
  for (let i = 0; i < 20; ++i) step = hand.update([5, 0, -4]);
  assert.ok(Math.abs(step.pose[0] - 5) < 1e-3 && step.pose[2] > 0 && step.pose[2] < 0.01, String(step.pose));
  for (let i = 0; i < 20; ++i) step = hand.update([5, 0, 4]);
  assert.equal(step.state, "reached");
  assert.deepEqual(step.contacts, []);
  assert.deepEqual(hand.pose, step.pose);
  assert.ok(hand.update([6, 0, 4], 1e-9).pieces.length <= 1, "the clock of the module runs");
  assert.match(refusal(() => hand.update([1])), /^goal: 1 number found/);
  assert.match(refusal(() => hand.update(far, "1")), /^seconds: "1" is not a number/);
  assert.match(refusal(() => chasles.draggedBody(scene, "x")), /x/);
  assert.match(refusal(() => chasles.draggedBody(scene, "cube", { margin: -1 })), /margin/);
  assert.match(refusal(() => chasles.draggedBody(scene, "cube", { rounds: -1 })), /rounds/);
});

test("workers answer as one instance does", async () => {
  const { vertices, faces } = potato(randomNumbers(3), 4, 7);
  const body = chasles.polyhedron(vertices, faces);
  const starts = Array.from({ length: 101 }, (_, i) => [4, 0.03 * i, 0]);
  const goals = starts.map((_, i) => [0, 0.06 * i, 0, 1, 0.1, 0.02 * i, 0]);
  const workers = await chasles.workers({ count: 2 });
  try {
    const options = { find: "first_with_all_contacts" };
    const answers = await workers.firstContactBatch(body, cube, starts, goals, options);
    assert.deepEqual(answers, chasles.firstContactBatch(body, cube, starts, goals, options));
    assert.ok(answers.some((answer) => answer.verdict === "contact") && answers.some((answer) => answer.verdict === "clear"));
    starts[77] = [1];
    await assert.rejects(workers.firstContactBatch(body, cube, starts, goals), (error) =>
      error instanceof InvalidInput && /^motion 77: start: 1 number found/.test(error.message));
    const dropped = chasles.polyhedron([...vertices, [9, 9, 9]], [[0, 1, 0], ...faces]); // a face without area
    starts[77] = far;
    const ids = await workers.firstContactBatch(dropped, cube, starts.slice(0, 5), goals.slice(0, 5));
    assert.deepEqual(ids, chasles.firstContactBatch(dropped, cube, starts.slice(0, 5), goals.slice(0, 5)));
    const bent = chasles.polyhedron([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]], [[0, 1, 2, 3]], { triangulate: true });
    const cut = await workers.firstContactBatch(bent, cube, starts.slice(0, 5), goals.slice(0, 5));
    assert.deepEqual(cut, chasles.firstContactBatch(bent, cube, starts.slice(0, 5), goals.slice(0, 5)));
  } finally {
    workers.stop();
  }
  await assert.rejects(workers.firstContactBatch(body, cube, starts, goals), InvalidInput);
  await assert.rejects(chasles.workers({ count: 0 }), InvalidInput);
});
