// The distance over time below the slider: a band between both bounds, in the colour of the pair that is nearest.
import { byId, element } from "./elements";
import type { Player } from "./player";
import { unpackedNumbers } from "./track";

/** From times[i] to times[i + 1] the distance is from lower[i] to upper[i]. Arrays are float64 in base64. */
export interface Curve {
  times: string; // ascending
  lower: string;
  upper: string;
  nearest: number[]; // by step: the index of the nearest pair; empty where there are only two bodies
  pairs: [string, string][];
  margins: number[];
}

const columns = 600; // of the picture
const height = 100; // in units of the picture, which is stretched
const hues = 6; // style.css has their colours

class Steps {
  readonly times: Float64Array;
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  readonly greatest: number;

  constructor(curve: Curve) {
    this.times = unpackedNumbers(curve.times);
    this.lower = unpackedNumbers(curve.lower);
    this.upper = unpackedNumbers(curve.upper);
    this.greatest = 1.05 * this.upper.reduce((most, upper) => (Number.isFinite(upper) ? Math.max(most, upper) : most), 0) || 1;
  }

  /** The step that holds at a time. */
  at(time: number): number {
    let [begin, end] = [0, this.times.length - 1];
    while (end - begin > 1) {
      const middle = (begin + end) >> 1;
      if (this.times[middle] <= time) begin = middle;
      else end = middle;
    }
    return begin;
  }
}

const svg = (name: string, attributes: Record<string, string>): SVGElement => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
};

/** One path a pair: the bounds of each column as a rectangle. */
function bands(curve: Curve, steps: Steps, { span }: Player): Map<number, string> {
  const paths = new Map<number, string>();
  const y = (distance: number) => height - (height * Math.min(distance, steps.greatest)) / steps.greatest;
  for (let column = 0; column < columns; ++column) {
    const timeAt = (x: number) => span.from + ((span.to - span.from) * x) / columns;
    let [lower, upper] = [Infinity, 0];
    for (let step = steps.at(timeAt(column)), last = steps.at(timeAt(column + 1)); step <= last; ++step) {
      lower = Math.min(lower, steps.lower[step]);
      upper = Math.max(upper, steps.upper[step]);
    }
    const pair = curve.nearest[steps.at(timeAt(column + 0.5))] ?? 0;
    paths.set(pair, `${paths.get(pair) ?? ""}M${column} ${y(upper).toFixed(2)}h1V${y(lower).toFixed(2)}h-1z`);
  }
  return paths;
}

const pairText = (pair: [string, string] | undefined): string => (pair ? pair.join(" and ") : "");

function draw(curve: Curve, steps: Steps, player: Player): void {
  const picture = byId("curve");
  picture.setAttribute("viewBox", `0 0 ${columns} ${height}`);
  for (const [pair, d] of bands(curve, steps, player)) {
    const band = svg("path", { d, class: `hue-${pair % hues}` });
    band.append(svg("title", {}));
    band.firstElementChild!.textContent = pairText(curve.pairs[pair]);
    picture.append(band);
  }
  for (const margin of curve.margins)
    if (margin <= steps.greatest) {
      const y = String(height - (height * margin) / steps.greatest);
      picture.append(svg("line", { x1: "0", x2: String(columns), y1: y, y2: y, class: "margin" }));
    }
}

/** Draws the curve, and says the distance at the player's time. */
export function connectCurve(curve: Curve | undefined, player: Player): void {
  if (!curve) return;
  const steps = new Steps(curve);
  byId("distance").hidden = false;
  draw(curve, steps, player);
  const text = byId("distance-text");
  player.onChange(() => {
    const step = steps.at(player.time);
    const [lower, upper] = [steps.lower[step], steps.upper[step]].map((number) => (number > 0 && number < 1e-300 ? "more than 0" : number.toPrecision(4)));
    const index = curve.nearest[step];
    const pair = index === undefined ? [] : [element("i"), ` ${pairText(curve.pairs[index])}`];
    if (index !== undefined) (pair[0] as HTMLElement).className = `hue-${index % hues}`;
    text.replaceChildren(`distance ${lower} to ${upper} `, ...pair);
  });
}
