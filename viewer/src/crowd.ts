// Many bodies, drawn with one call for each shape (instances). The two bodies of the chosen contact are drawn by others.
import {
  type BufferGeometry,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  MeshLambertMaterial,
  Color,
} from "three";
import type { Colours } from "./colours";
import { type DrawnMesh, pushedBack } from "./meshes";
import type { Track } from "./track";

export type Look = "solid" | "dim" | "hidden";

/** A body that the crowd draws: its shape as an index, and its motion. */
export interface Member {
  mesh: number;
  track: Track;
}

const manyBodies = 100; // whose dim surfaces would cover the chosen pair

const nowhere = new Matrix4().makeScale(0, 0, 0);

/** Lines that are drawn once for each matrix. three.js has this for meshes only, and recognises the members. */
class InstancedLines extends LineSegments {
  readonly isInstancedMesh = true;
  readonly instanceColor = null;
  readonly morphTexture = null;

  constructor(geometry: BufferGeometry, material: Material, readonly instanceMatrix: InstancedBufferAttribute, readonly count: number) {
    super(geometry, material);
    this.frustumCulled = false;
  }
}

/** All bodies of one shape. */
class Shape {
  readonly surface: InstancedMesh;
  readonly lines: InstancedLines;
  private readonly toShape: Matrix4;
  private readonly matrix = new Matrix4();

  constructor(mesh: DrawnMesh, readonly members: number[], surface: Material, lines: Material, private readonly toStage: Matrix4) {
    this.surface = new InstancedMesh(mesh.surface, surface, members.length);
    this.surface.frustumCulled = false;
    this.lines = new InstancedLines(mesh.creases, lines, this.surface.instanceMatrix, members.length);
    this.toShape = new Matrix4().makeTranslation(mesh.origin);
  }

  /** Computed in double precision; only the product is stored in single precision. */
  place(index: number, pose: Matrix4 | undefined): void {
    if (pose) this.matrix.multiplyMatrices(this.toStage, pose).multiply(this.toShape);
    this.surface.setMatrixAt(index, pose ? this.matrix : nowhere);
  }

  update(): void {
    this.surface.instanceMatrix.needsUpdate = true;
    this.surface.boundingSphere = null; // the pointer finds bodies by it
  }
}

export class Crowd {
  readonly group = new Group();
  private readonly shapes: Shape[];
  private readonly surface = new MeshLambertMaterial({ flatShading: true, ...pushedBack });
  private readonly lines = new LineBasicMaterial();
  private absent = new Set<number>();
  private isStale = true; // resting bodies have to be placed too

  /** `toStage` maps world coordinates to those of the group. */
  constructor(meshes: DrawnMesh[], private readonly bodies: Member[], toStage: Matrix4) {
    const members: number[][] = meshes.map(() => []);
    bodies.forEach(({ mesh }, index) => members[mesh].push(index));
    this.shapes = meshes.map((mesh, index) => new Shape(mesh, members[index], this.surface, this.lines, toStage));
    for (const { surface, lines } of this.shapes) this.group.add(surface, lines);
  }

  moveTo(time: number): void {
    const pose = new Matrix4();
    for (const shape of this.shapes) {
      shape.members.forEach((body, index) => {
        const { track } = this.bodies[body];
        if (this.isStale || track.count > 1) shape.place(index, this.absent.has(body) ? undefined : track.at(time, pose));
      });
      shape.update();
    }
    this.isStale = false;
  }

  /** The bodies that are drawn by others. Takes effect with the next call of moveTo. */
  leaveOut(bodies: readonly number[]): void {
    this.absent = new Set(bodies);
    this.isStale = true;
  }

  look(look: Look): void {
    const isDim = look === "dim";
    this.group.visible = look !== "hidden";
    const dim = (material: MeshLambertMaterial | LineBasicMaterial, opacity: number) => {
      material.transparent = isDim;
      material.opacity = isDim ? opacity : 1;
      material.depthWrite = !isDim;
      material.needsUpdate = true;
    };
    const opacity = this.bodies.length > manyBodies ? 0.05 : 0.1;
    dim(this.surface, opacity);
    dim(this.lines, 1.4 * opacity);
  }

  paint(colours: Colours): void {
    this.lines.color.set(colours.edge);
    const [moving, resting] = [new Color(colours.body), new Color(colours.resting)];
    for (const { surface, members } of this.shapes) {
      members.forEach((body, index) => surface.setColorAt(index, this.bodies[body].track.count > 1 ? moving : resting));
      if (surface.instanceColor) surface.instanceColor.needsUpdate = true;
    }
  }

  get surfaces(): InstancedMesh[] {
    return this.shapes.map(({ surface }) => surface);
  }

  /** The index of the body that is an instance of a surface. */
  bodyOf(surface: InstancedMesh, instance: number): number {
    return this.shapes.find((shape) => shape.surface === surface)!.members[instance];
  }
}
