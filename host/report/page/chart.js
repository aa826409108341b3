// Lines with intervals as SVG: what report pages draw with. No library that Debian ships draws intervals and fits in
// the size of this file.
"use strict";

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#a6761d"];
const DASHES = ["", "7 4", "2 3", "9 3 2 3", "12 4", "4 2", "1 4", "6 2 2 2"];
const HEIGHT = 420, LEFT = 64, TOP = 14, BOTTOM = 52;
const NARROW = 620;  // pixels; below, names stand under the chart instead of beside the lines

const svgNode = (name, attributes, text) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
};
const htmlNode = (name, attributes, ...children) => {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
};
const shown = (value, digits = 3) =>
  value === null || value === undefined ? "" : String(Number(Number(value).toPrecision(digits)));

// Round numbers from low to high, about `count` of them; of a logarithmic axis 1, 2, 5 times powers of ten.
function ticks(low, high, count, isLog) {
  if (isLog) {
    const all = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
      for (const digit of [1, 2, 5]) all.push(digit * 10 ** power);
    const inside = all.filter((v) => v >= low && v <= high);
    if (inside.length > 1) return inside;
  }
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((d) => d * power).find((s) => s >= raw);
  const result = [];
  for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-6; v += step) result.push(v);
  return result;
}

// Where a value lies between two ends, as a share.
const share = (value, low, high, isLog) =>
  high === low ? 0.5
  : isLog ? Math.log(value / low) / Math.log(high / low)
  : (value - low) / (high - low);

/* Draws into `place`. series: [{name, dotted?, points: [{x, y, low?, high?, label, row?}]}]; x: a number, or an index into
   `categories`. options: {xName, yName, categories?, logX, logY, onPoint(row)}. */
