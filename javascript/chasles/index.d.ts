/// <reference lib="esnext.disposable" />
// The types of the package `chasles`, of `chasles/inline`, and of the global `chasles` of script.js, which have the same names.
export as namespace chasles;

/** A typed array of numbers of any kind, as the arrays of three.js's attributes are. */
export interface NumberArray {
  readonly BYTES_PER_ELEMENT: number;
  readonly buffer: ArrayBufferLike;
  readonly length: number;
  readonly [i: number]: number;
}

/** Numbers of a point, of a direction, or of other coordinates. */
export type Numbers = readonly number[] | NumberArray;

/**
 * A pose: 3 numbers x y z, 7 numbers x y z qw qx qy qz (a quaternion of any non-zero length), or 16 numbers (a 4x4 matrix,
 * row by row). Objects of three.js are poses, too. A Matrix4 stores its elements column by column, and is taken as that. An
 * Object3D is where it is in the world, with its parents; an object with a scale, a shear or a mirroring in the world is
 * refused: `fromObject3D` makes a body with that in it, and its pose.
 */
export type Pose = Numbers | MatrixLike | ObjectLike;

/** What a Matrix4 of three.js has, and this package needs: 16 numbers, column by column. Of Babylon.js: `{ elements: matrix.asArray() }`. */
export interface MatrixLike {
  readonly elements: Numbers;
}

