//! Measurement data: records, FRFs, test geometry and shapes, as read from and written to files.
//!
//! Values are in SI if the file's unit is known, see [`Record::unit`]. Independent of file formats and of the
//! rotor model; a point and a direction are labels ([`Dof`]).

mod axis;
mod frf_matrix;
mod noisy;
mod shape;

pub use axis::{Axis, AxisQuantity, Points};
pub use frf_matrix::FrfMatrix;
pub use noisy::MeasurementNoise;
pub use shape::{Analysis, AttachedPoint, Element, Geometry, Node, Polyline, Shape};

use super::Complex;

/// Contents of a measured file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredData {
    /// Title of the file; empty if it has none.
    pub title: String,
    /// Time records, spectra and FRFs in the file's order; no two have the same name.
    pub records: Vec<Record>,
    /// Named scalars, such as a rotational speed.
    pub scalars: Vec<(String, f64)>,
    /// Names of records with what in the file states their axis, such as "`bearing.sr` (97656)".
    pub axis_sources: Vec<(String, String)>,
    pub geometry: Geometry,
    pub shapes: Vec<Shape>,
    /// Assumptions and corrections made by the reader, as text.
    pub notes: Vec<String>,
    /// Contents of the file that were not read, by their names in it, with the reason where it is not their type.
    pub left_out: Vec<String>,
}

/// Most names of contents that were left out in a message.
const MAX_LEFT_OUT: usize = 12;

/// One channel of sampled values over an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    pub name: String,
    pub kind: Kind,
    pub axis: Axis,
    pub values: Values,
    /// SI unit, such as "m/s^2" or "(m/s^2)/N"; "1" if dimensionless, empty if the file gives none.
    /// Rotational speeds may be in "rpm".
    pub unit: String,
    /// Unit in the file; values were converted from it if `unit` is not empty.
    pub file_unit: String,
    /// Response DOF: point and direction of the measurement.
    pub response: Dof,
    /// Reference DOF: point and direction of the excitation (force); [`Dof::NONE`] without one.
    pub reference: Dof,
    /// Rotational speed \[rpm\].
    pub speed_rpm: Option<f64>,
    /// Date and time as written in the file.
    pub date: String,
}

/// Kind of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    #[default]
    General,
    Time,
    AutoSpectrum,
    CrossSpectrum,
    Frf,
    Transmissibility,
    Coherence,
    /// Power spectral density \[unit²/Hz\].
    Psd,
    Spectrum,
}

impl Kind {
    /// Every kind with its label.
    pub const LABELS: [(Kind, &'static str); 9] = [
        (Kind::General, "general"),
        (Kind::Time, "time"),
        (Kind::AutoSpectrum, "auto-spectrum"),
        (Kind::CrossSpectrum, "cross-spectrum"),
        (Kind::Frf, "FRF"),
        (Kind::Transmissibility, "transmissibility"),
        (Kind::Coherence, "coherence"),
        (Kind::Psd, "PSD"),
        (Kind::Spectrum, "spectrum"),
    ];

    /// Label of the kind, such as "FRF".
    pub fn label(self) -> &'static str {
        Self::LABELS[self as usize].1
    }
}

/// Sampled values.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    Real(Vec<f64>),
    Complex(Vec<Complex<f64>>),
}

impl Values {
    pub fn len(&self) -> usize {
        match self {
            Values::Real(values) => values.len(),
            Values::Complex(values) => values.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Scales every value by `numerator` / `divisor`; a ratio of 1 leaves them bit-identical.
    pub fn scale(&mut self, numerator: f64, divisor: f64) {
        if numerator == divisor {
            return;
        }
        match self {
            Values::Real(values) => values.iter_mut().for_each(|v| *v = *v * numerator / divisor),
            Values::Complex(values) => values.iter_mut().for_each(|v| *v = *v * numerator / divisor),
        }
    }

    /// Number of NaN and infinite values, and the index of the first.
    pub fn not_finite(&self) -> Option<(usize, usize)> {
        let places: Vec<usize> = match self {
            Values::Real(v) => (0..v.len()).filter(|&k| !v[k].is_finite()).collect(),
            Values::Complex(v) => {
                (0..v.len()).filter(|&k| !(v[k].re.is_finite() && v[k].im.is_finite())).collect()
            }
        };
        places.first().map(|&first| (places.len(), first))
    }
}

/// Degree of freedom of a test, a point and a direction: ±1 ±2 ±3 are ±x ±y ±z, ±4 ±5 ±6 the rotations about
/// them, 0 is a scalar.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Dof {
    /// Number of the point; 0 for none.
    pub node: i64,
    pub direction: i8,
}

impl Dof {
    /// No point, no direction.
    pub const NONE: Dof = Dof { node: 0, direction: 0 };

