//! Results of the study of one bearing with free balls.

use crate::document::{Array, Document, Rows, in_json, named};
use rotordyn_bearing::CharacteristicOrders;
use rotordyn_bearing::free_ball::LOSSES;
use serde::{Deserialize, Serialize};

/// One bearing with free balls, settled under a load at a speed: means over the record unless stated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FreeBallResult {
    pub name: String,
    /// Speed of the inner ring \[rad/s\] and load of the shaft on the bearing F_x F_y F_z \[N\].
    pub speed: f64,
    pub load: [f64; 3],
    /// Displacement of the inner ring at which its force balances the load \[m\], and that force \[N\].
    pub displacement: [f64; 3],
    pub force: [f64; 3],
    /// Time step, time until the cage speed was settled, length of the record \[s\].
    pub step: f64,
    pub settling_time: f64,
    pub duration: f64,
    /// Speed of the cage, without cage of the balls about the axis \[rad/s\].
    pub cage_speed: f64,
    /// The same over the speed of the kinematic cage, and 1 less it.
    pub cage_ratio: f64,
    pub slip: f64,
    /// Kinematic cage beside the free one.
    pub comparison: CageComparison,
    /// Friction torque on the inner ring \[N m\] and heat of each source \[W\], in the order of
    /// [`LOSSES`](rotordyn_bearing::free_ball::LOSSES).
    pub friction_torque: f64,
    pub losses: [f64; LOSSES.len()],
    /// Largest and RMS force of a pocket on its ball along the orbit \[N\], over all balls.
    pub pocket_peak: f64,
    pub pocket_rms: f64,
    pub balls: Vec<FreeBallMean>,
    /// The record.
    pub record: FreeBallRecord,
    /// Cage speed ratio of every turn of the kinematic cage since the start, and the time of its end \[s\].
    pub turns: Vec<[f64; 2]>,
}

/// Means of one ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FreeBallMean {
    /// Pitch angle of the spin axis \[rad\].
    pub pitch_angle: f64,
    /// Load \[N\] and, weighted by it, contact angle \[rad\] at inner and outer race; NaN without load.
    pub loads: [f64; 2],
    pub angles: [f64; 2],
}

/// Samples over the record.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FreeBallRecord {
    /// \[s\].
    pub time: Vec<f64>,
    /// Cage speed over that of the kinematic cage.
    pub cage_ratio: Vec<f64>,
    /// Centre of the cage against the outer ring \[m\]; empty without cage.
    pub cage_x: Vec<f64>,
    pub cage_y: Vec<f64>,
    /// Pitch angle of each ball \[rad\], sample by sample.
    pub pitch_angles: Vec<f64>,
}

/// Free cage beside the kinematic one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CageComparison {
    /// Orders of the kinematic cage at the loaded contact angle.
    pub kinematic: CharacteristicOrders,
    /// FTF and BPFO of the free cage \[1/revolution\].
    pub ftf: f64,
    pub bpfo: f64,
    /// Difference of the BPFO, free less kinematic \[Hz\].
    pub shift_hz: f64,
    /// The larger of the resolution 1/T of a measured record and 0.1 % of the BPFO \[Hz\].
    pub limit_hz: f64,
}

impl CageComparison {
    /// Whether the kinematic cage was good enough: its BPFO differs by less than the limit.
    pub fn is_good_enough(&self) -> bool {
        self.shift_hz.abs() <= self.limit_hz
    }

    /// The assessment in words.
    pub fn assessment(&self) -> &'static str {
        match self.is_good_enough() {
            true => "the kinematic cage is good enough",
            false => "the kinematic cage is not good enough",
        }
    }
}

/// Names of the heat sources in files, in the order of [`LOSSES`].
pub const LOSS_NAMES: [&str; LOSSES.len()] = [
    "inner_traction",
    "outer_traction",
    "rolling_resistance",
    "contact_damping",
    "pockets",
    "guidance",
    "ball_contacts",
    "drag",
];

