// Mouse and touch: on the part they drag it, elsewhere they turn the view (which is the stage's own).
import { Vector3 } from "three";
import { byId } from "./elements";
import type { Hand } from "./drag";
import type { View } from "./view";

const turnAcross = 1.2 * Math.PI; // radians for a way as long as the picture is high

interface Held {
  pointer: number;
  isTurning: boolean;
  x: number;
  y: number;
  grabbed: Vector3;
  name: string; // of the body under the pointer
}

export class Pointer {
  private held?: Held;
  private readonly stage = byId("stage");

  /** `choose` is told what the pointer is on, and resolves when that can be taken. */
  constructor(
    private readonly view: View, private readonly hand: Hand, private readonly begun: () => void, private readonly choose: (name: string) => Promise<boolean>,
  ) {
    // before the canvas hears of it, whose events turn the view
    this.stage.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    this.stage.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    for (const name of ["pointerup", "pointercancel"] as const)
      this.stage.addEventListener(name, (event) => this.end(event), { capture: true });
    addEventListener("blur", () => this.release());
  }

  private down(event: PointerEvent): void {
    if (!(event.target instanceof HTMLCanvasElement)) return;
    if (this.held) {
      event.stopPropagation(); // a second finger, while the first one holds the part
      return;
    }
    const part = event.button === 1 ? undefined : this.view.onPart(event);
    if (!part) return;
    event.stopPropagation();
    this.stage.setPointerCapture(event.pointerId);
    this.stage.classList.add("is-dragging");
    const isTurning = byId<HTMLInputElement>("mode-turn").checked !== (event.shiftKey || event.button === 2);
    this.held = { pointer: event.pointerId, isTurning, x: event.clientX, y: event.clientY, grabbed: part.place, name: part.name };
    this.begun();
    void this.take(this.held);
  }

  private async take(held: Held): Promise<void> {
    if (!(await this.choose(held.name)) || this.held !== held) return;
    await this.hand.take(held.grabbed);
    if (this.held !== held) return this.hand.letGo(); // the button was up before the part was taken
    this.hand.isTurning = held.isTurning;
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    if (!held) {
      if (event.pointerType === "mouse" && event.buttons === 0) this.stage.classList.toggle("is-over", this.view.onPart(event) !== undefined);
      return;
    }
    event.stopPropagation();
    if (event.pointerId !== held.pointer || !this.hand.grip) return;
    if (held.isTurning) this.turn(held, event);
    else this.pull(held, event);
    held.x = event.clientX;
    held.y = event.clientY;
    this.hand.changed();
  }

  private pull(held: Held, event: PointerEvent): void {
    const { plane } = this.hand.scene.handling;
    const { lock } = this.hand.scene.spec;
    const slides = lock?.kind === "cylinder";
    const normal = slides ? this.view.facing(new Vector3(...lock.direction)) : plane && new Vector3(...plane);
    const place = this.view.onPlane(event, held.grabbed, normal);
    if (place) this.hand.grip?.moveTo(place);
  }

  /** About the axis of the scene if there is one, as a wheel is turned by its rim; otherwise as a ball is rolled. */
  private turn(held: Held, event: PointerEvent): void {
    const perPixel = turnAcross / byId("canvas").clientHeight;
    const [right, down] = [perPixel * (event.clientX - held.x), perPixel * (event.clientY - held.y)];
    const axes = this.view.axes();
    const { axis } = this.hand.scene.handling;
    const free = axes.up.clone().multiplyScalar(right).addScaledVector(axes.right, down);
    const turn = axis ? new Vector3(...axis).multiplyScalar(right) : free;
    this.hand.grip?.turnBy(turn, this.hand.pose);
  }

  private end(event: PointerEvent): void {
    if (this.held?.pointer !== event.pointerId) return;
    event.stopPropagation();
    this.release();
  }

  private release(): void {
    if (!this.held) return;
    this.held = undefined;
    this.stage.classList.remove("is-dragging");
    void this.hand.letGo();
  }
}
