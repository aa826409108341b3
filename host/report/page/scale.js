// The page of `whittle scale`: curves over one axis, a table that is linked with them, and what follows from them.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const main = document.querySelector("main");
const measured = data.points.filter((p) => p.frames);
const numeric = (word) => (/^[0-9.]+$/.test(word) ? Number(word) : null);
const pointName = (p) => Object.entries(p.values).map(([axis, word]) => `${axis} ${word}`).join(", ") || "as given";
const stageOf = (p, stage) => (stage === "frame" ? p : p.stages.find((s) => s.name === stage));
const percent = (share) => (share === null ? "" : `${shown(100 * share)} %`);
const between = (i, scale = 1) =>
  i.low === null ? shown(i.median * scale) : `${shown(i.median * scale)} (${shown(i.low * scale)}–${shown(i.high * scale)})`;

// What can be drawn of a stage of a point: {y, low, high}, or null.
const METRICS = {
  "time, ms": (p, stage) => scaled(stageOf(p, stage)?.seconds, 1e3),
  "speed-up": (p, stage) => scaled(stageOf(p, stage)?.speedUp, 1),
  "efficiency, %": (p, stage) => (p.efficiency === null ? null
    : scaled(stageOf(p, stage)?.speedUp, 100 * p.efficiency / p.speedUp.median)),
};
const scaled = (i, factor) => (i ? {y: i.median * factor, low: i.low === null ? null : i.low * factor,
  high: i.high === null ? null : i.high * factor} : null);

function text(name, words, attributes = {}) {
  main.append(htmlNode(name, attributes, words));
}

function choice(label, words) {
  const select = htmlNode("select", {}, ...words.map((w) => htmlNode("option", {value: w}, w)));
  return {select, node: htmlNode("label", {}, `${label} `, select)};
}

// One line for each combination of the other axes.
function seriesOver(axis, metric, stage) {
  const words = data.axes.find((a) => a.name === axis).values;
  const isNumeric = words.every((w) => numeric(w) !== null && numeric(w) > 0);
  const lines = new Map();
  for (const p of measured) {
    const value = METRICS[metric](p, stage);
    if (!value) continue;
    const rest = Object.entries(p.values).filter(([name]) => name !== axis).map(([name, w]) => `${name} ${w}`).join(", ");
    const x = isNumeric ? numeric(p.values[axis]) : words.indexOf(p.values[axis]);
    const label = `${pointName(p)}\n${stage}: ${between(stageOf(p, stage).seconds, 1e3)} ms\n` +
      `speed-up ${between(stageOf(p, stage).speedUp ?? {median: null, low: null})}\n${p.quietFrames} of ${p.frames} frames quiet`;
    if (!lines.has(rest)) lines.set(rest, []);
    lines.get(rest).push({x, ...value, label, row: data.points.indexOf(p)});
  }
  const series = [...lines].map(([name, points]) => ({name: name || stage, points: points.sort((a, b) => a.x - b.x)}));
  if (axis === "threads" && metric === "speed-up" && data.machine.length > 1) {
    const rates = data.machine.map((m) => ({x: m.threads, y: m.flopsPerSecond / data.machine[0].flopsPerSecond}));
    series.push({name: "the machine's arithmetic", dotted: true, points: rates});
    const memory = data.machine.map((m) => ({x: m.threads, y: m.triadBytesPerSecond / data.machine[0].triadBytesPerSecond}));
    series.push({name: "the machine's memory", dotted: true, points: memory});
  }
  const xs = [...new Set(series.flatMap((s) => s.points.map((p) => p.x)))];
  return {series, categories: isNumeric ? null : words,
    logX: isNumeric && xs.length > 1 && Math.max(...xs) >= 4 * Math.min(...xs)};
}

