// What happens, in words.
import type { Proof, Step } from "./protocol";

export const counted = (count: number, thing: string) => `${count.toLocaleString("en")} ${thing}${count === 1 ? "" : "s"}`;

export const list = (names: string[]) =>
  names.length < 2 ? (names[0] ?? "") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;

/** A length or a force with three digits. */
export const short = (value: number) => (value === 0 ? "0" : String(Number(value.toPrecision(3))));

const the = (names: string[]) => list(names.map((name) => `the ${name}`));

/** The state of the dragged body. Changes in wording are announced, so it has no numbers that change all the time. */
export function stateInWords(moving: string, step: Step): string {
  const blocked = step.blocking.length > 0;
  if (step.state === "touching") return `The ${moving} is touched by another body and stays.`;
  if (step.state === "resting" && blocked) return `The ${moving} rests: ${the(step.blocking)} ${step.blocking.length > 1 ? "block" : "blocks"} it.`;
  if (step.state === "resting") return `The ${moving} rests.`;
  if (blocked || step.contacts.length > 0) {
    const bodies = blocked ? step.blocking : [...new Set(step.contacts.map(({ body }) => body))];
    return `The ${moving} slides on ${the(bodies)}.`;
  }
  return `The ${moving} follows the hand.`;
}

/** After the part was let go. */
export function letGoInWords(moving: string, step: Step): string {
  const bodies = [...new Set(step.contacts.map(({ body }) => body))];
  return bodies.length === 0 ? `The ${moving} stays where it is.` : `The ${moving} stays where it is, at ${the(bodies)}.`;
}

const ordinal = (index: number) => (index + 1).toLocaleString("en");

/** The proof of the body's own way. */
export function wayInWords(moving: string, others: string[], proof: Proof): string {
  const { segments, contact } = proof;
  if (segments === 0) return `The ${moving} has not been dragged yet.`;
  if (contact)
    return `The ${moving} touches the ${contact.body} on piece ${ordinal(contact.segment)} of ${segments.toLocaleString("en")}, at ${contact.time.toFixed(6)} of it. This should not happen: save the hand, and report it.`;
  return `On all ${counted(segments, "piece")} of its way the ${moving} touched nothing: neither between two pictures nor for an instant. Checked against ${the(others)}.`;
}

/** What the hand asked for, which need not be possible. */
export function handInWords(moving: string, proof: Proof): string {
  const { contact, segments } = proof;
  if (segments === 0) return "";
  if (!contact) return `Exactly along the way of the hand the ${moving} would have touched nothing either.`;
  const where = contact.atStart ? "at its start" : `at ${contact.time.toFixed(6)} of it`;
  return `Exactly along the way of the hand it would have hit the ${contact.body}: first on update ${ordinal(contact.segment)} of ${segments.toLocaleString("en")}, ${where}.`;
}
