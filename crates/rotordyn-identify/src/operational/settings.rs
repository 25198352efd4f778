//! Input of an output-only identification: the record, the shaft, the settings.

use rotordyn_linalg::StopRequest;
use rotordyn_signal::Quantity;
use rotordyn_signal::record::Dof;

/// Simultaneously sampled responses of a machine under unknown broadband forces.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputRecord {
    /// `samples[channel][sample]`, SI units of any kind.
    pub samples: Vec<Vec<f64>>,
    /// \[Hz\].
    pub sample_rate: f64,
    /// Point and direction of every channel.
    pub dofs: Vec<Dof>,
    /// Quantity of every channel; shapes of records with several are displacements.
    pub quantities: Vec<Quantity>,
}

/// What is known of the rotation of the shaft during the record.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Shaft {
    /// Harmonics are recognised by their amplitude distribution and flagged.
    #[default]
    Unknown,
    /// Constant speed \[rev/s\], refined within [`OperationalSettings::speed_tolerance`] by its harmonics.
    Steady(f64),
    /// Shaft angle \[rad\] at every sample.
    Angle(Vec<f64>),
}

/// Settings of an output-only identification.
#[derive(Clone, Debug, PartialEq)]
pub struct OperationalSettings {
    /// Frequency band \[Hz\]; from 5 cycles in a block of the record to half the sampling rate if `None`.
    pub band: Option<[f64; 2]>,
    /// Highest order of the state space (two per mode); 60, or the maximum for the record, if `None`.
    pub max_order: Option<usize>,
    /// Channels that all others are correlated with; up to 6 chosen by their independence if `None`.
    pub references: Option<Vec<usize>>,
    /// Number of blocks of the record for the standard errors; as many as the correlation time allows if `None`.
    pub blocks: Option<usize>,
    /// Largest damping ratio of a mode.
    pub largest_damping: f64,
    pub shaft: Shaft,
    /// Orders looked for in addition to the multiples of the shaft speed, such as the ball-pass order; at a steady speed each is
    /// refined within 1.5 %, which balls that slip need.
    pub orders: Vec<f64>,
    /// Relative range around a steady speed in which its harmonics are looked for.
    pub speed_tolerance: f64,
    /// Ends the identification from another thread.
    pub stop: StopRequest,
}

impl Default for OperationalSettings {
    fn default() -> Self {
        Self {
            band: None,
            max_order: None,
            references: None,
            blocks: None,
            largest_damping: 0.2,
            shaft: Shaft::Unknown,
            orders: Vec::new(),
            speed_tolerance: 0.005,
            stop: StopRequest::default(),
        }
    }
}
