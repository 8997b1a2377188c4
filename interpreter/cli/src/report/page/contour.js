// ---- contour
const contour = byId("contour"), programmedLine = contourLines("programmed")[0];
const MARGIN = [68, 8, 10, 36];
// two windows on it: all of it, and where its error is largest; whole: back to that whenever the size of the canvas changes
const frames = [contour, byId("close")].map(canvas => ({ canvas, middle: [0, 0], scale: 1, whole: true }));
const [wide, close] = frames;
const contourBox = f => [MARGIN[0], MARGIN[1], f.canvas.clientWidth - MARGIN[0] - MARGIN[2], f.canvas.clientHeight - MARGIN[1] - MARGIN[3]];
// the size of a canvas is asked for once, not for every point
function screenOf(f) {
  const [x0, y0, w, h] = contourBox(f), { middle: [mx, my], scale } = f;
  return (x, y) => [x0 + w / 2 + (x - mx) * scale, y0 + h / 2 - (y - my) * scale];
}
const toScreen = (f, x, y) => screenOf(f)(x, y);
function toData(f, px, py) {
  const [x0, y0, w, h] = contourBox(f);
  return [f.middle[0] + (px - x0 - w / 2) / f.scale, f.middle[1] - (py - y0 - h / 2) / f.scale];
}
// the largest contour error of all runs: how much, and where
const worst = runs.map(r => r.worst).filter(w => w && w[0] > VISIBLE).sort((a, b) => b[0] - a[0])[0] || null;
byId("close-box").hidden = worst === null;
const axesOf = r => PLANES[view.plane].map(i => Math.min(i, r.plane.length - 1));
// a point in space as it is seen: turned about Z, then tipped
function seen(x, y, z) {
  const [s, c] = [Math.sin(view.turn[0]), Math.cos(view.turn[0])], [st, ct] = [Math.sin(view.turn[1]), Math.cos(view.turn[1])];
  return [x * c - y * s, (x * s + y * c) * st + (z || 0) * ct];
}
// the two coordinates of every point in the view
const flatViews = new Map();
function points(r, name) {
  const own = r[name];
  if (view.plane < SPACE) {
    if (name === "programmed") return own[Math.min(view.plane, own.length - 1)];
    const [a, b] = axesOf(r);
    return own[b] ? [own[a], own[b]] : null;
  }
  if (name === "programmed") return points(r, "ipo");
  const key = [runs.indexOf(r), name, ...view.turn].join();
  if (!flatViews.has(key)) {
    if (flatViews.size > 3 * runs.length) flatViews.clear();
    const xs = new Array(own[0].length), ys = new Array(own[0].length);
    for (let i = 0; i < xs.length; i++) [xs[i], ys[i]] = seen(own[0][i], own[1] ? own[1][i] : 0, own[2] ? own[2][i] : 0);
    flatViews.set(key, [xs, ys]);
  }
  return flatViews.get(key);
}
function showAll(f) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const r of runs) for (const name of ["ipo", "set"]) (points(r, name) || []).forEach((list, i) => {
    for (const v of list) {
      if (v < low[i]) low[i] = v;
      if (v > high[i]) high[i] = v;
    }
  });
  const [, , w, h] = contourBox(f), span = low.map((l, i) => Math.max(high[i] - l, 1e-3));
  f.middle = low.map((l, i) => isFinite(l) ? (l + high[i]) / 2 : 0);
  f.scale = 0.9 * Math.min(w / span[0], h / span[1]);
  if (f === close && worst) {
    const at = worst[1];
    f.middle = view.plane === SPACE ? seen(...at) : axesOf({ plane: at }).map(i => at[i]);
    f.scale = Math.min(w, h) / 2 / Math.min(3 * worst[0], 0.2 * Math.max(...span));
  }
  if (!isFinite(f.scale) || f.scale <= 0) f.scale = 1;
  f.whole = true;
}
// what moves less than half a pixel and what lies outside is left out, as in a picture
function trail(f, c, [xs, ys], use) {
  const [x0, y0, w, h] = contourBox(f), [x1, y1] = [x0 + w, y0 + h], onScreen = screenOf(f);
  let last = null, pen = null;
  c.beginPath();
  for (let i = 0; i < xs.length; i++) {
    if (use && !use(i)) { if (pen) c.lineTo(...last); last = pen = null; continue; }
    const [x, y] = onScreen(xs[i], ys[i]);
    const outside = last && (Math.max(x, last[0]) < x0 || Math.min(x, last[0]) > x1 || Math.max(y, last[1]) < y0 || Math.min(y, last[1]) > y1);
    if (last && !outside) {
      if (!pen) c.moveTo(...last);
      if (!pen || Math.abs(x - pen[0]) > 0.5 || Math.abs(y - pen[1]) > 0.5) { c.lineTo(x, y); pen = [x, y]; }
    } else if (pen) { c.lineTo(...last); pen = null; }
    last = [x, y];
  }
  if (pen) c.lineTo(...last);
  c.stroke();
}
// the set path in the colours of what is asked for: the speed, or what limits it
const RAMP = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"];
const LIMITS = ["feed", "axis", "corner", "curve", "stop", "lookahead", "ax_dev"];
const fastest = Math.max(1e-9, ...runs.filter(r => r.speed).flatMap(r => (r.speed.high || r.speed.low).reduce((m, v) => Math.max(m, v), 0)));
function paintAt(r, i) {
  const bucket = r.bucketOf[i];
  if (bucket < 0) return 0;
  if (view.paint === "limit") return Math.max(0, LIMITS.indexOf(r.limit[bucket]));
  return Math.min(RAMP.length - 1, Math.floor(valueOf(r.speed, bucket) / fastest * RAMP.length));
}
function painted(f, c, g, [xs, ys]) {
  let last = null, from = null;
  const onScreen = screenOf(f);
  for (let i = 0; i < xs.length; i++) {
    if (g.pass !== null && g.r.pass[i] !== g.pass) { if (last !== null) c.stroke(); last = from = null; continue; }
    const [x, y] = onScreen(xs[i], ys[i]), now = paintAt(g.r, i);
    if (now !== last) {
      if (last !== null) c.stroke();
      c.beginPath();
      c.strokeStyle = view.paint === "limit" ? paint(colour(now)) : RAMP[now];
      c.setLineDash(view.paint === "limit" ? CHART.dashes[now] : []);
      c.moveTo(...(from || [x, y]));
      last = now;
    }
    c.lineTo(x, y);
    from = [x, y];
  }
  if (last !== null) c.stroke();
}
// in space there are no scales: three directions and a length
function drawDirections(f, c, [x0, y0, , h], names) {
  const origin = [x0 + 34, y0 + h - 34];
  c.lineWidth = 1.5; c.textAlign = "center"; c.textBaseline = "middle";
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((unit, i) => {
    if (!names[i]) return;
    const [u, v] = seen(...unit);
    c.strokeStyle = c.fillStyle = paint("var(--faint)");
    c.beginPath(); c.moveTo(...origin); c.lineTo(origin[0] + 24 * u, origin[1] - 24 * v); c.stroke();
    c.fillText(names[i], origin[0] + 33 * u, origin[1] - 33 * v);
  });
  const length = (ticks(0, 140 / f.scale, 2)[1] || [1])[0], from = x0 + 84, at = y0 + h - 14;
  c.beginPath(); c.moveTo(from, at - 4); c.lineTo(from, at); c.lineTo(from + length * f.scale, at); c.lineTo(from + length * f.scale, at - 4); c.stroke();
  c.textAlign = "left";
  c.fillText(`${+length.toPrecision(3)} mm`, from + length * f.scale + 6, at - 2);
}
function drawContour(f) {
  if (f === close && worst === null) return;
  const [c] = fitted(f.canvas), box = contourBox(f), [x0, y0, w, h] = box;
  const names = runs.reduce((most, r) => r.plane.length > most.length ? r.plane : most, []);
  if (view.plane < SPACE) {
    const low = toData(f, x0, y0 + h), high = toData(f, x0 + w, y0), [a, b] = PLANES[view.plane];
    grid(c, box, [low[0], high[0]], [low[1], high[1]], ...[a, b].map(i => names[i] ? `${names[i]} in mm` : ""));
  } else {
    c.strokeStyle = paint("var(--frame)"); c.strokeRect(...box);
    drawDirections(f, c, box, names);
  }
  c.save();
  c.beginPath(); c.rect(...box); c.clip();
  c.lineJoin = "round";
  const own = (g, i) => g.pass === null || g.r.pass[i] === g.pass;
  if (!view.hidden.has("programmed")) for (const r of runs) {
    const p = points(r, "programmed");
    c.strokeStyle = paint(programmedLine.style.colour); c.lineWidth = programmedLine.style.width;
    if (p) trail(f, c, p);
  }
  if (view.line) for (const g of groups) {
    const p = points(g.r, "set");
    c.strokeStyle = paint("var(--mark)"); c.lineWidth = 11;
    if (p && !view.hidden.has(g)) trail(f, c, p, i => own(g, i) && isChosen(g.r, g.r.file[g.r.bucketOf[i]], g.r.pline[i]));
  }
  for (const name of ["act", "set"]) {
    if (view.hidden.has(name)) continue;
    for (const g of groups) {
      const p = points(g.r, name);
      if (view.hidden.has(g) || !p) continue;
      c.lineWidth = name === "act" ? CHART.actual.width : g.width;
      if (name === "set" && view.paint !== "run") { c.lineWidth = 2.4; painted(f, c, g, p); continue; }
      c.strokeStyle = paint(g.colour);
      c.setLineDash(name === "act" ? CHART.actual.dash : g.dash);
      trail(f, c, p, g.pass === null ? null : i => own(g, i));
    }
    c.setLineDash([]);
  }
  if (f === wide && worst && close.whole) {
    const [, , cw, ch] = contourBox(close), half = [cw / 2, ch / 2].map(v => v / close.scale * f.scale), [x, y] = toScreen(f, ...close.middle);
    c.strokeStyle = paint("var(--ink)"); c.lineWidth = 1;
    c.strokeRect(x - half[0], y - half[1], 2 * half[0], 2 * half[1]);
  }
  if (view.at !== null) for (const g of groups) {
    if (view.hidden.has(g)) continue;
    const p = pointAt(g.r, view.at), i = bucketAt(g.r, view.at);
    if (p < 0 || i < 0 || !own(g, p)) continue;
    for (const [name, curves, fill] of [["act", g.r.actCurves, paint("var(--card)")], ["set", g.r.setCurves, paint(g.colour)]]) {
      if (view.hidden.has(name)) continue;
      const at = curves.map(curve => curve ? valueOf(curve, i) : 0), [a, b] = view.plane < SPACE ? axesOf(g.r).map(n => at[n]) : seen(...at);
      if (a === undefined || b === undefined) continue;
      c.beginPath(); c.arc(...toScreen(f, a, b), 4, 0, 7); c.fillStyle = fill; c.fill();
      c.strokeStyle = paint(g.colour); c.lineWidth = 1.5; c.stroke();
    }
  }
  c.restore();
}
// the moment at which the set path is nearest to a place of the view
function momentAt(f, px, py) {
  let best = 900, at = null;
  const onScreen = screenOf(f);
  for (const g of groups) {
    const found = points(g.r, "set");
    if (view.hidden.has(g) || !found) continue;
    const [xs, ys] = found;
    // the nearest place of the lines between the points, which may be far apart
    let before = null;
    for (let i = 0; i < xs.length; i++) {
      if (g.pass !== null && g.r.pass[i] !== g.pass) { before = null; continue; }
      const [x, y] = onScreen(xs[i], ys[i]), k = g.r.pk[i];
      const [x0, y0, k0] = before || [x, y, k], dx = x - x0, dy = y - y0, square = dx * dx + dy * dy;
      const part = square > 0 ? Math.min(1, Math.max(0, ((px - x0) * dx + (py - y0) * dy) / square)) : 1;
      const d = (x0 + part * dx - px) ** 2 + (y0 + part * dy - py) ** 2;
      if (d < best) { best = d; at = seconds(g.r, Math.round(k0 + part * (k - k0))); }
      before = [x, y, k];
    }
  }
  return at;
}
