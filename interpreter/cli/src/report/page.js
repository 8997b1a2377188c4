"use strict";
const runs = JSON.parse(document.getElementById("data").textContent);
const COLOURS = ["#1c6dd0", "#d9480f", "#2b8a3e", "#9c36b5", "#0c8599", "#b08900", "#e64980", "#495057"];
const KINDS = [
  ["speed", "Path speed", true], ["error", "Contour error", false], ["dev", "Deviation from the contour", true],
  ["lag", "Lag", true], ["pos", "Position", false], ["vel", "Axis velocity", false], ["acc", "Axis acceleration", false],
];
const colour = i => COLOURS[i % COLOURS.length];
const one = runs.length === 1;
// deviations below this are rounding
const VISIBLE = 1e-7;
const byId = id => document.getElementById(id);
const make = (tag, text, cls) => {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (cls) e.className = cls;
  return e;
};
const seconds = (r, k) => k * r.summary.cycle_us / 1e6;

// what is looked at: contour window, stretch of time, the moment under the pointer
const view = { plane: 0, middle: [0, 0], scale: 1, time: [0, 1], at: null, hidden: new Set() };
const PLANES = [[0, 1], [0, 2], [1, 2]];
const groups = [];
runs.forEach((r, i) => {
  if (one && r.passes > 1) for (let p = 0; p < r.passes; p++) groups.push({ r, pass: p, name: "pass " + (p + 1) });
  else groups.push({ r, pass: null, name: one ? "set" : r.summary.program });
});
groups.forEach((g, i) => { g.colour = colour(i); });

function fitted(canvas) {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  const c = canvas.getContext("2d");
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, w, h);
  c.font = "11px sans-serif";
  return [c, w, h];
}

// at least two marks, or nobody can read a scale from them
function ticks(low, high, wanted) {
  const [found, decimals] = marks(low, high, wanted);
  return found.length > 1 || wanted > 16 ? [found, decimals] : ticks(low, high, 2 * wanted);
}
function marks(low, high, wanted) {
  const rough = (high - low) / Math.max(wanted, 2);
  if (!(rough > 0) || !isFinite(rough)) return [[], 0];
  const power = Math.floor(Math.log10(rough)), magnitude = 10 ** power;
  const factor = [1, 2, 5, 10].find(f => f * magnitude >= rough * 0.999999);
  const step = factor * magnitude, found = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step && found.length < 100; n++) found.push(n * step);
  return [found, Math.max(0, -(factor === 10 ? power + 1 : power))];
}

function grid(c, box, x, y, xText) {
  const [x0, y0, w, h] = box;
  const [xs, xd] = ticks(x[0], x[1], w / 90), [ys, yd] = ticks(y[0], y[1], h / 28);
  c.strokeStyle = "#e9ecef"; c.fillStyle = "#868e96"; c.lineWidth = 1;
  c.textAlign = "center"; c.textBaseline = "top";
  for (const v of xs) {
    const at = x0 + (v - x[0]) / (x[1] - x[0]) * w;
    c.beginPath(); c.moveTo(at, y0); c.lineTo(at, y0 + h); c.stroke();
    if (xText) c.fillText(v.toFixed(Math.min(xd, 9)), at, y0 + h + 4);
  }
  c.textAlign = "right"; c.textBaseline = "middle";
  for (const v of ys) {
    const at = y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
    c.beginPath(); c.moveTo(x0, at); c.lineTo(x0 + w, at); c.stroke();
    c.fillText(v.toFixed(Math.min(yd, 9)), x0 - 5, at);
  }
  c.strokeStyle = "#ced4da"; c.strokeRect(x0, y0, w, h);
}

