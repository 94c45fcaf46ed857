// What the hand did since the start: one entry for each drag, each of which can be undone.
import { areEqual, type Pose } from "./poses";
import type { Step } from "./protocol";

interface Drag {
  from: Pose;
  goals: Pose[]; // one an update
  reached: Pose[];
  way: Pose[]; // from `from` through the ends of all proven pieces
}

export class Session {
  private drags: Drag[] = [];

  constructor(public start: Pose) {}

  begin(pose: Pose): void {
    this.dropEmpty();
    this.drags.push({ from: pose, goals: [], reached: [], way: [pose] });
  }

  add(goal: Pose, step: Step): void {
    const drag = this.drags.at(-1)!;
    drag.goals.push(goal);
    drag.reached.push(step.pose);
    for (const pose of step.way) if (!areEqual(pose, drag.way.at(-1)!)) drag.way.push(pose);
  }

  /** Where the body was before the last drag, which is forgotten. */
  undo(): Pose | undefined {
    this.dropEmpty();
    return this.drags.pop()?.from;
  }

  get count(): number {
    return this.drags.filter(({ goals }) => goals.length > 0).length;
  }
  /** How many goals and proven pieces there are. */
  get sizes(): { goals: number; pieces: number } {
    const sum = (sizeOf: (drag: Drag) => number) => this.drags.reduce((total, drag) => total + sizeOf(drag), 0);
    return { goals: sum(({ goals }) => goals.length), pieces: sum(({ way }) => way.length - 1) };
  }
  get goals(): Pose[] {
    return this.drags.flatMap(({ goals }) => goals);
  }
  get reached(): Pose[] {
    return this.drags.flatMap(({ reached }) => reached);
  }

  /** The way of the body: one, as each drag begins where the last one ended. */
  get way(): Pose[] {
    const all = [this.start, ...this.drags.flatMap(({ way }) => way)];
    return all.filter((pose, index) => index === 0 || !areEqual(pose, all[index - 1]));
  }

  /** The ways of the hand: straight from goal to goal, once for each drag. */
  get handWays(): Pose[][] {
    return this.drags.filter(({ goals }) => goals.length > 0).map(({ from, goals }) => [from, ...goals]);
  }

  private dropEmpty(): void {
    if (this.drags.at(-1)?.goals.length === 0) this.drags.pop();
  }
}
