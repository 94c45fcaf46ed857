// Objects of three.js as poses and as bodies: taken as three.js draws them, or refused by name.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "chasles";
import {
  Bone, BoxGeometry, BufferAttribute, BufferGeometry, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, InstancedMesh, InterleavedBuffer, InterleavedBufferAttribute,
  LineSegments, Matrix4, Mesh, MeshBasicMaterial, Object3D, PlaneGeometry, Points, Quaternion, Raycaster, Skeleton, SkinnedMesh, TetrahedronGeometry, Vector3,
  WireframeGeometry,
} from "three";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { box, randomNumbers, refusal } from "./shapes.mjs";

const chasles = await load();
const cube = chasles.polyhedron(box().vertices, box().faces); // from -1 to 1
const random = randomNumbers(41);
const spread = (size) => size * (2 * random() - 1);
const randomTurn = () => new Quaternion(spread(1), spread(1), spread(1), spread(1)).normalize();

/** A mesh below two parents, placed by chance; `deform` has the last word on the scales. */
function randomMesh(deform = () => undefined) {
  const chain = [new Group(), new Group(), new Mesh(new BoxGeometry(1, 2, 3))];
  chain.forEach((object, i) => {
    object.position.set(spread(3), spread(3), spread(3));
    object.quaternion.copy(randomTurn());
    if (i > 0) chain[i - 1].add(object);
  });
  deform(chain);
  return chain[2];
}

/** The corners of a mesh in the world, by three.js alone. */
function drawnCorners(mesh) {
  const { position } = mesh.geometry.attributes;
  mesh.updateWorldMatrix(true, false);
  return Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld).toArray());
}

/** The vertices of a body at a pose of seven numbers. */
function placed(body, [x, y, z, w, a, b, c]) {
  const turn = new Quaternion(a, b, c, w);
  return Array.from({ length: body.vertices.length / 3 }, (_, i) =>
    new Vector3(...body.vertices.slice(3 * i, 3 * i + 3)).applyQuaternion(turn).add(new Vector3(x, y, z)).toArray());
}

function assertNear(points, expected, most = 1e-12) {
  assert.equal(points.length, expected.length);
  points.forEach((point, i) => assert.ok(Math.hypot(...point.map((x, k) => x - expected[i][k])) <= most, `${i}: ${point} ${expected[i]}`));
}

const poseOf = (value) => chasles.poseAt(value, value, 0);

test("an Object3D that does not update itself goes with its parents, and stays where it is told to", () => {
  const [cart, rack, crate] = [new Group(), new Group(), new Mesh(new BoxGeometry(1, 1, 1))];
  cart.add(rack.add(crate));
  crate.position.y = 1;
  for (const still of [rack, crate]) {
    still.updateMatrix();
    still.matrixAutoUpdate = false;
    cart.updateMatrixWorld();
    cart.position.x += 5;
    assert.deepEqual(poseOf(crate).slice(0, 3), [cart.position.x, 1, 0]);
    cart.updateMatrixWorld(true); // as the renderer does
    assert.deepEqual(crate.matrixWorld.elements.slice(12, 15), [cart.position.x, 1, 0]);
  }
  crate.matrixWorldAutoUpdate = false;
  crate.matrixWorld.setPosition(0, 0, 7);
  assert.deepEqual(poseOf(crate).slice(0, 3), [0, 0, 7]);
});

test("an Object3D is where it is in the world, with its parents as they are now", () => {
  for (let i = 0; i < 100; ++i) {
    const mesh = randomMesh();
    const corners = drawnCorners(mesh); // of vertices that are single precision, and exact here
    const plain = chasles.fromBufferGeometry(mesh.geometry);
    mesh.parent.parent.position.x += 1; // nobody has updated a matrix
    assertNear(placed(plain, poseOf(mesh)), corners.map(([x, ...rest]) => [x + 1, ...rest]));
    const scene = chasles.scene();
    scene.add("mesh", plain, { pose: mesh });
    assert.deepEqual(scene.poseAt("mesh", 0), poseOf(mesh));
  }
});

