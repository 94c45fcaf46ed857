// Holes in arrays, options of load, and ways to the module: refused in words, with a way out.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { runInNewContext } from "node:vm";
import { reactive } from "@vue/reactivity";
import { buildSync } from "esbuild";
import { Euler, Quaternion, Vector3 } from "three";
import { load } from "chasles";
import { load as loadInline } from "chasles/inline";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const { vertices, faces } = box();
const cube = chasles.polyhedron(vertices, faces);
const far = [5, 0, 0];

/** A copy of an array with a hole in place of an item. */
function withHole(list, place) {
  const copy = [...list];
  delete copy[place];
  return copy;
}
const without = (list, place) => [withHole(list, place), list.map((item, i) => (i === place ? undefined : item))];

test("holes and missing numbers are refused with their index, in every array", () => {
  const at = (place) => new RegExp(`^[^:]*\\b${place}\\b|\\[${place}\\]`);
  const body = chasles.polyhedron;
  const asked = {
    points: [vertices, (list) => chasles.polyhedron(list, faces)],
    numbers: [vertices.flat(), (list) => chasles.polyhedron(list, faces)],
    "numbers of a point": [[0, 0, 0], (list) => chasles.polyhedron([list, [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])],
    faces: [faces, (list) => chasles.polyhedron(vertices, list)],
    pose: [[0, 0, 0, 1, 0, 0, 0], (list) => chasles.firstContact(cube, cube, list, far)],
    matrix: [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], (list) => chasles.firstContact(cube, cube, far, list)],
    path: [[far, [4, 0, 0], [3, 0, 0]], (list) => chasles.firstContactOnPath(cube, cube, list)],
    starts: [[far, far, far], (list) => chasles.firstContactBatch(cube, cube, list, [far, far, far])],
    goals: [[far, far, far], (list) => chasles.firstContactBatch(cube, cube, [far, far, far], list)],
    centre: [[0, 0, 0], (centre) => chasles.firstContact(cube, cube, far, far, { motion: "sweep", centre })],
    times: [[0, 0.5, 1], (times) => chasles.scene().add("a", cube, { poses: [far, far, far], times })],
    poses: [[far, far, far], (poses) => chasles.scene().add("a", cube, { poses, times: [0, 0.5, 1] })],
    inertia: [[1, 0, 0, 0, 1, 0, 0, 0, 1], (inertia) => dragged({ mass: { inertia } })],
    "rows of an inertia": [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], (inertia) => dragged({ mass: { inertia } })],
    direction: [[0, 0, 1], (direction) => dragged({ lock: { kind: "hinge", direction } })],
  };
  for (const [name, [list, ask]] of Object.entries(asked)) {
    ask(list); // as it is, it is taken
    for (const place of [0, 1, 2])
      for (const spoiled of without(list, place)) assert.match(refusal(() => ask(spoiled)), /undefined|no point|no list|no array/, name);
  }
  assert.match(refusal(() => body.call(chasles, withHole(vertices, 3), faces)), at(3));
  assert.match(refusal(() => body.call(chasles, vertices, withHole(faces, 2))), at(2));
  assert.match(refusal(() => chasles.polyhedron(vertices, [withHole([0, 1, 3, 2], 1), ...faces])), /^faces\[0\]\[1\]: undefined is not a number/);
});

test("corners that are no numbers are called that", () => {
  const asked = {
    'faces[0][0]: "0"': [["0", "2", "1"], ["0", "1", "3"]], 'faces[0]: "0"': "0 2 1 0 1 3".split(" "), "faces[1]: 2n": [0, 2n, 1], "faces[0]: 0n": new BigUint64Array(3),
    "faces[0][0]: an array": [[[0, 2, 1]]], "faces[0][2]: null": [[0, 2, null]],
  };
  for (const [start, list] of Object.entries(asked))
    assert.equal(refusal(() => chasles.polyhedron(vertices, list)), `${start} is not a number, but vertices are named by numbers`);
  assert.equal(refusal(() => chasles.polyhedron(vertices, [0, 1, 2, 0, 1, -1])), "faces[5]: there is no vertex -1");
  assert.equal(refusal(() => chasles.polyhedron(vertices, [[0, 1, 2], "012"])), 'faces[1]: "012" is no list of indices');
  assert.equal(refusal(() => chasles.polyhedron("0 0 1".split(" "), faces)), 'vertices[0]: "0" is no point of 3 numbers');
  assert.equal(refusal(() => chasles.polyhedron([[0, 0, 0, 1]], faces)), "vertices[0]: 4 numbers are no point of 3 numbers");
});

