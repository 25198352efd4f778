//! The linear part of a time step as one matrix, from one inversion for many steps.

use nalgebra::DMatrix;

use super::Scheme;
use crate::model::Spin;
use crate::transient::system::System;
use rotordyn_linalg::panel::Panel;
use serde::{Deserialize, Serialize};

/// Largest (Ω − Ω_f) h for which matrices inverted at Ω_f are used, by their second-order expansion in Ω: the neglected
/// terms are 1e-7 of the gyroscopic effect.
const LARGEST_SPEED_CHANGE: f64 = 3e-4;
/// Largest change of Ω̇ h²: the part of the effective matrix by Ω̇ is that of the inversion.
const LARGEST_ACCELERATION_CHANGE: f64 = 1e-8;
/// Largest number of steps N with the matrices of the speed in their middle, and the largest ¼ N² h² Ω̇: the change of
/// velocity by gyroscopic forces, in parts, that is too large in the first half of them and too small in the second.
const LARGEST_WINDOW: f64 = 32.0;
const LARGEST_WINDOW_ERROR: f64 = 1e-5;
/// Largest change of Ω̇ over these steps, relative to that of the first: a window ends before a bend of the speed.
const LARGEST_BEND: f64 = 0.1;
/// Largest (Ω − Ω_w) h under a torque drive, where what the matrices of Ω_w leave out is iterated.
const LARGEST_DRIVEN_CHANGE: f64 = 1e-5;

/// Step matrices by step length.
#[derive(Default)]
pub(super) struct StepMatrices {
    matrices: Vec<StepMatrix>,
    /// Number of inversions.
    pub inverted: u64,
}

/// The linear part of a step of one length h, ẍ₁ = F (v̂, x̂, c) + R f₁ + S⁻¹ e, near one speed.
///
/// S ẍ₁ = P c + Wᵀ f₁ + e − (C + Ω G) v̂ − (K + Ω̇ K_s + Ω K_c) x̂ with loads P c at the end of the step, and loads e of a
/// torque drive; S = M̂ + g (γ h (C + Ω G) + β h² (K + Ω̇ K_s + Ω K_c)) = S₀ + κ S′, κ = Ω − Ω_f, so that
/// F ≈ F₀ + κ F₁ − κ² T F₁ with T = S₀⁻¹ S′.
pub(super) struct StepMatrix {
    step: f64,
    /// Speed Ω_f \[rad/s\] and acceleration \[rad/s²\] of the inversion.
    inversion: [f64; 2],
    window: Window,
    /// F.
    free: Expansion,
    /// R = S⁻¹ Wᵀ, coordinates × rows.
    response: Expansion,
    compliance: Compliance,
    compliance_terms: [DMatrix<f64>; 3],
    /// S⁻¹, under a torque drive.
    inverse: Option<Expansion>,
}

/// Y = W R = W S⁻¹ Wᵀ, rows × rows.
pub(super) struct Compliance {
    /// Row-major.
    pub rows: Vec<f64>,
    product: Panel,
}

impl Compliance {
    fn new(rows: usize) -> Self {
        Self { rows: vec![0.0; rows * rows], product: Panel::new(&[&DMatrix::zeros(rows, rows)]) }
    }

    /// Sets Y = Y₀ + κ Y₁ + κ² Y₂, the terms transposed.
    fn set(&mut self, terms: &[DMatrix<f64>; 3], change: f64) {
        let [at_inversion, first, second] = terms;
        let terms = at_inversion.iter().zip(first).zip(second);
        self.rows.clear();
        self.rows.extend(terms.map(|((a, b), c)| a + change * (b + change * c)));
        let rows = at_inversion.nrows();
        let mut column = Vec::with_capacity(rows);
        for k in 0..rows {
            column.clear();
            column.extend(self.rows.iter().skip(k).step_by(rows));
            self.product.set_column(k, &column);
        }
    }

    /// Y f.
    #[inline(always)]
    pub fn times(&self, force: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        self.product.mul_add(force, out);
    }
}

/// Speed \[rad/s\] and acceleration \[rad/s²\] of the matrices, and the first and last time at which steps with them end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Window {
    speed: f64,
    acceleration: f64,
    times: [f64; 2],
}

