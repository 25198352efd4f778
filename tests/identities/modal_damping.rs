//! Modal damping: one matrix C = M Φ diag(2 ζ ω) Φᵀ M of the symmetric stiffness at standstill in every study,
//! checked against dense algebra of its own.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};
use rotordyn::analysis::sensitivity::{Linearised, frf_sensitivity};
use rotordyn::analysis::unbalance;
use rotordyn::assembly::LinearSystem;
use rotordyn::linalg::{Complex64, SparseMatrix};
use rotordyn::model::{self, Model, Options, Quantity, study};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

/// An overhung rotor with an asymmetric housing, on two bearings with these lines, of `elements` elements.
pub fn overhung(elements: usize, bearings: [&str; 2], ratio: &str) -> Model {
    let [a, b] = bearings;
    let text = format!(
        "[model]\nname = \"overhung\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [shaft]\nmaterial = \"steel\"\nelement_length = \"{} mm\"\n\
         section = [{{ length = \"600 mm\", outer_diameter = \"25 mm\" }}]\n\
         [station]\nA = \"0 mm\"\nB = \"400 mm\"\nend = \"600 mm\"\n\
         [disc.wheel]\nstation = \"end\"\nouter_diameter = \"220 mm\"\nthickness = \"25 mm\"\nmaterial = \"steel\"\n\
         [unbalance.wheel]\nstation = \"end\"\nmass = \"2 g\"\nradius = \"100 mm\"\n\
         [bearing.A]\nstation = \"A\"\nmodel = \"linear\"\nk_zz = \"1e7 N/m\"\n{a}\n\
         [bearing.B]\nstation = \"B\"\nmodel = \"linear\"\n{b}\n\
         [drive]\nkind = \"prescribed\"\nstation = \"A\"\n\
         [speed]\nprofile = \"constant\"\nspeed = \"2000 rpm\"\nduration = \"1 s\"\n\
         [damping.modal]\nfrequency = \"20, 200 Hz\"\nratio = {ratio}\n\
         [probe.wheel_x]\nat = \"station.end\"\ndirection = \"x\"\n\
         [study.frf]\nfrequencies = {{ from = \"5 Hz\", to = \"405 Hz\", step = \"8 Hz\" }}\nspeed = \"3000 rpm\"\n\
         [study.frf.excitation.wheel]\nat = \"station.end\"\ndirection = \"x\"\n\
         [study.unbalance]\nspeeds = {{ from = \"300 rpm\", to = \"9000 rpm\", step = \"300 rpm\" }}\n\
         [study.run_up]\nstep = \"100 us\"\nsample_rate = \"1 kHz\"\ncutoff = \"1000 kHz\"\n",
        600 / elements
    );
    match model::load("overhung.toml", text, &Options::default()) {
        Ok(loaded) => loaded.model,
        Err(errors) => panic!("{errors:?}"),
    }
}

/// Cross-coupled k_xy = −k_yx larger than the direct stiffness, as of a whirling film.
pub const CROSS: [&str; 2] = [
    "k_xx = \"2e5 N/m\"\nk_yy = \"2e5 N/m\"\nk_xy = \"2.5e5 N/m\"\nk_yx = \"-2.5e5 N/m\"\nc_xx = \"300 N s/m\"\nc_yy = \"300 N s/m\"",
    "k_xx = \"3e6 N/m\"\nk_yy = \"2e6 N/m\"\nk_xy = \"4e5 N/m\"\nk_yx = \"-1e5 N/m\"",
];
/// The same at one end, tabulated over speed at the other.
pub const TABLE: [&str; 2] = [
    CROSS[0],
    "speed = \"0, 3000, 12000 rpm\"\nk_xx = \"3e6, 5e6, 9e6 N/m\"\nk_yy = \"2e6, 3e6, 8e6 N/m\"\n\
     k_xy = \"4e5, 8e5, 2e6 N/m\"\nk_yx = \"-1e5, -8e5, -2e6 N/m\"\nc_xx = \"200, 300, 100 N s/m\"\nc_yy = \"200, 300, 100 N s/m\"",
];
pub const ISOTROPIC: [&str; 2] =
    ["k_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"", "k_xx = \"2e7 N/m\"\nk_yy = \"2e7 N/m\""];
pub const RATIO: &str = "[0.01, 0.03]";

fn ratio(omega: f64) -> f64 {
    0.01 + 0.02 * ((omega / TAU - 20.0) / 180.0).clamp(0.0, 1.0)
}

/// C from its definition: M = L Lᵀ, L⁻¹ ½ (K + Kᵀ) L⁻ᵀ = V ω² Vᵀ, C = L V 2 ζ ω Vᵀ Lᵀ, K without bearings' skew part.
fn dense_modal_damping(machine: &Machine) -> DMatrix<f64> {
    let tangents = machine.tangents(0.0, true).unwrap();
    let standstill = LinearSystem::new(&machine.assembly, &tangents, 0.0).unwrap();
    let (m, k) = (standstill.mass.to_dense(), standstill.stiffness.to_dense());
    let lower = Cholesky::new(m).unwrap().unpack();
    let half = lower.solve_lower_triangular(&(0.5 * (&k + k.transpose()))).unwrap();
    let congruent = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let found = SymmetricEigen::new(0.5 * (&congruent + congruent.transpose()));
    let mut scaled = found.eigenvectors.clone();
    for (mut column, square) in scaled.column_iter_mut().zip(found.eigenvalues.iter()) {
        let omega = square.max(0.0).sqrt();
        column *= 2.0 * omega * ratio(omega);
    }
    &lower * scaled * found.eigenvectors.transpose() * lower.transpose()
}

