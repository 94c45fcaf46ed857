// Bodies from the geometries and meshes of three.js, as three.js draws them. What decides about the shape and is not in the
// argument is refused by name.
import { InvalidInput } from "./errors.js";
import { addMotion } from "./numbers.js";
import { fromArrays } from "./polyhedron.js";
import { poseWithRest, separated, updateWorld, worldRows } from "./poses.js";
import { shown } from "./values.js";

const rounding = 1e-12;
const largest = 1e30; // of a length in the library

function refuse(what) {
  throw new InvalidInput(what);
}

const ofLines = /^(Edges|Wireframe|Line|LineSegments)Geometry2?$/;
const article = (name) => (/^[AEIOU]/.test(name) ? "an" : "a");

/** Corners by threes would be triangles that nobody draws. A BufferGeometry by itself does not say what it is for. */
function refuseLines(geometry) {
  const { type } = geometry ?? {};
  if (ofLines.test(type)) refuse(`geometry: is ${article(type)} ${type}, which is lines and no surface: give the geometry that it was made from`);
}

/** The places of a geometry's vertices. Accessors know interleaved and normalised arrays. */
function positions(geometry) {
  const position = geometry?.attributes?.position;
  if (typeof position?.getX !== "function" || !(position.count >= 0)) refuse("geometry: has no attribute position");
  if (position.itemSize < 3) refuse(`geometry.attributes.position: has ${position.itemSize} numbers a vertex; a point needs 3`);
  const vertices = new Float64Array(3 * position.count);
  for (let i = 0; i < position.count; ++i)
    vertices.set([position.getX(i), position.getY(i), position.getZ(i)], 3 * i);
  return vertices;
}

const cornerCount = ({ index, attributes }) => (index ?? attributes.position).count;

/** Where no triangle is drawn: why. */
function refuseNothing(geometry, groups) {
  const corners = cornerCount(geometry);
  if (corners < 3) refuse(`geometry: has ${corners} corners, and a triangle needs 3`);
  if (groups?.length === 0)
    refuse("geometry.groups: none has a material of the mesh's list, so nothing is drawn: addGroup(start, count, materialIndex), or one material in place of the list");
  const { start = 0, count = Infinity } = geometry.drawRange ?? {};
  refuse(`geometry: none of its ${corners} corners begins a triangle within its drawRange (start ${start}, count ${count})${groups ? " and its groups" : ""}`);
}

/** Where a draw range or a group begins. WebGL draws nothing from between two corners. */
function firstCorner(start, name) {
  if (!Number.isInteger(start)) refuse(`${name}: its start is ${shown(start)}, and corners are counted by whole numbers`);
  return Math.max(start, 0);
}

const undrawn = -1;

/** How many ids the triangles from a corner up to another one need. */
const idsOf = ({ begin, end }) => (end - begin >= 3 ? Math.floor(begin / 3) + Math.floor((end - begin) / 3) : 0);

/**
 * The first corner of each triangle that WebGLRenderer draws, by its id there (`faceIndex`), or `undrawn`. A draw range, and a group
 * within it, begin at any corner, and corners at their end that are no whole triangle are not drawn. Without groups all is drawn.
 */
function drawnTriangles(geometry, groups = [{ start: 0, count: Infinity }]) {
  const { start: from = 0, count = Infinity } = geometry.drawRange ?? {};
  const first = firstCorner(from, "geometry.drawRange");
  const parts = groups.map((group) => ({
    begin: Math.max(first, firstCorner(group.start, "geometry.groups")),
    end: Math.min(from + count, group.start + group.count, cornerCount(geometry)),
  }));
  const triangles = new Float64Array(parts.reduce((most, part) => Math.max(most, idsOf(part)), 0)).fill(undrawn);
  for (const { begin, end } of parts) {
    for (let i = begin; i + 3 <= end; i += 3) {
      const id = Math.floor(i / 3);
      if (triangles[id] !== undrawn && triangles[id] !== i) refuse(`geometry.groups: two of them draw two triangles of one faceIndex (${id}): groups that overlap must begin at multiples of 3`);
      triangles[id] = i;
    }
  }
  return triangles;
}

