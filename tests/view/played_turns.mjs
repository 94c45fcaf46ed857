// The program of the page plays motions of half, full and many turns, and shows what was proven.
//
//   node played_turns.mjs VIEWER TURNING_MOTIONS    VIEWER: the folder in which the viewer is built, with esbuild and three.js
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [viewer, program] = process.argv.slice(2);
const { buildSync } = createRequire(`${resolve(viewer)}/`)("esbuild");
const frames = 50;
const fewestScenes = 400;
const most = 4e-3; // mesh unit; the tracks promise a thousandth of the diagonal, which is 1.4, between probes
const corners = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => [0.5 * x, 0.4 * y, 0.3 * z])));

/** What the page is made of, as a module for Node.js. */
async function pageProgram() {
  const folder = mkdtempSync(join(tmpdir(), "played_turns_"));
  const contents = `export * from "./src/record"; export * from "./src/track"; export * from "./src/player"; export { Vector3 } from "three";`;
  buildSync({ stdin: { contents, resolveDir: resolve(viewer) }, bundle: true, format: "esm", outfile: join(folder, "page.mjs") });
  try {
    return await import(pathToFileURL(join(folder, "page.mjs")));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const { Player, Track, tracksOf, unpackedNumbers, Vector3 } = await pageProgram();

/** A point carried by a pose: written without three.js. */
function carried([x, y, z, w, ...axis], point) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const twice = cross(axis, point).map((part) => 2 * part);
  const turned = cross(axis, twice);
  return [x, y, z].map((place, k) => place + point[k] + w * twice[k] + turned[k]);
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The largest distance of a corner on the page from its proven place. */
function largestError(track, time, pose) {
  const shown = track.at(time);
  return Math.max(...corners.map((corner) => distance(new Vector3(...corner).applyMatrix4(shown).toArray(), carried(pose, corner))));
}

/** The distance of a point from the line that the page draws. */
function distanceFromLine(line, point) {
  let least = Infinity;
  for (let i = 0; i + 1 < line.length; ++i) {
    const along = line[i + 1].map((x, k) => x - line[i][k]);
    const square = along.reduce((sum, x) => sum + x * x, 0);
    const part = square > 0 ? along.reduce((sum, x, k) => sum + x * (point[k] - line[i][k]), 0) / square : 0;
    const foot = along.map((x, k) => line[i][k] + Math.min(Math.max(part, 0), 1) * x);
    least = Math.min(least, distance(foot, point));
  }
  return least;
}

/** Presses "play", and calls `onFrame` with the player for each frame until the motion ends. */
function play(onFrame) {
  const waiting = [];
  globalThis.requestAnimationFrame = (call) => waiting.push(call);
  const { now } = performance;
  performance.now = () => 0;
  const player = new Player(1, { from: 0, to: 1 });
  player.toggle();
  performance.now = now;
  onFrame(player.time);
  for (let frame = 1; waiting.length > 0; ++frame) {
    waiting.shift()((4000 / frames) * frame); // the motion takes four seconds
    onFrame(player.time);
  }
  assert.ok(!player.isPlaying);
}

const { stdout, status } = spawnSync(program, { encoding: "utf8", maxBuffer: 1 << 30 });
assert.equal(status, 0);
const scenes = stdout.split("\n").filter((line) => line.startsWith("{")).map((line) => JSON.parse(line)); // another line is the seed
assert.ok(scenes.length >= fewestScenes);
const wrong = { scene: [], query: [], path: [] };
let bends = 0;
for (const [index, { record, query, proven }] of scenes.entries()) {
  const tracks = { scene: tracksOf(record)[0], query: new Track(unpackedNumbers(query)) };
  for (const [name, track] of Object.entries(tracks)) {
    let frame = 0;
    let error = 0;
    play((time) => (error = Math.max(error, largestError(track, time, proven[frame++]))));
    assert.equal(frame, frames + 1);
    if (!(error <= most)) wrong[name].push(`${index}: ${error}`);
  }
  const line = tracks.scene.pathOf(new Vector3(...corners[0])).map((point) => point.toArray());
  bends += line.length;
  const off = Math.max(...proven.map((pose) => distanceFromLine(line, carried(pose, corners[0]))));
  if (!(off <= most)) wrong.path.push(`${index}: ${off}`);
}
console.log(`${scenes.length} scenes of ${frames + 1} frames, paths of ${bends} points`);
assert.deepEqual(wrong, { scene: [], query: [], path: [] });
