//! Simulated measurement of the rig with changed housings, belt and damping; the update starts from the unchanged rig.

use std::sync::LazyLock;

use rotordyn::linalg::Complex64;
use rotordyn::model::parameter_paths::{all_values, resolve_parameter_path};
use rotordyn::model::{Model, Options, load};
use rotordyn::signal::record::Dof;
use rotordyn::update::UpdateError;
use rotordyn::update::culprits;
use rotordyn::update::parameter::{FreeParameter, ModelNumber, candidates};
use rotordyn::update::residual::Fitting;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Target, TargetMode, sensors};
use rotordyn::update::{IdentifiabilityClass, Update, UpdateJob, update};

use crate::rig::variant;

/// The rig, with a separate material for its bearings.
static RIG: LazyLock<String> = LazyLock::new(|| {
    let rig = include_str!("../../models/overhung_rig.toml");
    let own =
        "[material.bearing_steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\n[shaft]";
    let rig = rig.replacen("[shaft]", own, 1);
    rig.replace(
        "designation = \"6205\"\nmaterial = \"steel\"",
        "designation = \"6205\"\nmaterial = \"bearing_steel\"",
    )
});

/// Housing stiffness −30 % along x, +40 % along y; softer belt; more damping of air and housings.
pub const TRUTH: [(&str, &str); 9] = [
    ("housing.A.k_x", "4.2e6 N/m"),
    ("housing.B.k_x", "4.2e6 N/m"),
    ("housing.A.k_y", "2.1e7 N/m"),
    ("housing.B.k_y", "2.1e7 N/m"),
    ("belt.drive.k_x", "3e5 N/m"),
    ("housing.A.c_x", "400 N s/m"),
    ("housing.B.c_x", "400 N s/m"),
    ("bushing.disc_air.c_x", "18 N s/m"),
    ("bushing.disc_air.c_y", "18 N s/m"),
];

/// Deterministic random numbers in (−1, 1).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

pub fn point(model: &Model, name: &str) -> i64 {
    model.stations.iter().find(|s| s.name == name).unwrap().node as i64 + 1
}

/// Modes of a model below 300 Hz at disc, pulley and both bearings, frequencies off by 0.05 % and shapes by 1 %.
pub fn measured(model: Model) -> Target {
    let dofs: Vec<Dof> = ["A", "pulley", "B", "disc"]
        .iter()
        .flat_map(|name| [1, 2].map(|direction| Dof::new(point(&model, name), direction)))
        .chain([Dof::new(point(&model, "disc"), 3), Dof::new(point(&model, "disc"), 6)])
        .collect();
    let sensors = sensors(&dofs, &Default::default(), &model).unwrap();
    let empty = Target { speed: 0.0, sensors: sensors.clone(), modes: Vec::new(), frfs: None };
    let wide = TargetMode {
        frequency_hz: 300.0,
        damping_ratio: None,
        frequency_error: 0.0,
        damping_error: 0.0,
        shape_error: 0.0,
        quality_warnings: Vec::new(),
        shape: vec![Complex64::new(1.0, 0.0); sensors.len()],
    };
    let state = ModelState::new(model, &Target { modes: vec![wide; 6], ..empty.clone() }, None).unwrap();
    let mut noise = Noise(2010);
    let modes = state
        .modes
        .iter()
        .zip(&state.shapes)
        .filter(|(mode, _)| mode.frequency_hz() < 300.0)
        .map(|(mode, shape)| {
            let largest = shape.iter().map(|v| v.norm()).fold(0.0, f64::max);
            let mut perturbation = || Complex64::new(noise.next(), noise.next()) * (0.01 * largest);
            let shape = shape.iter().map(|v| v + perturbation()).collect();
            TargetMode {
                frequency_hz: mode.frequency_hz() * (1.0 + 5e-4 * noise.next()),
                damping_ratio: Some(mode.zeta() * (1.0 + 0.05 * noise.next())),
                frequency_error: 0.0,
                damping_error: 0.0,
                shape_error: 0.0,
                quality_warnings: Vec::new(),
                shape,
            }
        })
        .collect();
    Target { modes, ..empty }
}