test("points are refused as points, not as faces", () => {
  assert.equal(refusal(() => chasles.points([0, 0, 0, 1], 1)), "points: 4 numbers are no points of 3 numbers each");
  for (const none of [[], new Float64Array(0)]) assert.equal(refusal(() => chasles.points(none, 1)), "points: there are none; a body needs at least one");
  assert.equal(refusal(() => chasles.points([[0, 0]], 1)), "points[0]: 2 numbers are no point of 3 numbers");
});

test("arrays whose bytes were sent to another thread are refused by name", async () => {
  const detached = (array) => (structuredClone(array, { transfer: [array.buffer ?? array] }), array);
  const message = (name) => `${name}: is detached: its bytes belong to another thread now, as after postMessage`;
  for (const content of [new ArrayBuffer(8), new Uint8Array(8)]) {
    assert.equal(refusal(() => chasles.fromFile(detached(content), "a.obj")), message("content"));
    assert.equal(await refusal(load({ wasm: content })), message("wasm"));
  }
  assert.equal(refusal(() => chasles.polyhedron(detached(Float64Array.from(vertices.flat())), faces)), message("vertices"));
  assert.equal(refusal(() => chasles.polyhedron(vertices, detached(new Uint32Array(3)))), message("faces"));
  assert.equal(refusal(() => chasles.points(detached(new Float64Array(3)), 1)), message("points"));
  assert.match(refusal(() => chasles.firstContact(cube, cube, detached(new Float64Array(7)), far)), /^start: 0 numbers found/);
  assert.match(refusal(() => dragged({ mass: { inertia: detached(new Float64Array(9)) } })), /^mass\.inertia: a matrix needs 9 numbers, and there are 0/);
});

test("typed arrays that lie beyond their buffer, and values without a text, are refused in words", () => {
  const shortened = (Type, count) => {
    const buffer = new ArrayBuffer(count * Type.BYTES_PER_ELEMENT, { maxByteLength: 2 * count * Type.BYTES_PER_ELEMENT });
    const view = new Type(buffer, 0, count);
    buffer.resize(8);
    return view;
  };
  const message = (name) => `${name}: lies beyond the end of its buffer, which was made shorter by resize`;
  assert.equal(refusal(() => chasles.polyhedron(shortened(Float64Array, 9), [0, 1, 2])), message("vertices"));
  assert.equal(refusal(() => chasles.polyhedron(vertices, shortened(Uint32Array, 6))), message("faces"));
  assert.equal(refusal(() => chasles.points(shortened(Float32Array, 9), 1)), message("points"));
  assert.equal(refusal(() => chasles.fromFile(shortened(Uint8Array, 99), "a.obj")), message("content"));
  const view = new DataView(new ArrayBuffer(8));
  structuredClone(view.buffer, { transfer: [view.buffer] });
  assert.match(refusal(() => chasles.fromFile(view, "a.obj")), /^content: is detached/);
  const textless = [new Proxy(new Float64Array([3, 0.2, 0.3]), {}), Object.create(null), { toString: null, valueOf: null }];
  for (const value of textless) {
    assert.match(refusal(() => chasles.firstContact(cube, cube, value, far)), /^start: an object is no array of numbers: a pose is/);
    assert.match(refusal(() => chasles.polyhedron([value], faces)), /^vertices\[0\]: an object is no point/);
  }
});

test("whole numbers without limit are no coordinates", () => {
  for (const Type of [BigInt64Array, BigUint64Array])
    for (const count of [0, 9])
      assert.equal(refusal(() => chasles.polyhedron(new Type(count), [0, 1, 2])), `vertices: a ${Type.name} holds no numbers: Float64Array.from(vertices, Number) makes them`);
  assert.match(refusal(() => chasles.points(new BigInt64Array(3), 1)), /^points: a BigInt64Array holds no numbers/);
});

