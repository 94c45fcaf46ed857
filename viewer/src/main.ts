// Connects the parts of the page: scene, bodies, player and panel.
import { Box3, type Sphere, Vector3 } from "three";
import { Bodies, type Body } from "./bodies";
import { currentColours, onColourChange } from "./colours";
import { connectControls } from "./controls";
import { Markers } from "./markers";
import { fillPanel } from "./panel";
import { Player } from "./player";
import { markedPoints, readScene, stopOf, type Scene } from "./scene";
import { ballAround, Stage } from "./stage";

declare global {
  interface Window {
    /** For tests: the functions of the slider. */
    chasles: { ready: Promise<void>; setTime(time: number): void; time(): number; goThrough(may: boolean): void };
  }
}

const mostBoxes = 61; // sampled boxes per motion, enough to keep the whole motion in view

function corners({ min, max }: Box3): Vector3[] {
  const ends = [min, max];
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new Vector3(ends[k & 1].x, ends[(k >> 1) & 1].y, ends[k >> 2].z));
}

function cornersOnPath({ mesh, track }: Body): Vector3[] {
  const box = corners(mesh.surface.boundingBox!).map((corner) => corner.add(mesh.origin));
  const step = Math.max(1, Math.floor((track.count - 1) / (mostBoxes - 1)));
  const samples = Array.from({ length: track.count }, (_, index) => index).filter((index) => index % step === 0);
  return samples.flatMap((index) => box.map((corner) => corner.clone().applyMatrix4(track.sample(index))));
}

/** The corners of the box to show for a contact: the marked points, expanded by 0.55 radii of the smaller body. */
function aroundContact(scene: Scene, bodies: Bodies): Vector3[] {
  const box = new Box3().setFromPoints(markedPoints(scene.answer).map((point) => new Vector3(...point)));
  const radii = [bodies.moving, bodies.fixed].map(({ mesh }) => mesh.surface.boundingSphere!.radius);
  return corners(box.expandByScalar(0.55 * Math.min(...radii)));
}

function firstNormal(scene: Scene): Vector3 | undefined {
  const normal = scene.answer.contacts?.[0]?.normal;
  return normal && new Vector3(...normal);
}

function makeStage(scene: Scene, bodies: Bodies, markers: Markers, whole: Sphere): Stage {
  const canvas = document.getElementById("canvas") as HTMLCanvasElement;
  canvas.setAttribute("aria-label", `${scene.moving.name} moving past ${scene.fixed.name}`);
  const stage = new Stage(canvas, whole, () => markers.resize(stage.camera, stage.unit));
  bodies.moving.drawPath(whole.center);
  bodies.fixed.drawPath(whole.center);
  stage.world.add(...bodies.groups, bodies.moving.path, bodies.fixed.path, markers.group);
  return stage;
}

function connectViews(scene: Scene, bodies: Bodies, stage: Stage, player: Player, everything: Vector3[]): void {
  const along = firstNormal(scene);
  const whole = () => stage.lookAt(everything, along);
  document.getElementById("look-at-all")!.addEventListener("click", whole);
  document.getElementById("look-at-contact")!.addEventListener("click", () => {
    player.drag(player.stop);
    stage.lookAt(aroundContact(scene, bodies), along);
  });
  const seeThrough = document.getElementById("see-through")!;
  seeThrough.addEventListener("click", () => {
    const isOn = seeThrough.getAttribute("aria-pressed") !== "true";
    seeThrough.setAttribute("aria-pressed", String(isOn));
    bodies.seeThrough(isOn);
    stage.draw();
  });
  whole();
}

function show(scene: Scene, player: Player, choose: { contact(index: number | undefined): void }): void {
  const bodies = new Bodies(scene);
  const markers = new Markers(scene.answer, scene.margin, bodies.fixed.track.at(player.stop));
  const everything = [...cornersOnPath(bodies.moving), ...cornersOnPath(bodies.fixed)];
  const stage = makeStage(scene, bodies, markers, ballAround(everything));
  const follow = () => {
    bodies.moveTo(player.time);
    markers.show(bodies.fixed.track.at(player.time), player.time === player.stop);
    stage.draw();
  };
  const paint = () => {
    const colours = currentColours();
    bodies.paint(colours);
    markers.paint(colours.contact, "#ffffff");
    stage.setBackground(colours.background);
  };
  choose.contact = (index) => {
    markers.choose(index);
    stage.draw();
  };
  player.onChange(follow);
  onColourChange(paint);
  follow();
  paint();
  connectViews(scene, bodies, stage, player, everything);
  stage.drawNow();
}

function start(): void {
  const scene = readScene();
  const player = new Player(stopOf(scene.answer));
  const choose = { contact: (_: number | undefined): void => undefined };
  fillPanel(scene, (index) => choose.contact(index));
  connectControls(player, scene.answer.verdict === "clear");
  const ready = new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));
  window.chasles = {
    ready,
    setTime: (time) => player.drag(time),
    time: () => player.time,
    goThrough: (may) => player.goThrough(may),
  };
  try {
    show(scene, player, choose);
  } catch (error) {
    // Without WebGL the page still shows the numbers.
    const trouble = document.getElementById("trouble")!;
    trouble.textContent = `The picture cannot be drawn: ${error instanceof Error ? error.message : error}`;
    trouble.hidden = false;
  }
  player.set(0);
}

start();