pub fn free(path: &str) -> FreeParameter {
    let places = path
        .split('+')
        .flat_map(|path| resolve_parameter_path(RIG.as_bytes(), &Options::default(), path).unwrap())
        .map(|s| ModelNumber::read(&s.path, &s.text, s.quoted).unwrap())
        .collect();
    FreeParameter::new(path, places, true, None).unwrap()
}

/// All numbers of a model file.
pub fn numbers(text: &str) -> Vec<ModelNumber> {
    let values = all_values(text.as_bytes(), &Options::default()).unwrap();
    values.iter().filter_map(|v| ModelNumber::read(&v.path, &v.text, v.quoted)).collect()
}

pub fn load_rig(set: &[(String, String)]) -> Result<Model, UpdateError> {
    let options = Options { variant: None, set: set.to_vec() };
    Ok(load("overhung_rig.toml", &*RIG, &options).unwrap_or_else(|errors| panic!("{errors:?}")).model)
}

fn updated(paths: &[&str], fitting: Fitting) -> (Vec<FreeParameter>, Update) {
    let target = measured(variant(None, &TRUTH));
    assert!(target.modes.len() >= 8, "{}", target.modes.len());
    fitted(paths, fitting, &target)
}

/// Updates the nominal rig and prints the result.
pub fn fitted(paths: &[&str], fitting: Fitting, target: &Target) -> (Vec<FreeParameter>, Update) {
    let parameters: Vec<FreeParameter> = paths.iter().map(|path| free(path)).collect();
    let found = with_job(&parameters, &fitting, target, |job| update(job).unwrap());
    for (p, o) in parameters.iter().zip(&found.outcomes) {
        println!(
            "{:<28} {:.4e} -> {:.5e} (fitted {:.5e}) +- {:.2} %, prior {:.4}, {}",
            p.name,
            p.value(0.0),
            p.value(o.x),
            p.value(o.fitted),
            100.0 * o.error,
            o.prior_share,
            o.class.label()
        );
    }
    println!("sigma {:?}", found.identifiability.singular_values);
    println!("chi2 {} of {}", found.identifiability.chi_squared, found.identifiability.degrees_of_freedom);
    println!("iterations {}, converged {}", found.iterations.len(), found.converged);
    (parameters, found)
}

/// What is made of the job of an update of the nominal rig, all its other numbers being candidates.
fn with_job<T>(
    parameters: &[FreeParameter],
    fitting: &Fitting,
    target: &Target,
    of: impl FnOnce(&UpdateJob) -> T,
) -> T {
    let fixed = candidates(&numbers(&RIG), parameters);
    of(&UpdateJob { parameters, target, fitting, load: &load_rig, max_iterations: 30, fixed: &fixed })
}

/// One shape is half that of another mode, as of a mode that was hardly excited. Taken as exact it makes a wrong model of a
/// right one; with its error it does not.
#[test]
fn shape_of_known_error_does_not_reject_a_right_model() {
    let mut target = measured(variant(None, &TRUTH[..4]));
    let other = target.modes[1].shape.clone();
    let size = |shape: &[Complex64]| shape.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
    let part = 0.6 * size(&target.modes[0].shape) / size(&other);
    let turned = other.iter().map(|v| v * Complex64::new(0.0, part));
    target.modes[0].shape.iter_mut().zip(turned).for_each(|(v, w)| *v += w);
    let (_, exact) = fitted(&["housing.*.k_x", "housing.*.k_y"], Fitting::default(), &target);
    assert!(exact.goodness.is_rejected(), "{:?}", exact.goodness);
    target.modes[0].shape_error = 0.5;
    let (parameters, found) = fitted(&["housing.*.k_x", "housing.*.k_y"], Fitting::default(), &target);
    for (j, truth) in [(0, 4.2e6), (1, 2.1e7)] {
        let outcome = &found.outcomes[j];
        assert_eq!(outcome.class, IdentifiabilityClass::Identifiable, "{:?}", found.goodness);
        assert!((parameters[j].value(outcome.x) / truth).ln().abs() < 2.0 * outcome.error, "{outcome:?}");
    }
}