test("matrices: the elements of a Matrix4 are columns, 16 numbers are rows, and columns are refused where they show", () => {
  for (let i = 0; i < 50; ++i) {
    const matrix = new Matrix4().compose(new Vector3(spread(3), spread(3), spread(3)), randomTurn(), new Vector3(1, 1, 1));
    const expected = new Vector3(1, 2, 3).applyMatrix4(matrix).toArray();
    const body = chasles.polyhedron([[1, 2, 3], [0, 0, 0], [1, 0, 0]], [[0, 1, 2]]);
    for (const pose of [matrix, { elements: new Float64Array(matrix.elements) }, matrix.clone().transpose().toArray()])
      assertNear([placed(body, poseOf(pose))[0]], [expected], 1e-9);
    for (const columns of [matrix.elements, new Float64Array(matrix.elements)])
      assert.match(refusal(() => poseOf(columns)), /^start: 16 numbers column by column; .* give the Matrix4 itself, or \{ elements: numbers \}$/);
    assertNear([placed(body, poseOf({ elements: matrix.toArray() }))[0]], [expected], 1e-9);
  }
  assert.match(refusal(() => poseOf(new Matrix4().makeScale(2, 2, 2))), /^start: pose: matrix: /);
  assert.match(refusal(() => poseOf(new Matrix4().makeScale(-1, 1, 1))), /^start: pose: matrix: .*reflection/);
});

test("an object with more than a pose is refused by name, wherever a pose is taken", async () => {
  const scaled = randomMesh(([, , mesh]) => mesh.scale.set(3, 3, 3));
  const inherited = randomMesh(([top]) => top.scale.set(1, 1, 1.5));
  const mirrored = randomMesh(([, , mesh]) => mesh.scale.set(-1, 1, 1));
  const moved = new Mesh(new BoxGeometry(2, 2, 2));
  const scene = chasles.scene();
  scene.add("a", cube);
  const hand = chasles.draggedBody(scene, "a");
  const workers = await chasles.workers({ count: 1 });
  for (const [object, what] of [[scaled, "scaled by 3 3 3"], [inherited, "scaled by"], [mirrored, "mirrored"]]) {
    const expected = new RegExp(`the object is ${what}.* fromObject3D`);
    for (const asked of [
      () => chasles.firstContact(cube, cube, object, moved),
      () => chasles.firstContact(cube, cube, moved, moved, { fixedStart: moved, fixedGoal: object }),
      () => chasles.firstContactOnPath(cube, cube, [moved, object]),
      () => chasles.leastDistance(cube, cube, moved, object),
      () => chasles.firstContactBatch(cube, cube, [object], [moved]),
      () => scene.add("b", cube, { pose: object }),
      () => scene.move("a", { poses: [moved, object], times: [0, 1] }),
      () => scene.moveAll([moved], [object]),
      () => hand.update(object),
      () => hand.force(object),
    ])
      assert.match(refusal(asked), expected);
    assert.match(await refusal(workers.firstContactBatch(cube, cube, [moved], [object])), expected);
  }
  workers.stop();
  const sheared = randomMesh(([top, middle]) => (top.scale.set(1, 2, 3), middle.scale.set(1, 1 / 2, 1 / 3)));
  assert.match(refusal(() => poseOf(sheared)), /the object is (sheared|scaled)/);
  assert.match(refusal(() => poseOf({ ...new Object3D(), matrixWorld: undefined, scale: { x: 2, y: 1, z: 1 }, position: far, quaternion: still })), /scaled by 2 1 1/);
});
const far = { x: 5, y: 0, z: 0 };
const still = { x: 0, y: 0, z: 0, w: 1 };

test("fromObject3D: body and pose give the corners that three.js draws, with every scale, mirroring and shear", () => {
  let mirrored = 0;
  for (let i = 0; i < 200; ++i) {
    const mesh = randomMesh((chain) => chain.forEach(({ scale }) => random() < 0.5 && scale.set(spread(3), spread(3), spread(3))));
    const { body, pose } = chasles.fromObject3D(mesh);
    const corners = drawnCorners(mesh);
    assertNear(placed(body, pose), corners, 1e-10);
    assert.ok(body.report.closed);
    // Outlines stay outward: the volume of a closed surface is positive.
    const v = body.vertices;
    const at = (k) => new Vector3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
    const volume = body.faces.reduce((sum, [a, b, c]) => sum + at(a).dot(at(b).cross(at(c))) / 6, 0);
    const determinant = mesh.matrixWorld.determinant();
    assert.ok(Math.abs(volume / (6 * Math.abs(determinant)) - 1) < 1e-6, `${volume} ${determinant}`);
    mirrored += determinant < 0 ? 1 : 0;
  }
  assert.ok(mirrored > 20 && mirrored < 180);
});

