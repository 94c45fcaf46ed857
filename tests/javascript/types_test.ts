// Compiled, not run: the types accept what the README shows, and refuse what is wrong.
import { load, InvalidInput, Polyhedron, type FirstContact } from "chasles";
import wasmAddress from "chasles/chasles.wasm";
import { load as loadInline } from "chasles/inline";
import wasm from "chasles/chasles.wasm";
import { load as loadByPath } from "./node_modules/chasles/inline.js"; // as moduleResolution "node" finds it
import { BoxGeometry, InstancedMesh, Matrix4, Mesh, Object3D, SkinnedMesh } from "three";

const chasles = await load();
await load({ wasm });
const other = await (loadByPath satisfies typeof loadInline)({ wasm: new Uint8Array(8) });
const cube: Polyhedron = chasles.polyhedron(new Float64Array(24), new Uint32Array(36), { triangulate: true });
const box = chasles.fromBufferGeometry(new BoxGeometry(1, 1, 1));
const { attributes, index } = new BoxGeometry(1, 1, 1);
chasles.polyhedron(attributes.position.array, index!.array);
chasles.polyhedron(new Int8Array(9), new Float64Array(3));
// @ts-expect-error: no numbers
chasles.polyhedron(new BigInt64Array(9), [0, 1, 2]);
// @ts-expect-error: no array of numbers
chasles.polyhedron(new DataView(new ArrayBuffer(9)), [0, 1, 2]);
const nested = other.polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]);
const found: FirstContact = chasles.firstContact(cube, box, new Object3D(), new Matrix4(), { margin: 0.1, motion: "twist" });
if (found.verdict !== "clear") console.log(found.time, found.contacts[0]?.normal[0], found.tau?.toFixed());
// @ts-expect-error: an answer without contact has no time
console.log(found.time);
// @ts-expect-error: there is no such motion
chasles.firstContact(cube, box, [0, 0, 0], [1, 0, 0], { motion: "spiral" });
// @ts-expect-error: bodies come from an instance
new Polyhedron();
const segment: number = chasles.firstContactOnPath(cube, nested, [[0, 0, 0], new Float64Array(7)], { hold: 0 }).segment;
const clear: boolean = chasles.isClear(cube, box, [0, 0, 0], [1, 0, 0], { fixedStart: [0, 0, 0], fixedGoal: [1, 1, 1] });
const scene = chasles.scene();
scene.add("cube", cube, { pose: [0, 0, 0], goal: [1, 0, 0], motion: "velocity", group: "moving" });
const first = scene.firstContact({ until: 0.5 });
if (first.verdict === "contact") console.log(first.pair[0], first.time_upper);
const hand = chasles.draggedBody(scene, "cube", { rounds: 4 });
const force: number = hand.update([0, 0, 0], 1 / 60).contacts[0]?.force ?? 0;
const locked = chasles.draggedBody(scene, "cube", {
  friction: 0.3, lock: { kind: "hinge", direction: [0, 0, 1], point: new Float64Array(3) }, mass: { inertia: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] },
});
const across: number = locked.update([0, 0, 0]).contacts[0]?.friction[2] ?? locked.force([0, 0, 1])[5];
// @ts-expect-error: there is no such lock
chasles.draggedBody(scene, "cube", { lock: { kind: "screw" } });
for (const mesh of [new Mesh(new BoxGeometry()), new SkinnedMesh()]) console.log(chasles.fromObject3D(mesh, { triangulate: undefined }).pose);
// @ts-expect-error: many bodies
chasles.fromObject3D(new InstancedMesh(new BoxGeometry(), [], 3));
// @ts-expect-error: from where?
scene.move("cube", { goal: [0, 0, 0] });
// @ts-expect-error: when?
scene.add("track", cube, { poses: [[0, 0, 0], [1, 0, 0]] });
// @ts-expect-error: through which poses?
scene.add("spline", cube, { pose: [0, 0, 0], motion: "spline" });
// @ts-expect-error: a B-spline has no times
scene.add("near", cube, { poses: [[0, 0, 0], [1, 0, 0]], motion: "b_spline", times: [0, 1] });
scene.add("b_spline", cube, { poses: [[0, 0, 0], [1, 0, 0]], motion: "b_spline" });
// @ts-expect-error: one or the other
scene.add("both", cube, { pose: [0, 0, 0], poses: [[0, 0, 0], [1, 0, 0]], times: [0, 1] });
// @ts-expect-error: arrays of a body are not written to
cube.faces[0]?.push(1);
const turned = chasles.polyhedron(cube.vertices, cube.faces.map((face) => [...face].reverse()), { solid: "yes" });
console.log(turned.report.inward_parts, scene.names.length);
for (const wasm of [wasmAddress, fetch(wasmAddress), new URL(wasmAddress)]) await load({ wasm });
// All options may be undefined, also under exactOptionalPropertyTypes.
type Undefined<T> = { [Key in keyof Required<T>]: undefined };
const accepts = <T>(_: Undefined<T> extends T ? true : false) => undefined;
accepts<NonNullable<Parameters<typeof chasles.firstContact>[4]>>(true);
accepts<NonNullable<Parameters<typeof chasles.leastDistance>[4]>>(true);
accepts<NonNullable<Parameters<typeof chasles.workers>[0]>>(true);
accepts<NonNullable<Parameters<typeof chasles.draggedBody>[2]>>(true);
accepts<NonNullable<Parameters<typeof scene.add>[2]>>(true);
accepts<NonNullable<Parameters<typeof scene.firstContact>[0]>>(true);
accepts<NonNullable<Parameters<typeof load>[0]>>(true);
scene.move("cube", { motion: "spline", poses: [[0, 0, 0], [1, 0, 0]], times: [0, 1] });
scene.moveAll([[0, 0, 0]], [[1, 0, 0]], { motion: "twist" });
const middle: number = scene.poseAt("cube", 0.5)[0] + chasles.poseAt([0, 0, 0], [1, 0, 0], 0.5, { motion: "sweep" })[6];
const workers = await chasles.workers({ count: 2 });
const answers: FirstContact[] = await workers.firstContactBatch(cube, box, [[0, 0, 0]], [[1, 0, 0]]);
cube[Symbol.dispose]();
console.log(segment, clear, force, across, middle, answers, new InvalidInput("x").message);