    pub fn new(node: i64, direction: i8) -> Self {
        Dof { node, direction }
    }

    /// Whether the direction is a rotation.
    pub fn is_rotation(self) -> bool {
        self.direction.unsigned_abs() > 3
    }
}

/// "12:+y", "12:-Rz", "12" for a scalar.
impl std::fmt::Display for Dof {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}", self.node)?;
        let axis = match self.direction.unsigned_abs() {
            1 => "x",
            2 => "y",
            3 => "z",
            4 => "Rx",
            5 => "Ry",
            6 => "Rz",
            _ => return Ok(()),
        };
        write!(f, ":{}{axis}", if self.direction < 0 { '-' } else { '+' })
    }
}

/// Error for an unsuitable record: what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    #[error(transparent)]
    Signal(#[from] crate::SignalError),
    #[error("there is no channel `{name}`; there are {known}")]
    NoChannel { name: String, known: String },
    #[error("`{channel}` does not state its sampling rate; give it, such as \"12 kHz\"")]
    NoRate { channel: String },
    #[error(
        "`{channel}` is not sampled uniformly: the step after value {index} is {given:.6e}, the mean step is {mean:.6e}; resample it at a constant rate first"
    )]
    NonUniform { channel: String, index: usize, given: f64, mean: f64 },
    #[error("`{channel}` is {given}, not a time record; choose a channel of samples over time")]
    NotTime { channel: String, given: &'static str },
    #[error("`{channel}` is {given}, not an FRF over frequency; choose channels with complex values over Hz")]
    NotFrf { channel: String, given: &'static str },
    #[error("`{channel}` does not state its frequencies; give their step, such as \"0.5 Hz\"")]
    NoFrequencies { channel: String },
    #[error(
        "the unit of `{channel}` is unknown ({}); state it, such as \"m/s^2\"",
        if stated.is_empty() { "the file gives none".into() } else { format!("the file gives \"{stated}\"") }
    )]
    UnknownUnit { channel: String, stated: String },
    #[error("the axes of `{first}` and `{second}` differ: {axes}; use one axis for both, or leave one out")]
    AxesDiffer { first: String, second: String, axes: String },
    #[error(
        "there is no FRF between response {response} and reference {reference}; add it, or leave that {} out",
        if *few_references { "reference" } else { "response" }
    )]
    MissingFrf { response: String, reference: String, few_references: bool },
    #[error(
        "`{first}` and `{second}` are both the FRF of {between}; leave one out, or state their points in a mapping (hits at the same point are averaged)"
    )]
    DuplicateFrf { first: String, second: String, between: String },
    #[error("`{channel}` is NaN or infinite at value {index}; cut that part out of the record")]
    NotFinite { channel: String, index: usize },
    #[error(
        "no force channel was identified among the time records ({found}); name it (--force), or state its unit N in a mapping"
    )]
    NoForce { found: String },
    #[error("several time records are forces in N ({found}); name the channel of the hammer (--force)")]
    SeveralForces { found: String },
    #[error("there is no time record other than the force ({found}); add the channels of the accelerometers")]
    NoResponse { found: String },
    #[error(
        "`{channel}` contains no hammer hit: its largest value, {largest} {unit}, is not clearly above its median magnitude of {median} {unit}; check that it is the hammer's channel (--force) and was connected"
    )]
    NoHit { channel: String, largest: f64, median: f64, unit: String },
    #[error(
        "the record of `{channel}` ends {seconds:.3} s after its first hit, less than a block of {block:.3} s; use shorter blocks (--block)"
    )]
    ShortRecord { channel: String, seconds: f64, block: f64 },
    #[error("none of the {hits} hits in `{channel}` is usable: {faults}")]
    NoGoodHit { channel: String, hits: usize, faults: String },
    #[error("there is no FRF among the records ({found}); FRFs are complex values over Hz")]
    NoFrf { found: String },
}

impl RecordError {
    /// Error for two records with different axes.
    pub fn axes_differ(first: &Record, second: &Record) -> Self {
        let axis = |r: &Record| r.axis.describe(r.values.len());
        RecordError::AxesDiffer {
            first: first.name.clone(),
            second: second.name.clone(),
            axes: format!("{} and {}", axis(first), axis(second)),
        }
    }
}

impl Record {
    /// A record of a kind over an axis, in an SI unit; all other fields are empty.
    pub fn new(name: &str, kind: Kind, axis: Axis, values: Values, unit: &str) -> Self {
        Record {
            name: name.into(),
            kind,
            axis,
            values,
            unit: unit.into(),
            file_unit: unit.into(),
            response: Dof::NONE,
            reference: Dof::NONE,
            speed_rpm: None,
            date: String::new(),
        }
    }

