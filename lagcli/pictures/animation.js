"use strict";
// The scene is drawn anew for each time: places between two frames lie on the line between them.
const S = JSON.parse(document.getElementById("scene").textContent);
const stage = document.getElementById("stage");
const $ = (id) => document.getElementById(id);
const NS = "http://www.w3.org/2000/svg";
const dim = S.axes.length;
const W = 640;

// -- from the space of the problem to the page ------------------------------------------------
const middle = S.low.map((x, k) => (x + S.high[k]) / 2);
const size = S.low.map((x, k) => S.high[k] - x);
let turn = -60;
const raise = (20 * Math.PI) / 180;
function flat(p) {
  if (dim === 1) return S.axes === "x" ? [p[0] - middle[0], 0] : [0, p[0] - middle[0]];
  if (dim === 2) return [p[0] - middle[0], p[1] - middle[1]];
  const [x, y, z] = p.map((v, k) => v - middle[k]);
  const a = (turn * Math.PI) / 180;
  return [
    -Math.sin(a) * x + Math.cos(a) * y,
    -Math.sin(raise) * (Math.cos(a) * x + Math.sin(a) * y) + Math.cos(raise) * z,
  ];
}
const across = dim === 3 ? Math.hypot(size[0], size[1]) : dim === 1 && S.axes !== "x" ? size[0] * 0.5 : size[0];
const up = dim === 3 ? Math.hypot(size[0], size[1]) * Math.sin(raise) + size[2] * Math.cos(raise)
  : dim === 2 ? size[1] : S.axes === "x" ? size[0] * 0.25 : size[0];
const H = Math.round(Math.min(Math.max((W * up) / across, 200), 620));
const scale = Math.min(W / across, H / up);
const at = (p) => { const [x, y] = flat(p); return [W / 2 + scale * x, H / 2 - scale * y]; };
stage.setAttribute("viewBox", `0 0 ${W} ${H}`);

// -- what is drawn -----------------------------------------------------------------------------
function make(kind, attributes, text) {
  const element = document.createElementNS(NS, kind);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  stage.appendChild(element);
  return element;
}
const colour = (k) => `var(--c${k % 6})`;
const path = (points) => points.map((p) => at(p).map((v) => v.toFixed(1)).join(",")).join(" ");
const axes = [...S.axes].map((letter) => [letter, make("line", { class: "axis" }), make("text", { class: "letter" }, letter)]);
const surfaces = Object.entries(S.surfaces).flatMap(([name, lines]) =>
  lines.map((points) => [name, make("polyline", { class: "surface", points: path(points) })]));
const trails = S.bodies.map((body, k) => make("polyline", { class: "trail", style: `stroke:${colour(k)}` }));
const links = S.links.map((link) => [link, make(link.kind === "spring" ? "polyline" : "line", { class: link.kind })]);
const places = Object.keys(S.places).map((name) => [name, make("circle", { class: "place", r: 5 })]);
const bodies = S.bodies.map((body, k) => make("circle", { class: "body", r: (body.radius * W).toFixed(1), style: `fill:${colour(k)}` }));
const names = S.bodies.length > 1 ? S.bodies.map((body) => make("text", { class: "name" }, body.name)) : [];
const vectors = S.vectors.map((vector, k) => {
  const paint = colour(S.bodies.length + k);
  return [vector, make("line", { style: `stroke:${paint};stroke-width:3` }), make("polygon", { style: `fill:${paint}` })];
});
const strongest = Math.max(1e-300, ...S.vectors.flatMap((v) => v.values.filter(Boolean).map((f) => Math.hypot(...f))));
const pull = (0.28 * across) / strongest;
const bar = 10 ** Math.floor(Math.log10(across / 3));
const long = [5, 2, 1].map((k) => k * bar).find((b) => b <= across / 3) ?? bar;
make("line", { class: "measure", x1: 16, y1: H - 16, x2: 16 + long * scale, y2: H - 16 });
make("text", { class: "small", x: 16, y: H - 24 }, `${+long.toPrecision(3)}${S.length ? " " + S.length : ""}`);

