"use strict";
// Campbell diagram with its branches' values and shapes at a chosen speed.

/** The Campbell diagram, damping below it, the modes at the cursor; `shapes` is the viewer of mode shapes or null. */
function campbellView(results, shapes) {
  const frequency = results.set("campbell/frequency");
  const rpm = Array.from(results.values("campbell/rpm"));
  const [branches, speeds] = frequency.shape;
  const labels = results.values("campbell/label");
  const kinds = results.values("campbell/kind");
  const dampings = results.set("campbell/log_dec");
  const zetas = results.set("campbell/zeta");
  const named = results.set("campbell/labels");
  const orders = results.values("campbell/orders/order") ?? [];
  const orderLabels = results.values("campbell/orders/label") ?? [];
  const shown = { orders: true, speed: speeds - 1, branch: 0 };
  const top = Math.max(...rpm);
  const highest = frequency.values.reduce((m, v) => (v > m ? v : m), 0) || 1;
  // The order lines' range shows the crossings; the whole range is a double click away.
  const ofOrders = Math.max(...Array.from(orders, (order) => (order * top) / 60), 0);
  const upper = ofOrders > 0 ? Math.min(highest, Math.max(1.15 * ofOrders, 2 * Math.min(...firstOf(frequency)))) : highest;

  // Range of the decrements of the branches that the upper diagram shows.
  const dampingRange = () => {
    const inside = Array.from(dampings.values).filter((d, k) => Number.isFinite(d) && frequency.values[k] <= upper * 1.06);
    const [low, high] = [Math.min(...inside, 0), Math.max(...inside, 0)];
    const room = 0.08 * (high - low || 1);
    return [low < 0 ? low - room : 0, high + room];
  };
  const draw = () => {
    const data = [];
    const kindsShown = new Set();
    for (let b = 0; b < branches; b++) {
      const style = whirlStyle(kinds[b]);
      const common = { x: rpm, mode: "lines+markers", line: { color: style.color, width: b === shown.branch ? 3 : 1.6 }, marker: { symbol: style.symbol, size: 7 }, name: escapeText(kindName(kinds[b])), legendgroup: kindName(kinds[b]), showlegend: false };
      const at = Array.from({ length: speeds }, (_, s) => {
        const k = b * speeds + s;
        return [digits(zetas.values[k] * 100, 3), digits(dampings.values[k], 4), named?.values[k] || labels[b]];
      });
      const first = !kindsShown.has(common.legendgroup);
      kindsShown.add(common.legendgroup);
      data.push({
        ...common, showlegend: first, y: Array.from(rowOf(frequency, b)), customdata: at, meta: b,
        hovertemplate: "%{customdata[2]}<br>%{x:.5~g} rpm: <b>%{y:.5~g} Hz</b><br>damping ratio %{customdata[0]} %<br>log decrement %{customdata[1]}<extra></extra>",
      });
      data.push({ ...common, y: Array.from(rowOf(dampings, b)), yaxis: "y2", meta: b, hovertemplate: `${escapeText(labels[b])}<br>%{x:.5~g} rpm: log decrement %{y:.4~g}<extra></extra>` });
    }
    const annotations = [];
    const ends = [];
    for (let b = 0; b < branches; b++) {
      const y = frequency.values[b * speeds + speeds - 1];
      if (y <= upper * 1.06) ends.push({ y, text: labels[b], color: whirlStyle(kinds[b]).color });
    }
    if (shown.orders) {
      orders.forEach((order, k) => {
        const ball = !/^[\d.]+x$/.test(orderLabels[k]);
        const end = Math.min(top, (upper * 1.04 * 60) / order);
        data.push({
          x: [0, end], y: [0, (order * end) / 60], mode: "lines", name: orderLabels[k], showlegend: false,
          line: { color: ball ? colours().orange : colours().muted, width: 1, dash: ball ? "dashdot" : "dash" }, hovertemplate: `${escapeText(orderLabels[k])} (order ${digits(order)})<extra></extra>`,
        });
        if (end < top) annotations.push({ x: end, y: (order * end) / 60, text: escapeText(orderLabels[k]), showarrow: false, xanchor: "center", yanchor: "bottom", font: { color: colours().muted, size: 11 } });
        else ends.push({ y: (order * end) / 60, text: orderLabels[k], color: colours().muted });
      });
      const critical = results.values("campbell/crossings/rpm");
      if (critical?.length) {
        const text = Array.from(critical, (_, k) => `${escapeText(results.values("campbell/crossings/label")[k])}, order ${digits(results.values("campbell/crossings/order")[k])}`);
        data.push({
          x: Array.from(critical), y: Array.from(results.values("campbell/crossings/frequency")), text, mode: "markers", name: "critical speed",
          marker: { color: "#ffd34d", size: 9, line: { color: "#202024", width: 1.5 } }, hovertemplate: "critical speed <b>%{x:.5~g} rpm</b>, %{y:.5~g} Hz<br>%{text}<extra></extra>",
        });
      }
    }
    annotations.push(...spread(ends, upper * 1.06, 0.04).map(({ y, at, text, color }) => ({ x: top, y, ax: 26, ay: at, axref: "pixel", ayref: "y", text: escapeText(text), showarrow: true, arrowwidth: 0.7, arrowcolor: colours().muted, arrowhead: 0, xanchor: "left", align: "left", font: { color, size: 11 } })));
    const at = rpm[shown.speed];
    const cursor = { type: "line", x0: at, x1: at, xref: "x", yref: "paper", y0: 0, y1: 1, line: { color: colours().muted, width: 1 } };
    return {
      data,
      layout: {
        xaxis: axis("shaft speed [rpm]", { anchor: "y2", range: [0, top] }), yaxis: axis("natural frequency [Hz]", { domain: [0.3, 1], range: [0, upper * 1.06] }),
        yaxis2: axis("log decrement", { domain: [0, 0.22], range: dampingRange() }), annotations, shapes: [cursor], margin: { l: 70, r: 170, t: 36, b: 48 },
      },
    };
  };
  const diagram = chart("Campbell diagram: natural frequencies and logarithmic decrements over shaft speed, with order lines and the critical speeds where they cross. Hover a branch for its values; click it for its shape.", 620, draw, {
    click: (point) => {
      if (point.data.meta === undefined) return;
      choose(point.data.meta, nearest(rpm, point.x));
    },
  });
  const listed = make("div");
  const speed = slider("Speed", speeds, shown.speed, (k) => `${digits(rpm[k])} rpm`, (k) => choose(shown.branch, k));
  const choose = (branch, at) => {
    shown.branch = branch;
    shown.speed = at;
    speed.set(at);
    diagram.update();
    list();
    shapes?.showBranch(branch, at);
  };
  const list = () => {
    const present = Array.from({ length: branches }, (_, b) => b).filter((b) => !Number.isNaN(frequency.values[b * speeds + shown.speed]));
    const of = (set) => present.map((b) => set.values[b * speeds + shown.speed]);
    const columns = [
      { name: "mode", values: present.map((b) => labels[b]) },
      { name: "kind", values: present.map((b) => kinds[b]) },
      { name: "frequency", unit: "Hz", values: of(frequency) },
      { name: "damping ratio", unit: "%", values: of(zetas).map((z) => 100 * z) },
      { name: "log decrement", values: of(dampings) },
    ];
    listed.replaceChildren(table(`Modes at ${digits(rpm[shown.speed])} rpm`, columns, { digits: 4, mark: (r) => present[r] === shown.branch }));
  };
  list();
  const modes = Array.from(labels);
  const controls = make("div", { class: "controls" }, select("Mode", modes, 0, (b) => choose(b, shown.speed)), speed.node, checkBox("order lines", true, (on) => { shown.orders = on; diagram.update(); }));
  return [controls, diagram.node, listed];
}

