"use strict";
// Frequency response functions, and the response to unbalance with its orbits.

const FRF_VIEWS = ["magnitude and phase", "real and imaginary part", "Nyquist"];

/** Chosen FRFs of a study, path "frf". */
function frfView(results) {
  const response = results.set("frf/response");
  const frequency = Array.from(results.values("frf/frequency"));
  const [count, inputs, length] = response.shape;
  const outputs = results.values("frf/responses");
  const excitations = results.values("frf/excitations");
  const units = results.values("frf/units");
  const quantity = results.attribute("frf", "quantity") ?? "FRF";
  const shown = { view: 0, pairs: new Set([0]), decibel: false };
  const pairName = (k) => `${outputs[Math.floor(k / inputs)]} / ${excitations[k % inputs]}`;
  const pair = (k) => response.values.subarray(2 * k * length, 2 * (k + 1) * length);
  const colour = new Map();
  const styleOf = (k) => {
    if (!colour.has(k)) colour.set(k, colour.size);
    return curveStyle(colour.get(k));
  };
  const unitsShown = () => [...new Set([...shown.pairs].map((k) => units?.[k]).filter(Boolean))].join(", ");
  const draw = () => {
    const unit = unitsShown();
    const data = [];
    for (const k of [...shown.pairs].sort((a, b) => a - b)) {
      const values = pair(k);
      const name = escapeText(pairName(k));
      const line = { ...styleOf(k), width: 1.6 };
      const unitOf = escapeText(units?.[k] ?? "");
      const part = (offset) => Array.from({ length }, (_, i) => values[2 * i + offset]);
      if (shown.view === 2) {
        data.push({ x: part(0), y: part(1), customdata: frequency, mode: "lines", name, line, hovertemplate: `${name}<br>%{customdata:.5~g} Hz: <b>%{x:.4~g} %{y:+.4~g} j</b> ${unitOf}<extra></extra>` });
        continue;
      }
      const [first, second] = shown.view === 0 ? [magnitude(values), phaseDegrees(values)] : [part(0), part(1)];
      const words = shown.view === 0 ? ["", "°"] : ["real part", "imaginary part"];
      data.push({ x: frequency, y: first, mode: "lines", name, line, legendgroup: name, hovertemplate: `${name} ${words[0]}<br>%{x:.5~g} Hz: <b>%{y:.5~g}</b> ${unitOf}<extra></extra>` });
      data.push({ x: frequency, y: second, yaxis: "y2", mode: "lines", name, line, legendgroup: name, showlegend: false, hovertemplate: `${name}<br>%{x:.5~g} Hz: <b>%{y:.5~g}</b>${shown.view === 0 ? "°" : ` ${unitOf}`}<extra></extra>` });
    }
    const label = `${quantity} [${unit || "–"}]`;
    if (shown.view === 2) {
      return { data, layout: { xaxis: axis(`real part, ${label}`), yaxis: axis("imaginary part", { scaleanchor: "x" }) } };
    }
    const upper = shown.view === 0 ? axis(label, { type: "log", domain: [0.38, 1] }) : axis(`real part [${unit || "–"}]`, { domain: [0.54, 1] });
    const lower = shown.view === 0 ? axis("phase [°]", { domain: [0, 0.3], tickvals: [-180, -90, 0, 90, 180], range: [-190, 190] }) : axis("imaginary part", { domain: [0, 0.46] });
    return { data, layout: { xaxis: axis("frequency [Hz]", { anchor: "y2" }), yaxis: upper, yaxis2: lower } };
  };
  const made = chart("Frequency response functions of the chosen pairs of response and excitation.", 520, draw);
  const boxes = make("fieldset", { class: "pairs" }, make("legend", {}, "Response / excitation"));
  for (let k = 0; k < count * inputs; k++) {
    boxes.append(checkBox(pairName(k), shown.pairs.has(k), (on) => {
      if (on) shown.pairs.add(k);
      else shown.pairs.delete(k);
      made.update();
    }));
  }
  const controls = make("div", { class: "controls" }, select("Show", FRF_VIEWS, 0, (view) => { shown.view = view; made.update(); }));
  const rpm = results.attribute("frf", "rpm");
  return [make("p", {}, `${count * inputs} FRFs (${quantity}) at ${digits(rpm)} rpm.`), controls, boxes, made.node];
}

