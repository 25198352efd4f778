"use strict";
// Charts of a ball bearing: load around it, contacts by ball, sweeps.

function bearingCharts(source) {
  const loads = source.values("operating/balls/outer/load");
  if (!loads.length) return [];
  const sweeps = Object.keys(source.group("")?.groups ?? {}).filter((name) => name.startsWith("sweep_"));
  const first = ["sweep_load", "sweep_speed"];
  const drawn = [...first.filter((name) => sweeps.includes(name)), ...sweeps.filter((name) => !first.includes(name))];
  return [loadChart(source), ballChart(source), ...drawn.map((name) => sweepChart(source, name))].filter(Boolean).map((made) => made.node);
}

/** Load of every ball as a bar around the bearing, seen along the axis: x to the right, y up. */
function loadChart(source) {
  const balls = (name) => source.values(`operating/balls/${name}`);
  const [position, inner, outer, row] = [balls("position"), balls("inner/load"), balls("outer/load"), balls("row")];
  const rows = Math.max(...row, 0) + 1;
  const largest = Math.max(...inner, ...outer, 0) || 1;
  const force = source.values("operating/load");
  const draw = () => {
    const c = colours();
    const circle = Array.from({ length: 121 }, (_, k) => (k * Math.PI) / 60);
    const data = [];
    const annotations = [];
    for (let r = 0; r < rows; r++) {
      const dx = 3.9 * r;
      for (const radius of [0.8, 1.2]) data.push({ x: circle.map((a) => dx + radius * Math.cos(a)), y: circle.map((a) => radius * Math.sin(a)), mode: "lines", line: { color: c.muted, width: 1 }, hoverinfo: "skip", showlegend: false });
      const here = position.map((_, k) => k).filter((k) => row[k] === r);
      for (const [name, loads, from, sign, colour] of [["outer race", outer, 1.24, 1, c.blue], ["inner race", inner, 0.76, -1, c.red]]) {
        const [x, y] = [[], []];
        for (const k of here) {
          const to = from + (sign * 0.55 * loads[k]) / largest;
          const [cos, sin] = [Math.cos(position[k]), Math.sin(position[k])];
          x.push(dx + from * cos, dx + to * cos, null);
          y.push(from * sin, to * sin, null);
        }
        data.push({ x, y, mode: "lines", name, line: { color: colour, width: 6 }, hoverinfo: "skip", showlegend: r === 0 });
      }
      const degrees = (k) => digits((position[k] * 180) / Math.PI, 4);
      data.push({
        x: here.map((k) => dx + Math.cos(position[k])), y: here.map((k) => Math.sin(position[k])), mode: "markers", showlegend: false,
        marker: { size: 13, color: here.map((k) => (outer[k] > 0 ? c.blue : c.paper)), line: { color: c.ink, width: 1 } },
        text: here.map((k) => `ball at ${degrees(k)}°<br>inner race <b>${digits(inner[k])} N</b><br>outer race <b>${digits(outer[k])} N</b>`), hovertemplate: "%{text}<extra></extra>",
      });
      const size = Math.hypot(force[0], force[1]);
      if (size > 0) annotations.push({ x: dx + (0.5 * force[0]) / size, y: (0.5 * force[1]) / size, ax: dx, ay: 0, xref: "x", yref: "y", axref: "x", ayref: "y", showarrow: true, arrowhead: 2, arrowwidth: 2, arrowcolor: c.ink, text: "" });
      if (rows > 1) annotations.push({ x: dx, y: 1.95, text: `row ${r + 1}`, showarrow: false, font: { color: c.ink } });
    }
    const hidden = { visible: false, range: [-2, 2 + 3.9 * (rows - 1)] };
    return { data, layout: { annotations, xaxis: { ...hidden }, yaxis: { visible: false, range: [-2, 2], scaleanchor: "x" }, margin: { l: 10, r: 10, t: 36, b: 10 } } };
  };
  return chart(`Load of every ball at its races, seen against the z axis with x to the right and y up; longest bar ${digits(largest, 4)} N. The arrow is the radial load of the shaft. Hover a ball for its loads.`, 400, draw);
}

/** Panels below each other or side by side over one abscissa; panels: [{ name, unit, curves: [{ name, y }] }]. */
function panelChart(caption, xTitle, x, panels, { mark, range } = {}) {
  const columns = innerWidth < 640 || panels.length === 1 ? 1 : 2;
  const rows = Math.ceil(panels.length / columns);
  const height = 60 + 210 * rows;
  const draw = () => {
    const data = [];
    const layout = { shapes: [], margin: { l: 62, r: 14, t: 40, b: 46 } };
    const [wide, gap] = [1 / columns, 0.11];
    const named = new Set();
    panels.forEach((panel, p) => {
      const id = p === 0 ? "" : String(p + 1);
      const [column, row] = [p % columns, Math.floor(p / columns)];
      const across = [column * wide + (column > 0 ? gap / 2 : 0), (column + 1) * wide - (column < columns - 1 ? gap / 2 : 0)];
      const up = [1 - (row + 1) / rows + (row < rows - 1 ? 0.32 / rows : 0), 1 - row / rows];
      const lowest = p + columns >= panels.length;
      const yRange = panel.curves.some((curve) => curve.y.some((v) => v < 0)) || panel.free ? {} : { rangemode: "tozero" };
      layout[`xaxis${id}`] = axis(lowest ? xTitle : "", { domain: across, anchor: `y${id}`, ...(range ? { range } : {}) });
      layout[`yaxis${id}`] = axis(`${panel.name}${panel.unit ? ` [${panel.unit}]` : ""}`, { domain: up, anchor: `x${id}`, title: { text: `${panel.name}${panel.unit ? ` [${panel.unit}]` : ""}`, standoff: 4, font: { size: 12 } }, ...(panel.log ? { type: "log" } : yRange) });
      panel.curves.forEach((curve, k) => {
        const style = curveStyle(k);
        data.push({
          x, y: curve.y, xaxis: `x${id}`, yaxis: `y${id}`, name: curve.name ?? panel.name, legendgroup: curve.name ?? panel.name, showlegend: Boolean(curve.name) && !named.has(curve.name),
          mode: panel.points ? "markers" : "lines", line: { ...style, width: 1.8 }, marker: { color: style.color, size: 8, symbol: k ? "square" : "circle" },
          hovertemplate: `${escapeText(curve.name ?? panel.name)}<br>%{x:.5~g}: <b>%{y:.5~g}</b> ${escapeText(panel.unit)}<extra></extra>`,
        });
        if (curve.name) named.add(curve.name);
      });
      if (mark !== undefined) layout.shapes.push({ type: "line", x0: mark, x1: mark, xref: `x${id}`, yref: `y${id} domain`, y0: 0, y1: 1, line: { color: colours().muted, width: 1, dash: "dash" } });
    });
    return { data, layout };
  };
  return chart(caption, height, draw);
}

