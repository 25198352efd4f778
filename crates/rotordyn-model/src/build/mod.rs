//! Model builder: from the tree of a model file to the validated [`Model`] in SI units, reporting all
//! problems at once.

mod ball_keys;
mod bearing;
mod bearing_study;
pub mod catalogue;
mod connections;
mod contact;
mod defects;
mod imperfections;
mod increasing;
mod inertia;
mod loading;
mod material;
mod measured_speed;
mod mounting;
mod places;
mod radial_bearing;
mod rotor;
mod run_keys;
mod shaft;
mod springs;
mod steady;
mod study;
mod topology;
mod work_limits;

use super::file::diagnostic::{Kind, Log, Problem};
use super::file::reader::{Reader, any, not_negative, positive};
use super::file::tree::Table;
use super::study::Studies;
use super::{ExternalFile, Model};
use material::material;
use places::Places;
use rotordyn_bearing::Bearing;
use rotordyn_core::element::Material;
use rotordyn_units::{ACCELERATION, DENSITY, NUMBER, PRESSURE};

/// Standard gravity \[m/s²\].
const STANDARD_GRAVITY: f64 = 9.80665;

/// Build the whole model; `files` are its external data files. It is valid only if no error was logged.
pub(crate) fn build_model(root: &Table, files: &[ExternalFile], log: &Log) -> Model {
    let top = Reader::new(root, "", 0..0, log);
    let (name, title, gravity) = model_header(&top);
    let materials = materials(&top);
    let lubricants = contact::lubricants(&top);
    let line = if top.has("rotor") { rotor::read(&top, &materials) } else { shaft::read(&top, &materials) };
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
    let bearings = bearing::read(&top, &materials, &lubricants, gravity, &places);
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
    model.studies = study::read(&top, &model, &places);
    if log.error_count() == 0 {
        topology::check(&top, &model);
        mounting::check_axial_location(&top, &model);
        mounting::check_free_rotation(&top, &model);
        mounting::check_mounted_preloads(&top, model.bearings.iter().map(|s| (&*s.name, &s.bearing)), true);
    }
    top.finish();
    model
}

/// Build a bearing-only file: its name and title, bearings and studies.
pub(crate) fn build_bearings(root: &Table, log: &Log) -> (String, String, Vec<(String, Bearing)>, Studies) {
    let top = Reader::new(root, "", 0..0, log);
    let (name, title, gravity) = model_header(&top);
    let materials = materials(&top);
    let bearings = bearing::read_bearings_only(&top, &materials, &contact::lubricants(&top), gravity);
    let studies = study::read_for_bearings(&top, &bearings);
    mounting::check_mounted_preloads(&top, bearings.iter().map(|(name, b)| (&**name, b)), false);
    top.finish();
    (name, title, bearings, studies)
}

fn model_header(top: &Reader) -> (String, String, [f64; 3]) {
    if !top.has("model") {
        let problem = Problem::new(Kind::MissingKey, &(0..0), "the file has no [model] table");
        top.log.error(problem.hint("start the file with\n[model]\nname = \"my_machine\""));
        return (String::new(), String::new(), [0.0; 3]);
    }
    let r = top.table_or_empty("model");
    let name = r.need_text("name", "\"my_machine\"").unwrap_or_default().to_string();
    if name.is_empty() && r.has_no_errors() {
        r.error(Kind::OutOfRange, "name", "model.name is empty");
    }
    if !name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.')) || name.starts_with('.') {
        let problem =
            Problem::new(Kind::OutOfRange, &r.span_of("name"), "model.name is not a valid folder name");
        r.log.error(problem.expected("letters, digits, `_`, `-` and `.` (the results go to out/NAME)"));
    }
    let title = r.text("title").unwrap_or(&name).to_string();
    let gravity = match r.list("gravity", any(ACCELERATION)).as_deref() {
        None => [0.0, -STANDARD_GRAVITY, 0.0],
        Some(&[down]) => [0.0, -down, 0.0],
        Some(&[x, y, z]) => [x, y, z],
        Some(_) => {
            r.error(Kind::WrongType, "gravity", "model.gravity is one value (downwards, along -y) or three");
            [0.0; 3]
        }
    };
    r.finish();
    (name, title, gravity)
}

fn materials(top: &Reader) -> Vec<Material> {
    let read = |(name, r): (&str, Reader)| {
        let young = r.need("young", positive(PRESSURE));
        let density = r.need("density", not_negative(DENSITY));
        let shear = r.get("shear", positive(PRESSURE));
        let poisson = r.get("poisson", any(NUMBER));
        if poisson.is_some_and(|nu| !(-1.0..=0.5).contains(&nu)) {
            r.error(Kind::OutOfRange, "poisson", format!("{} must be from -1 to 0.5", r.name("poisson")));
        }
        if !r.has("shear") && !r.has("poisson") {
            r.missing("poisson", "0.3");
        }
        let poisson = poisson.or_else(|| shear.map(|g| young / (2.0 * g) - 1.0)).unwrap_or(0.3);
        let shear = shear.unwrap_or(young / (2.0 * (1.0 + poisson)));
        r.finish();
        Material { name: name.into(), young, shear, poisson, density }
    };
    top.items("material").into_iter().map(read).collect()
}
