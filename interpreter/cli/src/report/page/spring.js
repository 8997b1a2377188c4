// ---- a mass on a spring of wished frequency and damping, as filters/analysis/spring.rs says
const wished = new Map();
const modelOf = ({ r, axis }) => ({ ...r.models[axis], ...wished.get(r.models[axis].name) });
// deflection over time, its greatest value, and the amplitude when the axis has accelerated for the last time
function respond({ r, axis }, { hz, damping }) {
  const w = 2 * Math.PI * hz, wd = w * Math.sqrt((1 - damping) * (1 + damping)), T = r.summary.cycle_us / 1e6, lean = damping * w / wd;
  const sin = Math.sin(wd * T), cos = Math.cos(wd * T), decay = Math.exp(-damping * w * T), all = new Float64Array(r.accelerations[axis].length);
  let q = 0, v = 0, most = 0, left = 0;
  r.accelerations[axis].forEach((a, i) => {
    const rest = -a / (w * w), x = q - rest;
    q = rest + decay * ((cos + lean * sin) * x + sin / wd * v);
    v = decay * ((cos - lean * sin) * v - w * w / wd * sin * x);
    all[i] = q;
    most = Math.max(most, Math.abs(q));
    if (a !== 0) left = Math.hypot(q, (v + damping * w * q) / wd);
  });
  return { all, most, left };
}
const responses = new Map();
function responseOf(line) {
  const { hz, damping } = modelOf(line), key = `${hz} ${damping}`, known = responses.get(line);
  if (known && known.key === key) return known;
  const found = { key, ...respond(line, { hz, damping }) };
  responses.set(line, found);
  return found;
}
// every cycle of the time shown, or least and greatest deflection of as many cycles as make a point
const MOST_SWINGS = 2000;
function swing(line) {
  const { all } = responseOf(line), { r } = line, first = r.k[0] || 0;
  const cycle = t => Math.min(all.length, Math.max(0, Math.round(t * 1e6 / r.summary.cycle_us) - first));
  const from = Math.max(0, cycle(view.time[0]) - 1), to = Math.min(all.length, cycle(view.time[1]) + 2), each = Math.max(1, Math.ceil((to - from) / MOST_SWINGS)), points = [];
  for (let i = from; i < to; i += each) {
    let low = i, high = i;
    for (let n = i; n < Math.min(to, i + each); n++) {
      if (all[n] < all[low]) low = n;
      if (all[n] > all[high]) high = n;
    }
    for (const n of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) points.push([seconds(r, first + n), all[n]]);
  }
  return points;
}
const springPlot = plots.find(p => p.kind === "spring");
if (springPlot) {
  const bar = make("div", undefined, "bar"), left = make("span", undefined, "note");
  const field = (model, name, what, step, from, to) => {
    const label = make("label", name + " "), input = make("input");
    Object.assign(input, { type: "number", step, min: from, max: to, value: model[what] });
    input.setAttribute("aria-label", `${model.name} ${name}`);
    input.oninput = () => {
      const v = Number(input.value), fits = input.value !== "" && v >= from && v <= to;
      input.setCustomValidity(fits ? "" : `${from} to ${to}`);
      if (!fits) return;
      wished.set(model.name, { ...wished.get(model.name), [what]: v });
      say();
      draw();
    };
    label.append(input);
    return label;
  };
  const say = () => {
    left.textContent = springPlot.lines.map(l => {
      const { most, left } = responseOf(l), { hz, damping, unit } = modelOf(l);
      return `${l.name} (${hz} Hz, ${damping}): at most ${most.toFixed(5)}, residual at standstill ${left.toFixed(5)} ${unit}`;
    }).join("; ");
  };
  // several runs are runs of one machine: an axis has one spring
  for (const model of new Map(springPlot.lines.map(l => [l.r.models[l.axis].name, l.r.models[l.axis]])).values()) {
    const axis = make("span", model.name + " ", "axis");
    axis.append(field(model, "Hz", "hz", "any", 0.1, 10000), " ", field(model, "damping", "damping", 0.01, 0, 0.99));
    bar.append(axis);
  }
  springPlot.head.textContent = "Mass on a spring";
  springPlot.card.append(bar, left);
  say();
}