/**
 * The corners of all triangles up to the last drawn one: a face gets the id that its triangle has in three.js. A triangle that is not
 * drawn becomes a corner of a drawn one: a face that adds nothing to the surface.
 */
function cornersOf(geometry, triangles, groups) {
  const { index } = geometry;
  const corner = (k) => (index ? index.getX(k) : k);
  const first = triangles.find((start) => start !== undrawn);
  if (first === undefined) refuseNothing(geometry, groups);
  const corners = new Float64Array(3 * triangles.length); // what is no index is refused later
  for (let id = 0; id < triangles.length; ++id)
    for (let k = 0; k < 3; ++k) corners[3 * id + k] = corner(triangles[id] === undrawn ? first : triangles[id] + k);
  return corners;
}

/** Groups choose materials, and draw nothing by themselves; where they leave out triangles, the mesh decides. */
function refuseLooseGroups(geometry, triangles) {
  if (!(geometry.groups?.length > 0)) return;
  const grouped = drawnTriangles(geometry, geometry.groups);
  const longer = grouped.length > triangles.length ? grouped : triangles;
  const id = longer.findIndex((_, i) => (triangles[i] ?? undrawn) !== (grouped[i] ?? undrawn));
  if (id >= 0)
    refuse(`geometry.groups: leave out triangle ${id}, which some materials draw and others do not: fromObject3D(mesh) takes what is drawn, clearGroups() all`);
}

function refuseDeformed(geometry) {
  if (geometry.morphAttributes?.position?.length > 0)
    refuse("geometry.morphAttributes.position: the shape depends on the influences of a mesh: fromObject3D(mesh) takes the shape that is drawn");
  if (geometry.attributes?.skinIndex)
    refuse('geometry.attributes.skinIndex: the shape depends on the bones of a mesh: fromObject3D(mesh) takes the shape that is drawn; a copy after deleteAttribute("skinIndex") is at rest');
  if (geometry.isInstancedBufferGeometry)
    refuse("geometry: is an InstancedBufferGeometry, which is many bodies: make one body, and give each a pose");
}

/** Vertices at equal places, which normals and texture need, count as one. */
export function fromBufferGeometry(border, geometry, options) {
  if (geometry?.isMesh) refuse("geometry: is a Mesh: fromObject3D(mesh) takes it as it is drawn, fromBufferGeometry(mesh.geometry) without its scale");
  refuseLines(geometry);
  const vertices = positions(geometry);
  refuseDeformed(geometry);
  const triangles = drawnTriangles(geometry);
  refuseLooseGroups(geometry, triangles);
  return fromArrays(border, vertices, cornersOf(geometry, triangles), options);
}

/** Without bones and weights, a SkinnedMesh has no shape that is drawn. */
function refuseUnbound({ geometry, skeleton }) {
  for (const name of ["skinIndex", "skinWeight"])
    if (!geometry.attributes[name])
      refuse(`object: is a SkinnedMesh, and its geometry has no attribute ${name}: a Mesh of the geometry is at rest`);
  if (!skeleton) refuse("object: is a SkinnedMesh without a skeleton: mesh.bind(skeleton) gives it one");
}

/** Places of a mesh's vertices in its own frame, with morph targets and bones as they are now. */
function deformed(mesh, vertices) {
  const hasTargets = mesh.geometry.morphAttributes?.position?.length > 0;
  if (!hasTargets && !mesh.isSkinnedMesh) return vertices;
  if (typeof mesh.getVertexPosition !== "function") refuse("object: is deformed, and has no getVertexPosition");
  if (mesh.isSkinnedMesh) refuseUnbound(mesh);
  for (const bone of mesh.skeleton?.bones ?? []) updateWorld(bone);
  if (mesh.isSkinnedMesh) {
    updateWorld(mesh);
    mesh.updateMatrixWorld();
  }
  const place = mesh.position.clone();
  for (let i = 0; i < vertices.length / 3; ++i) {
    mesh.getVertexPosition(i, place);
    vertices.set([place.x, place.y, place.z], 3 * i);
  }
  return vertices;
}

