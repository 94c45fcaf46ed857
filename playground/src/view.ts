// The picture of a scene. The scene is shifted to its middle and scaled to radius one, as the viewer's stage wants it.
import { Box3, Group, Matrix4, Plane, Ray, Raycaster, Sphere, Vector2, Vector3 } from "three";
import { Stage } from "../../viewer/src/stage";
import { ContactMarks, cornersOf, DrawnBody, HandLine, type Kind, markerSize, type Palette } from "./drawing";
import { carried, type Pose } from "./poses";
import type { ContactShown, Opened } from "./protocol";
import type { PlaygroundScene } from "./scenes";
import { quantile } from "./timings";

const longestArrow = 0.4; // of the radius of the scene
const slowFrame = 24; // milliseconds
const leastSharpness = 0.35;
const framesToJudge = 10;
const names = ["moving", "fixed", "ground", "contact", "edge", "text", "background"] as const;

function currentPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()])) as unknown as Palette;
}

function kindOf({ spec, glass, ground }: PlaygroundScene, name: string): Kind {
  if (name === spec.moving || spec.bodies.some((body) => body.name === name && body.isPart)) return "moving";
  return glass.includes(name) ? "glass" : ground.includes(name) ? "ground" : "fixed";
}

export class View {
  private readonly stage: Stage;
  private readonly world = new Group(); // in the lengths of the scene
  private readonly marks = new ContactMarks();
  private readonly hand = new HandLine();
  private bodies: DrawnBody[] = [];
  private draggable: string[] = [];
  private ball = new Sphere(new Vector3(), 1);
  private blocking = "";
  private sharpness = 1; // while something is dragged
  private isSharp = true;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas, new Sphere(new Vector3(), 1), () => this.resizeMarks());
    this.world.matrixAutoUpdate = false;
    this.world.add(this.marks.group, this.hand.group);
    this.stage.scaled.add(this.world);
    this.hand.show();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  /** The radius of the scene. */
  get radius(): number {
    return this.ball.radius;
  }

  /** Shows a scene, from where it was looked at before if it is the same one. */
  open(scene: PlaygroundScene, { bodies }: Opened, pose: Pose, isSame = false): void {
    for (const body of this.bodies) {
      this.world.remove(body.group);
      body.dispose();
    }
    this.bodies = bodies.map((shape) => new DrawnBody(shape, kindOf(scene, shape.name)));
    this.world.add(...this.bodies.map(({ group }) => group));
    this.draggable = [scene.spec.moving, ...(scene.arm?.joints ?? []).map(({ link }) => link)];
    if (!isSame) this.frame(scene);
    this.moveTo(pose);
    this.showContacts([], []);
    this.showHand();
    this.paint();
    if (!isSame) this.lookFrom(scene.view);
    this.stage.drawNow(); // a pointer may come before the next frame
  }

  /** Shifts and scales the whole scene, as it is at its start. */
  private frame(scene: PlaygroundScene): void {
    this.moveTo(scene.spec.start);
    const whole = new Box3().setFromPoints(this.corners());
    this.ball = whole.getBoundingSphere(new Sphere());
    if (!(this.ball.radius > 0)) this.ball.radius = 1;
    const unit = 1 / this.ball.radius;
    this.world.matrix.makeScale(unit, unit, unit).multiply(new Matrix4().makeTranslation(this.ball.center.clone().negate()));
    this.world.matrixWorldNeedsUpdate = true;
  }

  /** Looks at the whole scene from a direction. */
  lookFrom(direction: number[]): void {
    this.stage.lookAt(this.corners().map((corner) => corner.applyMatrix4(this.world.matrix)), undefined, new Vector3(...direction));
  }

  /** Turns the camera around the middle, or nearer to it, by keys. */
  orbit(right: number, upwards: number, nearer = 1): void {
    this.stage.orbit(right, upwards, nearer);
  }

  moveTo(pose: Pose): void {
    for (const body of this.bodies) if (body.kind === "moving") body.moveTo(pose);
    this.draw();
  }

  showContacts(contacts: ContactShown[], blocking: string[]): void {
    this.marks.show(contacts);
    const key = blocking.join("\n");
    if (key !== this.blocking) {
      this.blocking = key;
      this.paint();
    }
    this.draw();
  }

  showHand(ends?: { from: Vector3; to: Vector3 }): void {
    this.hand.show(ends);
    this.draw();
  }

  draw(): void {
    this.stage.draw();
  }

  /** Without a graphics card many pixels take long: while something is dragged, slow frames get fewer of them. */
  keepUp(frames: number[]): void {
    const last = frames.slice(-framesToJudge);
    if (last.length === framesToJudge && quantile(last, 0.5) > slowFrame && this.sharpness > leastSharpness) {
      this.sharpness = Math.max(leastSharpness, 0.7 * this.sharpness);
      frames.splice(0);
      this.isSharp = true;
    }
    if (this.isSharp && this.sharpness < 1) this.stage.setSharpness(this.sharpness);
    this.isSharp = this.sharpness === 1;
  }

  /** All pixels again. */
  sharpen(): void {
    if (!this.isSharp) this.stage.setSharpness(1);
    this.isSharp = true;
  }

  /** What can be dragged under the pointer, and the place on it in the scene, if no other body is in front of it. */
  onPart(event: { clientX: number; clientY: number }): { name: string; place: Vector3 } | undefined {
    const solid = this.bodies.filter(({ kind }) => kind !== "glass");
    const [hit] = this.stage.under(event as PointerEvent, solid.map(({ mesh }) => mesh));
    const body = hit && solid.find(({ mesh }) => mesh === hit.object);
    return body && this.draggable.includes(body.shape.name) ? { name: body.shape.name, place: this.toScene(hit.point) } : undefined;
  }

  /** Where the pointer is on the plane through a place of the scene: parallel to the picture, or with this normal. */
  onPlane(event: { clientX: number; clientY: number }, place: Vector3, normal?: Vector3): Vector3 | undefined {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const at = new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.stage.camera);
    const ray = new Ray(this.toScene(caster.ray.origin), caster.ray.direction);
    const facing = normal && Math.abs(normal.dot(this.axes().back)) > 0.2 ? normal : this.axes().back;
    return ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(facing, place), new Vector3()) ?? undefined;
  }

  /** The normal of the plane along an axis that is seen best. */
  facing(axis: Vector3): Vector3 {
    const { back } = this.axes();
    return back.addScaledVector(axis, -back.dot(axis)).normalize();
  }

  /** The directions of the picture, in the scene. */
  axes(): { right: Vector3; up: Vector3; back: Vector3 } {
    const [right, up, back] = [new Vector3(), new Vector3(), new Vector3()];
    this.stage.camera.updateMatrixWorld();
    this.stage.camera.matrixWorld.extractBasis(right, up, back);
    return { right, up, back };
  }

  /** Where a point of the part is on the screen. */
  onScreen(pose: Pose, point: Vector3): { x: number; y: number } {
    this.stage.camera.updateMatrixWorld();
    const seen = carried(pose, point).applyMatrix4(this.world.matrix).project(this.stage.camera);
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return { x: left + ((seen.x + 1) / 2) * width, y: top + ((1 - seen.y) / 2) * height };
  }

  private paint(): void {
    const palette = currentPalette();
    const blocking = this.blocking.split("\n");
    for (const body of this.bodies) body.paint(palette, blocking.includes(body.shape.name));
    this.marks.paint(palette);
    this.hand.paint(palette);
    this.stage.setBackground(palette.background);
  }

  private toScene(place: Vector3): Vector3 {
    return place.clone().multiplyScalar(this.ball.radius).add(this.ball.center);
  }

  private corners(): Vector3[] {
    return this.bodies.flatMap(({ shape, group }) => {
      const box = new Box3(new Vector3(...shape.lower), new Vector3(...shape.upper));
      return cornersOf(box).map((corner) => corner.applyMatrix4(group.matrix));
    });
  }

  private resizeMarks(): void {
    const sizeAt = markerSize(this.stage.camera.position, this.world.matrix, 1 / this.ball.radius);
    this.marks.resize(sizeAt, longestArrow * this.ball.radius);
    this.hand.resize(sizeAt);
  }
}