impl FreeBallResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let c = &self.comparison;
        let comparison = Document::new()
            .number("kinematic_ftf", "1/revolution", c.kinematic.ftf)
            .number("kinematic_bpfo", "1/revolution", c.kinematic.bpfo)
            .number("ftf", "1/revolution", c.ftf)
            .number("bpfo", "1/revolution", c.bpfo)
            .number("bpfo_shift_hz", "Hz", c.shift_hz)
            .number("limit_hz", "Hz", c.limit_hz)
            .flag("good_enough", c.is_good_enough())
            .text("assessment", c.assessment());
        let losses = LOSS_NAMES
            .iter()
            .zip(self.losses)
            .fold(Document::new(), |out, (name, loss)| out.number(*name, "W", loss));
        let column = |pick: fn(&FreeBallMean) -> f64| self.balls.iter().map(pick).collect::<Vec<_>>();
        let balls = Document::new()
            .numbers("pitch_angle", "rad", column(|ball| ball.pitch_angle))
            .numbers("inner_load", "N", column(|ball| ball.loads[0]))
            .numbers("outer_load", "N", column(|ball| ball.loads[1]))
            .numbers("inner_contact_angle", "rad", column(|ball| ball.angles[0]))
            .numbers("outer_contact_angle", "rad", column(|ball| ball.angles[1]));
        let record = &self.record;
        let samples = record.time.len();
        let pitch = Array::real(&[samples, self.balls.len()], "rad", &record.pitch_angles).over(0, "time");
        let record = Document::new()
            .numbers("time", "s", &record.time)
            .array("cage_ratio", Array::real(&[samples], "1", &record.cage_ratio).over(0, "time"))
            .numbers("cage_x", "m", &record.cage_x)
            .numbers("cage_y", "m", &record.cage_y)
            .array("pitch_angle", pitch);
        let turn = |k: usize| self.turns.iter().map(|turn| turn[k]).collect::<Vec<_>>();
        let turns = Document::new().numbers("time", "s", turn(0)).numbers("cage_ratio", "1", turn(1));
        Document::new()
            .text(in_json("name"), &self.name)
            .quantity("speed", "rad/s", self.speed)
            .numbers("load", "N", &self.load[..])
            .numbers("displacement", "m", &self.displacement[..])
            .numbers("force", "N", &self.force[..])
            .number("step", "s", self.step)
            .number("settling_time", "s", self.settling_time)
            .number("duration", "s", self.duration)
            .quantity("cage_speed", "rad/s", self.cage_speed)
            .number("cage_ratio", "1", self.cage_ratio)
            .number("slip", "1", self.slip)
            .group("comparison", comparison)
            .number("friction_torque", "N m", self.friction_torque)
            .group("heat", losses)
            .number("pocket_force_peak", "N", self.pocket_peak)
            .number("pocket_force_rms", "N", self.pocket_rms)
            .group("balls", balls)
            .group("record", record)
            .group("turns", turns)
    }
}

/// Cage slip over load and speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkiddingMap {
    pub name: String,
    /// Loads \[N\] and speeds \[rad/s\].
    pub loads: Vec<f64>,
    pub speeds: Vec<f64>,
    /// 1 less the cage speed over the kinematic one, for each load all speeds; NaN where a run failed.
    pub slip: Vec<f64>,
    /// Heat of all sources \[W\].
    pub heat: Vec<f64>,
    /// Why runs failed.
    pub failures: Vec<String>,
    /// Whether no point is missing because the study was stopped.
    pub complete: bool,
}

impl SkiddingMap {
    /// Slip at a load and a speed by their numbers.
    pub fn slip_at(&self, load: usize, speed: usize) -> f64 {
        self.slip[load * self.speeds.len() + speed]
    }

    /// How many points failed, with the first cause; `None` if none did.
    pub fn failure_summary(&self) -> Option<String> {
        let first = self.failures.first()?;
        let (failed, all) = (self.failures.len(), self.slip.len());
        Some(format!("{failed} of {all} points of the skidding map of bearing {} failed: {first}", self.name))
    }

    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let shape = [self.loads.len(), self.speeds.len()];
        let map = |unit, data| Array::real(&shape, unit, data).over(0, "load").over(1, "speed");
        let points: Vec<[f64; 4]> = (0..self.slip.len())
            .map(|k| {
                let (load, speed) = (self.loads[k / self.speeds.len()], self.speeds[k % self.speeds.len()]);
                [load, speed, self.slip[k], self.heat[k]]
            })
            .collect();
        let points = Rows::of(&points)
            .number("load_n", "N", |point| point[0])
            .number("speed_rad_s", "rad/s", |point| point[1])
            .number("slip", "1", |point| point[2])
            .number("heat_w", "W", |point| point[3]);
        Document::new()
            .text(in_json("name"), &self.name)
            .numbers(named("load_n", "load"), "N", &self.loads)
            .numbers(named("speed_rad_s", "speed"), "rad/s", &self.speeds)
            .array("slip", map("1", &self.slip))
            .array(named("heat_w", "heat"), map("W", &self.heat))
            .table(in_json("points"), points)
            .texts("failures", &self.failures)
            .flag("complete", self.complete)
    }
}
