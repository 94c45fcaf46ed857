// The surface of a round body as it is drawn: balls around vertices, tubes along edges, and faces moved out to both sides.
import { Vector3 } from "three";
import type { BodyShape } from "./protocol";

export interface Surface {
  vertices: Float64Array;
  triangles: Uint32Array;
}

const sidesOf = [24, 16, 12, 8, 6, 4]; // of balls and tubes: the most that fit
const mostTriangles = 300_000; // of all balls and tubes; beyond, faces only are drawn

export function roundSurface(shape: BodyShape): Surface {
  const made = new Made(shape);
  made.addFaces();
  const [corners, edges] = [made.corners.length, made.edges.length];
  const sides = sidesOf.find((n) => corners * n * n + 2 * edges * n <= mostTriangles);
  if (sides) {
    for (const corner of made.corners) made.addRings(corner, new Vector3(), sides);
    for (const [from, to] of made.edges) made.addRings(from, to.clone().sub(from), sides);
  }
  return { vertices: new Float64Array(made.vertices), triangles: new Uint32Array(made.triangles) };
}

class Made {
  readonly corners: Vector3[];
  readonly edges: [Vector3, Vector3][];
  readonly vertices: number[] = [];
  readonly triangles: number[] = [];

  constructor(private readonly shape: BodyShape) {
    const { faces } = shape;
    const sides = faces.flatMap((face) => face.map((corner, k) => [corner, face[(k + 1) % face.length]]).filter(([a, b]) => a !== b));
    const pairs = new Map(sides.map(([a, b]) => [`${Math.min(a, b)} ${Math.max(a, b)}`, [a, b]]));
    this.corners = [...new Set(faces.flat())].map((corner) => this.place(corner));
    this.edges = [...pairs.values()].map(([a, b]) => [this.place(a), this.place(b)]);
  }

  addFaces(): void {
    const { triangles, radius } = this.shape;
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => this.place(triangles[i + k]));
      const out = b.clone().sub(a).cross(c.clone().sub(a)).setLength(radius);
      if (!(out.length() > 0)) continue; // a segment or a point
      for (const [side, corners] of [[1, [a, b, c]], [-1, [a, c, b]]] as const)
        this.triangles.push(...corners.map((corner) => this.add(corner.clone().addScaledVector(out, side))));
    }
  }

  /** A ball about a point, or a tube along a way: rings of corners, joined by triangles. */
  addRings(from: Vector3, way: Vector3, sides: number): void {
    const isBall = way.lengthSq() === 0;
    const axis = isBall ? new Vector3(0, 0, 1) : way.clone().normalize();
    const across = new Vector3().crossVectors(axis, Math.abs(axis.x) < 0.5 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).normalize();
    const third = new Vector3().crossVectors(axis, across);
    const rings = isBall ? sides / 2 : 1;
    const first = this.vertices.length / 3;
    for (let ring = 0; ring <= rings; ++ring)
      for (let side = 0; side < sides; ++side) {
        const around = (2 * Math.PI * side) / sides;
        const up = isBall ? (Math.PI * ring) / rings : Math.PI / 2;
        const out = across.clone().multiplyScalar(Math.cos(around)).addScaledVector(third, Math.sin(around)).multiplyScalar(Math.sin(up));
        out.addScaledVector(axis, -Math.cos(up)).multiplyScalar(this.shape.radius);
        this.add(out.add(from).addScaledVector(way, isBall ? 0 : ring));
      }
    for (let ring = 0; ring < rings; ++ring)
      for (let side = 0; side < sides; ++side) {
        const [a, b] = [side, (side + 1) % sides].map((k) => first + ring * sides + k);
        this.triangles.push(a, b, b + sides, a, b + sides, a + sides);
      }
  }

  private place(corner: number): Vector3 {
    return new Vector3().fromArray(this.shape.vertices, 3 * corner);
  }

  private add({ x, y, z }: Vector3): number {
    return this.vertices.push(x, y, z) / 3 - 1;
  }
}