test("the way out for a file leads to formats that are read here", () => {
  const step = new TextEncoder().encode('ISO-10303-21;\nHEADER;\nFILE_SCHEMA(("AUTOMOTIVE_DESIGN"));');
  for (const [bytes, name] of [[step, "a.step"], [new Uint8Array(9), "a.stp"], [new TextEncoder().encode("glTF"), "a.stl"], [new Uint8Array(9), "a.glb"], [new Uint8Array(9), "a.dae"]]) {
    const message = refusal(() => chasles.fromFile(bytes, name));
    assert.match(message, /OBJ, OFF, PLY or STL|\.obj, \.off, \.ply, \.stl, \.bt and \.ot/);
    assert.doesNotMatch(message.slice(message.indexOf(";")), /gl(b|TF)|3mf|dae/i);
  }
});

test("null is no value of any option, and undefined counts as left out", async () => {
  const scene = chasles.scene();
  scene.add("a", cube);
  const motion = ["motion", "centre", "maxTurn"];
  const fixed = ["fixedStart", "fixedGoal", "fixedCentre"];
  const query = ["margin", "hold", "timeTolerance", "find"];
  const profile = ["tolerance", "absoluteTolerance", "margins", "timeTolerance"];
  const places = ["pose", "goal", "motion", "centre", "poses", "times"];
  const workers = await chasles.workers({ count: 1 });
  const asked = [
    [["triangulate", "solid"], (options) => chasles.polyhedron(vertices, faces, options)],
    [["triangulate", "solid"], (options) => chasles.fromFile(new Uint8Array(1), "a.obj", options)],
    [[...query, ...motion, ...fixed], (options) => chasles.firstContact(cube, cube, far, far, options)],
    [[...query, ...motion, ...fixed], (options) => chasles.firstContactBatch(cube, cube, [far], [far], options)],
    [[...query, ...motion, ...fixed], (options) => workers.firstContactBatch(cube, cube, [far], [far], options)],
    [["margin", ...motion, ...fixed], (options) => chasles.isClear(cube, cube, far, far, options)],
    [[...query, ...motion], (options) => chasles.firstContactOnPath(cube, cube, [far, far], options)],
    [["tolerance", "timeTolerance", "find", ...motion, ...fixed], (options) => chasles.leastDistance(cube, cube, far, far, options)],
    [[...profile, ...motion, ...fixed], (options) => chasles.profile(cube, cube, far, far, options)],
    [["tolerance", "timeTolerance", "find"], (options) => scene.leastDistance(options)],
    [["tolerance", "timeTolerance", "find"], (options) => scene.leastDistances(options)],
    [profile, (options) => scene.profile(options)],
    [[...motion, ...fixed], (options) => chasles.poseAt(far, far, 0, options)],
    [[...places, "group"], (options) => scene.add("b", cube, options)],
    [places, (options) => scene.move("a", { pose: far, ...options })],
    [["motion"], (options) => scene.moveAll([far], [far], options)],
    [[...query, "until"], (options) => scene.firstContact(options)],
    [["margin", "reach", "stiffness", "rounds", "friction", "mass", "lock"], dragged],
    [["centre", "inertia"], (mass) => dragged({ mass: { inertia: [1, 0, 0, 0, 1, 0, 0, 0, 1], ...mass } })],
    [["direction", "point", "kind"], (lock) => dragged({ lock: { kind: "hinge", ...lock } })],
    [["count", "worker"], (options) => chasles.workers(options)],
    [["wasm"], (options) => load(options)],
  ];
  for (const [names, ask] of asked)
    for (const name of names) assert.equal(await rejected(() => ask({ [name]: null })), `${name}: is null, which is no value: leave it out, or give undefined`);
  workers.stop();
});

/** The refusal of a question that answers at once or by a promise. */
async function rejected(ask) {
  try {
    await ask();
  } catch (error) {
    return refusal(() => {
      throw error;
    });
  }
  return "";
}

