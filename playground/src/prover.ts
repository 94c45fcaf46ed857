// "Prove it": the exact path query, in a worker of its own, on the way of the part and on the way of the hand.
import { Engine } from "./engine";
import type { Proof } from "./protocol";
import type { Hand } from "./drag";

export interface Proofs {
  way: Proof; // of the part
  hand: Proof; // as if the part had followed exactly
}

export class Prover {
  private engine?: Engine;

  get isRunning(): boolean {
    return this.engine !== undefined;
  }

  /** `onPart` hears how much is done. Throws when it is stopped. */
  async prove({ scene, session }: Hand, onPart: (part: number) => void): Promise<Proofs> {
    const engine = new Engine();
    this.engine = engine;
    try {
      await engine.ask("open", { scene: scene.spec, pose: session.start });
      const way = await engine.ask("prove", { ways: [session.way] }, onPart);
      const hand = await engine.ask("prove", { ways: session.handWays });
      return { way, hand };
    } finally {
      engine.stop();
      if (this.engine === engine) this.engine = undefined;
    }
  }

  stop(): void {
    this.engine?.stop();
    this.engine = undefined;
  }
}
