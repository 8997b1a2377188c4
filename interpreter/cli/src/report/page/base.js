"use strict";
// ---- data, colours, scales
const { chart: CHART, runs } = JSON.parse(document.getElementById("data").textContent);
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
const end = Math.max(1e-6, ...runs.map(r => seconds(r, r.last)));
const begin = Math.min(...runs.map(r => seconds(r, r.k[0] || 0)));

// what is looked at: plane, turn of the view in space, stretch of time, the moment under the pointer, the line chosen
const ISOMETRIC = [Math.PI / 4, Math.atan(Math.SQRT1_2)];
const view = {
  plane: CHART.plane || 0, turn: [...ISOMETRIC], paint: "run", time: [begin, end], at: null, line: null, hidden: new Set(),
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
// what shares a colour on the contour: a pass of one run, or a run
const contourLines = what => CHART.contour.lines.filter(l => l.points.contour.what === what);
const groups = contourLines("set").map(l => ({ r: runs[l.points.contour.run], pass: l.points.contour.pass, name: l.name, ...l.style }));

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
  r.speed = r.curves.find(c => c.name === "path speed");
}
const isChosen = (r, file, line) => view.line !== null && line === view.line.line && r.files[file] === view.line.file;

function fitted(canvas) {
  // three points on paper for one of the page
  const ratio = document.documentElement.dataset.paper ? 3 : window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
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

// the rule of chart/scale.rs over its steps: about as many round numbers as wanted, at least two
function ticks(low, high, wanted) {
  if (!(high > low) || !isFinite(high - low)) return [];
  for (let n = Math.max(wanted, 2); ; n *= 2) {
    const step = CHART.steps.find(s => s.size >= (high - low) / n * (1 - 1e-6));
    if (!step) return [];
    const found = [];
    for (let i = Math.ceil(low / step.size - 1e-9); i * step.size <= high + 1e-9 * step.size && found.length < 200; i++) found.push([i * step.size, tickText(i * step.size, step.decimals)]);
    if (found.length > 1 || n > 16) return found;
  }
}
function tickText(v, decimals) {
  const text = decimals > 5 ? `${Math.round(v * 10 ** decimals)}e-${decimals}`.replace(/([1-9])(0+)e-(.*)/, (all, digit, zeros, d) => d > zeros.length ? `${digit}e-${d - zeros.length}` : all) : v.toFixed(decimals);
  return /^(-?0e|[-0.]*$)/.test(text) ? "0" : text.replace(/-/g, "\u2212");
}
// grid with numbers, and what they count beside both axes
function grid(c, box, x, y, xName, yName) {
  const [x0, y0, w, h] = box;
  c.strokeStyle = paint("var(--grid)"); c.fillStyle = paint("var(--faint)"); c.lineWidth = 1;
  c.textAlign = "center"; c.textBaseline = "top";
  for (const [v, text] of ticks(x[0], x[1], w / 90)) {
    const at = x0 + (v - x[0]) / (x[1] - x[0]) * w;
    c.beginPath(); c.moveTo(at, y0); c.lineTo(at, y0 + h); c.stroke();
    // the last number stays inside the picture
    c.fillText(text, Math.min(at, x0 + w - c.measureText(text).width / 2 + 6), y0 + h + 4);
  }
  c.fillText(xName, x0 + w / 2, y0 + h + 18);
  c.textAlign = "right"; c.textBaseline = "middle";
  for (const [v, text] of ticks(y[0], y[1], h / 35)) {
    const at = y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
    c.beginPath(); c.moveTo(x0, at); c.lineTo(x0 + w, at); c.stroke();
    c.fillText(text, x0 - 5, at);
  }
  c.save();
  c.translate(11, y0 + h / 2); c.rotate(-Math.PI / 2);
  c.textAlign = "center";
  c.fillText(yName, 0, 0);
  c.restore();
  c.strokeStyle = paint("var(--frame)"); c.strokeRect(x0, y0, w, h);
}
