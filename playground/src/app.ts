// The page: connects the hand, the picture, the panel and the buttons.
import { type Arm, armAt, type JointValue } from "./arm";
import { byId, onChange, onClick } from "./elements";
import { Hand, type Shown } from "./drag";
import { Keys } from "./keys";
import { fragmentOf, type Shared, sharedIn } from "./link";
import { type OwnFile, ownScene, readOwnFile, warningAbout } from "./own_files";
import { clearProof, hideTrouble, showButtons, showProof, showStep, showTrouble, withoutForces } from "./panel";
import { Pointer } from "./pointer";
import type { Pose } from "./poses";
import type { Radii, Step } from "./protocol";
import { Prover } from "./prover";
import { offer, savedHand } from "./save";
import { type PlaygroundScene, readyScenes, sceneNamed, usualFriction, withArm } from "./scenes";
import { View } from "./view";
import { list } from "./words";

const radiusFields = ["radius-moving", "radius-standing"];
const unusable = (error: unknown) => `This link cannot be used: ${messageOf(error).replace(/\.$/, "")}.`;
const messageOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

/** A scene as a link has it. */
function sharedScene(scene: PlaygroundScene, { friction = 0, radii = [0, 0], arm }: Shared): PlaygroundScene {
  if (!(friction >= 0 && friction <= 100)) throw new Error("the link's friction is no number from 0 to 100");
  const rubbed = { ...scene, spec: { ...scene.spec, friction, radii } };
  if (!scene.arm || !arm) return rubbed;
  const { joints } = scene.arm;
  if (arm.values.length !== joints.length || !joints[arm.active]) throw new Error(`the link's joints are not those of the ${scene.title.toLowerCase()}`);
  const values = arm.values.map(({ turn, slide }, index): JointValue => ({ turn, slide: joints[index].kind === "hinge" ? 0 : slide }));
  return withArm(rubbed, { joints, values, active: arm.active });
}

export class App implements Shown {
  readonly hand = new Hand(this);
  readonly view = new View(byId<HTMLCanvasElement>("canvas"));
  readonly prover = new Prover();
  private own: OwnFile[] = [];
  private lastStep?: Step;
  private opening: Promise<unknown> = Promise.resolve();

  async start(): Promise<void> {
    for (const { id, title } of readyScenes) byId("scene").append(new Option(title, id));
    await this.hand.load();
    await this.openLink();
    byId("loading").hidden = true;
    this.connect();
  }

  moved(pose: Pose, step?: Step): void {
    this.lastStep = step;
    if (this.hand.grip) this.view.keepUp(this.hand.timings.judged);
    this.view.moveTo(pose);
    this.view.showContacts(step?.contacts ?? [], step?.blocking ?? []);
    this.view.showHand(this.hand.line);
    showStep(this.hand, step, !this.hand.grip);
  }

  released(): void {
    this.view.showHand();
    this.view.sharpen();
    if (this.lastStep) void this.hand.atRest().then(() => this.leave());
  }

  failed(error: Error): void {
    showTrouble(`${error.message}. The ${this.hand.scene.spec.moving} stays where it was.`);
    this.moved(this.hand.pose);
  }

  private leave(): void {
    if (this.hand.grip || !this.lastStep) return;
    this.moved(this.hand.pose, withoutForces(this.lastStep));
  }

  /** Opens a scene; says so if that is not possible, and leaves the scene before. A part of the same scene is shown from the same side. */
  open(scene: PlaygroundScene, start?: Pose, pose?: Pose, isSame = false, wordsFor = messageOf): Promise<boolean> {
    const opened = this.opening.then(() => this.openNext(scene, start, pose, isSame, wordsFor)); // one after another
    this.opening = opened.catch(() => false);
    return opened;
  }

  private async openNext(scene: PlaygroundScene, start?: Pose, pose?: Pose, isSame = false, wordsFor = messageOf): Promise<boolean> {
    this.stopProof();
    const { isLoose } = this.hand;
    try {
      await this.hand.open(scene, start, pose);
    } catch (error) {
      showTrouble(wordsFor(error));
      if (this.hand.scene) this.showRadii();
      return false;
    }
    if (isSame) this.hand.isLoose = isLoose;
    clearProof();
    this.view.open(scene, this.hand.opened, this.hand.pose, isSame);
    byId<HTMLSelectElement>("scene").value = scene.id;
    byId("about").textContent = scene.about;
    byId("moving-name").textContent = scene.spec.moving;
    byId<HTMLInputElement>("loose").checked = this.hand.isLoose;
    byId<HTMLInputElement>("loose").disabled = scene.spec.lock !== undefined;
    byId<HTMLInputElement>("friction").checked = scene.spec.friction > 0;
    if (!isSame) this.showRadii();
    this.showJoints(scene.arm);
    byId("swap").hidden = scene.id !== "own" || this.own.length < 2;
    this.moved(this.hand.pose);
    return true;
  }

