// The controls of the page, and the list parameters behind them.

/** Types of `filter[0]` that the page offers. */
export const FILTERS = ["none", "LOWPASS", "BANDSTOP", "PT1"] as const;
export const PROTOTYPES = ["CRIT_DAMPING", "BUTTERWORTH", "BESSEL"] as const;
export const SLOPES = ["STEP", "TRAPEZ", "SIN2", "HSC"] as const;

/** Above it the control uses the highest permitted value, with a message. */
const HIGHEST_ORDER = { LOWPASS: 6, BANDSTOP: 3, PT1: 1 } as const;

export interface Controls {
  guard: boolean;
  mode: number;
  freq_hz: number;
  damping: number;
  bounded: boolean;
  ax_dev_mm: number;
  filter: (typeof FILTERS)[number];
  prototype: (typeof PROTOTYPES)[number];
  order: number;
  f0_hz: number;
  quality: number;
  slope: (typeof SLOPES)[number];
  acc_mm_s2: number;
  ramp_ms: number;
  feedforward: boolean;
  kv_1_s: number;
}

/** The machine `xyz` as in its lists, with everything else off. */
export const DEFAULTS: Readonly<Controls> = {
  guard: false,
  mode: 2,
  freq_hz: 20,
  damping: 0.1,
  bounded: false,
  ax_dev_mm: 0.01,
  filter: "none",
  prototype: "CRIT_DAMPING",
  order: 2,
  f0_hz: 20,
  quality: 2,
  slope: "TRAPEZ",
  acc_mm_s2: 3500,
  ramp_ms: 30,
  feedforward: false,
  kv_1_s: 50,
};

/** Range of each number, with the step of its slider. */
export const RANGES = {
  mode: [1, 4, 1],
  freq_hz: [4, 100, 0.5],
  damping: [0, 0.5, 0.01],
  ax_dev_mm: [0.001, 0.2, 0.001],
  order: [1, 6, 1],
  f0_hz: [2, 200, 0.5],
  quality: [1, 10, 0.1],
  acc_mm_s2: [200, 6000, 50],
  ramp_ms: [5, 120, 1],
  kv_1_s: [5, 250, 1],
} as const satisfies Partial<Record<keyof Controls, readonly [number, number, number]>>;

/** Settings applied to the lists, as with `--set`; only those that differ from the machine. */
export function settings(c: Controls): string[] {
  const all: string[] = [];
  const every = (key: string, value: number | string) => all.push(`*.${key}=${value}`);
  if (c.guard) {
    every("vib_guard.active", 1);
    every("vib_guard.mode", c.mode);
    every("vib_guard.freq", c.freq_hz);
    every("vib_guard.damping", c.damping);
  }
  if (c.filter !== "none") {
    every("filter[0].enable", 1);
    every("filter[0].type", c.filter);
    every("filter[0].order", Math.min(c.order, HIGHEST_ORDER[c.filter]));
    if (c.filter === "PT1") {
      every("filter[0].time_constant", Math.max(1000, Math.round(1e6 / (2 * Math.PI * c.f0_hz))));
    } else {
      every("filter[0].prototype", c.prototype);
      every("filter[0].fg_f0", c.f0_hz);
    }
    if (c.filter === "BANDSTOP") {
      every("filter[0].guete", c.quality);
    }
  }
  if (c.slope !== DEFAULTS.slope) {
    all.push(`channel.prog_start.slope.profile=${SLOPES.indexOf(c.slope)}`);
  }
  if (c.acc_mm_s2 !== DEFAULTS.acc_mm_s2) {
    for (const key of ["slope_profil.a_beschl", "slope_profil.a_brems", "lslope_profil.a_stufe_1", "lslope_profil.a_stufe_2"]) {
      every(`getriebe[0].${key}`, c.acc_mm_s2);
    }
  }
  if (c.ramp_ms !== DEFAULTS.ramp_ms) {
    for (const key of ["tr_beschl_zu", "tr_beschl_ab", "tr_brems_zu", "tr_brems_ab"]) {
      every(`getriebe[0].slope_profil.${key}`, Math.round(c.ramp_ms * 1000));
    }
  }
  if (c.feedforward) {
    every("vorsteuer.default_active", 1);
  }
  if (c.kv_1_s !== DEFAULTS.kv_1_s) {
    every("getriebe[0].kv", Math.round(c.kv_1_s * 100));
  }
  return all;
}

/** `AX_DEV` for programs that give none. */
export function tolerance(c: Controls): number | null {
  return c.guard && c.bounded ? c.ax_dev_mm : null;
}

/** The block with the same effect in a program as the controls of the guard. */
export function guardBlock(c: Controls): string | null {
  if (!c.guard) {
    return null;
  }
  const bound = c.bounded ? ` AX_DEV=${c.ax_dev_mm}` : "";
  return `#VIB GUARD ON [MODE=${c.mode} FREQ=${c.freq_hz} DAMPING=${c.damping}${bound}]`;
}

/** The command for the same run; a tolerance has to be written in the program. */
export function commandLine(c: Controls): string {
  return ["kontur run part.nc", ...settings(c).map((setting) => `--set '${setting}'`)].join(" ");
}

/** Controls from arbitrary data: anything that is not a permitted value of a control becomes its default. */
export function controlsOf(anything: unknown): Controls {
  const given = (typeof anything === "object" && anything !== null ? anything : {}) as Record<string, unknown>;
  const result: Record<string, unknown> = { ...DEFAULTS };
  for (const [key, initial] of Object.entries(DEFAULTS)) {
    const value = given[key];
    if (typeof value !== typeof initial) {
      continue;
    }
    if (typeof value === "number") {
      const range = RANGES[key as keyof typeof RANGES];
      if (Number.isFinite(value)) {
        result[key] = Math.min(range[1], Math.max(range[0], value));
      }
    } else if (typeof value === "boolean") {
      result[key] = value;
    } else {
      const words: readonly string[] = key === "filter" ? FILTERS : key === "slope" ? SLOPES : PROTOTYPES;
      if (words.includes(value as string)) {
        result[key] = value;
      }
    }
  }
  return result as unknown as Controls;
}
