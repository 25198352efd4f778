//! Motion of a ball between its races: orbital speed, spin axis, rolling and spinning at both contacts, sliding.
//!
//! Ball and races touch at the centres of the contact ellipses and do not slip there along the direction of rolling.
//! The spin axis lies in the plane through the bearing's axis and the ball centre, at the pitch angle β from the axis;
//! the gyroscopic moment does not turn the ball. Angles are signed like those of the contacts.
//! Source: Harris, Rolling Bearing Analysis, ch. 8 (rotation of the balls, raceway control).

use crate::contact::{ContactPatch, EllipticContact, HertzPair, Race};
use crate::{BallBearing, BallGeometry, BallInertia, BallLoad, InertiaDecision};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Motion of one ball at one position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BallMotion {
    /// Race without spinning: the one that controls the spin axis. `None` without load.
    pub control: Option<Race>,
    /// Q_o a_o E_o cos(α_i − α_o) over Q_i a_i E_i, E the complete elliptic integral of the second kind: above 1 the
    /// outer race controls. NaN without load at the inner race.
    pub control_ratio: f64,
    /// Orbital speed ω_m of the ball centre \[rad/s\].
    pub orbital_speed: f64,
    /// Angular speed ω_R of the ball about its own centre, relative to the orbiting frame \[rad/s\].
    pub ball_speed: f64,
    /// Components of that angular velocity along the shaft axis +z and radially outwards \[rad/s\].
    pub ball_velocity: [f64; 2],
    /// Pitch angle β \[rad\].
    pub pitch_angle: f64,
    /// Spin speed at the inner and outer contact, about the contact normal, ball relative to race \[rad/s\].
    pub spin: [f64; 2],
    /// Rolling speed at the inner and outer contact, ball relative to race \[rad/s\].
    pub rolling: [f64; 2],
    /// Friction moment of spinning M_s = (3/8) μ Q a E at the inner and outer contact, for μ = 1 \[N m\].
    pub spin_moment: [f64; 2],
    /// Largest pressure times sliding speed within the inner and outer contact ellipse \[W/m²\].
    pub pressure_velocity: [f64; 2],
}

impl BallMotion {
    /// Ratio of spinning to rolling ω_s/ω_roll at the inner and outer contact.
    pub fn spin_to_roll(&self) -> [f64; 2] {
        [0, 1].map(|k| if self.rolling[k] == 0.0 { 0.0 } else { self.spin[k].abs() / self.rolling[k].abs() })
    }

    /// Power lost by spinning at both contacts with a friction coefficient μ \[W\].
    pub fn spin_power(&self, friction: f64) -> f64 {
        (0..2).map(|k| friction * self.spin_moment[k] * self.spin[k].abs()).sum()
    }
}

/// Pitch angle β \[rad\] at which the ball does not spin on the controlling race.
///
/// tan β = sin α_o/(cos α_o + γ) for the outer race, sin α_i/(cos α_i − γ) for the inner one; γ = D_w/D_pw. Source:
/// Harris, Rolling Bearing Analysis, ch. 8.
pub fn pitch_angle(control: Race, ball_to_pitch: f64, [inner, outer]: [f64; 2]) -> f64 {
    match control {
        Race::Outer => outer.sin().atan2(outer.cos() + ball_to_pitch),
        Race::Inner => inner.sin().atan2(inner.cos() - ball_to_pitch),
    }
}

/// Criterion of race control, Q_o a_o E_o cos(α_i − α_o)/(Q_i a_i E_i): above 1 the outer race controls.
///
/// Source: Jones 1960; Harris, Rolling Bearing Analysis, ch. 8.
pub fn control_ratio(hertz: &HertzPair, load: &BallLoad) -> f64 {
    let [inner, outer] = load.patches(hertz);
    let moment =
        |q: f64, patch: &ContactPatch, contact: &EllipticContact| q * patch.semi_major * contact.integrals[1];
    moment(load.outer_load, &outer, &hertz.outer) * (load.contact_angle - load.outer_contact_angle).cos()
        / moment(load.load, &inner, &hertz.inner)
}

/// Orbital speed ω_m and speed ω_R of the ball about its centre \[rad/s\], for both races turning.
///
/// (ω_i − ω_m)(1 − γ cos α_i) = γ ω_R cos(α_i − β), (ω_m − ω_o)(1 + γ cos α_o) = γ ω_R cos(α_o − β); γ = D_w/D_pw.
///
/// `races`: speeds of inner and outer race \[rad/s\]. Source: Harris, Rolling Bearing Analysis, ch. 8.
pub fn rolling_speeds(ball_to_pitch: f64, angles: [f64; 2], pitch: f64, races: [f64; 2]) -> [f64; 2] {
    let [inner, outer] = angles;
    let inner_arm = (1.0 - ball_to_pitch * inner.cos()) / (inner - pitch).cos();
    let outer_arm = (1.0 + ball_to_pitch * outer.cos()) / (outer - pitch).cos();
    let orbital = (races[0] * inner_arm + races[1] * outer_arm) / (inner_arm + outer_arm);
    [orbital, (races[0] - orbital) * inner_arm / ball_to_pitch]
}

