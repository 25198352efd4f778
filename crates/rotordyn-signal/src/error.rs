//! Errors of records and settings, and the validity checks that return them.

/// Invalid record or setting of a signal function: what was expected, what was given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SignalError {
    #[error("{name} is empty: at least one sample is needed")]
    Empty { name: &'static str },
    #[error("{name} holds {value} at sample {index}: every sample must be finite")]
    NotFinite { name: &'static str, index: usize, value: f64 },
    #[error("{name} has {given} samples: at least {needed} are needed for {purpose}")]
    TooShort { name: &'static str, needed: usize, given: usize, purpose: &'static str },
    #[error("{name} has {given} samples: {expected} were expected, as many as {reference} has")]
    LengthMismatch { name: &'static str, reference: &'static str, expected: usize, given: usize },
    #[error(
        "time is not uniform: the step after sample {index} is {given:.6e} s, the mean step is {expected:.6e} s"
    )]
    NonUniform { index: usize, expected: f64, given: f64 },
    #[error("{name} = {given} is out of range: expected {expected}")]
    OutOfRange { name: &'static str, expected: &'static str, given: f64 },
    #[error("the sampling rate is {given} Hz: {purpose} needs at least {needed:.1} Hz")]
    RateTooLow { given: f64, needed: f64, purpose: &'static str },
    #[error(
        "the shaft turns {given:.3} revolutions without stopping or reversing: {needed:.3} are needed for {purpose}"
    )]
    TooFewRevolutions { needed: f64, given: f64, purpose: &'static str },
    #[error("{purpose} needs {what}, which is not known")]
    Unknown { what: &'static str, purpose: &'static str },
}

/// Error for an empty record or one with NaN or infinity.
pub(crate) fn check_record(name: &'static str, record: &[f64]) -> Result<(), SignalError> {
    if record.is_empty() {
        return Err(SignalError::Empty { name });
    }
    match record.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(SignalError::NotFinite { name, index, value: record[index] }),
        None => Ok(()),
    }
}

/// Error for a sampling rate that is not a positive number.
pub(crate) fn check_rate(sample_rate: f64) -> Result<(), SignalError> {
    check(
        sample_rate > 0.0 && sample_rate.is_finite(),
        "sampling rate",
        "a positive number of Hz",
        sample_rate,
    )
}

/// Error if two records differ in length.
pub(crate) fn check_same_length(
    name: &'static str,
    given: usize,
    reference: &'static str,
    expected: usize,
) -> Result<(), SignalError> {
    if given == expected {
        Ok(())
    } else {
        Err(SignalError::LengthMismatch { name, reference, expected, given })
    }
}

/// Error for a setting that does not meet `condition`.
pub(crate) fn check(
    condition: bool,
    name: &'static str,
    expected: &'static str,
    given: f64,
) -> Result<(), SignalError> {
    if condition { Ok(()) } else { Err(SignalError::OutOfRange { name, expected, given }) }
}

/// Error for a record with fewer samples than needed.
pub(crate) fn check_length(
    name: &'static str,
    given: usize,
    needed: usize,
    purpose: &'static str,
) -> Result<(), SignalError> {
    if given >= needed { Ok(()) } else { Err(SignalError::TooShort { name, needed, given, purpose }) }
}