impl Window {
    /// That of the steps from one that ends at a time with `spin` on.
    fn ahead(system: &System, step: f64, time: f64, spin: &Spin) -> Self {
        let steps = (4.0 * LARGEST_WINDOW_ERROR / spin.acceleration.abs()).sqrt() / step;
        let mut steps = steps.clamp(1.0, LARGEST_WINDOW).floor();
        let last = system.spin_ahead(time, spin, (steps - 1.0) * step).acceleration;
        if (last - spin.acceleration).abs() > LARGEST_BEND * spin.acceleration.abs() {
            steps = 1.0;
        }
        let middle = system.spin_ahead(time, spin, 0.5 * (steps - 1.0) * step);
        Self {
            speed: middle.speed,
            acceleration: middle.acceleration,
            times: [time - 0.5 * step, time + (steps - 0.5) * step],
        }
    }

    fn holds(&self, time: f64, spin: &Spin) -> bool {
        let [first, last] = self.times;
        [self.speed, self.acceleration] == [spin.speed, spin.acceleration] || (first..=last).contains(&time)
    }
}

/// A matrix A₀ + κ A₁ + κ² A₂ + (Ω̇ − Ω̇_f) A₃, A₃ where there is one, and its value at present.
struct Expansion {
    terms: [Panel; 3],
    by_acceleration: Option<Panel>,
    present: Panel,
}

impl Expansion {
    fn new(terms: &[DMatrix<f64>; 3], by_acceleration: Option<DMatrix<f64>>) -> Self {
        let terms = terms.each_ref().map(|term| Panel::new(&[term]));
        let by_acceleration = by_acceleration.map(|term| Panel::new(&[&term]));
        Self { present: terms[0].clone(), terms, by_acceleration }
    }

    fn set(&mut self, change: f64, acceleration_change: f64) {
        let [at_inversion, first, second] = &self.terms;
        self.present.set_to_sum(at_inversion, [(change, first), (change * change, second)]);
        if let Some(term) = self.by_acceleration.as_ref().filter(|_| acceleration_change != 0.0) {
            self.present.add(acceleration_change, term);
        }
    }
}

/// Step length, speed and acceleration of an inversion, and the window for which its matrices are at present.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Inversion {
    step: f64,
    at: [f64; 2],
    window: Window,
}

/// Every inversion in use, and the number of inversions: they give the same matrices again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Inversions {
    in_use: Vec<Inversion>,
    count: u64,
}

impl StepMatrices {
    /// When the matrices were inverted.
    pub fn inversions(&self) -> Inversions {
        let of = |m: &StepMatrix| Inversion { step: m.step, at: m.inversion, window: m.window };
        Inversions { in_use: self.matrices.iter().map(of).collect(), count: self.inverted }
    }

    /// The matrices of earlier inversions, inverted again.
    pub fn repeat(system: &System, scheme: Scheme, inversions: &Inversions) -> Self {
        let again = |of: &Inversion| StepMatrix::new(system, scheme, of.step, of.at, of.window);
        Self { matrices: inversions.in_use.iter().map(again).collect(), inverted: inversions.count }
    }

    /// The matrices of a step that ends at a time \[s\] with `spin`, inverted again if the speed has changed too much.
    pub fn at(&mut self, system: &System, scheme: Scheme, step: f64, time: f64, spin: &Spin) -> &StepMatrix {
        let holds = |window: &Window| match system.drive {
            None => window.holds(time, spin),
            Some(_) => ((spin.speed - window.speed) * step).abs() <= LARGEST_DRIVEN_CHANGE,
        };
        let k = match self.matrices.iter().position(|matrix| matrix.step == step) {
            Some(k) if holds(&self.matrices[k].window) => return &self.matrices[k],
            Some(k) => k,
            None => self.matrices.len(),
        };
        let window = match system.drive {
            None => Window::ahead(system, step, time, spin),
            Some(_) => Window { speed: spin.speed, acceleration: 0.0, times: [time; 2] },
        };
        if self.matrices.get(k).is_some_and(|matrix| matrix.reaches(&window)) {
            self.matrices[k].set(window);
        } else {
            self.inverted += 1;
            let new = StepMatrix::new(system, scheme, step, [window.speed, window.acceleration], window);
            if k == self.matrices.len() {
                self.matrices.push(new);
            } else {
                self.matrices[k] = new;
            }
        }
        &self.matrices[k]
    }
}

