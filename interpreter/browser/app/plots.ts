// Quantities over time. All plots share a cursor, which is a row of the trace.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { type Signal, type Trace } from "./trace";

interface Line {
  signal: Signal;
  name: string;
  /** Custom property with its colour. */
  colour: string;
}

/** The quantities that a plot can show, by name. */
export const QUANTITIES = {
  speed: { title: "Path speed", unit: "mm/s", lines: [{ signal: "v_mm_s", name: "speed", colour: "--set" }] },
  acceleration: { title: "Path acceleration", unit: "mm/s²", lines: [{ signal: "a_mm_s2", name: "acceleration", colour: "--set" }] },
  jerk: { title: "Path jerk", unit: "mm/s³", lines: [{ signal: "j_mm_s3", name: "jerk", colour: "--set" }] },
  error: {
    title: "Contour error",
    unit: "µm",
    lines: [
      { signal: "contour_err_mm", name: "contour", colour: "--set" },
      { signal: "X_dev_mm", name: "X", colour: "--actual" },
      { signal: "Y_dev_mm", name: "Y", colour: "--second" },
    ],
  },
  lag: {
    title: "Following error",
    unit: "µm",
    lines: [
      { signal: "X_lag_mm", name: "X", colour: "--actual" },
      { signal: "Y_lag_mm", name: "Y", colour: "--second" },
    ],
  },
} as const satisfies Record<string, { title: string; unit: string; lines: readonly Line[] }>;
export type Quantity = keyof typeof QUANTITIES;

/** Plots of one group share the cursor and the range of time. */
const GROUP = "kontur";

export class TimePlot {
  private plot: uPlot | undefined;
  private trace: Trace | undefined;
  private kept: Trace | undefined;
  private quiet = false;

  constructor(private readonly parent: HTMLElement, private quantity: Quantity, private readonly row: (row: number | null) => void) {
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(parent);
  }

  show(trace: Trace): void {
    this.trace = trace;
    if (this.plot) {
      this.plot.setData(this.data());
    } else {
      this.build();
    }
  }

  keep(trace: Trace | undefined): void {
    this.kept = trace;
    this.build();
  }

  choose(quantity: Quantity): void {
    this.quantity = quantity;
    this.build();
  }

  /** Colours have changed. */
  repaint(): void {
    this.build();
  }

  cursor(row: number | null): void {
    const time = row === null ? undefined : this.trace?.time_s[row];
    if (this.plot) {
      this.quiet = true;
      this.plot.setCursor(time === undefined ? { left: -10, top: -10 } : { left: this.plot.valToPos(time, "x"), top: this.plot.over.clientHeight / 2 });
      this.quiet = false;
    }
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(this.parent.clientWidth, 100), height: this.parent.clientHeight };
  }

  private data(): uPlot.AlignedData {
    const { trace, kept } = this;
    if (!trace) {
      return [[]];
    }
    const { lines, unit } = QUANTITIES[this.quantity];
    const factor = unit === "µm" ? 1000 : 1;
    const longest = kept && kept.rows > trace.rows ? kept : trace;
    const column = (of: Trace, signal: Signal) => {
      const values: (number | null)[] = Array.from(of.of(signal), (value) => value * factor);
      while (values.length < longest.rows) {
        values.push(null);
      }
      return values;
    };
    const all: uPlot.AlignedData = [Array.from(longest.time_s), ...lines.map((line) => column(trace, line.signal))];
    if (kept) {
      const first = lines[0].signal;
      all.push(column(kept, first));
    }
    return all;
  }

  private build(): void {
    this.plot?.destroy();
    this.plot = undefined;
    if (!this.trace) {
      return;
    }
    const style = getComputedStyle(this.parent);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const { title, lines, unit } = QUANTITIES[this.quantity];
    const font = `11px ${style.fontFamily}`;
    const axis: uPlot.Axis = {
      stroke: colour("--muted"),
      font,
      grid: { stroke: colour("--grid"), width: 1 },
      ticks: { stroke: colour("--grid"), width: 1, size: 4 },
    };
    const number = (value: number | null) => (value === null || value === undefined ? "–" : Number(value.toPrecision(5)).toLocaleString("en", { maximumFractionDigits: 4 }));
    const series: uPlot.Series[] = lines.map((line: Line) => ({
      label: line.name,
      stroke: colour(line.colour),
      width: 1.6,
      points: { show: false },
      value: (_: uPlot, value: number | null) => `${number(value)} ${unit}`,
    }));
    if (this.kept) {
      series.push({ label: "kept", stroke: colour("--kept"), width: 1.4, dash: [6, 4], points: { show: false }, value: (_: uPlot, value: number | null) => `${number(value)} ${unit}` });
    }
    this.plot = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false } },
        axes: [{ ...axis, values: (_, ticks) => ticks.map((t) => `${t} s`), size: 30 }, { ...axis, size: 62, label: `${title} in ${unit}`, labelSize: 18, labelGap: 0, labelFont: font }],
        series: [{ label: "t", value: (_, value) => (value === null || value === undefined ? "–" : `${value.toFixed(3)} s`) }, ...series],
        cursor: { sync: { key: GROUP, scales: ["x", null] }, y: false, points: { size: 7 } },
        legend: { live: true },
        hooks: {
          setCursor: [(plot) => {
            const own = !this.quiet && plot.cursor.event !== undefined && plot.cursor.event !== null;
            if (own) {
              this.row(plot.cursor.idx ?? null);
            }
          }],
        },
      },
      this.data(),
      this.parent,
    );
    this.plot.ctx.canvas.setAttribute("role", "img");
    this.plot.ctx.canvas.setAttribute("aria-label", `${title} in ${unit} over time`);
  }
}
