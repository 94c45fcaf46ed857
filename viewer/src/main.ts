// Starts the page of one query or the page of many bodies, according to the format of its data.
import { byId } from "./elements";
import type { Player } from "./player";
import { startQuery } from "./query_page";
import type { SceneRecord } from "./record";
import { startRecord } from "./record_page";
import type { Scene } from "./scene";

declare global {
  interface Window {
    /** For tests: the functions of the slider. */
    chasles: { ready: Promise<void>; setTime(time: number): void; time(): number; goThrough(may: boolean): void };
  }
}

function started(): { player: Player; draw: () => void } {
  const data = JSON.parse(byId("scene").textContent!) as Scene | SceneRecord;
  if (data.format === 1) return startQuery(data);
  if (data.format === 2) return startRecord(data);
  throw new Error(`this page shows data of the formats 1 and 2, not ${(data as { format: number }).format}`);
}

function start(): void {
  const { player, draw } = started();
  const ready = new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));
  window.chasles = {
    ready,
    setTime: (time) => player.drag(time),
    time: () => player.time,
    goThrough: (may) => player.goThrough(may),
  };
  try {
    draw();
  } catch (error) {
    // Without WebGL the page still shows the numbers.
    byId("trouble").textContent = `The picture cannot be drawn: ${error instanceof Error ? error.message : error}`;
    byId("trouble").hidden = false;
  }
  player.set(player.time);
}

start();
