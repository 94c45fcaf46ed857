// The words and numbers of a page of many bodies.
import { contactList, cutNote, insideSection, overlapName } from "./contact_details";
import { byId, element, table } from "./elements";
import { isOpen, touches } from "./matrix";
import { isDistance, type PairDistance, pairText, type RecordedContact, type SceneRecord, type Untested } from "./record";
import { drawnText } from "./scene";
import { unpackedNumbers } from "./track";

function counted(count: number, one: string, many: string): string {
  return `${count.toLocaleString("en")} ${count === 1 ? one : many}`;
}

/** Whether the first contact comes after the beginning: stamps of a robot may begin anywhere. */
function isLater({ events, times }: SceneRecord): boolean {
  return events[0].time_upper > unpackedNumbers(times)[0];
}

/** How many pairs are proven to touch, and how many perhaps do. */
function touchText(proven: number, open: number): string {
  const text = counted(proven, "pair touches", "pairs touch");
  return open > 0 ? `${text}, ${open.toLocaleString("en")} ${proven > 0 ? "more " : ""}perhaps` : text;
}

/** Of the least distances of all pairs. */
function matrixVerdict(pairs: PairDistance[]): string {
  const [touching, open] = [touches, isOpen].map((holds) => pairs.filter(holds).length);
  if (touching > 0) return touchText(touching, open);
  return open > 0 ? counted(open, "pair in doubt", "pairs in doubt") : "Clear";
}

function matrixMeaning(pairs: PairDistance[]): string {
  const apart = pairs.filter((pair) => !touches(pair));
  const open = apart.filter(isOpen).length;
  const rough = apart.filter(({ certain }) => !certain).length;
  const least = apart.reduce((least, { distance }) => Math.min(least, distance), Infinity);
  const text = `${counted(pairs.length, "pair", "pairs")} over the whole motion.`;
  if (open > 0) return `${text} Of ${open.toLocaleString("en")} it is not proven that they stay apart.`;
  const doubt = rough > 0 ? ` ${counted(rough, "distance is", "distances are")} wider than asked.` : "";
  return apart.length === 0 ? text : `${text} Proven: all ${apart.length < pairs.length ? "others " : ""}keep ${least}.${doubt}`;
}

function verdict(record: SceneRecord): string {
  const { source, events, matrix } = record;
  if (matrix) return matrixVerdict(matrix);
  if (source === "recording") return events.length === 0 ? "Recording" : counted(events.length, "contact", "contacts");
  if (events.length === 0) return "Clear";
  if (source === "all_contacts") {
    const proven = events.filter(({ certain }) => certain).length;
    return touchText(proven, events.length - proven);
  }
  return isLater(record) ? "First contact" : "Contact at the start";
}

/** What a clear answer has proven. Without its time, it is about the time that was asked about. */
function clearMeaning(touch: string, until: number | undefined): string {
  if (until === undefined) return `No pair ${touch} in the time that was asked about.`;
  return `Proven: no tested pair ${touch} ${until === 0 ? "at the start" : `before time ${until}`}.`;
}

function limitText({ until }: SceneRecord): string {
  if (until === undefined) return "";
  return until === 0 ? " Only the start was asked about." : ` Contacts after time ${until} were not asked for.`;
}

function meaning(record: SceneRecord): string {
  const { source, events, margin, clear_until, matrix } = record;
  if (matrix) return matrixMeaning(matrix);
  const touch = margin > 0 ? `comes within ${margin}` : "touches";
  const interpolated = "Between the recorded times the motion is interpolated.";
  if (source === "recording") return events.length === 0 ? `No contacts were recorded. ${interpolated}` : interpolated;
  if (events.length === 0) return clearMeaning(touch, clear_until);
  if (source === "all_contacts") return `The first contact of each pair, in order of time.${limitText(record)}`;
  const where = isLater(record) ? "inside the bracket" : "at the start";
  if (!events[0].certain) return `Whether a pair ${touch} ${where} could not be told from a miss.`;
  if (clear_until! < events[0].time) return `A pair ${touch} inside the bracket, and perhaps earlier: the question stopped at any contact.`;
  const others = events.length > 1 ? " The brackets of all listed pairs overlap." : "";
  return `The first pair ${touch} inside the bracket, and not before its lower end.${others}`;
}

