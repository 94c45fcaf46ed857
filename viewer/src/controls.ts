// Slider, buttons and keys. They control the player and show its state.
import { byId } from "./elements";
import type { Player } from "./player";

const smallStep = 0.01;

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
      return () => player.drag(player.span.from);
    case "End":
      return () => player.drag(player.end);
  }
  return undefined;
}

// A search field takes every key. The space key belongs to a focused button, summary or checkbox. The panel scrolls by arrow keys, Home and End.
function isTaken(event: KeyboardEvent): boolean {
  const target = event.target as Element;
  if (event.ctrlKey || event.metaKey || event.altKey || target.matches("[type=search]")) return true;
  if (event.key === " ") return target.matches("button, summary, #through");
  const scrolls = ["ArrowUp", "ArrowDown", "Home", "End"].includes(event.key);
  return scrolls && target.closest("aside") !== null;
}

/** Shows the time of the contact on the slider. */
export function markContact(player: Player): void {
  byId("track").style.setProperty("--contact-time", String(player.partAt(player.stop)));
}

/** `textOf` describes the player's time. */
export function connectControls(player: Player, textOf: (player: Player) => string): void {
  const slider = byId<HTMLInputElement>("time");
  const play = byId<HTMLButtonElement>("play");
  const through = byId<HTMLInputElement>("through");
  slider.min = String(player.span.from);
  slider.max = String(player.span.to);
  markContact(player);
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
    const text = textOf(player);
    slider.value = String(player.time);
    byId("timeline").style.setProperty("--now", String(player.partAt(player.time)));
    slider.setAttribute("aria-valuetext", text);
    byId("time-text").textContent = text;
    play.classList.toggle("is-playing", player.isPlaying);
    play.setAttribute("aria-label", player.isPlaying ? "Pause" : "Play");
  });
}
