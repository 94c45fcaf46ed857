// Poses as seven numbers: x y z, and the quaternion qw qx qy qz.
import { Matrix4, Quaternion, Vector3 } from "three";

export type Pose = number[];

const one = new Vector3(1, 1, 1);

export const placeOf = (pose: readonly number[]) => new Vector3(pose[0], pose[1], pose[2]);
export const turnOf = (pose: Pose) => new Quaternion(pose[4], pose[5], pose[6], pose[3]).normalize();

export function poseOf(place: Vector3, turn: Quaternion): Pose {
  const { x, y, z, w } = turn.clone().normalize();
  return [place.x, place.y, place.z, w, x, y, z];
}

export function matrixOf(pose: Pose, result = new Matrix4()): Matrix4 {
  return result.compose(placeOf(pose), turnOf(pose), one);
}

/** Where a point of the body is. */
export const carried = (pose: Pose, point: Vector3) => point.clone().applyQuaternion(turnOf(pose)).add(placeOf(pose));

/** The pose with this turn that has a point of the body at a place. */
export function poseWith(turn: Quaternion, point: Vector3, place: Vector3): Pose {
  return poseOf(place.clone().sub(point.clone().applyQuaternion(turn)), turn);
}

/** A turn as a vector along its axis, as long as its angle. */
export function turnBy(vector: Vector3): Quaternion {
  const angle = vector.length();
  return angle === 0 ? new Quaternion() : new Quaternion().setFromAxisAngle(vector.clone().divideScalar(angle), angle);
}

/** The same turn, but at most so far from another one. */
export function turnNear(turn: Quaternion, other: Quaternion, most: number): Quaternion {
  const angle = other.angleTo(turn);
  return angle <= most ? turn.clone() : other.clone().slerp(turn, most / angle);
}

/** What `inner` is when it is carried by `outer`. */
export function product(outer: Pose, inner: Pose): Pose {
  return poseOf(carried(outer, placeOf(inner)), turnOf(outer).multiply(turnOf(inner)));
}

/** `pose` as seen from `from`. */
export function relative(from: Pose, pose: Pose): Pose {
  const back = turnOf(from).invert();
  return poseOf(placeOf(pose).sub(placeOf(from)).applyQuaternion(back), back.clone().multiply(turnOf(pose)));
}

/** The angle of a turn about an axis of length one, in (-pi, pi]. */
export function angleAbout(axis: Vector3, { x, y, z, w }: Quaternion): number {
  const angle = 2 * Math.atan2(axis.dot(new Vector3(x, y, z)), w);
  return angle - 2 * Math.PI * Math.ceil((angle - Math.PI) / (2 * Math.PI));
}

export const areEqual = (a: Pose, b: Pose) => a.every((value, index) => value === b[index]);
