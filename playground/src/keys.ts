// The keyboard: moves and turns the part, turns the view, and presses buttons.
import { Vector3 } from "three";
import { centreOf } from "./grip";
import type { Hand } from "./drag";
import type { Lock } from "./protocol";
import type { View } from "./view";

const step = 0.025; // of the radius of the scene
const turnStep = 0.1; // radians
const viewStep = 0.12; // radians
const pause = 700; // milliseconds without a key after which the part is let go

type Direction = "right" | "up" | "back";
const directions: Record<string, [Direction, number]> = {
  ArrowRight: ["right", 1],
  ArrowLeft: ["right", -1],
  ArrowUp: ["up", 1],
  ArrowDown: ["up", -1],
  PageUp: ["back", -1],
  PageDown: ["back", 1],
};
// which way the part turns: as if its front were pushed by the key
const turnAxes: Record<string, [Direction, number]> = {
  ArrowRight: ["up", 1],
  ArrowLeft: ["up", -1],
  ArrowUp: ["right", -1],
  ArrowDown: ["right", 1],
  PageUp: ["back", 1],
  PageDown: ["back", -1],
};

export class Keys {
  private timer = 0;
  private taking?: Promise<void>;

  constructor(private readonly view: View, private readonly hand: Hand, canvas: HTMLCanvasElement, private readonly begun: () => void) {
    canvas.addEventListener("keydown", (event) => this.down(event));
    canvas.addEventListener("blur", () => this.letGo());
  }

  private down(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in directions) {
      event.preventDefault();
      void this.drag(event.key, event.shiftKey);
    } else if (this.turnView(event.key.toLowerCase())) event.preventDefault();
  }

  private async drag(key: string, isTurning: boolean): Promise<void> {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.letGo(), pause);
    await this.hold();
    const { hand } = this;
    hand.isTurning = isTurning;
    const [direction, sign] = (isTurning ? turnAxes : directions)[key];
    const along = this.inScene(this.view.axes()[direction].multiplyScalar(sign), isTurning);
    const { lock } = hand.scene.spec;
    hand.isTurning ||= lock?.kind === "hinge";
    if (isTurning) hand.grip?.turnBy(along.multiplyScalar(turnStep), hand.pose);
    else if (lock?.kind === "hinge") hand.grip?.turnBy(this.turnTowards(along, lock).multiplyScalar(turnStep), hand.pose);
    else hand.grip?.moveBy(along.multiplyScalar(step * this.view.radius));
    hand.changed();
  }

  /** The turn of a hinge that moves the middle of its body in this direction, rather than back. */
  private turnTowards(along: Vector3, { direction, point }: Lock): Vector3 {
    const axis = new Vector3(...direction);
    const lever = centreOf(this.hand.inertia, this.hand.pose).sub(new Vector3(...point));
    const ahead = axis.clone().cross(lever).dot(along);
    return axis.multiplyScalar(Math.sign(ahead) || 1);
  }

  /** Keys hold the part in its middle. */
  private async hold(): Promise<void> {
    if (!this.taking) {
      this.begun();
      this.taking = this.hand.take(centreOf(this.hand.inertia, this.hand.pose));
    }
    await this.taking;
  }

  private letGo(): void {
    clearTimeout(this.timer);
    if (!this.taking) return;
    this.taking = undefined;
    void this.hand.letGo();
  }

  /** In a scene with a plane the part moves in it, and with an axis it turns about it. */
  private inScene(way: Vector3, isTurning: boolean): Vector3 {
    const { plane, axis } = this.hand.scene.handling;
    const normal = isTurning ? axis : plane;
    if (!normal) return way;
    const about = new Vector3(...normal);
    if (isTurning) return about.multiplyScalar(Math.sign(way.dot(about)) || 1);
    const along = way.clone().addScaledVector(about, -way.dot(about));
    return along.length() > 0.1 ? along.normalize() : way;
  }

  private turnView(key: string): boolean {
    const turns: Record<string, [number, number, number]> = {
      a: [-viewStep, 0, 1],
      d: [viewStep, 0, 1],
      w: [0, viewStep, 1],
      s: [0, -viewStep, 1],
      "+": [0, 0, 0.88],
      "=": [0, 0, 0.88],
      "-": [0, 0, 1 / 0.88],
    };
    if (!(key in turns)) return false;
    this.view.orbit(...turns[key]);
    return true;
  }
}
