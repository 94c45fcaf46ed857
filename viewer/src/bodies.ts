// The two bodies, the ghosts of the moving body at its start and goal, and the paths of the centres of both bodies.
import { BufferGeometry, type Group, Line, LineBasicMaterial, LineSegments, type Matrix4, Mesh, MeshLambertMaterial, type Vector3 } from "three";
import type { Colours } from "./colours";
import { type DrawnMesh, drawnMesh, frame, pushedBack } from "./meshes";
import type { PackedBody, PoseRow, Scene } from "./scene";
import { Track, unpackedNumbers } from "./track";

export class Body {
  readonly group: Group;
  readonly path: Line;
  private readonly surface = new MeshLambertMaterial({
    flatShading: true,
    ...pushedBack,
  });
  private readonly lines = new LineBasicMaterial();
  private readonly pathLine = new LineBasicMaterial({ transparent: true, opacity: 0.55 });

  constructor(readonly mesh: DrawnMesh, readonly track: Track) {
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

  dispose(): void {
    for (const part of [this.surface, this.lines, this.pathLine, this.path.geometry]) part.dispose();
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
    const bodyOf = (packed: PackedBody, at: PoseRow | undefined) => {
      const exact = time !== undefined && at ? { time, pose: at } : undefined;
      return new Body(meshes[packed.mesh], new Track(unpackedNumbers(packed.poses), undefined, exact));
    };
    this.moving = bodyOf(scene.moving, pose);
    this.fixed = bodyOf(scene.fixed, scene.fixed_pose);
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
