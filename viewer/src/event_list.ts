// The list of contacts. Only the rows in view are elements of the page, so that a list may have a hundred thousand rows.
import { byId, element } from "./elements";
import { pairText, type RecordedContact, type SceneRecord } from "./record";

const rowHeight = 30; // pixels, as in the style sheet
const rowsBeyond = 8; // above and below the view

export class EventList {
  private shown: number[] = []; // indices of events
  private selected: number | undefined;
  private readonly root = byId("events");
  private readonly rows = byId("rows");
  private readonly field = byId<HTMLInputElement>("filter");

  constructor(
    private readonly record: SceneRecord,
    private readonly timeText: (time: number) => string,
    private readonly choose: (event: number | undefined) => void,
  ) {
    this.root.addEventListener("scroll", () => this.fill());
    this.root.addEventListener("keydown", (event) => this.onKey(event));
    this.rows.addEventListener("click", ({ target }) => this.onClick(target as Element));
    this.field.addEventListener("input", () => this.filter(this.field.value));
    new ResizeObserver(() => this.fill()).observe(this.root);
    this.filter("");
  }

  /** Shows the contacts of bodies whose name contains the text. The full name of a body shows only its contacts. */
  filter(text: string): void {
    const { bodies, events } = this.record;
    const part = text.toLowerCase();
    const isFull = bodies.some(({ name }) => name === text);
    const fits = ({ name }: { name: string }) => (isFull ? name === text : name.toLowerCase().includes(part));
    const isWanted = bodies.map(fits);
    this.shown = [...events.keys()].filter((index) => events[index].pair.some((body) => isWanted[body]));
    this.field.value = text;
    this.rows.style.height = `${this.shown.length * rowHeight}px`;
    byId("none").hidden = this.shown.length > 0;
    byId("none").textContent = `No contact of \u201c${text}\u201d`;
    this.fill();
  }

  select(event: number | undefined): void {
    this.selected = event;
    const row = event === undefined ? -1 : this.shown.indexOf(event);
    if (row >= 0) this.reveal(row);
    this.fill();
  }

  /** Chooses the contact `by` rows further. Without a choice, steps start before the first row or after the last one. */
  step(by: number): void {
    const last = this.shown.length - 1;
    const row = this.selected === undefined ? -1 : this.shown.indexOf(this.selected);
    const from = row >= 0 ? row : by > 0 ? -1 : last + 1;
    if (last >= 0) this.choose(this.shown[Math.min(Math.max(from + by, 0), last)]);
  }

  private reveal(row: number): void {
    const top = row * rowHeight;
    const { scrollTop, clientHeight } = this.root;
    if (top < scrollTop || top + rowHeight > scrollTop + clientHeight) this.root.scrollTop = top - clientHeight / 2 + rowHeight / 2;
  }

  private fill(): void {
    const { scrollTop, clientHeight } = this.root;
    const from = Math.max(0, Math.floor(scrollTop / rowHeight) - rowsBeyond);
    const to = Math.min(this.shown.length, Math.ceil((scrollTop + clientHeight) / rowHeight) + rowsBeyond);
    const rows = [];
    for (let row = from; row < to; ++row) rows.push(this.row(row));
    this.rows.replaceChildren(...rows);
    if (this.selected === undefined) this.root.removeAttribute("aria-activedescendant");
    else this.root.setAttribute("aria-activedescendant", `event-${this.selected}`);
  }

  private row(row: number): HTMLElement {
    const index = this.shown[row];
    const event = this.record.events[index];
    const made = element("div", element("span", this.timeText(event.time)), element("span", this.text(event)));
    made.id = `event-${index}`;
    made.setAttribute("role", "option");
    made.setAttribute("aria-selected", String(index === this.selected));
    made.setAttribute("aria-setsize", String(this.shown.length));
    made.setAttribute("aria-posinset", String(row + 1));
    made.style.top = `${row * rowHeight}px`;
    made.title = this.text(event);
    return made;
  }

  private text(event: RecordedContact): string {
    return `${pairText(this.record, event)}${event.kind ? `, ${event.kind}` : ""}${event.certain ? "" : " (not certain)"}`;
  }

  private onClick(target: Element): void {
    const row = target.closest("[role=option]");
    if (!row) return;
    const index = Number(row.id.replace("event-", ""));
    this.choose(index === this.selected ? undefined : index);
  }

  private onKey(event: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.root.clientHeight / rowHeight) - 1);
    const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    const by = steps[event.key];
    if (by === undefined) return;
    event.preventDefault();
    this.step(by);
  }
}
