// ---- curves over time and over frequency
const plots = [];
const baseName = name => name.replace(/ (set|actual|load)$/, "");
for (const { kind, open, note, view: shown } of CHART.views) {
  const lines = shown.lines.map(l => {
    const of = l.points.curve || l.points.spring || l.points.given, r = runs[of.run];
    return { r, c: l.points.curve && r.curves[of.curve], pass: of.pass === undefined ? null : of.pass, axis: l.points.spring && of.axis, points: of.points, name: l.name, ...l.style };
  });
  const overTime = kind !== "spectrum", title = shown.title;
  const card = make("div", undefined, "card"), bar = make("div", undefined, "bar"), canvas = make("canvas");
  const head = make("button", title, open ? "on" : "");
  head.setAttribute("aria-expanded", open);
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  bar.append(head);
  lines.forEach(l => key(bar, l.name, l.colour, l, l.dash, l.width));
  card.append(bar, canvas);
  byId("plots").append(card);
  if (note) card.append(make("div", note, "note"));
  const plot = { lines, canvas, open, kind, title, shown, overTime, x: overTime ? null : [...shown.x.range], head, card };
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
const plotBox = canvas => [68, 8, canvas.clientWidth - 76, canvas.clientHeight - 42];
const rangeOf = plot => plot.overTime ? view.time : plot.x;
function setRange(plot, x) { if (plot.overTime) view.time = x; else plot.x = x; }
function placeOf(plot, px) {
  const [x0, , w] = plotBox(plot.canvas), [from, to] = rangeOf(plot);
  return from + (px - x0) / w * (to - from);
}
// the window of an exact stop as a band from t1 on, and t1, t2 (inside the window), t3 (time limit)
function drawStops(c, { lines, kind }, X, Y, y0, h) {
  c.font = "10px sans-serif"; c.textBaseline = "top"; c.textAlign = "left"; c.lineWidth = 1;
  const found = lines.flatMap(l => l.r.stops
    .filter(([axis]) => !view.hidden.has(l) && l.c.name === axis + (kind === "lag" ? "" : " actual"))
    .map(stop => [l, stop]));
  // the times have room beside each other once a few stops are left in the view
  const [from, to] = view.time, seen = found.filter(([l, stop]) => seconds(l.r, stop[3]) >= from && seconds(l.r, stop[3]) <= to);
  const named = seen.length * 3 * 34 < X(to) - X(from);
  for (const [l, [axis, target, range, ...at]] of found) {
    const [t1, t2, t3] = at.map(k => k === null ? null : X(seconds(l.r, k)));
    const middle = kind === "lag" ? 0 : target, high = Y(middle + range), last = Math.max(t1 + 1, t2 || 0, t3 || 0);
    c.fillStyle = paint(l.colour); c.globalAlpha = 0.15;
    c.fillRect(t1, high, last - t1, Y(middle - range) - high);
    c.globalAlpha = 1;
    if (!named) continue;
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
// the number of the program's line where there is room
function drawLines(c, r, X, y0, h, last) {
  let i = Math.max(0, bucketAt(r, view.time[0])), n = 0;
  const starts = [], end = bucketAt(r, view.time[1]);
  for (; i <= end; i++) if (!starts.length || r.line[i] !== starts[starts.length - 1][1]) starts.push([X(seconds(r, r.k[i])), r.line[i]]);
  if (starts.length > CHART.most_stretches) return;
  c.textAlign = "center"; c.textBaseline = "top"; c.font = "10px sans-serif";
  for (const [x, line] of starts) {
    const to = n + 1 < starts.length ? starts[n + 1][0] : last, text = String(line);
    c.fillStyle = paint("var(--shade)");
    if (n % 2 === 0) c.fillRect(x, y0, to - x, h);
    c.fillStyle = paint("var(--faint)");
    if (line > 0 && to - x > 7 * text.length + 4) c.fillText(text, (x + to) / 2, y0 + 2);
    n++;
  }
}
// a line between two ends of the range: what it holds of least and greatest values, and its points
function* pointsOf(line, [from, to]) {
  if (line.points || line.swing) {
    for (const [x, y] of line.points || line.swing) yield [x, y, y];
    return;
  }
  const { r, c, pass } = line, last = Math.min(r.k.length - 1, bucketAt(r, to) + 1);
  // null: a gap, also where nothing is measured
  const at = (i, k) => pass !== null && r.passed[i] !== pass || c.low[i] === null ? null : [seconds(r, k), c.low[i], (c.high || c.low)[i]];
  for (let i = Math.max(0, bucketAt(r, from)); i <= last; i++) yield at(i, r.k[i]);
  // to the last cycle of the run
  if (last === r.k.length - 1 && r.last > r.k[last]) yield at(last, r.last);
}
const inside = (points, [from, to]) => points && points.filter(([x], i) => (i + 1 >= points.length || points[i + 1][0] >= from) && (i === 0 || points[i - 1][0] <= to));
// the axis at the right end of its curve: a second cue beside the colour
function drawNames(c, shown, Y, x) {
  const ends = shown.filter(l => l.last && !/ (actual|load)$/.test(l.name)).map(l => ({ name: baseName(l.name), colour: l.colour, y: Y(l.last[1]) }));
  let last = Infinity;
  c.textAlign = "right"; c.textBaseline = "bottom"; c.font = "bold 10px sans-serif";
  for (const e of ends.sort((a, b) => b.y - a.y)) {
    last = Math.min(e.y, last - 11);
    c.fillStyle = paint(e.colour);
    c.fillText(e.name, x, last);
  }
}
function drawPlot(plot) {
  const { lines, canvas, open, kind, shown: what } = plot;
  if (!open) return;
  const [c] = fitted(canvas), box = plotBox(canvas), [x0, y0, w, h] = box, range = rangeOf(plot), [t0, t1] = range;
  const shown = lines.filter(l => !view.hidden.has(l));
  let low = 0, high = 0;
  for (const line of shown) {
    if (line.axis !== undefined) line.swing = inside(swing(line), range);
    for (const p of pointsOf(line, range)) if (p) {
      low = Math.min(low, p[1]);
      high = Math.max(high, p[2]);
      line.last = p;
    }
  }
  const air = Math.max((high - low) * 0.1, 1e-6), y = [low < 0 ? low - air : low, high + air];
  const X = t => x0 + (t - t0) / (t1 - t0) * w, Y = v => y0 + h - (v - y[0]) / (y[1] - y[0]) * h;
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  if (one && (kind === "speed" || kind === "dev" || kind === "error")) drawLines(c, runs[0], X, y0, h, x0 + w);
  c.restore();
  grid(c, box, range, y, what.x.label, what.y.label);
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  if (plot.overTime) drawChosen(c, X, y0, h);
  for (const line of shown) {
    c.strokeStyle = paint(line.colour); c.lineWidth = line.width; c.setLineDash(line.dash); c.lineJoin = "round";
    c.beginPath();
    // least and greatest value of a pixel
    let down = false, pixel = null, least = 0, most = 0;
    const put = () => {
      if (pixel === null) return;
      if (down) c.lineTo(pixel[1], Y(least)); else c.moveTo(pixel[1], Y(least));
      if (most !== least) c.lineTo(pixel[1], Y(most));
      down = true;
    };
    for (const p of pointsOf(line, range)) {
      if (!p) { put(); down = false; pixel = null; continue; }
      const x = X(p[0]), at = Math.floor(2 * x);
      if (pixel !== null && pixel[0] === at) {
        least = Math.min(least, p[1]);
        most = Math.max(most, p[2]);
      } else {
        put();
        pixel = [at, x];
        [least, most] = [p[1], p[2]];
      }
    }
    put();
    c.stroke();
  }
  what.marks.forEach((m, i) => {
    c.strokeStyle = c.fillStyle = paint("var(--faint)"); c.lineWidth = 1.2; c.setLineDash([5, 4]);
    c.beginPath(); c.moveTo(X(m.at), y0); c.lineTo(X(m.at), y0 + h); c.stroke();
    c.textAlign = "left"; c.textBaseline = "top"; c.font = "11px sans-serif";
    c.fillText(m.name, X(m.at) + 4, y0 + 3 + 13 * (i % 4));
  });
  c.setLineDash([]);
  if (one && kind !== "speed" && kind !== "error") drawNames(c, shown, Y, x0 + w - 3);
  // many stops at once would hide the curves
  if ((kind === "lag" || kind === "pos") && (t1 - t0) < 3) drawStops(c, plot, X, Y, y0, h);
  if (plot.overTime && view.at !== null) {
    c.strokeStyle = paint("var(--ink)"); c.lineWidth = 1;
    c.beginPath(); c.moveTo(X(view.at), y0); c.lineTo(X(view.at), y0 + h); c.stroke();
  }
  c.restore();
}
