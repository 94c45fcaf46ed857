// Bodies inside of each other: what answers say of them, and what is solid.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "chasles";
import {
  BoxGeometry, CapsuleGeometry, ConeGeometry, CylinderGeometry, IcosahedronGeometry, Mesh, SphereGeometry, TorusGeometry, TorusKnotGeometry,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const cube = chasles.polyhedron(box().vertices, box().faces);
const speck = chasles.polyhedron(box(0.1).vertices, box().faces);
const hollow = chasles.polyhedron(box().vertices, box().faces, { solid: "no" });
const start = [0.5, 0, 0], goal = [5, 0, 0];

test("a body inside of another one touches it at the start", () => {
  const found = chasles.firstContact(speck, cube, start, goal);
  assert.equal(found.verdict, "contact_at_start");
  assert.deepEqual([found.certain, found.contacts, found.overlap, found.clear_until], [true, [], undefined, 0]);
  assert.equal(found.inside, "moving");
  found.inside_point.forEach((x, i) => assert.ok(Math.abs(x - start[i] - speck.vertices[3 * found.inside_vertex + i]) < 1e-12));
  assert.equal(chasles.firstContact(cube, speck, [-0.5, 0, 0], goal).inside, "fixed");
  assert.equal(chasles.isClear(speck, cube, start, start), false);
  const least = chasles.leastDistance(speck, cube, start, goal);
  assert.deepEqual([least.distance_upper, least.inside], [0, "moving"]);
  assert.equal(chasles.firstContactOnPath(speck, cube, [start, goal]).inside, "moving");
});

test("scenes and hands name it", () => {
  const scene = chasles.scene();
  scene.add("cube", cube);
  scene.add("speck", speck, { pose: start, goal });
  const found = scene.firstContact();
  assert.deepEqual([found.verdict, found.inside, found.pair], ["contact_at_start", "moving", ["speck", "cube"]]);
  assert.equal(scene.allContacts().events[0].inside, "moving");
  scene.move("speck", { pose: start });
  const step = chasles.draggedBody(scene, "speck").update(goal);
  assert.deepEqual([step.state, step.touching], ["touching", ["cube"]]);
});

test("solid says what the inside is", async () => {
  assert.equal(chasles.firstContact(speck, hollow, start, start).verdict, "clear");
  const { solid_parts, surface_parts, unpaired_edges, volume } = cube.report;
  assert.deepEqual([solid_parts, surface_parts, unpaired_edges, volume], [1, 1, 0, 8]);
  assert.equal(hollow.report.solid_parts, 0);
  assert.match(refusal(() => chasles.polyhedron(box().vertices, box().faces.slice(1), { solid: "yes" })), /^mesh: solid: the surface is not closed/);
  assert.match(refusal(() => chasles.polyhedron(box().vertices, box().faces, { solid: true })), /^solid: must be "automatic", "yes" or "no"/);
  const workers = await chasles.workers({ count: 1 });
  const answers = async (fixed) => (await workers.firstContactBatch(speck, fixed, [start], [start])).map((answer) => answer.verdict);
  assert.deepEqual([await answers(cube), await answers(hollow)], [["contact_at_start"], ["clear"]]);
  workers.stop();
});

test("surfaces that are turned inwards are counted as such, and enclose nothing", () => {
  const mirrored = new BoxGeometry(2, 2, 2).scale(-1, 1, 1);
  const room = chasles.fromBufferGeometry(mirrored);
  assert.deepEqual([room.report.surface_parts, room.report.solid_parts, room.report.inward_parts, room.report.volume, room.report.closed], [1, 0, 1, -8, true]);
  assert.equal(chasles.firstContact(speck, room, start, start).verdict, "clear");
  const half = new BoxGeometry(1, 1, 1).translate(2, 0, 0);
  const both = chasles.fromBufferGeometry(mergeGeometries([half, half.clone().scale(-1, 1, 1)])).report;
  assert.deepEqual([both.surface_parts, both.solid_parts, both.inward_parts], [2, 1, 1]);
  // An object that mirrors is told, and turned; a geometry whose vertices are mirrored is not.
  const mesh = new Mesh(new BoxGeometry(2, 2, 2));
  mesh.scale.x = -1;
  assert.deepEqual([chasles.fromObject3D(mesh).body.report.solid_parts, chasles.fromObject3D(mesh).body.report.inward_parts], [1, 0]);
  assert.equal(chasles.fromObject3D(new Mesh(mirrored)).body.report.inward_parts, 1);
  // The walls of a room move back.
  assert.deepEqual(chasles.fromBufferGeometry(mirrored, { radius: -0.1 }).report.upper.map((x) => x.toFixed(9)), ["1.100000000", "1.100000000", "1.100000000"]);
});

test("triangles of a left-handed frame are turned as the README says", () => {
  const { index, attributes } = new BoxGeometry(2, 2, 2).scale(-1, 1, 1); // as the builders of Babylon.js wind them
  const indices = index.array.slice();
  for (let i = 0; i < indices.length; i += 3) [indices[i + 1], indices[i + 2]] = [indices[i + 2], indices[i + 1]];
  const body = chasles.polyhedron(attributes.position.array, indices, { solid: "yes" });
  assert.deepEqual([body.report.solid_parts, body.report.inward_parts, body.report.volume], [1, 0, 8]);
  assert.equal(chasles.firstContact(speck, body, start, start).inside, "moving");
});

test("closed geometries of three.js are solid, seams that differ by rounding included", () => {
  const closed = [
    new BoxGeometry(), new SphereGeometry(), new SphereGeometry(2.5, 17, 9), new CylinderGeometry(), new ConeGeometry(), new TorusGeometry(), new TorusKnotGeometry(),
    new CapsuleGeometry(), new IcosahedronGeometry(1, 3),
  ];
  for (const geometry of closed) {
    const { solid_parts, surface_parts, unpaired_edges, volume } = chasles.fromBufferGeometry(geometry).report;
    assert.deepEqual([solid_parts, surface_parts, unpaired_edges], [1, 1, 0], geometry.type);
    assert.ok(volume > 0, geometry.type);
  }
  const ball = chasles.fromBufferGeometry(new SphereGeometry(3));
  assert.equal(chasles.firstContact(speck, ball, start, goal).inside, "moving");
});
