// A worker in a browser, written so that bundlers see the file. In script.js its script is in the same text instead.
export const newWorker = () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
