// Workers: what they hold, what they refuse, and when they let the process end.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { availableParallelism } from "node:os";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import { load } from "chasles";
import { load as loadInline } from "chasles/inline";
import { Mesh, Object3D } from "three";
import { box, refusal } from "./shapes.mjs";

const chasles = await load();
const { vertices, faces } = box();
const newCube = (instance = chasles) => instance.polyhedron(vertices, faces);
const cube = newCube();
const starts = Array.from({ length: 20 }, (_, i) => [5, 0.02 * i, 0]);
const goals = starts.map(() => [0, 0, 0]);
const pause = () => new Promise((resolve) => setTimeout(resolve, 10));

/** Workers that the test can ask, too, how many bodies they hold. */
async function countedWorkers(count, instance = chasles) {
  const made = [];
  const worker = () => {
    made.push(new Worker(new URL(import.meta.resolve("chasles/worker"))));
    return made.at(-1);
  };
  const workers = await instance.workers({ count, worker });
  const held = (each) =>
    new Promise((resolve) => {
      const awake = setInterval(() => undefined, 50); // the workers let the process end
      const listen = ({ job, answer }) => job === -1 && (each.off("message", listen), clearInterval(awake), resolve(answer.polyhedra));
      each.on("message", listen).postMessage({ task: "held", job: -1 });
    });
  return { workers, held: () => Promise.all(made.map(held)) };
}

test("bodies that are freed here are freed in the workers, which answer no freed ones", async () => {
  const { workers, held } = await countedWorkers(2);
  await workers.firstContactBatch(cube, cube, starts, goals);
  assert.deepEqual(await held(), [1, 1], "a body goes to a worker once");
  for (let i = 0; i < 61; ++i) {
    const body = newCube();
    assert.equal((await workers.firstContactBatch(body, cube, starts, goals)).length, 20);
    body.free();
    assert.match(await refusal(workers.firstContactBatch(body, cube, starts, goals)), /^moving: has been freed/);
    assert.match(await refusal(workers.firstContactBatch(cube, body, starts, goals)), /^fixed: has been freed/);
  }
  assert.deepEqual(await held(), [1, 1]);
  workers.stop();
});

test("a batch keeps the bodies that are freed while it runs", async () => {
  const { workers, held } = await countedWorkers(2);
  const body = newCube();
  const answers = workers.firstContactBatch(body, body, starts, goals);
  body.free();
  assert.ok((await answers).every(({ verdict }) => verdict === "contact"));
  assert.deepEqual(await held(), [0, 0]);
  workers.stop();
});

test("bodies that nothing refers to are freed in the workers", { skip: globalThis.gc ? false : "skipped: no --expose-gc" }, async () => {
  const { workers, held } = await countedWorkers(1);
  for (let i = 0; i < 20; ++i) await workers.firstContactBatch(newCube(), cube, starts.slice(0, 1), goals.slice(0, 1));
  for (let i = 0; i < 100 && (await held())[0] > 2; ++i) {
    globalThis.gc();
    await pause();
  }
  assert.ok((await held())[0] <= 2);
  workers.stop();
});

test("objects of three.js are poses of a batch, as they are when it is asked", async () => {
  const workers = await chasles.workers({ count: 2 });
  const [from, to, other] = [new Object3D(), new Mesh(), new Object3D()];
  from.position.set(5, 0.5, 0);
  other.position.set(1, 0, 0);
  const expected = chasles.firstContactBatch(cube, cube, [from, from.matrix, far], [to, to, to], { fixedStart: other, fixedGoal: other });
  const asked = workers.firstContactBatch(cube, cube, [from, from.matrix, far], [to, to, to], { fixedStart: other, fixedGoal: other });
  from.position.set(90, 0, 0);
  from.updateMatrix();
  assert.deepEqual(await asked, expected);
  assert.match(await refusal(workers.firstContactBatch(cube, cube, [far, ["1", 0, 0]], [to, to])), /^motion 1: start\[0\]: "1" is not a number/);
  assert.match(await refusal(workers.firstContactBatch(cube, cube, [far], [to], { margn: () => 1 })), /^margn: is no option here/);
  assert.match(await refusal(workers.firstContactBatch({}, cube, [far], [to])), /^moving: is no Polyhedron/);
  assert.match(await refusal(workers.firstContactBatch(newCube(await load()), cube, [far], [to])), /^moving: belongs to another instance/);
  assert.deepEqual(await workers.firstContactBatch(cube, cube, [], []), []);
  workers.stop();
  assert.match(await refusal(workers.firstContactBatch(cube, cube, [far], [to])), /^workers: have been stopped/);
});
const far = new Float64Array([5, 0, 0]);

test("workers of the inlined build need no file", async () => {
  const instance = await loadInline();
  const workers = await instance.workers({ count: 1 });
  const body = newCube(instance);
  assert.equal((await workers.firstContactBatch(body, body, starts, goals)).length, 20);
  workers.stop();
});

/** Runs a program that does not stop its workers. */
function run(lines) {
  const program = `import { load } from "chasles"; import { Worker } from "node:worker_threads";
    const chasles = await load(); const cube = chasles.polyhedron(${JSON.stringify(vertices)}, ${JSON.stringify(faces)}); ${lines}`;
  return spawnSync(process.execPath, ["--input-type=module", "-e", program], { encoding: "utf8", timeout: 30_000, cwd: import.meta.dirname });
}

test("there are as many workers as cores", async () => {
  const workers = await chasles.workers();
  assert.equal(workers.count, availableParallelism());
  workers.stop();
});

