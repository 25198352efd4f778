"use strict";
// The page of a ball bearing for its designer: tables of what is stored of it, or was computed for the page.

/** Access to the results of a bearing by paths below its group. */
function bearingSource(results, entry) {
  const base = entry.stored ? results : new Results(entry.tree, results.arrays);
  const at = (path) => (entry.stored ? `bearings/${entry.name}${path ? `/${path}` : ""}` : path);
  const set = (path) => base.set(at(path));
  const group = (path) => base.group(at(path));
  return {
    set, group, attribute: (path, name) => group(path)?.attributes?.[name],
    values: (path) => Array.from(set(path)?.values ?? []),
    /** A value of the operating point; NaN if it is not there. */
    point: (name) => Number(set(`operating/${name}`)?.values?.[0] ?? NaN),
  };
}

/** Unit in which a designer reads a quantity, and its factor from SI. */
function designUnit(unit) {
  return { m: ["mm", 1e3], rad: ["°", 180 / Math.PI], Pa: ["GPa", 1e-9], "m2/s": ["mm²/s", 1e6], "N/m": ["N/µm", 1e-6], "N m": ["N·m", 1] }[unit] ?? [unit, 1];
}

/** Rows of [name, value, unit in SI or text]; those without a value are left out. */
function valueTable(caption, rows, options) {
  const known = rows.filter(([, value]) => value !== undefined && value !== null && !(typeof value === "number" && Number.isNaN(value)));
  const shown = known.map(([name, value, unit = "1"]) => {
    if (typeof value !== "number") return [name, value, ""];
    const [word, factor] = designUnit(unit);
    return [name, value * factor, word === "1" ? "" : word];
  });
  if (!shown.length) return null;
  return table(caption, ["quantity", "value", "unit"].map((name, k) => ({ name, values: shown.map((row) => row[k]) })), options);
}

function numberOf(value) {
  return value === undefined || value === null ? NaN : Number(value);
}

/** Everything of one bearing. */
function bearingView(results, entry) {
  if (entry.failed) return [make("p", {}, `Not shown: ${entry.failed}. The command bearing analyses it, and report shows its results here.`)];
  const source = bearingSource(results, entry);
  const rpm = (source.point("speed") * 30) / Math.PI;
  const origin = source.attribute("", "load_source") ?? "";
  const words = [`At ${digits(rpm)} rpm; load by the shaft: ${origin}.`];
  if (!entry.stored) words.push("Computed for this page from the model in results.h5, which has no bearing study; the command bearing stores the same.");
  if (entry.absent?.length) words.push(`This results file, of an older version, does not have ${entry.absent.join(" and ")}; the command bearing writes them.`);
  const estimated = source.attribute("", "estimated_geometry");
  if (estimated) words.push(`Internal geometry ${estimated}.`);
  const parts = [
    make("p", {}, words.join(" ")), warningList(results, entry), sheetFigure(results, entry), limitTable(source), ...geometryTables(source, entry),
    loadTable(source), frequencyTable(source, rpm), ratingTable(source), lifeTable(source, rpm), frictionTable(source), ...bearingCharts(source),
  ];
  return parts.filter(Boolean);
}

/** Warnings of the bearing, as in the overview, or those of its own computation. */
function warningList(results, entry) {
  const items = Array.from(results.values("warnings/item") ?? []);
  const texts = results.values("warnings/text") ?? [];
  const own = items.flatMap((item, k) => (item === `bearing.${entry.name}` ? [texts[k]] : []));
  const all = [...new Set([...own, ...(entry.warnings ?? [])])];
  return all.length ? make("ul", { class: "warnings" }, ...all.map((text) => make("li", {}, text))) : null;
}

/** The drawn page of the bearing. */
function sheetFigure(results, entry) {
  const svg = entry.sheet ?? results.sheets?.[`bearing_${entry.name}_sheet`];
  return svg ? staticFigure({ caption: `Bearing ${entry.name} on one page: load distribution, most loaded ball in its grooves, contact angles, stiffness and contacts over load and speed.`, svg }) : null;
}

function limitTable(source) {
  const quantity = source.values("limits/quantity");
  if (!quantity.length) return null;
  const units = source.values("limits/unit").map(designUnit);
  const scaledBy = (name) => source.values(`limits/${name}`).map((v, k) => v * units[k][1]);
  const side = source.values("limits/side");
  const state = source.values("limits/state");
  const limits = scaledBy("limit").map((v, k) => `${side[k]} ${digits(v)}`);
  const columns = [
    { name: "quantity", values: quantity }, { name: "value", values: scaledBy("value"), digits: 4 }, { name: "limit", values: limits },
    { name: "unit", values: units.map(([word]) => (word === "1" ? "" : word)) }, { name: "state", values: state }, { name: "what it says", values: source.values("limits/says") },
  ];
  return table("Limits at the operating point", columns, { mark: (r) => state[r] !== "within" });
}