impl StepMatrix {
    fn new(system: &System, scheme: Scheme, step: f64, at: [f64; 2], window: Window) -> Self {
        let (n, [speed, acceleration]) = (system.structure(), at);
        let gain = scheme.gain(step);
        let damping = &system.damping + &system.gyroscopic * speed;
        let stiffness = &system.stiffness + &system.spin_up * acceleration + &system.circulatory * speed;
        let inertia = system.natural_frequencies.map(|frequency| scheme.inertia(frequency, step));
        let effective =
            DMatrix::from_diagonal(&inertia) + &damping * gain.velocity + &stiffness * gain.position;
        // The effective matrix is diagonal but for terms of order h: invertible for any useful step length;
        // a singular one yields NaN, which the divergence check of the driver reports.
        let inverse = effective.try_inverse().unwrap_or_else(|| DMatrix::from_element(n, n, f64::NAN));
        let turn = &inverse * (&system.gyroscopic * gain.velocity + &system.circulatory * gain.position);
        // A₀, A₁ and A₂ of S⁻¹ B for B = B₀ + κ B₁, from S₀⁻¹ B₀ and S₀⁻¹ B₁.
        let expansion = |at_inversion: DMatrix<f64>, by_speed: Option<DMatrix<f64>>| {
            let mut first = -(&turn * &at_inversion);
            if let Some(by_speed) = by_speed {
                first += by_speed;
            }
            let second = -(&turn * &first);
            [at_inversion, first, second]
        };

        let loads = system.load_matrix();
        let none = DMatrix::zeros(n, loads.ncols());
        let zero = DMatrix::zeros(n, n);
        let free = expansion(
            &inverse * side_by_side(&[&-damping, &-stiffness, &loads]),
            Some(&inverse * side_by_side(&[&-&system.gyroscopic, &-&system.circulatory, &none])),
        );
        let by_acceleration = || &inverse * side_by_side(&[&zero, &-&system.spin_up, &none]);
        let response = expansion(&inverse * system.interface_map.transpose(), None);
        let mut new = Self {
            step,
            inversion: at,
            window,
            free: Expansion::new(&free, system.panels.has_spin_up().then(by_acceleration)),
            // Column-major of the transpose is row-major.
            compliance_terms: response.each_ref().map(|r| (&system.interface_map * r).transpose()),
            compliance: Compliance::new(system.rows()),
            response: Expansion::new(&response, None),
            inverse: system.drive.is_some().then(|| Expansion::new(&expansion(inverse.clone(), None), None)),
        };
        new.set(window);
        new
    }

    /// Whether the expansion holds for a window.
    fn reaches(&self, window: &Window) -> bool {
        let [speed, acceleration] = self.inversion;
        ((speed - window.speed) * self.step).abs() <= LARGEST_SPEED_CHANGE
            && ((acceleration - window.acceleration) * self.step * self.step).abs()
                <= LARGEST_ACCELERATION_CHANGE
    }

    /// The matrices of a window.
    fn set(&mut self, window: Window) {
        let [speed, acceleration] = self.inversion;
        let (change, acceleration_change) = (window.speed - speed, window.acceleration - acceleration);
        for expansion in [&mut self.free, &mut self.response].into_iter().chain(&mut self.inverse) {
            expansion.set(change, acceleration_change);
        }
        self.compliance.set(&self.compliance_terms, change);
        self.window = window;
    }

    /// Speed of the matrices \[rad/s\].
    pub fn speed(&self) -> f64 {
        self.window.speed
    }

    /// Adds F (v̂, x̂, c) to `out`.
    pub fn add_free(&self, parts: &[f64], out: &mut [f64]) {
        self.free.present.mul_add(parts, out);
    }

    /// Adds R f to `out`.
    pub fn add_response(&self, force: &[f64], out: &mut [f64]) {
        self.response.present.mul_add(force, out);
    }

    /// Adds S⁻¹ e to `out`, under a torque drive.
    pub fn add_inverse(&self, load: &[f64], out: &mut [f64]) {
        if let Some(inverse) = &self.inverse {
            inverse.present.mul_add(load, out);
        }
    }

    /// Y = W R.
    pub fn compliance(&self) -> &Compliance {
        &self.compliance
    }
}

/// Matrices with the same number of rows beside each other.
fn side_by_side(blocks: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let columns: Vec<_> = blocks.iter().flat_map(|block| block.column_iter()).collect();
    DMatrix::from_columns(&columns)
}
