// The plain build: chasles.wasm is a file beside this one.
import { Chasles } from "./chasles.js";
import { besideScript, compiled } from "./module.js";
import { fromFile } from "./new_worker.js";
import { checkOptions } from "./values.js";

export { Chasles };
export { InstanceStopped, InvalidInput } from "./errors.js";
export { Polyhedron } from "./polyhedron.js";
export { DraggedBody, Scene } from "./scene.js";

/** Makes an instance of the library. `wasm` stands for chasles.wasm if that lies elsewhere. */
export async function load(options = {}) {
  checkOptions(options, ["wasm"]);
  const { wasm = besideScript(() => new URL("./chasles.wasm", import.meta.url)) } = options;
  return Chasles.of(await compiled(wasm), fromFile);
}