// ---- contour
const contour = byId("contour");
const MARGIN = [56, 8, 10, 22];
function contourBox() {
  return [MARGIN[0], MARGIN[1], contour.clientWidth - MARGIN[0] - MARGIN[2], contour.clientHeight - MARGIN[1] - MARGIN[3]];
}
function toScreen(x, y) {
  const [x0, y0, w, h] = contourBox();
  return [x0 + w / 2 + (x - view.middle[0]) * view.scale, y0 + h / 2 - (y - view.middle[1]) * view.scale];
}
function toData(px, py) {
  const [x0, y0, w, h] = contourBox();
  return [view.middle[0] + (px - x0 - w / 2) / view.scale, view.middle[1] - (py - y0 - h / 2) / view.scale];
}
function axesOf(r) { return PLANES[view.plane].map(i => Math.min(i, r.plane.length - 1)); }
function showAll() {
  let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const r of runs) axesOf(r).forEach((a, i) => {
    for (const name of ["ipo", "set"]) for (const v of r[name][a] || []) {
      if (v < low[i]) low[i] = v;
      if (v > high[i]) high[i] = v;
    }
  });
  const [, , w, h] = contourBox();
  view.middle = low.map((l, i) => isFinite(l) ? (l + high[i]) / 2 : 0);
  const span = low.map((l, i) => Math.max(high[i] - l, 1e-3));
  view.scale = 0.9 * Math.min(w / span[0], h / span[1]);
  if (!isFinite(view.scale) || view.scale <= 0) view.scale = 1;
}
function trail(c, xs, ys, use) {
  c.beginPath();
  let down = false;
  for (let i = 0; i < xs.length; i++) {
    if (use && !use(i)) { down = false; continue; }
    const [x, y] = toScreen(xs[i], ys[i]);
    if (down) c.lineTo(x, y); else c.moveTo(x, y);
    down = true;
  }
  c.stroke();
}
function drawContour() {
  const [c] = fitted(contour), box = contourBox(), [x0, y0, w, h] = box;
  const low = toData(x0, y0 + h), high = toData(x0 + w, y0);
  grid(c, box, [low[0], high[0]], [low[1], high[1]], true);
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  c.lineJoin = "round";
  if (!view.hidden.has("programmed")) for (const r of runs) {
    const p = r.programmed[Math.min(view.plane, r.programmed.length - 1)];
    if (!p) continue;
    c.strokeStyle = "#ced4da"; c.lineWidth = 5;
    trail(c, p[0], p[1]);
  }
  for (const [name, width, dash] of [["act", 1, [4, 3]], ["set", 1.7, []]]) {
    if (view.hidden.has(name)) continue;
    c.setLineDash(dash); c.lineWidth = width;
    for (const g of groups) {
      if (view.hidden.has(g)) continue;
      const [a, b] = axesOf(g.r);
      if (!g.r[name][b]) continue;
      c.strokeStyle = g.colour;
      trail(c, g.r[name][a], g.r[name][b], g.pass === null ? null : i => g.r.pass[i] === g.pass);
    }
  }
  c.setLineDash([]);
  if (view.at !== null) for (const g of groups) {
    if (view.hidden.has(g)) continue;
    const p = pointAt(g.r, view.at), i = bucketAt(g.r, view.at), [a, b] = axesOf(g.r);
    if (p < 0 || i < 0 || (g.pass !== null && g.r.pass[p] !== g.pass)) continue;
    for (const [name, curves, fill] of [["act", g.r.actCurves, "#fff"], ["set", g.r.setCurves, g.colour]]) {
      if (!curves[a] || !curves[b] || view.hidden.has(name)) continue;
      const [x, y] = toScreen(valueOf(curves[a], i), valueOf(curves[b], i));
      c.beginPath(); c.arc(x, y, 4, 0, 7); c.fillStyle = fill; c.fill();
      c.strokeStyle = g.colour; c.lineWidth = 1.5; c.stroke();
    }
  }
  c.restore();
}

