// ---- pointer, fingers and keys: what is under them, zoom, move
const zoomContour = (factor, px, py) => {
  const at = toData(px, py);
  view.scale = Math.min(1e9, Math.max(1e-4, view.scale * factor));
  const now = toData(px, py);
  view.middle = view.middle.map((m, i) => m + at[i] - now[i]);
  view.whole = false;
};
const moveContour = (dx, dy) => { view.whole = false; view.middle = [view.middle[0] - dx / view.scale, view.middle[1] + dy / view.scale]; };
const turnContour = (dx, dy) => {
  view.turn = [view.turn[0] + dx * 0.008, Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.turn[1] + dy * 0.008))];
};
const zoomTime = (factor, at) => { view.time = view.time.map(t => at + (t - at) / factor); };
function moveTime(canvas, px) {
  const [, , w] = plotBox(canvas), by = px / w * (view.time[1] - view.time[0]);
  view.time = view.time.map(t => t - by);
}
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
      if (before.width > 0) zoom(after.width / before.width, after.x, after.y);
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
pointer(contour, {
  at: momentAt, zoom: zoomContour, all: showAll,
  move: (dx, dy, aside) => (view.plane === SPACE && !aside ? turnContour : moveContour)(dx, dy),
});
for (const { canvas } of plots) pointer(canvas, {
  at: px => timeOf(canvas, px), zoom: (factor, px) => zoomTime(factor, timeOf(canvas, px)), move: dx => moveTime(canvas, dx),
  all: () => { view.time = [begin, end]; },
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
  const isContour = e.currentTarget === contour, pan = PAN[e.key], grow = { "+": 1.25, "=": 1.25, "-": 0.8 }[e.key];
  const middle = [contour.clientWidth / 2, contour.clientHeight / 2];
  if (pan && isContour) (view.plane === SPACE && !e.shiftKey ? turnContour : moveContour)(...pan);
  else if (pan && pan[0]) step(-Math.sign(pan[0]), e.shiftKey);
  else if (grow && isContour) zoomContour(grow, ...middle);
  else if (grow) zoomTime(grow, view.at === null ? (view.time[0] + view.time[1]) / 2 : view.at);
  else if (e.key === "Home") { if (isContour) showAll(); else view.time = [begin, end]; }
  else if (e.key === "Escape") { view.at = null; if (view.line) choose(view.line.file, view.line.line); }
  else return;
  e.preventDefault();
  const box = e.currentTarget.getBoundingClientRect();
  tip(box.left + 8, box.bottom);
  draw();
}
for (const canvas of [contour, ...plots.map(p => p.canvas)]) {
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
  const right = x + 18 + box.offsetWidth > window.innerWidth;
  box.style.left = Math.max(6, right ? x - 14 - box.offsetWidth : x + 18) + "px";
  box.style.top = Math.max(6, Math.min(y + 12, window.innerHeight - box.offsetHeight - 6)) + "px";
}
