// Elements of the page.

type Child = Node | string;

export function byId<Kind extends HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}

export function element(name: string, className: string, ...children: Child[]): HTMLElement {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

export function onClick(id: string, action: () => unknown): void {
  byId(id).addEventListener("click", () => void action());
}

export function onChange<Kind extends HTMLElement>(id: string, action: (element: Kind) => unknown): void {
  byId<Kind>(id).addEventListener("change", () => void action(byId<Kind>(id)));
}

/** Changes a text only if it differs, so that nothing is announced twice. */
export function setText(id: string, text: string): void {
  const target = byId(id);
  if (target.textContent !== text) target.textContent = text;
}
