//! Model builder: from the tree of a model file to the validated [`Model`] in SI units, reporting all
//! problems at once.

mod ball_inertia;
mod ball_keys;
mod bearing;
mod bearing_study;
mod bifurcation_parameter;
pub mod catalogue;
mod channel_names;
mod connections;
mod contact;
mod default_points;
mod default_ranges;
mod defects;
mod disc_fit;
mod free_ball;
mod free_cage;
mod imperfections;
mod increasing;
mod inertia;
mod loading;
mod lubricants;
mod material;
mod measured_speed;
mod mounting;
mod orders;
mod places;
mod plausibility;
mod radial_bearing;
mod rotor;
mod rotor_studies;
mod rounding;
mod run_analyses;
mod run_keys;
mod run_up;
mod shaft;
mod springs;
mod steady;
mod study;
mod topology;
mod work_limits;

use super::file::diagnostic::{Kind, Log, Problem};
use super::file::key::{
    Group, NamedTables, Quantities, Quantity, SubTable, Table as Declaration, Text, any, keys, named_tables,
    not_negative, positive, quantities, quantity, sub_table, text, within,
};
use super::file::overlay::VariantTopKeys;
use super::file::reader::{Reader, missing_table_problem};
use super::file::tree::Table;
use super::study::Studies;
use super::{ExternalFile, Model};
use material::material;
use places::Places;
use rotordyn_bearing::Bearing;
use rotordyn_core::element::Material;
use rotordyn_core::warning::Code;
use rotordyn_units::names::folder_problem;
use rotordyn_units::{ACCELERATION, DENSITY, NUMBER, PRESSURE};

/// The model file.
pub(crate) static FILE: Declaration = Declaration {
    meaning: "A machine, or bearings only: a file without shaft, rotor and stations.",
    groups: &[
        Group::always(TopKeys::LIST),
        Group::always(lubricants::TopKeys::LIST),
        Group::always(shaft::TopKeys::LIST),
        Group::always(rotor::TopKeys::LIST),
        Group::always(inertia::TopKeys::LIST),
        Group::always(connections::TopKeys::LIST),
        Group::always(bearing::TopKeys::LIST),
        Group::always(loading::TopKeys::LIST),
        Group::always(study::TopKeys::LIST),
        Group::always(VariantTopKeys::LIST),
    ],
};

keys! {
    /// Tables of this file.
    static TOP: TopKeys {
        model: SubTable = sub_table(HeaderKeys::TABLE).required("");
        material: NamedTables = named_tables(MaterialKeys::TABLE);
        schema: Text = text("address", "JSON Schema of the file, for editors.").named("$schema").optional()
            .example("\"rotordyn.schema.json\"");
    }
}

keys! {
    /// `[model]`.
    static HEADER: HeaderKeys = "Name of the model and gravity." {
        name: Text = text("letters, digits, _, - and .", "Name of the model; the results go to out/NAME.")
            .example("\"my_machine\"");
        title: Text = text("text", "Title of figures.").computed("name").example("\"My machine\"");
        gravity: Quantities = quantities(any(ACCELERATION), "one, along -y, or three: x, y, z",
            "Acceleration of gravity.").default("9.80665 m/s^2").example("\"0, -9.81, 0 m/s^2\"");
    }
}

/// Least and greatest Poisson's ratio; the shear modulus is infinite at -1.
const POISSON: [f64; 2] = [-0.99, 0.5];
/// Round-off of a Poisson's ratio that follows from two rounded moduli.
const RATIO_TOLERANCE: f64 = 1e-6;

keys! {
    /// `[material.x]`.
    static MATERIAL: MaterialKeys = "An elastic material." {
        young: Quantity = quantity(positive(PRESSURE), "Young's modulus.");
        density: Quantity = quantity(not_negative(DENSITY), "Density.");
        poisson: Quantity = quantity(within(NUMBER, POISSON), "Poisson's ratio.").required("or shear")
            .example("0.3");
        shear: Quantity = quantity(positive(PRESSURE), "Shear modulus; with poisson it need not be E / (2 (1 + nu)).")
            .required("or poisson").example("\"80 GPa\"");
    }
}

