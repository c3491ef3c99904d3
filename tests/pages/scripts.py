"""What a page is asked for by the tests that open it, as JavaScript that answers with plain data."""

from __future__ import annotations

HEIGHT = "document.documentElement.scrollHeight"
UNFOLD = "document.querySelectorAll('details').forEach(d => d.open = true)"
SETTLED = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
"""After scrolling, so that no late move of a resting pointer is met."""
DRAWN = """const drawn = f => [...f.querySelectorAll(".drawing > svg")].filter(s => s.getClientRects().length);
const figures = [...document.querySelectorAll("figure")].filter(f => f.getClientRects().length);"""

WIDE = """[...document.querySelectorAll("main *")].filter(e => e.getBoundingClientRect().right > innerWidth + .5
  && !e.closest(".scroll,pre,svg,.terms,.eqs,.eq")).map(e => e.tagName + "." + e.className).slice(0, 9)"""
"""Elements beyond the right edge, those in boxes that scroll left out."""

OVERLAPS = f"""(() => {{
  {DRAWN}
  const found = [];
  for (const figure of figures) for (const svg of drawn(figure)) {{
    // the ink of a label: its box less the room above capitals and below the line
    const boxes = [...svg.querySelectorAll("text")].filter(t => t.getClientRects().length && t.textContent.trim()
      && getComputedStyle(t).opacity !== "0").map(t => {{
      const r = t.getBoundingClientRect(), cut = .2 * Math.min(r.width, r.height);
      return [t.textContent, r.left - 1, r.top + cut, r.right + 1, r.bottom - cut];
    }});
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach(b => {{
      if (a[1] < b[3] && b[1] < a[3] && a[2] < b[4] && b[2] < a[4]) found.push([figure.id, a[0], b[0]]);
    }}));
  }}
  return found;
}})()"""
"""Pairs of labels in one drawing of which one covers the other."""

EMPTY = f"""(() => {{
  {DRAWN}
  const frame = /(^| )(g|ax|tg|tg2|bgf|band|hat|bar|ann|zb|zl|xh|gh)( |$)/;
  const data = svg => [...svg.querySelectorAll("path,circle,rect,image,line")].filter(e => e.getClientRects().length
    && !frame.test(e.getAttribute("class") ?? "") && !e.closest("defs,mask,.xt"));
  const found = [];
  for (const figure of figures) {{
    const script = figure.querySelector("script[type='application/json']");
    const d = script ? JSON.parse(script.textContent) : {{}};
    drawn(figure).forEach((svg, n) => {{
      const marks = data(svg).map(e => e.getBoundingClientRect()), m = svg.getScreenCTM();
      const boxes = d.planes ? [d.planes[n].box] : d.boxes ? d.boxes[svg.classList.contains("wide") ? 0 : 1] : [];
      if (!marks.length) found.push(figure.id);
      boxes.forEach(([x0, y0, x1, y1], i) => {{
        const [left, top, right, bottom] = [x0 * m.a + m.e, y0 * m.d + m.f, x1 * m.a + m.e, y1 * m.d + m.f];
        const shared = marks.map(r => [Math.min(r.right, right) - Math.max(r.left, left),
          Math.min(r.bottom, bottom) - Math.max(r.top, top)]).filter(([w, h]) => w > -1 && h > -1);
        if (!shared.some(([w, h]) => Math.max(w, h) > 20)) found.push(figure.id + ", panel " + (i + 1));
      }});
    }});
  }}
  return found;
}})()"""
"""Drawings, and panels of drawings, in which nothing is drawn."""

TEXTS = f"""(() => {{
  {DRAWN}
  return figures.flatMap(f => drawn(f).flatMap(svg => {{
    const box = svg.getBoundingClientRect();
    return [...svg.querySelectorAll("text")].filter(t => t.getClientRects().length && t.textContent.trim()).map(t => {{
      const r = t.getBoundingClientRect(), m = t.getScreenCTM();
      return [f.id, t.textContent, parseFloat(getComputedStyle(t).fontSize) * Math.hypot(m.a, m.b),
        Math.max(box.left - r.left, r.right - box.right, box.top - r.top, r.bottom - box.bottom)];
    }});
  }}));
}})()"""
"""Labels with their size in pixels, and how far each stands out of its drawing."""

MATHEMATICS = """[...document.querySelectorAll("mi,mn,mo,mtext")].filter(e => e.getClientRects().length
  && e.textContent.trim().length).map(e => [e.textContent, parseFloat(getComputedStyle(e).fontSize)])"""

FIGURES = f"""(() => {{
  {DRAWN}
  return figures.map(f => ({{id: f.id, named: drawn(f).every(s => (s.getAttribute("aria-label") ?? "").length > 5),
    drawn: drawn(f).length, out: !!f.querySelector(".out"), keyboard: f.querySelector(".drawing").tabIndex === 0,
    caption: f.querySelector("figcaption").textContent.trim().length,
    toggles: f.querySelectorAll(".toggles input").length}}));
}})()"""

TOGGLES = """[...document.querySelectorAll("figure .toggles input")].map(box => {
  const figure = box.closest("figure"), letter = box.className.slice(1);
  const seen = () => [...figure.querySelectorAll(".f" + letter)].filter(g => g.getClientRects().length).length;
  const all = seen();
  box.click();
  const none = seen();
  box.click();
  return [figure.id + " " + letter, all, none, seen()];
})"""
"""For each check box how many groups are drawn before, without and after."""

