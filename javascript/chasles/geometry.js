// Bodies from the geometries and meshes of three.js, as three.js draws them. What decides about the shape and is not in the
// argument is refused by name.
import { InvalidInput } from "./errors.js";
import { addMotion } from "./numbers.js";
import { fromArrays } from "./polyhedron.js";
import { poseWithRest, separated, updateWorld, worldRows } from "./poses.js";

const rounding = 1e-12;

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

/** The part of the corners that is drawn: those of the draw range. */
function drawnPart({ drawRange }, count) {
  const begin = Math.min(drawRange?.start ?? 0, count);
  const end = Math.min(begin + (drawRange?.count ?? Infinity), count);
  if ((end - begin) % 3 !== 0)
    refuse(`geometry${drawRange?.count < Infinity ? ".drawRange" : ""}: ${end - begin} indices are no triangles of 3 corners each`);
  return { begin, end };
}

/** Whether a group with a material draws a corner. */
const isInGroup = (groups, corner) => groups.some(({ start, count }) => corner >= start && corner < start + count);

/**
 * The corners of the triangles that are drawn. With a list of materials, only those in groups are. So that a face has the id that its
 * triangle has in three.js (`faceIndex`), a triangle in front of the last one that is not drawn becomes a corner of one that is: a face
 * that adds nothing to the surface.
 */
function drawnCorners(geometry, { begin, end }, materials) {
  const { index: given, groups = [] } = geometry;
  const drawn = materials && groups.filter(({ materialIndex }) => materials[materialIndex ?? 0]);
  const isDrawn = (i) => i >= begin && i < end && (!drawn || isInGroup(drawn, i));
  const corner = (k) => (given ? given.getX(k) : k);
  const shown = [];
  for (let i = begin; i < end; i += 3) if (isDrawn(i)) shown.push(i);
  if (shown.length === 0) return [];
  const [first, last] = [shown[0], shown.at(-1)];
  const corners = [];
  for (let i = first % 3; i <= last; i += 3) {
    const isShown = isDrawn(i);
    for (let k = i; k < i + 3; ++k) corners.push(corner(isShown ? k : first));
  }
  return corners;
}

/** Groups choose materials, and draw nothing by themselves; where they leave out triangles, the mesh decides. */
function refuseLooseGroups({ groups = [] }, { begin, end }) {
  if (groups.length === 0) return;
  for (let i = begin; i < end; i += 3)
    if (!isInGroup(groups, i))
      refuse(`geometry.groups: leave out triangle ${i / 3}, which some materials draw and others do not: fromObject3D(mesh) takes what is drawn, clearGroups() all`);
}

function refuseDeformed(geometry) {
  if (geometry.morphAttributes?.position?.length > 0)
    refuse("geometry.morphAttributes.position: the shape depends on the influences of a mesh: fromObject3D(mesh) takes the shape that is drawn");
  if (geometry.attributes?.skinIndex)
    refuse('geometry.attributes.skinIndex: the shape depends on the bones of a mesh: fromObject3D(mesh) takes the shape that is drawn; a copy after deleteAttribute("skinIndex") is at rest');
  if (geometry.isInstancedBufferGeometry)
    refuse("geometry: is an InstancedBufferGeometry, which is many bodies: make one body, and give each a pose");
}

const cornerCount = ({ index, attributes }) => (index ?? attributes.position).count;

/** Vertices at equal places, which normals and texture need, count as one. */
export function fromBufferGeometry(border, geometry, options) {
  if (geometry?.isMesh) refuse("geometry: is a Mesh: fromObject3D(mesh) takes it as it is drawn, fromBufferGeometry(mesh.geometry) without its scale");
  refuseLines(geometry);
  const vertices = positions(geometry);
  refuseDeformed(geometry);
  const part = drawnPart(geometry, cornerCount(geometry));
  refuseLooseGroups(geometry, part);
  return fromArrays(border, vertices, drawnCorners(geometry, part), options);
}

/** Places of a mesh's vertices in its own frame, with morph targets and bones as they are now. */
function deformed(mesh, vertices) {
  const hasTargets = mesh.geometry.morphAttributes?.position?.length > 0;
  if (!hasTargets && !mesh.isSkinnedMesh) return vertices;
  if (typeof mesh.getVertexPosition !== "function") refuse("object: is deformed, and has no getVertexPosition");
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

function refuseOtherThanMesh(object) {
  if (object?.isBufferGeometry) refuse("object: is no Mesh, but a geometry: fromBufferGeometry(geometry) takes it");
  if (!object?.matrixWorld || !object.isMesh)
    refuse(`object: is no Mesh${object?.children?.length > 0 ? ", but holds others: object.traverse() reaches each, for a body of its own" : ""}`);
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

/** `{ body, pose }`: `pose` is where the object is whenever it is read. The object must keep the scale that is in the body. */
export function fromObject3D(border, object, options) {
  refuseOtherThanMesh(object);
  const { geometry, material } = object;
  const { rest } = separated(worldRows(object));
  if (!rest.every(Number.isFinite) || [0, 4, 8].some((i) => rest[i] === 0))
    refuse("object: its matrix in the world has no inverse: a scale is 0, or a number is missing");
  const vertices = deformed(object, positions(geometry));
  const part = drawnPart(geometry, cornerCount(geometry));
  const corners = drawnCorners(geometry, part, Array.isArray(material) ? material : undefined);
  const rigid = isIdentity(rest);
  if (!rigid) baked(vertices, rest);
  const body = fromArrays(border, vertices, rest[8] < 0 ? turnedOver(corners) : corners, options);
  return {
    body,
    get pose() {
      const rows = poseWithRest(worldRows(object), rest);
      if (rows) return sevenNumbers(border, rows);
      return refuse("object: its scale, shear or mirroring has changed since its body was made: make a new body by fromObject3D(object)");
    },
  };
}