// index of the last entry of an ascending list that is not beyond k
function upTo(list, k) {
  let low = 0, high = list.length;
  while (low < high) {
    const mid = (low + high) >> 1;
    if (list[mid] <= k) low = mid + 1; else high = mid;
  }
  return low - 1;
}
const cycleAt = (r, t) => t * 1e6 / r.summary.cycle_us + 1e-6;
const pointAt = (r, t) => upTo(r.pk, cycleAt(r, t));
const bucketAt = (r, t) => upTo(r.k, cycleAt(r, t));

// the value of a curve in a bucket; of several cycles their middle
const valueOf = (c, i) => c.high ? (c.low[i] + c.high[i]) / 2 : c.low[i];
// set and actual position of the axes of the contour, by bucket
for (const r of runs) for (const [name, what] of [["setCurves", "set"], ["actCurves", "actual"]]) {
  r[name] = r.plane.map(axis => r.curves.find(c => c.name === `${axis} ${what}`));
}

// ---- curves over time
const plots = [];
const baseName = name => name.replace(/ (set|actual|load)$/, "");
const axisNames = [...new Set(runs.flatMap(r => r.curves.filter(c => c.kind !== "speed" && c.kind !== "error").map(c => baseName(c.name))))];
// one run: an axis has a colour, what is actual is dashed; several: a run has a colour, an axis its dashes, what is actual is thin
const AXIS_DASHES = [[], [7, 3], [2, 2], [8, 2, 2, 2], [12, 3], [4, 4], [1, 3], [10, 2, 4, 2]];
function styleOf(c, i) {
  const axis = axisNames.indexOf(baseName(c.name)), actual = c.name.endsWith(" actual"), load = c.name.endsWith(" load");
  if (!one) return { colour: colour(i), dash: axis < 0 ? [] : AXIS_DASHES[axis % AXIS_DASHES.length], width: actual ? 0.8 : load ? 0.5 : 1.8 };
  return { colour: axis < 0 ? COLOURS[0] : colour(1 + axis), dash: actual ? [5, 3] : load ? [2, 2] : [], width: 1.4 };
}
const flat = ({ low, high }) => [...low, ...(high || [])].every(v => Math.abs(v) < VISIBLE);
for (const [kind, title, wanted] of KINDS) {
  const lines = runs.flatMap((r, i) => r.curves.filter(c => c.kind === kind).map(c => ({
    r, c, name: (one ? "" : r.summary.program + " ") + c.name, ...styleOf(c, i),
  })));
  if (!lines.length) continue;
  const open = wanted && !(kind === "dev" && lines.every(l => flat(l.c)));
  const card = make("div", undefined, "card"), bar = make("div", undefined, "bar"), canvas = make("canvas");
  const head = make("button", title, open ? "on" : "");
  bar.append(head, make("span", `${lines[0].c.unit} over s`, "hint"));
  lines.forEach(l => key(bar, l.name, l.colour, l, l.dash, l.width));
  bar.append(bar.querySelector(".hint"));
  card.append(bar, canvas);
  byId("plots").append(card);
  const plot = { lines, canvas, open, kind };
  canvas.hidden = !open;
  canvas.style.display = open ? "" : "none";
  head.onclick = () => {
    plot.open = !plot.open;
    canvas.style.display = plot.open ? "" : "none";
    head.className = plot.open ? "on" : "";
    draw();
  };
  plots.push(plot);
  pointer(canvas, px => timeOf(canvas, px), px => moveTime(canvas, px));
}
function plotBox(canvas) { return [64, 8, canvas.clientWidth - 72, canvas.clientHeight - 28]; }
function timeOf(canvas, px) {
  const [x0, , w] = plotBox(canvas);
  return view.time[0] + (px - x0) / w * (view.time[1] - view.time[0]);
}
// the window of an exact stop as a band from t1 on, and t1, t2 (inside the window), t3 (time limit)
function drawStops(c, { lines, kind }, X, Y, y0, h) {
  c.font = "10px sans-serif"; c.textBaseline = "top"; c.textAlign = "left"; c.lineWidth = 1;
  for (const l of lines) for (const [axis, target, range, ...at] of l.r.stops) {
    if (view.hidden.has(l) || (kind === "lag" ? l.c.name !== axis : l.c.name !== axis + " actual")) continue;
    const [t1, t2, t3] = at.map(k => k === null ? null : X(seconds(l.r, k)));
    const middle = kind === "lag" ? 0 : target, high = Y(middle + range), last = Math.max(t1 + 1, t2 || 0, t3 || 0);
    c.fillStyle = l.colour + "22";
    c.fillRect(t1, high, last - t1, Y(middle - range) - high);
    c.strokeStyle = c.fillStyle = l.colour; c.setLineDash([3, 3]);
    [["t1", t1], ["t2", t2], ["t3", t3]].forEach(([name, x]) => {
      if (x === null) return;
      c.beginPath(); c.moveTo(x, y0); c.lineTo(x, y0 + h); c.stroke();
      c.fillText(`${axis} ${name}`, x + 2, y0 + 2);
    });
  }
  c.setLineDash([]);
}
function drawPlot(plot) {
  const { lines, canvas, open, kind } = plot;
  if (!open) return;
  const [c] = fitted(canvas), box = plotBox(canvas), [x0, y0, w, h] = box, [t0, t1] = view.time;
  const shown = lines.filter(l => !view.hidden.has(l));
  let low = 0, high = 0;
  const windows = shown.map(({ r, c: curve }) => {
    const from = Math.max(0, bucketAt(r, t0)), to = Math.min(r.k.length - 1, bucketAt(r, t1) + 1);
    for (let i = from; i <= to; i++) {
      low = Math.min(low, curve.low[i]);
      high = Math.max(high, (curve.high || curve.low)[i]);
    }
    return [from, to];
  });
  const air = Math.max((high - low) * 0.06, 1e-6), y = [low < 0 ? low - air : low, high + air];
  grid(c, box, view.time, y, true);
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  const X = t => x0 + (t - t0) / (t1 - t0) * w, Y = v => y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
  shown.forEach(({ r, c: curve, colour, dash, width }, n) => {
    c.strokeStyle = colour; c.lineWidth = width; c.setLineDash(dash); c.lineJoin = "round";
    c.beginPath();
    const [from, to] = windows[n];
    for (let i = from; i <= to; i++) {
      const x = X(seconds(r, r.k[i]));
      if (i === from) c.moveTo(x, Y(curve.low[i])); else c.lineTo(x, Y(curve.low[i]));
      if (curve.high && curve.high[i] !== curve.low[i]) c.lineTo(x, Y(curve.high[i]));
    }
    c.stroke();
  });
  c.setLineDash([]);
  // many stops at once would hide the curves
  if ((kind === "lag" || kind === "pos") && (t1 - t0) < 3) drawStops(c, plot, X, Y, y0, h);
  if (view.at !== null) {
    c.strokeStyle = "#495057"; c.lineWidth = 1;
    c.beginPath(); c.moveTo(X(view.at), y0); c.lineTo(X(view.at), y0 + h); c.stroke();
  }
  c.restore();
}
function moveTime(canvas, px) {
  const [, , w] = plotBox(canvas), by = px / w * (view.time[1] - view.time[0]);
  view.time = view.time.map(t => t - by);
}
const end = Math.max(1e-6, ...runs.map(r => r.summary.duration_s));