READ = """(() => {
  const figure = document.getElementById(%s), box = figure.querySelector(".drawing");
  box.scrollIntoView({block: "center"});
  const svg = [...box.querySelectorAll(":scope > svg")].find(s => s.getClientRects().length);
  const script = figure.querySelector("script[type='application/json']");
  const d = script ? JSON.parse(script.textContent) : {};
  const boxes = d.planes ? [d.planes[0].box] : d.boxes ? d.boxes[svg.classList.contains("wide") ? 0 : 1] : [];
  if (boxes.length) {
    const [x0, y0, x1, y1] = boxes[boxes.length - 1], m = svg.getScreenCTM();
    return [(x0 + .4 * (x1 - x0)) * m.a + m.e, (y0 + y1) / 2 * m.d + m.f];
  }
  const mark = figure.classList.contains("told") && [...svg.querySelectorAll("title")].map(t => t.parentElement)
    .find(e => e.getClientRects().length);
  const r = (mark || svg).getBoundingClientRect();
  return [r.left + r.width / 2, r.top + r.height * (mark ? .5 : .6)];
})()"""
"""Where a pointer reads a figure: in its last panel, or on its first mark."""

SORTED = """[...document.querySelectorAll("table[id] thead button")].map(button => {
  const table = button.closest("table"), column = button.closest("th").cellIndex;
  const rows = () => [...table.tBodies[0].rows].filter(r => r.className !== "remark");
  const cells = () => rows().map(r => r.cells[column].textContent);
  button.click();
  const up = cells(), said = button.closest("th").ariaSort;
  button.click();
  return [table.id + ", " + button.textContent, said, up, cells()];
})"""
"""Each column that sorts: its name, what is announced, and its cells going up and going down."""

SAVED = """(async () => {
  const got = [], click = HTMLAnchorElement.prototype.click;
  HTMLAnchorElement.prototype.click = function () { got.push([this.download, decodeURIComponent(this.href)]); };
  const shown = [...document.querySelectorAll("[data-save]")].filter(b => b.getClientRects().length);
  shown.filter(b => b.dataset.save !== "png").forEach(b => b.click());
  const before = got.length;
  shown.find(b => b.dataset.save === "png").click();
  for (let n = 0; n < 100 && got.length === before; n++) await new Promise(done => setTimeout(done, 20));
  HTMLAnchorElement.prototype.click = click;
  const files = [...document.querySelectorAll("a[download]")].map(a => [a.download, decodeURIComponent(a.href)]);
  return [got, files];
})()"""
"""What the buttons of all figures save (one picture in pixels), and the files that are links."""

SMUGGLED = """(async () => {
  const seen = [];
  addEventListener("securitypolicyviolation", e => seen.push(e.effectiveDirective));
  const script = document.createElement("script");
  script.textContent = "window.smuggled = true";
  document.body.append(script);
  const image = new Image();
  image.src = "https://example.invalid/x.png";
  for (let n = 0; n < 50 && seen.length < 2; n++) await new Promise(done => setTimeout(done, 20));
  return [window.smuggled === true, seen.sort()];
})()"""
"""Whether a script that is not the page's own ran, and what the page's policy refused."""

SHOWN = """(() => {
  const walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT), found = [];
  while (walk.nextNode()) {
    const e = walk.currentNode.parentElement, text = walk.currentNode.data.trim();
    if (!text || e.closest("script,style,title,.slid,.read,.out,.saves,.copies,.tab > button,summary")) continue;
    if (e.checkVisibility({visibilityProperty: true})) found.push(text);
  }
  return found;
})()"""
"""Every piece of text that is laid out, but what only a script can use."""

BUTTONS = "[...document.querySelectorAll('button,input[type=range]')].filter(b => b.getClientRects().length).length"
COLOURS = r"""
(() => {
  const found = {}, walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  const parse = c => c.match(/[\d.]+/g).map(Number);
  while (walk.nextNode()) {
    const e = walk.currentNode.parentElement;
    if (!walk.currentNode.data.trim() || !e.getClientRects().length || e.closest("script,style,title,desc")) continue;
    const style = getComputedStyle(e), ink = e.closest("svg") ? style.fill : style.color;
    let ground = "", up = e;
    for (; up && !ground; up = up.parentElement) {
      const c = getComputedStyle(up).backgroundColor, v = parse(c);
      if (v.length === 3 || v[3] > 0) ground = c;
    }
    found[ink + " on " + ground] = walk.currentNode.data.trim().slice(0, 40);
  }
  return Object.entries(found).map(([k, text]) => [text, ...k.split(" on ").map(parse)]);
})()
"""
"""Text colour against the nearest painted background, for all text that is laid out."""

LOOKED_AT = {
    "across": "document.documentElement.scrollWidth",
    "beyond": WIDE,
    "overlaps": OVERLAPS,
    "texts": TEXTS,
    "empty": EMPTY,
    "mathematics": MATHEMATICS,
    "colours": COLOURS,
}
"""What is looked at in each width."""
DONE = {"shown": SHOWN, "toggles": TOGGLES, "sorted": SORTED, "saved": SAVED}
"""What is tried once."""