function drawChart(place, series, options) {
  place.replaceChildren();
  const all = series.flatMap((s) => s.points);
  if (all.length === 0) return;
  const WIDTH = Math.max(300, Math.min(900, place.clientWidth)), isNarrow = WIDTH < NARROW, RIGHT = isNarrow ? 12 : 170;
  const svg = svgNode("svg", {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": options.yName});
  const tip = htmlNode("div", {class: "tip", hidden: ""});
  place.append(svg, tip);
  const xs = all.map((p) => p.x), lows = all.map((p) => p.low ?? p.y), highs = all.map((p) => p.high ?? p.y);
  const lowX = Math.min(...xs), highX = Math.max(...xs);
  const highY = Math.max(...highs) * 1.06;
  const lowY = options.logY ? Math.min(...lows) / 1.1 : 0;
  const toX = (v) => LEFT + 12 + (WIDTH - LEFT - RIGHT - 24) * share(v, lowX, highX, options.logX);
  const toY = (v) => HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share(v, lowY, highY, options.logY);

  for (const v of ticks(lowY, highY, 6, options.logY)) {
    svg.append(svgNode("line", {class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: toY(v), y2: toY(v)}));
    svg.append(svgNode("text", {x: LEFT - 8, y: toY(v) + 4, "text-anchor": "end"}, shown(v)));
  }
  let lastTick = -1e9;
  for (const v of [...new Set(xs)].sort((a, b) => a - b)) {
    if (toX(v) - lastTick < 46) continue;
    lastTick = toX(v);
    const text = options.categories ? options.categories[v] : String(v);
    svg.append(svgNode("text", {x: toX(v), y: HEIGHT - BOTTOM + 20, "text-anchor": "middle"}, text));
  }
  svg.append(svgNode("text", {class: "soft", x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 8, "text-anchor": "middle"},
    options.xName));
  svg.append(svgNode("text", {class: "soft", x: 14, y: (TOP + HEIGHT - BOTTOM) / 2, "text-anchor": "middle",
    transform: `rotate(-90 14 ${(TOP + HEIGHT - BOTTOM) / 2})`}, options.yName));

  const labels = [];
  series.forEach((s, i) => {
    if (s.points.length === 0) return;
    const look = {stroke: s.dotted ? "var(--soft)" : COLOURS[i % COLOURS.length],
      "stroke-dasharray": s.dotted ? "2 4" : DASHES[i % DASHES.length]};
    const path = s.points.map((p, k) => `${k === 0 ? "M" : "L"}${toX(p.x)} ${toY(p.y)}`).join("");
    svg.append(svgNode("path", {d: path, fill: "none", "stroke-width": 2, ...look}));
    labels.push({y: toY(s.points.at(-1).y), text: s.name, fill: look.stroke});
    if (s.dotted) return;
    for (const p of s.points) svg.append(pointNode(p, look.stroke, toX, toY, tip, svg, options));
  });
  if (isNarrow)
    for (const label of labels) place.append(htmlNode("div", {style: `color: ${label.fill}`}, label.text));
  else
    placeLabels(svg, labels, WIDTH - RIGHT + 8);
}

// A marker with its interval, which tells its numbers under the mouse and in the focus of the keyboard.
function pointNode(p, colour, toX, toY, tip, svg, options) {
  const x = toX(p.x);
  const group = svgNode("g", {tabindex: 0, "aria-label": p.label, stroke: colour, "stroke-width": 2});
  if (p.low !== undefined && p.low !== null) {
    group.append(svgNode("line", {x1: x, x2: x, y1: toY(p.low), y2: toY(p.high)}));
    for (const end of [p.low, p.high])
      group.append(svgNode("line", {x1: x - 4, x2: x + 4, y1: toY(end), y2: toY(end)}));
  }
  group.append(svgNode("circle", {cx: x, cy: toY(p.y), r: 4, fill: colour}));
  group.append(svgNode("circle", {cx: x, cy: toY(p.y), r: 14, fill: "transparent", stroke: "none"}));
  const show = () => {
    tip.textContent = p.label;
    tip.hidden = false;
    const scale = svg.clientWidth / svg.viewBox.baseVal.width;
    tip.style.left = `${Math.max(0, Math.min(x * scale + 12, svg.clientWidth - tip.offsetWidth))}px`;
    tip.style.top = `${toY(p.y) * scale + 14}px`;
    options.onPoint?.(p.row, true);
  };
  const hide = () => {
    tip.hidden = true;
    options.onPoint?.(p.row, false);
  };
  for (const [event, action] of [["mouseenter", show], ["focus", show], ["mouseleave", hide], ["blur", hide]])
    group.addEventListener(event, action);
  return group;
}

// Names at the ends of lines, moved apart where they would cover each other.
function placeLabels(svg, labels, x) {
  labels.sort((a, b) => a.y - b.y);
  let last = -1e9;
  for (const label of labels) {
    last = Math.max(label.y, last + 16);
    svg.append(svgNode("text", {x, y: last + 4, style: `fill: ${label.fill}`}, label.text));
  }
}

/* A table that sorts by a column when its head is pressed. columns: [{name, value(row), text(row)}]. Returns its rows'
   nodes, in the order of `rows`. */
function drawTable(place, columns, rows) {
  const body = htmlNode("tbody", {});
  const nodes = rows.map((row) => htmlNode("tr", {}, ...columns.map((c) => htmlNode("td", {}, c.text(row)))));
  body.append(...nodes);
  const heads = columns.map((c) => {
    const button = htmlNode("button", {type: "button", title: "sort"}, c.name);
    const head = htmlNode("th", {scope: "col"}, button);
    button.addEventListener("click", () => {
      const isUp = head.getAttribute("aria-sort") !== "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", isUp ? "ascending" : "descending");
      const order = rows.map((_, i) => i);
      const less = (a, b) => (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b)));
      order.sort((a, b) => (isUp ? 1 : -1) * less(c.value(rows[a]), c.value(rows[b])));
      body.append(...order.map((i) => nodes[i]));
    });
    return head;
  });
  place.replaceChildren(htmlNode("table", {}, htmlNode("thead", {}, htmlNode("tr", {}, ...heads)), body));
  return nodes;
}