test("an undefined option counts as left out, also one of another question", async () => {
  const names = ["margin", "hold", "timeTolerance", "find", "tolerance", "until", "motion", "centre", "maxTurn", "fixedStart", "fixedGoal", "fixedCentre", "poses", "group", "radius", "count"];
  const none = Object.fromEntries(names.map((name) => [name, undefined]));
  const scene = chasles.scene();
  const asked = [
    () => chasles.firstContact(cube, cube, far, far, none), () => chasles.isClear(cube, cube, far, far, none), () => chasles.poseAt(far, far, 0, none),
    () => chasles.firstContactOnPath(cube, cube, [far, far], none), () => chasles.leastDistance(cube, cube, far, far, none),
    () => chasles.firstContactBatch(cube, cube, [far], [far], none), () => scene.add("a", cube, none), () => scene.move("a", { ...none, pose: far }),
    () => scene.moveAll([far], [far], none), () => scene.firstContact(none), () => scene.allContacts(none), () => scene.clearUntil(none),
    () => chasles.profile(cube, cube, far, far, none), () => scene.leastDistance(none), () => scene.leastDistances(none), () => scene.profile(none),
    () => chasles.draggedBody(scene, "a", none), () => chasles.polyhedron(vertices, faces, none), () => chasles.workers({ ...none, count: 1 }).then((workers) => workers.stop()), () => load(none),
  ];
  for (const ask of asked) await ask();
  assert.match(refusal(() => chasles.isClear(cube, cube, far, far, { find: "first" })), /^find: is no option here; there are margin, /);
});

test("what is no pose is refused with what a pose is", () => {
  const [quaternion, euler] = [new Quaternion(0, 0, 1, 1).normalize(), new Euler(0, 0, 1)];
  const wayOut = /: a pose is a place with a turn: \{ position: \{ x, y, z \}, quaternion: \{ x, y, z, w \} \}, an Object3D, a Matrix4, or 3, 7 \(x y z qw qx qy qz\) or 16 numbers/;
  for (const given of [quaternion, quaternion.toArray(), euler, euler.toArray(), {}, { position: new Vector3(), rotation: euler }, "0 0 0", 3, new Map()])
    for (const ask of [(pose) => chasles.poseAt(pose, far, 0), (pose) => chasles.scene().add("a", cube, { pose }), (pose) => chasles.firstContactOnPath(cube, cube, [far, pose])]) {
      assert.match(refusal(() => ask(given)), wayOut);
      assert.doesNotMatch(refusal(() => ask(given)), /Vector3/);
    }
  for (const given of [euler, euler.toArray()]) assert.match(refusal(() => chasles.poseAt(given, far, 0)), /^start: an Euler is no pose: .*quaternion\.setFromEuler\(euler\)/);
  assert.match(refusal(() => chasles.poseAt(new Vector3(), far, 0)), /^start: .*: a Vector3 is given as v\.toArray\(\)$/);
  assert.doesNotMatch(refusal(() => chasles.polyhedron([quaternion], faces)), /Vector3/);
  const pose = chasles.poseAt({ position: new Vector3(1, 2, 3), quaternion }, far, 0);
  assert.deepEqual(pose.map((part) => part.toFixed(9)), [1, 2, 3, Math.SQRT1_2, 0, 0, Math.SQRT1_2].map((part) => part.toFixed(9)));
});

