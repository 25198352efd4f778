//! Derivatives of eigenvalues, shapes and FRFs compared with finite differences of the computation from the
//! model file.

use rotordyn::analysis::modal;
use rotordyn::analysis::sensitivity::{Linearised, ModeSensitivity, SystemDerivative, frf_sensitivity};
use rotordyn::element::Anchor;
use rotordyn::linalg::{Complex64, SparseRow};
use rotordyn::model::{Model, Options, Quantity, load};
use std::f64::consts::TAU;

use crate::rig::variant;

/// A number of the model file that is varied.
struct Parameter {
    path: &'static str,
    start: f64,
    unit: &'static str,
}

const fn parameter(path: &'static str, start: f64, unit: &'static str) -> Parameter {
    Parameter { path, start, unit }
}

/// One of every kind: housing, belt, bushing, disc, and parameters that act through the ball contacts only.
const RIG: [Parameter; 9] = [
    parameter("housing.B.k_x", 6e6, "N/m"),
    parameter("housing.A.k_y", 1.5e7, "N/m"),
    parameter("housing.B.c_x", 300.0, "N s/m"),
    parameter("belt.drive.k_x", 4e5, "N/m"),
    parameter("belt.drive.pull", 250.0, ""),
    parameter("bushing.disc_air.c_y", 12.0, "N s/m"),
    parameter("bearing.B.radial_clearance", 10.0, "um"),
    parameter("bearing.A.contact_damping", 300.0, "N s/m"),
    parameter("disc.pulley.mass", 1.0, "kg"),
];

impl Parameter {
    fn rig_at(&self, factor: f64) -> Model {
        let value = match self.unit {
            // Two numbers in one string.
            "" => format!("\"{:e}, 0 N\"", self.start * factor),
            unit => format!("\"{:e} {unit}\"", self.start * factor),
        };
        variant(None, &[(self.path, &value)])
    }
}

const STEP: f64 = 1e-4;
/// Step of the finite differences used as a check.
const CHECK_STEP: f64 = 1e-3;

fn derivative(at: &Linearised, model: &dyn Fn(f64) -> Model) -> SystemDerivative {
    at.derivative(&model(1.0 - STEP), &model(1.0 + STEP), 2.0 * STEP).unwrap()
}

/// The eigenpair nearest to λ of a model, solved from scratch.
fn nearest(model: Model, speed: f64, value: Complex64) -> (Complex64, Vec<Complex64>) {
    let at = Linearised::new(model, speed, None).unwrap();
    let found = modal::modes(&at.assembly, &at.system, 10).unwrap();
    let distance = |m: &modal::Mode| (m.eigenvalue - value).norm();
    let mode = found.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
    (mode.eigenvalue, mode.shape)
}

/// f′(1) by fourth-order finite differences, f a function of the factor on a parameter.
fn difference<T>(f: impl Fn(f64) -> T, combine: impl Fn(&[(f64, T)]) -> Complex64, h: f64) -> Complex64 {
    let points: Vec<(f64, T)> = [(8.0, 1.0), (-8.0, -1.0), (-1.0, 2.0), (1.0, -2.0)]
        .map(|(weight, way)| (weight / (12.0 * h), f(1.0 + way * h)))
        .into();
    combine(&points)
}

fn sum(points: &[(f64, Complex64)]) -> Complex64 {
    points.iter().map(|(w, v)| v * *w).sum()
}

/// Largest error of λ′ over the first modes, relative to λ′, or to 1 % of the natural frequency if larger.
fn check_eigenvalues(at: &Linearised, models: &[&dyn Fn(f64) -> Model], modes: usize) -> f64 {
    let found = modal::modes(&at.assembly, &at.system, modes).unwrap();
    let by: Vec<SystemDerivative> = models.iter().map(|model| derivative(at, model)).collect();
    let mut worst: f64 = 0.0;
    for mode in &found {
        let sensitivity = ModeSensitivity::new(&at.system, mode.eigenvalue, &mode.shape).unwrap();
        for (model, by) in models.iter().zip(&by) {
            let ours = sensitivity.eigenvalue_derivative(by);
            let value = |factor: f64| nearest(model(factor), at.system.speed, mode.eigenvalue).0;
            let theirs = difference(value, sum, CHECK_STEP);
            // Round-off of the stiffest elements leaves some 3e-12 of an eigenvalue uncertain, 5e-9 of it in
            // these differences: smaller derivatives than 1e-2 of the eigenvalue cannot be checked to 1e-6.
            let error = (ours - theirs).norm() / theirs.norm().max(1e-2 * mode.natural_omega());
            worst = worst.max(error);
            if error > 1e-6 {
                println!(
                    "{} at {:.2} Hz: {ours:.6e} instead of {theirs:.6e}",
                    mode.label,
                    mode.frequency_hz()
                );
            }
        }
    }
    worst
}

