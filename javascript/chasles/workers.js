// Workers with an instance each: Web Workers in a browser, worker threads in Node.js.
import { InvalidInput } from "./errors.js";
import { bindMembers, dispose, Held } from "./held.js";
import { builtin, isNode } from "./node.js";
import { checkBatch, checkContactOptions } from "./numbers.js";
import { Polyhedron } from "./polyhedron.js";
import { copiedPose } from "./poses.js";
import { checkOptions } from "./values.js";

/** A worker of either kind, behind the same functions. The kind is that of the worker: in Node.js there are both. */
function adapted(worker, why) {
  if (typeof worker?.postMessage !== "function" || typeof worker.terminate !== "function")
    throw new InvalidInput("worker: must make a Worker");
  return typeof worker.on === "function" ? nodeWorker(worker, why) : webWorker(worker, why);
}

async function startWorker(make, newWorker) {
  if (make !== undefined && typeof make !== "function") throw new InvalidInput("worker: must be a function that makes a Worker");
  if (make) return adapted(await make(), notStarted);
  const why = newWorker.hasText ? forbidden : notStarted;
  if (!isNode && typeof Worker === "undefined") throw new InvalidInput(noWorkers);
  if (!isNode) return adapted(started(() => newWorker.inBrowser(), why), why);
  const { Worker: NodeWorker } = await builtin("node:worker_threads");
  return adapted(started(() => newWorker.inNode(NodeWorker), why), why);
}

/** Pages may forbid workers, and bundles as CommonJS do not know their own address. */
function started(start, why) {
  try {
    return start();
  } catch (error) {
    const isUntrusted = /TrustedScriptURL|sink type/i.test(error.message);
    throw new Error((isUntrusted ? untrusted : why)(error.message), { cause: error });
  }
}

/** What a worker of Node.js fails with. Bundles for servers may take a module for a script of CommonJS. */
function failureOf(error, why) {
  const isScriptMissing = ["MODULE_NOT_FOUND", "ERR_MODULE_NOT_FOUND"].includes(error?.code) || error?.name === "SyntaxError";
  return isScriptMissing ? new Error(why(error.message), { cause: error }) : error;
}

/** While it waits for nothing, a worker does not keep the process alive. */
function nodeWorker(worker, why) {
  worker.unref();
  return {
    send: (message) => worker.postMessage(message),
    receive: (onMessage, onError) =>
      worker
        .on("message", onMessage)
        .on("error", (error) => onError(failureOf(error, why)))
        .on("messageerror", () => onError(new Error(notRead)))
        .on("exit", () => onError(new Error("chasles: a worker has ended"))),
    wait: (isWaiting) => (isWaiting ? worker.ref() : worker.unref()),
    stop: () => void worker.terminate(),
  };
}

const notRead = "chasles: an answer of a worker could not be read";
const cannotStart = (cause, reason) => `chasles: a worker cannot be started: ${cause}${reason ? ` (${reason})` : ""}; `;
const notStarted = (reason) =>
  cannotStart(isNode ? "its script was not found, or is not read as a module" : "its script was not found, or the page forbids it (worker-src)", reason) +
  'import "chasles/inline", which has the script in itself, or give workers({ worker }) a function that makes a Worker of chasles/worker' +
  (isNode ? '; a bundler for a server may leave chasles out (Next.js: serverExternalPackages: ["chasles"])' : "");
/** Of the builds whose script is a text. */
const forbidden = (reason) =>
  cannotStart("the page forbids it", reason) + "its Content-Security-Policy needs worker-src blob:, or give workers({ worker }) a function that makes a Worker";

const untrusted = (reason) =>
  cannotStart("the page demands Trusted Types", reason) + "give workers({ worker }) a function that makes a Worker of chasles/worker, by a TrustedScriptURL of a policy of yours";
const noWorkers =
  "workers: there is no Worker here, as in a service worker: make them in the page or in a dedicated worker, or ask here without them (firstContactBatch of the instance)";

function webWorker(worker, why) {
  return {
    send: (message) => worker.postMessage(message),
    receive: (onMessage, onError) => {
      worker.onmessage = ({ data }) => onMessage(data);
      worker.onmessageerror = () => onError(new Error(notRead));
      worker.onerror = (event) => onError(new Error(event.message ? `chasles: a worker failed: ${event.message}` : why()));
    },
    wait: () => undefined,
    stop: () => worker.terminate(),
  };
}

const most = 1024; // a page with more workers than any machine has cores would freeze
const patience = 30; // seconds

/**
 * The answers, or an Error if a worker whose script is another one stays silent. An interval counts the seconds, and any answer begins
 * anew: a machine that sleeps, is slow, or has many workers to start loses no time.
 */
function answeredInTime(answers) {
  let clock;
  const silence = new Promise((_, reject) => {
    let silent = 0;
    for (const answer of answers) answer.then(() => (silent = 0), reject);
    const count = () => ++silent < patience || reject(new Error(notAnswered));
    clock = setInterval(count, 1000);
    clock.unref?.();
  });
  return Promise.race([Promise.all(answers), silence]).finally(() => clearInterval(clock));
}

const notAnswered = `chasles: a worker has not answered for ${patience} seconds: the script that workers({ worker }) starts must run chasles/worker`;

const coresByDefault = 4; // of a browser that does not say

