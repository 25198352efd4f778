//! The six-degree-of-freedom bearing of Atef et al. 2022 (eq. 17-19) with dents and bumps, as a source of records whose
//! defects are known.
//!
//! Axes of the paper: x along the load, angles from x. A defect's depth enters inside the Hertz deflection. Parameters:
//! the complete set "REF_A" that reproduces the paper's figures.

use std::f64::consts::{PI, TAU};

pub const STEP: f64 = 6e-6;
pub const BALLS: usize = 9;
const BALL_DIAMETER: f64 = 0.00794004;
const PITCH_DIAMETER: f64 = 0.0390398;
pub const SHAFT: f64 = 1797.0 / 60.0;
const SETTLE: f64 = 0.25;

/// A half-sine on a race from `angle` on; `height` \[m\] is negative for a dent.
#[derive(Clone, Copy)]
pub struct Defect {
    pub angle_deg: f64,
    pub width: f64,
    pub height: f64,
}

impl Defect {
    /// A dent as deep as a ball enters a hole of this diameter (eq. 4).
    pub fn dent(angle_deg: f64, width: f64) -> Self {
        let radius = 0.5 * BALL_DIAMETER;
        Defect { angle_deg, width, height: -(radius - (radius * radius - 0.25 * width * width).sqrt()) }
    }

    pub fn bump(angle_deg: f64, width: f64, height: f64) -> Self {
        Defect { angle_deg, width, height }
    }
}

#[derive(Clone, Copy, PartialEq)]
pub enum Race {
    Outer,
    Inner,
}

impl Race {
    pub fn radius(self) -> f64 {
        match self {
            Race::Outer => 0.5 * (PITCH_DIAMETER + BALL_DIAMETER),
            Race::Inner => 0.5 * (PITCH_DIAMETER - BALL_DIAMETER),
        }
    }

    /// Ball-passing frequency of the race (BPFO, BPFI) \[Hz\].
    pub fn passing_frequency(self) -> f64 {
        let ratio = BALL_DIAMETER / PITCH_DIAMETER;
        match self {
            Race::Outer => 0.5 * BALLS as f64 * SHAFT * (1.0 - ratio),
            Race::Inner => 0.5 * BALLS as f64 * SHAFT * (1.0 + ratio),
        }
    }
}

/// Accelerations \[m/s²\] after the settling time.
pub struct Records {
    /// Outer ring, x and y.
    pub ring: [Vec<f64>; 2],
    /// Resonator, x.
    pub resonator: Vec<f64>,
    /// Time of the first sample after ball 1 was at angle 0.
    pub start: f64,
}

pub fn simulate(race: Race, defects: &[Defect], step: f64, seconds: f64) -> Records {
    let stiffness = 1.5779e10;
    let clearance = 5.5e-6 - 6.5e-6;
    let damping = 236.685;
    let load = 12.3936;
    let [inner, outer, resonator] =
        [[1.2638, 74.2e6, 1376.8], [12.638, 15105600.0, 2210.7], [1.0, 986960440.0, 1400.0]];
    let cage = Race::Outer.passing_frequency() / BALLS as f64;
    let relative_turn = match race {
        Race::Outer => cage,
        Race::Inner => cage - SHAFT,
    };
    let marks: Vec<_> =
        defects.iter().map(|d| (d.angle_deg.to_radians(), d.width / race.radius(), d.height)).collect();
    // States: x and y of inner ring, outer ring, resonator, then their velocities.
    let derivative = |t: f64, s: &[f64; 12]| -> [f64; 12] {
        let mut force = [0.0; 2];
        for ball in 0..BALLS {
            let place = TAU * ball as f64 / BALLS as f64;
            let (sin, cos) = (place + TAU * cage * t).sin_cos();
            let on_race = place + TAU * relative_turn * t;
            let mut profile = 0.0;
            for (start, width, height) in &marks {
                let inside = (on_race - start).rem_euclid(TAU);
                if inside <= *width {
                    profile += height * (PI * inside / width).sin();
                }
            }
            let deflection = (s[0] - s[2]) * cos + (s[1] - s[3]) * sin - clearance + profile;
            if deflection > 0.0 {
                let rate = (s[6] - s[8]) * cos + (s[7] - s[9]) * sin;
                let normal = stiffness * deflection.powf(1.5) + damping * rate;
                force[0] += normal * cos;
                force[1] += normal * sin;
            }
        }
        let mut out = [0.0; 12];
        for axis in 0..2 {
            let [xi, xo, xr] = [s[axis], s[2 + axis], s[4 + axis]];
            let [vi, vo, vr] = [s[6 + axis], s[8 + axis], s[10 + axis]];
            let spring = resonator[1] * (xr - xo) + resonator[2] * (vr - vo);
            out[axis] = vi;
            out[2 + axis] = vo;
            out[4 + axis] = vr;
            let external = if axis == 0 { load } else { 0.0 };
            out[6 + axis] = (external - force[axis] - inner[1] * xi - inner[2] * vi) / inner[0];
            out[8 + axis] = (force[axis] + spring - outer[1] * xo - outer[2] * vo) / outer[0];
            out[10 + axis] = -spring / resonator[0];
        }
        out
    };
    let mut state = [0.0; 12];
    state[0] = 1e-6;
    state[1] = 1e-6;
    let settle = (SETTLE / step).round() as usize;
    let steps = settle + (seconds / step).round() as usize;
    let mut records =
        Records { ring: [Vec::new(), Vec::new()], resonator: Vec::new(), start: settle as f64 * step };
    let shifted = |s: &[f64; 12], k: &[f64; 12], h: f64| std::array::from_fn(|i| s[i] + h * k[i]);
    for n in 0..steps {
        let t = n as f64 * step;
        let k1 = derivative(t, &state);
        if n >= settle {
            records.ring[0].push(k1[8]);
            records.ring[1].push(k1[9]);
            records.resonator.push(k1[10]);
        }
        let k2 = derivative(t + 0.5 * step, &shifted(&state, &k1, 0.5 * step));
        let k3 = derivative(t + 0.5 * step, &shifted(&state, &k2, 0.5 * step));
        let k4 = derivative(t + step, &shifted(&state, &k3, step));
        for i in 0..12 {
            state[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    records
}
