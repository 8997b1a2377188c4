// Messages between page and worker.

import type { Checked, Explained, Finished, Request, Started } from "./engine";

export type ToWorker =
  | { kind: "load"; bytes: ArrayBuffer }
  /** Replaces the previous run, finished or not. */
  | { kind: "run"; id: number; request: Request }
  | { kind: "explain"; id: number; thing: string };

export type FromWorker =
  | { kind: "checked"; id: number; checked: Checked }
  | { kind: "progress"; id: number; rows: number }
  | { kind: "finished"; id: number; result: RunResult }
  | { kind: "explained"; id: number; explained: Explained }
  /** The request was invalid. */
  | { kind: "refused"; id: number; reason: string }
  /** The module stopped; the worker has loaded another one. */
  | { kind: "trap"; id: number; reason: string };

/** A run with its columns; `lines` holds the line of every row. */
export interface RunResult {
  started: Started;
  finished: Finished;
  columns: Float64Array<ArrayBuffer>[];
  lines: Float64Array<ArrayBuffer>;
  /** Time in ms that the module took. */
  took_ms: number;
}
