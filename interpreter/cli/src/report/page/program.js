// ---- the NC text and the times, both linked with the samples
const NO_LINE = { element: null };
const rows = new Map();
// time of a line in each run that it belongs to
const spent = new Map();
runs.forEach(r => r.times.lines.forEach(l => {
  const name = `${l.file}\n${l.line}`;
  spent.set(name, [...(spent.get(name) || []), l.seconds]);
}));
function spentIn(name) {
  const times = spent.get(name) || [];
  const [least, most] = [Math.min(...times), Math.max(...times)].map(t => t.toFixed(3));
  return !times.length ? "" : least === most ? `${most} s` : `${least} .. ${most} s`;
}
const files = [...new Set(runs.flatMap(r => r.files))].filter(file => runs.some(r => r.texts[r.files.indexOf(file)]));
function choose(file, line) {
  const again = view.line && view.line.file === file && view.line.line === line;
  view.line = again ? null : { file, line };
  if (view.line && byId("file").value !== file && files.includes(file)) showFile(file);
  for (const [name, element] of rows) {
    const chosen = view.line !== null && name === `${view.line.file}\n${view.line.line}`;
    element.classList.toggle("chosen", chosen);
    element.setAttribute("aria-selected", chosen);
  }
  draw();
}
function showFile(file) {
  const panel = byId("program"), r = runs.find(r => r.texts[r.files.indexOf(file)]);
  byId("file").value = file;
  panel.replaceChildren();
  rows.clear();
  r.texts[r.files.indexOf(file)].forEach((text, i) => {
    const name = `${file}\n${i + 1}`, row = make("div");
    row.append(make("span", i + 1), make("span", spentIn(name)), text);
    row.setAttribute("role", "option");
    row.onclick = () => choose(file, i + 1);
    rows.set(name, row);
    panel.append(row);
  });
}
if (files.length) {
  byId("program-card").hidden = false;
  byId("program").classList.toggle("several", runs.length > 1);
  files.forEach(file => byId("file").append(new Option(file, file)));
  byId("file").hidden = files.length < 2;
  byId("file").onchange = () => { showFile(byId("file").value); };
  showFile(files[0]);
  byId("program").addEventListener("keydown", e => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
    if (!step) return;
    e.preventDefault();
    const file = byId("file").value, line = Math.max(1, Math.min(rows.size, (view.line && view.line.file === file ? view.line.line : 0) + step));
    if (!view.line || view.line.line !== line || view.line.file !== file) choose(file, line);
    rows.get(`${file}\n${line}`).scrollIntoView({ block: "nearest" });
  });
}
// the line under the pointer
let current = NO_LINE;
function followProgram() {
  const r = runs[0], i = view.at === null ? -1 : bucketAt(r, view.at), name = i < 0 ? "" : `${r.files[r.file[i]]}\n${r.line[i]}`;
  const element = rows.get(name) || null;
  if (element === current.element) return;
  if (current.element) current.element.classList.remove("at");
  current = { element };
  if (!element) return;
  element.classList.add("at");
  const panel = byId("program");
  if (!panel.matches(":hover")) panel.scrollTop = element.offsetTop - panel.offsetTop - panel.clientHeight / 2;
}

const MOST_LINES = 10;
function bar(share) {
  const cell = make("td", undefined, "share"), inside = make("i");
  inside.style.width = `${(100 * share).toFixed(1)}%`;
  cell.append(inside);
  return cell;
}
const because = t => t.reason + (t.axis ? ` ${t.axis}` : "") + (t.towards ? ` (for ${t.towards})` : "");
for (const r of runs) {
  const total = Math.max(1e-9, r.times.duration_s);
  const table = (title, names, fill) => {
    const box = make("div", undefined, "wide"), t = make("table"), head = make("tr");
    names.forEach(name => head.append(make("th", name, name === "mostly" ? "text" : "")));
    t.append(make("caption", (one ? "" : r.name + ": ") + title), head);
    fill(t);
    box.append(t);
    byId("times").append(box);
  };
  table("by what limited the speed", ["reason", "s", "%", ""], t => r.times.reasons.forEach(reason => {
    const row = make("tr");
    row.append(make("td", because(reason)), make("td", reason.seconds.toFixed(3)), make("td", (100 * reason.seconds / total).toFixed(1)), bar(reason.seconds / total));
    t.append(row);
  }));
  table("lines that take the most time", ["line", "s", "%", "", "mostly"], t => r.times.lines.slice(0, MOST_LINES).forEach(l => {
    const row = make("tr"), name = `${r.files.length > 1 ? l.file + " " : ""}${l.line}${l.block === null ? "" : " N" + l.block}`;
    row.append(make("td", name), make("td", l.seconds.toFixed(3)), make("td", (100 * l.seconds / total).toFixed(1)), bar(l.seconds / total),
      make("td", `${l.kind === "none" ? "" : l.kind + ", "}${l.reasons.length ? because(l.reasons[0]) : ""}`, "text"));
    row.dataset.line = l.line;
    row.tabIndex = 0;
    row.onclick = () => choose(l.file, l.line);
    row.onkeydown = e => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); choose(l.file, l.line); } };
    t.append(row);
  }));
}