test("fromObject3D: the pose follows the object, and its scale must stay", () => {
  const mesh = randomMesh(([top, , inner]) => (top.scale.set(1, 1, -2), inner.scale.set(3, 1, 0.5)));
  const part = chasles.fromObject3D(mesh);
  for (let i = 0; i < 20; ++i) {
    mesh.parent.parent.position.set(spread(5), spread(5), spread(5));
    mesh.parent.parent.quaternion.copy(randomTurn());
    assertNear(placed(part.body, part.pose), drawnCorners(mesh), 1e-9);
  }
  mesh.scale.x = 3.001;
  assert.match(refusal(() => part.pose), /^object: its scale, shear or mirroring has changed/);
  mesh.scale.x = 0;
  assert.match(refusal(() => chasles.fromObject3D(mesh)), /^object: its matrix in the world has no inverse/);
});

test("cubes of scale 3 meet", () => {
  const [left, right] = [-4, 4].map((x) => {
    const mesh = new Mesh(new BoxGeometry(1, 1, 1));
    mesh.scale.set(3, 3, 3);
    mesh.position.x = x;
    return mesh;
  });
  const [moving, fixed] = [left, right].map((mesh) => chasles.fromObject3D(mesh));
  const start = moving.pose;
  left.position.x = 2;
  const found = chasles.firstContact(moving.body, fixed.body, start, moving.pose, { fixedStart: right.position.toArray(), fixedGoal: fixed.pose });
  assert.ok(Math.abs(found.time - 5 / 6) < 1e-9, "the gap of 5 closes on a way of 6");
});

/** Two triangles and two more, far away. */
function fourTriangles() {
  const places = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [50, 0, 0], [51, 0, 0], [50, 1, 0], [51, 1, 0]];
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(places.flat(), 3));
  return geometry.setIndex([0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6]);
}

test("draw range, groups and materials: what is drawn is the body", () => {
  const faces = (body) => body.faces;
  const geometry = fourTriangles();
  geometry.setDrawRange(3, 6);
  const expected = [[1, 3, 2], [4, 5, 6]];
  assert.deepEqual(faces(chasles.fromBufferGeometry(geometry)), expected);
  assert.deepEqual(faces(chasles.fromObject3D(new Mesh(geometry)).body), expected);
  const loose = geometry.toNonIndexed();
  loose.setDrawRange(0, 6);
  assert.equal(faces(chasles.fromBufferGeometry(loose)).length, 2);
  geometry.setDrawRange(3, 5);
  assert.deepEqual(faces(chasles.fromBufferGeometry(geometry)), [[1, 3, 2]], "two corners are no triangle");
  geometry.setDrawRange(6, Infinity);
  geometry.addGroup(0, 6, 0);
  geometry.addGroup(9, 3, 5);
  assert.match(refusal(() => chasles.fromBufferGeometry(geometry)), /^geometry\.groups: leave out triangle 2.* fromObject3D/);
  assert.deepEqual(faces(chasles.fromObject3D(new Mesh(geometry)).body), [[4, 5, 6], [5, 7, 6]], "one material draws all");
  const list = [0, 1, 2, 3, 4, 5].map(() => new MeshBasicMaterial());
  assert.deepEqual(faces(chasles.fromObject3D(new Mesh(geometry, list)).body), [[5, 7, 6]]);
  geometry.addGroup(6, 3, 9); // no material draws it
  assert.deepEqual(faces(chasles.fromObject3D(new Mesh(geometry, list)).body), [[5, 7, 6]]);
  assert.equal(faces(chasles.fromBufferGeometry(geometry)).length, 2, "now the groups leave out nothing");
  assert.equal(faces(chasles.fromBufferGeometry(new BoxGeometry(1, 1, 1))).length, 12, "six groups");
});

/** The first corners of the triangles that WebGLRenderer.renderBufferDirect draws for a group, and WebGL of these corners. */
function drawnByThree({ index, attributes, drawRange }, group) {
  const drawStart = Math.max(drawRange.start, group.start, 0);
  const drawEnd = Math.min(drawRange.start + drawRange.count, group.start + group.count, (index ?? attributes.position).count);
  return Array.from({ length: Math.max(0, Math.floor((drawEnd - drawStart) / 3)) }, (_, i) => drawStart + 3 * i);
}

