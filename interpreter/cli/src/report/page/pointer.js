// ---- pointer, fingers and keys: what is under them, zoom, move
const zoomContour = (f, factor, px, py) => {
  const at = toData(f, px, py);
  f.scale = Math.min(1e9, Math.max(1e-4, f.scale * factor));
  const now = toData(f, px, py);
  f.middle = f.middle.map((m, i) => m + at[i] - now[i]);
  f.whole = false;
};
const moveContour = (f, dx, dy) => { f.whole = false; f.middle = [f.middle[0] - dx / f.scale, f.middle[1] + dy / f.scale]; };
const turnContour = (f, dx, dy) => {
  view.turn = [view.turn[0] + dx * 0.008, Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.turn[1] + dy * 0.008))];
};
const zoomPlot = (plot, factor, at) => setRange(plot, rangeOf(plot).map(t => at + (t - at) / factor));
function movePlot(plot, px) {
  const [, , w] = plotBox(plot.canvas), [from, to] = rangeOf(plot), by = px / w * (to - from);
  setRange(plot, [from - by, to - by]);
}
const wholePlot = plot => setRange(plot, plot.overTime ? [begin, end] : [...plot.shown.x.range]);
function pointer(canvas, { at, zoom, move, all }) {
  const down = new Map();
  const spread = () => {
    const [a, b] = [...down.values()];
    return { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, width: Math.hypot(a[0] - b[0], a[1] - b[1]) };
  };
  canvas.addEventListener("pointerdown", e => { down.set(e.pointerId, [e.offsetX, e.offsetY]); canvas.setPointerCapture(e.pointerId); });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, e => { down.delete(e.pointerId); });
  canvas.addEventListener("pointermove", e => {
    const last = down.get(e.pointerId), here = [e.offsetX, e.offsetY];
    if (last && down.size === 2) {
      const before = spread();
      down.set(e.pointerId, here);
      const after = spread();
      // what lay between the fingers stays there
      if (before.width > 0) zoom(after.width / before.width, before.x, before.y);
      move(after.x - before.x, after.y - before.y, true);
    } else if (last) {
      down.set(e.pointerId, here);
      move(here[0] - last[0], here[1] - last[1], e.shiftKey);
    }
    view.at = at(...here);
    tip(e.clientX, e.clientY);
    draw();
  });
  canvas.addEventListener("pointerleave", () => { view.at = null; byId("tip").hidden = true; draw(); });
  canvas.addEventListener("wheel", e => { e.preventDefault(); zoom(Math.exp(-e.deltaY * 0.0015), e.offsetX, e.offsetY); draw(); }, { passive: false });
  canvas.addEventListener("dblclick", () => { all(); draw(); });
}
for (const f of frames) pointer(f.canvas, {
  at: (px, py) => momentAt(f, px, py), zoom: (factor, px, py) => zoomContour(f, factor, px, py), all: () => showAll(f),
  move: (dx, dy, aside) => (view.plane === SPACE && !aside ? turnContour : moveContour)(f, dx, dy),
});
for (const plot of plots) pointer(plot.canvas, {
  at: px => plot.overTime ? placeOf(plot, px) : null, zoom: (factor, px) => zoomPlot(plot, factor, placeOf(plot, px)), move: dx => movePlot(plot, dx),
  all: () => wholePlot(plot),
});
// one step of the pointer over time is a bucket of the first run; with Shift a hundredth of what is shown
function step(sign, far) {
  const r = runs[0], at = view.at === null ? view.time[0] : view.at;
  const i = Math.max(0, Math.min(r.k.length - 1, bucketAt(r, at) + sign));
  view.at = far ? at + sign * (view.time[1] - view.time[0]) / 100 : seconds(r, r.k[i]);
  const by = view.at < view.time[0] ? view.at - view.time[0] : view.at > view.time[1] ? view.at - view.time[1] : 0;
  view.time = view.time.map(t => t + by);
}
const PAN = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
function keys(e) {
  const f = frames.find(f => f.canvas === e.currentTarget), pan = PAN[e.key], grow = { "+": 1.25, "=": 1.25, "-": 0.8 }[e.key];
  const middle = [e.currentTarget.clientWidth / 2, e.currentTarget.clientHeight / 2], plot = plots.find(p => p.canvas === e.currentTarget);
  if (pan && f) (view.plane === SPACE && !e.shiftKey ? turnContour : moveContour)(f, ...pan);
  else if (pan && pan[0] && !plot.overTime) movePlot(plot, pan[0]);
  else if (pan && pan[0]) step(-Math.sign(pan[0]), e.shiftKey);
  else if (grow && f) zoomContour(f, grow, ...middle);
  else if (grow) zoomPlot(plot, grow, plot.overTime && view.at !== null ? view.at : (rangeOf(plot)[0] + rangeOf(plot)[1]) / 2);
  else if (e.key === "Home") { if (f) showAll(f); else wholePlot(plot); }
  else if (e.key === "Escape") { view.at = null; if (view.line) choose(view.line.file, view.line.line); }
  else return;
  e.preventDefault();
  const box = e.currentTarget.getBoundingClientRect();
  tip(box.left + 8, box.bottom);
  draw();
}
for (const canvas of [...frames.map(f => f.canvas), ...plots.map(p => p.canvas)]) {
  canvas.addEventListener("keydown", keys);
  canvas.addEventListener("blur", () => { byId("tip").hidden = true; });
}

function tip(x, y) {
  const box = byId("tip");
  if (view.at === null) { box.hidden = true; return; }
  const text = [];
  for (const r of runs) {
    const i = bucketAt(r, view.at);
    if (i < 0) continue;
    const file = r.files.length > 1 ? r.files[r.file[i]] + " " : "";
    if (!one) text.push(r.name);
    // a bucket of several cycles has no value of one moment
    const last = (i + 1 < r.k.length ? r.k[i + 1] : r.last + 1) - 1, [from, to] = [r.k[i], last].map(k => seconds(r, k).toFixed(6));
    text.push(`t = ${from} s${last > r.k[i] ? ` to ${to} s, positions at the midpoint` : ""}   ${file}line ${r.line[i]}${r.block[i] === null ? "" : "   N" + r.block[i]}   limited by ${r.limit[i]}`);
    r.plane.forEach((name, a) => {
      if (!name) return;
      const [set, act] = [r.setCurves[a], r.actCurves[a]].map(c => c ? valueOf(c, i).toFixed(5) : "-");
      text.push(`${name}  set ${set}   act ${act} mm`);
    });
    for (const kind of ["speed", "error", "dev", "lag"]) {
      const all = [...new Set(plots.filter(p => p.kind === kind).flatMap(p => p.lines.filter(l => l.r === r).map(l => l.c)))].filter(c => c.low[i] !== null);
      const value = c => (c.high && Math.abs(c.high[i]) > Math.abs(c.low[i]) ? c.high : c.low)[i];
      const words = { speed: "", error: "", dev: "deviation ", lag: "lag " };
      if (all.length) text.push(all.map(c => `${words[kind]}${c.name} ${value(c).toFixed(kind === "speed" ? 3 : 5)} ${c.unit}`).join("   "));
    }
  }
  box.textContent = text.join("\n");
  box.hidden = false;
  const right = x + 18 + box.offsetWidth > window.innerWidth;
  box.style.left = Math.max(6, right ? x - 14 - box.offsetWidth : x + 18) + "px";
  box.style.top = Math.max(6, Math.min(y + 12, window.innerHeight - box.offsetHeight - 6)) + "px";
}
