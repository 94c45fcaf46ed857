// Where the hand wants the body: goals for the next update, from a grabbed point and the pointer, or from turns.
import { Matrix3, Quaternion, Vector3 } from "three";
import { carried, placeOf, type Pose, poseWith, turnBy, turnNear, turnOf } from "./poses";

const mostTurn = 0.4; // of one goal of a loose grip, radians
const mostLead = 2; // by which a turned hand may be ahead of the body, radians

/** The size of a body, for how easily it turns. */
export class Inertia {
  readonly centre: Vector3;
  private readonly moments: Vector3; // of the solid box around the body, per mass

  constructor(lower: Vector3, upper: Vector3) {
    this.centre = lower.clone().add(upper).multiplyScalar(0.5);
    const size = upper.clone().sub(lower);
    const least = (0.1 * size.length()) ** 2;
    const moment = (a: number, b: number) => Math.max((a * a + b * b) / 12, least);
    this.moments = new Vector3(moment(size.y, size.z), moment(size.z, size.x), moment(size.x, size.y));
  }

  /** The turn that a force at `lever` from the centre wants, in the world. */
  turnFor(force: Vector3, lever: Vector3, turn: Quaternion): Vector3 {
    const torque = lever.clone().cross(force).applyQuaternion(turn.clone().invert());
    return torque.divide(this.moments).applyQuaternion(turn);
  }
}

/** The body is held at one of its points. In a plane a loose grip neither lifts nor tilts it. */
export class Grip {
  readonly point: Vector3; // of the body
  private wantedTurn: Quaternion;
  private wantedPlace: Vector3; // of the grabbed point

  constructor(private readonly inertia: Inertia, place: Vector3, pose: Pose, private readonly isLoose: boolean, private readonly plane?: Vector3) {
    this.wantedPlace = place.clone();
    if (plane) this.wantedPlace.addScaledVector(plane, centreOf(inertia, pose).sub(place).dot(plane));
    this.wantedTurn = turnOf(pose);
    this.point = this.wantedPlace.clone().sub(placeOf(pose)).applyQuaternion(turnOf(pose).invert());
  }

  get place(): Vector3 {
    return this.wantedPlace.clone();
  }

  /** With a plane, `place` is in it or above it. */
  moveTo(place: Vector3): void {
    const height = this.plane ? this.wantedPlace.dot(this.plane) : 0;
    this.wantedPlace = place.clone();
    if (this.plane) this.wantedPlace.addScaledVector(this.plane, height - place.dot(this.plane));
  }

  moveBy(way: Vector3): void {
    this.wantedPlace.add(way);
  }

  /** The hand does not get further ahead of the body than it can be told from the other way round. */
  turnBy(vector: Vector3, pose: Pose): void {
    this.wantedTurn = turnNear(turnBy(vector).multiply(this.wantedTurn), turnOf(pose), mostLead);
  }

  /** The goal of an update. */
  goal(pose: Pose, isTurning: boolean): Pose {
    if (isTurning) return this.turnedGoal(pose);
    return this.isLoose ? this.pulledGoal(pose) : poseWith(this.wantedTurn, this.point, this.wantedPlace);
  }

  /** How far the grabbed point is from where the hand wants it. */
  stretch(pose: Pose): number {
    return carried(pose, this.point).distanceTo(this.wantedPlace);
  }

  /** What is turned keeps its place; a loose grip lets it move, as a nut along its thread. */
  private turnedGoal(pose: Pose): Pose {
    const { centre } = this.inertia;
    if (this.isLoose) this.wantedPlace = carried(pose, this.point);
    return poseWith(this.wantedTurn, centre, carried(pose, centre));
  }

  /** The goal with the grabbed point at the pointer that is reached with the least energy, as by a pull at this point. */
  private pulledGoal(pose: Pose): Pose {
    const turn = turnOf(pose);
    const centre = carried(pose, this.inertia.centre);
    const grabbed = carried(pose, this.point);
    const lever = grabbed.clone().sub(centre);
    if (this.plane) lever.addScaledVector(this.plane, -lever.dot(this.plane));
    const force = this.forceFor(this.wantedPlace.clone().sub(grabbed), lever, turn);
    const rotation = this.inertia.turnFor(force, lever, turn);
    if (this.plane) rotation.copy(this.plane).multiplyScalar(this.inertia.turnFor(force, lever, turn).dot(this.plane));
    const share = Math.min(1, mostTurn / rotation.length());
    const goalTurn = turnBy(rotation.multiplyScalar(share)).multiply(turn);
    this.wantedTurn = goalTurn;
    return poseWith(goalTurn, this.inertia.centre, centre.addScaledVector(force, share));
  }

  /** The force at the lever's end that moves it by `way`, to first order. */
  private forceFor(way: Vector3, lever: Vector3, turn: Quaternion): Vector3 {
    const columns = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((unit) =>
      unit.clone().add(this.inertia.turnFor(unit, lever, turn).cross(lever)),
    );
    const [a, b, c] = columns;
    return way.applyMatrix3(new Matrix3().set(a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z).invert());
  }
}

export const centreOf = (inertia: Inertia, pose: Pose) => inertia.centre.clone().applyQuaternion(turnOf(pose)).add(placeOf(pose));
