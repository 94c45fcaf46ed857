// What is drawn of a body's shape: its surface and its crease lines.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  type LineSegments,
  type Mesh,
  Vector3,
} from "three";
import { type PackedMesh, unpacked } from "./scene";

export interface DrawnMesh {
  surface: BufferGeometry;
  creases: BufferGeometry;
  origin: Vector3;
}

/** Surfaces are two-sided, because meshes may be open. A depth offset draws them behind their crease lines. */
export const pushedBack = { side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 } as const;

export function drawnMesh(packed: PackedMesh): DrawnMesh {
  const vertices = new BufferAttribute(new Float32Array(unpacked(packed.vertices)), 3);
  const geometry = (indices: string) => {
    const made = new BufferGeometry().setAttribute("position", vertices);
    return made.setIndex(new BufferAttribute(new Uint32Array(unpacked(indices)), 1));
  };
  const surface = geometry(packed.triangles);
  surface.computeBoundingBox();
  surface.computeBoundingSphere();
  return { surface, creases: geometry(packed.creases), origin: new Vector3(...packed.origin) };
}

/** The group's matrix is the pose of the body's frame. `origin` is the position of the mesh in this frame. */
export function frame(origin: Vector3, ...children: (Mesh | LineSegments)[]): Group {
  const group = new Group();
  group.matrixAutoUpdate = false;
  for (const child of children) {
    child.position.copy(origin);
    group.add(child);
  }
  return group;
}
