// The time that the page shows. It stops at the contact, unless "go through" is set.

const secondsOfMotion = 4;
const snapDistance = 0.006; // from the contact, in times of the motion

export class Player {
  private now = 0;
  private playing = false;
  private through = false;
  private lastFrame = 0;
  private readonly listeners: (() => void)[] = [];

  /** `stop` is the time of the contact; 1 if the motion is clear. */
  constructor(readonly stop: number) {}

  get time(): number {
    return this.now;
  }
  get isPlaying(): boolean {
    return this.playing;
  }
  get mayGoThrough(): boolean {
    return this.through;
  }
  get end(): number {
    return this.through ? 1 : this.stop;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  set(time: number): void {
    this.now = Math.min(Math.max(time, 0), this.end);
    this.notify();
  }

  /** Sets the time; a time close to the contact snaps to the contact. */
  drag(time: number): void {
    this.pause();
    this.set(Math.abs(time - this.stop) < snapDistance ? this.stop : time);
  }

  /** Steps by `by`. A step that would pass the contact ends there. */
  step(by: number): void {
    this.pause();
    const next = this.now + by;
    const passes = (this.now - this.stop) * (next - this.stop) < 0;
    this.set(passes ? this.stop : next);
  }

  goThrough(may: boolean): void {
    this.through = may;
    this.set(this.now);
  }

  toggle(): void {
    if (this.playing) return this.pause();
    if (this.now >= this.end) this.now = 0;
    this.playing = true;
    this.lastFrame = performance.now();
    requestAnimationFrame((at) => this.frame(at));
    this.notify();
  }

  pause(): void {
    this.playing = false;
    this.notify();
  }

  private frame(at: number): void {
    if (!this.playing) return;
    const next = this.now + Math.max(0, at - this.lastFrame) / 1000 / secondsOfMotion;
    this.lastFrame = at;
    if (next >= this.end) this.playing = false;
    this.set(next);
    if (this.playing) requestAnimationFrame((later) => this.frame(later));
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}