  /** What the address says, or the first scene. */
  async openLink(): Promise<void> {
    try {
      const shared = sharedIn(location.hash);
      const scene = shared && sceneNamed(shared.scene);
      if (shared && !scene) throw new Error(`there is no scene "${shared.scene}"`);
      const [start, pose] = scene?.arm ? [] : [shared?.start, shared?.pose]; // an arm stands where its joints are
      if (shared && scene && (await this.open(sharedScene(scene, shared), start, pose, false, unusable))) return;
    } catch (error) {
      showTrouble(unusable(error));
    }
    if (!this.hand.scene) await this.open(readyScenes[0]);
  }

  async take(files: File[]): Promise<void> {
    if (files.length === 0) return;
    const troubles: string[] = files.length > 2 ? ["Two files at a time: the others are left out."] : [];
    byId("kept").textContent = "";
    const read: OwnFile[] = [];
    for (const file of files.slice(0, 2)) {
      try {
        read.push(await readOwnFile(file));
      } catch (error) {
        troubles.push(`${messageOf(error)}.`);
      }
    }
    if (read.length > 0 && (await this.openOwn([...this.own, ...read].slice(-2)))) troubles.push(...read.map(warningAbout).filter((text) => text));
    else if (read.length > 0) return;
    if (troubles.length > 0) showTrouble(troubles.join(" "));
    else hideTrouble();
  }

  async prove(): Promise<void> {
    if (this.prover.isRunning) return this.stopProof();
    await this.hand.letGo();
    clearProof();
    byId("prove").textContent = "Stop";
    byId("progress").hidden = false;
    const begin = performance.now();
    try {
      const proofs = await this.prover.prove(this.hand, (part) => (byId<HTMLProgressElement>("progress").value = part));
      showProof(this.hand, proofs, (performance.now() - begin) / 1000);
    } catch (error) {
      if (messageOf(error) !== "stopped") showTrouble(`The proof failed: ${messageOf(error)}`);
    }
    this.stopProof();
  }

  async undo(): Promise<void> {
    this.stopProof();
    if (await this.hand.undo()) clearProof();
    showButtons(this.hand);
  }

  async reset(): Promise<void> {
    this.stopProof();
    clearProof();
    const { arm } = this.hand.scene;
    if (arm) await this.open(withArm(this.hand.scene, { ...sceneNamed(this.hand.scene.id)!.arm!, active: arm.active }), undefined, undefined, true);
    else await this.hand.reset();
    showButtons(this.hand);
  }

  /** The scene as it is now: an arm stands where it was dragged to. */
  private get present(): PlaygroundScene {
    const { scene, pose } = this.hand;
    return scene.arm ? withArm(scene, armAt(scene.arm, pose)) : scene;
  }

  /** Takes another joint into the hand. What was recorded is a way of the joint before, and is left. */
  private async chooseJoint(active: number): Promise<boolean> {
    await this.hand.letGo();
    const { present } = this;
    return this.open(withArm(present, { ...present.arm!, active }), undefined, undefined, true);
  }

  /** What the pointer is on goes into the hand: a link of an arm with its joint. */
  private async chooseBody(name: string): Promise<boolean> {
    await this.opening;
    const { arm, spec } = this.hand.scene;
    return name === spec.moving || !arm || this.chooseJoint(arm.joints.findIndex(({ link }) => link === name));
  }

  private async chooseFriction(isOn: boolean): Promise<void> {
    await this.hand.letGo();
    const { present } = this;
    const spec = { ...present.spec, friction: isOn ? usualFriction : 0 };
    await this.open({ ...present, spec }, spec.start, this.hand.pose, true);
  }

  private async chooseRadii(): Promise<void> {
    await this.hand.letGo();
    hideTrouble();
    const { present } = this;
    const radii = radiusFields.map((id) => byId<HTMLInputElement>(id).valueAsNumber || 0) as Radii;
    for (const id of radiusFields) byId<HTMLInputElement>(id).value ||= "0";
    const spec = { ...present.spec, radii };
    await this.open({ ...present, spec }, spec.start, this.hand.pose, true, (error) => `These radii cannot be used here: ${messageOf(error)}.`);
  }

  private showRadii(): void {
    this.hand.scene.spec.radii.forEach((radius, index) => (byId<HTMLInputElement>(radiusFields[index]).value = String(radius)));
  }

  private showJoints(arm?: Arm): void {
    byId("joints").hidden = !arm;
    const select = byId<HTMLSelectElement>("joint");
    select.replaceChildren(...(arm?.joints ?? []).map(({ name, link }, index) => new Option(`${name}: the ${link}`, String(index))));
    select.value = String(arm?.active);
  }

  async save(): Promise<void> {
    await this.hand.letGo();
    const { scene, opened, session } = this.hand;
    offer(savedHand(scene.title, scene.spec, opened, session));
    byId("kept").textContent = "Saved: unpack it, and run drag.sh, or the command in README.txt.";
  }

