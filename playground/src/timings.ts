// How long frames and updates take while something is dragged.

const kept = 20_000;

/** The value that so large a share of the values does not exceed. */
export function quantile(values: number[], share: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0;
}

export class Timings {
  readonly frames: number[] = []; // milliseconds between two of them
  readonly judged: number[] = []; // the same, since the picture was made coarser
  readonly updates: number[] = []; // milliseconds of the library alone
  private last?: number;

  begin(): void {
    this.last = undefined;
  }

  frame(time: number): void {
    if (this.last !== undefined) for (const list of [this.frames, this.judged]) this.keep(list, time - this.last);
    this.last = time;
  }

  update(milliseconds: number): void {
    this.keep(this.updates, milliseconds);
  }

  /** The last few seconds, in words. */
  get words(): string {
    const frames = this.frames.slice(-240);
    const updates = this.updates.slice(-600);
    if (frames.length < 10 || updates.length === 0) return "";
    const rate = 1000 / (frames.reduce((sum, time) => sum + time, 0) / frames.length);
    const [usual, most] = [quantile(updates, 0.5), quantile(updates, 0.99)];
    return `${rate.toFixed(0)} frames a second · half of the updates take up to ${usual.toFixed(1)} ms, 99 % up to ${most.toFixed(1)} ms`;
  }

  private keep(list: number[], value: number): void {
    if (list.length === kept) list.splice(0, kept / 2);
    list.push(value);
  }
}
