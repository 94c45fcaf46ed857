// The pose of a body at a time: interpolated between sampled poses, and exactly the pose of the answer at the contact.
import { Matrix4, Quaternion, Vector3 } from "three";
import { unpacked, type PoseRow } from "./scene";

const numbersOfPose = 7;
const one = new Vector3(1, 1, 1);

interface Pose {
  translation: Vector3;
  rotation: Quaternion;
}

function poseOf(row: PoseRow, at = 0): Pose {
  return {
    translation: new Vector3(row[at], row[at + 1], row[at + 2]),
    rotation: new Quaternion(row[at + 4], row[at + 5], row[at + 6], row[at + 3]),
  };
}

function matrixOf({ translation, rotation }: Pose): Matrix4 {
  return new Matrix4().compose(translation, rotation, one);
}

export class Track {
  private readonly rows: Float64Array;
  readonly count: number;

  constructor(poses: string, private readonly exact?: { time: number; pose: PoseRow }) {
    this.rows = new Float64Array(unpacked(poses));
    this.count = this.rows.length / numbersOfPose;
  }

  /** The pose of the body's frame in the world at a time. */
  at(time: number): Matrix4 {
    if (time === this.exact?.time) return matrixOf(poseOf(this.exact.pose));
    const place = time * (this.count - 1);
    const index = Math.min(Math.floor(place), this.count - 2);
    if (index < 0) return this.sample(0);
    const from = poseOf(this.rows, index * numbersOfPose);
    const to = poseOf(this.rows, (index + 1) * numbersOfPose);
    from.translation.lerp(to.translation, place - index);
    from.rotation.slerp(to.rotation, place - index);
    return matrixOf(from);
  }

  sample(index: number): Matrix4 {
    return matrixOf(poseOf(this.rows, index * numbersOfPose));
  }

  /** The path of a point of the body, in the world. */
  pathOf(point: Vector3): Vector3[] {
    return Array.from({ length: this.count }, (_, index) => point.clone().applyMatrix4(this.sample(index)));
  }
}
