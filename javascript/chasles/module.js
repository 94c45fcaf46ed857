// The WebAssembly module of whatever `load` is given. A refusal says where the module was looked for, and the way out.
import { InvalidInput } from "./errors.js";
import { builtin, isNode } from "./node.js";
import { asBytes, isArrayBuffer } from "./values.js";

const schemesOfNode = ["http:", "https:", "file:", "data:", "blob:"];
const wayOut = isNode
  ? 'give the bytes of chasles.wasm, or pathToFileURL(path) of node:url, or, in Next.js, name the package in serverExternalPackages, or import "chasles/inline", which needs no file'
  : 'import "chasles/inline", which fetches nothing, or give load({ wasm: url }) the address of chasles.wasm';
/** Of the builds that have the module in themselves. */
export const withoutFile = {
  given: "leave wasm out: load() of this build has the module in its script, and needs no file",
  own: "Node.js 20.12, Chrome 103, Firefox 113 and Safari 16.4 are new enough",
};

/** Also of another realm: of a frame, or of Node.js in an environment of tests. */
const isA = (value, name) => Object.prototype.toString.call(value) === `[object ${name}]`;

/** A refusal that gets its way out where the build is known. */
class NoModule extends Error {}

function refuse(what) {
  throw new NoModule(what);
}

async function bytesOfFile(url) {
  const { readFile } = await builtin("node:fs/promises");
  return readFile(url).catch((error) => refuse(`${url.href} cannot be read (${error.message})`));
}

/** An address; a path alone is one in a browser, where it counts from the page. */
function addressOf(given) {
  const base = isNode ? undefined : (globalThis.document?.baseURI ?? globalThis.location?.href);
  let url;
  try {
    url = new URL(given, base?.startsWith("blob:") ? undefined : base);
  } catch {
    return refuse(`"${given}" is no URL`);
  }
  return isNode && !schemesOfNode.includes(url.protocol) ? refuse(`"${given}" is no URL that can be fetched`) : url;
}

const isModule = (bytes) => [0, 97, 115, 109].every((byte, i) => bytes[i] === byte); // "\0asm"

function compileBytes(given, where) {
  const bytes = asBytes(given, "wasm");
  return isModule(bytes) ? WebAssembly.compile(bytes) : refuse(`${where} no WebAssembly module`);
}

async function compileResponse(response) {
  const address = response.url || "the response";
  if (response.bodyUsed || response.body?.locked) refuse(`${address} has been read already`);
  if (!response.ok) refuse(`${address} answers with status ${response.status}`);
  const type = response.headers.get("Content-Type") ?? "";
  if (type.startsWith("application/wasm") && WebAssembly.compileStreaming) return WebAssembly.compileStreaming(response);
  if (type.startsWith("text/html")) refuse(`${address} is a web page, as servers answer for files that they do not find`);
  return compileBytes(await response.arrayBuffer(), `${address} is`);
}

async function fetched(given) {
  const url = addressOf(given);
  if (isNode && url.protocol === "file:") return compileBytes(await bytesOfFile(url), `${url.href} is`);
  return compileResponse(await fetch(url).catch((error) => refuse(`${url.href} cannot be fetched (${error.message})`)));
}

async function compiledFrom(given) {
  if (isA(given, "WebAssembly.Module")) return given;
  if (isArrayBuffer(given) || ArrayBuffer.isView(given)) return compileBytes(given, "the bytes are");
  if (isA(given, "Response")) return compileResponse(given);
  if (isA(given, "URL") || typeof given === "string") return fetched(given);
  return refuse(`${Array.isArray(given) ? "an array" : String(given)} is no URL, Response, bytes or WebAssembly.Module`);
}

/** Browsers refuse to compile where the page forbids it. */
function inWords(error, way) {
  if (error instanceof NoModule) return new InvalidInput(`wasm: ${error.message}: ${way}`);
  if (/content security policy|unsafe-eval/i.test(error.message))
    return new InvalidInput("wasm: the Content-Security-Policy of the page forbids WebAssembly: its script-src needs 'wasm-unsafe-eval'");
  if (/disallowed by embedder/i.test(error.message))
    return new InvalidInput('wasm: this environment compiles no WebAssembly while it runs, as Cloudflare Workers: give load({ wasm }) the module of an import: import wasm from "./chasles.wasm"');
  if (error instanceof WebAssembly.CompileError) return new InvalidInput(`wasm: is damaged or cut off, or needs a newer engine (${error.message}): ${way}`);
  return error;
}

/** chasles.wasm beside a script. `find` makes the URL: it stands in the script, where bundlers see it. Bundles as CommonJS have no address. */
export function besideScript(find) {
  try {
    return find();
  } catch {
    throw new InvalidInput(`wasm: this bundle does not know its own address, so that chasles.wasm is not found beside it: ${wayOut}`);
  }
}

async function compiledOurs(source) {
  const module = await compiledFrom(await source);
  const names = WebAssembly.Module.exports(module).map(({ name }) => name);
  return names.includes("chasles_first_contact") ? module : refuse("is another module than chasles.wasm");
}

/** `source`: a URL, a Response, bytes, or a module; or a promise of one. `way`: the way out of a refusal. */
export async function compiled(source, way = wayOut) {
  return compiledOurs(source).catch((error) => {
    throw inWords(error, way);
  });
}
