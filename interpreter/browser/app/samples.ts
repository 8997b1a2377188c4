// Samples to start with, and exercises with a goal. The programs of exercises are those of `programs/lessons`.

import oneMove from "../../../programs/lessons/1_one_move.nc?raw";
import corner from "../../../programs/lessons/3_corner.nc?raw";
import rounding from "../../../programs/lessons/4_rounding.nc?raw";
import lag from "../../../programs/lessons/6_lag.nc?raw";
import guard from "../../../programs/lessons/7_guard.nc?raw";
import times from "../../../programs/lessons/8_times.nc?raw";
import squareCorner from "../../../programs/square_corner.nc?raw";
import type { Controls } from "./settings";
import { type Trace, most } from "./trace";

/** State of a goal: a number of the run, and whether it meets the goal. */
export interface Reached {
  reached: boolean;
  /** Value of the current run. */
  now: string;
}

export interface Sample {
  id: string;
  title: string;
  /** What there is to see, or the task. */
  text: string;
  program: string;
  controls?: Partial<Controls>;
  goal?: (trace: Trace, controls: Controls) => Reached;
}

const SQUARE = `%SQUARE
(the controls act on this square of 10 mm)
N10 G01 X10 F6000
N20 Y10
N30 X0
N40 Y0
N50 M30
`;

const between = (x: number, low: number, high: number) => x >= low && x <= high;
const s = (x: number) => `${x.toFixed(3)} s`;
const mm = (x: number) => `${x.toFixed(4)} mm`;

/** Time of the path, without the arrival of the axes. */
function pathTime(trace: Trace): number {
  return trace.summary.duration_s - trace.summary.arrival_s;
}

/** Lowest speed between the first and the last time at half of the highest speed. */
function lowest(trace: Trace): number {
  const v = trace.of("v_mm_s");
  const half = most(v) / 2;
  const first = v.findIndex((x) => x >= half);
  const last = v.findLastIndex((x) => x >= half);
  return first < 0 ? 0 : v.slice(first, last + 1).reduce((least, x) => Math.min(least, x), Infinity);
}

/** Lag of X in the middle of the first section at full speed. */
function onTheWay(trace: Trace): number {
  const v = trace.of("v_mm_s");
  const full = 0.999 * most(v);
  const first = v.findIndex((x) => x >= full);
  const length = v.slice(first).findIndex((x) => x < full);
  return Math.abs(trace.of("X_lag_mm")[first + Math.floor(length / 2)] ?? 0);
}

export const SAMPLES: readonly Sample[] = [
  {
    id: "square",
    title: "Square, 10 mm",
    text: "Switch the Vibration Guard on and lower its frequency: the corners get rounder. Then limit the error with AX_DEV, and see how much time that costs.",
    program: SQUARE,
    controls: { guard: true },
  },
  {
    id: "square_corner",
    title: "Square, 1 mm, three passes",
    text: "The program itself switches the guard: with a tolerance, without one, and off. Commands of a program take precedence over the controls.",
    program: squareCorner,
  },
];

export const EXERCISES: readonly Sample[] = [
  {
    id: "one_move",
    title: "1 Half a second",
    text: "Which F does the path of 100 mm need to take 0.500 s, not counting the arrival of the axes? The axes accelerate with a = 3500 mm/s² and need tr = 30 ms to build that up: a speed v costs v/a + tr.",
    program: oneMove,
    goal: (trace) => {
      const t = pathTime(trace);
      return { reached: between(t, 0.4985, 0.5015) && between(trace.summary.path_length_mm, 99.99, 100.01), now: `path ${trace.summary.path_length_mm.toFixed(1)} mm in ${s(t)}` };
    },
  },
  {
    id: "corner",
    title: "2 Through a corner",
    text: "At the sharp corner the axes allow a jump of 3.5 mm/s. Change the second line so that the path turns by an angle that can be passed at 20 mm/s, but not faster than 21 mm/s. Both lines stay 20 mm long: X[20+20*COS[P1]] Y[20*SIN[P1]].",
    program: corner,
    goal: (trace) => {
      const v = lowest(trace);
      return { reached: between(v, 19.9, 21) && between(trace.summary.path_length_mm, 39.9, 40.1), now: `lowest speed between the ramps ${v.toFixed(1)} mm/s` };
    },
  },
  {
    id: "rounding",
    title: "3 A rounded corner",
    text: "Which tolerance PATH_DEV lets the corner be passed at 30 mm/s? The cube of the speed grows with the square of the tolerance.",
    program: rounding.replaceAll("V.E.DEV", "0.05"),
    goal: (trace) => {
      const v = lowest(trace);
      return { reached: between(v, 29.5, 30.5), now: `lowest speed between the ramps ${v.toFixed(1)} mm/s` };
    },
  },
  {
    id: "lag",
    title: "4 Following error",
    text: "A position controller needs an error to move: lag = v / Kv. Find the Kv with which the axis lags by 0.5 mm on the way out, at 100 mm/s.",
    program: lag,
    goal: (trace) => {
      const lag = onTheWay(trace);
      return { reached: between(lag, 0.49, 0.51) && between(most(trace.of("v_mm_s")), 99.9, 100.1), now: `lag on the way out ${mm(lag)}` };
    },
  },
  {
    id: "guard",
    title: "5 Vibration Guard",
    text: "The guard rounds the corners of the square of 20 mm. Which is the lowest frequency in whole Hz that keeps the contour error below 0.01 mm, without AX_DEV?",
    program: guard.replaceAll("V.E.HZ", "20"),
    goal: (trace, controls) => {
      const e = most(trace.of("contour_err_mm"));
      return { reached: between(e, 0.0096, 0.01) && !controls.bounded, now: `contour error ${mm(e)}` };
    },
  },
  {
    id: "times",
    title: "6 Where the time goes",
    text: "This program is at its feed for a fifth of its time. Remove what only waits, without changing the path, until it takes less than 4.1 s.",
    program: times,
    goal: (trace) => ({
      reached: trace.summary.duration_s < 4.1 && between(trace.summary.path_length_mm, TIMES_MM - 0.1, TIMES_MM + 0.1) && trace.summary.state === "finished",
      now: `${trace.summary.path_length_mm.toFixed(1)} mm in ${s(trace.summary.duration_s)}`,
    }),
  },
];

/** Length of the path of the last exercise. */
const TIMES_MM = 511.2;

export function sampleOf(id: string): Sample | undefined {
  return [...SAMPLES, ...EXERCISES].find((sample) => sample.id === id);
}
