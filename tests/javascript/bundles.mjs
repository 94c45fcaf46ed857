// Bundles a small program around the package, as its users do: node bundles.mjs BUNDLER FOLDER. BUNDLER is a folder in which
// esbuild is installed; FOLDER gets plain/, loaded/ and inlined/.
import { copyFileSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [bundler, folder] = process.argv.slice(2);
const { build } = createRequire(`${resolve(bundler)}/`)("esbuild");
const here = fileURLToPath(new URL(".", import.meta.url));

/** Bundles a program of one line after the import of the question. */
async function bundle(name, line, options) {
  const contents = `import { ask } from "./question.mjs";\n${line}`;
  await build({ stdin: { contents, resolveDir: here }, bundle: true, minify: true, outfile: `${folder}/${name}/app.js`, ...options });
}

const ownWorker = '{ worker: () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" }) }';
mkdirSync(`${folder}/plain`, { recursive: true });
await bundle("plain", `import { load } from "chasles"; ask(load, {}, ${ownWorker});`, { format: "esm" });
await build({ entryPoints: [fileURLToPath(import.meta.resolve("chasles/worker"))], bundle: true, minify: true, format: "esm", outfile: `${folder}/plain/worker.js` });
copyFileSync(fileURLToPath(import.meta.resolve("chasles/chasles.wasm")), `${folder}/plain/chasles.wasm`);
await bundle("loaded", 'import { load } from "chasles"; import wasm from "chasles/chasles.wasm"; ask(load, { wasm });', { format: "esm", loader: { ".wasm": "file" } });
await bundle("inlined", 'import { load } from "chasles/inline"; ask(load, {}, {});', { format: "iife", logOverride: { "empty-import-meta": "silent" } });
