// The page of one query. Connects scene, bodies, player and panel.
import { Box3, type Sphere, Vector3 } from "three";
import { Bodies } from "./bodies";
import { corners, cornersOnPath } from "./boxes";
import { currentColours, onColourChange } from "./colours";
import { connectControls } from "./controls";
import { connectCurve } from "./curve";
import { byId, onClick } from "./elements";
import { Markers } from "./markers";
import { fillPanel } from "./panel";
import { Player } from "./player";
import { markedPoints, stopOf, type Scene } from "./scene";
import { ballAround, connectSeeThrough, Stage } from "./stage";

const mostBoxes = 61; // sampled boxes per motion, enough to keep the whole motion in view

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
  const canvas = byId<HTMLCanvasElement>("canvas");
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
  onClick("look-at-all", whole);
  onClick("look-at-contact", () => {
    player.drag(player.stop);
    stage.lookAt(aroundContact(scene, bodies), along);
  });
  connectSeeThrough(stage, (isOn) => bodies.seeThrough(isOn));
  whole();
}

function show(scene: Scene, player: Player, choose: { contact(index: number | undefined): void }): void {
  const bodies = new Bodies(scene);
  const markers = new Markers(scene.answer, scene.margin, bodies.fixed.track.at(player.stop));
  const everything = [bodies.moving, bodies.fixed].flatMap(({ mesh, track }) => cornersOnPath(mesh, track, mostBoxes));
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

function timeText({ time, stop }: Player, isClear: boolean): string {
  if (isClear) return `time ${time.toFixed(6)}`;
  if (time === stop) return `time ${time.toFixed(12)}, contact`;
  return `time ${time.toFixed(6)}${time > stop ? ", through" : ""}`;
}

/** Fills the panel and returns the player, and a function that draws the picture. */
export function startQuery(scene: Scene): { player: Player; draw: () => void } {
  const player = new Player(stopOf(scene.answer));
  const choose = { contact: (_: number | undefined): void => undefined };
  fillPanel(scene, (index) => choose.contact(index));
  connectControls(player, () => timeText(player, scene.answer.verdict === "clear"));
  connectCurve(scene.curve, player);
  return { player, draw: () => show(scene, player, choose) };
}