/// Motion of every ball of a bearing.
///
/// `speed`: of the inner race \[rad/s\], the outer one at rest. The spin axis follows the race that the bearing's ball
/// inertia assumes, else the criterion of race control. Balls without load at a race orbit like a ball at the nominal
/// contact angle.
pub fn ball_motions(bearing: &BallBearing, loads: &[BallLoad], speed: f64) -> Vec<BallMotion> {
    let (g, hertz) = (&bearing.geometry, bearing.hertz());
    loads.iter().map(|load| ball_motion(g, &hertz, bearing.inertia, load, speed)).collect()
}

fn ball_motion(
    g: &BallGeometry,
    hertz: &HertzPair,
    inertia: BallInertia,
    load: &BallLoad,
    speed: f64,
) -> BallMotion {
    let gamma = g.ball_diameter / g.pitch_diameter;
    if !(load.load > 0.0 && load.outer_load > 0.0) {
        let [orbital_speed, _] = rolling_speeds(gamma, [g.contact_angle; 2], g.contact_angle, [speed, 0.0]);
        return BallMotion { control_ratio: f64::NAN, orbital_speed, ..BallMotion::default() };
    }
    let angles = [load.contact_angle, load.outer_contact_angle];
    let ratio = control_ratio(hertz, load);
    let control = match inertia {
        BallInertia::OuterRaceControl
        | BallInertia::Centrifugal
        | BallInertia::Auto(Some(InertiaDecision { on: true, .. })) => Race::Outer,
        BallInertia::InnerRaceControl | BallInertia::HarrisInnerRaceControl => Race::Inner,
        BallInertia::Auto(_) | BallInertia::None | BallInertia::Shared | BallInertia::CentrifugalForce(_) => {
            if ratio >= 1.0 {
                Race::Outer
            } else {
                Race::Inner
            }
        }
    };
    let pitch = pitch_angle(control, gamma, angles);
    let [orbital, ball] = rolling_speeds(gamma, angles, pitch, [speed, 0.0]);
    // Relative to the orbiting frame; the outer race turns backwards there.
    let races = [speed - orbital, -orbital];
    let spin = [
        ball * (angles[0] - pitch).sin() + races[0] * angles[0].sin(),
        -ball * (angles[1] - pitch).sin() - races[1] * angles[1].sin(),
    ];
    let rolling = [
        ball * (angles[0] - pitch).cos() + races[0] * angles[0].cos(),
        ball * (angles[1] - pitch).cos() + races[1] * angles[1].cos(),
    ];
    let patches = load.patches(hertz);
    let contacts = [&hertz.inner, &hertz.outer];
    let loads = [load.load, load.outer_load];
    let grooves = [g.inner_groove_radius, g.outer_groove_radius];
    BallMotion {
        control: Some(control),
        control_ratio: ratio,
        orbital_speed: orbital,
        ball_speed: ball.abs(),
        ball_velocity: [-ball * pitch.cos(), ball * pitch.sin()],
        pitch_angle: pitch,
        spin,
        rolling,
        spin_moment: [0, 1].map(|k| 0.375 * loads[k] * patches[k].semi_major * contacts[k].integrals[1]),
        pressure_velocity: [0, 1].map(|k| {
            let radius = deformed_radius(grooves[k], g.ball_diameter);
            largest_pressure_velocity(&patches[k], radius, spin[k], rolling[k])
        }),
    }
}

/// Radius of the deformed contact surface across rolling \[m\], 2 r D_w/(2 r + D_w) for a groove of radius r.
///
/// Source: Harris, Rolling Bearing Analysis, ch. 8: 2 f D_w/(2 f + 1).
pub fn deformed_radius(groove_radius: f64, ball_diameter: f64) -> f64 {
    2.0 * groove_radius * ball_diameter / (2.0 * groove_radius + ball_diameter)
}

/// Distance of the two lines of pure rolling from the centre over the semi-axis, from equal friction forces to both
/// sides of them: c − c³/3 = 1/3.
const ROLLING_LINES: f64 = 0.347_296_355_333_860_7;

