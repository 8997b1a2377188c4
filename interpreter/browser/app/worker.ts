// Runs programs in the background, in sections, so that a newer request ends an older one.

import { Engine, Refused, Trap } from "./engine";
import type { FromWorker, RunResult, ToWorker } from "./protocol";

/** Time in ms between two checks for messages. */
const STRETCH_MS = 25;
/** Time in ms after which a run is stopped where it is. */
const RUN_MS = 15_000;

let bytes: ArrayBuffer | undefined;
let engine: Promise<Engine> | undefined;
let newest = 0;

function send(message: FromWorker, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

/** Lets pending messages be processed. */
function breath(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

async function guarded(id: number, work: (engine: Engine) => Promise<void> | void): Promise<void> {
  try {
    if (engine === undefined) {
      throw new Refused("no module");
    }
    await work(await engine);
  } catch (e) {
    if (e instanceof Refused) {
      send({ kind: "refused", id, reason: e.message });
      return;
    }
    engine = bytes && Engine.load(bytes);
    send({ kind: "trap", id, reason: e instanceof Trap ? e.message : String(e) });
  }
}

async function run(id: number, engine: Engine, request: Parameters<Engine["start"]>[0]): Promise<void> {
  const began = performance.now();
  send({ kind: "checked", id, checked: engine.check(request) });
  const started = engine.start(request);
  if (started.refused) {
    return;
  }
  let stretch = 2000;
  let more = true;
  while (more) {
    const at = performance.now();
    more = engine.advance(stretch);
    const took = performance.now() - at;
    stretch = Math.min(20_000, Math.max(20, Math.round(stretch * Math.min(2, STRETCH_MS / Math.max(took, 1)))));
    if (!more || performance.now() - began > RUN_MS) {
      break;
    }
    send({ kind: "progress", id, rows: engine.rows });
    await breath();
    if (newest !== id) {
      return;
    }
  }
  const finished = engine.finish();
  const columns = started.columns.map((_, i) => engine.column(i));
  const lines = engine.column(started.columns.length);
  const result: RunResult = { started, finished, columns, lines, took_ms: performance.now() - began };
  send({ kind: "finished", id, result }, [...columns, lines].map((column) => column.buffer));
}

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  switch (message.kind) {
    case "load":
      bytes = message.bytes;
      engine = Engine.load(bytes);
      break;
    case "run":
      newest = message.id;
      void guarded(message.id, async (engine) => {
        // a newer request has come while this one waited
        if (newest === message.id) {
          await run(message.id, engine, message.request);
        }
      });
      break;
    case "explain":
      void guarded(message.id, (engine) => send({ kind: "explained", id: message.id, explained: engine.explain(message.thing) }));
      break;
  }
};