test("limits that other libraries have as options are refused with the way out", async () => {
  for (const name of ["seconds", "signal", "timeout", "limit"]) {
    assert.match(refusal(() => chasles.firstContact(cube, cube, far, far, { [name]: 1 })), new RegExp(`^${name}: is no option here \\(.*README, "Limits and cancelling"\\); there are margin`));
    assert.match(refusal(() => dragged({ [name]: 1 })), /update\(goal, seconds\)/);
  }
  const readme = await readFile(new URL(import.meta.resolve("chasles/package.json").replace("package.json", "README.md")), "utf8");
  assert.match(readme, /^## Limits and cancelling$/m);
});

test("messages name options as JavaScript does", () => {
  const asked = { maxTurn: 0, timeTolerance: 2 };
  for (const [name, value] of Object.entries(asked)) {
    const message = refusal(() => chasles.firstContact(cube, cube, far, [0, 0, 0], { [name]: value }));
    assert.match(message, new RegExp(`^\\w+: ${name}: must be`));
  }
  assert.match(refusal(() => chasles.firstContact(cube, cube, far, [0, 0, 0], { maxTurn: 10 })), /^motion: maxTurn: must be at most pi radians/);
  const scene = chasles.scene();
  scene.add("a", cube);
  const moved = (times, motion) => refusal(() => scene.move("a", { poses: [far, far, far], times, motion }));
  for (const motion of ["velocity", "twist", "spline"]) {
    assert.match(moved([0, NaN, 1], motion), /^motion: times: [^:]*time 1 is nan/i);
    assert.match(moved([0, 2, 1], motion), /^motion: times: must ascend, but time 2 is 1 after 2$/);
  }
  assert.equal(refusal(() => chasles.draggedBody(scene, "a").update(far, NaN)), "seconds: NaN is not a number; 0 is no bound");
});

test("objects in a reactive state: Vue leaves them as they are, and a Proxy is refused with the way out", async () => {
  const scene = chasles.scene();
  scene.add("a", cube);
  const workers = await chasles.workers({ count: 1 });
  const objects = { body: chasles.polyhedron(vertices, faces), scene, hand: chasles.draggedBody(scene, "a"), instance: chasles, workers };
  const state = reactive(objects);
  assert.notEqual(state, objects);
  for (const name of ["body", "scene", "hand"]) assert.equal(state[name], objects[name]);
  const proxies = Object.fromEntries(Object.entries(objects).map(([name, object]) => [name, new Proxy(object, {})]));
  for (const { instance, workers: behind } of [state, proxies]) { // their members work behind a Proxy
    assert.equal(instance.firstContact(cube, cube, far, far).verdict, "clear");
    assert.ok(instance.held.polyhedra > 1);
    assert.equal((await behind.firstContactBatch(cube, cube, [far], [far])).length, behind.count);
  }
  const { body, scene: world, hand } = proxies;
  const wayOut = /^[a-z ]+: is a Proxy of a (Polyhedron|Scene|DraggedBody): give the object itself \(Vue: toRaw\), and keep it .* markRaw or shallowRef/;
  const asked = [
    () => chasles.firstContact(body, cube, far, far), () => scene.add("b", body), () => chasles.draggedBody(world, "a"), () => body.free(), () => body[Symbol.dispose](),
    () => world.add("b", cube), () => world.remove("a"), () => world.move("a", { pose: far }), () => world.moveAll([far], [far]), () => world.poseAt("a", 0),
    () => world.ignore("a", "a"), () => world.setMargin("a", "a", 1), () => world.firstContact(), () => world.allContacts(), () => world.clearUntil(), () => hand.update(far), () => hand.force(far),
    ...["report", "vertices", "faces", "triangles", "sourceFaces"].map((name) => () => body[name]), () => world.names,
    ...["name", "pose", "margin", "reach"].map((name) => () => hand[name]),
  ];
  for (const ask of asked) assert.match(refusal(ask), wayOut);
  assert.match(await refusal(workers.firstContactBatch(body, cube, [far], [far])), wayOut);
  workers.stop();
});

test("objects of Babylon.js are refused in one line with the way out", () => {
  const numbers = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1]; // a quarter turn about z, and a shift
  const matrix = { m: numbers, asArray: () => numbers, toString: () => "{0, 1, 0, 0\n-1, 0, 0, 0}" };
  const node = { position: { x: 1, y: 2, z: 3, asArray: () => [1, 2, 3] }, computeWorldMatrix: () => matrix };
  const poseOf = (pose) => chasles.poseAt(pose, pose, 0);
  assert.match(refusal(() => poseOf(matrix)), /^start: .* a Matrix of Babylon\.js is given as \{ elements: matrix\.asArray\(\) \}$/);
  assert.match(refusal(() => poseOf(node)), /^start: .* \{ elements: node\.computeWorldMatrix\(true\)\.asArray\(\) \}$/);
  assert.match(refusal(() => poseOf(node.position)), /^start: .* a Vector3 is given as v\.asArray\(\)$/);
  assert.deepEqual(poseOf({ elements: matrix.asArray() }).map((part) => part.toFixed(9)), [3, 2, 1, Math.SQRT1_2, 0, 0, Math.SQRT1_2].map((part) => part.toFixed(9)));
});