/** Branches of one look in the legend. */
function kindName(kind) {
  const name = Object.keys(WHIRL).find((word) => kind?.includes(word));
  return { forward: "forward whirl", backward: "backward whirl" }[name] ?? name ?? "other";
}

/** First frequency of every branch. */
function firstOf(frequency) {
  return Array.from({ length: frequency.shape[0] }, (_, b) => rowOf(frequency, b).find((f) => f > 0) ?? Infinity);
}

/** Places `at` for labels at the heights y, at least a share of the range apart. */
function spread(ends, range, share) {
  const sorted = ends.sort((a, b) => a.y - b.y).map((end) => ({ ...end, at: end.y }));
  for (let turn = 0; turn < 60; turn++) {
    for (let k = 1; k < sorted.length; k++) {
      const lack = share * range - (sorted[k].at - sorted[k - 1].at);
      if (lack > 0) {
        sorted[k].at += lack / 2;
        sorted[k - 1].at -= lack / 2;
      }
    }
    sorted.forEach((end) => (end.at = Math.max(end.at, 0.005 * range)));
  }
  return sorted;
}

/** Text for Plotly, which reads some markup. */
function escapeText(text) {
  return String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
}

/** Critical speeds of the study, with what API 684 asks of them where the results hold it. */
function criticalView(results) {
  const column = (name, path, unit, more = {}) => ({ name, unit, values: Array.from(results.values(path) ?? []), ...more });
  const path = results.group("critical_speeds") ? "critical_speeds" : "campbell/crossings";
  const columns = [
    column("speed", `${path}/rpm`, "rpm"), column("order", `${path}/order`, ""), column("frequency", `${path}/frequency`, "Hz"),
    column("mode", `${path}/label`, ""), column("whirl", `${path}/whirl`, ""), column("log decrement", `${path}/log_dec`, "", { digits: 3 }),
  ].filter((c) => c.values.length);
  return columns.length ? [table("Critical speeds", columns)] : [];
}
