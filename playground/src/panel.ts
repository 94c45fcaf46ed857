// The panel beside the picture: status, contacts, proof.
import { byId, element, setText } from "./elements";
import type { Hand } from "./drag";
import type { Proofs } from "./prover";
import { type ContactShown, standing, type Step } from "./protocol";
import { handInWords, letGoInWords, short, stateInWords, wayInWords } from "./words";

const mostListed = 8;
const pauseOfNumbers = 120; // milliseconds

let lastNumbers = 0;

/** The state in words, at once; the numbers a few times a second. */
export function showStep(hand: Hand, step: Step | undefined, isLast: boolean): void {
  const { moving } = hand.scene.spec;
  const words = !step ? `The ${moving} is at rest. Drag it.` : hand.grip ? stateInWords(moving, step) : letGoInWords(moving, step);
  setText("status", words);
  byId("status").classList.toggle("is-held", step !== undefined && step.blocking.length > 0);
  byId("status").classList.toggle("is-free", step !== undefined && step.blocking.length === 0 && step.contacts.length === 0);
  const now = performance.now();
  if (!isLast && now - lastNumbers < pauseOfNumbers) return;
  lastNumbers = now;
  showContacts(step?.contacts ?? [], hand.scene.unit);
  showSummary(hand, step);
  showButtons(hand);
  setText("figures", hand.timings.words);
}

/** What a step leaves when the hand pulls no more: contacts without forces. */
export function withoutForces(step: Step): Step {
  return { ...step, contacts: step.contacts.map((contact) => ({ ...contact, force: 0, friction: [0, 0, 0] })), wrench: [0, 0, 0, 0, 0, 0], blocking: [] };
}

export function showButtons(hand: Hand): void {
  byId<HTMLButtonElement>("undo").disabled = hand.session.count === 0;
  byId<HTMLButtonElement>("save").disabled = hand.session.count === 0;
}

function showSummary(hand: Hand, step: Step | undefined): void {
  const { unit } = hand.scene;
  const { goals, pieces } = hand.session.sizes;
  const force = step ? Math.hypot(...step.wrench.slice(0, 3)) : 0;
  const rows: [string, string][] = [
    ["contacts", String(step?.contacts.length ?? 0)],
    ["force on the hand", force === 0 ? "none" : `${short(force)}${unit && ` ${unit} of the spring`}`],
    ["recorded", `${goals} updates, ${pieces} proven pieces`],
  ];
  byId("summary").replaceChildren(...rows.flatMap(([name, value]) => [element("dt", "", name), element("dd", "", value)]));
}

function showContacts(contacts: ContactShown[], unit: string): void {
  const strongest = [...contacts].sort((a, b) => b.force - a.force).slice(0, mostListed);
  const rows = strongest.map(({ body, force, gap, normal }) =>
    element("tr", "", ...[body, short(force), `${short(gap)} ${unit}`, normal.map((part) => part.toFixed(2)).join(" ")].map((cell) => element("td", "", cell))),
  );
  const table = byId("contacts");
  table.hidden = rows.length === 0;
  table.querySelector("tbody")!.replaceChildren(...rows);
}

export function showProof(hand: Hand, { way, hand: ofHand }: Proofs, seconds: number): void {
  const { moving } = hand.scene.spec;
  const others = standing(hand.scene.spec);
  if (others.length === 0 || way.segments === 0) {
    byId("proof").replaceChildren(element("p", "", others.length === 0 ? "There is nothing to touch." : wayInWords(moving, others, way)));
    return;
  }
  const isClear = way.contact === undefined;
  byId("proof").replaceChildren(
    element("p", `verdict ${isClear ? "is-clear" : "is-contact"}`, isClear ? "Proven clear" : "Contact"),
    element("p", "", wayInWords(moving, others, way)),
    element("p", "", handInWords(moving, ofHand)),
    element("p", "faint", `By the exact path query, in ${seconds.toFixed(1)} s.`),
  );
}

export function clearProof(): void {
  byId("proof").replaceChildren();
}

export function showTrouble(text: string): void {
  byId("trouble").hidden = false;
  byId("trouble-text").textContent = text;
}

export function hideTrouble(): void {
  byId("trouble").hidden = true;
  byId("trouble-text").textContent = "";
}