test("options are those of firstContactBatch, and refused in the same words before anything is sent", async () => {
  const { workers, held } = await countedWorkers(1);
  for (const options of [{ margin: () => 1 }, { find: Symbol("first") }, { centre: () => 1, motion: "sweep" }, { fixedStart: () => far }, { hold: "1" }, { fixedCentre: far }, 3, null]) {
    const expected = refusal(() => chasles.firstContactBatch(cube, cube, starts, goals, options));
    assert.equal(await refusal(workers.firstContactBatch(cube, cube, starts, goals, options)), expected);
  }
  assert.deepEqual(await held(), [0]);
  const given = { motion: "velocity", centre: new Uint8Array(3), fixedStart: far, fixedGoal: far, fixedCentre: [0, 0, 0] };
  assert.deepEqual(await workers.firstContactBatch(cube, cube, starts, goals, given), chasles.firstContactBatch(cube, cube, starts, goals, given));
  workers.stop();
});

test("whatever fails when a job is sent or answered fails the job, and the process ends", () => {
  const { stdout, stderr, status } = run(`
    const said = ({ name, message }) => console.log(name, message);
    const ask = (workers, options) => workers.firstContactBatch(cube, cube, [[5, 0, 0]], [[0, 0, 0]], options).then((answers) => console.log(answers.length), said);
    await ask(await chasles.workers({ count: 1 }), { margin: () => 1 });
    let broken = null;
    const worker = () => {
      const made = new Worker(new URL(import.meta.resolve("chasles/worker")), { execArgv: [] });
      const send = made.postMessage.bind(made);
      made.postMessage = (message) => {
        if (message.task === broken) throw new Error("not sent: " + broken);
        send(message);
        if (broken === "unreadable") made.emit("messageerror", new Error("x"));
      };
      return made;
    };
    for (const task of ["batch", "body", "unreadable"]) {
      broken = null;
      const workers = await chasles.workers({ count: 1, worker });
      broken = task;
      await ask(workers);
      broken = null;
      await ask(workers);
    }
    const chatty = await chasles.workers({ count: 1, worker: () => new Worker('import("' + import.meta.resolve("chasles/worker") + '"); const port = require("node:worker_threads").parentPort; for (const said of [null, undefined, 3, "ready", {}]) port.postMessage(said);', { eval: true, execArgv: [] }) });
    await ask(chatty);
    await chasles.workers({ count: 1, worker: () => new Worker(new URL("file:///nowhere/worker.js")) }).catch(({ message }) => console.log(message.slice(0, 111)));`);
  const lines = stdout.trimEnd().split("\n");
  assert.equal(status, 0, stderr);
  assert.match(lines[0], /^InvalidInput margin: .* is not a number$/);
  assert.deepEqual(lines.slice(1), [
    "Error not sent: batch", "1", // the worker goes on
    "Error not sent: body", "Error not sent: body", // it lacks a body, and is not asked again
    ...Array(2).fill("Error chasles: an answer of a worker could not be read"),
    "1",
    "chasles: a worker cannot be started: its script was not found, or is not read as a module (Cannot find module '",
  ]);
});

test("a count of workers is bounded, in words", async () => {
  for (const count of [1e9, 1025, Infinity, 0, -1, 1.5, "2"])
    assert.match(await refusal(chasles.workers({ count })), /^count: must be a whole number from 1 to 1024$/);
});

test("workers whose script never answers are given up after 30 seconds without any answer, and stopped", async (t) => {
  t.mock.timers.enable({ apis: ["setInterval"] });
  const settled = async () => {
    for (let i = 0; i < 20; ++i) await Promise.resolve();
  };
  const made = [];
  const worker = () => made[made.push({ postMessage: (message) => (made.at(-1).asked = message), terminate: () => (made.isStopped = true) }) - 1];
  let message = null;
  const waiting = chasles.workers({ count: 2, worker }).catch((error) => (message = error.message));
  await settled();
  const wait = async (seconds) => {
    t.mock.timers.tick(1000 * seconds);
    await settled();
  };
  await wait(29);
  assert.equal(message, null);
  made[0].onmessage({ data: { job: 1 } }); // a slow machine: one of them has come up
  await settled();
  await wait(29);
  assert.equal(message, null, "its answer begins anew");
  await wait(1);
  await waiting;
  assert.match(message, /^chasles: a worker has not answered for 30 seconds: .* must run chasles\/worker$/);
  assert.ok(made.isStopped);
  const quick = chasles.workers({ count: 1, worker });
  await settled();
  made.at(-1).onmessage({ data: { job: 1 } });
  assert.equal((await quick).count, 1);
  await wait(100);
});

test("a process ends without stop(), and not before its answers are there", () => {
  const ask = "console.log((await workers.firstContactBatch(cube, cube, [[5, 0, 0]], [[0, 0, 0]])).length);";
  const factory = 'worker: () => new Worker(new URL(import.meta.resolve("chasles/worker")), { execArgv: [] })';
  for (const options of ["count: 2", `count: 1, ${factory}`, `count: 1, worker: async () => (${factory.slice(8)})()`]) {
    const { stdout, stderr, status } = run(`const workers = await chasles.workers({ ${options} }); ${ask} ${ask}`);
    assert.deepEqual([stdout, status], ["1\n1\n", 0], stderr);
  }
});

test("workers that cannot work fail, and nothing hangs", () => {
  const { stdout } = run(`for (const script of ["process.exit(3)", "throw new Error('broken')"])
    await chasles.workers({ count: 1, worker: () => new Worker(script, { eval: true }) }).catch(({ message }) => console.log(message));`);
  assert.deepEqual(stdout.trim().split("\n"), ["chasles: a worker has ended", "broken"]);
});
