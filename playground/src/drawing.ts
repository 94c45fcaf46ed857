// What is drawn: the bodies, their contacts with normals and forces, and the line from the part to the hand.
import {
  type Box3, BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, EdgesGeometry, Group, InstancedMesh, LineBasicMaterial,
  LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, Quaternion, SphereGeometry, Vector3,
} from "three";
import { pushedBack } from "../../viewer/src/meshes";
import { matrixOf, type Pose } from "./poses";
import type { BodyShape, ContactShown } from "./protocol";
import { roundSurface } from "./round";

const creaseAngle = 25; // degrees
const mostWithCreases = 60_000; // triangles
const mostMarkers = 64;
const markerRadius = 0.0056; // relative to the distance from the camera
const up = new Vector3(0, 1, 0);
const nowhere = new Matrix4().makeScale(0, 0, 0);

export interface Palette {
  moving: string;
  fixed: string;
  ground: string;
  contact: string;
  edge: string;
  text: string;
  background: string;
}

/** How a body is drawn. */
export type Kind = "moving" | "fixed" | "glass" | "ground";

/** A body. Its vertices are in single precision, so they are relative to its middle. */
export class DrawnBody {
  readonly group = new Group();
  readonly mesh: Mesh;
  private readonly surface: MeshLambertMaterial;
  private readonly lines = new LineBasicMaterial();

