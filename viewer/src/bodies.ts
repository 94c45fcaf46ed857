// The two bodies, the ghosts of the moving body at its start and goal, and the paths of the centres of both bodies.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type Matrix4,
  Vector3,
} from "three";
import { type PackedBody, type PackedMesh, type PoseRow, type Scene, unpacked } from "./scene";
import { Track } from "./track";
import type { Colours } from "./colours";

interface DrawnMesh {
  surface: BufferGeometry;
  creases: BufferGeometry;
  origin: Vector3;
}

/** Surfaces are two-sided, because meshes may be open. A depth offset draws them behind their crease lines. */
const pushedBack = { side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 } as const;

function drawnMesh(packed: PackedMesh): DrawnMesh {
  const vertices = new BufferAttribute(new Float32Array(unpacked(packed.vertices)), 3);
  const geometry = (indices: string) => {
    const made = new BufferGeometry().setAttribute("position", vertices);
    return made.setIndex(new BufferAttribute(new Uint32Array(unpacked(indices)), 1));
  };
  const surface = geometry(packed.triangles);
  surface.computeBoundingBox();
  surface.computeBoundingSphere();
  return { surface, creases: geometry(packed.creases), origin: new Vector3(...packed.origin) };
}

/** The group's matrix is the pose of the body's frame. `origin` is the position of the mesh in this frame. */
function frame(origin: Vector3, ...children: (Mesh | LineSegments)[]): Group {
  const group = new Group();
  group.matrixAutoUpdate = false;
  for (const child of children) {
    child.position.copy(origin);
    group.add(child);
  }
  return group;
}

export class Body {
  readonly group: Group;
  readonly path: Line;
  readonly track: Track;
  private readonly surface = new MeshLambertMaterial({
    flatShading: true,
    ...pushedBack,
  });
  private readonly lines = new LineBasicMaterial();
  private readonly pathLine = new LineBasicMaterial({ transparent: true, opacity: 0.55 });

  constructor(readonly mesh: DrawnMesh, body: PackedBody, exact: { time: number; pose: PoseRow } | undefined) {
    this.track = new Track(body.poses, exact);
    this.group = frame(mesh.origin, new Mesh(mesh.surface, this.surface), new LineSegments(mesh.creases, this.lines));
    this.path = new Line(new BufferGeometry(), this.pathLine);
  }

  moveTo(time: number): void {
    this.moveBy(this.track.at(time));
  }

  /** Line vertices are in single precision, so they are relative to a nearby centre. */
  drawPath(centre: Vector3): void {
    const points = this.track.pathOf(this.mesh.origin).map((point) => point.sub(centre));
    this.path.geometry.setFromPoints(points);
    this.path.position.copy(centre);
  }

  paint(colour: string, edge: string): void {
    this.surface.color.set(colour);
    this.lines.color.set(edge);
    this.pathLine.color.set(colour);
  }

  seeThrough(isOn: boolean): void {
    this.surface.transparent = isOn;
    this.surface.opacity = isOn ? 0.35 : 1;
    this.surface.depthWrite = !isOn;
    this.surface.needsUpdate = true;
    this.lines.transparent = isOn;
    this.lines.opacity = isOn ? 0.45 : 1;
    this.lines.needsUpdate = true;
  }

  private moveBy(matrix: Matrix4): void {
    this.group.matrix.copy(matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }
}

/** The moving body at its start or goal, transparent. The depth is drawn first, so that only its front layer shows. */
export class Ghost {
  readonly group: Group;
  private readonly veil = new MeshLambertMaterial({ flatShading: true, ...pushedBack, transparent: true, depthWrite: false });
  private readonly lines = new LineBasicMaterial({ transparent: true, depthWrite: false });

  constructor(mesh: DrawnMesh, matrix: Matrix4, opacity: number) {
    const depth = new Mesh(mesh.surface, new MeshLambertMaterial({ colorWrite: false, ...pushedBack }));
    const veil = new Mesh(mesh.surface, this.veil);
    const lines = new LineSegments(mesh.creases, this.lines);
    this.veil.opacity = opacity;
    this.lines.opacity = Math.min(1, 1.6 * opacity);
    [depth, veil, lines].forEach((part, order) => (part.renderOrder = order + 1));
    this.group = frame(mesh.origin, depth, veil, lines);
    this.group.matrix.copy(matrix);
  }

  paint(colour: string): void {
    this.veil.color.set(colour);
    this.lines.color.set(colour);
  }
}

export class Bodies {
  readonly moving: Body;
  readonly fixed: Body;
  readonly ghosts: Ghost[];

  constructor(scene: Scene) {
    const meshes = scene.meshes.map(drawnMesh);
    const { time, pose } = scene.answer;
    const exact = (of: PoseRow | undefined) => (time !== undefined && of ? { time, pose: of } : undefined);
    this.moving = new Body(meshes[scene.moving.mesh], scene.moving, exact(pose));
    this.fixed = new Body(meshes[scene.fixed.mesh], scene.fixed, exact(scene.fixed_pose));
    const mesh = this.moving.mesh;
    const ghost = (at: number, opacity: number) => new Ghost(mesh, this.moving.track.sample(at), opacity);
    this.ghosts = [ghost(0, 0.26), ghost(this.moving.track.count - 1, 0.16)];
  }

  get groups() {
    return [this.moving.group, this.fixed.group, ...this.ghosts.map(({ group }) => group)];
  }

  moveTo(time: number): void {
    this.moving.moveTo(time);
    this.fixed.moveTo(time);
  }

  seeThrough(isOn: boolean): void {
    this.moving.seeThrough(isOn);
    this.fixed.seeThrough(isOn);
    for (const ghost of this.ghosts) ghost.group.visible = !isOn; // too many transparent layers otherwise
  }

  paint(colours: Colours): void {
    this.moving.paint(colours.moving, colours.edge);
    this.fixed.paint(colours.fixed, colours.edge);
    for (const ghost of this.ghosts) ghost.paint(colours.moving);
  }
}
