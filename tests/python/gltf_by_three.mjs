// Where three.js has the nodes of a file of glTF: its own loader and its own AnimationMixer.
// node gltf_by_three.mjs FILE, with a list of times in seconds on standard input; prints {names, animations, matrices}:
// for each time the world matrix (column by column) of each node by its number.
import { readFileSync } from "node:fs";
import { AnimationMixer, LoopOnce } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

globalThis.self = globalThis;
const times = JSON.parse(readFileSync(0, "utf8"));
const bytes = readFileSync(process.argv[2]);
const data = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const gltf = await new GLTFLoader().parseAsync(data, "");
const mixer = new AnimationMixer(gltf.scene);
for (const clip of gltf.animations) {
  const action = mixer.clipAction(clip);
  action.setLoop(LoopOnce);
  action.clampWhenFinished = true;
  action.play();
}
const nodes = new Map();
for (const [object, place] of gltf.parser.associations) {
  if (place?.nodes !== undefined && object.isObject3D && object.parent) nodes.set(place.nodes, object);
}
const matrices = times.map((time) => {
  mixer.setTime(time);
  gltf.scene.updateMatrixWorld(true);
  return Object.fromEntries([...nodes].map(([index, object]) => [index, [...object.matrixWorld.elements]]));
});
const names = Object.fromEntries([...nodes].map(([index, object]) => [index, object.userData.name ?? object.name]));
console.log(JSON.stringify({ names, animations: gltf.animations.map((clip) => [clip.name, clip.duration]), matrices }));