async function cores() {
  if (!isNode) return Math.min(globalThis.navigator?.hardwareConcurrency ?? coresByDefault, most);
  const { availableParallelism } = await builtin("node:os");
  return Math.min(availableParallelism(), most);
}

const errorTypes = { InvalidInput, RangeError };

/** A worker with the jobs that it has not answered yet. */
class Mate {
  #worker;
  #waiting = new Map();
  #bodies = new WeakMap(); // bodies that the worker has
  #next = 1;
  #failure = null;

  constructor(worker) {
    this.#worker = worker;
    worker.receive((message) => this.#settle(message), (error) => this.fail(error));
  }

  ask(message) {
    if (this.#failure) return Promise.reject(this.#failure);
    const job = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(job, { resolve, reject });
      this.#worker.wait(true);
      try {
        this.#worker.send({ ...message, job });
      } catch (error) {
        reject(error); // nothing has been sent, and no answer comes
        this.#forget(job);
      }
    });
  }

  /** A body in the worker, which gets a copy at first. It stays there until it is freed here and let go as often as it was held. */
  hold(body) {
    if (!this.#bodies.has(body)) {
      const held = { number: this.#next++, uses: 0, isFreed: false };
      this.#tell({ task: "body", number: held.number, copy: Polyhedron.copy(body) });
      this.#bodies.set(body, held);
      Held.follow(body, () => {
        held.isFreed = true;
        this.#drop(held);
      });
    }
    const held = this.#bodies.get(body);
    ++held.uses;
    return held;
  }

  letGo(held) {
    --held.uses;
    this.#drop(held);
  }

  #drop({ number, uses, isFreed }) {
    if (isFreed && uses === 0 && !this.#failure) this.#tell({ task: "free", number });
  }

  #tell(message) {
    this.ask(message).catch((error) => this.fail(error));
  }

  fail(error) {
    this.#failure ??= error;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
    this.#worker.wait(false);
  }

  stop() {
    this.fail(new InvalidInput("workers: have been stopped"));
    this.#worker.stop();
  }

  #forget(job) {
    this.#waiting.delete(job);
    if (this.#waiting.size === 0) this.#worker.wait(false);
  }

  #settle(message) {
    const { job, answer, error } = message ?? {}; // the script of a user may say other things, too
    const waiting = this.#waiting.get(job);
    if (!waiting) return;
    this.#forget(job);
    if (!error) waiting.resolve(answer);
    else waiting.reject(new (errorTypes[error.kind] ?? Error)(error.message));
  }
}

/** The poses of a list as arrays, which can be sent. */
function copiedPoses(list, name) {
  return Array.from(list, (pose, i) => copiedPose(pose, `motion ${i}: ${name}`));
}

/** Options that can be sent: numbers, texts and arrays. Poses in them may be objects of three.js. */
function copiedOptions(options) {
  checkContactOptions(options);
  const copied = { ...options };
  for (const name of ["fixedStart", "fixedGoal"])
    if (options[name] !== undefined) copied[name] = copiedPose(options[name], name);
  for (const name of ["centre", "fixedCentre"])
    if (options[name] !== undefined) copied[name] = Array.from(options[name]);
  return copied;
}

export class Workers {
  #border;
  #mates = [];

  constructor(border) {
    this.#border = border;
    bindMembers(this, Workers);
  }

  static async start(border, newWorker, options) {
    checkOptions(options, ["count", "worker"]);
    const { count = await cores(), worker } = options;
    if (!Number.isInteger(count) || count < 1 || count > most) throw new InvalidInput(`count: must be a whole number from 1 to ${most}`);
    const workers = new Workers(border);
    try {
      for (let i = 0; i < count; ++i) workers.#mates.push(new Mate(await startWorker(worker, newWorker)));
      await answeredInTime(workers.#mates.map((mate) => mate.ask({ task: "open", module: border.module })));
    } catch (error) {
      workers.stop();
      throw error;
    }
    return workers;
  }

  get count() {
    return this.#mates.length;
  }

  /** One answer a motion, in order: the answers of `Chasles.firstContactBatch`. Bodies that are freed meanwhile are kept until it ends. */
  async firstContactBatch(moving, fixed, starts, goals, options = {}) {
    for (const [body, name] of [[moving, "moving"], [fixed, "fixed"]]) Held.handle(body, this.#border, Polyhedron, name);
    checkBatch(starts, goals);
    const sent = copiedOptions(options);
    const [from, to] = [copiedPoses(starts, "start"), copiedPoses(goals, "goal")];
    const size = Math.max(1, Math.ceil(from.length / (4 * this.count)));
    const chunks = [];
    for (let begin = 0; begin < from.length; begin += size)
      chunks.push({ begin, starts: from.slice(begin, begin + size), goals: to.slice(begin, begin + size) });
    const answers = new Array(chunks.length);
    let next = 0;
    const run = async (mate) => {
      const held = [];
      try {
        for (const body of [moving, fixed]) held.push(mate.hold(body));
        while (next < chunks.length) {
          const chunk = next++;
          answers[chunk] = await mate.ask({ task: "batch", moving: held[0].number, fixed: held[1].number, ...chunks[chunk], options: sent });
        }
      } finally {
        for (const body of held) mate.letGo(body);
      }
    };
    await Promise.all(this.#mates.slice(0, chunks.length).map(run));
    return answers.flat();
  }

  stop() {
    for (const mate of this.#mates) mate.stop();
  }
  [dispose]() {
    this.stop();
  }
}
