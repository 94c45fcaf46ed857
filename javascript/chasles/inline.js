// The inlined build: the module is in a script, so that nothing is fetched.
import { Chasles } from "./chasles.js";
import { base64 } from "./chasles.wasm.js";
import { compiled, withoutFile } from "./module.js";
import { builtin, isNode } from "./node.js";
import { fromText } from "./text_worker.js";
import { checkOptions } from "./values.js";

export { Chasles };
export { InstanceStopped, InvalidInput } from "./errors.js";
export { Polyhedron } from "./polyhedron.js";
export { DraggedBody, Scene } from "./scene.js";

/**
 * The module. A browser compiles it while it is unpacked. Node.js takes its own zlib: environments of tests (jsdom, happy-dom) replace
 * Blob and Response.
 */
async function unpacked() {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i); // Uint8Array.from takes ten times as long
  if (isNode) return (await builtin("node:zlib")).inflateRawSync(bytes);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream, { headers: { "Content-Type": "application/wasm" } });
}

/** Makes an instance of the library. `wasm` stands for the module in the script. */
export async function load(options = {}) {
  checkOptions(options, ["wasm"]);
  const { wasm = unpacked() } = options;
  return Chasles.of(await compiled(wasm, options.wasm === undefined ? withoutFile.own : withoutFile.given), fromText);
}
