//! Waterfall (cascade) plot: spectra at chosen speeds.

use super::SignalError;
use super::error::{check, check_record, check_same_length};

/// Spectra over one axis (Hz or order) at increasing speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Waterfall {
    /// Speeds of the rows \[rpm\]: the requested ones that the run reaches.
    pub rpm: Vec<f64>,
    pub axis: Vec<f64>,
    /// Amplitudes, a row for each speed.
    pub amplitude: Vec<f64>,
    /// Requested speeds \[rpm\] without any frame.
    pub missing: Vec<f64>,
}

/// Averages the power of all frames within ± `half_width` of each chosen speed.
///
/// `axis` (bins), `amplitude` (frames × bins) row-major, `frame_rpm` (frames), `rpm_steps` and `half_width`
/// \[rpm\]. A run that passes a speed twice gives the mean of both passes. Errors: NaN, sizes that do not
/// match.
pub fn waterfall(
    axis: &[f64],
    amplitude: &[f64],
    frame_rpm: &[f64],
    rpm_steps: &[f64],
    half_width: f64,
) -> Result<Waterfall, SignalError> {
    check_record("axis", axis)?;
    check_record("frame speeds", frame_rpm)?;
    check_record("rpm steps", rpm_steps)?;
    check(half_width > 0.0, "half width", "a positive speed", half_width)?;
    check_same_length("amplitude", amplitude.len(), "frames times axis", frame_rpm.len() * axis.len())?;
    let mut out =
        Waterfall { rpm: Vec::new(), axis: axis.to_vec(), amplitude: Vec::new(), missing: Vec::new() };
    for &step in rpm_steps {
        let mut power = vec![0.0; axis.len()];
        let mut frames = 0;
        for (row, rpm) in amplitude.chunks_exact(axis.len()).zip(frame_rpm) {
            if (rpm - step).abs() <= half_width {
                frames += 1;
                power.iter_mut().zip(row).for_each(|(p, a)| *p += a * a);
            }
        }
        if frames == 0 {
            out.missing.push(step);
            continue;
        }
        out.rpm.push(step);
        out.amplitude.extend(power.iter().map(|p| (p / frames as f64).sqrt()));
    }
    Ok(out)
}
