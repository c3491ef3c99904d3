(() => {
  "use strict";
  const $ = (s, r = document) => r.querySelector(s), $$ = (s, r = document) => [...r.querySelectorAll(s)];
  const NS = "http://www.w3.org/2000/svg";
  const data = figure => JSON.parse($("script[type='application/json']", figure).textContent);
  const visible = figure => $$("svg.wide,svg.narrow", figure).find(s => s.getBoundingClientRect().width);
  const sup = n => String(n).replace("-", "⁻").replace(/\d/g, c => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]);
  const percent = v => {
    if (v === 0) return "0";
    if (Math.abs(v) > 10) return "over 1000 %";
    const [m, e] = Math.abs(v).toExponential(1).split("e");
    if (Math.abs(v) < 1e-6) return m + " × 10" + sup(+e);
    return (100 * m * 10 ** e).toFixed(Math.max(0, -1 - e)) + " %";
  };
  // a size of an error, never rounded below what is certain
  const atMost = v => {
    if (v === 0) return "0";
    const e = Math.floor(Math.log10(v)), up = Math.ceil(v / 10 ** (e - 1) * (1 - 1e-9)) * 10 ** (e - 1);
    return percent(up);
  };
  const short = v => { const t = v.toPrecision(5); return t.includes("e") ? v.toExponential(3) : String(+t); };

  // contents: mark the section whose heading was passed last
  const links = $$(".toc a"), parts = links.map(a => $(a.hash));
  let busy = 0;
  const mark = () => {
    busy = 0;
    let now = 0;
    parts.forEach((s, i) => { if (s.getBoundingClientRect().top < innerHeight * .3) now = i; });
    if (innerHeight + scrollY > document.documentElement.scrollHeight - 4) now = parts.length - 1;
    links.forEach((a, i) => {
      if (i !== now) { a.removeAttribute("aria-current"); return; }
      if (a.hasAttribute("aria-current")) return;
      a.setAttribute("aria-current", "true");
      const strip = $(".toc");
      if (strip.scrollWidth > strip.clientWidth) strip.scrollLeft = a.offsetLeft - 60;
    });
  };
  if (links.length) {
    addEventListener("scroll", () => busy || (busy = requestAnimationFrame(mark)), {passive: true});
    mark();
  }

  // crosshair and readout; figures with the same link move together
  const readers = $$("figure.reads").map(figure => ({figure, d: data(figure)})).filter(r => r.d.at);
  const at = r => { const s = visible(r.figure); return s ? [s, r.d.boxes[s.classList.contains("wide") ? 0 : 1]] : [null, []]; };
  const show = (r, x) => {
    const [svg, boxes] = at(r), out = $(".out", r.figure);
    $$(".xh", r.figure).forEach(e => e.remove());
    r.now = x;
    if (x === null || !svg) { out.textContent = ""; return; }
    for (const [x0, y0, x1, y1, low, high] of boxes) {
      const line = document.createElementNS(NS, "line"), p = x0 + (x1 - x0) * (x - low) / (high - low);
      for (const [k, v] of [["x1", p], ["x2", p], ["y1", y0], ["y2", y1], ["class", "xh"]]) line.setAttribute(k, v);
      svg.append(line);
    }
    const grid = r.d.at, i = Math.round((x - grid[0]) / (grid[grid.length - 1] - grid[0]) * (grid.length - 1));
    const said = r.d.series.map(([name, unit, v]) => v[i] === null || v[i] === undefined ? "" :
      name + " " + (unit === "%" ? percent(v[i]) : short(v[i]) + (unit ? " " + unit : "")));
    out.textContent = (r.d.name + " = " + short(grid[i]) + " " + r.d.unit).trim() + "   " + said.filter(Boolean).join("   ");
  };
  const move = (r, x) => {
    const grid = r.d.at, held = x === null ? null : Math.min(grid[grid.length - 1], Math.max(grid[0], x));
    readers.filter(o => o === r || (r.d.link && o.d.link === r.d.link)).forEach(o => show(o, held));
  };
  readers.forEach(r => {
    const box = $(".drawing", r.figure);
    box.addEventListener("pointermove", e => {
      const [svg, boxes] = at(r);
      if (!svg) return;
      const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse()), b = boxes[0];
      if (p.x < b[0] - 8 || p.x > b[2] + 8) { move(r, null); return; }
      move(r, b[4] + (p.x - b[0]) / (b[2] - b[0]) * (b[5] - b[4]));
    });
    box.addEventListener("pointerleave", () => move(r, null));
    box.addEventListener("keydown", e => {
      const grid = r.d.at, n = grid.length, step = grid[1] - grid[0];
      const now = r.now === undefined || r.now === null ? null : r.now;
      const to = {ArrowLeft: (now ?? grid[n >> 1]) - step, ArrowRight: (now ?? grid[n >> 1]) + step, Home: grid[0],
        End: grid[n - 1], PageDown: (now ?? grid[0]) + 16 * step, PageUp: (now ?? grid[n - 1]) - 16 * step}[e.key];
      if (e.key === "Escape") move(r, null);
      else if (to !== undefined) { e.preventDefault(); move(r, to); }
    });
  });

  // order and amplitude: the generated code of each order, its error as it was enclosed for that very value
  const figure = $("#order-map"), code = {/*CODE*/};
  if (figure && Object.keys(code).length) {
    const d = data(figure), so = $(".so", figure), sa = $(".sa", figure);
    const unit = v => short(v) + (d.unit ? " " + d.unit : "");
    const set = () => {
      const i = +so.value, j = +sa.value, order = d.orders[i], A = d.amplitudes[j];
      const value = code[order](A, d.k), bound = d.bounds[i][j];
      $(".oo", figure).textContent = order;
      $(".oa", figure).textContent = d.letter + " = " + unit(A);
      $(".rv", figure).textContent = short(value * d.factor) + (d.frequency_unit ? " " + d.frequency_unit : "");
      const sign = d.signs[i][j] === "+" ? "+" : "−";
      $(".re", figure).textContent = bound === null ? "–" : (bound > 10 ? "" : "≤ ") + atMost(bound) + (sign === "+" ? ", high" : ", low");
      $$("svg", figure).forEach((svg, n) => {
        const mk = $(".mk", svg);
        if (!mk) return;
        const [up, low] = d.boxes[svg.classList.contains("wide") ? 0 : 1];
        const x = v => low[0] + (low[2] - low[0]) * (v - low[4]) / (low[5] - low[4]);
        const y = low[3] - (low[3] - low[1]) * (i + .5) / d.orders.length;
        mk.firstElementChild.setAttribute("d", `M${low[0]} ${y}H${low[2]}M${x(A)} ${up[1]}V${low[3]}`);
        mk.lastElementChild.setAttribute("cx", x(A));
        mk.lastElementChild.setAttribute("cy", y);
        const line = d.amplitudes.map(a => [x(a), code[order](a, d.k) / d.scale])
          .filter(([, v]) => v >= up[6] && v <= up[7])
          .map(([px, v]) => px.toFixed(1) + " " + (up[3] - (up[3] - up[1]) * (v - up[6]) / (up[7] - up[6])).toFixed(1));
        $(".moving path", svg).setAttribute("d", line.length ? "M" + line.join("L") : "");
      });
    };
    [so, sa].forEach(e => e.addEventListener("input", set));
    $(".drawing", figure).addEventListener("pointerdown", e => {
      const svg = visible(figure), low = d.boxes[svg.classList.contains("wide") ? 0 : 1][1];
      const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
      if (p.x < low[0] || p.x > low[2] || p.y < low[1] || p.y > low[3]) return;
      const a = low[4] + (p.x - low[0]) / (low[2] - low[0]) * (low[5] - low[4]);
      sa.value = d.amplitudes.reduce((best, v, k) => Math.abs(v - a) < Math.abs(d.amplitudes[best] - a) ? k : best, 0);
      so.value = Math.min(d.orders.length - 1, Math.floor((low[3] - p.y) / (low[3] - low[1]) * d.orders.length));
      set();
    });
    $(".slid", figure).hidden = false;
    $(".read", figure).hidden = false;
    set();
  }

  // each drawing as a file: the styles that the page gives it written into it, its numbers as they are read
  const STYLES = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "opacity",
    "font-size", "font-weight", "font-family", "text-anchor", "paint-order", "stop-color", "display", "vector-effect"];
  const inlined = svg => {
    const copy = svg.cloneNode(true), from = [svg, ...$$("*", svg)], to = [copy, ...$$("*", copy)];
    from.forEach((e, i) => {
      const style = getComputedStyle(e);
      to[i].setAttribute("style", STYLES.map(name => name + ":" + style.getPropertyValue(name)).join(";"));
    });
    const box = svg.viewBox.baseVal;
    copy.setAttribute("xmlns", NS);
    copy.setAttribute("width", box.width);
    copy.setAttribute("height", box.height);
    copy.style.background = getComputedStyle(document.body).backgroundColor;
    return new XMLSerializer().serializeToString(copy);
  };
  const save = (name, url) => {
    const link = document.createElement("a");
    link.download = name;
    link.href = url;
    link.click();
  };
  const uri = (kind, text) => "data:" + kind + ";charset=utf-8," + encodeURIComponent(text);
  const table = d => [[d.name, ...d.series.map(s => s[0])].map(n => '"' + n.replaceAll('"', '""') + '"').join(","),
    ...d.at.map((x, i) => [x, ...d.series.map(s => s[2][i] ?? "")].join(","))].join("\n") + "\n";
  $$("button[data-save]").forEach(button => {
    const figure = button.closest("figure");
    button.parentElement.hidden = false;
    button.addEventListener("click", () => {
      if (button.dataset.save === "csv") { save(figure.id + ".csv", uri("text/csv", table(data(figure)))); return; }
      const drawn = $$(".drawing > svg", figure).filter(s => s.getBoundingClientRect().width);
      drawn.forEach((svg, i) => {
        const name = figure.id + (drawn.length > 1 ? "-" + (i + 1) : ""), text = inlined(svg);
        if (button.dataset.save === "svg") { save(name + ".svg", uri("image/svg+xml", text)); return; }
        const image = new Image(), box = svg.viewBox.baseVal;
        image.onload = () => {
          const canvas = document.createElement("canvas");
          canvas.width = 2 * box.width;
          canvas.height = 2 * box.height;
          canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
          save(name + ".png", canvas.toDataURL("image/png"));
        };
        image.src = uri("image/svg+xml", text);
      });
    });
  });

  // copying, and sorting of tables by their columns
  $$("button[data-copy],.tab button").forEach(b => {
    b.hidden = false;
    b.addEventListener("click", () => {
      const text = b.dataset.copy ?? $("code", b.parentElement).textContent, name = b.textContent;
      const done = said => { b.textContent = said; setTimeout(() => { b.textContent = name; }, 1500); };
      (navigator.clipboard ? navigator.clipboard.writeText(text) : Promise.reject()).then(() => done("Copied"), () => done("Not allowed"));
    });
  });
  const sizes = {ns: 1e-9, "µs": 1e-6, ms: 1e-3};
  const worth = cell => {
    const t = cell.textContent.replace(/[\u2007\u2008]/g, "").replace("−", "-").trim(), v = parseFloat(t);
    if (Number.isNaN(v)) return Infinity;
    const power = t.match(/10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/), unit = t.match(/ (ns|µs|ms)/);
    const raised = power ? [...power[1]].map(c => c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("") : 0;
    return Math.abs(v) * (t.includes("%") ? .01 : 1) * 10 ** +raised * (unit ? sizes[unit[1]] : 1);
  };
  $$("table[id] thead th").forEach((head, i, all) => {
    const table = head.closest("table"), body = $("tbody", table), column = [...head.parentElement.children].indexOf(head);
    if (column === 0 || body.rows.length < 5) return;
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      $$("th", table).forEach(th => th.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const groups = [];
      for (const row of [...body.rows]) row.className === "remark" ? groups[groups.length - 1].push(row) : groups.push([row]);
      const key = g => worth(g[0].cells[column]);
      groups.sort((a, b) => down ? key(b) - key(a) : key(a) - key(b));
      body.append(...groups.flat());
    });
  });
})();
