//! Shaft speed as a function of time.

/// Prescribed shaft speed over time; speeds in rad/s, times in s.
#[derive(Clone, Debug, PartialEq)]
pub enum SpeedProfile {
    Constant {
        speed: f64,
        duration: f64,
    },
    /// `settle` at `from`, linear ramp over `ramp` to `to`, `hold` at `to`.
    Ramp {
        from: f64,
        to: f64,
        settle: f64,
        ramp: f64,
        hold: f64,
    },
    /// Like `Ramp` with a smooth (C²) quintic start and end.
    SCurve {
        from: f64,
        to: f64,
        settle: f64,
        ramp: f64,
        hold: f64,
    },
    /// Points (time, speed), joined by a monotone cubic.
    Table {
        points: Vec<[f64; 2]>,
    },
    /// Ω(t) = Ω₀ exp(−t/τ) after `settle`, until `duration`.
    CoastDown {
        from: f64,
        settle: f64,
        time_constant: f64,
        duration: f64,
    },
}
