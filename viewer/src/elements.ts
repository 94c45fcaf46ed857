// Elements of the page.
import type { Vector } from "./scene";

type Child = Node | string;

export function element(name: string, ...children: Child[]): HTMLElement {
  const made = document.createElement(name);
  made.append(...children);
  return made;
}

export function byId<Kind extends HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}

export function onClick(id: string, action: () => void): void {
  byId(id).addEventListener("click", action);
}

/** Text in the faint colour. */
export function more(text: string): HTMLElement {
  return Object.assign(element("p", text), { className: "more" });
}

// One number per line: two numbers with all digits do not fit on one line.
function lines(numbers: readonly number[]): HTMLElement {
  return element("dd", ...numbers.map((number) => element("span", String(number))));
}

export function table(rows: [string, number | string | Vector][]): HTMLElement {
  const list = element("dl");
  for (const [name, value] of rows)
    list.append(element("dt", name), Array.isArray(value) ? lines(value) : element("dd", String(value)));
  return list;
}
