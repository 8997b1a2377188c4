// ---- legends: a click hides what they name
function swatchOf(css, dash, width) {
  const swatch = document.createElementNS("http://www.w3.org/2000/svg", "svg"), line = document.createElementNS(swatch.namespaceURI, "line");
  for (const [to, of] of [[swatch, { width: 28, height: 8, "aria-hidden": true }], [line, { x1: 0, x2: 28, y1: 4, y2: 4, stroke: css, "stroke-width": width, "stroke-dasharray": dash.join(" ") }]])
    for (const [attribute, value] of Object.entries(of)) to.setAttribute(attribute, value);
  swatch.append(line);
  return swatch;
}
function key(parent, name, css, what, dash = [], width = 2) {
  const k = make("span", undefined, "key");
  k.append(swatchOf(css, dash, width), name);
  k.tabIndex = 0;
  k.setAttribute("role", "button");
  k.setAttribute("aria-pressed", true);
  k.onclick = () => {
    const shown = view.hidden.delete(what);
    if (!shown) view.hidden.add(what);
    k.classList.toggle("off", !shown);
    k.setAttribute("aria-pressed", shown);
    draw();
  };
  k.onkeydown = e => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); k.click(); } };
  parent.append(k);
}
