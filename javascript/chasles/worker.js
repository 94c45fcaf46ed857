// The other side of workers.js: an instance that answers parts of batches.
import { Chasles } from "./chasles.js";
import { InvalidInput } from "./errors.js";
import { builtin, isNode } from "./node.js";

let chasles = null;
const bodies = new Map();

function batch({ moving, fixed, begin, starts, goals, options }) {
  return starts.map((start, i) => {
    try {
      return chasles.firstContact(bodies.get(moving), bodies.get(fixed), start, goals[i], options);
    } catch (error) {
      throw error instanceof InvalidInput ? new InvalidInput(`motion ${begin + i}: ${error.message}`) : error;
    }
  });
}

const tasks = {
  async open({ module }) {
    chasles = await Chasles.of(module);
  },
  body({ number, copy }) {
    bodies.set(number, Chasles.adopt(chasles, copy));
  },
  free({ number }) {
    bodies.get(number)?.free();
    bodies.delete(number);
  },
  held: () => chasles.held,
  batch,
};

/** Every job is answered, also one whose answer cannot be sent. */
async function answer(message, post) {
  const { job } = message;
  try {
    post({ job, answer: await tasks[message.task](message) });
  } catch (error) {
    post({ job, error: { message: error.message, kind: error.name } });
  }
}

if (isNode) {
  const listen = ({ parentPort }) => parentPort.on("message", (message) => answer(message, (said) => parentPort.postMessage(said)));
  builtin("node:worker_threads").then(listen); // no "await": script.js has no modules
} else {
  globalThis.onmessage = ({ data }) => answer(data, (said) => globalThis.postMessage(said));
}