export interface PointLike {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** What an Object3D of three.js has, and this package needs. Without `matrixWorld`, position and quaternion are the pose. */
export interface ObjectLike {
  readonly position: PointLike;
  readonly quaternion: PointLike & { readonly w: number };
  readonly scale?: PointLike | undefined;
  readonly matrixWorld?: MatrixLike | undefined;
  updateWorldMatrix?: ((updateParents: boolean, updateChildren: boolean) => void) | undefined;
}

/** An array of numbers that says nothing else: x y z qw qx qy qz, with a quaternion of length one. */
export type PoseNumbers = [number, number, number, number, number, number, number];
export type Point = [number, number, number];

/** What is proven: no contact on [0, 1]; the first contact within the bracket; touching or overlapping at time 0. */
export type Verdict = "clear" | "contact" | "contact_at_start";
export type Find = "first" | "any" | "first_with_all_contacts";

/**
 * A vertex is a number, a face a list of one number, an edge a list of its two vertices. Ids count the vertices and faces that were
 * given, from 0. The faces of a geometry of three.js are counted as three.js does (`faceIndex`), also where a draw range or groups
 * leave out triangles.
 */
export type Feature = number | [number] | [number, number];

export interface Contact {
  kind: "vertex_face" | "face_vertex" | "edge_edge" | "vertex_edge" | "edge_vertex" | "vertex_vertex";
  moving_feature: Feature;
  fixed_feature: Feature;
  /** On the fixed feature, in the world, mesh unit. */
  point: Point;
  /** Unit, from the fixed body to the moving body. */
  normal: Point;
  /** Distance of the two features, mesh unit. */
  gap: number;
  /** -d(gap)/dtime, mesh unit per motion. */
  approach_speed: number;
}

/** An edge of one body that passes through a face of the other one at time 0. */
export interface Overlap {
  moving_feature: Feature;
  fixed_feature: Feature;
  point: Point;
}

/** How much was done. */
export interface Work {
  node_pairs: number;
  face_pairs: number;
  elementary_tests: number;
  root_brackets: number;
  refined: number;
  exact: number;
}

/** Numbers of a motion: the turn in radians, and slide and axis of the screw between the end poses. */
export interface MotionNumbers {
  kind: "screw" | "sweep" | "velocity" | "twist";
  angle: number;
  slide: number;
  axis_point: Point;
  axis_direction: Point;
  displacement?: Point;
}

/** The keys that an answer with a contact has, and an answer without one lacks. */
export interface ContactParts {
  /** The bracket of the first contact, in [0, 1]. */
  time: number;
  time_upper: number;
  /** The same in the paper's parameter; for screws and sweeps. */
  tau?: number;
  tau_upper?: number;
  /** True if a contact is proven to be in the bracket. */
  certain: boolean;
  /** The moving body in the world, and the fixed body, at `time`. */
  pose: PoseNumbers;
  fixed_pose: PoseNumbers;
  /** Not empty, except with `overlap` and `inside`: bodies in each other at time 0 may have no contacts. Write `contacts[0]?.`. */
  contacts: Contact[];
  /** There are more contacts than the list has. */
  contacts_cut?: true;
  /** Where the bodies pass through each other at time 0. */
  overlap?: Overlap;
  /** At time 0 this body, or a part of it, is inside of the other one, and the surfaces do not meet: there are no contacts. */
  inside?: "moving" | "fixed";
  /** A vertex of that body which is inside, and its place in the world. */
  inside_vertex?: number;
  inside_point?: Point;
}

export interface ClearAnswer {
  verdict: "clear";
  /** With `hold`: the contacts at time 0. */
  held?: Contact[];
  /** There are more held contacts than the list has. */
  contacts_cut?: true;
  clear_until: number;
  motion: MotionNumbers;
  work: Work;
}
export interface ContactAnswer extends ContactParts {
  verdict: "contact" | "contact_at_start";
  held?: Contact[];
  /** Before this time the bodies are proven to stay apart, or farther apart than the margin. */
  clear_until: number;
  motion: MotionNumbers;
  work: Work;
}

/** The keys of `chasles check --json`, and `fixed_pose`. */
export type FirstContact = ClearAnswer | ContactAnswer;
/** The times count within the segment, which counts from 0. */
export type PathContact = FirstContact & { segment: number };

/** The keys of `chasles clearance --json`, and `fixed_pose`. The bracket [distance, distance_upper] encloses the least distance. */
export interface LeastDistance extends ContactParts {
  distance: number;
  distance_upper: number;
  motion: MotionNumbers;
  work: Work;
}

/** The distance over time. From times[i] to times[i + 1] it is never below lower[i] and never above upper[i], mesh unit.
 * Where no more is known than that nothing touches, `lower` is the least normal number, 2.2e-308. */
export interface DistanceProfile {
  /** Ascending, from 0 to 1. The last entries of `lower` and `upper` are those at time 1. */
  times: Float64Array;
  lower: Float64Array;
  upper: Float64Array;
  /** Whether the bounds are as near to each other as asked, but where the bodies touch: there `lower` is 0. */
  certain: boolean;
  /** For each margin that was asked: the times within it, and those that may be. */
  zones: { margin: number; inside: [number, number][]; doubt: [number, number][] }[];
  /** When the bodies are proven not to touch: the longest intervals. */
  free: [number, number][];
  motion: MotionNumbers;
  work: Work;
}

export interface MotionOptions {
  /** "screw" by default: the paper's motion. "velocity" and "twist" are even in time. */
  motion?: "screw" | "sweep" | "velocity" | "twist" | undefined;
  /** The body point that a sweep or a constant velocity carries along a line; the body's origin by default. */
  centre?: Numbers | undefined;
  /** Largest turn of one piece of a screw, radians; 10 degrees by default, and at most `Math.PI`: one piece. */
  maxTurn?: number | undefined;
}

export interface FixedOptions {
  /**
   * Poses of the fixed body in the world, if it moves too. With "velocity" and "twist" each body follows that motion in the world. With
   * "screw" and "sweep" that is the motion of the moving body as seen from the fixed one, and the fixed body follows the constant
   * twist between its poses: `poseAt(fixedStart, fixedGoal, time, { motion: "twist" })` says where it is.
   */
  fixedStart?: Pose | undefined;
  fixedGoal?: Pose | undefined;
  /** For "velocity" only: the point of the fixed body that goes along a line; its origin by default. */
  fixedCentre?: Numbers | undefined;
}

export interface QueryOptions {
  /** Distance of the surfaces that counts as contact, mesh unit; in [0, 1e30]. */
  margin?: number | undefined;
  /** Less than the margin: bodies that start within the margin may move on until they come within this distance. */
  hold?: number | undefined;
  /** Width of the bracket to aim for, as a part of the motion; in [1e-15, 1]. */
  timeTolerance?: number | undefined;
  find?: Find | undefined;
}

type OfProfiles = "absoluteTolerance" | "margins";
/** Options of other questions. They would have no effect here, and are refused: `undefined` counts as left out. */
export type LeftOut<Names extends string> = { readonly [Name in Names]?: undefined };

export type FirstContactOptions = QueryOptions & MotionOptions & FixedOptions & LeftOut<OfProfiles | "tolerance" | "until">;
/** Those of `isClear`. */
export type ClearOptions = Omit<QueryOptions, "find"> & MotionOptions & FixedOptions & LeftOut<OfProfiles | "find" | "tolerance" | "until">;
/** Those of `firstContactOnPath`. */
export type PathOptions = QueryOptions & MotionOptions & LeftOut<OfProfiles | keyof FixedOptions | "tolerance" | "until">;
/** Those of `poseAt`. */
export type PoseOptions = MotionOptions & FixedOptions & LeftOut<OfProfiles | keyof QueryOptions | "tolerance" | "until">;
export type LeastDistanceOptions = {
  /** Width of the bracket of the distance to aim for, as a part of the distance; 1e-6 by default. A coarser one can take less time. */
  tolerance?: number | undefined;
  timeTolerance?: number | undefined;
  find?: Exclude<Find, "any"> | undefined;
} & MotionOptions & FixedOptions & LeftOut<OfProfiles | "margin" | "hold" | "until">;

export interface ProfileTolerances {
  /** The greatest difference of the bounds, as a part of the distance; in [1e-4, 1], 0.01 by default. */
  tolerance?: number | undefined;
  /** Differences of less do not matter, mesh unit; 0, the default: a millionth of the sum of both radii around the bodies. */
  absoluteTolerance?: number | undefined;
  /** Distances, mesh unit: the times at which each is crossed are bounded closely. */
  margins?: Numbers | undefined;
  /** So closely, as a part of the motion; in [1e-9, 1], a millionth by default. */
  timeTolerance?: number | undefined;
}
export type ProfileOptions = ProfileTolerances & MotionOptions & FixedOptions & LeftOut<"find" | "margin" | "hold" | "until">;

/** An object that holds memory of the instance, until it is freed or nothing refers to it any more. */
export interface Held {
  free(): void;
  [Symbol.dispose](): void;
}

export interface MeshReport {
  readonly vertices: number;
  readonly distinct_vertices: number;
  readonly faces: number;
  readonly triangles: number;
  readonly polygons: number;
  readonly edges: number;
  readonly boundary_edges: number;
  readonly nonmanifold_edges: number;
  /** Faces without area that edges of other faces cover; and triangles of a geometry in front of the last drawn one that are not drawn. */
  readonly dropped_faces: number;
  readonly segments: number;
  readonly closed: boolean;
  /** Edges that faces do not run along equally often in both directions. */
  readonly unpaired_edges: number;
  /** Connected parts of the surface, and the closed ones whose volume belongs to the body. */
  readonly surface_parts: number;
  readonly solid_parts: number;
  /**
   * Closed parts that are turned inwards: nothing in them is solid. They are rooms, and cavities of parts around them. A body whose
   * only part is one is mostly a mistake: each triangle is wound the other way round, as in left-handed frames.
   */
  readonly inward_parts: number;
  /** Of the solid parts, less that of the parts turned inwards. Parts that overlap count twice. */
  readonly volume: number;
  /** The body is its polyhedron and all points within this distance of it. */
  readonly radius: number;
  /** The faces have moved inwards by at most so much: the body has been made with a radius below 0. */
  readonly moved_inwards: number;
  readonly lower: Readonly<Point>;
  readonly upper: Readonly<Point>;
}

export interface BodyOptions {
  /** Cut polygons that are not planar, cross themselves or turn back into triangles. */
  triangulate?: boolean | undefined;
  /** Whether the volume that a closed surface encloses belongs to the body: of each closed part ("automatic"), of all ("yes", or the mesh is refused), or of none. */
  solid?: "automatic" | "yes" | "no" | undefined;
  /**
   * All points within this distance of the polyhedron belong to the body. Below 0, the faces of a closed body move inwards by at
   * most so much: an overlap that is allowed. A surface that is turned inwards is a room, whose walls move back: its box grows. 0 by default.
   */
  radius?: number | undefined;
}

export interface Polyhedron extends Held {}
/**
 * A polyhedral surface. It never changes; scenes and hands that use it keep it. It is a handle of memory in the instance: `structuredClone`,
 * `postMessage` and `JSON.stringify` keep nothing of it. Send its `vertices` and `faces`: `polyhedron` makes the body again, with
 * `report.radius` as its `radius`, and `solid: "no"` if it was made so.
 *
 * Its arrays are made at the first read, and later reads give the same arrays. `report` and `faces` are frozen. A write to a typed array
 * changes nothing of the body, only what later reads give: take a copy (`slice()`) to write.
 */
export declare class Polyhedron {
  private constructor();
  readonly report: MeshReport;
  /** x y z of each vertex. */
  readonly vertices: Float64Array;
  /** The outline of each face: `report.faces` of the body, then dropped faces without area that close gaps of the surface. */
  readonly faces: readonly (readonly number[])[];
  /** Triangles that cover the faces, three vertex ids each. */
  readonly triangles: Uint32Array;
  /** The id of each face in the input: what answers call it. */
  readonly sourceFaces: Uint32Array;
}

/** A body that goes from a pose to a goal. With a pose alone it stands still, and takes neither `motion` nor `centre`. */
export interface MotionToGoal {
  pose?: Pose | undefined;
  goal?: Pose | undefined;
  /** "velocity" by default. It and "twist" are even from pose to pose. */
  motion?: "velocity" | "twist" | undefined;
  /** The body point that "velocity" carries along a line; the body's origin by default. */
  centre?: Numbers | undefined;
  poses?: undefined;
  times?: undefined;
}

/** A body that goes through poses at times. */
export interface MotionThroughPoses {
  /** Two or more poses, instead of pose and goal. */
  poses: readonly Pose[];
  /** One for each pose, ascending from 0 to 1. */
  times: Numbers;
  /**
   * "velocity" by default. It and "twist" are even from pose to pose. "spline": the body's origin follows the natural cubic
   * spline through all poses, with slerp from turn to turn.
   */
  motion?: "velocity" | "twist" | "spline" | undefined;
  /** The body point that "velocity" carries along a line; the body's origin by default. */
  centre?: Numbers | undefined;
  pose?: undefined;
  goal?: undefined;
}

/** Smooth in velocity and acceleration, near its poses but not through them, and without times. */
export interface MotionNearPoses {
  poses: readonly Pose[];
  motion: "b_spline";
  times?: undefined;
  centre?: undefined;
  pose?: undefined;
  goal?: undefined;
}

/** How a body of a scene moves. */
export type BodyMotion = MotionToGoal | MotionThroughPoses | MotionNearPoses;

export interface SceneOptions extends LeftOut<keyof MotionOptions | keyof FixedOptions | OfProfiles | "tolerance"> {
  /** Distance of the surfaces that counts as contact, mesh unit; pairs may have their own (`setMargin`). */
  margin?: number | undefined;
  /** Less than the margin: bodies that start within it may move on until they come within this distance. */
  hold?: number | undefined;
  timeTolerance?: number | undefined;
  find?: Find | undefined;
  /** Contacts that begin later are left out. Two bodies that both stand still are tested with 0 only, a question about the start. */
  until?: number | undefined;
}

/**
 * What an answer about a scene says nothing about. Two bodies that both stand still are not tested ("at_rest"), also if they
 * overlap, except with `until: 0`. "ignored": by `ignore` and `ignoreGroups`.
 */
export interface Untested {
  /** How many pairs are tested, and how many are not. */
  tested: number;
  pairs: number;
  /** Each pair counts for one reason. `pairs` has their names, at most 100 of each reason. */
  reasons: { reason: "at_rest" | "ignored"; count: number; pairs: [string, string][] }[];
}

/** A question that lists everything is no question of yes or no. */
export type SceneListOptions = Omit<SceneOptions, "find"> & { find?: Exclude<Find, "any"> | undefined };

/** The keys of `chasles scene --json` without `motion`, and `fixed_pose`. */
export type SceneContact =
  | { verdict: "clear"; clear_until: number; work: Work; untested: Untested }
  | (ContactParts & {
      verdict: "contact" | "contact_at_start";
      /** With `hold`: the contacts of the pair at time 0. */
      held?: Contact[];
      clear_until: number;
      /** Names of the moving and the fixed body. */
      pair: [string, string];
      /** Further pairs that may touch at the same time. */
      simultaneous?: [string, string][];
      work: Work;
      untested: Untested;
    });

export interface SceneEvents {
  /** `contacts` may be empty for a pair that overlaps, or of which one body is inside of the other one, at time 0. */
  events: ({ pair: [string, string] } & Pick<
    ContactParts,
    "time" | "time_upper" | "certain" | "contacts" | "contacts_cut" | "overlap" | "inside" | "inside_vertex" | "inside_point"
  >)[];
  work: Work;
  untested: Untested;
}

export interface Scene extends Held {}
/** Many bodies in one world over the time [0, 1]. */
export declare class Scene {
  private constructor();
  /** Frozen; another array after `add` and `remove`. */
  readonly names: readonly string[];
  /** Without a pose the body is at the origin of the world. */
  add(name: string, shape: Polyhedron, options?: BodyMotion & { group?: string | undefined }): string;
  remove(name: string): void;
  /** Another motion, from `pose` or through `poses`: the body keeps no place. `poseAt(name, 0)` is where it started. */
  move(name: string, options: BodyMotion & ({ pose: Pose } | { poses: readonly Pose[] })): void;
  /** All bodies at once, in the order of `names`. If an argument is refused, nothing has moved. */
  moveAll(starts: readonly Pose[], goals: readonly Pose[], options?: { motion?: "velocity" | "twist" | undefined }): void;
  /** Where a body is at a time in [0, 1]. */
  poseAt(name: string, time: number): PoseNumbers;
  ignore(a: string, b: string): void;
  /** The groups of this and other rules may get their bodies later: a group without a body is no error. The same group twice: within it. */
  ignoreGroups(a: string, b: string): void;
  setMargin(a: string, b: string, margin: number): void;
  setGroupMargin(a: string, b: string, margin: number): void;
  /**
   * The distance that two bodies hold if they start within their margin, in place of `hold` of the question. It counts in questions
   * where it is less than the margin of the two bodies.
   */
  setHold(a: string, b: string, hold: number): void;
  setGroupHold(a: string, b: string, hold: number): void;
  /** The earliest contact of all pairs. */
  firstContact(options?: SceneOptions): SceneContact;
  /** The first contact of each pair that touches, in order of time. */
  allContacts(options?: SceneListOptions): SceneEvents;
  /** For each body the time until which it is proven clear of all others. */
  clearUntil(options?: SceneListOptions): Record<string, number>;
  /** The two bodies that come nearest to each other, over the whole time; margins have no effect. Null if no two bodies are tested. */
  leastDistance(options?: SceneDistanceOptions): SceneDistance | null;
  /** The least distance of each two bodies, over the whole time; margins have no effect. */
  leastDistances(options?: SceneDistanceOptions): SceneDistances;
  /** The distance of the two bodies that are nearest, over the time; margins of the scene have no effect. Infinite if no two bodies are tested. */
  profile(options?: SceneProfileOptions): SceneProfile;
}

type NotOfScenes = LeftOut<keyof MotionOptions | keyof FixedOptions | "margin" | "hold" | "until">;
export type SceneDistanceOptions = Pick<LeastDistanceOptions, "tolerance" | "timeTolerance" | "find"> & NotOfScenes & LeftOut<OfProfiles>;
export type SceneProfileOptions = ProfileTolerances & LeftOut<"find"> & NotOfScenes;

export interface SceneDistance extends Omit<LeastDistance, "motion"> {
  /** The first body moves, the second one is fixed. The lower end of the distance holds for all pairs. */
  pair: [string, string];
  untested: Untested;
}

export interface PairDistance extends Omit<LeastDistance, "motion"> {
  /** The first body moves, the second one is fixed. */
  pair: [string, string];
}

export interface SceneDistances {
  /** Each tested pair, in the order of its bodies in `names`. */
  pairs: PairDistance[];
  untested: Untested;
}

export interface SceneProfile extends Omit<DistanceProfile, "motion"> {
  /** The pairs that are nearest at some time. */
  pairs: [string, string][];
  /** From times[i] to times[i + 1] the pair pairs[nearest[i]] has the least upper bound. */
  nearest: number[];
  untested: Untested;
}

export interface DragOptions {
  /** The gap that contacts keep, mesh unit; 0: a ten-thousandth of the diagonal of the body's box. */
  margin?: number | undefined;
  /** Contacts within it are foreseen, mesh unit; at least 1.25 times the margin, and 0: just that. */
  reach?: number | undefined;
  /** Force of the hand for a distance of 1. */
  stiffness?: number | undefined;
  /** Certified steps of one update at most. */
  rounds?: number | undefined;
  /** Of Coulomb: the greatest friction force of a contact, as a share of its normal force. The body rests where friction can hold it. */
  friction?: number | undefined;
  /** How hard turning is against shifting; by default that of the solid box around the body. */
  mass?: MassProperties | undefined;
  /** The body moves only as the lock lets it. */
  lock?: DragLock | undefined;
}

/** The mass of a body, as a share of its whole mass. */
export interface MassProperties {
  /** Of mass, in the body's frame, mesh unit; the body's origin by default. */
  centre?: Numbers | undefined;
  /** Moments about the centre in the body's frame, per mass: 9 numbers or 3 rows, symmetric and positive definite. */
  inertia: Numbers | readonly Numbers[];
}

/** How a dragged body may move, in the world, from where it is when the dragging begins: at its goal, if it has one. */
export interface DragLock {
  /** To turn about a line; to slide along a direction; both; to slide in a plane and to turn about its normal. */
  kind: "free" | "hinge" | "slider" | "cylinder" | "plane";
  /** Of the line, or the normal of the plane; 0 0 1 by default. Refused for "free". */
  direction?: Numbers | undefined;
  /** On the line of a hinge or a cylinder; 0 0 0 by default. Refused for the other kinds. */
  point?: Numbers | undefined;
}

/** A force, and a torque about the body's origin, in the world. */
export type Wrench = [number, number, number, number, number, number];

export interface DragStep {
  /** The pose reached. */
  pose: PoseNumbers;
  /**
   * "reached": the body is at the goal; with a lock, as near to it as the lock allows.
   * "resting": contacts hold the body against the pull of the hand.
   * "moving": the rounds or the seconds of the update were used up; the next update goes on.
   * "touching": the body touches or overlaps the bodies of `touching`, and stays where it is. A body that touches exactly has no
   * gap to move in: `scene.move` it a hair away, more than a millionth of the margin, before a hand takes it.
   */
  state: "reached" | "resting" | "moving" | "touching";
  /** With the force along the normal, and the friction force across it, both on the dragged body. */
  contacts: (Contact & { body: string; force: number; friction: Point })[];
  events: (Contact & { body: string; begins: boolean })[];
  /** What the contacts push the hand with. What a lock takes is not a part of it. */
  wrench: Wrench;
  /** Of the goal, mesh unit. */
  distance: number;
  /** Bodies that push, or at which the last step ended. */
  blocking: string[];
  /** With the state "touching": the bodies that are nearer than a millionth of the margin, or overlap. */
  touching: string[];
  /** The way, in screws of the default `maxTurn`, each proven clear until a time: `poseAt(start, goal, time)` is on it. */
  pieces: { start: PoseNumbers; goal: PoseNumbers; until: number; clearance: number }[];
  intrusions: { body: string; time: number }[];
  work: Work;
}

export interface DraggedBody extends Held {}
/** A body of a scene in a hand: it stops at contacts, slides along them and lifts off, and never goes through. */
export declare class DraggedBody {
  private constructor();
  readonly name: string;
  /** Where the last update ended, or where the dragging began. `scene.move` of this body is seen by the next update. */
  readonly pose: PoseNumbers;
  readonly margin: number;
  readonly reach: number;
  /**
   * Goes towards the goal. No round begins after so many seconds, and each goes less far where its search gets long; 0: no bound. Throws
   * `InvalidInput` for a goal farther from the origin than some 2^28 margins, as a ray that grazes its plane gives.
   */
  update(goal: Pose, seconds?: number): DragStep;
  /** What the contacts would push the hand with at another goal, from where the last update ended. No geometry is computed. */
  force(goal: Pose): Wrench;
}

/** What a BufferGeometry of three.js has, and this package needs. Draw range and index are followed, from any corner, by whole triangles. */
export interface GeometryLike {
  readonly attributes: {
    readonly position?: undefined | { readonly count: number; getX(i: number): number; getY(i: number): number; getZ(i: number): number };
  };
  readonly index?: { readonly count: number; getX(i: number): number } | null | undefined;
  readonly drawRange?: { readonly start: number; readonly count: number } | undefined;
  readonly groups?: readonly { readonly start: number; readonly count: number; readonly materialIndex?: number | undefined }[] | undefined;
}

/** What a Mesh of three.js has, and this package needs. */
export interface MeshLike extends ObjectLike {
  readonly isMesh: true;
  readonly isInstancedMesh?: undefined;
  readonly isBatchedMesh?: undefined;
  readonly geometry: GeometryLike;
  readonly material: unknown;
  readonly matrixWorld: MatrixLike;
}

/** A body of a Mesh. */
export interface MeshBody {
  readonly body: Polyhedron;
  /**
   * Where the object is in the world, whenever this is read. The object may move and turn. It must keep the scale, shear and
   * mirroring that are in the body.
   */
  readonly pose: PoseNumbers;
}

/** What a factory of workers makes: a Web Worker, or a Worker of node:worker_threads. It runs `chasles/worker`. */
export interface WorkerLike {
  postMessage(message: any): void;
  terminate(): unknown;
}

/** Workers with an instance each. In Node.js they keep the process alive only while they work. */
export interface Workers {
  readonly count: number;
  /**
   * The answers of Chasles.firstContactBatch. A body goes to each worker once, and is freed there when it is freed here; a batch
   * keeps its bodies until it ends.
   */
  firstContactBatch(
    moving: Polyhedron, fixed: Polyhedron, starts: readonly Pose[], goals: readonly Pose[], options?: FirstContactOptions,
  ): Promise<FirstContact[]>;
  stop(): void;
  [Symbol.dispose](): void;
}

/** An instance of the library. Its objects belong to it. */
export declare class Chasles {
  private constructor();
  /**
   * A body of points, and of triangles in one array or of faces with three corners or more. Seen from outside, the corners of a face go round
   * counter-clockwise: a closed surface whose faces all go the other way round is turned inwards (`report.inward_parts`), and nothing in it is solid.
   */
  polyhedron(
    vertices: Numbers | readonly Numbers[],
    faces: Numbers | readonly Numbers[],
    options?: BodyOptions,
  ): Polyhedron;
  /** The sphere about the origin. */
  sphere(radius: number): Polyhedron;
  /** All points within `radius` of the segment of this length above 0 along z, whose middle is the origin. */
  capsule(radius: number, length: number): Polyhedron;
  /** All points within `radius` of some points, as one body: face i is point i. */
  points(points: Numbers | readonly Numbers[], radius: number): Polyhedron;
  /** A body of the content of an OBJ, OFF, PLY, STL or OctoMap (.bt, .ot) file; the extension of the name says which. */
  fromFile(content: Uint8Array | ArrayBuffer, name: string, options?: BodyOptions): Polyhedron;
  /** A body of a geometry of three.js. Vertices at equal places count as one. Where a mesh decides about the shape, `fromObject3D` takes it. */
  fromBufferGeometry(geometry: GeometryLike, options?: BodyOptions): Polyhedron;
  /**
   * A body of a Mesh of three.js as it is drawn in the world, and its pose: scale, shear and mirroring are in the body, and so are
   * morph targets and bones as they are now. Of a mesh with a list of materials, the triangles of its groups are taken.
   * `visible` is not read: a hidden object is a body, and so are triangles whose material is hidden.
   */
  fromObject3D(mesh: MeshLike, options?: BodyOptions): MeshBody;
  scene(): Scene;
  draggedBody(scene: Scene, name: string, options?: DragOptions): DraggedBody;