/// A pulley 3 % lighter than in the model lets χ² fall by less than chance does: although the other differences are smaller
/// still, nothing is said to depend on its mass. One 10 % lighter is found.
#[test]
fn difference_within_the_stated_deviations_is_no_dependence() {
    let paths = ["material.steel.young", "shaft.section.0.outer_diameter"];
    let mut target = measured(variant(None, &[("disc.pulley.mass", "0.90 kg")]));
    let (_, light) = fitted(&paths, Fitting::default(), &target);
    let on =
        |found: &Update, j: usize| found.outcomes[j].fixed.depends_on.as_ref().map(|d| d.on.name.clone());
    assert_eq!(on(&light, 0).as_deref(), Some("disc.pulley.mass"));
    target.modes = measured(variant(None, &[("disc.pulley.mass", "0.97 kg")])).modes;
    let (_, found) = fitted(&paths, Fitting::default(), &target);
    assert!(found.goodness.chi_squared < 6.0, "{:?}", found.goodness);
    assert_eq!([on(&found, 0), on(&found, 1)], [None, None]);
}

/// Housings 30 % softer than in the model, with a bound at −15 %: the bound is found as the cause.
#[test]
fn bound_that_excludes_the_truth_is_named() {
    let target = measured(variant(None, &TRUTH[..4]));
    let mut parameters = [free("housing.*.k_x"), free("housing.*.k_y")];
    parameters[0].lower = 0.85f64.ln();
    let fitting = Fitting::default();
    let (found, search) = with_job(&parameters, &fitting, &target, |job| {
        let found = update(job).unwrap();
        let search = culprits::search(job, &found).unwrap();
        (found, search)
    });
    assert!(found.goodness.is_rejected() && found.outcomes[0].class == IdentifiabilityClass::AtBound);
    let released = search.released.unwrap();
    assert_eq!(released.parameters, [0]);
    assert!(!released.goodness.is_rejected(), "{:?}", released.goodness);
    assert!((parameters[0].value(released.x[0]) / 4.2e6 - 1.0).abs() < 0.02, "{:?}", released.x);
    assert!(released.gain > 0.9 * found.goodness.chi_squared, "{released:?}");
}

#[test]
fn housings_are_identifiable_and_the_bearing_is_not() {
    // The housings are twenty times softer than balls and rings, whose material hardly changes the modes.
    let paths = ["housing.*.k_x", "housing.*.k_y", "belt.drive.k_x", "material.bearing_steel.young"];
    let (parameters, found) = updated(&paths, Fitting::default());
    assert!(found.converged);
    for (j, truth) in [(0, 4.2e6), (1, 2.1e7)] {
        let value = parameters[j].value(found.outcomes[j].x);
        assert_eq!(found.outcomes[j].class, IdentifiabilityClass::Identifiable);
        assert!((value / truth - 1.0).abs() < 0.02, "{} = {value:e}", paths[j]);
    }
    assert_ne!(found.outcomes[3].class, IdentifiabilityClass::Identifiable);
}

#[test]
fn separate_housings_with_damping_in_the_fit() {
    let paths = ["housing.A.k_x", "housing.A.k_y", "housing.B.k_x", "housing.B.k_y", "belt.drive.k_x"];
    let (parameters, found) = updated(&paths, Fitting { damping: Some(0.1), ..Fitting::default() });
    assert!(found.converged);
    for (j, truth) in [4.2e6, 2.1e7, 4.2e6, 2.1e7, 3e5].into_iter().enumerate() {
        let outcome = &found.outcomes[j];
        assert_ne!(outcome.class, IdentifiabilityClass::NotIdentifiable, "{}", paths[j]);
        // Standard errors assume deviations of 0.1 % of a frequency; the noise is half of that.
        let off = (parameters[j].value(outcome.x) / truth - 1.0).abs();
        assert!(off < 2.0 * outcome.error, "{} is off by {off:.4}, stated {:.4}", paths[j], outcome.error);
    }
}
