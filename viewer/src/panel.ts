// The answer in words and numbers. Numbers have all their digits: JavaScript prints the shortest text that reads back to
// the same double.
import { contactList, cutNote, insideSection, overlapName } from "./contact_details";
import { byId, element, table } from "./elements";
import { type Answer, drawnText, type Scene, type Vector } from "./scene";

const verdicts = { clear: "Clear", contact: "Contact", contact_at_start: "Contact at the start" };

/** An answer that is not certain claims no contact. */
function uncertainMeaning({ verdict, time, clear_until }: Answer, touch: string): string {
  const where = verdict === "contact_at_start" ? "at the start" : "inside the bracket";
  const before = verdict === "contact" && clear_until >= time! ? " They do not before its lower end." : "";
  return `Whether the bodies ${touch} ${where} could not be told from a miss.${before}`;
}

function meaningWithHold({ verdict, certain }: Answer): string {
  if (verdict === "clear") return "Proven: the bodies keep the hold distance, or that of the start if it is less.";
  const doubt = certain ? "" : " That could not be told from a miss.";
  return `The bodies come to the hold distance, or nearer than at the start: inside the bracket, and not before its lower end.${doubt}`;
}

function meaning(answer: Answer, margin: number): string {
  if (answer.held?.length) return meaningWithHold(answer);
  const touch = margin > 0 ? `come within ${margin}` : "touch";
  if (answer.verdict !== "clear" && !answer.certain) return uncertainMeaning(answer, touch);
  switch (answer.verdict) {
    case "clear":
      return margin > 0 ? `Proven: never within ${margin} during the whole motion.` : "Proven: nothing touches during the whole motion.";
    case "contact":
      if (answer.clear_until < answer.time!) return `The bodies ${touch} inside the bracket, and perhaps earlier: the query stopped at any contact.`;
      return `The bodies first ${touch} inside the bracket, and not before its lower end.`;
    case "contact_at_start":
      if (answer.inside && answer.certain) return `The ${answer.inside} body is inside of the other one already.`;
      return answer.overlap && answer.certain ? "The surfaces pass through each other already." : `The bodies ${touch} already.`;
  }
}

function timeRows(answer: Answer): [string, string | number][] {
  const tau: [string, number][] = answer.tau === undefined ? [] : [["tau from", answer.tau], ["to", answer.tau_upper!]];
  return [
    ["time from", answer.time!],
    ["to", answer.time_upper!],
    ...tau,
    ["certain", answer.certain ? "yes" : "no: the bodies may just miss each other"],
  ];
}

/** What the screw between the end poses is to the motion. */
const motionNames = {
  screw: "",
  sweep: "sweep; the screw with equal end poses:",
  velocity: "constant velocity; the screw with equal end poses:",
  twist: "constant twist: even turn and slide",
};

function motionRows({ motion }: Answer, scene: Scene): [string, number | string | Vector][] {
  const rows: [string, number | string | Vector][] = [];
  if (motionNames[scene.motion]) rows.push(["motion", motionNames[scene.motion]]);
  if (scene.is_in_world) rows.push(["body", "the moving one, in the world; the fixed one moves too"]);
  rows.push(["turn", `${motion.angle} rad`], ["slide", motion.slide], ["axis", motion.axis_direction]);
  rows.push(["through", motion.axis_point]);
  if (motion.displacement) rows.push(["centre goes", motion.displacement]);
  return rows;
}

function workRows(answer: Answer): [string, number][] {
  return Object.entries(answer.work).map(([name, count]) => [name.replaceAll("_", " "), count]);
}

/** `choose` receives the index of the contact whose entry is open. */
export function fillPanel(scene: Scene, choose: (index: number | undefined) => void): void {
  const { answer } = scene;
  const contacts = answer.contacts ?? [];
  document.title = `${scene.title} \u2013 Chasles`;
  document.documentElement.classList.toggle("is-clear", answer.verdict === "clear");
  byId("title").textContent = scene.title;
  byId("moving-name").textContent = `moving: ${scene.moving.name}`;
  byId("fixed-name").textContent = `fixed: ${scene.fixed.name}`;
  byId("verdict").textContent = verdicts[answer.verdict];
  byId("meaning").textContent = meaning(answer, scene.margin) + drawnText(scene.meshes, [scene.moving, scene.fixed]);
  const numbers = byId("numbers");
  const section = (title: string, ...content: HTMLElement[]) => numbers.append(element("h2", title), ...content);
  if (answer.verdict !== "clear") section("When", table(timeRows(answer)));
  if (contacts.length > 0) section(contacts.length === 1 ? "Contact" : `${contacts.length} contacts`, ...contactList(contacts, choose));
  numbers.append(...cutNote(answer));
  if (answer.held?.length) {
    section("Held at the start", ...contactList(answer.held, () => undefined));
    section("Safe", table([["clear until", answer.clear_until!]]));
  }
  if (answer.overlap) section("Overlap", element("div", overlapName(answer.overlap)), table([["point", answer.overlap.point]]));
  for (const parts of insideSection(answer)) section(...parts);
  section("Motion", table(motionRows(answer, scene)));
  section("Work", table(workRows(answer)));
}
