//! Free balls beside cages that roll without slip: speeds of the cages, and levels of the order lines.

use super::OrderLine;
use crate::document::{Document, Rows, in_json, named};
use serde::{Deserialize, Serialize};

/// Deviation of the cage speed up to which a cage that rolls without slip is called good enough.
const SPEED_LIMIT: f64 = 1e-3;
/// The same of the level of an order line.
const LEVEL_LIMIT: f64 = 0.05;
/// Lines below this share of their channel's largest are not judged, nor those below this multiple of the noise.
const SMALLEST_SHARE: f64 = 0.05;
const NOISE_FACTOR: f64 = 10.0;

/// The last third of a run's revolutions with free balls, and of the same run with cages that roll without slip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RollingCageComparison {
    /// Start and end \[s\], and revolutions of the shaft.
    pub stretch: [f64; 2],
    pub revolutions: f64,
    pub cages: Vec<CageSpeed>,
    pub lines: Vec<CageLine>,
}

/// Mean cage speed of a bearing with free balls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CageSpeed {
    pub bearing: String,
    /// Turns of the balls about the bearing per revolution of the shaft, and those of a cage that rolls without slip.
    pub order: f64,
    pub rolling_order: f64,
    /// Order of ball passage over the outer race that this gives, and by rolling.
    pub bpfo: f64,
    pub rolling_bpfo: f64,
    /// Largest slip of the cage, 1 − speed over that of rolling.
    pub largest_slip: f64,
    /// Largest pocket force \[N\].
    pub pocket_force: f64,
    /// Mean friction torque \[N m\] and power lost \[W\].
    pub friction_torque: f64,
    pub friction_power: f64,
}

/// One order line of one channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CageLine {
    pub channel: String,
    pub unit: String,
    pub line: OrderLine,
    /// RMS level with free balls, with a cage that rolls, with one that turns with the balls' mean angle of the run, and with
    /// every kinematic ball at the angle of its free one.
    pub free: f64,
    pub rolling: f64,
    pub driven: f64,
    pub spaced: f64,
    /// Level with free balls at orders a few lines beside it, where there is only the noise of collisions.
    pub noise: f64,
}

impl CageSpeed {
    /// Mean slip of the balls, 1 − orbital speed over that of rolling.
    pub fn slip(&self) -> f64 {
        1.0 - self.order / self.rolling_order
    }
}

impl CageLine {
    /// Relative difference of the level with free balls from that of a cage that rolls.
    pub fn difference(&self) -> f64 {
        self.free / self.rolling - 1.0
    }

    /// Relative difference from the level of a cage that turns with the balls.
    pub fn difference_driven(&self) -> f64 {
        self.free / self.driven - 1.0
    }

    /// Relative difference from the level with every kinematic ball at the angle of its free one.
    pub fn difference_spaced(&self) -> f64 {
        self.free / self.spaced - 1.0
    }
}

impl RollingCageComparison {
    /// Lines that are not small beside the largest of their channel and the noise.
    fn judged(&self) -> impl Iterator<Item = &CageLine> {
        self.lines.iter().filter(|line| {
            let largest = self.lines.iter().filter(|other| other.channel == line.channel);
            line.free > SMALLEST_SHARE * largest.map(|other| other.free).fold(0.0, f64::max)
                && line.free > NOISE_FACTOR * line.noise
        })
    }

    /// Whether a cage that rolls without slip describes this run, in one sentence.
    pub fn conclusion(&self) -> String {
        let slips = |cage: &&CageSpeed| {
            let shift = (cage.bpfo - cage.rolling_bpfo).abs();
            cage.slip().abs() > SPEED_LIMIT && shift * self.revolutions > 1.0
        };
        let fastest = |a: &&CageSpeed, b: &&CageSpeed| a.slip().abs().total_cmp(&b.slip().abs());
        if let Some(cage) = self.cages.iter().filter(slips).max_by(fastest) {
            return format!(
                "the balls of {} slip: their orders lie {:.2} % from those of a cage that rolls",
                cage.bearing,
                -100.0 * cage.slip()
            );
        }
        let differs = self.judged().filter(|line| line.difference().abs() > LEVEL_LIMIT);
        match differs.max_by(|a, b| a.difference().abs().total_cmp(&b.difference().abs())) {
            Some(line) => format!(
                "cage speeds as by rolling, but levels differ: {} of {} by {:.0} %, {:.0} % with the cage at the balls' mean \
                 angle, {:.0} % with every ball at its own",
                line.line.label,
                line.channel,
                100.0 * line.difference(),
                100.0 * line.difference_driven(),
                100.0 * line.difference_spaced()
            ),
            None => "a cage that rolls without slip is good enough for this run".into(),
        }
    }

    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let cages = Rows::of(&self.cages)
            .text("bearing", |c| &c.bearing)
            .number("ftf", "1/revolution", |c| c.order)
            .number("rolling_ftf", "1/revolution", |c| c.rolling_order)
            .number("bpfo", "1/revolution", |c| c.bpfo)
            .number("rolling_bpfo", "1/revolution", |c| c.rolling_bpfo)
            .number("mean_slip", "1", CageSpeed::slip)
            .number("largest_slip", "1", |c| c.largest_slip)
            .number(named("largest_pocket_force_n", "largest_pocket_force"), "N", |c| c.pocket_force)
            .number(named("friction_torque_n_m", "friction_torque"), "N m", |c| c.friction_torque)
            .number(named("friction_power_w", "friction_power"), "W", |c| c.friction_power);
        let lines = Rows::of(&self.lines)
            .text("channel", |l| &l.channel)
            .text("unit", |l| &l.unit)
            .text("label", |l| &l.line.label)
            .number("order", "1/revolution", |l| l.line.order)
            .number("rms_free_balls", "", |l| l.free)
            .number("rms_rolling_cage", "", |l| l.rolling)
            .number("rms_driven_cage", "", |l| l.driven)
            .number("rms_driven_balls", "", |l| l.spaced)
            .number("rms_noise", "", |l| l.noise);
        Document::new()
            .quantity("start", "s", self.stretch[0])
            .quantity("end", "s", self.stretch[1])
            .number("revolutions", "1", self.revolutions)
            .table(named("cages", "cages"), cages)
            .table(named("lines", "lines"), lines)
            .text(in_json("conclusion"), self.conclusion())
    }
}
