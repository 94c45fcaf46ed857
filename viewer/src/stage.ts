// Camera, light and drawing. The scene is shifted to its centre and scaled to radius one in double precision. The
// graphics card computes in single precision; without the shift and the scale, distant or tiny bodies would lose digits.
import {
  Box3,
  DirectionalLight,
  Group,
  HemisphereLight,
  Matrix4,
  type Object3D,
  PerspectiveCamera,
  Raycaster,
  Scene as ThreeScene,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { byId, onClick } from "./elements";

const fieldOfView = 32;
const filledPart = 0.86; // of the picture
const usualDirection = new Vector3(0.55, -1, 0.5).normalize();

export class Stage {
  /** Holds objects in world coordinates. */
  readonly world = new Group();
  /** Holds objects whose coordinates are those of the shifted and scaled scene. */
  readonly scaled = new Group();
  readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.001, 200);
  private readonly scene = new ThreeScene();
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly sky = new HemisphereLight(0xffffff, 0x8a8f98, 1.5);
  private readonly sun = new DirectionalLight(0xffffff, 1.9);
  private drawing = false;

  constructor(private readonly canvas: HTMLCanvasElement, readonly whole: Sphere, private readonly beforeDrawing: () => void) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera.up.set(0, 0, 1);
    this.sky.position.set(0, 0, 1);
    this.scene.add(this.world, this.scaled, this.sky, this.camera);
    this.camera.add(this.sun);
    this.sun.position.set(-1.2, 1.6, 2);
    this.world.matrixAutoUpdate = false;
    this.world.matrix.makeScale(this.unit, this.unit, this.unit).multiply(
      new Matrix4().makeTranslation(whole.center.clone().negate()),
    );
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  /** The length of one mesh unit in the scene. */
  get unit(): number {
    return 1 / this.whole.radius;
  }

  /**
   * Points the camera at `points` (world coordinates) so that they fill the picture. If `along` is given, the camera looks
   * nearly perpendicular to it. `from` is the direction towards the camera.
   */
  lookAt(points: Vector3[], along?: Vector3, from = usualDirection): void {
    const back = from.clone().normalize();
    if (along) back.addScaledVector(along, -0.85 * back.dot(along));
    back.setZ(Math.max(back.z, 0.3)).normalize(); // from above
    const right = this.camera.up.clone().cross(back).normalize();
    const frame = new Matrix4().makeBasis(right, back.clone().cross(right), back);
    const toFrame = frame.clone().invert();
    const seen = points.map((point) =>
      point.clone().sub(this.whole.center).multiplyScalar(this.unit).applyMatrix4(toFrame),
    );
    const middle = new Box3().setFromPoints(seen).getCenter(new Vector3());
    const slope = Math.tan((fieldOfView / 2 / 180) * Math.PI) * filledPart;
    const distanceFor = ({ x, y, z }: Vector3) => {
      const off = Math.max(Math.abs(x - middle.x) / this.camera.aspect, Math.abs(y - middle.y));
      return off / slope + z - middle.z;
    };
    const distance = Math.max(...seen.map(distanceFor));
    this.controls.target.copy(middle).applyMatrix4(frame);
    this.camera.position.copy(this.controls.target).addScaledVector(back, distance);
    this.controls.update();
    this.draw();
  }

  /** Turns the camera around what it looks at, by angles to the right and upwards, and changes its distance. */
  orbit(right: number, upwards: number, farther: number): void {
    const { target } = this.controls;
    const back = this.camera.position.clone().sub(target).multiplyScalar(farther);
    const tilt = Math.asin(back.z / back.length());
    const steepest = 1.55;
    const up = Math.min(Math.max(tilt + upwards, -steepest), steepest) - tilt;
    const side = this.camera.up.clone().cross(back).normalize();
    back.applyAxisAngle(side, -up).applyAxisAngle(this.camera.up, right);
    this.camera.position.copy(target).add(back);
    this.controls.update();
    this.draw();
  }

  /** What the pointer is on, nearest first. */
  under({ clientX, clientY }: PointerEvent, objects: Object3D[]) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const place = new Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    return ray.intersectObjects(objects);
  }

  /** Draws with a share of the pixels along each side. */
  setSharpness(share: number): void {
    this.renderer.setPixelRatio(share * Math.min(devicePixelRatio, 2));
    this.draw();
  }

  setBackground(colour: string): void {
    this.renderer.setClearColor(colour);
    this.draw();
  }

  /** Draws at the next frame. Several calls before this frame cause one drawing. */
  draw(): void {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow(): void {
    this.drawing = false;
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 500;
    this.camera.far = distance + 20;
    this.camera.updateProjectionMatrix();
    this.scene.updateMatrixWorld();
    this.beforeDrawing();
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.draw();
  }
}

/** Connects the button "See through". */
export function connectSeeThrough(stage: Stage, seeThrough: (isOn: boolean) => void): void {
  const button = byId("see-through");
  onClick("see-through", () => {
    const isOn = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(isOn));
    seeThrough(isOn);
    stage.draw();
  });
}

/** A sphere around all points. Its radius is never 0. */
export function ballAround(points: Vector3[]): Sphere {
  const ball = new Box3().setFromPoints(points).getBoundingSphere(new Sphere());
  if (!(ball.radius > 0)) ball.radius = 1;
  return ball;
}