  async share(): Promise<void> {
    await this.hand.letGo();
    const { pose } = this.hand;
    const scene = this.present;
    const { start, friction, radii } = scene.spec;
    if (scene.id === "own") {
      byId("kept").textContent = "No link is copied: it cannot hold your files. Save the hand instead.";
      return;
    }
    const where = scene.arm ? { arm: scene.arm } : { start, pose };
    history.replaceState(null, "", fragmentOf({ scene: scene.id, ...where, friction, radii }));
    const copied = navigator.clipboard ? await navigator.clipboard.writeText(location.href).then(() => true, () => false) : false;
    byId("kept").textContent = copied ? "The link is copied." : "The link is in the address bar.";
  }

  private async openOwn(files: OwnFile[]): Promise<boolean> {
    const select = byId<HTMLSelectElement>("scene");
    if (!select.querySelector("[value=own]")) select.append(new Option("Your own files", "own"));
    const before = this.own;
    this.own = files;
    const isOpen = await this.open(ownScene(files));
    if (isOpen) history.replaceState(null, "", "#"); // a link cannot hold files, and must not name the scene before
    else this.own = before;
    if (this.own.length === 0) select.querySelector("[value=own]")?.remove();
    return isOpen;
  }

  private stopProof(): void {
    this.prover.stop();
    byId("prove").textContent = "Prove it";
    byId("progress").hidden = true;
    byId<HTMLProgressElement>("progress").value = 0;
  }

  private begun(): void {
    this.stopProof();
    clearProof();
    hideTrouble();
  }

  private connect(): void {
    new Pointer(this.view, this.hand, () => this.begun(), (name) => this.chooseBody(name));
    new Keys(this.view, this.hand, byId<HTMLCanvasElement>("canvas"), () => this.begun());
    onClick("undo", () => this.undo());
    onClick("reset", () => this.reset());
    onClick("prove", () => this.prove());
    onClick("save", () => this.save());
    onClick("share", () => this.share());
    onClick("dismiss", hideTrouble);
    onClick("swap", () => this.openOwn([...this.own].reverse()));
    onClick("look-scene", () => this.view.lookFrom(this.hand.scene.view));
    onClick("look-front", () => this.view.lookFrom([0, -1, 0.3]));
    onClick("look-top", () => this.view.lookFrom([0, -0.02, 1]));
    onChange<HTMLInputElement>("loose", ({ checked }) => (this.hand.isLoose = checked));
    onChange<HTMLInputElement>("friction", ({ checked }) => this.chooseFriction(checked));
    for (const id of radiusFields) onChange<HTMLInputElement>(id, () => this.chooseRadii());
    onChange<HTMLSelectElement>("joint", ({ value }) => this.chooseJoint(Number(value)));
    onChange<HTMLSelectElement>("scene", ({ value }) => this.choose(value));
    addEventListener("hashchange", () => void this.openLink());
    addEventListener("keydown", (event) => this.key(event));
    this.connectFiles();
  }

  private async choose(id: string): Promise<void> {
    hideTrouble();
    history.replaceState(null, "", id === "own" ? "#" : `#${id}`);
    await this.open(id === "own" ? ownScene(this.own) : sceneNamed(id)!);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as Element;
    if (target.matches("select, input") || event.altKey) return;
    const isUndo = event.key.toLowerCase() === "z" && (event.ctrlKey || event.metaKey);
    if ((event.ctrlKey || event.metaKey) && !isUndo) return;
    const actions: Record<string, () => unknown> = {
      u: () => this.undo(),
      r: () => this.reset(),
      p: () => this.prove(),
      j: () => this.nextJoint(),
      f: () => this.chooseFriction(this.hand.scene.spec.friction === 0),
    };
    const action = isUndo ? actions.u : actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    void action();
  }

  private nextJoint(): unknown {
    const { arm } = this.hand.scene;
    return arm && this.chooseJoint((arm.active + 1) % arm.joints.length);
  }

  private connectFiles(): void {
    const chosen = byId<HTMLInputElement>("chosen-files");
    onClick("files", () => chosen.click());
    chosen.addEventListener("change", async () => {
      await this.take([...(chosen.files ?? [])]);
      chosen.value = "";
    });
    const stage = byId("stage");
    const show = (isOver: boolean) => {
      stage.classList.toggle("takes-files", isOver);
      byId("drop-here").hidden = !isOver;
    };
    addEventListener("dragover", (event) => {
      event.preventDefault();
      show(true);
    });
    addEventListener("dragleave", (event) => event.relatedTarget === null && show(false));
    addEventListener("drop", (event) => {
      event.preventDefault();
      show(false);
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length === 0) showTrouble(`Nothing to read was dropped: only files are (${list(["OBJ", "OFF", "PLY", "STL"])}).`);
      else void this.take(files);
    });
  }
}
