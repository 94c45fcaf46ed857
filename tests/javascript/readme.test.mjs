// The code of the package's README runs, and prints what its comments say.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { test } from "node:test";

const readme = readFileSync(fileURLToPath(import.meta.resolve("chasles/package.json")).replace("package.json", "README.md"), "utf8");

test("the README's code prints what it says", () => {
  const code = [...readme.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]).join("\n");
  const expected = [...code.matchAll(/^ *console\.log\(.*\); \/\/ (.*)$/gm)].map((match) => match[1]);
  assert.ok(expected.length > 8);
  const file = new URL("./readme_code.mjs", import.meta.url);
  writeFileSync(file, code);
  const { stdout, stderr, status } = spawnSync(process.execPath, [fileURLToPath(file)], { encoding: "utf8" });
  assert.equal(status, 0, stderr);
  assert.deepEqual(stdout.trimEnd().split("\n"), expected);
});