test("groups and draw ranges begin at any corner, and end within a triangle: what is drawn is the body", () => {
  const geometry = new BoxGeometry(1, 2, 3);
  const place = (vertex) => [...geometry.attributes.position.array.slice(3 * vertex, 3 * vertex + 3)].join(" ");
  const withArea = (faces) => faces.map(([id, face]) => [id, face.map(place).sort()]).filter(([, [a, b, c]]) => a !== b && b !== c); // of a box
  let unaligned = 0;
  for (let i = 0; i < 300; ++i) {
    const cuts = Array.from({ length: 4 }, () => Math.floor(37 * random())).sort((a, b) => a - b);
    geometry.clearGroups();
    for (const k of [0, 2]) geometry.addGroup(cuts[k], cuts[k + 1] - cuts[k], 0);
    geometry.setDrawRange(Math.floor(6 * random()), random() < 0.5 ? Infinity : 10 + Math.floor(20 * random()));
    for (const list of [[new MeshBasicMaterial()], undefined]) {
      const drawn = (list ? geometry.groups : [{ start: 0, count: Infinity }]).flatMap((group) => drawnByThree(geometry, group));
      const expected = withArea(drawn.map((k) => [Math.floor(k / 3), [0, 1, 2].map((j) => geometry.index.getX(k + j))]));
      if (expected.length === 0) continue;
      const { faces, sourceFaces } = chasles.fromObject3D(new Mesh(geometry, list)).body;
      assert.deepEqual(withArea(faces.map((face, k) => [sourceFaces[k], face])), expected);
      unaligned += list && drawn.some((k) => k % 3 !== 0) ? 1 : 0;
    }
  }
  assert.ok(unaligned > 100);
  geometry.setDrawRange(0, Infinity);
  geometry.groups = [{ start: 4, count: 6, materialIndex: 0 }];
  assert.match(refusal(() => chasles.fromBufferGeometry(geometry)), /^geometry\.groups: leave out triangle 0.* fromObject3D/);
  geometry.addGroup(0, 6, 0);
  assert.match(refusal(() => chasles.fromObject3D(new Mesh(geometry, [new MeshBasicMaterial()]))), /^geometry\.groups: .* one faceIndex \(1\): .* multiples of 3$/);
});

/** The first contact of a small body that falls on a mesh at a place, and what three.js says about this place. */
function faceBelow(mesh, body, x, y) {
  const pin = chasles.fromBufferGeometry(new TetrahedronGeometry(0.05));
  const { contacts } = chasles.firstContact(pin, body, [x, y, 2], [x, y, -2]);
  const [hit] = new Raycaster(new Vector3(x, y, 2), new Vector3(0, 0, -1)).intersectObject(mesh);
  return [contacts[0].fixed_feature, [hit.faceIndex]];
}

test("faces have the ids that three.js gives them, with a draw range, groups and without an index", () => {
  const both = new MeshBasicMaterial({ side: DoubleSide });
  const strip = new PlaneGeometry(10, 1, 10, 1); // two triangles for each unit of x
  for (const geometry of [strip, strip.toNonIndexed()])
    for (const [start, count] of [[0, Infinity], [30, 30], [27, 12], [33, Infinity], [3, 54]]) {
      geometry.setDrawRange(start, count);
      const body = chasles.fromBufferGeometry(geometry);
      const last = Math.min(start + count, 60);
      assert.deepEqual([...body.sourceFaces], Array.from({ length: (last - start) / 3 }, (_, i) => start / 3 + i));
      assert.deepEqual([body.report.dropped_faces, body.report.segments], [start / 3, 0]);
      for (let i = Math.ceil(start / 6); i < Math.floor(last / 6); ++i) {
        const [found, expected] = faceBelow(new Mesh(geometry, both), body, i - 4.5, 0.2);
        assert.deepEqual(found, expected, `${start} ${count}: ${i}`);
      }
    }
  const cut = new PlaneGeometry(10, 1, 10, 1);
  for (const [begin, material] of [[6, 0], [24, 1], [36, 0]]) cut.addGroup(begin, 6, material);
  const mesh = new Mesh(cut, [both, both]);
  const { body } = chasles.fromObject3D(mesh);
  assert.deepEqual([...body.sourceFaces], [2, 3, 8, 9, 12, 13]);
  for (const i of [1, 4, 6]) {
    const [found, expected] = faceBelow(mesh, body, i - 4.5, 0.2);
    assert.deepEqual(found, expected);
  }
  cut.setDrawRange(0, 0);
  assert.match(refusal(() => chasles.fromBufferGeometry(cut)), /within its drawRange/);
});

