//! Unbalance response.

use super::response_grid::{is_rotation, requested_mask, unit_of};
use super::{BearingForce, UndampedPeak};
use crate::analysis::critical_speed::UnstableMode;
use crate::analysis::peaks::Peak;
use crate::analysis::separation::SeparationMargin;
use crate::analysis::shaft_loads::ShaftAmplitudes;
use crate::document::{Array, Document, MissingCell, Rows, TO_RPM, in_hdf5, in_json, named};
use crate::model::Probe;
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// Unbalance response at every requested probe, and the orbit of every disc.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct UnbalanceResult {
    /// Speeds Ω \[rad/s\]: those requested and those added around the critical speeds.
    pub speeds: Vec<f64>,
    /// Index of every requested speed.
    pub requested: Vec<usize>,
    pub channels: Vec<UnbalanceChannel>,
    pub orbits: Vec<DiscOrbit>,
    /// Peaks of every channel and orbit, by speed \[rad/s\].
    pub peaks: Vec<ResponsePeak>,
    /// Lowest and highest operating speed \[rad/s\] for the separation margins: those of the study, else the highest of
    /// the speed profile.
    pub operating_speeds: Option<[f64; 2]>,
    /// Critical speeds with their margins.
    pub margins: Vec<SeparationMargin>,
    pub bearing_forces: Vec<BearingForce>,
    /// Displacements u_x and u_y of the shaft in every bearing, relative to its housing, over speed \[m\].
    pub bearing_displacements: Vec<Vec<[Complex64; 2]>>,
    /// Amplitudes along the shaft at the highest operating speed and where its bending moment is largest; empty for a
    /// rigid rotor.
    pub shaft: Vec<ShaftAmplitudes>,
    /// Undamped modes excited by the unbalance, at which the response is infinite, by speed \[rad/s\].
    pub undamped: Vec<UndampedPeak>,
    /// An unstable mode at the lowest speed that is known to have one.
    #[serde(default)]
    pub unstable: Option<UnstableMode>,
}

/// A peak of the unbalance response.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResponsePeak {
    /// Name of the probe, or "orbit of disc.NAME" for its semi-major axis.
    pub response: String,
    pub unit: String,
    pub peak: Peak,
}

/// One response: complex amplitude of the probe's quantity over speed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct UnbalanceChannel {
    pub probe: Probe,
    /// Re and Im per speed; x(t) = Re(X e^{jΩt}).
    pub amplitude: Vec<[f64; 2]>,
}

/// The orbit of a disc's centre over speed: complex u_x and u_y as Re and Im.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct DiscOrbit {
    pub name: String,
    pub x: Vec<[f64; 2]>,
    pub y: Vec<[f64; 2]>,
}

impl UnbalanceChannel {
    /// Unit of the response.
    pub fn unit(&self) -> &'static str {
        unit_of(self.probe.quantity, is_rotation(&self.probe.direction))
    }
}

impl UnbalanceResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let speeds: Vec<f64> = self.speeds.iter().map(|speed| speed * TO_RPM).collect();
        let count = speeds.len();
        let part = |pairs: &[[f64; 2]], k: usize| -> Vec<f64> { pairs.iter().map(|p| p[k]).collect() };
        let responses = Rows::of(&self.channels)
            .text("name", |c| &c.probe.name)
            .text("unit", UnbalanceChannel::unit)
            .numbers("re", "", &[count], |c| part(&c.amplitude, 0))
            .numbers("im", "", &[count], |c| part(&c.amplitude, 1));
        let orbits = Rows::of(&self.orbits)
            .text("disc", |o| &o.name)
            .numbers("x_re", "m", &[count], |o| part(&o.x, 0))
            .numbers("x_im", "m", &[count], |o| part(&o.x, 1))
            .numbers("y_re", "m", &[count], |o| part(&o.y, 0))
            .numbers("y_im", "m", &[count], |o| part(&o.y, 1));
        let complex = |pairs: &[[f64; 2]], unit| {
            let values: Vec<_> = pairs.iter().map(|&[re, im]| Complex64::new(re, im)).collect();
            Array::complex(&[pairs.len()], unit, values).over(0, "rpm")
        };
        let mut out = Document::new()
            .array(in_json("requested"), Array::indices(&self.requested))
            .array(in_hdf5("requested"), requested_mask(&self.requested, count).over(0, "rpm"))
            .numbers(named("speeds_rpm", "rpm"), "rpm", speeds)
            .optional(in_json("operating_speed_rpm"), "rad/s", self.operating_speeds.map(|speeds| speeds[1]))
            .optional(
                in_json("lowest_operating_speed_rpm"),
                "rad/s",
                self.operating_speeds.map(|speeds| speeds[0]),
            )
            .table("peaks", self.peak_columns())
            .table("separation_margins", SeparationMargin::columns(&self.margins))
            .table(in_json("bearing_forces"), BearingForce::columns(&self.bearing_forces, count))
            .list("shaft", self.shaft.iter().map(ShaftAmplitudes::document))
            .and(BearingForce::arrays(&self.bearing_forces))
            .table(in_json("undamped"), UndampedPeak::columns(&self.undamped, "speed_rpm", TO_RPM))
            .table(in_json("responses"), responses)
            .table(in_json("orbits"), orbits);
        for (k, shaft) in self.shaft.iter().enumerate() {
            out = out.group(in_hdf5(format!("shaft/{k}")), shaft.document());
        }
        for channel in &self.channels {
            let name = in_hdf5(format!("channels/{}", channel.probe.name));
            out = out.array(name, complex(&channel.amplitude, channel.unit()));
        }
        for DiscOrbit { name, x, y } in &self.orbits {
            out = out
                .array(in_hdf5(format!("orbits/{name}/x")), complex(x, "m"))
                .array(in_hdf5(format!("orbits/{name}/y")), complex(y, "m"));
        }
        out
    }

    fn peak_columns(&self) -> Rows<'static, '_, ResponsePeak> {
        let speed = self.operating_speeds;
        let half_power =
            |p: &ResponsePeak| p.peak.half_power.map_or([f64::NAN; 2], |ends| ends.map(|s| s * TO_RPM));
        Rows::of(&self.peaks)
            .text("response", |p| &p.response)
            .text(in_json("unit"), |p| &p.unit)
            .number(named("speed_rpm", "rpm"), "rpm", |p| p.peak.at * TO_RPM)
            .number("amplitude", "SI", |p| p.peak.amplitude)
            .optional("amplification_factor", "1", |p| p.peak.amplification())
            .numbers(in_json("half_power_rpm"), "rpm", &[2], half_power)
            .missing(MissingCell::Null)
            .optional(in_json("separation_margin"), "1", |p| speed.map(|speed| p.peak.separation(speed)))
            .optional(in_json("required_separation_margin"), "1", |p| p.peak.required_separation(speed?))
    }
}