/** " Not tested: 3 pairs (2 at rest: a and b, c and d; 1 ignored: e and f)." */
function untestedText({ untested }: SceneRecord): string {
  if (!untested || untested.pairs === 0) return "";
  const named = ({ pairs, links, count }: Untested["reasons"][number]) => {
    const names = links ?? pairs!.map((pair) => pair.join(" and "));
    const left = (links ? links.length : count) - Math.min(names.length, 3);
    return names.slice(0, 3).join(", ") + (left > 0 ? `, and ${left.toLocaleString("en")} more` : "");
  };
  const reasons = untested.reasons.map((one) => `${one.count.toLocaleString("en")} ${one.reason.replaceAll("_", " ")}: ${named(one)}`);
  return ` Not tested: ${counted(untested.pairs, "pair", "pairs")} (${reasons.join("; ")}).`;
}

export function fillRecordPanel(record: SceneRecord): void {
  const { bodies, events } = record;
  const root = document.documentElement;
  root.classList.add("is-record");
  root.classList.toggle("is-clear", record.matrix ? matrixVerdict(record.matrix) === "Clear" : events.length === 0);
  root.classList.toggle("has-matrix", record.matrix !== undefined);
  root.classList.toggle("has-no-events", events.length === 0);
  document.title = `${record.title} \u2013 Chasles`;
  byId("title").textContent = record.title;
  byId("verdict").textContent = verdict(record);
  const resting = bodies.filter(({ poses }) => poses.length <= 76).length; // one pose of 56 bytes in base64
  const rest = resting > 0 ? `, ${resting.toLocaleString("en")} at rest` : "";
  byId("meaning").textContent = `${counted(bodies.length, "body", "bodies")}${rest}. ${meaning(record)}${untestedText(record)}${drawnText(record.meshes, bodies)}`;
}

function distanceRows(event: RecordedContact): [string, number][] {
  return isDistance(event) ? [["distance from", event.distance], ["to", event.distance_upper]] : [];
}

function timeRows({ source }: SceneRecord, event: RecordedContact): [string, string | number][] {
  const isBracket = source !== "recording" || event.time_upper > event.time;
  const times: [string, number][] = isBracket ? [["time from", event.time], ["to", event.time_upper]] : [["time", event.time]];
  const doubt = isDistance(event) ? "no: the bracket is wider than asked" : "no: the bodies may just miss each other";
  return [...distanceRows(event), ...times, ["certain", event.certain ? "yes" : doubt]];
}

/** Shows the numbers of a contact. `choose` receives the index of the point whose entry is open. */
export function showEvent(record: SceneRecord, event: RecordedContact | undefined, choose: (index: number | undefined) => void): void {
  document.documentElement.classList.toggle("is-unselected", event === undefined);
  const numbers = byId("numbers");
  numbers.replaceChildren();
  if (!event) return;
  const [moving, fixed] = event.pair.map((body) => record.bodies[body].name);
  byId("moving-name").textContent = `moving: ${moving}`;
  byId("fixed-name").textContent = `fixed: ${fixed}`;
  const section = (title: string, ...content: HTMLElement[]) => numbers.append(element("h2", title), ...content);
  const kind: [string, string][] = event.kind ? [["kind", event.kind]] : [];
  section(pairText(record, event), table([...timeRows(record, event), ...kind]));
  const { contacts, overlap } = event;
  byId("contact-name").textContent = isDistance(event) ? "nearest" : "contact";
  const one = isDistance(event) ? "Nearest" : "Contact";
  if (contacts.length > 0) section(contacts.length === 1 ? one : `${contacts.length} contacts`, ...contactList(contacts, choose));
  numbers.append(...cutNote(event));
  if (overlap) section("Overlap", element("div", overlapName(overlap)), table([["point", overlap.point]]));
  for (const parts of insideSection(event)) section(...parts);
}
