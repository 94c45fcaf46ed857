// Contact points as spheres and normals as arrows. Markers have a constant size on the screen. They are drawn in front of
// the bodies, because most contacts lie hidden between them. They move with the fixed body.
import {
  BufferGeometry,
  type Camera,
  ConeGeometry,
  CylinderGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { type Marked, markedPoints, type Point, type Vector } from "./scene";

const mostMarkers = 500;
const radiusOnScreen = 0.0052; // relative to the distance from the camera
const chosenIsLarger = 1.6;
const otherEndIsSmaller = 0.85;
const up = new Vector3(0, 1, 0);

interface Marker {
  point: Vector3; // in the fixed body's frame
  turn?: Quaternion; // rotates `up` to the normal
  scale: number;
}

function markerOf(point: Vector, normal: Vector | undefined, toFixed: Matrix4): Marker {
  const turn = normal && new Quaternion().setFromUnitVectors(up, new Vector3(...normal).transformDirection(toFixed));
  return { point: new Vector3(...point).applyMatrix4(toFixed), turn, scale: 1 };
}

/** With a margin the bodies keep a gap. A smaller marker shows the point on the moving body. */
function otherEnd({ point, normal, gap }: Point, toFixed: Matrix4): Marker {
  const end = new Vector3(...point).addScaledVector(new Vector3(...normal), gap);
  return { point: end.applyMatrix4(toFixed), scale: otherEndIsSmaller };
}

/** Arrows point along the y axis. The unit is the radius of a marker. */
function shaft(): BufferGeometry {
  return new CylinderGeometry(0.26, 0.26, 9, 12).translate(0, 5.5, 0);
}
function head(): BufferGeometry {
  return new ConeGeometry(0.9, 3, 20).translate(0, 11, 0);
}

export class Markers {
  readonly group = new Group();
  private readonly markers: Marker[];
  private readonly parts: InstancedMesh[];
  private readonly rims: InstancedMesh;
  private readonly lines: LineSegments;
  private readonly colour = new MeshBasicMaterial({ depthTest: false, transparent: true });
  private readonly gapColour = new LineBasicMaterial({ depthTest: false, transparent: true });
  private readonly rimColour = new MeshBasicMaterial({ depthTest: false, transparent: true });

  /** `fixedPose` is the pose of the fixed body at the time of the contact; the points of the answer belong to this time. */
  constructor(answer: Marked, margin: number, fixedPose: Matrix4) {
    const toFixed = fixedPose.clone().invert();
    const contacts = (answer.contacts ?? []).slice(0, mostMarkers);
    const marked = markedPoints(answer).slice(0, mostMarkers);
    const gaps = margin > 0 ? contacts : []; // without a margin the gaps are rounding errors
    this.markers = [
      ...marked.map((point, index) => markerOf(point, contacts[index]?.normal, toFixed)),
      ...gaps.map((contact) => otherEnd(contact, toFixed)),
    ];
    this.lines = this.gapLines(gaps, toFixed);
    this.group.add(this.lines);
    const instanced = (geometry: BufferGeometry, material: MeshBasicMaterial, order: number) => {
      const mesh = new InstancedMesh(geometry, material, this.markers.length);
      mesh.renderOrder = order;
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    };
    this.rims = instanced(new SphereGeometry(1.35, 24, 16), this.rimColour, 10);
    this.parts = [shaft(), head(), new SphereGeometry(1, 24, 16)].map((part) => instanced(part, this.colour, 11));
    this.group.matrixAutoUpdate = false;
    this.group.visible = this.markers.length > 0;
  }

  choose(index: number | undefined): void {
    for (const marker of this.markers) if (marker.turn) marker.scale = 1;
    if (index !== undefined && index < mostMarkers) this.markers[index].scale = chosenIsLarger;
  }

  /** Line vertices are in single precision, so they are relative to a nearby point. */
  private gapLines(contacts: Point[], toFixed: Matrix4): LineSegments {
    const base = this.markers[0]?.point ?? new Vector3();
    const ends = contacts.flatMap((contact) => [
      new Vector3(...contact.point).applyMatrix4(toFixed).sub(base),
      otherEnd(contact, toFixed).point.sub(base),
    ]);
    const lines = new LineSegments(new BufferGeometry().setFromPoints(ends), this.gapColour);
    lines.position.copy(base);
    lines.renderOrder = 12;
    return lines;
  }

  show(fixedPose: Matrix4, isAtContact: boolean): void {
    this.group.matrix.copy(fixedPose);
    this.group.matrixWorldNeedsUpdate = true;
    this.colour.opacity = this.gapColour.opacity = isAtContact ? 1 : 0.35;
    this.rimColour.opacity = isAtContact ? 0.9 : 0.2;
  }

  paint(colour: string, rim: string): void {
    this.colour.color.set(colour);
    this.gapColour.color.set(colour);
    this.rimColour.color.set(rim);
  }

  dispose(): void {
    for (const part of [...this.parts, this.rims]) {
      part.geometry.dispose();
      part.dispose();
    }
    this.lines.geometry.dispose();
    for (const material of [this.colour, this.gapColour, this.rimColour]) material.dispose();
  }

  /** `unit` is the length of one mesh unit in the scene. */
  resize(camera: Camera, unit: number): void {
    const at = new Vector3();
    this.markers.forEach(({ point, turn, scale }, index) => {
      const distance = at.copy(point).applyMatrix4(this.group.matrixWorld).distanceTo(camera.position);
      const size = new Vector3().setScalar((scale * radiusOnScreen * distance) / unit);
      const place = new Matrix4().compose(point, turn ?? new Quaternion(), size);
      const nowhere = new Matrix4().makeScale(0, 0, 0);
      const [shafts, heads, spheres] = this.parts;
      for (const mesh of [shafts, heads]) mesh.setMatrixAt(index, turn ? place : nowhere);
      for (const mesh of [spheres, this.rims]) mesh.setMatrixAt(index, place);
    });
    for (const mesh of [...this.parts, this.rims]) mesh.instanceMatrix.needsUpdate = true;
  }
}