test("draw ranges and groups that begin between two corners are refused by name", () => {
  const geometry = new PlaneGeometry(10, 1, 10, 1);
  for (const start of [1.5, NaN, Infinity, "3", null]) {
    const given = String(typeof start === "string" ? JSON.stringify(start) : start);
    geometry.setDrawRange(start, 20);
    const message = (name) => `geometry.${name}: its start is ${given}, and corners are counted by whole numbers`;
    assert.equal(refusal(() => chasles.fromBufferGeometry(geometry)), message("drawRange"));
    assert.equal(refusal(() => chasles.fromObject3D(new Mesh(geometry))), message("drawRange"));
    geometry.setDrawRange(0, Infinity);
    geometry.clearGroups();
    geometry.addGroup(start, 20, 0);
    assert.equal(refusal(() => chasles.fromObject3D(new Mesh(geometry, [new MeshBasicMaterial()]))), message("groups"));
    geometry.clearGroups();
  }
  geometry.setDrawRange(-3, 12.5); // as three.js draws it: from corner 0 to 9
  assert.equal(chasles.fromBufferGeometry(geometry).report.faces, 3);
});

test("what is hidden is a body all the same", () => {
  const mesh = new Mesh(fourTriangles().clone(), [new MeshBasicMaterial({ visible: false })]);
  mesh.geometry.addGroup(0, 12, 0);
  mesh.visible = false;
  assert.equal(chasles.fromObject3D(mesh).body.report.faces, 4);
});

test("interleaved attributes are read, and attributes of two numbers are refused", () => {
  const buffer = new InterleavedBuffer(new Float32Array([9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0]), 4);
  const geometry = new BufferGeometry().setAttribute("position", new InterleavedBufferAttribute(buffer, 3, 1));
  assert.deepEqual([...chasles.fromBufferGeometry(geometry).vertices], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
  const flat = new BufferGeometry().setAttribute("position", new Float32BufferAttribute([0, 0, 1, 0, 0, 1], 2));
  assert.match(refusal(() => chasles.fromBufferGeometry(flat)), /^geometry\.attributes\.position: has 2 numbers a vertex/);
});

test("morph targets and bones: as drawn now, or refused by name", () => {
  const geometry = new BoxGeometry(2, 2, 2);
  const up = geometry.attributes.position.clone();
  for (let i = 0; i < up.count; ++i) up.setXYZ(i, 0, 0, 10);
  geometry.morphAttributes.position = [up];
  geometry.morphTargetsRelative = true;
  assert.match(refusal(() => chasles.fromBufferGeometry(geometry)), /^geometry\.morphAttributes\.position: .* fromObject3D/);
  const mesh = new Mesh(geometry);
  mesh.updateMorphTargets();
  mesh.morphTargetInfluences[0] = 0.5;
  assert.deepEqual(chasles.fromObject3D(mesh).body.report.lower, [-1, -1, 4]);

  const skin = new BoxGeometry(2, 2, 2);
  const { count } = skin.attributes.position;
  skin.setAttribute("skinIndex", new BufferAttribute(new Uint16Array(4 * count), 4));
  skin.setAttribute("skinWeight", new Float32BufferAttribute(Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? 1 : 0)), 4));
  assert.match(refusal(() => chasles.fromBufferGeometry(skin)), /^geometry\.attributes\.skinIndex: .* fromObject3D.* deleteAttribute/);
  assert.deepEqual(chasles.fromBufferGeometry(skin.clone().deleteAttribute("skinIndex")).report.lower, [-1, -1, -1]);
  const loose = new SkinnedMesh(new BoxGeometry(), new MeshBasicMaterial());
  assert.equal(refusal(() => chasles.fromObject3D(loose)), "object: is a SkinnedMesh, and its geometry has no attribute skinIndex: a Mesh of the geometry is at rest");
  assert.equal(refusal(() => chasles.fromObject3D(new SkinnedMesh(skin))), "object: is a SkinnedMesh without a skeleton: mesh.bind(skeleton) gives it one");
  const skinned = new SkinnedMesh(skin);
  const bone = new Bone();
  skinned.add(bone);
  skinned.bind(new Skeleton([bone]));
  bone.position.y = 7;
  skinned.position.x = 1;
  const { body, pose } = chasles.fromObject3D(skinned);
  assert.deepEqual([body.report.lower[1], pose[0]], [6, 1]);
});

