// The WebAssembly module of whatever `load` is given.

const isFile = (url) => url instanceof URL && url.protocol === "file:";

async function bytesOfFile(url) {
  const name = "node:fs/promises"; // a name that bundlers for browsers do not follow
  const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
  return readFile(url);
}

async function compileResponse(response) {
  if (!response.ok) throw new Error(`chasles: ${response.url} cannot be loaded (${response.status})`);
  const isTyped = response.headers.get("Content-Type")?.startsWith("application/wasm");
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** `source`: a URL, a Response, bytes, or a module. */
export async function compiled(source) {
  const given = await source;
  if (given instanceof WebAssembly.Module) return given;
  if (given instanceof ArrayBuffer || ArrayBuffer.isView(given)) return WebAssembly.compile(given);
  if (typeof Response !== "undefined" && given instanceof Response) return compileResponse(given);
  return isFile(given) ? WebAssembly.compile(await bytesOfFile(given)) : compileResponse(await fetch(given));
}
