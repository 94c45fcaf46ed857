// The hand: holds the part, asks for updates as long as anything changes, and shows what they did.
import { Vector3 } from "three";
import { Engine, EngineError } from "./engine";
import { Grip, Inertia } from "./grip";
import { carried, placeOf, type Pose, turnOf } from "./poses";
import type { Opened, Step } from "./protocol";
import type { PlaygroundScene } from "./scenes";
import { Session } from "./session";
import { Timings } from "./timings";

const budget = 0.002; // seconds; an update starts no further round after this time
const still = 2e-6; // of the size of the part: less than this is no motion

export interface Shown {
  /** After each update, and whenever the part is placed. */
  moved(pose: Pose, step?: Step): void;
  /** The part has been let go. */
  released(): void;
  /** The library or a worker has failed; the scene is open again as it was before. */
  failed(error: Error): void;
}

export class Hand {
  readonly timings = new Timings();
  session!: Session;
  scene!: PlaygroundScene;
  opened!: Opened;
  pose!: Pose;
  isLoose = false;
  isTurning = false;
  grip?: Grip;
  inertia!: Inertia;
  size = 1; // of the part
  private engine = new Engine();
  private inFlight: Promise<void> = Promise.resolve();
  private isBusy = false;
  private hasChanged = false;
  private isLooping = false;
  private rest: (() => void)[] = [];

  constructor(private readonly shown: Shown) {}

  load(): Promise<unknown> {
    return this.engine.ask("load", {});
  }

  /** Opens a scene. If the library refuses, the one before stays open, and the error is thrown. */
  async open(scene: PlaygroundScene, start = scene.spec.start, pose = start): Promise<void> {
    await this.letGo();
    const spec = { ...scene.spec, start };
    this.opened = await this.engine.ask("open", { scene: spec, pose });
    this.scene = { ...scene, spec };
    this.session = new Session(start);
    this.pose = pose;
    this.isLoose = scene.handling.isLoose;
    const { moving } = this.opened;
    const [lower, upper] = [placeOf(moving.lower), placeOf(moving.upper)];
    this.inertia = new Inertia(lower, upper);
    this.size = upper.distanceTo(lower);
    // a linked pose was reached before, by a way that nobody knows here
    if (pose !== start) this.session = new Session(pose);
  }

  /** Takes the part at one of its points, which is given in the scene. */
  async take(place: Vector3): Promise<void> {
    await this.letGo();
    const { lock } = this.scene.spec;
    const [plane, axis] = [this.scene.handling.plane, this.scene.handling.axis].map((normal) => normal && new Vector3(...normal));
    this.session.begin(this.pose);
    this.grip = new Grip(this.inertia, place, this.pose, lock ? { isLoose: false, lock } : { isLoose: this.isLoose, plane, axis });
    this.timings.begin();
    this.hasChanged = true;
    if (!this.isLooping) requestAnimationFrame((time) => this.frame(time));
    this.isLooping = true;
  }

  async letGo(): Promise<void> {
    this.grip = undefined;
    this.hasChanged = false;
    this.shown.released();
    await this.inFlight;
  }

  /** The hand has moved. */
  changed(): void {
    this.hasChanged = true;
  }

  /** Where the hand pulls, for the picture. */
  get line(): { from: Vector3; to: Vector3 } | undefined {
    if (!this.grip || this.isTurning) return undefined;
    return { from: carried(this.pose, this.grip.point), to: this.grip.place };
  }

  /** Ends when the part has come to rest. */
  atRest(): Promise<void> {
    return this.isBusy || this.hasChanged ? new Promise((resolve) => this.rest.push(resolve)) : Promise.resolve();
  }

  async undo(): Promise<boolean> {
    await this.letGo();
    const pose = this.session.undo();
    if (pose) await this.place(pose);
    return pose !== undefined;
  }

  async reset(): Promise<void> {
    await this.letGo();
    this.session = new Session(this.scene.spec.start);
    await this.place(this.scene.spec.start);
  }

  private async place(pose: Pose): Promise<void> {
    await this.engine.ask("place", { pose });
    this.pose = pose;
    this.shown.moved(pose);
  }

  private frame(time: number): void {
    this.isLooping = this.grip !== undefined;
    if (!this.grip) return this.nowAtRest();
    this.timings.frame(time);
    if (!this.isBusy && this.hasChanged) this.inFlight = this.update(this.grip);
    requestAnimationFrame((next) => this.frame(next));
  }

  private async update(grip: Grip): Promise<void> {
    this.isBusy = true;
    this.hasChanged = false;
    const { session } = this;
    const before = this.pose;
    const goal = grip.goal(before, this.isTurning);
    try {
      const step = await this.engine.ask("update", { goal, seconds: budget });
      session.add(goal, step);
      this.timings.update(step.milliseconds);
      this.pose = step.pose;
      if (step.state === "moving" || this.distance(before, step.pose) > still * this.size) this.hasChanged = true;
      this.shown.moved(step.pose, step);
    } catch (error) {
      await this.recover(error as EngineError);
    }
    this.isBusy = false;
    if (!this.hasChanged || !this.grip) this.nowAtRest();
  }

  private nowAtRest(): void {
    if (this.isBusy) return;
    if (!this.grip) this.hasChanged = false;
    for (const resolve of this.rest.splice(0)) resolve();
  }

  /** Input that is refused changes nothing. After any other fault a new worker opens the scene where the part was. */
  private async recover(error: EngineError): Promise<void> {
    this.grip = undefined;
    if (!error.isInput) {
      this.engine.stop();
      this.engine = new Engine();
      await this.engine.ask("open", { scene: this.scene.spec, pose: this.pose });
    }
    this.shown.failed(error);
  }

  private distance(a: Pose, b: Pose): number {
    return placeOf(a).distanceTo(placeOf(b)) + this.size * turnOf(a).angleTo(turnOf(b));
  }
}
