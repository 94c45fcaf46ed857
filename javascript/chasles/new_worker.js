// Workers of the plain build: their script is a file beside this one. Each call is written so that bundlers see the file. A bundle as
// CommonJS does not know its own address; workers.js says so.
export const fromFile = {
  inBrowser: () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" }),
  inNode: (NodeWorker) => new NodeWorker(new URL("./worker.js", import.meta.url), { execArgv: [] }), // none of --input-type
};
