// Makes the folder that `npm pack` packs: node assemble.mjs CHASLES.WASM VERSION FOLDER.
import { copyFileSync, cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const [wasm, version, folder] = process.argv.slice(2);
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
// Last: the build takes the package for made where this file is newer than what it is made from.
const description = JSON.parse(readFileSync(here("package.json"), "utf8"));
writeFileSync(`${folder}/package.json`, `${JSON.stringify({ ...description, version }, null, 2)}\n`);