/** Contact angle, pressure and film of every loaded ball over its position. */
function ballChart(source) {
  const balls = (name) => source.values(`operating/balls/${name}`);
  // From -180° to 180°.
  const position = balls("position").map((a) => (Math.atan2(Math.sin(a), Math.cos(a)) * 180) / Math.PI);
  const both = (name, factor) => ["inner", "outer"].map((race) => {
    const load = balls(`${race}/load`);
    return { name: `${race} race`, y: balls(`${race}/${name}`).map((v, k) => (load[k] > 0 ? v * factor : null)) };
  });
  const panels = [
    { name: "contact angle", unit: "°", curves: both("contact_angle", 180 / Math.PI), points: true, free: true },
    { name: "pressure", unit: "GPa", curves: both("pressure", 1e-9), points: true },
  ];
  if (balls("outer/film").some((v) => v > 0)) {
    panels.push({ name: "central film", unit: "µm", curves: both("film", 1e6), points: true }, { name: "minimum film", unit: "µm", curves: both("minimum_film", 1e6), points: true });
  }
  const shown = panels.filter((panel) => panel.curves.some((curve) => curve.y.some(Number.isFinite)));
  return shown.length ? panelChart("Contacts of the loaded balls over their position from x to y.", "position [°]", position, shown, { range: [-185, 185] }) : null;
}

/** Value of the most loaded ball at every point of a sweep; null without load. */
function ofMostLoaded(source, sweep, race, name, factor) {
  const [outer, load, set] = ["outer/load", `${race}/load`, `${race}/${name}`].map((path) => source.set(`${sweep}/balls/${path}`));
  if (!set) return [];
  const [points, balls] = set.shape;
  return Array.from({ length: points }, (_, p) => {
    let heaviest = p * balls;
    for (let k = p * balls; k < (p + 1) * balls; k++) if (outer.values[k] > outer.values[heaviest]) heaviest = k;
    return load.values[heaviest] > 0 ? set.values[heaviest] * factor : null;
  });
}

const SWEPT = { N: ["N", 1], m: ["µm", 1e6], rad: ["mrad", 1e3], "N m": ["N·m", 1] };

/** Stiffness, contacts, friction and life over a swept quantity. */
function sweepChart(source, sweep) {
  const set = source.set(`${sweep}/swept_value`);
  if (!set || set.values.length < 2) return null;
  const kind = sweep.slice("sweep_".length);
  const [unit, factor] = { speed: ["rpm", 30 / Math.PI], cage_angle: ["°", 180 / Math.PI] }[kind] ?? SWEPT[set.unit] ?? [set.unit, 1];
  const label = { speed: "shaft speed", cage_angle: "cage angle" }[kind] ?? source.attribute(sweep, "label") ?? kind.replace("_", " ");
  const values = (name, by = 1) => source.values(`${sweep}/${name}`).map((v) => v * by);
  const race = (name, by) => ["inner", "outer"].map((which) => ({ name: `${which} race`, y: ofMostLoaded(source, sweep, which, name, by) }));
  const panels = [
    { name: "stiffness", unit: "N/µm", curves: [{ name: "radial", y: values("radial_stiffness", 1e-6) }, { name: "axial", y: values("axial_stiffness", 1e-6) }] },
    { name: "pressure", unit: "GPa", curves: race("pressure", 1e-9) },
    { name: "contact angle", unit: "°", curves: race("contact_angle", 180 / Math.PI), free: true },
    { name: "friction torque", unit: "N·m", curves: [{ y: values("friction_torque") }] },
    { name: "minimum film", unit: "µm", curves: race("minimum_film", 1e6) },
    { name: "life", unit: "10⁶ rev.", log: true, curves: [{ name: "basic L₁₀", y: values("basic_life") }, { name: "reference L₁₀ᵣ", y: values("reference_life") }] },
  ];
  const counts = (y) => y.some((v) => Number.isFinite(v) && v !== 0);
  const shown = panels.map((panel) => ({ ...panel, curves: panel.curves.filter((curve) => counts(curve.y)) })).filter((panel) => panel.curves.length);
  if (!shown.length) return null;
  const mark = { speed: source.point("speed"), cage_angle: source.point("cage_angle") }[kind];
  return panelChart(
    `Stiffness, and contacts of the most loaded ball, over ${label}.${mark === undefined ? "" : " Dashed: the operating point."}`, `${label} [${unit}]`, Array.from(set.values, (v) => v * factor), shown,
    { mark: mark === undefined ? undefined : mark * factor },
  );
}