function geometryTables(source, entry) {
  const of = (name) => numberOf(source.attribute("geometry", name));
  const rows = [
    ["balls", of("balls")], ["arrangement", source.attribute("geometry", "arrangement")], ["distance of the rows", of("row_spacing"), "m"],
    ["ball diameter", of("ball_diameter"), "m"], ["pitch diameter", of("pitch_diameter"), "m"],
    ["groove radius, inner", of("inner_groove_radius"), "m"], ["groove radius, outer", of("outer_groove_radius"), "m"],
    ["nominal contact angle", of("contact_angle"), "rad"], ["bore", of("bore"), "m"], ["outside diameter", of("outside_diameter"), "m"], ["width", of("width"), "m"],
    ["shoulder angle, inner", of("inner_shoulder_angle"), "rad"], ["shoulder angle, outer", of("outer_shoulder_angle"), "rad"],
    ["radial clearance before mounting (diametral)", of("radial_clearance"), "m"],
    ["radial clearance as mounted, at speed", source.point("mounted_radial_clearance"), "m"],
    ["axial clearance as mounted, at speed", source.point("mounted_axial_clearance"), "m"],
    ["free contact angle as mounted", source.point("free_contact_angle"), "rad"],
  ];
  const clearance = of("radial_clearance");
  const classes = of("contact_angle") === 0 ? (entry.classes ?? []) : [];
  const inside = (c) => clearance >= c.least && clearance <= c.most;
  const um = (key) => classes.map((c) => c[key] * 1e6);
  const classTable = classes.length
    ? table("Clearance classes of ISO 5753-1 at this bore", [
        { name: "class", values: classes.map((c) => c.name) }, { name: "least", unit: "µm", values: um("least") }, { name: "greatest", unit: "µm", values: um("most") },
        { name: "clearance of the model", values: classes.map((c) => (inside(c) ? "inside" : "")) },
      ], { mark: (r) => inside(classes[r]) })
    : null;
  return [valueTable("Geometry as it was understood", rows), classTable];
}

function loadTable(source) {
  const names = ["F x", "F y", "F z", "M x", "M y"];
  const moves = ["u x", "u y", "u z", "tilt x", "tilt y"];
  const [load, displacement] = [source.values("operating/load"), source.values("operating/displacement")];
  if (!load.length) return null;
  const rows = [
    ...load.map((v, k) => [names[k], v, k > 2 ? "N m" : "N"]), ...displacement.map((v, k) => [moves[k], v * 1e6, k > 2 ? "µrad" : "µm"]),
    ["radial stiffness, other motions free", source.point("radial_stiffness"), "N/m"], ["radial stiffness, other motions held", source.point("radial_stiffness_constrained"), "N/m"],
    ["axial stiffness, other motions free", source.point("axial_stiffness"), "N/m"], ["axial stiffness, other motions held", source.point("axial_stiffness_constrained"), "N/m"],
    ["loaded balls", source.point("loaded_balls")], ["largest ball load", source.point("largest_ball_load"), "N"], ["largest contact pressure", source.point("largest_pressure"), "Pa"],
    ["preload force", source.point("preload_force"), "N"],
  ];
  return valueTable("Load, displacement and stiffness at the operating point", rows);
}

function frequencyTable(source, rpm) {
  const kinds = [["FTF (cage)", "ftf"], ["BPFO (outer race)", "bpfo"], ["BPFI (inner race)", "bpfi"], ["BSF (ball spin)", "bsf"]];
  const nominal = kinds.map(([, key]) => numberOf(source.attribute("", key)));
  const loaded = kinds.map(([, key]) => source.point(key));
  if (![...nominal, ...loaded].some(Number.isFinite)) return null;
  const hertz = (orders) => orders.map((order) => (order * rpm) / 60);
  return table(`Defect frequencies at ${digits(rpm)} rpm`, [
    { name: "frequency", values: kinds.map(([name]) => name) }, { name: "order, nominal angle", values: nominal }, { name: "order, loaded", values: loaded },
    { name: "nominal angle", unit: "Hz", values: hertz(nominal) }, { name: "loaded", unit: "Hz", values: hertz(loaded) },
  ]);
}

function ratingTable(source) {
  const of = (name) => numberOf(source.attribute("", name));
  return valueTable("Ratings and equivalent loads", [
    ["dynamic load rating C", of("dynamic_rating"), "N"], ["static load rating C₀", of("static_rating"), "N"], ["fatigue load limit C_u", of("fatigue_limit"), "N"],
    ["dynamic equivalent load P", source.point("equivalent_load"), "N"], ["radial factor X", source.point("radial_factor_x")], ["axial factor Y", source.point("axial_factor_y")],
    ["limit e of F_a/F_r", source.point("load_ratio_limit_e")], ["static equivalent load P₀", source.point("static_equivalent_load"), "N"], ["static safety s₀", source.point("static_safety")],
    ["viscosity ratio κ", source.point("viscosity_ratio")], ["reference viscosity ν₁", source.point("reference_viscosity"), "m2/s"],
    ["film ratio λ", source.point("minimum_film") > 0 ? source.point("film_ratio") : NaN], ["life modification a_ISO", source.point("life_modification")],
  ]);
}

function lifeTable(source, rpm) {
  const kinds = [
    ["basic L₁₀ (ISO 281)", "basic_life"], ["reference L₁₀ᵣ (ISO/TS 16281)", "reference_life"], ["the same by the ball loads", "life_by_ball_loads"], ["modified L_nmr", "modified_life"],
  ].map(([name, key]) => [name, source.point(key)]).filter(([, life]) => !Number.isNaN(life));
  if (!kinds.length) return null;
  const hours = (life) => (rpm > 0 ? (life * 1e6) / (rpm * 60) : NaN);
  return table("Rating lives", [
    { name: "life", values: kinds.map(([name]) => name) }, { name: "life", unit: "10⁶ revolutions", values: kinds.map(([, life]) => life), digits: 4 },
    { name: "hours at this speed", values: kinds.map(([, life]) => hours(life)), digits: 4 },
  ]);
}

function frictionTable(source) {
  if (!(source.point("friction_torque") > 0)) return null;
  return valueTable("Friction torque (Palmgren) and heat", [
    ["torque", source.point("friction_torque"), "N m"], ["by load", source.point("friction_torque_load"), "N m"], ["viscous", source.point("friction_torque_viscous"), "N m"],
    ["by spinning", source.point("friction_torque_spin"), "N m"], ["heat", source.point("friction_heat"), "W"],
  ]);
}
