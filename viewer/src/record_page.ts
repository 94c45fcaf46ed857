// The page of many bodies. Connects the record, the crowd, the chosen pair, the player, the list and the panel.
import { Box3, type InstancedMesh, type Matrix4, Vector3 } from "three";
import { Body } from "./bodies";
import { corners, cornersOf, cornersOnPath } from "./boxes";
import { currentColours, onColourChange } from "./colours";
import { connectControls, markContact } from "./controls";
import { Crowd, type Look } from "./crowd";
import { connectCurve } from "./curve";
import { byId, element, onClick } from "./elements";
import { EventList } from "./event_list";
import { Markers } from "./markers";
import { MatrixTable, touches } from "./matrix";
import { type DrawnMesh, drawnMesh } from "./meshes";
import { Player } from "./player";
import { isDistance, type PairDistance, type RecordedContact, type SceneRecord, tracksOf } from "./record";
import { fillRecordPanel, showEvent } from "./record_panel";
import { markedPoints } from "./scene";
import { ballAround, connectSeeThrough, Stage } from "./stage";
import { type Track, unpackedNumbers } from "./track";

const mostBoxes = 200_000; // of all bodies, to find what the picture has to show
const mostTicks = 200; // on the slider
const shownAround = 3; // radii of the smaller body, if the other one is much larger
const shownAroundAll = 0.1; // of the diagonal of the box around all moving bodies
const clickDistance = 4; // pixels

/** The pair of the chosen contact. */
interface Pair {
  event: RecordedContact;
  moving: Body;
  fixed: Body;
  markers: Markers;
}

class RecordView {
  private readonly meshes: DrawnMesh[];
  private readonly tracks: Track[];
  private readonly crowd: Crowd;
  private readonly stage: Stage;
  private readonly everything: Vector3[];
  private pair: Pair | undefined;
  private others: Look = "dim";
  private isSeeThrough = false;

  constructor(private readonly record: SceneRecord, private readonly player: Player, pick: (body: number) => void) {
    this.meshes = record.meshes.map(drawnMesh);
    this.tracks = tracksOf(record);
    const whole = this.boxOf(() => true);
    const canvas = byId<HTMLCanvasElement>("canvas");
    canvas.setAttribute("aria-label", `${record.bodies.length} bodies`);
    this.stage = new Stage(canvas, ballAround(corners(whole)), () => this.pair?.markers.resize(this.stage.camera, this.stage.unit));
    const members = record.bodies.map(({ mesh }, index) => ({ mesh, track: this.tracks[index] }));
    this.crowd = new Crowd(this.meshes, members, this.stage.world.matrix);
    this.stage.scaled.add(this.crowd.group);
    this.everything = corners(this.shownBox(whole));
    this.connect(canvas, pick);
    this.paint();
    this.lookAtAll();
  }

  /** Draws the pair of a contact in the colours of a query, with its points, and frames it. */
  choose(event: RecordedContact | undefined): void {
    this.removePair();
    if (event) this.addPair(event);
    this.crowd.leaveOut(event?.pair ?? []);
    this.crowd.look(event ? this.others : "solid");
    this.paint();
    if (event) this.lookAtPair();
  }

  choosePoint(index: number | undefined): void {
    this.pair?.markers.choose(index);
    this.stage.draw();
  }

  show(look: Look): void {
    this.others = look;
    this.crowd.look(this.pair ? look : "solid");
    this.stage.draw();
  }

  follow(): void {
    const { time, stop } = this.player;
    this.crowd.moveTo(time);
    if (this.pair) {
      const { moving, fixed, markers } = this.pair;
      for (const body of [moving, fixed]) body.moveTo(time);
      markers.show(fixed.track.at(time), time === stop);
    }
    this.stage.draw();
  }

  lookAtPair(): void {
    if (this.pair) this.stage.lookAt(this.aroundPair(this.pair), this.normal);
  }
  lookAtAll(): void {
    this.stage.lookAt(this.everything);
  }

