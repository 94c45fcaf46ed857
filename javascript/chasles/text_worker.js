// Workers of the inlined build: their script is a text, so that no file has to be found. worker_script.js is made by
// assemble.mjs.
import { script } from "./worker_script.js";

let address;

export const fromText = {
  hasText: true,
  inBrowser: () => new Worker((address ??= URL.createObjectURL(new Blob([script], { type: "text/javascript" })))),
  inNode: (NodeWorker) => new NodeWorker(script, { eval: true, execArgv: [] }),
};