function place(name, i, part) {
  const body = S.bodies.find((b) => b.name === name);
  const list = body ? body.places : S.places[name];
  return between(list[i], list[Math.min(i + 1, list.length - 1)], part);
}
const between = (p, q, part) => p.map((v, k) => v + (q[k] - v) * part);
function spring(a, b) {
  const [x, y] = at(a), [u, v] = at(b);
  const length = Math.hypot(u - x, v - y) || 1, nx = -(v - y) / length, ny = (u - x) / length;
  const points = [[x, y]];
  for (let k = 0; k <= 18; k += 1) {
    const s = 0.12 + (0.76 * k) / 18, side = k === 0 || k === 18 ? 0 : k % 2 ? 8 : -8;
    points.push([x + s * (u - x) + side * nx, y + s * (v - y) + side * ny]);
  }
  points.push([u, v]);
  return points.map((p) => p.map((c) => c.toFixed(1)).join(",")).join(" ");
}
function line(element, a, b) {
  const [x, y] = at(a), [u, v] = at(b);
  for (const [name, value] of [["x1", x], ["y1", y], ["x2", u], ["y2", v]]) element.setAttribute(name, value.toFixed(1));
}
function arrow(vector, shaft, head, i, part, shown) {
  const force = vector.values[i], later = vector.values[Math.min(i + 1, vector.values.length - 1)];
  const value = force && later ? between(force, later, part) : force;
  const visible = shown && value && Math.hypot(...value) > 1e-9 * strongest;
  shaft.style.display = head.style.display = visible ? "" : "none";
  if (!visible) return;
  const from = place(vector.on, i, part), to = from.map((v, k) => v + pull * value[k]);
  line(shaft, from, to);
  const [x, y] = at(from), [u, v] = at(to), a = Math.atan2(v - y, u - x);
  const corner = (da, r) => `${(u + r * Math.cos(a + da)).toFixed(1)},${(v + r * Math.sin(a + da)).toFixed(1)}`;
  head.setAttribute("points", `${corner(0, 6)} ${corner(2.5, 11)} ${corner(-2.5, 11)}`);
}
function drawAxes() {
  const origin = S.low.map((v, k) => (v <= 0 && S.high[k] >= 0 ? 0 : v + 0.02 * size[k]));
  axes.forEach(([, element, letter], k) => {
    const a = [...origin], b = [...origin];
    a[k] = S.low[k]; b[k] = S.high[k];
    line(element, a, b);
    const [x, y] = at(b);
    letter.setAttribute("x", Math.min(x, W) - 14); letter.setAttribute("y", Math.max(y, 0) + (k === 0 && dim < 3 ? -6 : 16));
  });
}

// -- time --------------------------------------------------------------------------------------
const T = S.times, first = T[0], last = T[T.length - 1];
const seconds = S.unit === "s" && last - first >= 2 && last - first <= 60 ? last - first : 12;
let now = first, playing = false, before = null;
function frame(t) {
  let low = 0, high = T.length - 1;
  while (high - low > 1) { const mid = (low + high) >> 1; if (T[mid] <= t) low = mid; else high = mid; }
  const width = T[high] - T[low];
  return [low, width > 0 ? Math.min(1, Math.max(0, (t - T[low]) / width)) : 0];
}
const said = (t) => `t = ${t.toFixed(digits)}${S.unit ? " " + S.unit : ""}`;
const digits = Math.max(0, 3 - Math.ceil(Math.log10(last - first || 1)));
function draw() {
  const [i, part] = frame(now);
  drawAxes();
  for (const [name, element] of surfaces) element.classList.toggle("closed", !!(S.closed[name] || [])[i]);
  const traced = $("trails").checked;
  S.bodies.forEach((body, k) => {
    const here = place(body.name, i, part), [x, y] = at(here);
    bodies[k].setAttribute("cx", x.toFixed(1)); bodies[k].setAttribute("cy", y.toFixed(1));
    if (names[k]) { names[k].setAttribute("x", x + body.radius * W + 4); names[k].setAttribute("y", y - 6); }
    trails[k].setAttribute("points", traced && body.trail ? path([...body.places.slice(0, i + 1), here]) : "");
  });
  for (const [name, element] of places) {
    const [x, y] = at(place(name, i, part));
    element.setAttribute("cx", x.toFixed(1)); element.setAttribute("cy", y.toFixed(1));
  }
  for (const [link, element] of links) {
    const a = place(link.first, i, part), b = place(link.second, i, part);
    if (link.kind === "spring") element.setAttribute("points", spring(a, b)); else line(element, a, b);
  }
  const forced = $("forces") ? $("forces").checked : false;
  for (const [vector, shaft, head] of vectors) arrow(vector, shaft, head, i, part, forced);
  for (const [name, acts] of Object.entries(S.closed)) {
    const words = acts[i] ? "in contact" : "open";
    if ($("contact-" + name).textContent !== words) $("contact-" + name).textContent = words;
  }
  $("clock").textContent = said(now);
  $("time").value = now;
  $("time").setAttribute("aria-valuetext", said(now));
}
function step(stamp) {
  if (!playing) return;
  if (before !== null) now += ((stamp - before) / 1000) * ((last - first) / seconds) * Number($("speed").value);
  before = stamp;
  if (now >= last) { now = last; play(false); }
  draw();
  if (playing) requestAnimationFrame(step);
}
function play(on) {
  playing = on; before = null;
  $("play").textContent = on ? "Pause" : "Play";
  if (on) { if (now >= last) now = first; requestAnimationFrame(step); }
}
function go(t) { now = Math.min(last, Math.max(first, t)); draw(); }
$("play").addEventListener("click", () => play(!playing));
$("time").addEventListener("input", () => { play(false); go(Number($("time").value)); });
$("trails").addEventListener("change", draw);
if ($("forces")) $("forces").addEventListener("change", draw);
if ($("turn")) $("turn").addEventListener("input", () => { turn = Number($("turn").value); draw(); });
document.querySelectorAll("[data-t]").forEach((b) => b.addEventListener("click", () => { play(false); go(Number(b.dataset.t)); }));
document.addEventListener("keydown", (event) => {
  if (event.target.closest("button, input, select, summary")) return;
  const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (event.key === " ") { event.preventDefault(); play(!playing); }
  if (by) { play(false); go(now + (by * (last - first)) / 100); }
});
const start = /^#t=([\d.]+)$/.exec(location.hash); // page.html#t=2.5 opens at that time
go(start ? Number(start[1]) : first);