/// The dense matrices M, D, S at a speed, with C of standstill in D.
struct Dense {
    m: DMatrix<f64>,
    d: DMatrix<f64>,
    s: DMatrix<f64>,
}

impl Dense {
    fn new(machine: &Machine, modal: &DMatrix<f64>, speed: f64) -> Self {
        let system = machine.linear_system(speed).unwrap();
        let d = system.damping.to_dense() + modal;
        Self { m: system.mass.to_dense(), d, s: system.stiffness.to_dense() }
    }

    /// λ² M + λ D + S.
    fn dynamic(&self, value: Complex64) -> DMatrix<Complex64> {
        DMatrix::from_fn(self.m.nrows(), self.m.ncols(), |i, j| {
            value * value * self.m[(i, j)] + value * self.d[(i, j)] + self.s[(i, j)]
        })
    }

    /// The eigenvalue next to λ, φ by inverse iteration x ← T⁻¹ T′ x, λ ← λ − 1/(cᴴ x), started 1e-4 beside it.
    fn eigenvalue(&self, value: Complex64, shape: &[Complex64]) -> Complex64 {
        let mut at = value * Complex64::new(1.0, 1e-4);
        let mut x = DVector::from_column_slice(shape);
        for _ in 0..6 {
            x /= Complex64::from(x.norm());
            let slope = DMatrix::from_fn(x.len(), x.len(), |i, j| 2.0 * at * self.m[(i, j)] + self.d[(i, j)]);
            let Some(next) = self.dynamic(at).lu().solve(&(slope * &x)) else { break };
            at -= x.norm_squared() / x.dotc(&next);
            x = next;
        }
        at
    }
}

/// Largest difference of the listed modes from those of the dense matrices, over speeds.
fn eigenvalue_error(machine: &Machine, modes: usize) -> f64 {
    let modal = dense_modal_damping(machine);
    let mut worst: f64 = 0.0;
    for rpm in [0.0, 1700.0, 8000.0] {
        let speed = rpm / 60.0 * TAU;
        let dense = Dense::new(machine, &modal, speed);
        let found = machine.modal(&study::ModalStudy { speeds: vec![speed], modes }).unwrap();
        assert_eq!(found[0].modes.len(), modes);
        for mode in &found[0].modes {
            let exact = dense.eigenvalue(mode.eigenvalue, &mode.shape);
            worst = worst.max((mode.eigenvalue - exact).norm() / exact.norm());
        }
    }
    worst
}

#[test]
fn eigenvalues_equal_those_of_the_dense_definition() {
    for (name, bearings) in [("cross", CROSS), ("table", TABLE), ("isotropic", ISOTROPIC)] {
        let machine = Machine::new(overhung(12, bearings, RATIO)).unwrap();
        let worst = eigenvalue_error(&machine, 9);
        println!("{name}: {worst:.1e}");
        // The dense definition's own round-off, of the stiffest mode relative to the softest, is about 1e-10.
        assert!(worst < 1e-9, "{name}: {worst:e}");
    }
}

/// Of an axisymmetric rotor on bearings with equal direct stiffness, cross-coupling k_xy = −k_yx turns every
/// double mode into a forward and a backward one: ω² ± j r, with the damping of the undamped mode in both.
#[test]
fn skew_coupling_does_not_change_the_damping_matrix() {
    let bearing = |skew: &str| {
        format!("k_xx = \"4e5 N/m\"\nk_yy = \"4e5 N/m\"\nk_xy = \"{skew} N/m\"\nk_yx = \"-{skew} N/m\"")
    };
    let damping = |skew: &str| {
        let text = bearing(skew);
        let machine = Machine::new(overhung(6, [&text, &text], RATIO)).unwrap();
        machine.linear_system(0.0).unwrap().full_damping().to_dense()
    };
    let plain = damping("0");
    for skew in ["1e5", "4e5", "2e6"] {
        let difference = (damping(skew) - &plain).amax() / plain.amax();
        assert!(difference < 1e-9, "{skew}: {difference:e}");
    }
}