/** Runs a program in a process of its own, in which `before` changes the globals. */
function inProcess(before, program) {
  const { stdout, stderr } = spawnSync(process.execPath, ["--input-type=module", "-e", `${before}\n${program}`], { encoding: "utf8", cwd: import.meta.dirname });
  return stdout.trim() || stderr;
}

test("environments of tests: globals of jsdom and happy-dom are not needed, and what lacks is named", () => {
  const program = `const said = [];
    for (const name of ["chasles", "chasles/inline"])
      said.push(await (await import(name)).load().then(({ held }) => held.polyhedra, ({ name, message }) => name + ": " + message));
    console.log(said.join("|"));`;
  assert.equal(inProcess('globalThis.Blob = class {}; globalThis.Response = class {}; delete globalThis.DecompressionStream;', program), "0|0");
  // Node.js's own Response needs both: it is made before.
  for (const name of ["TextEncoder", "TextDecoder"])
    for (const said of inProcess(`new Response(); delete globalThis.${name};`, program).split("|"))
      assert.match(said, /^InvalidInput: load: there are no TextEncoder and TextDecoder here, as in the environment jsdom of Jest: test in the environment "node"/);
});

test("the content of a file may be an ArrayBuffer of another realm", () => {
  const content = runInNewContext("new ArrayBuffer(3)");
  assert.ok(!(content instanceof ArrayBuffer));
  assert.match(refusal(() => chasles.fromFile(content, "a.obj")), /^a\.obj: /);
});

function dragged(options) {
  const scene = chasles.scene();
  scene.add("a", cube);
  return chasles.draggedBody(scene, "a", options);
}

test("the parts of a pose are named by what they need", async () => {
  const place = { x: 5, y: 0, z: 0 };
  const turn = { x: 0, y: 0, z: 0, w: 1 };
  assert.deepEqual([...chasles.poseAt({ position: place, quaternion: turn }, far, 0)], [5, 0, 0, 1, 0, 0, 0]);
  const whatItIs = ": a pose is a place with a turn: { position: { x, y, z }, quaternion: { x, y, z, w } }, an Object3D, a Matrix4, or 3, 7 (x y z qw qx qy qz) or 16 numbers";
  const asked = {
    "position.x: undefined is not a number": { position: [5, 0, 0], quaternion: [0, 0, 0, 1] },
    "quaternion.w: undefined is not a number": { position: place, quaternion: [0, 0, 0, 1] },
    "position.z: undefined is not a number": { position: { x: 5, y: 0 }, quaternion: turn },
    'quaternion.y: "0" is not a number': { position: place, quaternion: { ...turn, y: "0" } },
    "scale.x: undefined is not a number": { position: place, quaternion: turn, scale: [1, 1, 1] },
    "[object Object] is no array of numbers": { position: place },
  };
  const workers = await chasles.workers({ count: 1 });
  for (const [what, pose] of Object.entries(asked)) {
    assert.equal(refusal(() => chasles.firstContact(cube, cube, pose, far)), `start: ${what}${whatItIs}`);
    assert.equal(refusal(() => chasles.firstContactOnPath(cube, cube, [far, pose])), `poses[1]: ${what}${whatItIs}`);
    assert.equal(refusal(() => chasles.scene().add("a", cube, { pose })), `pose: ${what}${whatItIs}`);
    assert.equal(await refusal(workers.firstContactBatch(cube, cube, [far], [pose])), `motion 0: goal: ${what}${whatItIs}`);
  }
  workers.stop();
  const scaled = { position: place, quaternion: turn, scale: { x: 1, y: 2, z: 1 } };
  assert.equal(refusal(() => chasles.firstContact(cube, cube, scaled, far)), "start: the object is scaled by 1 2 1, which no pose is");
});