#[test]
fn eigenvalue_sensitivities_of_the_rig() {
    for rpm in [0.0, 1200.0] {
        let at = Linearised::new(variant(None, &[]), rpm * TAU / 60.0, None).unwrap();
        let models: Vec<Box<dyn Fn(f64) -> Model>> =
            RIG.iter().map(|p| Box::new(|factor| p.rig_at(factor)) as Box<dyn Fn(f64) -> Model>).collect();
        let models: Vec<&dyn Fn(f64) -> Model> = models.iter().map(|m| m.as_ref()).collect();
        let worst = check_eigenvalues(&at, &models, 8);
        println!("{rpm} rpm: {worst:.2e}");
        assert!(worst < 1e-6, "{worst:.2e} at {rpm} rpm");
    }
}

/// A rotor on bearings with cross-coupled stiffness: left and right eigenvectors differ at every speed.
fn cross_coupled(factor: [f64; 3]) -> Model {
    load("cross.toml", cross_coupled_text(factor), &Options::default()).unwrap().model
}

fn cross_coupled_text(factor: [f64; 3]) -> String {
    format!(
        r#"
        [model]
        name = "cross"
        [material.steel]
        young = "207 GPa"
        poisson = 0.3
        density = "7850 kg/m^3"
        [shaft]
        element_length = "100 mm"
        section = [{{ length = "0.8 m", outer_diameter = "30 mm" }}]
        [station]
        A = "0 m"
        disc = "0.3 m"
        B = "0.8 m"
        [disc.main]
        station = "disc"
        mass = "{:e} kg"
        polar_inertia = "0.05 kg m^2"
        diametral_inertia = "0.03 kg m^2"
        [bearing.A]
        station = "A"
        model = "linear"
        k_xx = "{:e} N/m"
        k_yy = "2e7 N/m"
        k_xy = "{:e} N/m"
        k_yx = "-3e6 N/m"
        k_zz = "1e7 N/m"
        c_xx = "200 N s/m"
        c_yy = "300 N s/m"
        [bearing.B]
        station = "B"
        model = "linear"
        k_xx = "1e7 N/m"
        k_yy = "1.3e7 N/m"
        c_xx = "200 N s/m"
        c_yy = "300 N s/m"
        [damping.modal]
        frequency = "50, 300 Hz"
        ratio = [0.01, 0.02]
        "#,
        10.0 * factor[0],
        1e7 * factor[1],
        3e6 * factor[2]
    )
}

#[test]
fn eigenvalue_sensitivities_with_cross_coupled_stiffness() {
    let at = Linearised::new(cross_coupled([1.0; 3]), 300.0, None).unwrap();
    let worst = check_eigenvalues(
        &at,
        &[&|f| cross_coupled([f, 1.0, 1.0]), &|f| cross_coupled([1.0, f, 1.0]), &|f| {
            cross_coupled([1.0, 1.0, f])
        }],
        6,
    );
    println!("{worst:.2e}");
    assert!(worst < 1e-6, "{worst:.2e}");
}

