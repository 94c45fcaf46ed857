// The types say what there is: names, members, options and answers of index.d.ts are compared with those of the running package, and
// the code of the documents compiles under `strict`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import * as plain from "chasles";
import * as inline from "chasles/inline";
import { BoxGeometry, Mesh } from "three";
import { box, refusal } from "./shapes.mjs";

const { load } = plain;
const chasles = await load();
const { vertices, faces } = box();
const cube = chasles.polyhedron(vertices, faces);
const far = [5, 0, 0];
const folder = new URL("./types_made/", import.meta.url);

/** Compiles a program under `strict`; returns the complaints. */
function complaints(name, program) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder);
  writeFileSync(new URL(`${name}.ts`, folder), program);
  const options = { ...JSON.parse(readFileSync(new URL("./tsconfig.json", import.meta.url))).compilerOptions, noUnusedLocals: false };
  assert.ok(options.strict);
  writeFileSync(new URL("tsconfig.json", folder), JSON.stringify({ compilerOptions: options, files: [`${name}.ts`] }));
  const compiler = fileURLToPath(new URL("./node_modules/typescript/bin/tsc", import.meta.url));
  const { stdout, stderr } = spawnSync(process.execPath, [compiler, "-p", fileURLToPath(folder)], { encoding: "utf8" });
  return stdout + stderr;
}

/** An object with these keys for a type with exactly these: a key too many and a key too few are complaints. */
const exactly = (type, names) => `Same<${type}>({ ${names.map((name) => `${JSON.stringify(name)}: true`).join(", ")} });\n`;
const head = `import * as all from "chasles"; import * as inline from "chasles/inline";
declare function Same<T>(keys: { [Key in T & string]: true }): void;
/** The options that a question takes: those of other questions can be undefined only. */
type Taken<T> = { [Key in keyof T]-?: [T[Key]] extends [undefined] ? never : Key }[keyof T];
`;

/** The members of an object and of its classes, without private ones and symbols. */
function membersOf(object) {
  const names = new Set(Object.keys(object));
  for (let type = Object.getPrototypeOf(object); type !== Object.prototype; type = Object.getPrototypeOf(type))
    for (const name of Object.getOwnPropertyNames(type)) if (name !== "constructor") names.add(name);
  return [...names];
}

/** The keys of options, as the refusal of an unknown one lists them. */
const keysOf = (ask) => refusal(() => ask({ unknown: 1 })).replace(/^.*there are /, "").split(", ");

const scene = chasles.scene();
scene.add("a", cube, { pose: far, goal: [-5, 0, 0] });
scene.add("b", cube);
const hand = chasles.draggedBody(scene, "a");
const workers = await chasles.workers({ count: 1 });
const part = chasles.fromObject3D(new Mesh(new BoxGeometry(1, 1, 1)));

test("names and members are those of the types", async () => {
  const program = [
    exactly("keyof typeof all", Object.keys(plain)),
    exactly("keyof typeof inline", Object.keys(inline)),
    ...Object.entries({ Chasles: chasles, Polyhedron: cube, Scene: scene, DraggedBody: hand, Workers: workers, MeshBody: part }).map(
      ([type, object]) => exactly(`keyof all.${type}`, membersOf(object))),
  ].join("");
  workers.stop();
  assert.equal(complaints("names", head + program), "");
  assert.match(complaints("names", head + exactly("keyof typeof all", [...Object.keys(plain), "Extra"])), /Extra/, "the comparison can fail");
  assert.match(complaints("names", head + exactly("keyof typeof all", Object.keys(plain).slice(1))), /missing/, "the comparison can fail");
});

