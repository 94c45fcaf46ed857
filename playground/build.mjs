// Makes the page: node build.mjs SHAPES.WASM PACKAGE PAGE. Everything is in it: the program, its workers with the library, the
// meshes, the style.
import { build, transform } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const [shapesModule, packageFolder, page] = process.argv.slice(2);
const here = (file) => fileURLToPath(new URL(file, import.meta.url));
const text = (file) => readFileSync(here(file), "utf8");

/** What playground/shapes/shapes.cpp writes. The module asks the system for nothing. */
async function generated() {
  const module = await WebAssembly.compile(readFileSync(shapesModule));
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => 52;
  const { exports } = await WebAssembly.instantiate(module, imports);
  exports._initialize();
  const address = exports.shapes(); // before the memory is looked at, which grows meanwhile
  const bytes = new Uint8Array(exports.memory.buffer, address);
  return JSON.parse(new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0))));
}

/** Modules whose text is made here, by name. */
const made = (modules) => ({
  name: "made",
  setup(step) {
    step.onResolve({ filter: new RegExp(`^(${Object.keys(modules).join("|")})$`) }, ({ path }) => ({ path, namespace: "made" }));
    step.onLoad({ filter: /.*/, namespace: "made" }, ({ path }) => ({ contents: modules[path], loader: "js" }));
  },
});

async function bundled(entry, modules) {
  const result = await build({
    entryPoints: [here(entry)],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "none", // the page contains the whole licence of three.js instead
    alias: { chasles: resolve(packageFolder, "inline.js") },
    define: { "import.meta.url": '"about:blank"' }, // the page starts its workers itself
    plugins: [made(modules)],
    write: false,
  });
  const script = result.outputFiles[0].text.trim();
  if (/<\/script|<!--/i.test(script)) throw new Error(`${entry}: contains what ends a script element`);
  return script;
}

const { shapes, places } = await generated();
const packedShapes = deflateRawSync(JSON.stringify(shapes), { level: 9 }).toString("base64");
const parts = {
  LICENCES: `three.js\n\n${text("../node_modules/three/LICENSE")}`,
  STYLE: (await transform(text("src/style.css"), { loader: "css", minify: true })).code.trim(),
  WORKER: await bundled("src/worker.ts", { shapes: text("src/packed_shapes.js").replace("@SHAPES@", packedShapes) }),
  SCRIPT: await bundled("src/main.ts", { places: `export const places = ${JSON.stringify(places)};` }),
};
mkdirSync(dirname(page), { recursive: true });
writeFileSync(page, text("page.html").replace(/@(LICENCES|STYLE|WORKER|SCRIPT)@/g, (_, name) => parts[name]));
