// The pose of a body at a time: interpolated between sampled poses, and exactly the pose of the answer at the contact.
import { Matrix4, Quaternion, Vector3 } from "three";
import { unpacked, type PoseRow } from "./scene";

const numbersOfPose = 7;
const turnOfArc = Math.PI / 60; // a path of turning points is drawn in steps of this turn
const one = new Vector3(1, 1, 1);

interface Pose {
  translation: Vector3;
  rotation: Quaternion;
}

const newPose = (): Pose => ({ translation: new Vector3(), rotation: new Quaternion() });
const from = newPose(); // used again for every pose, because a scene moves thousands of bodies
const to = newPose();

function read(pose: Pose, row: PoseRow, at = 0): Pose {
  pose.translation.set(row[at], row[at + 1], row[at + 2]);
  pose.rotation.set(row[at + 4], row[at + 5], row[at + 6], row[at + 3]);
  return pose;
}

function matrixOf({ translation, rotation }: Pose, result: Matrix4): Matrix4 {
  return result.compose(translation, rotation, one);
}

/** The index of the interval that contains the time: that of the last entry which is not after it. */
function intervalAt(times: Float64Array, time: number): number {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

export function unpackedNumbers(text: string): Float64Array {
  return new Float64Array(unpacked(text));
}

export class Track {
  readonly count: number;

  /** `rows` has seven numbers per pose. Without `times`, the poses are at equal time steps from 0 to 1. */
  constructor(
    private readonly rows: Float64Array,
    private readonly times?: Float64Array,
    private readonly exact?: { time: number; pose: PoseRow },
  ) {
    this.count = rows.length / numbersOfPose;
  }

  /** The pose of the body's frame in the world at a time. */
  at(time: number, result = new Matrix4()): Matrix4 {
    if (time === this.exact?.time) return matrixOf(read(from, this.exact.pose), result);
    if (this.count === 1) return this.sample(0, result);
    return this.between(...this.place(time), result);
  }

  sample(index: number, result = new Matrix4()): Matrix4 {
    return matrixOf(read(from, this.rows, index * numbersOfPose), result);
  }

  /** Poses along the whole motion, close enough that lines between their points look like arcs; about `most` of them. */
  along(most = Infinity): Matrix4[] {
    const last = this.count - 1;
    const places: [number, number][] = [];
    for (let index = 0; index < last; ++index) {
      const parts = Math.max(1, Math.ceil(this.turn(index) / turnOfArc));
      for (let part = 0; part < parts; ++part) places.push([index, part / parts]);
    }
    const nth = Math.max(1, Math.ceil(places.length / Math.max(1, most - 1)));
    return [...places.filter((_, index) => index % nth === 0).map(([index, part]) => this.between(index, part)), this.sample(last)];
  }

  /** The path of a point of the body, in the world. */
  pathOf(point: Vector3): Vector3[] {
    return this.along().map((pose) => point.clone().applyMatrix4(pose));
  }

  private between(index: number, part: number, result = new Matrix4()): Matrix4 {
    read(from, this.rows, index * numbersOfPose);
    read(to, this.rows, (index + 1) * numbersOfPose);
    from.translation.lerp(to.translation, part);
    from.rotation.slerp(to.rotation, part);
    return matrixOf(from, result);
  }

  /** The turn from a pose to the next one, in radians. */
  private turn(index: number): number {
    read(from, this.rows, index * numbersOfPose);
    read(to, this.rows, (index + 1) * numbersOfPose);
    return from.rotation.angleTo(to.rotation);
  }

  /** The index of the pose before a time, and the part of the step to the next pose. */
  private place(time: number): [number, number] {
    if (!this.times) {
      const place = time * (this.count - 1);
      const index = Math.min(Math.floor(place), this.count - 2);
      return [index, place - index];
    }
    const index = intervalAt(this.times, time);
    const part = (time - this.times[index]) / (this.times[index + 1] - this.times[index]);
    return [index, Math.min(Math.max(part, 0), 1)];
  }
}
