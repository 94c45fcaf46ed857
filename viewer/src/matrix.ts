// The least distances of all pairs: a table of bodies by bodies. A cell chooses its pair.
import { byId, element } from "./elements";
import { pairText, type PairDistance, type SceneRecord } from "./record";

const mostBodies = 100; // a table of more has too many cells
const mostWithNumbers = 4; // bodies: then a number fits into a cell

/** Whether the pair touches, or may do so for all that is proven. */
export const touches = ({ distance_upper }: PairDistance): boolean => distance_upper === 0;
export const isOpen = (pair: PairDistance): boolean => pair.distance === 0 && !touches(pair);

/** Shares from 0 for the least distance to 1 for the greatest one, by the logarithm. */
class Scale {
  readonly least: number;
  readonly greatest: number;

  constructor(pairs: PairDistance[]) {
    const distances = pairs.map(({ distance }) => distance).filter((distance) => distance > 0);
    this.least = distances.reduce((least, distance) => Math.min(least, distance), Infinity);
    this.greatest = distances.reduce((greatest, distance) => Math.max(greatest, distance), 0);
  }

  share(distance: number): number {
    return distance <= this.least ? 0 : Math.log(distance / this.least) / Math.log(this.greatest / this.least);
  }
}

/** All bodies, or those that come nearest to another one. */
function shownBodies({ bodies, matrix }: SceneRecord): number[] {
  if (bodies.length <= mostBodies) return [...bodies.keys()];
  const shown = new Set<number>();
  for (const { pair } of [...matrix!].sort((a, b) => a.distance - b.distance))
    for (const body of pair) if (shown.size < mostBodies) shown.add(body);
  return [...shown].sort((a, b) => a - b);
}

function distanceText(pair: PairDistance): string {
  const [lower, upper] = [pair.distance, pair.distance_upper].map((number) => (number === 0 ? "0" : number.toPrecision(4)));
  return pair.certain ? lower : `${lower} to ${upper}`;
}

export class MatrixTable {
  private readonly cells = new Map<string, HTMLElement>();
  private readonly byCell = new Map<HTMLElement, PairDistance>();
  private readonly rows: HTMLElement[][] = []; // the cells, row by row
  private readonly scale: Scale;
  private readonly text = byId("matrix-text");
  private chosen: PairDistance | undefined;

  constructor(
    private readonly record: SceneRecord,
    private readonly timeText: (time: number) => string,
    private readonly choose: (pair: PairDistance | undefined) => void,
  ) {
    const pairs = record.matrix!;
    this.scale = new Scale(pairs);
    byId("distances").hidden = false;
    this.fill(shownBodies(record), new Map(pairs.flatMap((pair) => [[pair.pair.join(), pair], [[...pair.pair].reverse().join(), pair]])));
    const table = byId("matrix");
    table.addEventListener("click", ({ target }) => this.toggle(target as Element));
    table.addEventListener("keydown", (event) => this.onKey(event));
    for (const kind of ["mouseover", "focusin"]) table.addEventListener(kind, ({ target }) => this.say(this.pairAt(target as Element)));
    for (const kind of ["mouseleave", "focusout"]) table.addEventListener(kind, () => this.say(undefined));
    this.say(undefined);
  }

  /** Marks the cells of a pair of bodies. */
  select(pair: readonly [number, number] | undefined): void {
    for (const cell of document.querySelectorAll("#matrix [aria-selected=true]")) cell.setAttribute("aria-selected", "false");
    this.chosen = undefined;
    for (const name of pair ? [pair.join(), [...pair].reverse().join()] : []) {
      const cell = this.cells.get(name);
      if (!cell || !this.byCell.has(cell)) continue;
      cell.setAttribute("aria-selected", "true");
      this.chosen = this.byCell.get(cell);
    }
    this.say(undefined);
  }