#[test]
fn shape_and_frf_sensitivities_of_the_rig_at_speed() {
    let speed = 1200.0 * TAU / 60.0;
    let at = Linearised::new(variant(None, &[]), speed, None).unwrap();
    let chosen = [&RIG[0], &RIG[3], &RIG[6]];
    let by: Vec<SystemDerivative> = chosen.iter().map(|p| derivative(&at, &|f| p.rig_at(f))).collect();
    let by: Vec<&SystemDerivative> = by.iter().collect();
    let row = |at: &Linearised, name: &str, direction: usize| -> SparseRow {
        let node = at.model.stations.iter().find(|s| s.name == name).unwrap().node;
        at.assembly.anchor_rows(&Anchor::node(node))[direction].clone()
    };
    let rows = |at: &Linearised| [row(at, "disc", 0), row(at, "B", 1), row(at, "A", 0), row(at, "disc", 1)];

    // Shapes are compared by their ratios to the first row.
    let found = modal::modes(&at.assembly, &at.system, 6).unwrap();
    let here = rows(&at);
    for mode in &found {
        let sensitivity = ModeSensitivity::new(&at.system, mode.eigenvalue, &mode.shape).unwrap();
        let slopes = sensitivity.shape_derivatives(&by).unwrap();
        let lead = here[0].dot_complex(&mode.shape);
        if lead.norm() < 1e-2 {
            continue;
        }
        for (parameter, slope) in chosen.iter().zip(&slopes) {
            for (k, row) in here.iter().enumerate().skip(1) {
                let part = row.dot_complex(&mode.shape);
                let ours = row.dot_complex(slope) / lead - part * here[0].dot_complex(slope) / (lead * lead);
                let ratio = |factor: f64| {
                    let model = parameter.rig_at(factor);
                    let there = Linearised::new(model.clone(), speed, None).unwrap();
                    let shape = nearest(model, speed, mode.eigenvalue).1;
                    let there = rows(&there);
                    there[k].dot_complex(&shape) / there[0].dot_complex(&shape)
                };
                let theirs = difference(ratio, sum, CHECK_STEP);
                // Shapes have an error of some 1e-10 of their largest component, a hundred times that of
                // eigenvalues.
                let scale = theirs.norm().max(0.1 * (part / lead).norm()).max(0.1);
                let error = (ours - theirs).norm() / scale;
                assert!(error < 1e-6, "{} {}: {ours} {theirs} {error:.1e}", mode.label, parameter.path);
            }
        }
    }

    let frequencies = [12.0, 27.5, 60.0, 140.0];
    let quantities = [Quantity::Acceleration; 4];
    let frf = |at: &Linearised, by: &[&SystemDerivative]| {
        let rows = rows(at);
        frf_sensitivity(at, &frequencies, &rows[..1], &rows, &quantities, by).unwrap()
    };
    let ours = frf(&at, &by);
    for (p, parameter) in chosen.iter().enumerate() {
        for r in 0..4 {
            for k in 0..frequencies.len() {
                let value = |factor: f64| {
                    let there = Linearised::new(parameter.rig_at(factor), speed, None).unwrap();
                    frf(&there, &[]).values[r][0][k]
                };
                let theirs = difference(value, sum, CHECK_STEP);
                let slope = ours.derivatives[p][r][0][k];
                // The response across the force plane is a thousandth of that in it, with the latter's
                // round-off.
                let largest = (0..4).map(|r| ours.values[r][0][k].norm()).fold(0.0, f64::max);
                let scale = theirs.norm().max(1e-2 * largest);
                let error = (slope - theirs).norm() / scale;
                assert!(error < 1e-6, "{}: {slope} {theirs} {error:.1e}", parameter.path);
            }
        }
    }
}

/// The rotor of [`cross_coupled`] with its modal damping: one of the two ratios, or both, times a factor.
fn modally_damped(factor: [f64; 2]) -> Model {
    let ratios = format!("[{:e}, {:e}]", 0.01 * factor[0], 0.02 * factor[1]);
    let options = Options { variant: None, set: vec![("damping.modal.ratio".into(), ratios)] };
    load("cross.toml", cross_coupled_text([1.0; 3]), &options).unwrap().model
}

#[test]
fn sensitivities_to_modal_damping() {
    let at = Linearised::new(modally_damped([1.0; 2]), 300.0, None).unwrap();
    let models: [&dyn Fn(f64) -> Model; 3] =
        [&|f| modally_damped([f, 1.0]), &|f| modally_damped([1.0, f]), &|f| modally_damped([f, f])];
    let worst = check_eigenvalues(&at, &models, 6);
    println!("{worst:.2e}");
    assert!(worst < 1e-6, "{worst:.2e}");

    let rows = |at: &Linearised| {
        let node = at.model.stations.iter().find(|s| s.name == "disc").unwrap().node;
        let all = at.assembly.anchor_rows(&Anchor::node(node));
        [all[0].clone(), all[1].clone()]
    };
    let frequencies = [20.0, 33.0, 70.0, 140.0];
    let frf = |at: &Linearised, by: &[&SystemDerivative]| {
        let rows = rows(at);
        frf_sensitivity(at, &frequencies, &rows[..1], &rows, &[Quantity::Velocity; 2], by).unwrap()
    };
    let by: Vec<SystemDerivative> = models.iter().map(|model| derivative(&at, model)).collect();
    let ours = frf(&at, &by.iter().collect::<Vec<_>>());
    for (p, model) in models.iter().enumerate() {
        for r in 0..2 {
            for (k, hz) in frequencies.iter().enumerate() {
                let value =
                    |f: f64| frf(&Linearised::new(model(f), 300.0, None).unwrap(), &[]).values[r][0][k];
                let theirs = difference(value, sum, CHECK_STEP);
                let slope = ours.derivatives[p][r][0][k];
                let scale = theirs.norm().max(1e-2 * ours.values[r][0][k].norm());
                let error = (slope - theirs).norm() / scale;
                assert!(error < 1e-6, "{p}, {hz} Hz: {slope} {theirs} {error:.1e}");
            }
        }
    }
}
