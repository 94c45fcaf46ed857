// The inlined build: the module is in a script, so that nothing is fetched.
import { Chasles } from "./chasles.js";
import { base64 } from "./chasles.wasm.js";
import { compiled } from "./module.js";

export { Chasles };
export { InstanceStopped, InvalidInput } from "./errors.js";
export { Polyhedron } from "./polyhedron.js";
export { DraggedBody, Scene } from "./scene.js";

/** The module, unpacked. */
function unpacked() {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}

/** Makes an instance of the library. `wasm` stands for the module in the script. */
export async function load({ wasm } = {}) {
  return Chasles.of(await compiled(wasm ?? unpacked()));
}