  /** When do two bodies first touch, where, and how? */
  firstContact(moving: Polyhedron, fixed: Polyhedron, start: Pose, goal: Pose, options?: FirstContactOptions): FirstContact;
  /** True if it is proven that no contact occurs on the whole motion. */
  isClear(moving: Polyhedron, fixed: Polyhedron, start: Pose, goal: Pose, options?: ClearOptions): boolean;
  /** The first contact on the way from pose to pose. */
  firstContactOnPath(
    moving: Polyhedron, fixed: Polyhedron, poses: readonly Pose[], options?: PathOptions,
  ): PathContact;
  /**
   * How near do two bodies come, when, and where? Where surfaces stay near each other over large areas, this takes tens of times as long as
   * a first contact: `isClear` with a `margin` takes less, and a coarser `tolerance` can.
   */
  leastDistance(moving: Polyhedron, fixed: Polyhedron, start: Pose, goal: Pose, options?: LeastDistanceOptions): LeastDistance;
  /** How far apart are two bodies over the motion? Bounds of their distance for every time, the times within margins, and when nothing touches. */
  profile(moving: Polyhedron, fixed: Polyhedron, start: Pose, goal: Pose, options?: ProfileOptions): DistanceProfile;
  /** Where the moving body is at a time in [0, 1] of the motion that the questions are asked about. For the fixed body see FixedOptions. */
  poseAt(start: Pose, goal: Pose, time: number, options?: PoseOptions): PoseNumbers;
  /** One answer a motion, in order. */
  firstContactBatch(
    moving: Polyhedron, fixed: Polyhedron, starts: readonly Pose[], goals: readonly Pose[], options?: FirstContactOptions,
  ): FirstContact[];
  /**
   * Workers for batches: as many as there are cores, or `count`, at most 1024. `worker` makes one of them where the package's own
   * script cannot be found; its script has to run `chasles/worker`, or the promise is rejected after 30 seconds without an answer.
   */
  workers(options?: { count?: number | undefined; worker?: (() => WorkerLike | Promise<WorkerLike>) | undefined }): Promise<Workers>;
  /** How many objects are not freed. */
  readonly held: { polyhedra: number; scenes: number; draggedBodies: number };
}

/** Wrong input: the message says what is wrong, where and why. */
export declare class InvalidInput extends Error {}
/**
 * The instance stopped within a call, and answers no more; load() makes a new one. Memory that is full stops nothing: the call throws
 * `RangeError` ("chasles: out of memory"), the objects stay as they were, and `free()` makes room. An instance has at most 4 GiB.
 */
export declare class InstanceStopped extends Error {}

export type WasmSource = string | URL | Response | ArrayBuffer | Uint8Array | WebAssembly.Module;

/**
 * Makes an instance. `wasm` stands for chasles.wasm if that lies elsewhere: a URL, a Response, bytes, or a module. In Node.js a
 * path alone is no URL.
 */
export declare function load(options?: { wasm?: WasmSource | Promise<WasmSource> | undefined }): Promise<Chasles>;