#[test]
fn responses_equal_dense_elimination() {
    // Heavy damping too, where the iteration needs more products.
    for (name, bearings) in [("cross", CROSS), ("table", TABLE), ("isotropic", ISOTROPIC)] {
        let machine = Machine::new(overhung(12, bearings, RATIO)).unwrap();
        let modal = dense_modal_damping(&machine);
        let probe = &machine.model.probes[0];
        let row = machine.assembly.direction_row(&probe.at, &probe.direction);
        let response = |dense: &Dense, omega: f64, load: &DVector<Complex64>| {
            let q = dense.dynamic(Complex64::new(0.0, omega)).lu().solve(load).unwrap();
            row.dot_complex(q.as_slice())
        };

        let frf_study = machine.model.studies.frf.clone().unwrap();
        let frf = machine.frf(&frf_study).unwrap().frf;
        let dense = Dense::new(&machine, &modal, frf_study.speed);
        let mut unit = DVector::from_element(machine.assembly.dofs.len(), Complex64::default());
        row.0.iter().for_each(|&(i, v)| unit[i] += v);
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for (hz, h) in frf.frequencies.iter().zip(&frf.values[0][0]) {
            let expected = response(&dense, TAU * hz, &unit);
            let h = h / rotordyn::analysis::frf::derivative_factor(frf.quantity, TAU * hz);
            worst = worst.max((h - expected).norm() / expected.norm());
        }
        println!("{name}: FRF {worst:.1e}");
        assert!(worst < 1e-8, "{name}: FRF {worst:e}");

        let study = machine.model.studies.unbalance.clone().unwrap();
        let speeds = machine.unbalance(&study).unwrap().speeds;
        let tangents = |speed| machine.tangents(speed, true);
        let motions = unbalance::response(&machine.assembly, &speeds, &tangents, |motion| motion).unwrap();
        worst = 0.0;
        for (&speed, motion) in speeds.iter().zip(motions) {
            let load = DVector::from_vec(machine.assembly.unbalance_amplitude(speed));
            let expected = response(&Dense::new(&machine, &modal, speed), speed, &load);
            let found = row.dot_complex(&motion.amplitude);
            worst = worst.max((found - expected).norm() / expected.norm());
            largest = largest.max(found.norm());
        }
        println!("{name}: unbalance {worst:.1e}, {:.3} mm", 1e3 * largest);
        assert!(worst < 1e-8, "{name}: unbalance {worst:e}");
    }
}

/// A run-up that keeps all modes has exactly the damping of the FRF, at whatever speed it starts.
#[test]
fn run_up_and_frf_have_the_same_damping() {
    for bearings in [CROSS, TABLE] {
        let machine = Machine::new(overhung(6, bearings, RATIO)).unwrap();
        let reduction = machine.reduce(&machine.model.studies.run_up.clone().unwrap()).unwrap();
        let basis = &reduction.basis;
        let modal = basis.transpose() * dense_modal_damping(&machine) * basis;
        let rest = basis.transpose() * machine.assembly.damping.to_dense() * basis;
        let size = basis.ncols();
        let ours = reduction.system.damping.view((0, 0), (size, size)) - rest;
        let difference = (&ours - &modal).amax() / modal.amax();
        assert!(difference < 1e-9, "{difference:e}");
    }
}

/// dH/dp at 3000 rpm with respect to a bearing's table, which changes the damping through standstill.
#[test]
fn frf_sensitivity_to_a_table_includes_the_damping_at_standstill() {
    let scaled = |f: f64| {
        let kxx = format!("k_xx = \"{:e}, 5e6, 9e6 N/m\"", 3e6 * f);
        let table = TABLE[1].replace("k_xx = \"3e6, 5e6, 9e6 N/m\"", &kxx);
        overhung(6, [TABLE[0], &table], "[0.05, 0.1]")
    };
    let speed = 3000.0 / 60.0 * TAU;
    let value = |f: f64, by: Option<f64>| {
        let at = Linearised::new(scaled(f), speed, None).unwrap();
        let probe = &at.model.probes[0];
        let row = [at.assembly.direction_row(&probe.at, &probe.direction)];
        let slope = by.map(|h| at.derivative(&scaled(1.0 - h), &scaled(1.0 + h), 2.0 * h).unwrap());
        let by: Vec<_> = slope.iter().collect();
        let found = frf_sensitivity(&at, &[20.0, 45.0], &row, &row, &[Quantity::Displacement], &by).unwrap();
        (found.values[0][0].clone(), found.derivatives.first().map(|d| d[0][0].clone()))
    };
    let ours = value(1.0, Some(1e-4)).1.unwrap();
    let h = 1e-3;
    let (high, low) = (value(1.0 + h, None).0, value(1.0 - h, None).0);
    for k in 0..2 {
        // At 3000 rpm the table's second row holds: the first one acts through standstill only.
        let expected = (high[k] - low[k]) / (2.0 * h);
        assert!(
            expected.norm() > 0.0 && (ours[k] - expected).norm() < 1e-5 * expected.norm(),
            "{ours:?} {expected}"
        );
    }
}

/// The patterns of a system cover every entry of its damping.
#[test]
fn patterns_cover_the_damping() {
    let machine = Machine::new(overhung(6, TABLE, RATIO)).unwrap();
    let system = machine.linear_system(300.0).unwrap();
    let layout = &system.layout;
    let mut group = vec![usize::MAX; layout.size()];
    for (g, unknowns) in layout.groups().enumerate() {
        unknowns.iter().for_each(|&i| group[i] = g);
    }
    let full: SparseMatrix = system.full_damping();
    assert!(full.iter().all(|(i, j, v)| v == 0.0 || group[i] == group[j]));
}
