"use strict";
// ---- data, colours, scales
const runs = JSON.parse(document.getElementById("data").textContent);
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
const end = Math.max(1e-6, ...runs.map(r => seconds(r, r.k[r.k.length - 1] || 0)));
const begin = Math.min(...runs.map(r => seconds(r, r.k[0] || 0)));

// what is looked at: contour window (whole: all of it, whatever the size of the canvas), turn of the view in space, stretch of time, the moment under the pointer, the line chosen
const ISOMETRIC = [Math.PI / 4, Math.atan(Math.SQRT1_2)];
const view = {
  plane: 0, middle: [0, 0], scale: 1, turn: [...ISOMETRIC], paint: "run", time: [begin, end], whole: true, at: null, line: null, hidden: new Set(),
};
const PLANES = [[0, 1], [0, 2], [1, 2]], SPACE = PLANES.length;

// colours are variables of the style sheet; a canvas needs their values
const colour = i => `var(--c${i % 8})`;
const values = new Map();
function paint(css) {
  const name = /^var\((.*)\)$/.exec(css);
  if (!name) return css;
  if (!values.has(name[1])) values.set(name[1], getComputedStyle(document.documentElement).getPropertyValue(name[1]).trim());
  return values.get(name[1]);
}
const DASHES = [[], [7, 3], [2, 2], [8, 2, 2, 2], [12, 3], [4, 4], [1, 3], [10, 2, 4, 2]];
const groups = [];
runs.forEach((r, i) => {
  if (one && r.passes > 1) for (let p = 0; p < r.passes; p++) groups.push({ r, pass: p, name: "pass " + (p + 1) });
  else groups.push({ r, pass: null, name: one ? "set" : r.summary.program });
});
groups.forEach((g, i) => { g.colour = colour(i); g.dash = DASHES[i % DASHES.length]; });

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
for (const r of runs) {
  // set and actual position of the axes of the contour, by bucket
  for (const [name, what] of [["setCurves", "set"], ["actCurves", "actual"]]) r[name] = r.plane.map(axis => r.curves.find(c => c.name === `${axis} ${what}`));
  r.bucketOf = r.pk.map(k => upTo(r.k, k));
  r.speed = r.curves.find(c => c.kind === "speed");
}
const isChosen = (r, file, line) => view.line !== null && line === view.line.line && r.files[file] === view.line.file;

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
// grid with numbers, and what they count at the ends of both axes
function grid(c, box, x, y, xName, yName) {
  const [x0, y0, w, h] = box;
  const [xs, xd] = ticks(x[0], x[1], w / 90), [ys, yd] = ticks(y[0], y[1], h / 28);
  c.strokeStyle = paint("var(--grid)"); c.fillStyle = paint("var(--faint)"); c.lineWidth = 1;
  c.textAlign = "center"; c.textBaseline = "top";
  for (const v of xs) {
    const at = x0 + (v - x[0]) / (x[1] - x[0]) * w;
    c.beginPath(); c.moveTo(at, y0); c.lineTo(at, y0 + h); c.stroke();
    if (at < x0 + w - 34) c.fillText(v.toFixed(Math.min(xd, 9)), at, y0 + h + 4);
  }
  c.textAlign = "right";
  c.fillText(xName, x0 + w, y0 + h + 4);
  c.textBaseline = "middle";
  for (const v of ys) {
    const at = y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
    c.beginPath(); c.moveTo(x0, at); c.lineTo(x0 + w, at); c.stroke();
    if (at > y0 + 16) c.fillText(v.toFixed(Math.min(yd, 9)), x0 - 5, at);
  }
  c.textBaseline = "top";
  c.fillText(yName, x0 - 5, y0);
  c.strokeStyle = paint("var(--frame)"); c.strokeRect(x0, y0, w, h);
}
