//! Derivatives of double eigenvalues of an axisymmetric rotor at rest compared with finite differences.

use rotordyn::analysis::modal::{self, Mode};
use rotordyn::analysis::sensitivity::{Linearised, ModeSensitivity, SystemDerivative};
use rotordyn::element::Anchor;
use rotordyn::linalg::{Complex64, SparseRow};
use rotordyn::model::{Model, Options, load};

/// Shaft with one disc off midspan; factors on k_xx and k_yy of bearing A and on the shaft's modulus.
fn rotor(factor: [f64; 3]) -> Model {
    let text = format!(
        r#"
        [model]
        name = "round"
        [material.steel]
        young = "{:e} GPa"
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
        mass = "10 kg"
        polar_inertia = "0.05 kg m^2"
        diametral_inertia = "0.03 kg m^2"
        [bearing.A]
        station = "A"
        model = "linear"
        k_xx = "{:e} N/m"
        k_yy = "{:e} N/m"
        k_zz = "1e7 N/m"
        c_xx = "200 N s/m"
        c_yy = "200 N s/m"
        [bearing.B]
        station = "B"
        model = "linear"
        k_xx = "3e6 N/m"
        k_yy = "3e6 N/m"
        c_xx = "300 N s/m"
        c_yy = "300 N s/m"
        "#,
        207.0 * factor[2],
        2e6 * factor[0],
        2e6 * factor[1],
    );
    load("round.toml", text, &Options::default()).unwrap().model
}

const STEP: f64 = 1e-4;
const COUNT: usize = 6;

fn modes(factor: [f64; 3]) -> Vec<Mode> {
    let at = Linearised::new(rotor(factor), 0.0, None).unwrap();
    modal::modes(&at.assembly, &at.system, COUNT).unwrap()
}

/// The two modes nearest to λ.
fn pair_near(modes: &[Mode], value: Complex64) -> [&Mode; 2] {
    let mut all: Vec<&Mode> = modes.iter().collect();
    all.sort_by(|a, b| (a.eigenvalue - value).norm().total_cmp(&(b.eigenvalue - value).norm()));
    [all[0], all[1]]
}

/// Every double eigenvalue of the rotor with its two shapes rotated by 0.6 rad.
fn rotated_doubles(at: &Linearised) -> Vec<(Complex64, [Vec<Complex64>; 2])> {
    let found = modal::modes(&at.assembly, &at.system, COUNT).unwrap();
    let doubles = modal::double_eigenvalue_partners(&at.system, &found);
    let (sin, cos) = 0.6_f64.sin_cos();
    let mix = |k: usize, o: usize, a: f64, b: f64| -> Vec<Complex64> {
        found[k].shape.iter().zip(&found[o].shape).map(|(x, y)| x * a + y * b).collect()
    };
    let of = |(k, other): (usize, &Option<usize>)| {
        let other = other.filter(|other| *other > k)?;
        Some((found[k].eigenvalue, [mix(k, other, cos, sin), mix(k, other, -sin, cos)]))
    };
    doubles.iter().enumerate().filter_map(of).collect()
}

fn derivative(at: &Linearised, model: &dyn Fn(f64) -> [f64; 3]) -> SystemDerivative {
    at.derivative(&rotor(model(1.0 - STEP)), &rotor(model(1.0 + STEP)), 2.0 * STEP).unwrap()
}

#[test]
fn eigenvalue_derivatives_from_projected_problem() {
    let at = Linearised::new(rotor([1.0; 3]), 0.0, None).unwrap();
    let all = rotated_doubles(&at);
    assert!(all.len() >= 2, "{}", all.len());
    let ways: [&dyn Fn(f64) -> [f64; 3]; 3] = [&|f| [f, 1.0, 1.0], &|f| [f, f, 1.0], &|f| [1.0, 1.0, f]];
    for (value, [u, v]) in &all {
        let sensitivities = [
            ModeSensitivity::of_double_eigenvalue(&at.system, *value, u, v).unwrap(),
            ModeSensitivity::of_double_eigenvalue(&at.system, *value, v, u).unwrap(),
        ];
        for (splits, way) in ways.iter().enumerate().map(|(k, way)| (k == 0, way)) {
            let by = derivative(&at, way);
            let [a, d] = sensitivities.each_ref().map(|s| s.eigenvalue_derivative(&by));
            let [c, b] = sensitivities.each_ref().map(|s| s.coupling(&by));
            // The sum and the squared difference of both eigenvalues are smooth in the parameter.
            let (trace, split) = (a + d, (a - d) * (a - d) + 4.0 * b * c);
            let h = 1e-3;
            let [low, high] = [1.0 - h, 1.0 + h].map(|f| {
                let found = modes(way(f));
                let pair = pair_near(&found, *value);
                let [p, q] = pair.map(|m| m.eigenvalue);
                (p + q, (p - q) * (p - q))
            });
            let theirs = (high.0 - low.0) / (2.0 * h);
            assert!((trace - theirs).norm() < 1e-5 * theirs.norm(), "{trace} {theirs}");
            let theirs = (high.1 + low.1) / (2.0 * h * h);
            let error = (split - theirs).norm() / trace.norm_sqr();
            assert!(error < 1e-4, "{split} {theirs} {error:.1e}");
            assert_eq!(split.norm() > 0.1 * trace.norm_sqr(), splits);
            // A change in one plane couples the shapes rotated by 0.6 rad.
            assert_eq!(c.norm() > 0.1 * trace.norm(), splits, "{c} of {trace}");
        }
    }
}

#[test]
fn shape_derivatives_stay_in_plane() {
    let at = Linearised::new(rotor([1.0; 3]), 0.0, None).unwrap();
    let row = |at: &Linearised, name: &str, direction: usize| -> SparseRow {
        let node = at.model.stations.iter().find(|s| s.name == name).unwrap().node;
        at.assembly.anchor_rows(&Anchor::node(node))[direction].clone()
    };
    let way = |f: f64| [1.0, 1.0, f];
    let by = derivative(&at, &way);
    for (value, [u, v]) in &rotated_doubles(&at) {
        let slope = ModeSensitivity::of_double_eigenvalue(&at.system, *value, u, v)
            .unwrap()
            .shape_derivatives(&[&by])
            .unwrap();
        for direction in [0, 1] {
            let [disc, end] = ["disc", "B"].map(|name| row(&at, name, direction));
            let [d, e, dd, de] = [
                disc.dot_complex(u),
                end.dot_complex(u),
                disc.dot_complex(&slope[0]),
                end.dot_complex(&slope[0]),
            ];
            let ours = de / d - e * dd / (d * d);
            let ratio = |f: f64| {
                let there = Linearised::new(rotor(way(f)), 0.0, None).unwrap();
                let found = modal::modes(&there.assembly, &there.system, COUNT).unwrap();
                // One of the two lies in this plane.
                let [disc, end] = ["disc", "B"].map(|name| row(&there, name, direction));
                let size = |m: &&Mode| disc.dot_complex(&m.shape).norm();
                let pair = pair_near(&found, *value);
                let mode = pair.into_iter().max_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
                end.dot_complex(&mode.shape) / disc.dot_complex(&mode.shape)
            };
            let h = 1e-3;
            let theirs = (ratio(1.0 + h) - ratio(1.0 - h)) / (2.0 * h);
            let error = (ours - theirs).norm() / theirs.norm();
            assert!(error < 1e-4, "{direction}: {ours} {theirs} {error:.1e}");
        }
    }
}
