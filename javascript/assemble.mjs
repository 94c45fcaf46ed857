// Makes the folder that `npm pack` packs: node assemble.mjs CHASLES.WASM VERSION FOLDER.
import { copyFileSync, cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const [wasm, version, folder] = process.argv.slice(2);
const here = (file) => fileURLToPath(new URL(file, import.meta.url));

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
cpSync(here("chasles"), folder, { recursive: true });
copyFileSync(wasm, `${folder}/chasles.wasm`);
copyFileSync(here("README.md"), `${folder}/README.md`);
copyFileSync(here("../LICENSE"), `${folder}/LICENSE`);
writeFileSync(
  `${folder}/chasles.wasm.js`,
  `// chasles.wasm as text.\nexport const base64 =\n  "${readFileSync(wasm).toString("base64")}";\n`,
);
// Last: the build takes the package for made where this file is newer than what it is made from.
const description = JSON.parse(readFileSync(here("package.json"), "utf8"));
writeFileSync(`${folder}/package.json`, `${JSON.stringify({ ...description, version }, null, 2)}\n`);
