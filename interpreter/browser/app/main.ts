// The page: text and settings go to the worker, the results are drawn.

import "./style.css";
import { traceHash } from "./canonical";
import { Client } from "./client";
import { Contour } from "./contour";
import { Editor, explanation } from "./editor";
import type { Message } from "./engine";
import packed from "./generated/kontur.wasm.gz?inline";
import { type Quantity, TimePlot } from "./plots";
import type { RunResult } from "./protocol";
import { EXERCISES, SAMPLES, type Sample, sampleOf } from "./samples";
import { type Controls, DEFAULTS, RANGES, commandLine, controlsOf, guardBlock, settings, tolerance } from "./settings";
import { PROGRAM_MAX, type State, fromLink, toLink } from "./share";
import { SIGNALS, Trace } from "./trace";
import RunWorker from "./worker?worker&inline";

/** Rows after which the page stops a run: two minutes of a cycle of 1 ms. */
const MAX_ROWS = 120_000;
/** Pause in typing in ms after which the program runs. */
const TYPING_MS = 120;

function $<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) {
    throw new Error(`#${id} is missing`);
  }
  return found as T;
}

async function unpacked(url: string): Promise<ArrayBuffer> {
  const binary = atob(url.slice(url.indexOf(",") + 1));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

let controls: Controls = { ...DEFAULTS };
let sample: Sample = SAMPLES[0] as Sample;
let trace: Trace | undefined;
let kept: Trace | undefined;
let asked = 0;
/** A message that stays beside the results until another program is chosen. */
let remark = "";
let editor: Editor;
let client: Client;

// ---- results

const contour = new Contour($("contour"), {
  row: (row) => point(row, true),
  picked: (line) => editor.goTo(line),
});
const plots = [
  new TimePlot($("speed"), "speed", (row) => point(row, false)),
  new TimePlot($("error"), "error", (row) => point(row, false)),
];

/** Shows the values of a row, and marks it. */
function point(row: number | null, fromContour: boolean): void {
  contour.cursor(row);
  if (fromContour) {
    plots.forEach((plot) => plot.cursor(row));
  }
  const under = $("under");
  if (row === null || !trace || row >= trace.rows) {
    under.textContent = "Point at the path to see time, line and error there; click to go to the line.";
    return;
  }
  const at = (values: Float64Array) => values[row] ?? 0;
  const position = `X ${at(trace.of("X_set_mm")).toFixed(4)} Y ${at(trace.of("Y_set_mm")).toFixed(4)} mm`;
  const speed = `${at(trace.of("v_mm_s")).toFixed(2)} mm/s`;
  const error = `${(1000 * at(trace.of("contour_err_mm"))).toFixed(2)} µm off the contour`;
  under.textContent = `t = ${at(trace.time_s).toFixed(3)} s · line ${at(trace.lines)} · ${position} · ${speed} · ${error}`;
}

function numbers(trace: Trace): void {
  const { summary } = trace;
  const planar = summary.axes.slice(0, 2);
  const largest = (of: (axis: (typeof planar)[number]) => number) => Math.max(0, ...planar.map(of));
  const shown: [string, string, string, number, boolean][] = [
    ["Duration", summary.duration_s.toFixed(3), "s", summary.duration_s, false],
    ["Contour error", (1000 * (summary.max_contour_error?.mm ?? 0)).toFixed(2), "µm", 0, false],
    ["Axis deviation", (1000 * largest((a) => a.max_dev ?? 0)).toFixed(2), "µm", 0, false],
    ["Acceleration", largest((a) => a.max_acc).toFixed(0), "mm/s²", 0, false],
    ["Jerk", (largest((a) => a.max_jerk) / 1000).toFixed(0), "m/s³", 0, false],
    ["Following error", (1000 * largest((a) => a.max_lag)).toFixed(1), "µm", 0, false],
  ];
  const list = $("numbers");
  list.replaceChildren();
  for (const [name, value, unit] of shown) {
    const box = document.createElement("div");
    const term = document.createElement("dt");
    term.textContent = name;
    const definition = document.createElement("dd");
    definition.textContent = `${value} `;
    const small = document.createElement("small");
    small.textContent = unit;
    definition.append(small);
    box.append(term, definition);
    list.append(box);
  }
}

function notice(text: string): void {
  const box = $("notice");
  box.hidden = text === "";
  box.textContent = text;
}

function finished(result: RunResult): void {
  trace = new Trace(result);
  messages(result.finished.messages);
  numbers(trace);
  contour.show(trace);
  plots.forEach((plot) => trace && plot.show(trace));
  $("results-title").closest(".results")?.classList.remove("stale");
  notice(trace.cut ? `Stopped after ${(trace.rows * trace.cycle_s).toFixed(0)} s of the program: the limit of this page. The command line has no such limit.` : remark);
  goal();
  void hash();
  const drawn = performance.now() - asked;
  $("status").textContent = `computed in ${result.took_ms.toFixed(0)} ms, drawn after ${drawn.toFixed(0)} ms`;
  document.documentElement.dataset.drawn = drawn.toFixed(1);
}

/** The hash of the drawn run, computed only while it is shown. */
async function hash(): Promise<void> {
  if (trace && $<HTMLDetailsElement>("same").open) {
    $("hash").textContent = await traceHash(trace.all());
  }
}

function failed(reason: string): void {
  $("results-title").closest(".results")?.classList.add("stale");
  $("status").textContent = "";
  notice(reason);
}

function goal(): void {
  const box = $("goal");
  box.hidden = !sample.goal;
  if (sample.goal && trace) {
    const { reached, now } = sample.goal(trace, controls);
    box.classList.toggle("reached", reached);
    box.textContent = reached ? `✓ Reached: ${now}` : `Not yet: ${now}`;
  }
}

// ---- messages

function messages(said: Message[]): void {
  editor.show(said);
  const list = $("messages");
  list.replaceChildren();
  const counts = { error: 0, warning: 0, note: 0 };
  said.forEach((message) => counts[message.severity]++);
  $("counts").textContent = said.length === 0 ? "no messages" : Object.entries(counts).filter(([, n]) => n > 0).map(([name, n]) => `${n} ${name}${n > 1 ? "s" : ""}`).join(", ");
  for (const message of said.slice(0, 100)) {
    const item = document.createElement("li");
    item.className = message.severity;
    const button = document.createElement("button");
    button.type = "button";
    const id = document.createElement("b");
    id.textContent = message.id;
    const text = document.createElement("span");
    text.textContent = message.place ? `line ${message.place.line}: ${message.text}` : message.text;
    button.append(id, text);
    if (message.hint) {
      const hint = document.createElement("small");
      hint.textContent = message.hint;
      button.append(hint);
    }
    button.addEventListener("click", () => {
      if (message.place) {
        editor.goTo(message.place.line, message.place.column);
      }
      void detail(message.id);
    });
    item.append(button);
    list.append(item);
  }
  $("detail").hidden = true;
}

async function detail(thing: string): Promise<void> {
  const explained = await client.explain(thing);
  const box = $("detail");
  box.hidden = explained === null;
  if (explained) {
    box.replaceChildren(explanation(explained));
  }
}

// ---- requests

let typing: ReturnType<typeof setTimeout> | undefined;

function run(): void {
  clearTimeout(typing);
  asked = performance.now();
  $("command").textContent = commandLine(controls);
  const block = tolerance(controls) === null ? null : guardBlock(controls);
  $("block-note").hidden = block === null;
  $("block").textContent = block ?? "";
  if (editor.text.length > PROGRAM_MAX) {
    failed("the program is too long for the page");
    return;
  }
  client.run({ program: editor.text, settings: settings(controls), ax_dev_mm: tolerance(controls), signals: SIGNALS.join(","), max_rows: MAX_ROWS });
}

const form = $<HTMLFormElement>("controls");
const fields = (name: string) => [...form.elements].filter((e) => e.getAttribute("name") === name) as (HTMLInputElement | HTMLSelectElement)[];

/** Whether a control has an effect with the other settings. */
function acting(name: string): boolean {
  switch (name) {
    case "mode": case "freq_hz": case "damping": case "bounded":
      return controls.guard;
    case "ax_dev_mm":
      return controls.guard && controls.bounded;
    case "prototype":
      return controls.filter === "LOWPASS" || controls.filter === "BANDSTOP";
    case "order": case "f0_hz":
      return controls.filter !== "none" && !(name === "order" && controls.filter === "PT1");
    case "quality":
      return controls.filter === "BANDSTOP";
    case "ramp_ms":
      return controls.slope !== "STEP";
    default:
      return true;
  }
}

function showControls(except?: EventTarget | null): void {
  for (const [name, value] of Object.entries(controls)) {
    for (const field of fields(name)) {
      if (field instanceof HTMLInputElement && field.type === "checkbox") {
        field.checked = value === true;
      } else if (field !== except) {
        field.value = String(value);
      }
      field.disabled = !acting(name);
      field.closest("label")?.classList.toggle("off", !acting(name));
    }
  }
}

function prepareControls(): void {
  for (const [name, [low, high, step]] of Object.entries(RANGES)) {
    for (const field of fields(name)) {
      if (field instanceof HTMLInputElement) {
        field.min = String(low);
        field.max = String(high);
        // a number field takes any value; a slider has steps
        field.step = field.type === "range" ? String(step) : "any";
        if (field.type === "number") {
          field.setAttribute("aria-label", `${field.closest("label")?.firstElementChild?.textContent ?? name}, as a number`);
        }
      }
    }
  }
  form.addEventListener("input", (event) => {
    const field = event.target as HTMLInputElement | HTMLSelectElement;
    const initial = DEFAULTS[field.name as keyof Controls];
    let value: unknown = field.value;
    if (typeof initial === "boolean") {
      value = (field as HTMLInputElement).checked;
    } else if (typeof initial === "number") {
      if (field.value === "") {
        return;
      }
      value = Number(field.value);
    }
    controls = controlsOf({ ...controls, [field.name]: value });
    showControls(field);
    run();
  });
  form.addEventListener("change", () => showControls());
  form.addEventListener("submit", (event) => event.preventDefault());
  $("same").addEventListener("toggle", () => void hash());
  $("reset").addEventListener("click", () => {
    controls = controlsOf({ ...DEFAULTS, ...sample.controls });
    showControls();
    run();
  });
  // the explanation of a control, from the same source as everywhere else
  for (const label of form.querySelectorAll<HTMLElement>("[data-thing]")) {
    label.addEventListener("pointerenter", async () => {
      if (!label.title) {
        const explained = await client.explain(label.dataset.thing ?? "");
        label.title = explained?.found ? `${explained.title}\n${explained.meaning}` : "";
      }
    }, { once: true });
  }
}

function choose(next: Sample): void {
  sample = next;
  $("task").textContent = next.text;
  $<HTMLSelectElement>("sample").value = next.id;
  $("goal").hidden = true;
}

function load(state: State): void {
  choose(sampleOf(state.sample) ?? (SAMPLES[0] as Sample));
  controls = state.controls;
  trace = undefined;
  remark = "";
  contour.forget();
  keep(undefined);
  editor.text = state.program;
  showControls();
  run();
}

function keep(next: Trace | undefined): void {
  kept = next;
  contour.keep(next);
  plots.forEach((plot) => plot.keep(next));
  const button = $("keep");
  button.setAttribute("aria-pressed", String(next !== undefined));
  button.textContent = next ? "Discard the kept run" : "Keep for comparison";
}

function theme(dark: boolean): void {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  $("theme").textContent = dark ? "Light" : "Dark";
  contour.draw();
  plots.forEach((plot) => plot.repaint());
}

function prepareHeader(): void {
  const select = $<HTMLSelectElement>("sample");
  for (const [title, group] of [["Look at", SAMPLES], ["Exercises", EXERCISES]] as const) {
    const box = document.createElement("optgroup");
    box.label = title;
    for (const one of group) {
      box.append(new Option(one.title, one.id));
    }
    select.append(box);
  }
  select.addEventListener("change", () => {
    const next = sampleOf(select.value);
    if (next) {
      load({ sample: next.id, program: next.program, controls: controlsOf({ ...DEFAULTS, ...next.controls }) });
    }
  });
  $("share").addEventListener("click", async () => {
    const link = await toLink({ sample: sample.id, program: editor.text, controls });
    history.replaceState(null, "", `#${link}`);
    let said = "Copied";
    try {
      await navigator.clipboard.writeText(location.href);
    } catch {
      said = "It is in the address bar";
    }
    $("share").textContent = said;
    setTimeout(() => ($("share").textContent = "Copy link"), 2000);
  });
  const wanted = window.matchMedia("(prefers-color-scheme: dark)");
  theme(wanted.matches);
  wanted.addEventListener("change", () => theme(wanted.matches));
  $("theme").addEventListener("click", () => theme(document.documentElement.dataset.theme !== "dark"));
}

async function main(): Promise<void> {
  const linked = location.hash.length > 1 ? await fromLink(location.hash.slice(1)) : null;
  const first = linked ?? { sample: sample.id, program: sample.program, controls: controlsOf({ ...DEFAULTS, ...sample.controls }) };
  editor = new Editor($("editor"), "", {
    changed: () => {
      clearTimeout(typing);
      typing = setTimeout(run, TYPING_MS);
    },
    line: (line) => contour.mark(line),
    explain: (thing) => client.explain(thing),
  });
  client = new Client(() => new RunWorker(), await unpacked(packed), {
    checked: (checked) => {
      messages(checked.messages);
      if (checked.refused) {
        failed("The program was refused: see its messages.");
      }
    },
    progress: (rows) => ($("status").textContent = `running, ${rows} cycles`),
    finished,
    failed,
  });
  prepareHeader();
  prepareControls();
  $("keep").addEventListener("click", () => keep(kept ? undefined : trace));
  $("in").addEventListener("click", () => contour.zoom(1.5));
  $("out").addEventListener("click", () => contour.zoom(1 / 1.5));
  $("fit").addEventListener("click", () => contour.fit());
  $("actual").addEventListener("change", (e) => contour.actual((e.target as HTMLInputElement).checked));
  for (const [id, plot] of [["upper", plots[0]], ["lower", plots[1]]] as const) {
    $(id).addEventListener("change", (e) => plot?.choose((e.target as HTMLSelectElement).value as Quantity));
  }
  window.addEventListener("hashchange", async () => {
    const state = await fromLink(location.hash.slice(1));
    if (state) {
      load(state);
    }
  });
  load(first);
  if (location.hash.length > 1 && !linked) {
    remark = "The link contains no program of this page.";
    notice(remark);
  }
}

void main();
