// The contacts of an answer, one entry each, with all numbers.
import { element, more, table } from "./elements";
import type { Feature, Marked, Nested, Overlap, Point, Vector } from "./scene";

const mostListed = 100;

function featureName(feature: Feature): string {
  if (typeof feature === "number") return `vertex ${feature}`;
  return feature.length === 1 ? `face ${feature[0]}` : `edge ${feature[0]}\u2013${feature[1]}`;
}

/** A contact of a recording need not name its features. */
function pairName({ moving_feature, fixed_feature }: Point, index: number): string {
  if (moving_feature === undefined || fixed_feature === undefined) return `point ${index + 1}`;
  return `${featureName(moving_feature)} on ${featureName(fixed_feature)}`;
}

export function overlapName({ moving_feature, fixed_feature }: Overlap): string {
  return `${featureName(moving_feature)} of the moving body, ${featureName(fixed_feature)} of the fixed one`;
}

/** A line if a list of contacts is cut. Where bodies overlap, the overlap says more. */
export function cutNote({ contacts_cut, overlap }: Marked): HTMLElement[] {
  return contacts_cut && !overlap ? [more("The list is cut: there are more contacts.")] : [];
}

/** The heading and the rows about a body that is inside of the other one; none if there is no such body. */
export function insideSection({ inside, inside_vertex, inside_point }: Nested): [string, ...HTMLElement[]][] {
  if (!inside) return [];
  const text = `vertex ${inside_vertex} of the ${inside} body is inside of the ${inside === "moving" ? "fixed" : "moving"} one`;
  return [["Inside", element("div", text), table([["point", inside_point!]])]];
}

function contactDetails(contact: Point): HTMLElement {
  const rows: [string, Vector | number][] = [
    ["point", contact.point],
    ["normal", contact.normal],
    ["gap", contact.gap],
  ];
  if (contact.approach_speed !== undefined) rows.push(["approach speed", contact.approach_speed]);
  return table(rows);
}

/** `choose` receives the index of the contact whose entry is open. */
export function contactList(contacts: Point[], choose: (index: number | undefined) => void): HTMLElement[] {
  const isAlone = contacts.length === 1;
  const entries = contacts.slice(0, mostListed).map((contact, index) => {
    const entry = element("details", element("summary", pairName(contact, index)), contactDetails(contact)) as HTMLDetailsElement;
    entry.name = "contact"; // one open at a time
    entry.open = isAlone;
    entry.addEventListener("toggle", () => {
      const isNoneOpen = !document.querySelector("details[open]");
      if (entry.open || isNoneOpen) choose(entry.open ? index : undefined);
    });
    return entry;
  });
  const left = contacts.length - entries.length;
  return left > 0 ? [...entries, more(`and ${left} more`)] : entries;
}
