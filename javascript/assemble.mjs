// Makes the folder that `npm pack` packs: node assemble.mjs CHASLES.WASM VERSION FOLDER BUNDLER. BUNDLER is a folder in which
// esbuild is installed.
import { copyFileSync, cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const [wasm, version, folder, bundler] = process.argv.slice(2);
const { build } = createRequire(`${resolve(bundler)}/`)("esbuild");
const here = (file) => fileURLToPath(new URL(file, import.meta.url));

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
cpSync(here("chasles"), folder, { recursive: true });
writeFileSync(`${folder}/chasles.wasm`, readFileSync(wasm)); // not executable, as the linker made it
copyFileSync(here("README.md"), `${folder}/README.md`);
copyFileSync(here("../LICENSE"), `${folder}/LICENSE`);
const packed = deflateRawSync(readFileSync(wasm), { level: 9 });
writeFileSync(
  `${folder}/chasles.wasm.js`,
  `// chasles.wasm, compressed (raw deflate) and as text.\nexport const base64 =\n  "${packed.toString("base64")}";\n`,
);

async function bundled(file, options) {
  const { outputFiles } = await build({
    entryPoints: [resolve(folder, file)], bundle: true, minify: true, target: "es2022", charset: "ascii", write: false, ...options,
  });
  return outputFiles[0].text;
}

const scriptOfWorkers = await bundled("worker.js", { format: "iife" });
writeFileSync(
  `${folder}/worker_script.js`,
  `// worker.js with all that it imports, as text.\nexport const script =\n  ${JSON.stringify(scriptOfWorkers)};\n`,
);
const script = await bundled("inline.js", {
  format: "iife",
  globalName: "chasles",
});
writeFileSync(`${folder}/script.js`, `// chasles for a script element without modules: the global "chasles" has what "chasles/inline" exports.\n${script}`);

// Last: the build takes the package for made where this file is newer than what it is made from.
const description = JSON.parse(readFileSync(here("package.json"), "utf8"));
writeFileSync(`${folder}/package.json`, `${JSON.stringify({ ...description, version }, null, 2)}\n`);
