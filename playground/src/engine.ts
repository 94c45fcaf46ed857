// A worker of the page, behind a promise for each question.
import type { Question, Reply, Task, Tasks } from "./protocol";

/** What the library said about input, or a fault of a worker. */
export class EngineError extends Error {
  constructor(message: string, readonly isInput: boolean) {
    super(message);
  }
}

interface Waiting {
  resolve(answer: unknown): void;
  reject(error: Error): void;
  onPart?(part: number): void;
}

/** The script of the workers is text in the page, so that nothing has to be fetched. */
let scriptAddress: string | undefined;
function workerScript(): string {
  const text = document.getElementById("worker")!.textContent!;
  return (scriptAddress ??= URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
}

export class Engine {
  private readonly worker = new Worker(workerScript());
  private readonly waiting = new Map<number, Waiting>();
  private next = 1;

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<Reply>) => this.settle(data);
    this.worker.onerror = (event) => this.fail(new EngineError(event.message || "the worker could not be started", false));
  }

  ask<Name extends Task>(task: Name, ask: Tasks[Name]["ask"], onPart?: (part: number) => void): Promise<Tasks[Name]["answer"]> {
    const question: Question = { id: this.next++, task, ask };
    return new Promise((resolve, reject) => {
      this.waiting.set(question.id, { resolve: resolve as (answer: unknown) => void, reject, onPart });
      this.worker.postMessage(question);
    });
  }

  /** Ends the worker, whatever it does. Open questions are answered with an error. */
  stop(): void {
    this.worker.terminate();
    this.fail(new EngineError("stopped", false));
  }

  private settle(reply: Reply): void {
    const waiting = this.waiting.get(reply.id);
    if (!waiting) return;
    if ("part" in reply) {
      waiting.onPart?.(reply.part);
      return;
    }
    this.waiting.delete(reply.id);
    if ("error" in reply) waiting.reject(new EngineError(reply.error, reply.isInput));
    else waiting.resolve(reply.answer);
  }

  private fail(error: EngineError): void {
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }
}
