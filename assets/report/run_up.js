"use strict";
// Run-up: time histories, spectra over speed with a cursor, order cuts.

/** Axis of the frames: speed where it rises or falls all along, but for a constant end; else time. `kept`: the frames shown. */
function frameAxis(rpm, time) {
  const sign = rpm[rpm.length - 1] >= rpm[0] ? 1 : -1;
  const step = (1e-3 * Math.abs(rpm[rpm.length - 1] - rpm[0])) / Math.max(rpm.length, 1);
  const monotonic = rpm.every((v, k) => k === 0 || sign * (v - rpm[k - 1]) >= -step);
  const kept = rpm.map((_, k) => k).filter((k) => k === 0 || sign * (rpm[k] - rpm[k - 1]) > step);
  if (monotonic && kept.length > 0.5 * rpm.length) return { values: kept.map((k) => rpm[k]), kept, title: "shaft speed [rpm]", unit: "rpm" };
  return { values: time, kept: rpm.map((_, k) => k), title: "time [s]", unit: "s" };
}

/** Maps that a channel may have. */
const MAPS = ["spectrogram", "orders"];

/** Spectrogram and order map of one channel with the spectrum at the cursor. */
function spectraView(results) {
  const names = results.items("spectra", ...MAPS);
  const kinds = [["spectrogram", "frequency", "Hz"], ["orders", "order", "1/revolution"]].filter(([kind]) => names.some((n) => results.group(`spectra/${n}/${kind}`)));
  const shown = { channel: 0, kind: 0, at: 0, lines: true };
  const data = () => {
    const [kind, across, unit] = kinds[shown.kind];
    const path = `spectra/${names[shown.channel]}/${kind}`;
    const map = results.set(`${path}/amplitude`);
    if (!map) return null;
    const rpm = Array.from(results.values(`${path}/rpm`));
    const frames = frameAxis(rpm, Array.from(results.values(`${path}/time`)));
    return { kind, unit, map, rpm, frames, across: Array.from(results.values(`${path}/${across}`)), title: kind === "orders" ? "order" : "frequency [Hz]", length: map.shape[1] };
  };
  const frameCount = () => data()?.frames.kept.length ?? 1;
  const overlays = (d) => {
    if (!shown.lines || d.frames.unit !== "rpm" || d.kind !== "spectrogram") return [];
    const top = d.across[d.across.length - 1];
    const out = [];
    const frequency = results.set("campbell/frequency");
    if (frequency) {
      const rpm = Array.from(results.values("campbell/rpm"));
      for (let b = 0; b < frequency.shape[0]; b++) {
        const y = Array.from(rowOf(frequency, b), (f) => (f <= top ? f : null));
        const label = escapeText(results.values("campbell/label")[b]);
        out.push({ x: rpm, y, mode: "lines", name: label, showlegend: false, line: { color: "#ffffff", width: 1.2, dash: DASHES[b % 4] }, hovertemplate: `${label}<br>%{x:.5~g} rpm: %{y:.5~g} Hz<extra></extra>` });
      }
    }
    const orders = results.values("campbell/orders/order") ?? [];
    const [low, high] = [Math.min(...d.rpm), Math.max(...d.rpm)];
    Array.from(orders).forEach((order, k) => {
      const x = [low, Math.min(high, (top * 60) / order)];
      if (x[1] > x[0]) out.push({ x, y: x.map((v) => (v * order) / 60), mode: "lines", showlegend: false, line: { color: "#ffd34d", width: 1, dash: "dot" }, hovertemplate: `${escapeText(results.values("campbell/orders/label")[k])}<extra></extra>` });
    });
    return out;
  };
  const draw = () => {
    const d = data();
    if (!d) return { data: [], layout: {} };
    const level = decibels(d.map.values);
    const z = d.across.map((_, line) => d.frames.kept.map((frame) => level.of(d.map.values[frame * d.length + line])));
    const shownAs = shownUnit(d.map.unit);
    const heat = { type: "heatmap", x: d.frames.values, y: d.across, z, colorscale: "Cividis", zmin: -70, zmax: 0, zsmooth: "fast", colorbar: { title: { text: `dB re ${digits(level.top * shownAs.factor, 3)} ${escapeText(shownAs.unit)}`, side: "right" } }, hovertemplate: `%{x:.5~g} ${d.frames.unit}, %{y:.5~g}: %{z:.1f} dB<extra></extra>` };
    const at = d.frames.values[shown.at];
    const cursor = { type: "line", x0: at, x1: at, xref: "x", yref: "paper", y0: 0, y1: 1, line: { color: "#ffffff", width: 1.5 } };
    return { data: [heat, ...overlays(d)], layout: { xaxis: axis(d.frames.title), yaxis: axis(d.title, { range: [d.across[0], d.across[d.across.length - 1]] }), shapes: [cursor], showlegend: false } };
  };
  const map = chart("Spectra of the run-up with the natural frequencies (white) and order lines (yellow) of the linear Campbell diagram. Click to place the cursor.", 520, draw, {
    click: (point) => move(nearest(data().frames.values, point.x)),
  });
  const drawSpectrum = () => {
    const d = data();
    if (!d) return { data: [], layout: {} };
    const as = shownUnit(d.map.unit);
    const frame = d.frames.kept[shown.at];
    const y = scaled(d.map.values.subarray(frame * d.length, (frame + 1) * d.length), as.factor);
    const unit = escapeText(as.unit);
    return { data: [{ x: d.across, y, mode: "lines", line: { color: colours().blue, width: 1.5 }, hovertemplate: `%{x:.5~g}: <b>%{y:.5~g}</b> ${unit}<extra></extra>` }], layout: { xaxis: axis(d.title), yaxis: axis(`amplitude [${unit}]`, { type: "log" }) } };
  };
  const spectrum = chart("Spectrum at the cursor.", 320, drawSpectrum);
  const words = (k) => {
    const d = data();
    return d ? `${digits(d.rpm[d.frames.kept[k]])} rpm` : "";
  };
  const cursorHolder = make("span");
  let cursor;
  const renew = () => {
    shown.at = Math.min(shown.at, frameCount() - 1);
    cursor = slider("Cursor", frameCount(), shown.at, words, (k) => move(k));
    cursorHolder.replaceChildren(cursor.node);
    map.update();
    spectrum.update();
  };
  const move = (k) => {
    shown.at = k;
    cursor.set(k);
    map.update();
    spectrum.update();
  };
  shown.at = Math.floor(frameCount() / 2);
  renew();
  const controls = make(
    "div", { class: "controls" }, select("Channel", names, 0, (k) => { shown.channel = k; renew(); }),
    kinds.length > 1 ? select("Over", ["frequency", "order"], 0, (k) => { shown.kind = k; renew(); }) : null,
    checkBox("linear lines", true, (on) => { shown.lines = on; map.update(); }), cursorHolder,
  );
  return [controls, map.node, spectrum.node, ...cutsView(results, names)];
}

