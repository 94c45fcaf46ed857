// How the package compares with the native library: size, time until ready, time of the known answers and of tight cases.
//
//   node bench.mjs [ROUNDS]    in the project that tools/wasm_check.sh makes, with the same variables
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { brotliCompressSync, gzipSync, gunzipSync } from "node:zlib";
import { fileURLToPath } from "node:url";
import { load } from "chasles";
import { load as loadInline } from "chasles/inline";
import { nativeAnswers, optionsOf } from "./native.mjs";
import { box, potato, randomNumbers } from "./shapes.mjs";

const rounds = Number(process.argv[2] ?? 20);
const file = (name) => readFileSync(fileURLToPath(import.meta.resolve(`chasles/${name}`)));
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(0)} kB`;
const seconds = (work) => {
  const start = process.cpuUsage(); // of the processor: other programs count less
  work();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1e6;
};

const wasm = file("chasles.wasm");
console.log(`chasles.wasm: ${kilobytes(wasm.length)}, gzip ${kilobytes(gzipSync(wasm, { level: 9 }).length)}, ` +
  `brotli ${kilobytes(brotliCompressSync(wasm).length)}`);

for (const [name, make] of [["plain", load], ["inline", loadInline]]) {
  const times = [];
  for (let i = 0; i < 5; ++i) {
    const start = performance.now();
    const chasles = await make();
    const cube = chasles.polyhedron(box().vertices, box().faces);
    chasles.firstContact(cube, cube, [5, 0, 0], [0, 0, 0]);
    times.push(performance.now() - start);
  }
  console.log(`${name}: ready and first answer after ${times.map((t) => t.toFixed(0)).join(", ")} ms (loaded five times)`);
}

/** In a new process: since Node.js began, and what load() takes of it. */
function freshProcess(name) {
  const code = `import { load } from "${name}"; const began = performance.now(); const chasles = await load(); const loaded = performance.now();
    const body = chasles.polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]); chasles.firstContact(body, body, [0, 0, 1], [0, 0, 2]);
    console.log(JSON.stringify([began, loaded - began, performance.now()]));`;
  const here = fileURLToPath(new URL(".", import.meta.url));
  return JSON.parse(spawnSync(process.execPath, ["--input-type=module", "-e", code], { cwd: here, encoding: "utf8" }).stdout);
}

for (const name of ["chasles", "chasles/inline"]) {
  const runs = Array.from({ length: 7 }, () => freshProcess(name)).sort((a, b) => a[2] - b[2]);
  const [imported, loading, answered] = runs[3].map((t) => t.toFixed(0));
  console.log(`${name} in a new process: imported ${imported} ms after Node.js began, load() takes ${loading} ms, first answer after ${answered} ms ` +
    "(median of 7)");
}

function knownAnswers() {
  const folder = `${process.env.CHASLES_DATA_DIR}/screw-known-answers`;
  const lines = gunzipSync(readFileSync(`${folder}/cases.jsonl.gz`)).toString().trimEnd().split("\n");
  return lines.map((line) => JSON.parse(line)).flatMap(({ moving, fixed, start, goal }, i) => [
    { vertices: moving.v, faces: moving.f },
    { vertices: fixed.v, faces: fixed.f },
    { ask: "first_contact", moving: 2 * i, fixed: 2 * i + 1, start, goal, max_turn: Math.PI },
  ]);
}

/** A round body that turns and slides within a hair of another one: a large mesh, and many doubtful pairs. */
function tightCases() {
  const random = randomNumbers(5);
  const lines = [potato(random, 30, 40), potato(random, 30, 40), box(1)];
  for (let i = 0; i < 20; ++i) {
    lines.push({ ask: "first_contact", moving: 0, fixed: 1, start: [1.75 + 0.01 * i, -0.5, 0], goal: [1.75 + 0.01 * i, 0.5, 0, 1, 0, 0.1, 1] });
    lines.push({ ask: "first_contact", moving: 2, fixed: 2, start: [0, 0, 2], goal: [0.01 * i, 0, 2, 1, 0, 0, 0.1], find: "first_with_all_contacts" });
    lines.push({ ask: "first_contact", moving: 0, fixed: 1, start: [4, 0, 0], goal: [1.9, 0, 0, 1, 0.1, 0, 1], margin: 0.01 * i, motion: "twist" });
  }
  return lines;
}

for (const [name, lines] of [["known answers", knownAnswers()], ["tight cases", tightCases()]]) {
  const chasles = await load();
  const bodies = lines.filter((line) => line.vertices).map((line) => chasles.polyhedron(line.vertices, line.faces));
  const asked = lines.filter((line) => line.ask).map((line) => ({ ...line, options: optionsOf(line) }));
  const round = () => {
    for (const { moving, fixed, start, goal, options } of asked) chasles.firstContact(bodies[moving], bodies[fixed], start, goal, options);
  };
  const first = seconds(round);
  let best = first;
  let native = Infinity;
  for (let turn = 0; turn < 4; ++turn) { // in turns, as other programs of the machine slow both
    native = Math.min(native, nativeAnswers(lines, rounds).at(-1).seconds);
    for (let i = 0; i < rounds; ++i) best = Math.min(best, seconds(round));
  }
  console.log(`${name}: ${asked.length} questions, native ${(1e3 * native).toFixed(1)} ms, here ${(1e3 * best).toFixed(1)} ms: ` +
    `${(best / native).toFixed(2)} times (fastest of ${4 * rounds} rounds); the first round ${(1e3 * first).toFixed(1)} ms`);
}
