(() => {
"use strict";
const NS = "http://www.w3.org/2000/svg", groups = {};
const short = v => v == null ? "–" : Number(v.toPrecision(5)).toString().replace("-", "−");
const fraction = (v, [a, b], log) => log ? Math.log(v / a) / Math.log(b / a) : (v - a) / (b - a);

function at(x, xs, ys) {
  let lo = 0, hi = xs.length - 1;
  if (hi < 0 || x < xs[0] || x > xs[hi]) return null;
  while (hi - lo > 1) { const m = (lo + hi) >> 1; if (xs[m] <= x) lo = m; else hi = m; }
  if (lo === hi) return ys[lo];
  const p = ys[lo], q = ys[hi], s = (x - xs[lo]) / (xs[hi] - xs[lo] || 1);
  return p == null || q == null ? null : p + (q - p) * s;
}

function setUp(figure) {
  const data = JSON.parse(figure.querySelector("script[type='application/json']").textContent);
  const drawing = figure.querySelector(".drawing"), out = figure.querySelector(".readout");
  const longest = data.xs.reduce((a, b) => b.length > a.length ? b : a, []);
  let now = null;
  const visible = () => {
    const svg = [...drawing.querySelectorAll("svg.wide,svg.narrow")].find(s => s.getBoundingClientRect().width > 0);
    return [svg, data.axes[svg.classList.contains("wide") ? "wide" : "narrow"]];
  };
  const shown = s => { const box = s.c && figure.querySelector("input." + s.c); return !box || box.checked; };
  function clear() {
    now = null;
    drawing.querySelectorAll(".cross,.dot").forEach(e => e.remove());
    out.textContent = "";
  }
  function add(svg, name, attributes, style) {
    const e = document.createElementNS(NS, name);
    for (const k in attributes) e.setAttribute(k, attributes[k]);
    if (style) e.style.fill = style;
    svg.append(e);
  }
  function show(x) {
    clear();
    const [svg, axes] = visible();
    const [low, high] = axes[0].x;
    now = Math.min(Math.max(x, low), high);
    for (const a of axes) {
      const [x0, y0, x1, y1] = a.box, px = x0 + (x1 - x0) * fraction(now, a.x, a.lx);
      add(svg, "line", {class: "cross", x1: px, x2: px, y1: y0, y2: y1});
    }
    const parts = [data.xn + " = " + short(now) + (data.xu ? " " + data.xu : "")];
    for (const s of data.series) {
      if (!shown(s)) continue;
      const v = at(now, data.xs[s.x], s.y), a = axes[s.p];
      parts.push(s.n + " " + short(v) + (v != null && data.yu ? " " + data.yu : ""));
      if (v == null) continue;
      const [x0, y0, x1, y1] = a.box, f = fraction(v, a.y, a.ly);
      if (f >= 0 && f <= 1) add(svg, "circle", {class: "dot", r: 3.2, cx: x0 + (x1 - x0) * fraction(now, a.x, a.lx), cy: y1 - (y1 - y0) * f}, "var(--" + s.t + ")");
    }
    out.textContent = parts.join("   ");
  }
  const peers = data.link ? (groups[data.link] ??= []) : [];
  peers.push({show, clear, data});
  const everywhere = x => data.link ? peers.forEach(p => p.show(x)) : show(x);
  const nowhere = () => data.link ? peers.forEach(p => p.clear()) : clear();
  drawing.addEventListener("pointermove", event => {
    const [svg, axes] = visible(), point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const a = axes.find(b => point.x >= b.box[0] && point.x <= b.box[2] && point.y >= b.box[1] && point.y <= b.box[3]);
    if (!a) return;
    const f = (point.x - a.box[0]) / (a.box[2] - a.box[0]), [low, high] = a.x;
    everywhere(a.lx ? low * (high / low) ** f : low + (high - low) * f);
  });
  drawing.addEventListener("pointerleave", nowhere);
  drawing.addEventListener("keydown", event => {
    const step = {ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10}[event.key];
    if (event.key === "Escape") return nowhere();
    if (event.key === "Home") everywhere(longest[0]);
    else if (event.key === "End") everywhere(longest[longest.length - 1]);
    else if (step) {
      let i = longest.findIndex(v => v >= now - 1e-12 * Math.abs(now));
      i = now == null ? 0 : Math.min(Math.max((i < 0 ? longest.length - 1 : i) + step, 0), longest.length - 1);
      everywhere(longest[i]);
    } else return;
    event.preventDefault();
  });
  figure.addEventListener("change", () => now != null && show(now));
}

function copying(button) {
  const text = button.parentElement.querySelector("pre").textContent, name = button.textContent;
  button.hidden = false;
  button.addEventListener("click", async () => {
    try { await navigator.clipboard.writeText(text); }
    catch {
      const area = document.createElement("textarea");
      area.value = text; document.body.append(area); area.select();
      document.execCommand("copy"); area.remove();
    }
    button.textContent = "Copied";
    setTimeout(() => { button.textContent = name; }, 1500);
  });
}

document.querySelectorAll("figure[data-readout]").forEach(setUp);
document.querySelectorAll(".copy button").forEach(copying);
addEventListener("beforeprint", () => document.querySelectorAll("details:not([open])").forEach(d => { d.open = true; d.dataset.printed = ""; }));
addEventListener("afterprint", () => document.querySelectorAll("details[data-printed]").forEach(d => { d.open = false; delete d.dataset.printed; }));
})();
