// ---- what stands around the plots
key(byId("legend"), "programmed", programmedLine.style.colour, "programmed", [], 5);
groups.forEach(g => key(byId("legend"), g.name, g.colour, g, g.dash));
if (groups.length > 1) key(byId("legend"), "set", "var(--ink)", "set");
key(byId("legend"), "actual", CHART.actual.colour, "act", CHART.actual.dash, CHART.actual.width);
const scaleLegend = make("div", undefined, "note");
byId("legend").append(scaleLegend);
// one of several: buttons of which one is on
function choice(parent, names, chosen, pick) {
  const buttons = names.map(([what, name]) => {
    const b = make("button", name, what === chosen ? "on" : "");
    b.setAttribute("aria-pressed", what === chosen);
    b.onclick = () => {
      for (const other of buttons) {
        other.className = other === b ? "on" : "";
        other.setAttribute("aria-pressed", other === b);
      }
      pick(what);
      draw();
    };
    parent.append(b);
    return b;
  });
}
const most = Math.max(...runs.map(r => r.plane.length));
const HOW = "zoom with the wheel or by pinching, pan by dragging, double-click to show all; arrow keys, + and - also work";
byId("how").textContent = HOW;
if (most === 3) {
  const plane = (p, i) => [i, p.map(a => runs.find(r => r.plane.length > a).plane[a]).join("")];
  choice(byId("planes"), [...PLANES.map(plane), [SPACE, "3D"]], view.plane, i => {
    view.plane = i;
    view.turn = [...ISOMETRIC];
    byId("how").textContent = i === SPACE ? "drag to rotate, with Shift or two fingers to pan" : HOW;
    frames.forEach(showAll);
  });
}
choice(byId("paints"), [["run", groups.length > 1 && one ? "by pass" : "by run"], ["speed", "by speed"], ["limit", "by limit"]], "run", what => {
  view.paint = what;
  scaleLegend.replaceChildren();
  if (what === "speed") {
    const ramp = make("span", undefined, "ramp");
    ramp.style.background = `linear-gradient(90deg, ${RAMP.join(",")})`;
    scaleLegend.append("0", ramp, `${fastest.toFixed(1)} mm/s reached`);
  } else if (what === "limit") {
    const used = new Set(runs.flatMap(r => r.limit));
    LIMITS.forEach((name, i) => {
      if (!used.has(name)) return;
      const k = make("span", undefined, "key");
      k.append(swatchOf(colour(i), CHART.dashes[i], 2.4), name);
      scaleLegend.append(k);
    });
  }
});
byId("facts").textContent = runs.map(({ name, summary: s, window: w }) => {
  const e = s.max_contour_error;
  return `${one ? "" : name + ": "}machine ${s.machine} · cycle ${s.cycle_us / 1000} ms · ${s.duration_s.toFixed(3)} s (path / feed ${s.ideal_duration_s.toFixed(3)} s) · ${s.state}`
    + (e && e.mm > VISIBLE ? ` · contour error at most ${e.mm.toFixed(5)} mm at ${e.time_s.toFixed(4)} s, line ${e.line}` : "")
    + (w ? ` · drawn: ${w[0]} to ${w[1]} s` : "");
}).join("\n");
const head = make("tr");
["axis", "|vel| /s", "|acc| /s²", "|jerk| /s³", "|err|", "|dev|", "|lag|", "delay", "position", "torque Nm"].forEach(t => head.append(make("th", t)));
byId("axes").append(head);
for (const { name, summary: s, times } of runs) for (const a of s.axes) {
  const row = make("tr"), range = times.axes.find(r => r.name === a.name), span = (list, digits) => list.map(v => v.toFixed(digits)).join(" .. ");
  [`${one ? "" : name + " "}${a.name} ${a.unit}`, a.max_vel.toFixed(3), a.max_acc.toFixed(1), a.max_jerk.toFixed(0), a.max_err.toFixed(6),
    a.max_dev === null ? "-" : a.max_dev.toFixed(6), a.max_lag.toFixed(6), (a.filter_delay_cycles * s.cycle_us / 1000).toFixed(2) + " ms",
    range ? span(range.position, 3) : "", range && range.torque_n_m.some(v => v !== 0) ? span(range.torque_n_m, 2) : "-"].forEach(t => row.append(make("td", t)));
  byId("axes").append(row);
}
for (const { summary: s } of runs) for (const m of s.messages.slice(0, 50)) {
  const place = m.source ? `${m.source.file}:${m.source.line}:${m.source.column}: ` : "";
  byId("messages").append(make("div", `${place}${m.severity} ${m.id || m.kontur_id}: ${m.text}`, m.severity));
}
const widest = Math.max(...runs.map(r => r.width)), within = Math.max(...runs.map(r => r.within));
if (within > VISIBLE) byId("legend").append(make("div",
  `Points of the contour are omitted where they are within ${within < 0.1 ? `${+(within * 1000).toPrecision(2)} µm` : `${+within.toPrecision(2)} mm`} of the drawn lines; use --window to draw a part of the run with all points.`, "note"));
