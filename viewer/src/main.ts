// Puts the page together: scene, bodies, player, numbers.
import { type Box3, Sphere, Vector3 } from "three";
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
    /** For tests: what the slider does, without the slider. */
    chasles: { ready: Promise<void>; setTime(time: number): void; time(): number; goThrough(may: boolean): void };
  }
}

const mostBoxes = 61; // enough of a way to be sure that none of it leaves the picture

function boxesOnWay({ mesh, track }: Body): Box3[] {
  const box = mesh.surface.boundingBox!.clone().translate(mesh.origin);
  const step = Math.max(1, Math.floor((track.count - 1) / (mostBoxes - 1)));
  const samples = Array.from({ length: track.count }, (_, index) => index).filter((index) => index % step === 0);
  return samples.map((index) => box.clone().applyMatrix4(track.sample(index)));
}

/** Where to look for a contact: as much around it as shows the smaller body's part in it. */
function contactBall(scene: Scene, bodies: Bodies): Sphere | undefined {
  const points = markedPoints(scene.answer).map((point) => new Vector3(...point));
  if (points.length === 0) return undefined;
  const ball = new Sphere().setFromPoints(points);
  const radii = [bodies.moving, bodies.fixed].map(({ mesh }) => mesh.surface.boundingSphere!.radius);
  ball.radius = Math.max(1.5 * ball.radius, 0.5 * Math.min(...radii));
  return ball;
}

function firstNormal(scene: Scene): Vector3 | undefined {
  const normal = scene.answer.contacts?.[0]?.normal;
  return normal && new Vector3(...normal);
}

function makeStage(scene: Scene, bodies: Bodies, markers: Markers): Stage {
  const whole = ballAround([...boxesOnWay(bodies.moving), ...boxesOnWay(bodies.fixed)]);
  const canvas = document.getElementById("canvas") as HTMLCanvasElement;
  canvas.setAttribute("aria-label", `${scene.moving.name} on its way past ${scene.fixed.name}`);
  const stage = new Stage(canvas, whole, () => markers.resize(stage.camera, stage.unit));
  bodies.moving.drawWay(whole.center);
  bodies.fixed.drawWay(whole.center);
  stage.world.add(...bodies.groups, bodies.moving.way, bodies.fixed.way, markers.group);
  return stage;
}

function connectViews(scene: Scene, bodies: Bodies, stage: Stage, player: Player): void {
  const contact = contactBall(scene, bodies);
  const along = firstNormal(scene);
  const whole = () => stage.lookAt(stage.whole, along);
  document.getElementById("look-at-all")!.addEventListener("click", whole);
  document.getElementById("look-at-contact")!.addEventListener("click", () => {
    player.drag(player.stop);
    stage.lookAt(contact ?? stage.whole, along);
  });
  whole();
}

function show(scene: Scene, player: Player, choose: { contact(index: number | undefined): void }): void {
  const bodies = new Bodies(scene);
  const markers = new Markers(scene.answer, bodies.fixed.track.at(player.stop));
  const stage = makeStage(scene, bodies, markers);
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
  connectViews(scene, bodies, stage, player);
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
    // The numbers are worth reading without the picture.
    const trouble = document.getElementById("trouble")!;
    trouble.textContent = `The picture cannot be drawn: ${error instanceof Error ? error.message : error}`;
    trouble.hidden = false;
  }
  player.set(0);
}

start();
