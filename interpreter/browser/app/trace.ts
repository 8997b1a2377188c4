// A finished run in the form that plots and goals use.

import type { Summary } from "./engine";
import type { RunResult } from "./protocol";

/** Columns that the page requests. */
export const SIGNALS = [
  "v_mm_s", "a_mm_s2", "j_mm_s3", "X_ipo_mm", "Y_ipo_mm", "X_set_mm", "Y_set_mm", "X_act_mm", "Y_act_mm",
  "X_dev_mm", "Y_dev_mm", "contour_err_mm", "X_lag_mm", "Y_lag_mm",
] as const;
export type Signal = (typeof SIGNALS)[number];

export class Trace {
  readonly time_s: Float64Array;
  readonly lines: Float64Array;
  readonly summary: Summary;
  readonly cycle_s: number;
  readonly cut: boolean;
  private readonly columns: Map<string, Float64Array>;

  constructor(result: RunResult) {
    if (!result.finished.summary) {
      throw new Error("a run without a summary");
    }
    this.summary = result.finished.summary;
    this.cycle_s = result.started.cycle_s;
    this.cut = result.finished.cut;
    this.lines = result.lines;
    this.columns = new Map(result.started.columns.map((column, i) => [column.name, result.columns[i] ?? new Float64Array()]));
    this.time_s = Float64Array.from(result.lines, (_, k) => k * this.cycle_s);
  }

  get rows(): number {
    return this.lines.length;
  }

  /** All columns in the order of the trace. */
  all(): { name: string; values: Float64Array }[] {
    return Array.from(this.columns, ([name, values]) => ({ name, values }));
  }

  of(signal: Signal): Float64Array {
    return this.columns.get(signal) ?? new Float64Array(this.rows);
  }
}

/** The largest magnitude of a column; 0 without rows. */
export function most(values: Float64Array): number {
  return values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
}