test("options are objects with known keys, also those of load", async () => {
  for (const start of [load, loadInline]) {
    assert.match(await refusal(start({ wsm: "x" })), /^wsm: is no option here; there are wasm$/);
    for (const options of [null, "chasles.wasm", new URL("file:///chasles.wasm"), new Uint8Array(8), []])
      assert.match(await refusal(start(options)), /^options: must be an object with wasm$/);
    assert.match(await refusal(start({ wasm: 3 })), /^wasm: 3 is no URL, Response, bytes or WebAssembly\.Module: (give|leave wasm out)/);
  }
  assert.match(refusal(() => chasles.firstContact(cube, cube, far, far, new Map([["margin", 1]]))), /^options: must be an object with margin/);
  assert.match(await refusal(chasles.workers({ worker: "worker.js" })), /^worker: must be a function that makes a Worker/);
  assert.match(await refusal(chasles.workers({ count: 1, worker: () => ({}) })), /^worker: must make a Worker/);
});

test("objects of the package are made by it, not by new", async () => {
  const { Chasles, DraggedBody, Polyhedron, Scene } = await import("chasles");
  const scene = chasles.scene();
  const made = [
    [() => new Polyhedron(vertices, faces), /^Polyhedron: is made by chasles\.polyhedron\(vertices, faces\), .*, not by new Polyhedron\(\)$/],
    [() => new Polyhedron(), /^Polyhedron: is made by /],
    [() => new Scene(chasles), /^Scene: is made by chasles\.scene\(\), not by/],
    [() => new DraggedBody(scene, "cube"), /^DraggedBody: is made by chasles\.draggedBody\(scene, name\), not by/],
    [() => new Chasles(), /^Chasles: is made by load\(\), not by/],
  ];
  for (const [make, message] of made) assert.match(await refusal(make), message);
});

test("a question that lists everything takes no find: any", async () => {
  const scene = chasles.scene();
  scene.add("cube", cube);
  for (const question of ["allContacts", "clearUntil"])
    assert.match(await refusal(() => scene[question]({ find: "any" })), /^query: find: any asks whether anything touches, .*: leave it out, or ask for the first contact$/);
  assert.equal(scene.firstContact({ find: "any" }).verdict, "clear");
  assert.match(await refusal(() => chasles.firstContact(cube, cube, [5n, 0, 0], far)), /^start\[0\]: 5n is not a number$/);
});

test("the module may be a URL, a module or a response of another realm", async () => {
  const address = import.meta.resolve("chasles/chasles.wasm");
  const bytes = await readFile(fileURLToPath(address));
  const module = new (runInNewContext("WebAssembly").Module)(bytes);
  assert.ok(!(module instanceof WebAssembly.Module));
  const url = { [Symbol.toStringTag]: "URL", toString: () => address };
  const response = { [Symbol.toStringTag]: "Response", ok: true, headers: new Map([["Content-Type", "application/octet-stream"]]), arrayBuffer: async () => bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length) };
  for (const wasm of [module, url, response]) {
    const other = await load({ wasm });
    assert.equal(other.polyhedron(vertices, faces).report.closed, true);
  }
});