test("options are those of the types", async () => {
  const options = {
    FirstContactOptions: keysOf((given) => chasles.firstContact(cube, cube, far, far, given)),
    LeastDistanceOptions: keysOf((given) => chasles.leastDistance(cube, cube, far, far, given)),
    ProfileOptions: keysOf((given) => chasles.profile(cube, cube, far, far, given)),
    SceneOptions: keysOf((given) => scene.firstContact(given)),
    SceneDistanceOptions: keysOf((given) => scene.leastDistance(given)),
    SceneProfileOptions: keysOf((given) => scene.profile(given)),
    BodyMotion: keysOf((given) => scene.move("a", given)),
    DragOptions: keysOf((given) => chasles.draggedBody(scene, "a", given)),
    MassProperties: keysOf((mass) => chasles.draggedBody(scene, "a", { mass })),
    DragLock: keysOf((lock) => chasles.draggedBody(scene, "a", { lock })),
  };
  const ofFunctions = {
    "Parameters<typeof all.load>[0]": (await refusal(load({ unknown: 1 }))).replace(/^.*there are /, "").split(", "),
    'Parameters<all.Chasles["workers"]>[0]': (await refusal(chasles.workers({ unknown: 1 }))).replace(/^.*there are /, "").split(", "),
    'Parameters<all.Chasles["polyhedron"]>[2]': keysOf((given) => chasles.polyhedron(vertices, faces, given)),
    'Parameters<all.Chasles["firstContactOnPath"]>[3]': keysOf((given) => chasles.firstContactOnPath(cube, cube, [far, far], given)),
    'Parameters<all.Chasles["isClear"]>[4]': keysOf((given) => chasles.isClear(cube, cube, far, far, given)),
    'Parameters<all.Chasles["poseAt"]>[3]': keysOf((given) => chasles.poseAt(far, far, 0, given)),
    'Parameters<all.Scene["add"]>[2]': keysOf((given) => scene.add("x", cube, given)),
    'Parameters<all.Scene["moveAll"]>[2]': keysOf((given) => scene.moveAll([far, far], [far, far], given)),
  };
  const program = Object.entries(options).map(([type, keys]) => exactly(`Taken<all.${type}>`, keys));
  program.push(...Object.entries(ofFunctions).map(([type, keys]) => exactly(`Taken<NonNullable<${type}>>`, keys)));
  assert.equal(complaints("options", head + program.join("")), "");
});

test("options of one question compile for another one exactly where they are taken", () => {
  const questions = {
    FirstContactOptions: ["chasles.firstContact(body, body, far, far, OPTIONS)", (given) => chasles.firstContact(cube, cube, far, far, given)],
    ClearOptions: ["chasles.isClear(body, body, far, far, OPTIONS)", (given) => chasles.isClear(cube, cube, far, far, given)],
    PathOptions: ["chasles.firstContactOnPath(body, body, [far, far], OPTIONS)", (given) => chasles.firstContactOnPath(cube, cube, [far, far], given)],
    LeastDistanceOptions: ["chasles.leastDistance(body, body, far, far, OPTIONS)", (given) => chasles.leastDistance(cube, cube, far, far, given)],
    PoseOptions: ["chasles.poseAt(far, far, 0, OPTIONS)", (given) => chasles.poseAt(far, far, 0, given)],
    SceneOptions: ["scene.firstContact(OPTIONS)", (given) => scene.firstContact(given)],
    SceneListOptions: ["scene.allContacts(OPTIONS)", (given) => scene.allContacts(given)],
    ProfileOptions: ["chasles.profile(body, body, far, far, OPTIONS)", (given) => chasles.profile(cube, cube, far, far, given)],
    SceneDistanceOptions: ["scene.leastDistance(OPTIONS)", (given) => scene.leastDistance(given)],
    SceneProfileOptions: ["scene.profile(OPTIONS)", (given) => scene.profile(given)],
  };
  const lines = ["declare const chasles: all.Chasles, body: all.Polyhedron, scene: all.Scene; const far = [5, 0, 0];\n"];
  const counts = { taken: 0, refused: 0 };
  const listsAll = ["LeastDistanceOptions", "SceneListOptions", "SceneDistanceOptions"];
  for (const [type, [, ask]] of Object.entries(questions))
    for (const [other, [code, asked]] of Object.entries(questions)) {
      const takesAll = keysOf(ask).every((key) => keysOf(asked).includes(key));
      const isTaken = takesAll && !(keysOf(ask).includes("find") && listsAll.includes(other) && !listsAll.includes(type));
      ++counts[isTaken ? "taken" : "refused"];
      lines.push(`${isTaken ? "" : "// @ts-expect-error\n"}${code.replace("OPTIONS", `null! as all.${type}`)}; // ${type}\n`);
    }
  assert.ok(counts.taken > 10 && counts.refused > 20, JSON.stringify(counts));
  assert.equal(complaints("others", head + lines.join("")), "");
});

