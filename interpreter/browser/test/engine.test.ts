// The module beside the library: the same bits, messages with places, an end to whatever a program does.

import { mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { beforeEach, describe, expect, test } from "vitest";
import { traceHash } from "../app/canonical";
import { thingAt } from "../app/editor";
import { Engine, Refused, Trap, type Request } from "../app/engine";
import type { RunResult } from "../app/protocol";
import { EXERCISES, SAMPLES, sampleOf } from "../app/samples";
import { DEFAULTS, RANGES, controlsOf, settings, tolerance, type Controls } from "../app/settings";
import { fromLink, toLink } from "../app/share";
import { SIGNALS, Trace } from "../app/trace";
import { native } from "./native";

const root = new URL("../../../", import.meta.url);
const bytes = gunzipSync(readFileSync(new URL("../app/generated/kontur.wasm.gz", import.meta.url)));
const folder = mkdtempSync(join(tmpdir(), "kontur-"));

let engine: Engine;
beforeEach(async () => {
  engine = await Engine.load(bytes);
});

function request(program: string, more: Partial<Request> = {}): Request {
  return { program, settings: [], ax_dev_mm: null, signals: SIGNALS.join(","), max_rows: 120_000, ...more };
}

function run(program: string, more: Partial<Request> = {}): RunResult {
  const started = engine.start(request(program, more));
  expect(started.refused, JSON.stringify(started.messages)).toBe(false);
  while (engine.advance(1000));
  const finished = engine.finish();
  const columns = started.columns.map((_, i) => engine.column(i));
  return { started, finished, columns, lines: engine.column(started.columns.length), took_ms: 0 };
}

describe("bits", () => {
  const controls = { ...DEFAULTS, guard: true, freq_hz: 33.5, slope: "HSC", ramp_ms: 25 } as Controls;
  test.each([
    ["square", [] as string[]],
    ["square_corner", []],
    ["times", []],
    ["square", settings(controls)],
  ])("%s gives the hash of the library", async (id, set) => {
    const program = sampleOf(id)?.program ?? "";
    const path = join(folder, `${id}.nc`);
    writeFileSync(path, program);
    const trace = new Trace(run(program, { settings: set }));
    const hash = await traceHash(trace.all());
    const expected = native("trace-hash", ["--signals", SIGNALS.join(","), ...set.flatMap((s) => ["--set", s]), path]);
    expect(expected.split(" ")[0]).toBe(hash);
  });

  test("a second run in the same module has the same bits", async () => {
    const once = await traceHash(new Trace(run(SAMPLES[0]?.program ?? "")).all());
    run(SAMPLES[1]?.program ?? "");
    expect(await traceHash(new Trace(run(SAMPLES[0]?.program ?? "")).all())).toBe(once);
  });
});

describe("messages", () => {
  test("have ID, place and hint", () => {
    const { messages, refused } = engine.check(request("N10 G01 X10\nN20 G777 Y5\n"));
    expect(refused).toBe(true);
    const [feed, unknown] = messages;
    expect(feed).toMatchObject({ id: "20008", severity: "error", place: { line: 1 } });
    expect(feed?.hint).toContain("F");
    expect(unknown).toMatchObject({ id: "20131", place: { line: 2, column: 5, length: 4 } });
  });

  test("of settings have none", () => {
    const { messages, refused } = engine.check(request("M30\n", { settings: ["*.kvv=1"] }));
    expect(refused).toBe(true);
    expect(messages[0]).toMatchObject({ place: null });
  });

  test("words are explained", () => {
    expect(engine.explain("20008").meaning).toBe("feed is 0 in a motion block");
    expect(engine.explain("#VIB GUARD ON").found).toBe(true);
    expect(engine.explain("#VIB GARD").related).toContain("#VIB GUARD");
  });

  test("the word under a column is found", () => {
    const line = "N10 #VIB GUARD ON [MODE=2 FREQ=40] ; G04";
    expect(thingAt(line, 6)?.things).toEqual(["#VIB GUARD ON"]);
    expect(thingAt(line, 20)?.things[0]).toBe("#VIB GUARD ON");
    expect(thingAt("N10 G1 X5", 5)?.things).toContain("G01");
    expect(thingAt("N10 G1 X5", 8)).toBeNull();
  });
});

describe("an end", () => {
  test("rows are limited", () => {
    const result = run("$WHILE 1\nG01 X10 F6000\nX0\n$ENDWHILE\nM30\n", { max_rows: 5000 });
    expect(result.finished.cut).toBe(true);
    expect(result.lines.length).toBe(5000);
  });

  test.each([
    ["a loop without motion", "$WHILE 1\nP1=P1+1\n$ENDWHILE\nM30\n"],
    ["a call of itself", "%L A\nLL A\nM17\n%MAIN\nLL A\nM30\n"],
    ["brackets", `P1=${"[".repeat(4000)}1${"]".repeat(4000)}\nM30\n`],
    ["no text", "\u0000\uFFFD\u{1F600}".repeat(1000)],
    ["an array of everything", "#VAR\nV.P.A[100000][100000]=[0]\n#ENDVAR\nM30\n"],
    ["a long line", `X${"1".repeat(200_000)}\n`],
  ])("%s is a message", (_, program) => {
    const { messages, refused } = engine.check(request(program));
    expect(refused).toBe(true);
    expect(messages[0]?.severity).toBe("error");
    // and the module continues
    expect(engine.check(request("M30\n")).refused).toBe(false);
  });

  test("no program of the suite of faults, whole or cut anywhere, stops the module", () => {
    const suite = new URL("tests/suite/faults/", root);
    const names = readdirSync(suite).filter((name) => name.endsWith(".nc"));
    expect(names.length).toBeGreaterThan(100);
    for (const name of names) {
      const program = readFileSync(new URL(name, suite), "latin1");
      for (const part of [program, program.slice(0, program.length / 2), program.slice(program.length / 3)]) {
        if (!engine.start(request(part, { max_rows: 3000 })).refused) {
          while (engine.advance(1000));
          engine.finish();
        }
      }
    }
  });

  test("what is no request is refused", () => {
    expect(() => engine.check({ ...request("M30"), settings: 7 } as unknown as Request)).toThrow(Refused);
    expect(() => engine.check(request("X".repeat(5 << 20)))).toThrow(Refused);
    expect(() => engine.start(request("M30", { signals: "nothing" }))).toThrow(Refused);
  });

  test("a stop of the module says why", () => {
    const memory = new WebAssembly.Memory({ initial: 1 });
    const words = new TextEncoder().encode("panicked at here");
    new Uint8Array(memory.buffer, 32768, words.length).set(words);
    const stopped = () => {
      throw new WebAssembly.RuntimeError("unreachable");
    };
    const broken = Engine.of({ memory, request: () => 8, check: stopped, last_words: () => 32768, last_words_length: () => words.length });
    expect(() => broken.check(request("M30"))).toThrow(Trap);
    expect(() => broken.check(request("M30"))).toThrow("panicked at here");
  });
});

describe("controls", () => {
  test("every one is a parameter that the machine takes", () => {
    const turned: Partial<Controls>[] = [
      { guard: true }, { guard: true, mode: 4, freq_hz: 100, damping: 0.5, bounded: true, ax_dev_mm: 0.001 },
      { filter: "LOWPASS", prototype: "BESSEL", order: 6 }, { filter: "BANDSTOP", quality: 10, order: 6 }, { filter: "PT1", f0_hz: 200 },
      { slope: "STEP" }, { slope: "SIN2" }, { slope: "HSC" }, { acc_mm_s2: 6000 }, { acc_mm_s2: 200 }, { ramp_ms: 5 }, { feedforward: true }, { kv_1_s: 250 },
    ];
    for (const some of turned) {
      const controls = { ...DEFAULTS, ...some };
      const result = run(SAMPLES[0]?.program ?? "", { settings: settings(controls), ax_dev_mm: tolerance(controls) });
      const wrong = result.finished.messages.filter((m) => m.severity !== "note");
      expect(wrong, JSON.stringify(some)).toEqual([]);
    }
  });

  test("unchanged they are the machine", () => {
    expect(settings(DEFAULTS)).toEqual([]);
  });

  test("a tolerance holds", () => {
    const controls: Controls = { ...DEFAULTS, guard: true, bounded: true, ax_dev_mm: 0.005 };
    const free = run(SAMPLES[0]?.program ?? "", { settings: settings(controls) });
    const bound = run(SAMPLES[0]?.program ?? "", { settings: settings(controls), ax_dev_mm: tolerance(controls) });
    const deviation = (r: RunResult) => Math.max(...(r.finished.summary?.axes ?? []).map((a) => a.max_dev ?? 0));
    expect(deviation(free)).toBeGreaterThan(0.05);
    expect(deviation(bound)).toBeLessThanOrEqual(0.005);
  });
});

describe("links", () => {
  test("carry the state", async () => {
    const state = { sample: "lag", program: "N10 G01 X5 F1000 (ä Ω)\nM30\n", controls: { ...DEFAULTS, guard: true, freq_hz: 12.5 } };
    expect(await fromLink(await toLink(state))).toEqual(state);
  });

  test("of strangers do no harm", async () => {
    expect(await fromLink("no link")).toBeNull();
    expect(await fromLink("")).toBeNull();
    const bomb = await toLink({ sample: "", program: "X".repeat(9_000_000), controls: { ...DEFAULTS } });
    expect(bomb.length).toBeLessThan(20_000);
    expect(await fromLink(bomb)).toBeNull();
    expect(controlsOf({ freq_hz: Infinity, mode: 77, filter: "<script>", guard: "yes", extra: 1 })).toEqual({ ...DEFAULTS, mode: RANGES.mode[1] });
    expect(controlsOf(null)).toEqual(DEFAULTS);
  });
});

describe("exercises", () => {
  /** What reaches the goal: changes of the program and of the controls. */
  const SOLUTIONS: Record<string, { edit?: (program: string) => string; controls?: Partial<Controls> }> = {
    one_move: { edit: (p) => p.replace("X100 F6000", "X100 F15066") },
    // asin(3.5 / 20) = 10.08 degrees
    corner: { edit: (p) => p.replace("Y20", "X[20+20*COS[10]] Y[20*SIN[10]]") },
    rounding: { edit: (p) => p.replace("PATH_DEV=0.05", "PATH_DEV=0.163") },
    lag: { controls: { kv_1_s: 200 } },
    guard: { edit: (p) => p.replace("FREQ=20", "FREQ=48") },
    times: { edit: (p) => p.replace("N60 G04 0.1\n", "").replace("G60 ", "") },
  };

  test.each(EXERCISES.map((exercise) => [exercise.id, exercise] as const))("%s is not reached at first, and can be", (id, exercise) => {
    const solution = SOLUTIONS[id];
    const attempt = (program: string, some: Partial<Controls>) => {
      const controls = { ...DEFAULTS, ...exercise.controls, ...some };
      const trace = new Trace(run(program, { settings: settings(controls), ax_dev_mm: tolerance(controls) }));
      return exercise.goal?.(trace, controls);
    };
    expect(attempt(exercise.program, {})).toMatchObject({ reached: false });
    const program = solution?.edit?.(exercise.program) ?? exercise.program;
    expect(program !== exercise.program || solution?.controls !== undefined).toBe(true);
    expect(attempt(program, solution?.controls ?? {})).toMatchObject({ reached: true });
  });
});

describe("problem matcher of the book", () => {
  test("finds what the command line prints", () => {
    const page = readFileSync(new URL("interpreter/book/pages/editor.md", root), "utf8");
    const tasks = JSON.parse(page.split("```json")[1]?.split("```")[0] ?? "");
    const [head, place] = tasks.tasks[0].problemMatcher.pattern as { regexp: string; [group: string]: string | number }[];
    const path = join(folder, "wrong.nc");
    writeFileSync(path, `${"N10 G04 0.1\n".repeat(120)}N20 G777\n`);
    const said = native("kontur", ["check", path]);
    const lines = said.split("\n");
    const at = lines.findIndex((line) => new RegExp(head?.regexp ?? "").test(line));
    const first = lines[at]?.match(head?.regexp ?? "");
    const second = lines[at + 1]?.match(place?.regexp ?? "");
    expect(first?.slice(1, 3)).toEqual(["error", "20131"]);
    expect(second?.slice(1)).toEqual([path, "121", "5"]);
  });
});
