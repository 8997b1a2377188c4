// The page's side of the worker. A worker that is silent for too long is ended, and another one takes its place.

import type { Checked, Explained, Request } from "./engine";
import type { FromWorker, RunResult, ToWorker } from "./protocol";

/** Time in ms without a message after which a worker counts as stuck. */
const SILENCE_MS = 10_000;

export interface Listener {
  checked(checked: Checked): void;
  progress(rows: number): void;
  finished(result: RunResult): void;
  /** No result: the module stopped, did not answer, or did not accept the request. */
  failed(reason: string): void;
}

export class Client {
  private worker: Worker | undefined;
  private nextId = 1;
  private running = 0;
  private silence: ReturnType<typeof setTimeout> | undefined;
  private readonly questions = new Map<number, (explained: Explained | null) => void>();

  constructor(
    private readonly create: () => Worker,
    private readonly bytes: ArrayBuffer,
    private readonly listener: Listener,
  ) {}

  /** Runs a program in place of the current run. */
  run(request: Request): void {
    this.running = this.nextId++;
    this.watch();
    this.tell({ kind: "run", id: this.running, request });
  }

  /** The output of `kontur explain`; null if the worker ends before it answers. */
  explain(thing: string): Promise<Explained | null> {
    const id = this.nextId++;
    const answer = new Promise<Explained | null>((resolve) => this.questions.set(id, resolve));
    this.tell({ kind: "explain", id, thing });
    return answer;
  }

  private tell(message: ToWorker): void {
    if (!this.worker) {
      this.worker = this.create();
      this.worker.onmessage = (event: MessageEvent<FromWorker>) => this.hear(event.data);
      this.worker.onerror = (event) => this.replace(event.message || "the worker stopped");
      this.worker.postMessage({ kind: "load", bytes: this.bytes } satisfies ToWorker);
    }
    this.worker.postMessage(message);
  }

  private watch(): void {
    clearTimeout(this.silence);
    this.silence = setTimeout(() => this.replace(`no answer for ${SILENCE_MS / 1000} s: the run was stopped`), SILENCE_MS);
  }

  private replace(reason: string): void {
    this.worker?.terminate();
    this.worker = undefined;
    clearTimeout(this.silence);
    this.running = 0;
    this.questions.forEach((resolve) => resolve(null));
    this.questions.clear();
    this.listener.failed(reason);
  }

  private hear(message: FromWorker): void {
    const question = this.questions.get(message.id);
    if (question) {
      this.questions.delete(message.id);
      question(message.kind === "explained" ? message.explained : null);
      return;
    }
    if (message.id !== this.running) {
      return;
    }
    clearTimeout(this.silence);
    switch (message.kind) {
      case "checked":
        if (!message.checked.refused) {
          this.watch();
        }
        this.listener.checked(message.checked);
        break;
      case "progress":
        this.watch();
        this.listener.progress(message.rows);
        break;
      case "finished":
        this.listener.finished(message.result);
        break;
      case "refused":
        this.listener.failed(message.reason);
        break;
      case "trap":
        this.listener.failed(`the module stopped and was reloaded: ${message.reason}`);
        break;
    }
  }
}