  constructor(readonly shape: BodyShape, readonly kind: Kind) {
    const middle = new Vector3(...shape.lower).add(new Vector3(...shape.upper)).multiplyScalar(0.5);
    const surface = shape.radius > 0 ? roundSurface(shape) : shape;
    const vertices = new Float32Array(surface.vertices.length);
    for (let i = 0; i < vertices.length; ++i) vertices[i] = surface.vertices[i] - middle.getComponent(i % 3);
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(vertices, 3));
    geometry.setIndex(new BufferAttribute(surface.triangles, 1));
    this.surface = new MeshLambertMaterial({ flatShading: true, ...pushedBack });
    if (kind === "glass") Object.assign(this.surface, { transparent: true, opacity: 0.12, depthWrite: false });
    this.mesh = new Mesh(geometry, this.surface);
    this.group.matrixAutoUpdate = false;
    this.add(this.mesh, middle);
    if (shape.radius === 0 && shape.triangles.length <= 3 * mostWithCreases) this.add(new LineSegments(new EdgesGeometry(geometry, creaseAngle), this.lines), middle);
  }

  moveTo(pose: Pose): void {
    matrixOf(pose, this.group.matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  paint(palette: Palette, isBlocking: boolean): void {
    this.surface.color.set(palette[this.kind === "glass" ? "fixed" : this.kind]);
    this.lines.color.set(isBlocking ? palette.contact : palette.edge);
    this.lines.transparent = this.kind === "glass";
    this.lines.opacity = this.lines.transparent ? 0.35 : 1;
  }

  dispose(): void {
    this.group.traverse((part) => (part as Mesh).geometry?.dispose());
    this.surface.dispose();
    this.lines.dispose();
  }

  private add(part: Object3D, middle: Vector3): void {
    part.position.copy(middle);
    this.group.add(part);
  }
}

/** Friction included. */
const forceOf = ({ normal, force, friction }: ContactShown) => new Vector3(...normal).multiplyScalar(force).add(new Vector3(...friction));

/** Spheres at contacts, thin shafts along their normals, and arrows as long as their forces. In front of the bodies. */
export class ContactMarks {
  readonly group = new Group();
  private readonly colour = new MeshBasicMaterial({ depthTest: false, transparent: true });
  private readonly rimColour = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
  private readonly rims = this.instanced(new SphereGeometry(1.4, 14, 10), this.rimColour, 10);
  private readonly spheres = this.instanced(new SphereGeometry(1, 14, 10), this.colour, 11);
  private readonly normals = this.instanced(new CylinderGeometry(0.16, 0.16, 1, 6).translate(0, 0.5, 0), this.colour, 11);
  private readonly shafts = this.instanced(new CylinderGeometry(0.42, 0.42, 1, 8).translate(0, 0.5, 0), this.colour, 12);
  private readonly heads = this.instanced(new ConeGeometry(1.15, 3, 12).translate(0, 1.5, 0), this.colour, 12);
  private contacts: ContactShown[] = [];

  show(contacts: ContactShown[]): void {
    this.contacts = contacts.slice(0, mostMarkers);
  }

  paint(palette: Palette): void {
    this.colour.color.set(palette.contact);
    this.rimColour.color.set(palette.background);
  }

  /** `sizeAt` is the radius of a marker at a place, and `longest` the length of the longest arrow, both in mesh units. */
  resize(sizeAt: (place: Vector3) => number, longest: number): void {
    const greatest = Math.max(...this.contacts.map((contact) => forceOf(contact).length()), 0);
    const scale = greatest > longest ? longest / greatest : 1;
    this.contacts.forEach((contact, index) => this.place(index, contact, sizeAt, scale));
    for (const part of this.parts) {
      part.count = this.contacts.length;
      part.instanceMatrix.needsUpdate = true;
    }
  }

  private get parts(): InstancedMesh[] {
    return [this.rims, this.spheres, this.normals, this.shafts, this.heads];
  }

  private place(index: number, contact: ContactShown, sizeAt: (place: Vector3) => number, scale: number): void {
    const point = new Vector3(...contact.point);
    const normal = new Vector3(...contact.normal);
    const turn = new Quaternion().setFromUnitVectors(up, normal);
    const size = sizeAt(point);
    const force = forceOf(contact);
    const length = contact.force > 0 ? Math.max(force.length() * scale, 2 * size) : 0;
    const put = (part: InstancedMesh, at: Vector3, stretch: number, along = turn) =>
      part.setMatrixAt(index, new Matrix4().compose(at, along, new Vector3(size, stretch, size)));
    put(this.rims, point, size);
    put(this.spheres, point, size);
    put(this.normals, point, 6 * size);
    if (length > 0) {
      const direction = force.normalize();
      const along = new Quaternion().setFromUnitVectors(up, direction);
      put(this.shafts, point, length, along);
      put(this.heads, point.clone().addScaledVector(direction, length), size, along);
    } else for (const part of [this.shafts, this.heads]) part.setMatrixAt(index, nowhere);
  }

  private instanced(geometry: BufferGeometry, material: MeshBasicMaterial, order: number): InstancedMesh {
    const mesh = new InstancedMesh(geometry, material, mostMarkers);
    mesh.renderOrder = order;
    mesh.frustumCulled = false;
    this.group.add(mesh);
    return mesh;
  }
}

/** The line from the grabbed point to where the hand pulls it. */
export class HandLine {
  readonly group = new Group();
  private readonly colour = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.85 });
  private readonly line = new Mesh(new CylinderGeometry(1, 1, 1, 10).translate(0, 0.5, 0), this.colour);
  private readonly ends = [0, 1].map(() => new Mesh(new SphereGeometry(1, 20, 14), this.colour));
  private ofHand?: { from: Vector3; to: Vector3 };

  constructor() {
    for (const part of [this.line, ...this.ends]) {
      part.renderOrder = 13;
      part.frustumCulled = false;
      this.group.add(part);
    }
  }

  show(ends?: { from: Vector3; to: Vector3 }): void {
    this.ofHand = ends;
    this.group.visible = ends !== undefined;
  }

  paint(palette: Palette): void {
    this.colour.color.set(palette.text);
  }

  resize(sizeAt: (place: Vector3) => number): void {
    if (!this.ofHand) return;
    const { from, to } = this.ofHand;
    const way = to.clone().sub(from);
    const length = Math.max(way.length(), 1e-9);
    this.line.position.copy(from);
    this.line.quaternion.setFromUnitVectors(up, way.divideScalar(length));
    this.line.scale.set(0.3 * sizeAt(from), length, 0.3 * sizeAt(from));
    [from, to].forEach((place, index) => {
      this.ends[index].position.copy(place);
      this.ends[index].scale.setScalar((index === 0 ? 0.8 : 1.2) * sizeAt(place));
    });
  }
}

/** The radius of a marker at a place in the world of the scene. */
export function markerSize(camera: Vector3, toStage: Matrix4, unit: number): (place: Vector3) => number {
  return (place) => (markerRadius * place.clone().applyMatrix4(toStage).distanceTo(camera)) / unit;
}

export function cornersOf({ min, max }: Box3): Vector3[] {
  const ends = [min, max];
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new Vector3(ends[k & 1].x, ends[(k >> 1) & 1].y, ends[k >> 2].z));
}