test("what is no surface, or many, is refused by name", () => {
  const body = (object) => refusal(() => chasles.fromObject3D(object));
  const group = new Group();
  group.add(new Mesh(new BoxGeometry(1, 1, 1)));
  assert.match(body(group), /^object: is no Mesh, but a Group that holds others, .*one body for each mesh: object\.traverse\(/);
  for (const object of [undefined, null, {}, new Object3D(), new Points(), new LineSegments(), new BoxGeometry(1, 1, 1)])
    assert.match(body(object), /^object: is no Mesh/);
  assert.match(body(new InstancedMesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial(), 3)), /^object: is an InstancedMesh/);
  assert.match(refusal(() => chasles.fromObject3D(new Mesh(new BoxGeometry(1, 1, 1)), { triangulat: true })), /^triangulat: is no option/);
});

test("geometries of lines are refused by their type, also in a mesh", () => {
  const solid = new BoxGeometry(2, 2, 2);
  for (const lines of [new EdgesGeometry(solid), new WireframeGeometry(solid), new EdgesGeometry(solid).clone()]) {
    const { type } = lines;
    assert.equal(lines.attributes.position.count % 3, 0, "the count of corners does not tell them from triangles");
    assert.match(refusal(() => chasles.fromBufferGeometry(lines)), new RegExp(`^geometry: is an? ${type}, which is lines and no surface: `));
    assert.match(refusal(() => chasles.fromObject3D(new Mesh(lines))), new RegExp(`^geometry: is an? ${type}, `));
  }
  assert.match(refusal(() => chasles.fromObject3D(new LineSegments2())), /^geometry: is a LineSegmentsGeometry, which is lines/);
});

test("a mesh in the place of a geometry, and a geometry in that of a mesh: the refusal names the sibling", () => {
  const solid = new BoxGeometry(2, 2, 2);
  assert.match(refusal(() => chasles.fromBufferGeometry(new Mesh(solid))), /^geometry: is a Mesh: fromObject3D\(mesh\)/);
  assert.match(refusal(() => chasles.fromObject3D(solid)), /^object: is no Mesh, but a geometry: fromBufferGeometry\(geometry\) takes it/);
});

test("where nothing is drawn, the reason is named", () => {
  const drawn = (start, count) => {
    const solid = new BoxGeometry(1, 1, 1);
    solid.setDrawRange(start, count);
    return solid;
  };
  for (const [start, count] of [[0, 0], [900, 30], [0, 2], [34, Infinity]]) {
    const reason = `geometry: none of its 36 corners begins a triangle within its drawRange (start ${start}, count ${count})`;
    assert.equal(refusal(() => chasles.fromBufferGeometry(drawn(start, count))), reason);
    assert.equal(refusal(() => chasles.fromObject3D(new Mesh(drawn(start, count)))), reason);
    assert.equal(refusal(() => chasles.fromObject3D(new Mesh(drawn(start, count), [new MeshBasicMaterial()]))), `${reason} and its groups`);
  }
  const solid = new BoxGeometry(1, 1, 1);
  const reason = /^geometry\.groups: none has a material of the mesh's list, so nothing is drawn: addGroup\(start, count, materialIndex\), or one material/;
  assert.match(refusal(() => chasles.fromObject3D(new Mesh(solid, []))), reason);
  solid.clearGroups();
  assert.match(refusal(() => chasles.fromObject3D(new Mesh(solid, [new MeshBasicMaterial()]))), reason);
  const empty = new BufferGeometry().setAttribute("position", new Float32BufferAttribute([0, 0, 0, 1, 0, 0], 3));
  assert.equal(refusal(() => chasles.fromBufferGeometry(empty)), "geometry: has 2 corners, and a triangle needs 3");
});

test("an object at no place is refused as an object", () => {
  const mesh = new Mesh(new BoxGeometry(1, 1, 1));
  const part = chasles.fromObject3D(mesh);
  for (const x of [NaN, Infinity, 1e31]) {
    mesh.position.x = x;
    assert.equal(refusal(() => part.pose), "object: its matrix in the world has a number that is NaN or beyond 1e30");
  }
  mesh.position.x = 1;
  assert.deepEqual(part.pose, [1, 0, 0, 1, 0, 0, 0]);
});
