// Camera, light and drawing. The scene is shifted to its middle and scaled to size one in double precision, so that
// neither far nor tiny bodies lose digits on the way to the graphics card.
import {
  Box3,
  DirectionalLight,
  Group,
  HemisphereLight,
  Matrix4,
  PerspectiveCamera,
  Scene as ThreeScene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const fieldOfView = 32;
const usualDirection = new Vector3(0.55, -1, 0.5).normalize();

export class Stage {
  readonly world = new Group();
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
    this.scene.add(this.world, this.sky, this.camera);
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

  /** The length of the mesh's unit in the scene. */
  get unit(): number {
    return 1 / this.whole.radius;
  }

  /** Looks at a ball of the world, across `along` rather than along it, if that is given. */
  lookAt({ center, radius }: Sphere, along?: Vector3): void {
    const direction = usualDirection.clone();
    if (along) direction.addScaledVector(along, -0.85 * direction.dot(along)).normalize();
    const narrower = Math.min(1, this.camera.aspect);
    const distance = (radius * this.unit) / Math.sin((fieldOfView / 2 / 180) * Math.PI) / narrower;
    this.controls.target.copy(center).sub(this.whole.center).multiplyScalar(this.unit);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
    this.controls.update();
    this.draw();
  }

  setBackground(colour: string): void {
    this.renderer.setClearColor(colour);
    this.draw();
  }

  /** With the next frame; many calls make one drawing. */
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

/** Around all boxes, in the world. Never of radius 0. */
export function ballAround(boxes: Box3[]): Sphere {
  const box = boxes.reduce((all, one) => all.union(one), new Box3());
  const ball = box.getBoundingSphere(new Sphere());
  if (!(ball.radius > 0)) ball.radius = 1;
  return ball;
}
