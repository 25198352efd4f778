"use strict";
// Charts: colours that differ in lightness, dashes and symbols as well, so that they read in grey; light and dark.

const LIGHT = { ink: "#202024", muted: "#5c5c62", grid: "#e7e7eb", paper: "#ffffff", blue: "#1962b5", red: "#cc2a2a", green: "#00805c", purple: "#8042ac", orange: "#b85c08" };
const DARK = { ink: "#ececf0", muted: "#a9a9b2", grid: "#3a3a42", paper: "#1c1c20", blue: "#6aaef5", red: "#ff7d74", green: "#4cc79b", purple: "#c695ea", orange: "#f2a254" };
const CURVE_COLOURS = ["blue", "red", "ink", "green", "purple", "orange"];
const DASHES = ["solid", "longdash", "dashdot", "dot"];
const WHIRL = { forward: ["blue", "triangle-up"], backward: ["red", "triangle-down"], torsional: ["green", "diamond"], axial: ["purple", "square"] };

/** Width of a printed page between its margins, 182 mm, in CSS pixels. */
const PRINTED_WIDTH = 688;

const charts = [];
let darkNow = false;
let printing = false;

function colours() {
  return darkNow ? DARK : LIGHT;
}

/** Colour, dash of curve number k. */
function curveStyle(k) {
  return { color: colours()[CURVE_COLOURS[k % 6]], dash: DASHES[k % 4] };
}

/** Colour and symbol of a branch by its kind, "forward whirl" … */
function whirlStyle(kind) {
  const name = Object.keys(WHIRL).find((word) => kind?.includes(word));
  const [colour, symbol] = WHIRL[name] ?? ["ink", "circle"];
  return { color: colours()[colour], symbol };
}

/** Unit in which a quantity is shown, and its factor. */
function shownUnit(unit) {
  const other = { m: ["µm", 1e6], "m/s": ["mm/s", 1e3], "m/s^2": ["m/s²", 1], "m2/s": ["m²/s", 1] }[unit];
  return other ? { unit: other[0], factor: other[1] } : { unit: unit || "–", factor: 1 };
}

/** Values times a factor. */
function scaled(values, factor) {
  return factor === 1 ? Array.from(values) : Array.from(values, (v) => factor * v);
}

function axis(title, more = {}) {
  const c = colours();
  return {
    title: { text: title, standoff: 8 }, color: c.ink, gridcolor: c.grid, zerolinecolor: c.grid, linecolor: c.muted,
    mirror: "all", ticks: "outside", tickcolor: c.muted, automargin: true, exponentformat: "power", ...more,
  };
}

/**
 * A chart below its heading, with a caption that says what is seen.
 * draw() returns { data, layout }; it is called again by update() and when light changes to dark.
 */
function chart(caption, height, draw, { click } = {}) {
  const plot = make("div", { class: "plot", style: `height:${height}px`, role: "group", "aria-label": caption });
  const node = make("figure", { class: "chart" }, plot, make("figcaption", {}, caption));
  const render = () => {
    const { data, layout } = draw();
    const c = colours();
    const full = {
      paper_bgcolor: c.paper, plot_bgcolor: c.paper, font: { family: "system-ui, sans-serif", size: 13, color: c.ink },
      margin: { l: 70, r: 20, t: 36, b: 48 }, hovermode: "closest", legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0 },
      hoverlabel: { bgcolor: c.paper, bordercolor: c.muted, font: { color: c.ink } }, modebar: { color: c.muted, activecolor: c.blue }, ...layout,
      // A cursor at a value that was not computed is not drawn.
      shapes: (layout.shapes ?? []).filter((shape) => Number.isFinite(shape.x0)),
      ...(printing ? { width: PRINTED_WIDTH } : {}),
    };
    const config = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d"] };
    return Plotly.react(plot, data, full, config);
  };
  const made = { node, plot, update: () => made.drawn && render(), drawn: false };
  made.draw = () => {
    if (made.drawn) return;
    made.drawn = true;
    render().then(() => {
      if (click) plot.on("plotly_click", (event) => click(event.points[0]));
    });
  };
  charts.push(made);
  return made;
}

/** Draws charts when they come near the window. */
function drawOnSight() {
  const watch = new IntersectionObserver(
    (entries) => entries.filter((e) => e.isIntersecting).forEach((e) => { e.target.chart.draw(); watch.unobserve(e.target); }),
    { rootMargin: "400px" },
  );
  charts.forEach((made) => { made.plot.chart = made; watch.observe(made.plot); });
}

function setDark(dark) {
  darkNow = dark;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  charts.forEach((made) => made.update());
  document.dispatchEvent(new Event("themechange"));
}

/** For paper: light, every chart drawn as wide as the page, values of the model open; then as it was. */
function fitPaper() {
  const opened = [];
  let before = false;
  addEventListener("beforeprint", () => {
    before = darkNow;
    printing = true;
    charts.forEach((made) => made.draw());
    setDark(false);
    document.querySelectorAll("details.printed:not([open])").forEach((part) => { part.open = true; opened.push(part); });
  });
  addEventListener("afterprint", () => {
    printing = false;
    opened.splice(0).forEach((part) => { part.open = false; });
    setDark(before);
  });
}

/** Amplitude and phase of pairs (re, im). */
function magnitude(pairs) {
  return Array.from({ length: pairs.length / 2 }, (_, k) => Math.hypot(pairs[2 * k], pairs[2 * k + 1]));
}

function phaseDegrees(pairs) {
  return Array.from({ length: pairs.length / 2 }, (_, k) => (Math.atan2(pairs[2 * k + 1], pairs[2 * k]) * 180) / Math.PI);
}

/** A level map's limits: 70 dB below its maximum. */
function decibels(values) {
  let top = 0;
  for (const v of values) if (v > top) top = v;
  const floor = top * 10 ** (-70 / 20);
  return { top, of: (v) => (top > 0 ? 20 * Math.log10(Math.max(v, floor) / top) : -70) };
}