/** Loaders give a Group that holds meshes. */
function refuseGroup({ type = "Group" }) {
  refuse(`object: is no Mesh, but ${article(type)} ${type} that holds others, as loaders give it: make one body for each mesh: object.traverse((part) => { if (part.isMesh) parts.push(chasles.fromObject3D(part)); })`);
}

function refuseOtherThanMesh(object) {
  if (object?.isBufferGeometry) refuse("object: is no Mesh, but a geometry: fromBufferGeometry(geometry) takes it");
  if (!object?.matrixWorld || !object.isMesh) {
    if (object?.children?.length > 0) refuseGroup(object);
    refuse("object: is no Mesh");
  }
  if (object.isInstancedMesh || object.isBatchedMesh)
    refuse(`object: is ${object.isInstancedMesh ? "an InstancedMesh" : "a BatchedMesh"}, which is many bodies: make one body of the geometry, and give each a pose`);
  refuseLines(object.geometry);
  if (object.geometry?.isInstancedBufferGeometry) refuseDeformed({ isInstancedBufferGeometry: true });
}

/** Up to rounding: a scale of 1 + 1e-9 is baked. */
const isIdentity = (rest) => rest.every((entry, i) => Math.abs(entry - (i % 4 === 0 ? 1 : 0)) <= rounding);

/** The vertices in the frame of the body, which turns and shifts only. */
function baked(vertices, [s, t, u, , v, w, , , x]) {
  for (let i = 0; i < vertices.length; i += 3) {
    const [a, b, c] = vertices.subarray(i, i + 3);
    vertices.set([s * a + t * b + u * c, v * b + w * c, x * c], i);
  }
  return vertices;
}

/** A mirrored triangle is seen from its other side: its corners go round the other way. */
function turnedOver(corners) {
  for (let i = 0; i < corners.length; i += 3) [corners[i + 1], corners[i + 2]] = [corners[i + 2], corners[i + 1]];
  return corners;
}

function sevenNumbers(border, pose) {
  border.giveNumbers(addMotion([0], pose, pose, {}));
  return Array.from(border.ask("pose_at"));
}

/** A matrix in the world whose numbers a pose can have. */
function finiteRows(object) {
  const rows = worldRows(object);
  if (!rows.every((x) => Math.abs(x) <= largest)) refuse(`object: its matrix in the world has a number that is NaN or beyond 1e30`);
  return rows;
}

/** `{ body, pose }`: `pose` is where the object is whenever it is read. The object must keep the scale that is in the body. */
export function fromObject3D(border, object, options) {
  refuseOtherThanMesh(object);
  const { geometry, material } = object;
  const { rest } = separated(worldRows(object));
  if (!rest.every(Number.isFinite) || [0, 4, 8].some((i) => rest[i] === 0))
    refuse("object: its matrix in the world has no inverse: a scale is 0, or a number is missing");
  const vertices = deformed(object, positions(geometry));
  const groups = Array.isArray(material) ? (geometry.groups ?? []).filter(({ materialIndex }) => material[materialIndex ?? 0]) : undefined;
  const corners = cornersOf(geometry, drawnTriangles(geometry, groups), groups);
  const rigid = isIdentity(rest);
  if (!rigid) baked(vertices, rest);
  const body = fromArrays(border, vertices, rest[8] < 0 ? turnedOver(corners) : corners, options);
  return {
    body,
    get pose() {
      const rows = poseWithRest(finiteRows(object), rest);
      if (rows) return sevenNumbers(border, rows);
      return refuse("object: its scale, shear or mirroring has changed since its body was made: make a new body by fromObject3D(object)");
    },
  };
}
