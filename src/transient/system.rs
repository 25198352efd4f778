//! The reduced equations of motion of a machine with nonlinear bearings, ready for time integration.
//!
//! ẍ + (C + Ω G) ẋ + (K + Ω̇ K_s + Ω K_c) x = p(t) + Wᵀ f(d, ḋ, rotation), d = W x,
//! in mass-normalised coordinates q = V x; f is the sum of the bearings' reactions on the shaft.

use nalgebra::{DMatrix, DVector};

use super::torque::TorqueDrive;
use crate::bearing::{BearingElement, Reaction, Rotation};
use crate::linalg::panel::Panel;
use crate::model::{Quantity, SpeedCurve, Spin};

/// A nonlinear bearing of the reduced system and the rows of W that are its relative displacement.
#[derive(Clone, Debug)]
pub struct Interface {
    pub name: String,
    pub element: BearingElement,
    /// First row of W and number of rows (5 for ball bearings: θ_z is free; else 6).
    pub first_row: usize,
    pub rows: usize,
    /// Cage angle at the start \[rad\].
    pub cage_angle: f64,
}

/// A load p(t) = factor(t) · vector, factor piecewise linear and zero outside its table.
#[derive(Clone, Debug)]
pub struct LoadHistory {
    pub vector: DVector<f64>,
    pub points: Vec<[f64; 2]>,
}

/// One measured channel: row · x (or ẋ, ẍ).
#[derive(Clone, Debug)]
pub struct Channel {
    pub name: String,
    pub row: DVector<f64>,
    pub quantity: Quantity,
}

impl Channel {
    /// The channel's value at a state.
    pub fn read(&self, state: &State) -> f64 {
        self.row.dot(match self.quantity {
            Quantity::Displacement => &state.x,
            Quantity::Velocity => &state.v,
            Quantity::Acceleration => &state.a,
        })
    }
}

/// The reduced machine; immutable during a run.
#[derive(Clone, Debug)]
pub struct System {
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub gyroscopic: DMatrix<f64>,
    pub spin_up: DMatrix<f64>,
    pub circulatory: DMatrix<f64>,
    /// Static load: gravity, belt pulls, constant loads.
    pub static_load: DVector<f64>,
    /// Unbalance along cos θ and sin θ, per Ω².
    pub unbalance: [DVector<f64>; 2],
    /// −Vᵀ M r: what a unit Ω̇ does to torsion.
    pub spin_inertia: DVector<f64>,
    pub histories: Vec<LoadHistory>,
    /// Interface map W, rows × coordinates.
    pub interface_map: DMatrix<f64>,
    pub interfaces: Vec<Interface>,
    pub channels: Vec<Channel>,
    pub curve: SpeedCurve,
    /// Torque drive, when the shaft's speed follows from a torque balance instead of the profile.
    pub drive: Option<TorqueDrive>,
    pub panels: Panels,
}

/// The system's matrices laid out for the products of a time step.
#[derive(Clone, Debug)]
pub struct Panels {
    /// \[C K G K_s\], and K_c where there is internal damping.
    linear: Panel,
    has_circulatory: bool,
    /// C alone.
    pub damping: Panel,
    /// \[K_s K_c\]: the terms of the left side that are neither spring nor damper nor gyroscope.
    pub effective: Panel,
    /// W and Wᵀ.
    to_interface: Panel,
    from_interface: Panel,
}

impl Panels {
    /// Lays out the matrices C, K, G, K_s, K_c and W.
    pub fn new(
        [damping, stiffness, gyroscopic, spin_up, circulatory]: [&DMatrix<f64>; 5],
        interface_map: &DMatrix<f64>,
    ) -> Self {
        let has_circulatory = circulatory.amax() != 0.0;
        let all = [damping, stiffness, gyroscopic, spin_up, circulatory];
        Self {
            linear: Panel::new(&all[..if has_circulatory { 5 } else { 4 }]),
            has_circulatory,
            damping: Panel::new(&[damping]),
            effective: Panel::new(&[spin_up, circulatory]),
            to_interface: Panel::new(&[interface_map]),
            from_interface: Panel::new(&[&interface_map.transpose()]),
        }
    }
}

