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

/** The corners of the box at some poses of the track, among them the first one and, for few poses, all. */
export function cornersOnPath(mesh: DrawnMesh, track: Track, mostBoxes: number): Vector3[] {
  const box = cornersOf(mesh);
  const step = Math.max(1, Math.ceil((track.count - 1) / Math.max(1, mostBoxes - 1)));
  const samples = Array.from({ length: track.count }, (_, index) => index).filter((index) => index % step === 0);
  return samples.flatMap((index) => box.map((corner) => corner.clone().applyMatrix4(track.sample(index))));
}
