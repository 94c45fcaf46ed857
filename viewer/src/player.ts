// The time that the page shows. It stops at the contact, unless "go through" is set.

/** The first and the last time. */
export interface Span {
  from: number;
  to: number;
}

const secondsOfMotion = 4;
const snapDistance = 0.006; // from the contact, relative to the whole motion

export class Player {
  private now: number;
  private playing = false;
  private through = false;
  private lastFrame = 0;
  private readonly listeners: (() => void)[] = [];

  /** `stop` is the time of the contact; the last time if the motion is clear. */
  constructor(public stop: number, readonly span: Span = { from: 0, to: 1 }) {
    this.now = span.from;
  }

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
    return this.through ? this.span.to : this.stop;
  }

  /** The length of the whole motion in time. */
  get length(): number {
    return this.span.to - this.span.from;
  }
  /** A time as a part of the whole motion, from 0 to 1. */
  partAt(time: number): number {
    return this.length > 0 ? (time - this.span.from) / this.length : 0;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  set(time: number): void {
    this.now = Math.min(Math.max(time, this.span.from), this.end);
    this.notify();
  }

  /** Sets the time; a time close to the contact snaps to the contact. */
  drag(time: number): void {
    this.pause();
    this.set(Math.abs(time - this.stop) < snapDistance * this.length ? this.stop : time);
  }

  /** Steps by a part of the whole motion. A step that would pass the contact ends there. */
  step(part: number): void {
    this.pause();
    const next = this.now + part * this.length;
    const passes = (this.now - this.stop) * (next - this.stop) < 0;
    this.set(passes ? this.stop : next);
  }

  goThrough(may: boolean): void {
    this.through = may;
    this.set(this.now);
  }

  toggle(): void {
    if (this.playing) return this.pause();
    if (this.now >= this.end) this.now = this.span.from;
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
    const next = this.now + (Math.max(0, at - this.lastFrame) / 1000 / secondsOfMotion) * this.length;
    this.lastFrame = at;
    if (next >= this.end) this.playing = false;
    this.set(next);
    if (this.playing) requestAnimationFrame((later) => this.frame(later));
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}
