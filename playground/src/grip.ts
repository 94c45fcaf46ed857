// Where the hand wants the body: goals for the next update, from a grabbed point and the pointer, or from turns.
import { Matrix3, Quaternion, Vector3 } from "three";
import { angleAbout, carried, placeOf, poseOf, type Pose, poseWith, turnBy, turnNear, turnOf } from "./poses";
import type { Lock } from "./protocol";

const mostTurn = 0.4; // of one goal of a loose grip, radians
const mostLead = 2; // by which a turned hand may be ahead of the body, radians

/** The size of a body, for how easily it turns. */
export class Inertia {
  readonly centre: Vector3;
  readonly radius: number; // half the diagonal of the box
  private readonly moments: Vector3; // of the solid box around the body, per mass

  constructor(lower: Vector3, upper: Vector3) {
    this.centre = lower.clone().add(upper).multiplyScalar(0.5);
    const size = upper.clone().sub(lower);
    this.radius = size.length() / 2;
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

/** How a body is held. A loose grip does not tilt it in a plane or about an axis, and does not lift it out of the plane. */
export interface Handle {
  isLoose: boolean;
  plane?: Vector3;
  axis?: Vector3;
  lock?: Lock; // the body is moved along it
}

/** The body is held at one of its points. */
export class Grip {
  readonly point: Vector3; // of the body
  private wantedTurn: Quaternion;
  private wantedPlace: Vector3; // of the grabbed point

  private readonly plane?: Vector3;
  private isAlong?: boolean;

  constructor(private readonly inertia: Inertia, place: Vector3, pose: Pose, private readonly handle: Handle) {
    const { plane } = handle;
    this.plane = plane;
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
    const { lock, isLoose } = this.handle;
    if (lock) return this.lockedGoal(pose, isTurning, lock);
    if (isTurning) return this.turnedGoal(pose);
    return isLoose ? this.pulledGoal(pose) : poseWith(this.wantedTurn, this.point, this.wantedPlace);
  }

  /** The turn about the line of the lock that has the grabbed point nearest to the pointer, or the slide along it. */
  private lockedGoal(pose: Pose, isTurning: boolean, { kind, direction, point }: Lock): Pose {
    const axis = new Vector3(...direction);
    const middle = new Vector3(...point);
    const grabbed = carried(pose, this.point);
    const way = this.wantedPlace.clone().sub(grabbed);
    const asked = isTurning
      ? angleAbout(axis, this.wantedTurn.clone().multiply(turnOf(pose).invert()))
      : kind === "hinge" ? angleBetween(axis, grabbed.clone().sub(middle), this.wantedPlace.clone().sub(middle)) : 0;
    const rotation = turnBy(axis.clone().multiplyScalar(Math.max(-mostLead, Math.min(asked, mostLead))));
    const place = placeOf(pose).sub(middle).applyQuaternion(rotation).add(middle);
    if (kind === "cylinder" && !isTurning) place.addScaledVector(axis, way.dot(axis));
    const goal = poseOf(place, rotation.multiply(turnOf(pose)));
    if (isTurning) this.wantedPlace = grabbed;
    else this.wantedTurn = turnOf(goal);
    return goal;
  }

  /** How far the grabbed point is from where the hand wants it. */
  stretch(pose: Pose): number {
    return carried(pose, this.point).distanceTo(this.wantedPlace);
  }

  /** What is turned keeps its place; a loose grip lets it move, as a nut along its thread. */
  private turnedGoal(pose: Pose): Pose {
    const { centre } = this.inertia;
    if (this.handle.isLoose) this.wantedPlace = carried(pose, this.point);
    return poseWith(this.wantedTurn, centre, carried(pose, centre));
  }

  /** The goal with the grabbed point at the pointer that is reached with the least energy, as by a pull at this point. */
  private pulledGoal(pose: Pose): Pose {
    const turn = turnOf(pose);
    const centre = carried(pose, this.inertia.centre);
    const grabbed = carried(pose, this.point);
    const lever = grabbed.clone().sub(centre);
    const way = this.wantedPlace.clone().sub(grabbed);
    const about = this.plane ?? this.handle.axis;
    if (about && this.pullsAlong(about, way, lever)) this.wantedPlace.sub(way.clone().sub(along(about, way)));
    const lift = about ? along(about, way) : new Vector3(); // of the whole body, as by fingers around it
    if (about) for (const vector of [lever, way]) vector.sub(along(about, vector));
    if (this.isAlong) way.set(0, 0, 0);
    const force = this.forceFor(way, lever, turn);
    const rotation = this.inertia.turnFor(force, lever, turn);
    if (about) {
      rotation.copy(along(about, rotation));
      force.sub(along(about, force));
    }
    const share = Math.min(1, mostTurn / rotation.length());
    const goalTurn = turnBy(rotation.multiplyScalar(share)).multiply(turn);
    this.wantedTurn = goalTurn;
    return poseWith(goalTurn, this.inertia.centre, centre.addScaledVector(force, share).add(lift));
  }

  /** Whether a body with an axis is pulled along it, and free to turn, or at its rim: the beginning of the pull decides. */
  private pullsAlong(axis: Vector3, way: Vector3, lever: Vector3): boolean {
    const isDecided = this.isAlong !== undefined || this.plane !== undefined;
    const isRim = lever.clone().sub(along(axis, lever)).length() > 0.1 * this.inertia.radius;
    if (!isDecided && isRim && way.length() > 0.1 * this.inertia.radius) this.isAlong = along(axis, way).length() > 0.7 * way.length();
    return this.isAlong ?? false;
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

const along = (axis: Vector3, vector: Vector3) => axis.clone().multiplyScalar(vector.dot(axis));

/** The angle from one direction to another one, about an axis. */
function angleBetween(axis: Vector3, from: Vector3, to: Vector3): number {
  const [a, b] = [from, to].map((way) => way.clone().addScaledVector(axis, -way.dot(axis)));
  return Math.atan2(axis.dot(a.clone().cross(b)), a.dot(b));
}

export const centreOf = (inertia: Inertia, pose: Pose) => inertia.centre.clone().applyQuaternion(turnOf(pose)).add(placeOf(pose));