  private connect(canvas: HTMLCanvasElement, pick: (body: number) => void): void {
    this.player.onChange(() => this.follow());
    onColourChange(() => this.paint());
    connectSeeThrough(this.stage, (isOn) => {
      this.isSeeThrough = isOn;
      for (const body of this.pairBodies) body.seeThrough(isOn);
    });
    let pressed: PointerEvent | undefined;
    canvas.addEventListener("pointerdown", (event) => (pressed = event));
    canvas.addEventListener("pointerup", (event) => {
      const moved = pressed && Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY);
      const body = moved !== undefined && moved < clickDistance && event.button === 0 ? this.bodyUnder(event) : undefined;
      if (body !== undefined) pick(body);
    });
  }

  private bodyUnder(event: PointerEvent): number | undefined {
    const groups = this.pairBodies.map(({ group }) => group.children[0]);
    const crowd = this.crowd.group.visible && !(this.pair && this.others === "dim") ? this.crowd.surfaces : [];
    const [first] = this.stage.under(event, [...groups, ...crowd]);
    if (!first) return undefined;
    const place = groups.indexOf(first.object);
    return place >= 0 ? this.pair!.event.pair[place] : this.crowd.bodyOf(first.object as InstancedMesh, first.instanceId!);
  }

  private get pairBodies(): Body[] {
    return this.pair ? [this.pair.moving, this.pair.fixed] : [];
  }
  private get normal(): Vector3 | undefined {
    const normal = this.pair?.event.contacts[0]?.normal;
    return normal && new Vector3(...normal);
  }

  private addPair(event: RecordedContact): void {
    const [moving, fixed] = event.pair.map((body) => new Body(this.meshes[this.record.bodies[body].mesh], this.tracks[body]));
    const markers = new Markers(event, isDistance(event) ? event.distance_upper : this.record.margin, fixed.track.at(event.time));
    this.pair = { event, moving, fixed, markers };
    for (const body of [moving, fixed]) {
      body.drawPath(this.stage.whole.center);
      body.seeThrough(this.isSeeThrough);
      this.stage.world.add(body.group, body.path);
    }
    this.stage.world.add(markers.group);
  }

  private removePair(): void {
    if (!this.pair) return;
    for (const body of this.pairBodies) {
      this.stage.world.remove(body.group, body.path);
      body.dispose();
    }
    this.stage.world.remove(this.pair.markers.group);
    this.pair.markers.dispose();
    this.pair = undefined;
  }

  private paint(): void {
    const colours = currentColours();
    this.crowd.paint(colours);
    this.pair?.moving.paint(colours.moving, colours.edge);
    this.pair?.fixed.paint(colours.fixed, colours.edge);
    this.pair?.markers.paint(colours.contact, "#ffffff");
    this.stage.setBackground(colours.background);
  }

  /** The box around the whole motion of some bodies. */
  private boxOf(isWanted: (track: Track) => boolean): Box3 {
    const box = new Box3();
    const boxes = Math.max(2, Math.floor(mostBoxes / this.tracks.length));
    this.tracks.forEach((track, index) => {
      const mesh = this.meshes[this.record.bodies[index].mesh];
      if (isWanted(track)) for (const corner of cornersOnPath(mesh, track, boxes)) box.expandByPoint(corner);
    });
    return box.isEmpty() ? new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1)) : box;
  }

  /** All moving bodies, and what is around them. A large floor would make them small. */
  private shownBox(whole: Box3): Box3 {
    if (this.tracks.every(({ count }) => count === 1)) return whole;
    const moving = this.boxOf(({ count }) => count > 1);
    return moving.expandByScalar(shownAroundAll * moving.getSize(new Vector3()).length()).intersect(whole);
  }

  /** The corners of both bodies at the contact or the least distance. Only the near part of a much larger body is shown. */
  private aroundPair({ event, moving, fixed }: Pair): Vector3[] {
    const placed = (point: Vector3, pose: Matrix4) => point.applyMatrix4(pose);
    const points = [moving, fixed].flatMap(({ mesh, track }) => cornersOf(mesh).map((corner) => placed(corner, track.at(event.time))));
    const radius = Math.min(...[moving, fixed].map(({ mesh }) => mesh.surface.boundingSphere!.radius));
    const smaller = moving.mesh.surface.boundingSphere!.radius === radius ? moving : fixed;
    const [marked] = markedPoints(event);
    const middle = marked ? new Vector3(...marked) : placed(smaller.mesh.origin.clone(), smaller.track.at(event.time));
    const size = new Vector3().setScalar(2 * shownAround * radius);
    const near = new Box3().setFromCenterAndSize(middle, size);
    if (isDistance(event)) {
      const [nearest] = event.contacts;
      const other = smaller === moving ? fixed : moving;
      const end = nearest ? middle.clone().addScaledVector(new Vector3(...nearest.normal), nearest.gap) : placed(other.mesh.origin.clone(), other.track.at(event.time));
      near.union(new Box3().setFromCenterAndSize(end, size));
    }
    return points.map((point) => near.clampPoint(point, point));
  }
}