/** Unbalance response over speed, with the orbits at the cursor. */
function unbalanceView(results) {
  const rpm = Array.from(results.values("unbalance/rpm"));
  const names = results.setNames("unbalance/channels");
  const orbitNames = results.items("unbalance/orbits", "x");
  const shown = { channels: new Set(names.slice(0, 2)), at: rpm.length - 1 };
  const set = (name) => results.set(`unbalance/channels/${name}`);
  const draw = () => {
    const data = [];
    const units = [...new Set([...shown.channels].map((name) => shownUnit(set(name).unit).unit))];
    names.forEach((name, k) => {
      if (!shown.channels.has(name)) return;
      const line = { ...curveStyle(k), width: 1.6 };
      const as = shownUnit(set(name).unit);
      const unit = escapeText(as.unit);
      const safe = escapeText(name);
      data.push({ x: rpm, y: scaled(magnitude(set(name).values), as.factor), mode: "lines", name: safe, line, legendgroup: safe, hovertemplate: `${safe}<br>%{x:.5~g} rpm: <b>%{y:.5~g}</b> ${unit}<extra></extra>` });
      data.push({ x: rpm, y: phaseDegrees(set(name).values), yaxis: "y2", mode: "lines", name: safe, line, legendgroup: safe, showlegend: false, hovertemplate: `${safe}<br>%{x:.5~g} rpm: <b>%{y:.5~g}°</b><extra></extra>` });
    });
    const x = rpm[shown.at];
    const cursor = { type: "line", x0: x, x1: x, xref: "x", yref: "paper", y0: 0, y1: 1, line: { color: colours().muted, width: 1 } };
    return {
      data,
      layout: {
        shapes: [cursor], xaxis: axis("shaft speed [rpm]", { anchor: "y2" }), yaxis: axis(`amplitude [${units.join(", ") || "–"}]`, { type: "log", domain: [0.38, 1] }),
        yaxis2: axis("phase [°]", { domain: [0, 0.3], tickvals: [-180, -90, 0, 90, 180], range: [-190, 190] }),
      },
    };
  };
  const bode = chart("Response to unbalance: amplitude and phase over shaft speed. Click to place the cursor of the orbits.", 520, draw, { click: (point) => move(nearest(rpm, point.x)) });
  const drawOrbits = () => {
    const data = orbitNames.flatMap((name, k) => {
      const [x, y] = ["x", "y"].map((d) => results.values(`unbalance/orbits/${name}/${d}`).subarray(2 * shown.at, 2 * shown.at + 2));
      const angle = Array.from({ length: 97 }, (_, i) => (i * Math.PI) / 48);
      const along = ([re, im]) => angle.map((a) => 1e6 * (re * Math.cos(a) - im * Math.sin(a)));
      const line = { ...curveStyle(k), width: 1.8 };
      const safe = escapeText(name);
      return [
        { x: along(x), y: along(y), mode: "lines", name: safe, legendgroup: safe, line, hovertemplate: `${safe}: %{x:.4~g}, %{y:.4~g} µm<extra></extra>` },
        { x: [1e6 * x[0]], y: [1e6 * y[0]], mode: "markers", legendgroup: safe, showlegend: false, marker: { color: line.color, size: 8 }, hovertemplate: `${safe} at the key phase<extra></extra>` },
      ];
    });
    return { data, layout: { xaxis: axis("x [µm]"), yaxis: axis("y [µm]", { scaleanchor: "x" }) } };
  };
  const orbits = orbitNames.length ? chart("Orbits at the cursor's speed; the dot is the position when the key phase mark passes.", 420, drawOrbits) : null;
  const cursor = slider("Speed", rpm.length, shown.at, (k) => `${digits(rpm[k])} rpm`, (k) => move(k));
  const move = (k) => {
    shown.at = k;
    cursor.set(k);
    bode.update();
    orbits?.update();
  };
  const boxes = make("fieldset", { class: "pairs" }, make("legend", {}, "Responses"));
  names.forEach((name) => boxes.append(checkBox(name, shown.channels.has(name), (on) => {
    if (on) shown.channels.add(name);
    else shown.channels.delete(name);
    bode.update();
  })));
  const peakTable = peaksTable(results, set);
  return [boxes, bode.node, make("div", { class: "controls" }, cursor.node), orbits?.node, peakTable].filter(Boolean);
}

/** Peaks of the responses, each in the unit of its response; orbits are displacements. */
function peaksTable(results, channel) {
  const read = (name) => Array.from(results.values(`unbalance/peaks/${name}`) ?? []);
  const responses = read("response");
  if (!responses.length) return null;
  const as = responses.map((name) => shownUnit(name.startsWith("orbit of") ? "m" : channel(name)?.unit));
  const columns = [
    { name: "response", values: responses }, { name: "speed", unit: "rpm", values: read("rpm") },
    { name: "amplitude", values: read("amplitude").map((a, k) => a * as[k].factor), digits: 4 }, { name: "unit", values: as.map((u) => u.unit) },
    { name: "amplification factor", values: read("amplification_factor"), digits: 3 },
  ];
  return table("Peaks of the response", columns.filter((c) => c.values.length));
}
