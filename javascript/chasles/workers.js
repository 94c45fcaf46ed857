// Workers with an instance each: Web Workers in a browser, worker threads in Node.js.
import { InvalidInput } from "./errors.js";
import { dispose } from "./held.js";
import { newWorker } from "./new_worker.js";
import { checkBatch, checkOptions } from "./numbers.js";
import { Polyhedron } from "./polyhedron.js";

const isNode = Boolean(globalThis.process?.versions?.node);

/** A worker of either kind, behind the same three functions. */
async function startWorker(make) {
  if (make) return browserWorker(make());
  if (!isNode) return browserWorker(newWorker());
  const threads = "node:worker_threads"; // a name that bundlers for browsers do not follow
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ /* webpackIgnore: true */ threads);
  const worker = new NodeWorker(new URL("./worker.js", import.meta.url));
  return {
    send: (message) => worker.postMessage(message),
    receive: (onMessage, onError) => worker.on("message", onMessage).on("error", onError),
    stop: () => void worker.terminate(),
  };
}

function browserWorker(worker) {
  return {
    send: (message) => worker.postMessage(message),
    receive: (onMessage, onError) => {
      worker.onmessage = ({ data }) => onMessage(data);
      worker.onerror = (event) => onError(new Error(event.message ?? "the worker could not be started"));
    },
    stop: () => worker.terminate(),
  };
}

const cores = () => globalThis.navigator?.hardwareConcurrency ?? 4;

/** A worker with the jobs that it has not answered yet. */
class Mate {
  #worker;
  #waiting = new Map();
  #sent = new WeakMap(); // bodies that the worker has, with their numbers there
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
      this.#worker.send({ ...message, job });
    });
  }

  /** The number of a body in the worker, which gets a copy at first. */
  body(body) {
    if (!this.#sent.has(body)) {
      const number = this.#next++;
      const copy = Polyhedron.copy(body);
      this.#sent.set(body, number);
      this.ask({ task: "body", number, copy }).catch((error) => this.fail(error));
    }
    return this.#sent.get(body);
  }

  fail(error) {
    this.#failure ??= error;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }

  stop() {
    this.#worker.stop();
    this.fail(new InvalidInput("workers: have been stopped"));
  }

  #settle({ job, answer, error }) {
    const waiting = this.#waiting.get(job);
    this.#waiting.delete(job);
    if (!waiting) return;
    if (!error) waiting.resolve(answer);
    else waiting.reject(error.isInput ? new InvalidInput(error.message) : new Error(error.message));
  }
}

export class Workers {
  #mates;

  constructor(mates) {
    this.#mates = mates;
  }

  static async start(module, options) {
    checkOptions(options, ["count", "worker"]);
    const { count = cores(), worker } = options;
    if (!Number.isInteger(count) || count < 1) throw new InvalidInput("count: must be a whole number from 1");
    const mates = [];
    for (let i = 0; i < count; ++i) mates.push(new Mate(await startWorker(worker)));
    const workers = new Workers(mates);
    try {
      await Promise.all(mates.map((mate) => mate.ask({ task: "open", module })));
    } catch (error) {
      workers.stop();
      throw error;
    }
    return workers;
  }

  get count() {
    return this.#mates.length;
  }

  /** One answer a motion, in order: the answers of `Chasles.firstContactBatch`. */
  async firstContactBatch(moving, fixed, starts, goals, options = {}) {
    checkBatch(starts, goals);
    const size = Math.max(1, Math.ceil(starts.length / (4 * this.count)));
    const from = (list, begin) => Array.from(list).slice(begin, begin + size);
    const chunks = [];
    for (let begin = 0; begin < starts.length; begin += size)
      chunks.push({ begin, starts: from(starts, begin), goals: from(goals, begin) });
    const answers = new Array(chunks.length);
    let next = 0;
    const run = async (mate) => {
      while (next < chunks.length) {
        const chunk = next++;
        const bodies = { moving: mate.body(moving), fixed: mate.body(fixed) };
        answers[chunk] = await mate.ask({ task: "batch", ...bodies, ...chunks[chunk], options });
      }
    };
    await Promise.all(this.#mates.map(run));
    return answers.flat();
  }

  stop() {
    for (const mate of this.#mates) mate.stop();
  }
  [dispose]() {
    this.stop();
  }
}
