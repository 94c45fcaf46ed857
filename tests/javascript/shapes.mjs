// Bodies, random questions and refusals of the tests. Nothing here comes from the library.
import assert from "node:assert/strict";

/** The message of the InvalidInput that `work` throws, or rejects with if it is a promise. */
export function refusal(work) {
  const message = (error) => {
    assert.equal(error.name, "InvalidInput", error.stack);
    assert.ok(!error.message.includes("\n"));
    return error.message;
  };
  if (work instanceof Promise) return work.then(() => assert.fail("nothing was refused"), message);
  try {
    work();
  } catch (error) {
    return message(error);
  }
  return assert.fail("nothing was refused");
}

/** A box with polygon faces. */
export function box(x = 1, y = x, z = x) {
  const vertices = [];
  for (const a of [-x, x]) for (const b of [-y, y]) for (const c of [-z, z]) vertices.push([a, b, c]);
  return { vertices, faces: [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]] };
}

/** Numbers in [0, 1) from a seed (mulberry32). */
export function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A triangle mesh: a sphere with random radii, and `rings` times `sides` vertices beside both poles. */
export function potato(random, rings, sides) {
  const vertices = [[0, 0, -1]];
  for (let i = 1; i <= rings; ++i)
    for (let k = 0; k < sides; ++k) {
      const [polar, around, radius] = [(Math.PI * i) / (rings + 1), (2 * Math.PI * k) / sides, 0.6 + 0.4 * random()];
      vertices.push([
        radius * Math.sin(polar) * Math.cos(around), radius * Math.sin(polar) * Math.sin(around), -radius * Math.cos(polar),
      ]);
    }
  const top = vertices.push([0, 0, 1]) - 1;
  const at = (ring, side) => 1 + ring * sides + (side % sides);
  const faces = [];
  for (let k = 0; k < sides; ++k) {
    faces.push([0, at(0, k + 1), at(0, k)], [top, at(rings - 1, k), at(rings - 1, k + 1)]);
    for (let i = 0; i + 1 < rings; ++i)
      faces.push([at(i, k), at(i, k + 1), at(i + 1, k + 1)], [at(i, k), at(i + 1, k + 1), at(i + 1, k)]);
  }
  return { vertices, faces };
}

export function randomPose(random, distance) {
  const spread = (size) => size * (2 * random() - 1);
  return [spread(distance), spread(distance), spread(distance), spread(1), spread(1), spread(1), spread(1)];
}