test("a way to the module that does not lead there is refused with a way out", async () => {
  const path = fileURLToPath(import.meta.resolve("chasles/chasles.wasm"));
  const wayOut = /: give the bytes of chasles\.wasm, or pathToFileURL\(path\) of node:url, or, in Next\.js, .*, or import "chasles\/inline", which needs no file$/;
  for (const wasm of [path, "./chasles.wasm", "chasles.wasm", "C:\\chasles.wasm"]) {
    const message = await refusal(load({ wasm }));
    assert.ok(message.startsWith(`wasm: "${wasm}" is no URL`), message);
    assert.match(message, wayOut);
  }
  assert.match(await refusal(load({ wasm: new URL("nowhere.wasm", import.meta.url) })), /^wasm: file:.*nowhere\.wasm cannot be read \(ENOENT/);
  assert.match(await refusal(load({ wasm: new URL(import.meta.url) })), /^wasm: file:.* is no WebAssembly module/);
  assert.match(await refusal(load({ wasm: new Uint8Array(8) })), /^wasm: the bytes are no WebAssembly module/);
  const empty = Uint8Array.from([0, 97, 115, 109, 1, 0, 0, 0]);
  assert.match(await refusal(load({ wasm: empty })), /^wasm: is another module than chasles\.wasm/);
  assert.ok(await load({ wasm: import.meta.resolve("chasles/chasles.wasm") }), "an address as text");
  const whole = await readFile(path);
  for (const start of [load, loadInline])
    for (const size of [4, 5000, whole.length - 1]) {
      const message = await refusal(start({ wasm: whole.subarray(0, size) }));
      assert.match(message, /^wasm: is damaged or cut off, or needs a newer engine \(/);
      assert.match(message, start === load ? wayOut : /: leave wasm out: load\(\) of this build has the module in its script, and needs no file$/);
    }
  const response = new Response(whole);
  await response.arrayBuffer();
  assert.match(await refusal(load({ wasm: response })), /^wasm: the response has been read already: /);
  const watched = new Response(whole);
  watched.body.getReader();
  assert.match(await refusal(load({ wasm: watched })), /^wasm: the response has been read already: /);
});

test("bundles for Node.js: what does not find its files says so, and the inlined build needs none", () => {
  const questions = {
    plain: 'import { load } from "chasles"; const instance = load();',
    bytes: 'import { load } from "chasles"; import { readFileSync } from "node:fs"; const instance = load({ wasm: readFileSync(process.argv[2]) });',
    inline: 'import { load } from "chasles/inline"; const instance = load();',
  };
  const end = "instance.then((it) => it.workers({ count: 1 })).then((workers) => (workers.stop(), workers.count)).catch(({ message }) => message).then(console.log);";
  const said = {};
  for (const [name, question] of Object.entries(questions))
    for (const [format, extension] of [["cjs", "cjs"], ["esm", "mjs"]]) {
      const outfile = fileURLToPath(new URL(`./bundles_for_node/${name}.${extension}`, import.meta.url));
      buildSync({ stdin: { contents: question + end, resolveDir: import.meta.dirname }, bundle: true, platform: "node", format, outfile, logLevel: "error" });
      const { stdout, stderr } = spawnSync(process.execPath, [outfile, fileURLToPath(import.meta.resolve("chasles/chasles.wasm"))], { encoding: "utf8" });
      said[`${name} ${format}`] = stdout.trim() || stderr;
    }
  assert.match(said["plain cjs"], /^wasm: this bundle does not know its own address, .* or import "chasles\/inline", which needs no file$/);
  assert.match(said["plain esm"], /^wasm: file:.*chasles\.wasm cannot be read \(ENOENT.* or import "chasles\/inline", which needs no file$/);
  for (const format of ["cjs", "esm"]) {
    assert.match(said[`bytes ${format}`], /^chasles: a worker cannot be started: its script was not found, or is not read as a module \(.*\); import "chasles\/inline"/);
    assert.equal(said[`inline ${format}`], "1");
  }
});

test("require() where Node.js loads modules so", { skip: process.features.require_module ? false : "skipped: this Node.js does not" }, () => {
  const program = 'const { load } = require("chasles"); load().then(({ held }) => console.log(held.polyhedra));';
  const { stdout, stderr } = spawnSync(process.execPath, ["--input-type=commonjs", "-e", program], { encoding: "utf8", cwd: import.meta.dirname });
  assert.equal(stdout, "0\n", stderr);
});

test("what a server answers: a web page, an error, the module without its type", async () => {
  const bytes = await readFile(new URL(import.meta.resolve("chasles/chasles.wasm")));
  const server = createServer((request, response) => {
    const answers = { "/page": [200, "text/html", "<!doctype html>"], "/gone": [404, "text/plain", ""], "/plain": [200, "text/plain", "abc"], "/bytes": [200, "application/octet-stream", bytes] };
    const [status, type, body] = answers[request.url];
    response.writeHead(status, { "Content-Type": type }).end(body);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const address = `http://127.0.0.1:${server.address().port}`;
  try {
    assert.match(await refusal(load({ wasm: `${address}/page` })), /^wasm: http:.*\/page is a web page, as servers answer for files that they do not find: /);
    assert.match(await refusal(load({ wasm: new URL(`${address}/gone`) })), /^wasm: http:.*\/gone answers with status 404: /);
    assert.match(await refusal(load({ wasm: fetch(`${address}/plain`) })), /^wasm: http:.*\/plain is no WebAssembly module: /);
    assert.ok(await load({ wasm: `${address}/bytes` }));
  } finally {
    server.close();
  }
  assert.match(await refusal(load({ wasm: `${address}/page` })), /^wasm: http:.*\/page cannot be fetched \(/);
});