    /// Time record sampled at a constant rate \[Hz\] from `start` \[s\].
    pub fn samples(name: &str, rate: f64, start: f64, values: Vec<f64>, unit: &str) -> Self {
        let axis = Axis { quantity: AxisQuantity::Time, points: Points::Uniform { start, step: 1.0 / rate } };
        Record::new(name, Kind::Time, axis, Values::Real(values), unit)
    }

    /// The samples of a time record.
    ///
    /// # Errors
    /// Complex values, or an axis other than time.
    pub fn time_samples(&self) -> Result<&[f64], RecordError> {
        match (&self.values, self.axis.quantity) {
            (Values::Real(values), AxisQuantity::Time | AxisQuantity::Unknown) => Ok(values),
            _ => Err(RecordError::NotTime { channel: self.name.clone(), given: self.kind.label() }),
        }
    }

    /// Sampling rate \[Hz\] of a time record.
    ///
    /// # Errors
    /// The rate is unknown, the sampling is not uniform, or it is not a time record.
    pub fn sample_rate(&self) -> Result<f64, RecordError> {
        self.time_samples()?;
        match &self.axis.points {
            Points::Uniform { step, .. } => Ok(1.0 / step),
            Points::Unknown => Err(RecordError::NoRate { channel: self.name.clone() }),
            Points::NonUniform(points) => {
                let (index, given, mean) = axis::largest_step_deviation(points);
                Err(RecordError::NonUniform { channel: self.name.clone(), index, given, mean })
            }
        }
    }

    /// Values of an FRF over frequencies in Hz.
    ///
    /// # Errors
    /// Real values, or an axis other than frequency.
    pub fn frf(&self) -> Result<&[Complex<f64>], RecordError> {
        match (&self.values, self.axis.quantity) {
            (Values::Complex(values), AxisQuantity::Frequency) => Ok(values),
            (Values::Complex(_), _) if self.axis.points == Points::Unknown => {
                Err(RecordError::NoFrequencies { channel: self.name.clone() })
            }
            _ => Err(RecordError::NotFrf { channel: self.name.clone(), given: self.kind.label() }),
        }
    }

    /// The SI unit.
    ///
    /// # Errors
    /// The file gives no unit, or an unknown one.
    pub fn si_unit(&self) -> Result<&str, RecordError> {
        match self.unit.as_str() {
            "" => {
                Err(RecordError::UnknownUnit { channel: self.name.clone(), stated: self.file_unit.clone() })
            }
            unit => Ok(unit),
        }
    }
}

impl MeasuredData {
    /// What was left out of the file, as a sentence; `None` if nothing was.
    pub fn left_out_text(&self) -> Option<String> {
        let count = self.left_out.len();
        let listed = self.left_out[..count.min(MAX_LEFT_OUT)].join(", ");
        let more = count.saturating_sub(MAX_LEFT_OUT);
        let more = if more > 0 { format!(", and {more} more") } else { String::new() };
        (count > 0).then(|| format!("not read: {listed}{more}"))
    }

    /// The record of this name.
    ///
    /// # Errors
    /// No such record; the error lists the available names.
    pub fn record(&self, name: &str) -> Result<&Record, RecordError> {
        self.records.iter().find(|r| r.name == name).ok_or_else(|| {
            let known: Vec<&str> = self.records.iter().map(|r| r.name.as_str()).take(20).collect();
            let more = if self.records.len() > 20 { ", ..." } else { "" };
            RecordError::NoChannel { name: name.into(), known: known.join(", ") + more }
        })
    }

    /// Sets the axis of every complex record without one to frequencies from 0 by this step \[Hz\]: an FRF.
    pub fn set_missing_frequency_step(&mut self, step: f64) {
        let unknown =
            |r: &&mut Record| r.axis.points == Points::Unknown && matches!(r.values, Values::Complex(_));
        for record in self.records.iter_mut().filter(unknown) {
            record.axis = Axis::uniform(AxisQuantity::Frequency, 0.0, step);
            if record.kind == Kind::General {
                record.kind = Kind::Frf;
            }
        }
    }

    /// Sets the sampling rate \[Hz\] of every time record without one.
    pub fn set_missing_rate(&mut self, rate: f64) {
        let unknown = |r: &&mut Record| {
            r.axis.points == Points::Unknown && matches!(r.values, Values::Real(_)) && r.kind == Kind::Time
        };
        for record in self.records.iter_mut().filter(unknown) {
            let points = Points::Uniform { start: 0.0, step: 1.0 / rate };
            record.axis = Axis { quantity: AxisQuantity::Time, points };
        }
    }
}