/** Order cuts of a channel over speed. */
function cutsView(results, names) {
  const with_ = names.filter((name) => results.group(`spectra/${name}/orders/cuts`));
  if (!with_.length) return [];
  let channel = 0;
  const draw = () => {
    const path = `spectra/${with_[channel]}/orders`;
    const cuts = results.set(`${path}/cuts/rms`);
    const frames = frameAxis(Array.from(results.values(`${path}/rpm`)), Array.from(results.values(`${path}/time`)));
    const as = shownUnit(cuts.unit);
    const unit = escapeText(as.unit);
    const data = Array.from(results.values(`${path}/cuts/label`)).map((label, k) => {
      const safe = escapeText(label);
      return { x: frames.values, y: frames.kept.map((frame) => as.factor * rowOf(cuts, k)[frame]), mode: "lines", name: safe, line: { ...curveStyle(k), width: 1.6 }, hovertemplate: `${safe}<br>%{x:.5~g} ${frames.unit}: <b>%{y:.5~g}</b> ${unit} rms<extra></extra>` };
    });
    return { data, layout: { xaxis: axis(frames.title), yaxis: axis(`rms [${unit}]`, { type: "log" }) } };
  };
  const made = chart("Order cuts: root mean square of each order over the run-up.", 400, draw);
  return [make("div", { class: "controls" }, select("Channel of the order cuts", with_, 0, (k) => { channel = k; made.update(); })), made.node];
}

/** Time histories: smallest and largest value of every interval. */
function historyView(results, history) {
  let chosen = 0;
  const names = history.channels.map((c) => c.name);
  const time = history.time;
  const draw = () => {
    const c = history.channels[chosen];
    const as = shownUnit(c.unit);
    const unit = escapeText(as.unit);
    const x = [];
    const y = [];
    for (let k = 0; k < time.length; k++) {
      x.push(time[k], time[k]);
      y.push(as.factor * c.low[k], as.factor * c.high[k]);
    }
    const line = { color: colours().blue, width: 1 };
    return {
      data: [
        { x, y, mode: "lines", name: escapeText(c.name), line, hovertemplate: `%{x:.5~g} s: %{y:.5~g} ${unit}<extra></extra>` },
        { x: time, y: history.rpm, yaxis: "y2", mode: "lines", name: "speed", line: { color: colours().muted, width: 1.4 }, hovertemplate: "%{x:.5~g} s: %{y:.5~g} rpm<extra></extra>" },
      ],
      layout: { showlegend: false, xaxis: axis("time [s]", { anchor: "y2" }), yaxis: axis(`${escapeText(c.name)} [${unit}]`, { domain: [0.3, 1] }), yaxis2: axis("speed [rpm]", { domain: [0, 0.22] }) },
    };
  };
  const made = chart(history.samples > time.length ? `Time history; every line of it spans the smallest and largest of ${Math.ceil(history.samples / time.length)} samples.` : "Time history.", 420, draw);
  return [make("div", { class: "controls" }, select("Channel", names, 0, (k) => { chosen = k; made.update(); })), made.node];
}