/** Marks the times of contacts below the slider, more strongly where there are many. */
function addTicks({ events }: SceneRecord, player: Player): void {
  const counts = new Map<number, number>();
  for (const { time } of events) {
    const place = Math.round(player.partAt(time) * mostTicks);
    counts.set(place, (counts.get(place) ?? 0) + 1);
  }
  const most = Math.max(...counts.values());
  for (const [place, count] of counts) {
    const tick = element("i");
    tick.style.setProperty("--at", String(place / mostTicks));
    tick.style.setProperty("--share", String(Math.sqrt(count / most)));
    byId("ticks").append(tick);
  }
}

/** Decimals that show a millionth of the whole motion. */
function decimalsFor(length: number): number {
  return length > 0 ? Math.min(Math.max(6 - Math.ceil(Math.log10(length)), 0), 15) : 6;
}

function connectOthers(show: (look: Look) => void): void {
  const buttons = [...byId("others").querySelectorAll("button")];
  for (const button of buttons)
    button.addEventListener("click", () => {
      for (const each of buttons) each.setAttribute("aria-pressed", String(each === button));
      show(button.value as Look);
    });
}

/** Fills the panel and returns the player, and a function that draws the picture. */
export function startRecord(record: SceneRecord): { player: Player; draw: () => void } {
  const times = unpackedNumbers(record.times);
  const player = new Player(times[times.length - 1], { from: times[0], to: times[times.length - 1] });
  const decimals = decimalsFor(player.length);
  const timeText = (time: number) => time.toFixed(decimals);
  let view: RecordView | undefined;
  let isAtEvent = (): boolean => false;
  let chosen: RecordedContact | undefined;
  const show = (event: RecordedContact | undefined, index?: number) => {
    chosen = event;
    isAtEvent = () => event !== undefined && player.time === event.time;
    player.stop = event?.time ?? player.span.to;
    markContact(player);
    showEvent(record, event, (point) => view?.choosePoint(point));
    list.select(index);
    matrix?.select(event?.pair);
    view?.choose(event);
    player.pause();
    player.set(event?.time ?? player.time);
  };
  const choose = (index: number | undefined) => show(index === undefined ? undefined : record.events[index], index);
  const choosePair = (pair: PairDistance | undefined) => {
    const isOfPair = (event: RecordedContact) => event.pair.join() === pair!.pair.join();
    if (pair && touches(pair)) choose(record.events.findIndex(isOfPair));
    else show(pair);
  };
  player.goThrough(true);
  fillRecordPanel(record);
  addTicks(record, player);
  const eventText = () => (chosen && isDistance(chosen) ? ", nearest" : ", contact");
  connectControls(player, () => `time ${timeText(player.time)}${isAtEvent() ? eventText() : ""}`);
  connectCurve(record.curve, player);
  const list = new EventList(record, timeText, choose);
  const matrix = record.matrix && new MatrixTable(record, timeText, choosePair);
  onClick("previous", () => list.step(-1));
  onClick("next", () => list.step(1));
  addEventListener("keydown", ({ key }) => key === "Escape" && choose(undefined));
  connectOthers((look) => view?.show(look));
  onClick("look-at-all", () => view?.lookAtAll());
  onClick("look-at-contact", () => {
    player.drag(player.stop);
    view?.lookAtPair();
  });
  const draw = () => {
    view = new RecordView(record, player, (body) => list.filter(record.bodies[body].name));
    choose(record.source === "first_contact" && record.events.length > 0 ? 0 : undefined);
  };
  showEvent(record, undefined, () => undefined);
  return { player, draw };
}