// ---- pointer: hover, zoom, move
function pointer(canvas, timeAt, move) {
  let last = null;
  canvas.addEventListener("pointerdown", e => { last = [e.offsetX, e.offsetY]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointerup", () => { last = null; });
  canvas.addEventListener("pointermove", e => {
    if (last) {
      move(e.offsetX - last[0], e.offsetY - last[1]);
      last = [e.offsetX, e.offsetY];
    }
    view.at = timeAt(e.offsetX, e.offsetY);
    tip(e);
    draw();
  });
  canvas.addEventListener("pointerleave", () => { view.at = null; byId("tip").hidden = true; draw(); });
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    const factor = Math.exp(-e.deltaY * 0.0015);
    if (canvas === contour) {
      const at = toData(e.offsetX, e.offsetY);
      view.scale = Math.min(1e9, Math.max(1e-4, view.scale * factor));
      const now = toData(e.offsetX, e.offsetY);
      view.middle = view.middle.map((m, i) => m + at[i] - now[i]);
    } else {
      const at = timeOf(canvas, e.offsetX);
      view.time = view.time.map(t => at + (t - at) / factor);
    }
    draw();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => {
    if (canvas === contour) showAll(); else view.time = [0, end];
    draw();
  });
}
pointer(contour, (px, py) => {
  let best = 900, at = null;
  for (const g of groups) {
    if (view.hidden.has(g)) continue;
    const [a, b] = axesOf(g.r), xs = g.r.set[a], ys = g.r.set[b];
    if (!ys) continue;
    // the nearest place of the lines between the points, which may be far apart
    let before = null;
    for (let i = 0; i < xs.length; i++) {
      if (g.pass !== null && g.r.pass[i] !== g.pass) { before = null; continue; }
      const [x, y] = toScreen(xs[i], ys[i]), k = g.r.pk[i];
      const [x0, y0, k0] = before || [x, y, k], dx = x - x0, dy = y - y0, square = dx * dx + dy * dy;
      const part = square > 0 ? Math.min(1, Math.max(0, ((px - x0) * dx + (py - y0) * dy) / square)) : 1;
      const d = (x0 + part * dx - px) ** 2 + (y0 + part * dy - py) ** 2;
      if (d < best) { best = d; at = seconds(g.r, Math.round(k0 + part * (k - k0))); }
      before = [x, y, k];
    }
  }
  return at;
}, (dx, dy) => { view.middle = [view.middle[0] - dx / view.scale, view.middle[1] + dy / view.scale]; });

function tip(e) {
  const box = byId("tip");
  if (view.at === null) { box.hidden = true; return; }
  const text = [];
  for (const r of runs) {
    const i = bucketAt(r, view.at);
    if (i < 0) continue;
    const file = r.files.length > 1 ? r.files[r.file[i]] + " " : "";
    if (!one) text.push(r.summary.program);
    text.push(`t = ${seconds(r, r.k[i]).toFixed(6)} s   ${file}line ${r.line[i]}${r.block[i] === null ? "" : "   N" + r.block[i]}   held by ${r.limit[i]}`);
    r.plane.forEach((name, a) => {
      const [set, act] = [r.setCurves[a], r.actCurves[a]].map(c => c ? valueOf(c, i).toFixed(5) : "-");
      text.push(`${name}  set ${set}   act ${act} mm`);
    });
    for (const kind of ["speed", "error", "dev", "lag"]) {
      const all = r.curves.filter(c => c.kind === kind);
      const value = c => (c.high && Math.abs(c.high[i]) > Math.abs(c.low[i]) ? c.high : c.low)[i];
      const words = { speed: "", error: "", dev: "deviation ", lag: "lag " };
      if (all.length) text.push(all.map(c => `${words[kind]}${c.name} ${value(c).toFixed(kind === "speed" ? 3 : 5)} ${c.unit}`).join("   "));
    }
  }
  box.textContent = text.join("\n");
  box.hidden = false;
  const right = e.clientX + 18 + box.offsetWidth > window.innerWidth;
  box.style.left = (right ? e.clientX - 14 - box.offsetWidth : e.clientX + 18) + "px";
  box.style.top = Math.min(e.clientY + 12, window.innerHeight - box.offsetHeight - 6) + "px";
}

// ---- what stands around the plots
function key(parent, name, colour, what, dash = [], width = 2) {
  const k = make("span", undefined, "key");
  const swatch = document.createElementNS("http://www.w3.org/2000/svg", "svg"), line = document.createElementNS(swatch.namespaceURI, "line");
  for (const [to, of] of [[swatch, { width: 28, height: 8 }], [line, { x1: 0, x2: 28, y1: 4, y2: 4, stroke: colour, "stroke-width": width, "stroke-dasharray": dash.join(" ") }]])
    for (const [attribute, value] of Object.entries(of)) to.setAttribute(attribute, value);
  swatch.append(line);
  k.append(swatch, name);
  k.onclick = () => {
    if (view.hidden.delete(what)) k.classList.remove("off");
    else { view.hidden.add(what); k.classList.add("off"); }
    draw();
  };
  parent.append(k);
}
key(byId("legend"), "programmed", "#ced4da", "programmed", [], 5);
groups.forEach(g => key(byId("legend"), g.name, g.colour, g));
if (groups.length > 1) key(byId("legend"), "set", "#343a40", "set");
key(byId("legend"), "actual", "#343a40", "act", [4, 3], 1);
const most = Math.max(...runs.map(r => r.plane.length));
PLANES.forEach((p, i) => {
  if (p[1] >= most || most < 3) return;
  const b = make("button", p.map(a => runs.find(r => r.plane.length > a).plane[a]).join(""), i === 0 ? "on" : "");
  b.onclick = () => {
    view.plane = i;
    for (const other of byId("planes").children) other.className = other === b ? "on" : "";
    showAll();
    draw();
  };
  byId("planes").append(b);
});
byId("facts").textContent = runs.map(({ summary: s }) => {
  const e = s.max_contour_error;
  return `${one ? "" : s.program + ": "}machine ${s.machine} · cycle ${s.cycle_us / 1000} ms · ${s.duration_s.toFixed(3)} s (path / feed ${s.ideal_duration_s.toFixed(3)} s) · ${s.state}`
    + (e && e.mm > VISIBLE ? ` · contour error at most ${e.mm.toFixed(5)} mm at ${e.time_s.toFixed(4)} s, line ${e.line}` : "");
}).join("\n");
byId("facts").style.whiteSpace = "pre-line";
const head = make("tr");
["axis", "|vel| /s", "|acc| /s²", "|jerk| /s³", "|err|", "|dev|", "|lag|", "delay"].forEach(t => head.append(make("th", t)));
byId("axes").append(head);
for (const { summary: s } of runs) for (const a of s.axes) {
  const row = make("tr");
  [`${one ? "" : s.program + " "}${a.name} ${a.unit}`, a.max_vel.toFixed(3), a.max_acc.toFixed(1), a.max_jerk.toFixed(0), a.max_err.toFixed(6),
    a.max_dev.toFixed(6), a.max_lag.toFixed(6), (a.filter_delay_cycles * s.cycle_us / 1000).toFixed(2) + " ms"].forEach(t => row.append(make("td", t)));
  byId("axes").append(row);
}
for (const { summary: s } of runs) for (const m of s.messages.slice(0, 50)) {
  const place = m.source ? `${m.source.file}:${m.source.line}:${m.source.column}: ` : "";
  byId("messages").append(make("div", `${place}${m.severity} ${m.id || m.kontur_id}: ${m.text}`, m.severity));
}

const widest = Math.max(...runs.map(r => r.width)), within = Math.max(...runs.map(r => r.within));
if (within > VISIBLE) byId("legend").append(make("div",
  `Points of the contour are left out where they lie within ${(within * 1000).toPrecision(2)} µm of the lines that are drawn.`, "note"));
if (widest > 1) byId("legend").append(make("div",
  `Over time least and greatest value of ${widest} cycles each; under the pointer their middle.`, "note"));

function draw() { drawContour(); plots.forEach(drawPlot); }
view.time = [0, end];
showAll();
draw();
window.addEventListener("resize", draw);