  private fill(bodies: number[], pairs: Map<string, PairDistance>): void {
    const name = (body: number) => this.record.bodies[body].name;
    const table = byId("matrix");
    const head = element("tr", element("td"), ...bodies.map((body) => this.heading("col", name(body))));
    table.append(element("thead", head));
    const rows = bodies.map((row) => {
      const cells = bodies.map((column) => this.cell(row, column, pairs.get(`${row},${column}`)));
      this.rows.push(cells);
      return element("tr", this.heading("row", name(row)), ...cells);
    });
    table.append(element("tbody", ...rows));
    table.classList.toggle("has-numbers", bodies.length <= mostWithNumbers);
    if (this.rows.length > 1) this.rows[0][1].tabIndex = 0;
    if (bodies.length < this.record.bodies.length) byId("matrix-part").textContent = `The ${bodies.length} bodies that come nearest to another one.`;
    const { least, greatest } = this.scale;
    byId("matrix-scale").hidden = !(least <= greatest);
    byId("matrix-open").hidden = !this.record.matrix!.some(isOpen);
    byId("matrix-rough").hidden = !this.record.matrix!.some((pair) => !pair.certain && pair.distance > 0);
    byId("matrix-least").textContent = least.toPrecision(3);
    byId("matrix-greatest").textContent = greatest.toPrecision(3);
  }

  private heading(scope: "row" | "col", name: string): HTMLElement {
    const made = element("th", element("span", name));
    made.setAttribute("scope", scope);
    made.title = name;
    return made;
  }

  private cell(row: number, column: number, pair: PairDistance | undefined): HTMLElement {
    const made = element("td", pair ? this.mark(pair) : "");
    made.tabIndex = -1;
    made.setAttribute("role", "gridcell");
    const names = [row, column].map((body) => this.record.bodies[body].name).join(" and ");
    made.setAttribute("aria-label", pair ? this.pairText(pair) : row === column ? names : `${names}: not tested`);
    if (!pair) made.className = row === column ? "same" : "untested";
    else {
      made.className = touches(pair) ? "touches" : isOpen(pair) ? "open" : pair.certain ? "" : "rough";
      made.setAttribute("aria-selected", "false");
      made.style.setProperty("--share", String(this.scale.share(pair.distance)));
      if (this.scale.share(pair.distance) > 0.5) made.classList.add("far");
      this.byCell.set(made, pair);
    }
    this.cells.set(`${row},${column}`, made);
    return made;
  }

  private mark(pair: PairDistance): string {
    if (touches(pair)) return "\u25cf";
    if (isOpen(pair)) return "?";
    return this.record.bodies.length <= mostWithNumbers ? pair.distance.toPrecision(2) : "";
  }

  private pairText(pair: PairDistance): string {
    const names = pairText(this.record, pair);
    if (touches(pair)) return `${names}: contact at time ${this.timeText(pair.time)}`;
    const doubt = pair.certain ? "" : " (not certain)";
    return `${names}: ${distanceText(pair)} at time ${this.timeText(pair.time)}${doubt}`;
  }

  private pairAt(target: Element): PairDistance | undefined {
    const cell = target.closest("td");
    return cell ? this.byCell.get(cell) : undefined;
  }

  /** The numbers of a cell below the table; without one those of the chosen pair. */
  private say(pair: PairDistance | undefined): void {
    const said = pair ?? this.chosen;
    this.text.textContent = said ? this.pairText(said) : "Choose a cell: the time of the least distance, or of the first contact.";
  }

  private toggle(target: Element): void {
    const pair = this.pairAt(target);
    if (!pair) return;
    this.focus(target.closest("td")!);
    this.choose(pair === this.chosen ? undefined : pair);
  }

  private focus(cell: HTMLElement): void {
    for (const other of document.querySelectorAll<HTMLElement>("#matrix td[tabindex='0']")) other.tabIndex = -1;
    cell.tabIndex = 0;
    cell.focus({ preventScroll: false });
  }

  /** Arrow keys go through the cells, Enter and the space key choose one. The slider does not get these keys. */
  private onKey(event: KeyboardEvent): void {
    const cell = (event.target as Element).closest("td");
    if (!cell || event.ctrlKey || event.metaKey || event.altKey) return;
    const last = this.rows.length - 1;
    const row = this.rows.findIndex((cells) => cells.includes(cell));
    const column = row < 0 ? -1 : this.rows[row].indexOf(cell);
    const places: Record<string, [number, number]> = {
      ArrowUp: [row - 1, column],
      ArrowDown: [row + 1, column],
      ArrowLeft: [row, column - 1],
      ArrowRight: [row, column + 1],
      Home: [row, 0],
      End: [row, last],
    };
    const place = places[event.key];
    if (row < 0 || (!place && event.key !== "Enter" && event.key !== " ")) return;
    event.preventDefault();
    event.stopPropagation();
    if (!place) return this.toggle(cell);
    const [nextRow, nextColumn] = place.map((index) => Math.min(Math.max(index, 0), last));
    this.focus(this.rows[nextRow][nextColumn]);
  }
}