/// Build the whole model; `files` are its external data files. It is valid only if no error was logged.
pub(crate) fn build_model(root: &Table, files: &[ExternalFile], log: &Log) -> Model {
    let top = Reader::root(root, &FILE, log);
    let (name, title, gravity) = model_header(&top);
    let materials = materials(&top);
    let lubricants = lubricants::lubricants(&top);
    let line = if top.has(&rotor::TOP.rotor) {
        rotor::read(&top, &materials)
    } else {
        shaft::read(&top, &materials)
    };
    let mut places = Places::new(&line.stations);
    if let Some(rotor) = &line.rigid_rotor {
        places.add("rotor".into(), rotor.node, [0.0, 0.0, line.node_z[rotor.node]]);
    }
    let discs = inertia::discs(&top, &materials, &mut places);
    let inertia::Bodies { bodies, mut bushings } = inertia::bodies(&top, &mut places, line.node_z.len());
    let masses = inertia::masses(&top, &places);
    bushings.extend(connections::bushings(&top, &places));
    let joints = connections::joints(&top, &places);
    let belts = connections::belts(&top, &places);
    let errors_before = log.error_count();
    let bearings = bearing::read(&top, &materials, &lubricants, gravity, &places);
    if log.error_count() > errors_before {
        log.add_cause(bearing::TOP.bearing.about.name);
    }
    bearing::name_ends(&top, &mut places);
    let rotor_mass = line.mass() + discs.iter().map(|d| d.mass).sum::<f64>();
    let unbalances = loading::unbalances(&top, &places, rotor_mass);
    let loads = loading::loads(&top, &places);
    let probes = loading::probes(&top, &places);
    let mut model = Model {
        name,
        title,
        gravity,
        materials,
        node_z: line.node_z,
        shaft: line.elements,
        rigid_rotor: line.rigid_rotor,
        stations: line.stations,
        discs,
        bodies,
        masses,
        bushings,
        joints,
        bearings,
        belts,
        unbalances,
        loads,
        damping: loading::damping(&top),
        drive: loading::drive(&top, &places),
        profile: loading::profile(&top, files),
        probes,
        studies: Studies::default(),
    };
    if model.probes.is_empty() {
        model.probes = default_points::probes(&model);
        let named = model.probes.iter().map(|probe| probe.name.as_str()).collect::<Vec<_>>();
        top.taken_by_default(&loading::TOP.probe, named.join(", "));
    }
    model.studies = study::read(&top, &model, &places);
    if log.error_count() == 0 {
        channel_names::check(&top, &model);
        topology::check(&top, &model);
        let sites = top.items(&bearing::TOP.bearing);
        mounting::check_axial_location(&sites, &model, log);
        mounting::check_free_rotation(&top, &model);
        disc_fit::check(&top, &model);
        plausibility::check(&top, &model, (&TOP.material, [&MATERIAL.young, &MATERIAL.density]));
        let bearings = model.bearings.iter().map(|s| (&*s.name, &s.bearing));
        mounting::check_mounted_preloads(&sites, bearings, true, log);
    }
    top.finish();
    model
}

/// Warn of materials and lubricants that nothing uses; `text` is the file as written, with its variants.
pub(crate) fn check_unused(root: &Table, text: &str, log: &Log) {
    let top = Reader::root(root, &FILE, log);
    plausibility::check_unused(&top, root, text, &[&TOP.material, &lubricants::TOP.lubricant]);
}

/// Build a bearing-only file: its name and title, bearings and studies.
pub(crate) fn build_bearings(root: &Table, log: &Log) -> (String, String, Vec<(String, Bearing)>, Studies) {
    let top = Reader::root(root, &FILE, log);
    let (name, title, gravity) = model_header(&top);
    let materials = materials(&top);
    let bearings = bearing::read_bearings_only(&top, &materials, &lubricants::lubricants(&top), gravity);
    let studies = study::read_for_bearings(&top, &bearings);
    let sites = top.items(&bearing::TOP.bearing);
    mounting::check_mounted_preloads(&sites, bearings.iter().map(|(name, b)| (&**name, b)), false, log);
    top.finish();
    (name, title, bearings, studies)
}