function head() {
  const settings = measured[0]?.settings;
  text("h1", `${data.scene.split("/").pop()}: how its time changes`);
  const size = settings ? `, ${settings.width}×${settings.height}, ${settings.raysPerPixel} ${settings.raysPerPixel === 1 ? "ray" : "rays"} for each pixel` : "";
  text("p", `${data.triangles.toLocaleString("en")} triangles${size}. ${data.device}, ${data.processors} processors. ` +
    `${measured.reduce((n, p) => n + p.frames, 0)} frames of ${data.points.length} points in ${shown(data.seconds)} s.`);
  const busy = measured.reduce((n, p) => n + p.frames - p.quietFrames, 0);
  if (busy > 0)
    text("p", `${busy} frames ran beside other work (${shown(data.load.others)} processors at the most). They were ` +
      "measured again while time lasted, and count only where there are too few others.", {class: "warning"});
  for (const [a, b] of data.differing)
    text("p", `${pointName(data.points[a])} and ${pointName(data.points[b])} drew different pictures.`, {class: "warning"});
  if (data.fastest) {
    const best = data.points[data.fastest.point];
    const others = data.fastest.notToldApart.map((i) => pointName(data.points[i]));
    text("p", `Fastest: ${pointName(best)}: ${between(best.seconds, 1e3)} ms.` +
      (others.length > 0 ? ` Not told apart from it: ${others.join("; ")}.` : ""));
  }
}

function law(name, fit, parts) {
  if (fit.cannotTell) return `${name}: cannot tell: ${fit.cannotTell}.`;
  const told = parts.map(([key, word]) => (fit[key].mayBeZero ? `${word} not told from 0`
    : `${word} ${shown(fit[key].value)} ± ${shown(fit[key].half, 2)}`));
  return `${name}: ${told.join(", ")}; off by ${shown(100 * fit.residual, 2)} %.`;
}

function charts(rows) {
  if (data.axes.length === 0 || measured.length === 0) return;
  text("h2", "Curves, with 95 % intervals");
  const stages = ["frame", ...new Set(measured.flatMap((p) => p.stages.map((s) => s.name)))];
  const hasThreads = measured.some((p) => p.efficiency !== null);
  const axis = choice("over", data.axes.map((a) => a.name));
  const metric = choice("show", Object.keys(METRICS).filter((m) => hasThreads || !m.startsWith("efficiency")));
  const stage = choice("of", stages);
  const log = htmlNode("input", {type: "checkbox"});
  const place = htmlNode("div", {class: "chart"});
  main.append(htmlNode("div", {class: "controls"}, metric.node, stage.node, axis.node,
    htmlNode("label", {}, log, " logarithmic")), place);
  const draw = () => {
    const {series, categories, logX} = seriesOver(axis.select.value, metric.select.value, stage.select.value);
    const onPoint = (row, isOn) => rows()[row]?.classList.toggle("marked", isOn);
    drawChart(place, series, {xName: axis.select.value, yName: metric.select.value, categories, logX, logY: log.checked,
      onPoint});
  };
  for (const control of [axis.select, metric.select, stage.select, log]) control.addEventListener("change", draw);
  addEventListener("resize", draw);
  draw();
}

function table() {
  text("h2", "Every point");
  const place = htmlNode("div", {class: "scroll"});
  main.append(place);
  const sortable = (word) => numeric(word) ?? word;
  const columns = data.axes.map((a) => ({name: a.name, value: (p) => sortable(p.values[a.name]), text: (p) => p.values[a.name]}));
  const add = (name, value, words) =>
    columns.push({name, value: (p) => (p.frames ? value(p) : Infinity), text: (p) => (p.frames ? words(p) : "")});
  add("frame, ms", (p) => p.seconds.median, (p) => between(p.seconds, 1e3));
  add("speed-up", (p) => p.speedUp.median, (p) => between(p.speedUp));
  if (measured.some((p) => p.efficiency !== null)) {
    add("efficiency", (p) => p.efficiency, (p) => percent(p.efficiency));
    add("of machine", (p) => p.ofMachine, (p) => percent(p.ofMachine));
  }
  add("Mrays/s", (p) => p.raysPerSecond, (p) => shown(p.raysPerSecond / 1e6));
  add("frames", (p) => p.frames, (p) => (p.quietFrames < p.frames ? `${p.frames}, ${p.quietFrames} quiet` : String(p.frames)));
  if (measured.length < data.points.length)
    columns.push({name: "not measured", value: (p) => p.refused ?? "", text: (p) => (p.frames ? "" : p.refused ?? "no time")});
  return drawTable(place, columns, data.points);
}

let rowNodes = [];
head();
charts(() => rowNodes);
rowNodes = table();
if (data.laws) {
  text("h2", "Laws of speed-up");
  text("p", law("Amdahl's law", data.laws.amdahl, [["serial", "serial share"]]));
  text("p", law("Universal law", data.laws.universal, [["serial", "waiting"], ["crosstalk", "crosstalk"]]));
}
text("h2", "To repeat it");
text("pre", data.command);
