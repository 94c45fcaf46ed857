// The colours of the style sheet, which follow the light or dark mode of the system.

const names = ["moving", "fixed", "contact", "background", "edge", "text", "body", "resting"] as const;
export type Colours = Record<(typeof names)[number], string>;

export function currentColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()])) as Colours;
}

export function onColourChange(listener: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
}
