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
  const short = v => {
    const t = v.toPrecision(5), [m, e] = v.toExponential(3).split("e");
    return (t.includes("e") ? +m + " × 10" + sup(+e) : String(+t)).replace("-", "−");
  };

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

  // crosshair, readout and zoom; figures with the same link move together
  const make = (name, attributes) => {
    const e = document.createElementNS(NS, name);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    return e;
  };
  const inside = (svg, e) => new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
  const readers = $$("figure.reads").map(figure => ({figure, d: data(figure)})).filter(r => r.d.at || r.d.planes);
  const drawings = figure => $$(".drawing > svg", figure).filter(s => s.getBoundingClientRect().width);
  // each drawing that is laid out with the boxes of its panels
  const boxesOf = (r, svg, n) => r.d.planes ? [r.d.planes[n].box] : r.d.boxes[svg.classList.contains("wide") ? 0 : 1];
  const laid = r => drawings(r.figure).map((svg, n) => [svg, boxesOf(r, svg, n)]);
  // the whole of the axis that figures share
  const ends = r => r.d.at ? [r.d.at[0], r.d.at[r.d.at.length - 1]] : r.d.planes[0].box.slice(4, 6);
  const span = (r, box) => r.range ?? [box[4], box[5]];
  // an error below what its reference knows is told as at most that
  const known = (d, v) => v < d.least ? "≤ " + percent(d.least) : percent(v);
  const abscissa = (d, x) => d.log ? 10 ** x : x;
  const say = (r, text) => { $(".out", r.figure).textContent = text; };
  const show = (r, x) => {
    $$(".xh", r.figure).forEach(e => e.remove());
    r.now = x;
    if (x === null) { say(r, ""); return; }
    for (const [svg, boxes] of laid(r)) for (const box of boxes) {
      const [x0, y0, x1, y1] = box, [low, high] = span(r, box), p = x0 + (x1 - x0) * (x - low) / (high - low);
      if (p >= x0 - .5 && p <= x1 + .5) svg.append(make("line", {x1: p, x2: p, y1: y0, y2: y1, class: "xh"}));
    }
    if (!r.d.at) return;
    const grid = r.d.at, i = Math.round((x - grid[0]) / (grid[grid.length - 1] - grid[0]) * (grid.length - 1));
    if (grid[i] === undefined) { say(r, ""); return; } // a linked figure reads where this one has nothing
    const said = r.d.series.map(([name, unit, v]) => v[i] === null || v[i] === undefined ? "" :
      name + " " + (unit === "%" ? known(r.d, v[i]) : short(v[i]) + (unit ? " " + unit : "")));
    say(r, (r.d.name + " = " + short(abscissa(r.d, grid[i])) + " " + r.d.unit).trim() + "   " + said.filter(Boolean).join("   "));
  };
  const linked = r => readers.filter(o => o === r || (r.d.link && o.d.link === r.d.link));
  const move = (r, x) => {
    const grid = r.d.at, held = x === null || !grid ? x : Math.min(grid[grid.length - 1], Math.max(grid[0], x));
    linked(r).forEach(o => show(o, held));
  };

  // the time axis stretched: every panel is a drawing of its own whose view is narrowed, its ticks are written anew
  const ticks = (low, high) => {
    const power = 10 ** Math.floor(Math.log10((high - low) / 6));
    const step = [1, 2, 2.5, 5, 10].map(s => s * power).find(s => (high - low) / s <= 7);
    const digits = Math.max(0, 1 - Math.floor(Math.log10(step) + 1e-9) + (String(step / power) === "2.5" ? 1 : 0) - 1);
    const found = [];
    for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n++) found.push([n * step, (n * step).toFixed(digits)]);
    return found;
  };
  const stretch = (r, range) => {
    r.range = range;
    r.figure.classList.toggle("zoomed", range !== null);
    const whole = $(".whole", r.figure);
    if (whole) whole.hidden = range === null;
    $$(".drawing > svg", r.figure).forEach((svg, n) => {
      const boxes = boxesOf(r, svg, n);
      $$(".z", svg).forEach((z, i) => {
        const [x0, y0, x1, y1, low, high] = boxes[i], [a, b] = range ?? [low, high], scale = (x1 - x0) / (high - low);
        z.setAttribute("viewBox", [x0 + (a - low) * scale, y0, (b - a) * scale, y1 - y0].join(" "));
      });
      $$(".xt", svg).forEach(g => {
        g.kept ??= g.innerHTML;
        if (range === null) { g.innerHTML = g.kept; return; }
        const [left, right, bottom] = g.dataset.x.split(" ").map(Number);
        g.replaceChildren(...ticks(...range).flatMap(([v, name]) => {
          const p = left + (right - left) * (v - range[0]) / (range[1] - range[0]);
          const label = make("text", {x: p, y: bottom + 19, class: "m", "text-anchor": "middle"});
          label.textContent = name.replace("-", "−");
          return [make("line", {x1: p, x2: p, y1: bottom, y2: bottom + 5, class: "ax"}), label];
        }));
      });
    });
    if (r.now !== null && r.now !== undefined) show(r, r.now);
  };
  // a pointer reads where it is; a finger's reading stays when it is lifted
  const reading = (box, at, away) => {
    for (const kind of ["pointerdown", "pointermove"]) box.addEventListener(kind, at);
    box.addEventListener("pointerleave", e => { if (e.pointerType !== "touch") away(); });
  };
  const zooms = r => $(".z", r.figure);
  const zoom = (r, range) => {
    const [low, high] = ends(r), least = (high - low) / 50;
    let [a, b] = range ?? [low, high];
    if (b - a < least) { const middle = (a + b) / 2; a = middle - least / 2; b = middle + least / 2; }
    [a, b] = [Math.max(low, a), Math.min(high, b)];
    linked(r).filter(zooms).forEach(o => stretch(o, b - a > .999 * (high - low) ? null : [a, b]));
  };
  const by = (r, factor) => {
    const [low, high] = r.range ?? ends(r), middle = r.now ?? (low + high) / 2;
    zoom(r, [middle - (middle - low) * factor, middle + (high - middle) * factor]);
  };
  // + and - stretch about the crosshair, 0 shows all; true where a key was one of them
  const zoomed = (r, key) => {
    if (!zooms(r) || !"+=-0".includes(key)) return false;
    if (key === "0") zoom(r, null); else by(r, key === "-" ? 2 : .5);
    return true;
  };
  const place = (r, e) => {
    const all = laid(r), found = all.find(([svg]) => svg.contains(e.target)) ?? all[0];
    if (!found) return [null];
    const [svg, boxes] = found, p = inside(svg, e);
    const b = boxes.find(([x0, , x1]) => p.x >= x0 - 8 && p.x <= x1 + 8) ?? boxes[0], [low, high] = span(r, b);
    return [svg, b, p.x, low + (p.x - b[0]) / (b[2] - b[0]) * (high - low), boxes];
  };
  // what a pointer is dragged across is stretched to the whole width
  readers.filter(zooms).forEach(r => {
    const box = $(".drawing", r.figure);
    let from = null, mark = null;
    const end = () => { mark?.remove(); from = mark = null; };
    const across = e => Math.min(from.b[2], Math.max(from.b[0], inside(from.svg, e).x));
    box.addEventListener("pointerdown", e => {
      const [svg, b, p, , boxes] = place(r, e);
      if (!svg || e.button !== 0 || p < b[0] || p > b[2]) return;
      from = {svg, p, b, bottom: boxes[boxes.length - 1][3]};
      box.setPointerCapture(e.pointerId);
    });
    box.addEventListener("pointermove", e => {
      if (from === null) return;
      const q = across(e);
      if (!mark) from.svg.append(mark = make("rect", {class: "sel", y: from.b[1], height: from.bottom - from.b[1]}));
      mark.setAttribute("x", Math.min(from.p, q));
      mark.setAttribute("width", Math.abs(q - from.p));
    });
    box.addEventListener("pointerup", e => {
      if (from === null) return;
      const {b, p} = from, q = across(e), [low, high] = span(r, b);
      end();
      if (Math.abs(q - p) < 8) return;
      zoom(r, [p, q].map(x => low + (x - b[0]) / (b[2] - b[0]) * (high - low)).sort((a, c) => a - c));
    });
    box.addEventListener("pointercancel", end);
    box.addEventListener("dblclick", () => zoom(r, null));
    $(".whole", r.figure).addEventListener("click", () => zoom(r, null));
  });
  readers.filter(r => r.d.at).forEach(r => {
    const box = $(".drawing", r.figure);
    reading(box, e => {
      const [svg, b, p, x] = place(r, e);
      if (svg) move(r, p < b[0] - 8 || p > b[2] + 8 ? null : x);
    }, () => move(r, null));
    box.addEventListener("keydown", e => {
      const grid = r.d.at, n = grid.length, step = grid[1] - grid[0], [low, high] = r.range ?? [grid[0], grid[n - 1]];
      const now = r.now === undefined ? null : r.now, middle = (low + high) / 2;
      const to = {ArrowLeft: (now ?? middle) - step, ArrowRight: (now ?? middle) + step, Home: low,
        End: high, PageDown: (now ?? low) + 16 * step, PageUp: (now ?? high) - 16 * step}[e.key];
      if (e.key === "Escape") { move(r, null); if (r.range) zoom(r, null); }
      else if (!zoomed(r, e.key) && to !== undefined) { e.preventDefault(); move(r, to); }
    });
  });

  // planes: the level under the pointer, from the grey of the picture that is drawn
  const greys = new Map();
  const grey = image => {
    if (greys.has(image)) return greys.get(image);
    greys.set(image, null);
    const picture = new Image();
    picture.onload = () => {
      const canvas = document.createElement("canvas");
      canvas.width = picture.naturalWidth;
      canvas.height = picture.naturalHeight;
      const pen = canvas.getContext("2d", {willReadFrequently: true});
      pen.drawImage(picture, 0, 0);
      greys.set(image, [canvas.width, canvas.height, pen.getImageData(0, 0, canvas.width, canvas.height).data]);
    };
    picture.src = image.getAttribute("href");
    return null;
  };
  const level = (plane, svg, u, v) => {
    const shares = $$("mask image", svg).map(image => {
      const g = grey(image);
      if (!g) return null;
      const [w, h, pixels] = g, column = Math.min(w - 1, Math.floor(u * w)), row = Math.min(h - 1, Math.floor((1 - v) * h));
      return pixels[4 * (row * w + column)] / 255;
    });
    if (!shares.length || shares.includes(null)) return null;
    if (plane.floor !== undefined) return shares[0] * -plane.floor + plane.floor;
    return plane.knee * Math.sinh((shares[0] - shares[1]) * Math.asinh(1 / plane.knee));
  };
  const worded = (plane, value) => value === null ? "" : plane.floor === undefined
    ? "   " + percent(value).replace(/^/, value < 0 ? "−" : "") + " of the maximum"
    : value <= plane.floor ? "   below " + plane.floor.toFixed(0).replace("-", "−") + " dB"
    : "   " + value.toFixed(0).replace("-", "−") + " dB of the maximum";
  readers.filter(r => r.d.planes).forEach(r => {
    const box = $(".drawing", r.figure);
    const read = (i, t, f) => {
      const plane = r.d.planes[i], svg = drawings(r.figure)[i], [t0, t1] = plane.time, [f0, f1] = plane.frequency;
      move(r, t);
      r.at = [i, t, f];
      const u = (t - t0) / (t1 - t0), v = (f - f0) / (f1 - f0);
      const found = u < 0 || u > 1 || v < 0 || v > 1 ? null : level(plane, svg, u, v);
      const text = "t = " + short(t) + (r.d.unit ? " " + r.d.unit : "") + "   ω" + (plane.unit === "Hz" ? " / 2π" : "") + " = " + short(f);
      say(r, text + (plane.unit ? " " + plane.unit : "") + worded(plane, found));
    };
    $$("mask image", box).forEach(grey);
    reading(box, e => {
      const all = drawings(r.figure), i = all.findIndex(svg => svg.contains(e.target));
      if (i < 0) return;
      const p = inside(all[i], e), [x0, y0, x1, y1, , , low, high] = r.d.planes[i].box;
      const [a, b] = span(r, r.d.planes[i].box);
      if (p.x < x0 || p.x > x1 || p.y < y0 || p.y > y1) { move(r, null); return; }
      read(i, a + (p.x - x0) / (x1 - x0) * (b - a), low + (y1 - p.y) / (y1 - y0) * (high - low));
    }, () => move(r, null));
    box.addEventListener("keydown", e => {
      const [i, t, f] = r.at ?? [0, null, null], [, , , , , , low, high] = r.d.planes[i].box;
      const [a, b] = span(r, r.d.planes[i].box);
      const now = [t ?? (a + b) / 2, f ?? (low + high) / 4], dt = (b - a) / 100, df = (high - low) / 100;
      const to = {ArrowLeft: [-dt, 0], ArrowRight: [dt, 0], ArrowUp: [0, df], ArrowDown: [0, -df]}[e.key];
      if (e.key === "Escape") { move(r, null); if (r.range) zoom(r, null); }
      else if (zoomed(r, e.key)) return;
      else if (e.key === "Home" || e.key === "End") { e.preventDefault(); read(e.key === "Home" ? 0 : r.d.planes.length - 1, ...now); }
      else if (to) { e.preventDefault(); read(i, Math.min(b, Math.max(a, now[0] + to[0])), Math.min(high, Math.max(low, now[1] + to[1]))); }
    });
  });

  // marks with titles: the nearest is ringed and told; arrow keys go from one to the next
  $$("figure.told").forEach(figure => {
    const box = $(".drawing", figure), out = $(".out", figure);
    let now = null;
    const all = () => drawings(figure).flatMap(svg => $$("title", svg).map(t => t.parentElement)).filter(e => e.getClientRects().length);
    const read = e => {
      $$(".ring", figure).forEach(r => r.remove());
      now = e;
      out.textContent = e ? $("title", e).textContent : "";
      if (!e) return;
      const b = e.getBBox();
      e.ownerSVGElement.append(make("rect", {x: b.x - 4, y: b.y - 4, width: b.width + 8, height: b.height + 8, rx: 8, class: "ring"}));
    };
    const distance = (mark, e) => {
      const r = mark.getBoundingClientRect();
      return Math.hypot(Math.max(r.left - e.clientX, 0, e.clientX - r.right), Math.max(r.top - e.clientY, 0, e.clientY - r.bottom));
    };
    reading(box, e => {
      const [, near] = all().reduce(([d, m], mark) => { const c = distance(mark, e); return c < d ? [c, mark] : [d, m]; }, [60, null]);
      if (near !== now) read(near);
    }, () => read(null));
    box.addEventListener("keydown", e => {
      if (e.key === "Escape") { read(null); return; }
      const marks = all(), last = marks.length - 1, step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[e.key];
      const from = now ? marks.indexOf(now) : step > 0 ? -1 : last + 1;
      const to = {Home: 0, End: last}[e.key] ?? from + step;
      if (Number.isNaN(to)) return;
      e.preventDefault();
      read(marks[Math.min(last, Math.max(0, to))] ?? null);
    });
    figure.addEventListener("change", () => read(null));
  });

  // order and amplitude: the generated code of each order, its error as it was enclosed for that very value
  const figure = $("#order-map"), code = {/*CODE*/};
  if (figure && Object.keys(code).length) {
    const d = data(figure), so = $(".so", figure), sa = $(".sa", figure);
    const unit = v => short(v) + (d.unit ? " " + d.unit : "");
    const size = (i, j) => {
      const bound = d.bounds[i][j], sign = d.signs[i][j] === "+" ? "high" : "low";
      return bound === null ? "–" : (bound > 10 ? "" : "≤ ") + atMost(bound) + ", " + sign;
    };
    const set = () => {
      const i = +so.value, j = +sa.value, order = d.orders[i], A = d.amplitudes[j];
      const value = code[order](A, d.k);
      $(".oo", figure).textContent = order;
      $(".oa", figure).textContent = d.letter + " = " + unit(A);
      $(".rv", figure).textContent = short(value * d.factor) + (d.frequency_unit ? " " + d.frequency_unit : "");
      $(".re", figure).textContent = size(i, j);
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
    // order and amplitude of the cell under the pointer
    const cell = e => {
      const svg = visible(figure), low = d.boxes[svg.classList.contains("wide") ? 0 : 1][1], p = inside(svg, e);
      if (p.x < low[0] || p.x > low[2] || p.y < low[1] || p.y > low[3]) return null;
      const a = low[4] + (p.x - low[0]) / (low[2] - low[0]) * (low[5] - low[4]);
      const j = d.amplitudes.reduce((best, v, k) => Math.abs(v - a) < Math.abs(d.amplitudes[best] - a) ? k : best, 0);
      return [Math.min(d.orders.length - 1, Math.floor((low[3] - p.y) / (low[3] - low[1]) * d.orders.length)), j];
    };
    const drawing = $(".drawing", figure), out = $(".out", figure);
    const tell = at => {
      out.textContent = at ? "order " + d.orders[at[0]] + "   " + d.letter + " = " + unit(d.amplitudes[at[1]]) + "   error " + size(...at) : "";
    };
    const go = at => { [so.value, sa.value] = at; set(); };
    reading(drawing, e => tell(cell(e)), () => tell(null));
    drawing.addEventListener("pointerdown", e => { const at = cell(e); if (at) go(at); });
    // the keys move the chosen cell and read it
    drawing.addEventListener("keydown", e => {
      if (e.key === "Escape") { tell(null); return; }
      const i = +so.value, j = +sa.value, last = d.amplitudes.length - 1;
      const to = {ArrowLeft: [i, j - 1], ArrowRight: [i, j + 1], ArrowUp: [i + 1, j], ArrowDown: [i - 1, j],
        Home: [i, 0], End: [i, last]}[e.key];
      if (!to) return;
      e.preventDefault();
      go([Math.min(d.orders.length - 1, Math.max(0, to[0])), Math.min(last, Math.max(0, to[1]))]);
      tell([+so.value, +sa.value]);
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
  const quoted = n => '"' + n.replaceAll('"', '""') + '"', rows = all => all.map(row => row.join(",")).join("\n") + "\n";
  const curves = d => [[d.name, ...d.series.map(s => s[0])].map(quoted), ...d.at.map((x, i) => [d.log ? +abscissa(d, x).toPrecision(5) : x, ...d.series.map(s => s[2][i] ?? "")])];
  const cells = d => [["order", d.letter, "bound", "sign"].map(quoted),
    ...d.orders.flatMap((n, i) => d.amplitudes.map((a, j) => [n, a, d.bounds[i][j] ?? "", quoted(d.signs[i][j])]))];
  const plain = cell => quoted(cell.textContent.replace(/[\u2007\u2008()]/g, "").replaceAll("−", "-").trim());
  const typed = table => [...table.rows].filter(row => row.className !== "remark").map(row => [...row.cells].map(plain));
  const matrix = (d, figure) => d.planes.flatMap((plane, i) => {
    const svg = drawings(figure)[i], g = grey($("mask image", svg));
    if (!g) return [];
    const [w, h] = g, [t0, t1] = plane.time, [f0, f1] = plane.frequency, places = (n, a, b) => [...Array(n).keys()].map(k => a + (k + .5) / n * (b - a));
    const across = places(w, t0, t1), up = places(h, f0, f1), values = up.map((f, k) => [f.toPrecision(5), ...across.map((t, c) => +level(plane, svg, (c + .5) / w, (k + .5) / h).toPrecision(3))]);
    return [[quoted((plane.unit ? "frequency, " + plane.unit : "omega") + " by time"), ...across.map(t => t.toPrecision(5))], ...values];
  });
  const table = figure => {
    const d = $("script[type='application/json']", figure) ? data(figure) : {};
    return rows(d.at ? curves(d) : d.map ? cells(d) : d.planes ? matrix(d, figure) : typed(document.getElementById(figure.dataset.table)));
  };
  $$("button[data-save]").forEach(button => {
    const figure = button.closest("figure");
    button.parentElement.hidden = false;
    button.addEventListener("click", () => {
      if (button.dataset.save === "csv") { save(figure.id + ".csv", uri("text/csv", table(figure))); return; }
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

  // what scrolls sideways can be reached by the keyboard
  $$(".eqs dd,.terms,.sys .eq").forEach(e => { if (e.scrollWidth > e.clientWidth) e.tabIndex = 0; });

  // copying, and sorting of tables by their columns
  $$("button[data-copy],.tab button").forEach(b => {
    b.hidden = false;
    b.addEventListener("click", () => {
      const text = b.dataset.copy ?? $("code", b.parentElement).textContent, name = b.textContent;
      const done = said => { b.textContent = said; setTimeout(() => { b.textContent = name; }, 1500); };
      (navigator.clipboard ? navigator.clipboard.writeText(text) : Promise.reject()).then(() => done("Copied"), () => done("Not allowed"));
    });
  });
  const units = {"%": .01, ns: 1e-9, "µs": 1e-6, ms: 1e-3};
  // the size of the number that a cell begins with; NaN where it holds none
  const sized = cell => {
    const t = cell.textContent.replace(/[\u2007\u2008]/g, "").replaceAll("−", "-").replace("≤", "").trim();
    const [, v, power, unit] = t.match(/^([+-]?[\d.]+)(?: ± [\d.]+)?(?: × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?(?: (%|ns|µs|ms))?(?!\S)/) ?? [];
    const raised = [...power ?? "⁰"].map(c => c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("");
    return v === undefined ? NaN : Math.abs(v) * (units[unit] ?? 1) * 10 ** raised;
  };
  // by number, then by name; what is neither comes last either way
  const ordered = (groups, column, down) => {
    const keyed = groups.map(g => [sized(g[0].cells[column]), g[0].cells[column].textContent.trim(), g]);
    const bare = ([v, t]) => Number.isNaN(v) && (!t || t === "–"), sign = down ? -1 : 1;
    const worded = ([v]) => Number.isNaN(v), compared = (a, b) => worded(a) ? a[1].localeCompare(b[1], "en") : a[0] - b[0];
    return keyed.sort((a, b) => bare(a) - bare(b) || worded(a) - worded(b) || sign * compared(a, b)).map(k => k[2]);
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
      body.append(...ordered(groups, column, down).flat());
    });
  });
})();
