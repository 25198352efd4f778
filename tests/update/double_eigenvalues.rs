//! Isotropic rotor at rest: its modes come in pairs of equal frequency (double eigenvalues), and the planes of the
//! measured shapes are arbitrary.

use rotordyn::linalg::Complex64;
use rotordyn::model::{Model, Options, load};
use rotordyn::signal::record::Dof;
use rotordyn::update::UpdateError;
use rotordyn::update::parameter::{FreeParameter, ModelNumber};
use rotordyn::update::residual::Fitting;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Target, TargetMode, sensors};
use rotordyn::update::{IdentifiabilityClass, UpdateJob, update};

const ROTOR: &str = r#"
    [model]
    name = "two_discs"
    [material.steel]
    young = "207 GPa"
    poisson = 0.3
    density = "7850 kg/m^3"
    [shaft]
    element_length = "50 mm"
    section = [{ length = "1 m", outer_diameter = "30 mm" }]
    [station]
    A = "0 m"
    left = "0.3 m"
    right = "0.6 m"
    B = "1 m"
    [disc.left]
    station = "left"
    mass = "8 kg"
    polar_inertia = "0.04 kg m^2"
    diametral_inertia = "0.02 kg m^2"
    [disc.right]
    station = "right"
    mass = "12 kg"
    polar_inertia = "0.09 kg m^2"
    diametral_inertia = "0.05 kg m^2"
    [bearing.A]
    station = "A"
    model = "linear"
    k_xx = "2e6 N/m"
    k_yy = "2e6 N/m"
    k_zz = "1e7 N/m"
    c_xx = "100 N s/m"
    c_yy = "100 N s/m"
    [bearing.B]
    station = "B"
    model = "linear"
    k_xx = "2e6 N/m"
    k_yy = "2e6 N/m"
    c_xx = "100 N s/m"
    c_yy = "100 N s/m"
"#;

fn rotor(set: &[(String, String)]) -> Result<Model, UpdateError> {
    let options = Options { variant: None, set: set.to_vec() };
    Ok(load("two_discs.toml", ROTOR, &options).unwrap_or_else(|errors| panic!("{errors:?}")).model)
}

fn state(model: Model, modes: Vec<TargetMode>) -> (ModelState, Target) {
    let point = |name: &str| model.stations.iter().find(|s| s.name == name).unwrap().node as i64 + 1;
    let dofs: Vec<Dof> =
        ["A", "left", "right", "B"].iter().flat_map(|n| [1, 2].map(|d| Dof::new(point(n), d))).collect();
    let sensors = sensors(&dofs, &Default::default(), &model).unwrap();
    let target = Target { speed: 0.0, sensors, modes, frfs: None };
    (ModelState::new(model, &target, None).unwrap(), target)
}

fn mode(frequency_hz: f64, shape: Vec<Complex64>) -> TargetMode {
    TargetMode {
        frequency_hz,
        damping_ratio: None,
        frequency_error: 0.0,
        damping_error: 0.0,
        shape,
        shape_error: 0.0,
        quality_warnings: Vec::new(),
    }
}

/// Modes below 300 Hz, both shapes of each pair rotated by an angle that differs between pairs, with 1 % of noise.
fn measured(model: Model, angle: f64) -> Target {
    let (found, target) = state(model, vec![mode(300.0, vec![Complex64::new(1.0, 0.0); 8]); 6]);
    let bending: Vec<usize> = (0..found.modes.len())
        .filter(|&k| found.modes[k].frequency_hz() < 300.0 && found.modes[k].label.contains("bending"))
        .collect();
    assert!(bending.len() >= 6 && bending.len().is_multiple_of(2), "{}", bending.len());
    let mut seed = 17_u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    let mut modes = Vec::new();
    for (k, pair) in bending.chunks(2).enumerate() {
        let (sin, cos) = (angle * (1.0 + k as f64)).sin_cos();
        let [x, y] = [&found.shapes[pair[0]], &found.shapes[pair[1]]];
        let largest = x.iter().chain(y).map(|v| v.norm()).fold(0.0, f64::max);
        for [a, b] in [[cos, sin], [-sin, cos]] {
            let shape = x.iter().zip(y).map(|(x, y)| x * a + y * b + 0.01 * largest * noise()).collect();
            modes.push(mode(found.modes[pair[0]].frequency_hz() * (1.0 + 2e-4 * noise()), shape));
        }
    }
    Target { modes, ..target }
}

fn free(name: &str, paths: &[&str], value: f64, unit: &str) -> FreeParameter {
    let places = paths
        .iter()
        .map(|p| ModelNumber { path: (*p).into(), value, unit: unit.into(), quoted: true })
        .collect();
    FreeParameter::new(name, places, true, None).unwrap()
}

#[test]
fn bearings_and_shaft_from_rotated_shapes_of_mode_pairs() {
    let bearings = ["bearing.A.k_xx", "bearing.A.k_yy", "bearing.B.k_xx", "bearing.B.k_yy"];
    let parameters =
        [free("k", &bearings, 2e6, "N/m"), free("young", &["material.steel.young"], 207.0, "GPa")];
    let mut truth: Vec<(String, String)> =
        bearings.iter().map(|p| (p.to_string(), "\"3.2e6 N/m\"".into())).collect();
    truth.push(("material.steel.young".into(), "\"190 GPa\"".into()));
    for angle in [0.0, 0.4, std::f64::consts::FRAC_PI_4] {
        let target = measured(rotor(&truth).unwrap(), angle);
        let fitting = Fitting::default();
        let job = UpdateJob {
            parameters: &parameters,
            target: &target,
            fitting: &fitting,
            load: &rotor,
            max_iterations: 30,
            fixed: &[],
        };
        let found = update(&job).unwrap();
        println!("{angle}: {:?}", found.outcomes);
        assert!(found.converged);
        assert_eq!(found.fitted_modes.len(), target.modes.len());
        for (j, truth) in [3.2e6, 190.0].into_iter().enumerate() {
            assert_eq!(found.outcomes[j].class, IdentifiabilityClass::Identifiable);
            let off = (parameters[j].value(found.outcomes[j].x) / truth).ln();
            assert!(off.abs() < 2.0 * found.outcomes[j].error, "{angle}: off by {off:.5}");
            assert!(off.abs() < 5e-3, "{angle}: off by {off:.5}");
        }
        let macs: Vec<f64> = found.after.pairing.pairs.iter().map(|p| p.mac).collect();
        assert!(macs.iter().all(|mac| *mac > 0.99), "{angle}: {macs:?}");
    }
}
