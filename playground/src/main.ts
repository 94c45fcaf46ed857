// Starts the page.
import { App } from "./app";
import { byId } from "./elements";
import type { Pose } from "./poses";

declare global {
  interface Window {
    /** For tests. */
    playground: {
      ready: Promise<number>; // milliseconds after the page began to load
      app: App;
      partOnScreen(point?: number[]): { x: number; y: number };
      pose(): Pose;
      atRest(): Promise<void>;
    };
  }
}

function start(): void {
  const app = new App();
  const ready = app.start().then(() => performance.now());
  ready.catch((error: Error) => (byId("loading").textContent = `The page cannot start: ${error.message}`));
  const { hand, view } = app;
  window.playground = {
    ready,
    app,
    partOnScreen: (point) => {
      const centre = hand.inertia.centre.clone();
      return view.onScreen(hand.pose, point ? centre.set(point[0], point[1], point[2]) : centre);
    },
    pose: () => hand.pose,
    atRest: () => hand.atRest(),
  };
}

try {
  start();
} catch (error) {
  byId("loading").textContent = `The page cannot start: ${error instanceof Error ? error.message : error}`;
}
