"use strict";
// The page: sections from what the results hold.

/** Title, condition and content of every section with charts; content returns elements. */
function sections(results, head) {
  const viewer = shapeViewer(results, head.machine);
  const further = head.figures.filter(({ name }) => !isSheet(name));
  results.sheets = Object.fromEntries(head.figures.filter(({ name }) => isSheet(name)).map(({ name, svg }) => [name, svg]));
  const has = (path) => results.set(path)?.values?.length > 0;
  return [
    ["campbell", "Campbell diagram", has("campbell/frequency"), () => [...campbellView(results, viewer), ...criticalView(results)]],
    ["shapes", "Mode shapes", Boolean(viewer), () => [viewer.node, ...modeTables(results)]],
    ["critical", "Critical speeds", !has("campbell/frequency") && has("critical_speeds/rpm"), () => criticalView(results)],
    ["frf", "Frequency responses", has("frf/response"), () => frfView(results)],
    ["unbalance", "Unbalance response", has("unbalance/rpm"), () => unbalanceView(results)],
    ["spectra", "Run-up: spectra and orders", results.items("spectra", ...MAPS).length > 0, () => spectraView(results)],
    ["history", "Run-up: time histories", head.history?.channels.length > 0, () => historyView(results, head.history)],
    ...(head.bearings ?? []).map((entry, k) => [`bearing-${k}`, `Bearing ${entry.name}`, true, () => bearingView(results, entry)]),
    ["figures", "Further figures", further.length > 0, () => further.map(staticFigure)],
    ["results", "All results", true, () => allResults(results)],
  ];
}

/** Whether a figure belongs to the page of a bearing. */
function isSheet(name) {
  return /^bearing_.*_sheet$/.test(name);
}

/** Natural frequencies of the modal study, a table for each speed. */
function modeTables(results) {
  const frequency = results.set("modes/frequency");
  if (!frequency) return [];
  const [speeds, modes] = frequency.shape;
  const rpm = results.values("modes/rpm");
  return Array.from({ length: speeds }, (_, s) => {
    const part = (name) => Array.from(results.values(`modes/${name}`) ?? []).slice(s * modes, (s + 1) * modes);
    const columns = [
      { name: "mode", values: part("label") }, { name: "kind", values: part("kind") }, { name: "frequency", unit: "Hz", values: part("frequency") },
      { name: "damping ratio", unit: "%", values: part("zeta").map((z) => 100 * z) }, { name: "log decrement", values: part("log_dec") },
    ].filter((c) => c.values.length);
    return table(`Natural frequencies at ${digits(rpm[s])} rpm`, columns);
  });
}

function staticFigure({ caption, svg }) {
  const image = make("img", { alt: caption, src: `data:image/svg+xml;base64,${btoa(unescape(encodeURIComponent(svg)))}` });
  return make("figure", { class: "chart static" }, image, make("figcaption", {}, caption));
}

/** Every group of the results: its values, and a table of its data sets of equal length. */
function allResults(results) {
  const out = [];
  const walk = (node, path) => {
    const content = groupContent(node, path, results);
    if (content.length) {
      const details = make("details", {}, make("summary", {}, path || "/"));
      details.addEventListener("toggle", () => details.childElementCount === 1 && details.append(...content.map((build) => build())));
      out.push(details);
    }
    for (const [name, child] of Object.entries(node.groups ?? {})) walk(child, path ? `${path}/${name}` : name);
  };
  walk(results.root, "");
  return [make("p", {}, "Every value of results.h5 by its path; long records and maps are drawn above and not listed."), ...out];
}

const LISTED_VALUES = 4000;

function groupContent(node, path, results) {
  const builds = [];
  const attributes = Object.entries(node.attributes ?? {});
  if (attributes.length) {
    builds.push(() => table(`Values of ${path || "/"}`, [{ name: "name", values: attributes.map(([name]) => name) }, { name: "value", values: attributes.map(([, value]) => value) }]));
  }
  const byLength = new Map();
  for (const [name, set] of Object.entries(node.sets ?? {})) {
    if (set.shape.length !== 1 || set.shape[0] === 0 || set.shape[0] > LISTED_VALUES || set.complex) continue;
    if (!byLength.has(set.shape[0])) byLength.set(set.shape[0], []);
    byLength.get(set.shape[0]).push(name);
  }
  for (const names of byLength.values()) {
    const at = (name) => (path ? `${path}/${name}` : name);
    builds.push(() => table(`${path}: ${names.join(", ")}`, names.map((name) => ({ name, unit: results.set(at(name)).unit, values: Array.from(results.set(at(name)).values) }))));
  }
  return builds;
}

/** Arrays of the machine's geometry and history that the head refers to. */
function withArrays(results, value) {
  if (value && typeof value === "object" && value.offset !== undefined) return results.array(value);
  if (Array.isArray(value)) return value.map((v) => withArrays(results, v));
  if (value && typeof value === "object") return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, withArrays(results, v)]));
  return value;
}

function themeButton() {
  const wanted = matchMedia("(prefers-color-scheme: dark)");
  const button = document.getElementById("theme");
  const apply = (dark) => {
    setDark(dark);
    button.textContent = dark ? "Light" : "Dark";
  };
  button.addEventListener("click", () => apply(!darkNow));
  wanted.addEventListener("change", (event) => apply(event.matches));
  apply(wanted.matches);
  fitPaper();
  document.getElementById("print").addEventListener("click", () => print());
}

async function start() {
  const { head, arrays } = await decodeData(document.getElementById("data").textContent);
  const results = new Results(head.results, arrays);
  head.machine = head.machine && withArrays(results, head.machine);
  head.history = head.history && withArrays(results, head.history);
  const main = document.querySelector("main");
  const list = document.querySelector("nav ul");
  for (const [id, title, present, build] of sections(results, head)) {
    if (!present) continue;
    const section = make("section", { id }, make("h2", {}, title));
    try {
      section.append(...build());
    } catch (error) {
      section.append(make("p", { class: "failed", role: "alert" }, `This part of the results cannot be shown: ${error.message}`));
      console.error(error);
    }
    main.append(section);
    list.append(make("li", {}, make("a", { href: `#${id}` }, title)));
  }
  document.querySelectorAll("table.plain").forEach(makeSortable);
  themeButton();
  drawOnSight();
  document.body.dataset.ready = "true";
}

/** A table of the page as written gets the buttons of the others. */
function makeSortable(plain) {
  const heads = [...plain.tHead.rows[0].cells].map((cell) => cell.textContent);
  const rows = [...plain.tBodies[0].rows].map((row) => [...row.cells].map((cell) => cell.textContent));
  const columns = heads.map((name, c) => ({ name, values: rows.map((row) => row[c]) }));
  const caption = plain.caption?.textContent ?? "";
  plain.replaceWith(table(caption, columns));
}

start();