/// Largest pressure times sliding speed within a contact ellipse \[W/m²\].
///
/// p = p₀ √(1 − (x/b)² − (y/a)²); sliding speed by spinning and by the curvature of the surface (Heathcote),
/// v_x = ω_roll ((c a)² − y²)/(2 R) + ω_s y, v_y = −ω_s x, with lines of pure rolling at y = ±c a.
///
/// `radius`: of the deformed surface across rolling R \[m\]; `spin` ω_s and `rolling` ω_roll \[rad/s\].
pub fn largest_pressure_velocity(patch: &ContactPatch, radius: f64, spin: f64, rolling: f64) -> f64 {
    const RINGS: usize = 60;
    let ContactPatch { semi_major: a, semi_minor: b, maximum_pressure, .. } = *patch;
    let mut largest = 0.0f64;
    for ring in 0..RINGS {
        let share = ring as f64 / RINGS as f64;
        let pressure = maximum_pressure * (1.0 - share * share).max(0.0).sqrt();
        for (sin, cos) in RAY_DIRECTIONS.iter() {
            let (x, y) = (b * share * cos, a * share * sin);
            let along = rolling * ((ROLLING_LINES * a).powi(2) - y * y) / (2.0 * radius) + spin * y;
            // The sum of both components is an upper bound of the sliding speed, and takes no root.
            if ABOVE_ROUND_OFF * pressure * (along.abs() + (spin * x).abs()) > largest {
                largest = largest.max(pressure * along.hypot(spin * x));
            }
        }
    }
    largest
}

/// Rays around the contact ellipse.
const RAYS: usize = 90;
/// Factor that keeps an upper bound one in spite of round-off.
const ABOVE_ROUND_OFF: f64 = 1.0 + 1e-12;

/// Sine and cosine of rays around a contact ellipse.
static RAY_DIRECTIONS: LazyLock<[(f64, f64); RAYS]> =
    LazyLock::new(|| std::array::from_fn(|ray| (std::f64::consts::TAU * ray as f64 / RAYS as f64).sin_cos()));

/// Advance of every ball against the mean orbital speed of its row, over the position around the bearing \[rad\].
///
/// φ(ψ) = ∫ (ω_m/ω̄_m − 1) dψ by the trapezoidal rule over the positions of the balls, with zero mean: positive
/// where a ball leads its place in the cage.
pub fn ball_advance(loads: &[BallLoad], motions: &[BallMotion]) -> Vec<f64> {
    let mut advance = vec![0.0; loads.len()];
    let rows = loads.iter().map(|load| load.row + 1).max().unwrap_or(0);
    for row in 0..rows {
        let mut balls: Vec<usize> =
            (0..loads.len().min(motions.len())).filter(|&j| loads[j].row == row).collect();
        let tau = std::f64::consts::TAU;
        let place = |j: usize| loads[j].position.rem_euclid(tau);
        balls.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
        let n = balls.len();
        if n == 0 {
            continue;
        }
        // Widths of the trapezoidal rule around the circle.
        let step = |k: usize| (place(balls[(k + 1) % n]) - place(balls[k])).rem_euclid(tau);
        let step = |k: usize| if n == 1 { tau } else { step(k) };
        let speed = |k: usize| motions[balls[k % n]].orbital_speed;
        let mean = (0..n).map(|k| 0.5 * (speed(k) + speed(k + 1)) * step(k)).sum::<f64>() / tau;
        if mean == 0.0 {
            continue;
        }
        let mut sum = 0.0;
        let values: Vec<f64> = (0..n)
            .map(|k| {
                let here = sum;
                sum += (0.5 * (speed(k) + speed(k + 1)) / mean - 1.0) * step(k);
                here
            })
            .collect();
        let average = values.iter().sum::<f64>() / n as f64;
        for (k, value) in values.into_iter().enumerate() {
            advance[balls[k]] = value - average;
        }
    }
    advance
}

/// Clearance and contact angle of a mounted bearing at a speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MountedGeometry {
    /// Diametral radial clearance by fits, temperatures and centrifugal growth P_d \[m\].
    pub radial_clearance: f64,
    /// Axial clearance P_e = 2 A sin α_f \[m\] of a deep groove bearing (α₀ = 0); 0 without radial clearance.
    pub axial_clearance: f64,
    /// Free contact angle α_f \[rad\]: 0 with interference.
    pub free_contact_angle: f64,
}

/// Geometry as mounted: cos α_f = cos α₀ − P_d/(2 A), A = r_i + r_o − D_w.
///
/// `speed`: of the shaft \[rad/s\]. Limit: arccos(1 − P_d/(2 A)) for α₀ = 0. Source: Harris, Rolling Bearing Analysis,
/// ch. 2.
pub fn mounted_geometry(bearing: &BallBearing, speed: f64) -> MountedGeometry {
    let g = &bearing.geometry;
    let clearance = g.radial_clearance + bearing.clearance_change(speed);
    let distance = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
    let cos = g.contact_angle.cos() - 0.5 * clearance / distance;
    let angle = cos.clamp(-1.0, 1.0).acos();
    MountedGeometry {
        radial_clearance: clearance,
        axial_clearance: if g.contact_angle == 0.0 { 2.0 * distance * angle.sin() } else { 0.0 },
        free_contact_angle: angle,
    }
}