fn model_header(top: &Reader) -> (String, String, [f64; 3]) {
    // For editors only.
    top.text(&TOP.schema);
    if !top.has(&TOP.model) {
        let problem = missing_table_problem(TOP.model.about.name);
        top.log.error(problem.hint("start the file with\n[model]\nname = \"my_machine\""));
        return (String::new(), String::new(), [0.0; 3]);
    }
    let r = top.table_or_empty(&TOP.model);
    let name = r.need_text(&HEADER.name).unwrap_or_default().to_string();
    if name.is_empty() && r.has_no_errors() {
        r.error(Kind::OutOfRange, &HEADER.name, "model.name is empty");
    }
    if !name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'))
        || name.starts_with('.')
        || !name.is_empty() && folder_problem(&name).is_some()
    {
        let problem =
            Problem::new(Kind::OutOfRange, &r.span_of(&HEADER.name), "model.name is not a valid folder name");
        r.log.error(problem.expected("letters, digits, `_`, `-` and `.` (the results go to out/NAME)"));
    }
    let title = r.text(&HEADER.title).unwrap_or(&name).to_string();
    let gravity = match r.list(&HEADER.gravity).as_deref() {
        None => [0.0; 3],
        Some(&[down]) => [0.0, -down, 0.0],
        Some(&[x, y, z]) => [x, y, z],
        Some(_) => {
            r.error(
                Kind::WrongType,
                &HEADER.gravity,
                "model.gravity is one value (downwards, along -y) or three",
            );
            [0.0; 3]
        }
    };
    check_gravity(&r, gravity);
    r.finish();
    (name, title, gravity)
}

/// Magnitudes of an acceleration of gravity \[m/s²\]: from a tenth of that of the moon to five times that of the earth.
const GRAVITY: [f64; 2] = [0.16, 50.0];

/// Warns of a gravity that is rarely meant.
fn check_gravity(r: &Reader, gravity: [f64; 3]) {
    let [x, y, z] = gravity;
    let size = x.hypot(y).hypot(z);
    let [least, greatest] = GRAVITY;
    let message = if size > 0.0 && !(least..=greatest).contains(&size) {
        format!("{} is {size:.4} m/s^2: on the earth it is 9.81 m/s^2", r.name(&HEADER.gravity))
    } else if y > 0.5 * size && size > 0.0 {
        format!("{} points upwards, along +y", r.name(&HEADER.gravity))
    } else {
        return;
    };
    let hint = "one value is downwards, along -y; three are its components along x, y and z";
    let problem = Problem::new(Kind::OutOfRange, &r.span_of(&HEADER.gravity), message).hint(hint);
    r.log.warn(Code::Gravity, "model.gravity", problem);
}

fn materials(top: &Reader) -> Vec<Material> {
    let read = |(name, r): (&str, Reader)| {
        let (young, density) = (r.value(&MATERIAL.young), r.value(&MATERIAL.density));
        let (shear, poisson) = (r.get(&MATERIAL.shear), r.get(&MATERIAL.poisson));
        if !r.has(&MATERIAL.shear) && !r.has(&MATERIAL.poisson) {
            r.missing(&MATERIAL.poisson);
        }
        let derived = shear.map(|g| young / (2.0 * g) - 1.0);
        let [least, greatest] = POISSON;
        let is_allowed = |ratio: f64| (least..=greatest + RATIO_TOLERANCE).contains(&ratio);
        if !r.has(&MATERIAL.poisson) && r.has_no_errors() && !derived.is_none_or(is_allowed) {
            let [low, high] = [greatest, least].map(|ratio| 0.5e-9 * young / (1.0 + ratio));
            let message = format!("{} does not fit to Young's modulus", r.name(&MATERIAL.shear));
            let problem = Problem::new(Kind::OutOfRange, &r.span_of(&MATERIAL.shear), message);
            let moduli =
                format!("from {low:.4} GPa to {high:.4} GPa, Poisson's ratio from {greatest} to {least}");
            r.log.error(problem.expected(moduli));
        }
        let poisson = poisson.or(derived).unwrap_or(0.3);
        let shear = shear.unwrap_or(young / (2.0 * (1.0 + poisson)));
        r.finish();
        Material { name: name.into(), young, shear, poisson, density }
    };
    top.items(&TOP.material).into_iter().map(read).collect()
}
