// ---- curves over time
const KINDS = [
  ["speed", "Path speed", true], ["error", "Contour error", false], ["dev", "Deviation from the contour", true],
  ["lag", "Lag", true], ["pos", "Position", false], ["vel", "Axis velocity", false], ["acc", "Axis acceleration", false],
];
const plots = [];
const baseName = name => name.replace(/ (set|actual|load)$/, "");
const axisNames = [...new Set(runs.flatMap(r => r.curves.filter(c => c.kind !== "speed" && c.kind !== "error").map(c => baseName(c.name))))];
// one run: an axis has a colour, what is actual is dashed; several: a run has a colour, an axis its dashes, what is actual is thin
function styleOf(c, i) {
  const axis = axisNames.indexOf(baseName(c.name)), actual = c.name.endsWith(" actual"), load = c.name.endsWith(" load");
  if (!one) return { colour: colour(i), dash: axis < 0 ? [] : DASHES[axis % DASHES.length], width: actual ? 0.8 : load ? 0.5 : 1.8 };
  return { colour: axis < 0 ? colour(0) : colour(1 + axis), dash: actual ? [5, 3] : load ? [2, 2] : [], width: 1.4 };
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
  head.setAttribute("aria-expanded", open);
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  bar.append(head);
  lines.forEach(l => key(bar, l.name, l.colour, l, l.dash, l.width));
  card.append(bar, canvas);
  byId("plots").append(card);
  const plot = { lines, canvas, open, kind, title };
  canvas.style.display = open ? "" : "none";
  head.onclick = () => {
    plot.open = !plot.open;
    canvas.style.display = plot.open ? "" : "none";
    head.className = plot.open ? "on" : "";
    head.setAttribute("aria-expanded", plot.open);
    draw();
  };
  plots.push(plot);
}
const plotBox = canvas => [64, 8, canvas.clientWidth - 72, canvas.clientHeight - 28];
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
    c.fillStyle = paint(l.colour); c.globalAlpha = 0.15;
    c.fillRect(t1, high, last - t1, Y(middle - range) - high);
    c.globalAlpha = 1;
    c.strokeStyle = c.fillStyle; c.setLineDash([3, 3]);
    [["t1", t1], ["t2", t2], ["t3", t3]].forEach(([name, x]) => {
      if (x === null) return;
      c.beginPath(); c.moveTo(x, y0); c.lineTo(x, y0 + h); c.stroke();
      c.fillText(`${axis} ${name}`, x + 2, y0 + 2);
    });
  }
  c.setLineDash([]);
}
// the chosen line as bands
function drawChosen(c, X, y0, h) {
  if (!view.line) return;
  c.fillStyle = paint("var(--mark)");
  for (const r of runs) {
    const first = Math.max(0, bucketAt(r, view.time[0]));
    for (let i = first; i < r.k.length && seconds(r, r.k[i]) <= view.time[1]; i++) {
      if (!isChosen(r, r.file[i], r.line[i])) continue;
      let last = i;
      while (last + 1 < r.k.length && isChosen(r, r.file[last + 1], r.line[last + 1])) last++;
      // a cycle shows the time up to it
      const from = X(seconds(r, r.k[Math.max(0, i - 1)]));
      c.fillRect(from, y0, Math.max(1.5, X(seconds(r, r.k[last])) - from), h);
      i = last;
    }
  }
}
// the axis at the right end of its curve: a second cue beside the colour
function drawNames(c, shown, windows, Y, x) {
  const ends = shown.map(({ c: curve, colour }, n) => ({ name: baseName(curve.name), colour, y: Y(valueOf(curve, windows[n][1])), skip: / (actual|load)$/.test(curve.name) }));
  let last = Infinity;
  c.textAlign = "right"; c.textBaseline = "bottom"; c.font = "bold 10px sans-serif";
  for (const e of ends.filter(e => !e.skip).sort((a, b) => b.y - a.y)) {
    last = Math.min(e.y, last - 11);
    c.fillStyle = paint(e.colour);
    c.fillText(e.name, x, last);
  }
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
  grid(c, box, view.time, y, "s", lines[0].c.unit);
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  const X = t => x0 + (t - t0) / (t1 - t0) * w, Y = v => y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
  drawChosen(c, X, y0, h);
  shown.forEach(({ r, c: curve, colour, dash, width }, n) => {
    c.strokeStyle = paint(colour); c.lineWidth = width; c.setLineDash(dash); c.lineJoin = "round";
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
  if (one && kind !== "speed" && kind !== "error") drawNames(c, shown, windows, Y, x0 + w - 3);
  // many stops at once would hide the curves
  if ((kind === "lag" || kind === "pos") && (t1 - t0) < 3) drawStops(c, plot, X, Y, y0, h);
  if (view.at !== null) {
    c.strokeStyle = paint("var(--ink)"); c.lineWidth = 1;
    c.beginPath(); c.moveTo(X(view.at), y0); c.lineTo(X(view.at), y0 + h); c.stroke();
  }
  c.restore();
}
