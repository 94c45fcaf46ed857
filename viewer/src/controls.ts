// Slider, buttons and keys. They control the player and show its state.
import type { Player } from "./player";

const smallStep = 0.01;

function byId<Kind extends HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}

function timeText({ time, stop }: Player, isClear: boolean): string {
  if (isClear) return `time ${time.toFixed(6)}`;
  if (time === stop) return `time ${time.toFixed(12)}, contact`;
  return `time ${time.toFixed(6)}${time > stop ? ", through" : ""}`;
}

function keyAction(player: Player, key: string): (() => void) | undefined {
  switch (key) {
    case " ":
      return () => player.toggle();
    case "ArrowRight":
    case "ArrowUp":
      return () => player.step(smallStep);
    case "ArrowLeft":
    case "ArrowDown":
      return () => player.step(-smallStep);
    case "Home":
      return () => player.drag(0);
    case "End":
      return () => player.drag(player.end);
  }
  return undefined;
}

// The space key belongs to a focused button, summary or checkbox. The panel scrolls by arrow keys, Home and End.
function isTaken(event: KeyboardEvent): boolean {
  const target = event.target as Element;
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  if (event.key === " ") return target.matches("button, summary, #through");
  const scrolls = ["ArrowUp", "ArrowDown", "Home", "End"].includes(event.key);
  return scrolls && target.closest("aside") !== null;
}

export function connectControls(player: Player, isClear: boolean): void {
  const slider = byId<HTMLInputElement>("time");
  const play = byId<HTMLButtonElement>("play");
  const through = byId<HTMLInputElement>("through");
  const track = byId("track");
  track.style.setProperty("--contact-time", String(player.stop));
  slider.addEventListener("input", () => player.drag(Number(slider.value)));
  play.addEventListener("click", () => player.toggle());
  through.addEventListener("change", () => player.goThrough(through.checked));
  addEventListener("keydown", (event) => {
    const action = isTaken(event) ? undefined : keyAction(player, event.key);
    if (!action) return;
    event.preventDefault();
    action();
  });
  player.onChange(() => {
    const text = timeText(player, isClear);
    slider.value = String(player.time);
    track.style.setProperty("--now", String(player.time));
    slider.setAttribute("aria-valuetext", text);
    byId("time-text").textContent = text;
    play.classList.toggle("is-playing", player.isPlaying);
    play.setAttribute("aria-label", player.isPlaying ? "Pause" : "Play");
  });
}
