// Boxes around drawn shapes, as points for the camera.
import { Box3, Vector3 } from "three";
import type { DrawnMesh } from "./meshes";
import type { Track } from "./track";

export function corners({ min, max }: Box3): Vector3[] {
  const ends = [min, max];
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new Vector3(ends[k & 1].x, ends[(k >> 1) & 1].y, ends[k >> 2].z));
}

/** The corners of a shape's box, in the body's frame. */
export function cornersOf(mesh: DrawnMesh): Vector3[] {
  return corners(mesh.surface.boundingBox!).map((corner) => corner.add(mesh.origin));
}

/** The corners of the box at some poses of the track, among them the first and the last one and, for few poses, all. */
export function cornersOnPath(mesh: DrawnMesh, track: Track, mostBoxes: number): Vector3[] {
  const box = cornersOf(mesh);
  return track.along(mostBoxes).flatMap((pose) => box.map((corner) => corner.clone().applyMatrix4(pose)));
}