if (widest > 1) byId("legend").append(make("div",
  `Over time, minimum and maximum of ${widest} cycles each; under the pointer their midpoint. Use --window to draw a part of the run cycle by cycle.`, "note"));

// what a canvas shows, for those who do not see it
function describe() {
  byId("close").setAttribute("aria-label", worst ? `The contour within ${(3 * worst[0]).toPrecision(2)} mm of its largest error of ${worst[0].toFixed(5)} mm` : "");
  contour.setAttribute("aria-label", `Contour of ${runs.map(r => r.name).join(", ")}. ` + runs.map(({ summary: s }) =>
    `${s.duration_s.toFixed(3)} s, ${s.path_length_mm.toFixed(3)} mm` + (s.max_contour_error ? `, contour error at most ${s.max_contour_error.mm.toFixed(5)} mm` : "")).join("; "));
  for (const { canvas, title, lines, shown } of plots) canvas.setAttribute("aria-label", `${title}: ${shown.y.label} over ${shown.x.label}. ` + lines.filter(l => l.c || l.points).map(({ name, c, points }) => {
    const low = (c ? c.low : points.map(p => p[1])).reduce((m, v) => Math.min(m, v), Infinity);
    const high = (c ? c.high || c.low : points.map(p => p[1])).reduce((m, v) => Math.max(m, v), -Infinity);
    return `${name} ${low.toPrecision(5)} to ${high.toPrecision(5)}`;
  }).join("; "));
}
function drawAll() { frames.forEach(drawContour); plots.forEach(drawPlot); followProgram(); }
// once per picture of the screen, however many events there are
let waiting = null;
function draw() { if (waiting === null) waiting = requestAnimationFrame(() => { waiting = null; drawAll(); }); }
function fit() { frames.filter(f => f.whole).forEach(showAll); }
function redraw() { values.clear(); fit(); drawAll(); }
describe();
frames.forEach(showAll);
drawAll();
window.addEventListener("resize", () => { fit(); draw(); });
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
// paper is white, and everything is laid out and drawn for its size there: as large as fits on one sheet, as long as it can be read
const SHEET_PX = 188 / 25.4 * 96, FITS = Array.from({ length: 25 }, (_, i) => 1 - 0.025 * i);
window.addEventListener("beforeprint", () => {
  const root = document.documentElement;
  root.dataset.theme = "light";
  root.dataset.paper = one ? "one" : "several";
  FITS.find(fit => {
    root.style.setProperty("--fit", fit);
    return root.offsetHeight <= SHEET_PX;
  });
  view.at = null;
  redraw();
});
window.addEventListener("afterprint", () => {
  delete document.documentElement.dataset.theme;
  delete document.documentElement.dataset.paper;
  redraw();
});