/// Everything that changes during a run.
#[derive(Clone, Debug)]
pub struct State {
    pub time: f64,
    pub spin: Spin,
    pub x: DVector<f64>,
    pub v: DVector<f64>,
    pub a: DVector<f64>,
    /// Per interface: where cage and shaft are.
    pub rotations: Vec<Rotation>,
    /// Per interface: the force and tangents at this state.
    pub reactions: Vec<Reaction>,
    /// Relative displacements W x and velocities W ẋ.
    pub d: Vec<f64>,
    pub d_rate: Vec<f64>,
}

impl System {
    /// Number of coordinates.
    pub fn size(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Number of interface rows.
    pub fn rows(&self) -> usize {
        self.interfaces.last().map_or(0, |i| i.first_row + i.rows)
    }

    /// The shaft's motion `offset` after (time, spin): from the profile, or at constant acceleration under a
    /// torque drive.
    pub fn spin_ahead(&self, time: f64, spin: &Spin, offset: f64) -> Spin {
        match &self.drive {
            None => self.curve.at(time + offset),
            Some(_) => Spin {
                angle: spin.angle + offset * (spin.speed + 0.5 * offset * spin.acceleration),
                speed: spin.speed + offset * spin.acceleration,
                acceleration: spin.acceleration,
            },
        }
    }

    /// What an interface row is, in words.
    pub fn name_of_row(&self, row: usize) -> String {
        const DIRECTIONS: [&str; 6] = ["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"];
        self.interfaces
            .iter()
            .find(|i| (i.first_row..i.first_row + i.rows).contains(&row))
            .map_or("the structure".into(), |i| {
                format!("bearing {}, {}", i.name, DIRECTIONS[row - i.first_row])
            })
    }

    /// External load p(t) without bearing forces, written to `out`.
    pub fn load(&self, time: f64, spin: &Spin, out: &mut DVector<f64>) {
        let (sin, cos) = spin.angle.sin_cos();
        let (square, rate) = (spin.speed * spin.speed, spin.acceleration);
        out.copy_from(&self.static_load);
        out.axpy(square * cos + rate * sin, &self.unbalance[0], 1.0);
        out.axpy(square * sin - rate * cos, &self.unbalance[1], 1.0);
        if rate != 0.0 {
            out.axpy(rate, &self.spin_inertia, 1.0);
        }
        if let Some(drive) = &self.drive {
            out.axpy(drive.torque_at(spin.speed), &drive.torque, 1.0);
        }
        for history in &self.histories {
            let factor = piecewise(&history.points, time, 0.0);
            if factor != 0.0 {
                out.axpy(factor, &history.vector, 1.0);
            }
        }
    }

    /// Adds weight × ((C + Ω G) v + (K + Ω̇ K_s + Ω K_c) x) to `out`; `scratch` is for reuse.
    pub fn add_linear(
        &self,
        spin: &Spin,
        [x, v]: [&DVector<f64>; 2],
        weight: f64,
        scratch: &mut Vec<f64>,
        out: &mut DVector<f64>,
    ) {
        scratch.clear();
        scratch.extend(v.iter().map(|v| weight * v));
        scratch.extend(x.iter().map(|x| weight * x));
        scratch.extend(v.iter().map(|v| weight * spin.speed * v));
        scratch.extend(x.iter().map(|x| weight * spin.acceleration * x));
        if self.panels.has_circulatory {
            scratch.extend(x.iter().map(|x| weight * spin.speed * x));
        }
        self.panels.linear.mul_add(scratch, out.as_mut_slice());
    }

    /// W y for coordinates y, written to `out`.
    pub fn to_interface(&self, y: &DVector<f64>, out: &mut [f64]) {
        out.fill(0.0);
        self.panels.to_interface.mul_add(y.as_slice(), out);
    }

    /// Adds Wᵀ f to `out`.
    pub fn add_from_interface(&self, force: &[f64], out: &mut DVector<f64>) {
        self.panels.from_interface.mul_add(force, out.as_mut_slice());
    }

    /// Evaluates every bearing at relative displacements and velocities.
    pub fn react(&self, d: &[f64], d_rate: &[f64], rotations: &[Rotation], out: &mut [Reaction]) {
        for ((interface, rotation), reaction) in self.interfaces.iter().zip(rotations).zip(out) {
            let (mut at, mut rate) = ([0.0; 6], [0.0; 6]);
            let rows = interface.first_row..interface.first_row + interface.rows;
            at[..interface.rows].copy_from_slice(&d[rows.clone()]);
            rate[..interface.rows].copy_from_slice(&d_rate[rows]);
            *reaction = interface.element.reaction(&at, &rate, rotation);
        }
    }

    /// Collects the reactions' forces into interface rows.
    pub fn gather(&self, reactions: &[Reaction], out: &mut [f64]) {
        for (interface, reaction) in self.interfaces.iter().zip(reactions) {
            out[interface.first_row..interface.first_row + interface.rows]
                .copy_from_slice(&reaction.force[..interface.rows]);
        }
    }

    /// The state at t = 0 with given coordinates, at rest or moving, with consistent acceleration.
    pub fn initial_state(&self, x: DVector<f64>, v: DVector<f64>) -> State {
        let mut spin = self.curve.at(0.0);
        if self.drive.is_some() {
            spin.acceleration = 0.0;
        }
        let (n, rows) = (self.size(), self.rows());
        let rotations = self
            .interfaces
            .iter()
            .map(|i| Rotation {
                cage_angle: i.cage_angle,
                cage_speed: i.element.cage_ratio(i.element.nominal_cos()) * spin.speed,
                shaft_angle: spin.angle,
                shaft_speed: spin.speed,
            })
            .collect();
        let mut state = State {
            time: 0.0,
            spin,
            x,
            v,
            a: DVector::zeros(n),
            rotations,
            reactions: vec![Reaction::default(); self.interfaces.len()],
            d: vec![0.0; rows],
            d_rate: vec![0.0; rows],
        };
        self.refresh(&mut state);
        state
    }

    /// The state at a time other than 0, its cages at given angles.
    pub fn state_at(&self, time: f64, cage_angles: &[f64], x: DVector<f64>, v: DVector<f64>) -> State {
        let mut state = self.initial_state(x, v);
        state.time = time;
        state.spin = self.curve.at(time);
        for (rotation, angle) in state.rotations.iter_mut().zip(cage_angles) {
            rotation.cage_angle = *angle;
            rotation.shaft_angle = state.spin.angle;
        }
        self.refresh(&mut state);
        state
    }

    /// Brings reactions and acceleration of a state up to date with its x, v, time and rotations.
    pub fn refresh(&self, state: &mut State) {
        let (x, v) = (state.x.clone(), state.v.clone());
        self.to_interface(&x, &mut state.d);
        self.to_interface(&v, &mut state.d_rate);
        let mut reactions = std::mem::take(&mut state.reactions);
        self.react(&state.d, &state.d_rate, &state.rotations, &mut reactions);
        state.reactions = reactions;
        let mut force = vec![0.0; self.rows()];
        self.gather(&state.reactions, &mut force);
        let mut a = DVector::zeros(self.size());
        self.load(state.time, &state.spin, &mut a);
        self.add_linear(&state.spin, [&x, &v], -1.0, &mut Vec::new(), &mut a);
        self.add_from_interface(&force, &mut a);
        state.a = a;
    }

    /// Reads every channel at a state into `out`.
    pub fn read_channels(&self, state: &State, out: &mut [f64]) {
        for (value, channel) in out.iter_mut().zip(&self.channels) {
            *value = channel.read(state);
        }
    }
}

/// Piecewise-linear table, `outside` beyond its ends.
pub fn piecewise(points: &[[f64; 2]], x: f64, outside: f64) -> f64 {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return outside;
    };
    if x < first[0] || x > last[0] {
        return outside;
    }
    let k = points.partition_point(|p| p[0] <= x).clamp(1, points.len().max(2) - 1);
    match points.get(k) {
        Some(right) if right[0] > points[k - 1][0] => {
            let left = points[k - 1];
            left[1] + (right[1] - left[1]) * (x - left[0]) / (right[0] - left[0])
        }
        _ => first[1],
    }
}
