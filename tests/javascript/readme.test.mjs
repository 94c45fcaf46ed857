// The code of the package's README, and of the guide that tools/wasm_check.sh puts beside this file, runs, and prints what its
// comments say.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import { box } from "./shapes.mjs";

const readme = fileURLToPath(import.meta.resolve("chasles/package.json")).replace("package.json", "README.md");
const guide = fileURLToPath(new URL("./javascript.md", import.meta.url));

test("the worker of the guide answers", async () => {
  const [, code] = /```javascript\n(\/\/ asking\.js\n.*?)```/s.exec(readFileSync(guide, "utf8"));
  const self = `import { parentPort } from "node:worker_threads";
    globalThis.self = { set onmessage(work) { parentPort.on("message", (data) => work({ data })); }, postMessage: (answer) => parentPort.postMessage(answer) };`;
  writeFileSync(new URL("./self.mjs", import.meta.url), self);
  writeFileSync(new URL("./asking.mjs", import.meta.url), `import "./self.mjs";\n${code}`);
  const worker = new Worker(new URL("./asking.mjs", import.meta.url));
  const answer = new Promise((resolve, reject) => worker.on("message", resolve).on("error", reject));
  worker.postMessage({ points: box().vertices, faces: box().faces, path: [[5, 0, 0], [4, 0, 0], [0, 0, 0]] });
  const { verdict, segment } = await answer;
  assert.deepEqual([verdict, segment], ["contact", 1]);
  await worker.terminate();
});

for (const [name, document, fewest] of [["README", readme, 9], ["guide", guide, 5]]) {
  test(`the code of the ${name} prints what it says`, () => {
    const code = [...readFileSync(document, "utf8").matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]).join("\n");
    const expected = [...code.matchAll(/^ *(?:if \(.*\) )?console\.log\(.*\); \/\/ (.*)$/gm)].map((match) => match[1]);
    assert.ok(expected.length >= fewest);
    const file = new URL(`./${name}_code.mjs`, import.meta.url);
    writeFileSync(file, code);
    const { stdout, stderr, status } = spawnSync(process.execPath, [fileURLToPath(file)], { encoding: "utf8" });
    assert.equal(status, 0, stderr);
    assert.deepEqual(stdout.trimEnd().split("\n"), expected);
  });

  test(`the first code of the ${name} takes bodies that overlap at the start, too`, () => {
    const [, first] = /```js\n(.*?)```/s.exec(readFileSync(document, "utf8"));
    const code = first.replace(/(firstContact\(\w+, \w+), \[.*?\]/, "$1, [0.3, 0.2, 0.1]");
    assert.notEqual(code, first);
    const file = new URL(`./${name}_overlap.mjs`, import.meta.url);
    writeFileSync(file, code);
    const { stdout, stderr, status } = spawnSync(process.execPath, [fileURLToPath(file)], { encoding: "utf8" });
    assert.equal(status, 0, stderr);
    assert.match(stdout, /^contact_at_start /);
  });
}
