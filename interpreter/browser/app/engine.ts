// The module and its calls. A module that has stopped cannot be used any more: `Trap` says why, and the caller loads another one.

/** A message as an editor shows it; lines and columns from 1. */
export interface Message {
  id: string;
  severity: "note" | "warning" | "error";
  text: string;
  hint: string | null;
  place: { line: number; column: number; length: number } | null;
  time_s: number | null;
}

/** The request for a run: a program, settings as with `--set`, and the wanted part of the result. */
export interface Request {
  program: string;
  settings: string[];
  ax_dev_mm: number | null;
  signals: string;
  max_rows: number;
}

export interface Checked {
  messages: Message[];
  refused: boolean;
}

export interface Column {
  name: string;
  unit: string;
  decimals: number;
}

export interface Started extends Checked {
  cycle_s: number;
  axes: string[];
  columns: Column[];
}

/** The part of a summary that the page shows. */
export interface Summary {
  state: "finished" | "aborted";
  cycles: number;
  duration_s: number;
  arrival_s: number;
  ideal_duration_s: number;
  path_length_mm: number;
  max_contour_error: { mm: number; time_s: number; line: number } | null;
  axes: { name: string; max_vel: number; max_acc: number; max_jerk: number; max_dev: number | null; max_lag: number }[];
  time_by_v_limit_s: Record<string, number>;
}

export interface Finished {
  cut: boolean;
  messages: Message[];
  summary: Summary | null;
}

export interface Explained {
  found: boolean;
  title: string;
  meaning: string;
  facts: [string, string][];
  notes: string[];
  example: string | null;
  related: string[];
}

interface Exports {
  memory: WebAssembly.Memory;
  request(bytes: number): number;
  check(): void;
  explain(): void;
  start(): void;
  advance(cycles: number): number;
  finish(): void;
  answer(): number;
  answer_length(): number;
  column(i: number): number;
  rows(): number;
  last_words(): number;
  last_words_length(): number;
}

/** The module stopped. */
export class Trap extends Error {}

/** The request is invalid: too long, or not in the form that the module expects. */
export class Refused extends Error {}

export class Engine {
  private constructor(private readonly exports: Exports) {}

  /** A new module from its bytes. */
  static async load(bytes: BufferSource): Promise<Engine> {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Engine(instance.exports as unknown as Exports);
  }

  /** An engine on given exports. */
  static of(exports: object): Engine {
    return new Engine(exports as Exports);
  }

  check(request: Request): Checked {
    return this.ask<Checked>(JSON.stringify(request), (e) => e.check());
  }

  explain(thing: string): Explained {
    return this.ask<Explained>(thing, (e) => e.explain());
  }

  start(request: Request): Started {
    return this.ask<Started>(JSON.stringify(request), (e) => e.start());
  }

  /** Computes up to the given number of cycles; true while there are more. */
  advance(cycles: number): boolean {
    return this.guarded((e) => e.advance(cycles) === 1);
  }

  finish(): Finished {
    return this.ask<Finished>("", (e) => e.finish());
  }

  get rows(): number {
    return this.guarded((e) => e.rows());
  }

  /** A copy of the values of a column; after the last column come the lines of the rows. */
  column(i: number): Float64Array<ArrayBuffer> {
    return this.guarded((e) => new Float64Array(e.memory.buffer, e.column(i), e.rows()).slice());
  }

  private ask<T>(text: string, call: (exports: Exports) => void): T {
    const answer = this.guarded((e) => {
      const bytes = new TextEncoder().encode(text);
      const at = e.request(bytes.length);
      if (at === 0) {
        throw new Refused("the program is too long for the page");
      }
      new Uint8Array(e.memory.buffer, at, bytes.length).set(bytes);
      call(e);
      return new TextDecoder().decode(new Uint8Array(e.memory.buffer, e.answer(), e.answer_length()));
    });
    const parsed = JSON.parse(answer) as T & { wrong?: string };
    if (parsed.wrong !== undefined) {
      throw new Refused(parsed.wrong);
    }
    return parsed;
  }

  private guarded<T>(call: (exports: Exports) => T): T {
    try {
      return call(this.exports);
    } catch (e) {
      if (e instanceof Refused) {
        throw e;
      }
      throw new Trap(this.lastWords() || String(e));
    }
  }

  private lastWords(): string {
    try {
      const e = this.exports;
      return new TextDecoder().decode(new Uint8Array(e.memory.buffer, e.last_words(), e.last_words_length()));
    } catch {
      return "";
    }
  }
}