test("options that are undefined are taken, as the types say", async () => {
  const none = (...names) => Object.fromEntries(names.map((name) => [name, undefined]));
  const motion = ["motion", "centre", "maxTurn", "fixedStart", "fixedGoal", "fixedCentre"];
  const query = ["margin", "hold", "timeTolerance", "find"];
  const expected = chasles.firstContact(cube, cube, far, [0, 0, 0]);
  assert.deepEqual(chasles.firstContact(cube, cube, far, [0, 0, 0], none(...query, ...motion)), expected);
  chasles.leastDistance(cube, cube, far, far, none("tolerance", "timeTolerance", "find", ...motion));
  const world = chasles.scene();
  world.add("a", cube, none("pose", "goal", "motion", "centre", "poses", "times", "group"));
  world.firstContact(none(...query, "until"));
  world.moveAll([far], [far], none("motion"));
  chasles.draggedBody(world, "a", none("margin", "reach", "stiffness", "rounds", "friction", "mass", "lock"));
  chasles.polyhedron(vertices, faces, none("triangulate"));
  assert.ok(await load(none("wasm")));
});

/** Typed arrays as what a type takes for them. */
const asLists = (profile) => {
  for (const name of ["times", "lower", "upper"]) assert.ok(profile[name] instanceof Float64Array);
  return { ...profile, times: "NUMBERS", lower: "NUMBERS", upper: "NUMBERS" };
};

test("answers have the keys of the types", () => {
  const near = [0.5, 0, 0, 1, 0.2, 0.1, 0];
  const held = { margin: 0.1, hold: 0.02 };
  const table = chasles.scene();
  table.add("table", cube);
  table.add("box", cube, { pose: [0, 0, 2.05], goal: [0.5, 0, 0] });
  const answers = {
    FirstContact: [
      chasles.firstContact(cube, cube, far, near), chasles.firstContact(cube, cube, far, far), chasles.firstContact(cube, cube, [1, 0.3, 0.2], near),
      chasles.firstContact(cube, cube, far, near, { motion: "velocity" }), chasles.firstContact(cube, cube, [0, 0, 2.05], far, held),
      chasles.firstContact(cube, cube, [0, 0, 2.05], [0, 0, 2], held), ...chasles.firstContactBatch(cube, cube, [far], [near]),
    ],
    PathContact: [chasles.firstContactOnPath(cube, cube, [far, near])],
    LeastDistance: [chasles.leastDistance(cube, cube, far, near), chasles.leastDistance(cube, cube, far, far)],
    DistanceProfile: [asLists(chasles.profile(cube, cube, far, near, { margins: [1] }))],
    SceneDistance: [scene.leastDistance(), table.leastDistance()],
    SceneDistances: [scene.leastDistances(), table.leastDistances()],
    SceneProfile: [asLists(scene.profile()), asLists(table.profile({ margins: [0.1] }))],
    SceneContact: [scene.firstContact(), scene.firstContact({ until: 0.01 }), table.firstContact(held)],
    SceneEvents: [scene.allContacts()],
    DragStep: [hand.update([0, 0, 0]), hand.update(far)],
    MeshReport: [cube.report],
    PoseNumbers: [hand.pose, part.pose, scene.poseAt("a", 0), chasles.poseAt(far, near, 0.5)],
    Wrench: [hand.force(far)],
  };
  assert.ok(answers.FirstContact.some((answer) => answer.held) && answers.SceneContact.some((answer) => answer.held));
  assert.ok(answers.FirstContact.some((answer) => answer.overlap));
  const texts = Object.entries(answers).flatMap(([type, list]) => list.map((answer, i) => `const ${type}${i}: all.${type} = ${JSON.stringify(answer).replaceAll('"NUMBERS"', "new Float64Array()")};\n`));
  for (const type of ["DraggedBody", "MeshBody"]) texts.push(`export const ofA${type}: all.PoseNumbers = null! as all.${type}["pose"];\n`);
  assert.equal(complaints("answers", head + texts.join("")), "");
  assert.match(complaints("answers", `${head}const wrong: all.SceneContact = ${JSON.stringify({ ...scene.firstContact(), extra: 1 })};`), /extra/);
});

for (const [name, address] of [["README", import.meta.resolve("chasles/package.json").replace("package.json", "README.md")], ["guide", new URL("./javascript.md", import.meta.url)]])
  test(`the code of the ${name} compiles under "strict"`, () => {
    const code = [...readFileSync(new URL(address), "utf8").matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]);
    assert.ok(code.length >= 4);
    assert.equal(complaints(`code_of_the_${name}`, code.join("\n")), "");
    assert.equal(complaints("first_code", code[0]), "", "alone, as it is copied");
  });
