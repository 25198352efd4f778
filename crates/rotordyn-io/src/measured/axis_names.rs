//! Names under which programs store sampling rates, steps, times and frequencies.
//!
//! Case, blanks, `_`, `-` and `.` do not matter: `SampleFrequency`, `sample_frequency` and `Sample frequency` are one name.
//! A unit may follow: `fs_kHz`, `time_ms`.

use super::unit_label;
use crate::measured::content_problem::ContentProblem;

/// What a name states of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Samples per second.
    Rate,
    /// Seconds per sample.
    Step,
    /// Time of the first sample.
    Start,
    /// Number of samples.
    Count,
    /// List of times.
    Times,
    /// List of frequencies.
    Frequencies,
}

/// Names without case and separators, the most definite first.
const NAMES: [(Role, &[&str]); 6] = [
    (
        Role::Rate,
        &[
            "fs",
            "fshz",
            "samplerate",
            "samplingrate",
            "sampleratehz",
            "samplingratehz",
            "samplefrequency",
            "samplingfrequency",
            "samplefreq",
            "samplingfreq",
            "sfreq",
            "fsample",
            "fsamp",
            "samplespersecond",
            "abtastrate",
            "abtastfrequenz",
            "sr",
            "srate",
            "rate",
        ],
    ),
    (
        Role::Step,
        &[
            "dt",
            "deltat",
            "tdelta",
            "timestep",
            "sampleinterval",
            "samplinginterval",
            "sampletime",
            "sampleperiod",
            "samplingperiod",
            "wfincrement",
            "xincrement",
            "deltax",
            "xdelta",
            "ts",
            "step",
        ],
    ),
    (Role::Start, &["t0", "tstart", "wfstartoffset", "xstart", "x0"]),
    (
        Role::Count,
        &[
            "npts",
            "npoints",
            "nsamples",
            "nsamp",
            "numsamples",
            "samplecount",
            "numberofsamples",
            "wfsamples",
        ],
    ),
    (
        Role::Times,
        &["time", "t", "times", "timedomain", "timevector", "timeaxis", "tvec", "ts", "xvalue", "zeit"],
    ),
    (
        Role::Frequencies,
        &[
            "freqhz",
            "frequency",
            "frequencies",
            "freq",
            "freqs",
            "f",
            "fhz",
            "frequencyhz",
            "freqdomain",
            "frequencydomain",
            "freqvector",
            "freqaxis",
            "fvec",
            "frequenz",
        ],
    ),
];

/// Names that may state something else, such as the rate of the shaft: taken only where nothing else states the axis.
const UNCERTAIN: [&str; 3] = ["rate", "ts", "step"];

/// What a name states, with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Meaning {
    pub role: Role,
    /// Place in the list of names: lower is more definite.
    pub rank: usize,
    pub uncertain: bool,
    /// A value times `numerator` over `divisor` is in Hz or s.
    pub numerator: f64,
    pub divisor: f64,
}

/// Longest name of an axis with its unit \[bytes\].
const MAX_NAME: usize = 64;

/// What a name states as one of the roles; `None` if nothing.
pub(crate) fn meaning(name: &str, roles: &[Role]) -> Option<Meaning> {
    if name.len() > MAX_NAME {
        return None;
    }
    let find = |name: &str, numerator: f64, divisor: f64| {
        let plain = plain(name);
        roles.iter().find_map(|role| {
            let names = NAMES.iter().find(|(of, _)| of == role)?.1;
            let rank = names.iter().position(|known| *known == plain)?;
            let uncertain = UNCERTAIN.contains(&plain.as_str());
            Some(Meaning { role: *role, rank, uncertain, numerator, divisor })
        })
    };
    find(name, 1.0, 1.0).or_else(|| {
        let (base, si) = unit_label::split_unit_suffix(name)?;
        let found = find(base, 1.0, 1.0)?;
        let (numerator, divisor) = found.role.factor(&si)?;
        Some(Meaning { numerator, divisor, ..found })
    })
}

impl Meaning {
    /// A value in Hz or s.
    pub fn in_si(&self, value: f64) -> f64 {
        // A ratio of 1 keeps the value bit by bit.
        if self.numerator == self.divisor { value } else { value * self.numerator / self.divisor }
    }
}

/// A name in lower case without separators.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| !matches!(c, ' ' | '_' | '-' | '.'));
    kept.flat_map(char::to_lowercase).collect()
}

/// Relative difference of two rates that are the same: a step printed with three digits is off by up to 0.5 %.
const SAME_RATE: f64 = 5e-3;

/// A sampling rate that something in the file states.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StatedRate {
    /// \[Hz\]
    pub rate: f64,
    /// \[s\]
    pub step: f64,
    /// What states it, such as "`bearing.sr` (97656)".
    pub source: String,
}

impl StatedRate {
    /// A rate that the user gives \[Hz\].
    pub fn given(rate: f64) -> Self {
        Self { rate, step: 1.0 / rate, source: "the rate given".into() }
    }

    /// The rate or the step that a value of a name states; `None` if it cannot be one.
    pub fn of(meaning: &Meaning, name: &str, value: f64) -> Option<Self> {
        let si = meaning.in_si(value);
        let (rate, step) = match meaning.role {
            Role::Rate => (si, 1.0 / si),
            Role::Step => (1.0 / si, si),
            _ => return None,
        };
        let possible = [rate, step].iter().all(|v| *v > 0.0 && v.is_finite());
        possible.then(|| Self { rate, step, source: format!("`{name}` ({value})") })
    }
}

/// Whether two rates differ by at most 0.5 %.
pub(crate) fn is_same_rate(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() <= SAME_RATE
}

/// Refuses rates that differ, naming both.
///
/// # Errors
/// Two rates differ by more than 0.5 %.
pub(crate) fn check_same<'a>(rates: impl IntoIterator<Item = &'a StatedRate>) -> Result<(), ContentProblem> {
    let mut rates = rates.into_iter();
    let Some(first) = rates.next() else { return Ok(()) };
    match rates.find(|other| !is_same_rate(other.rate, first.rate)) {
        None => Ok(()),
        Some(other) => Err(ContentProblem::new(
            format!(
                "it states two sampling rates: {} is {} Hz, {} is {} Hz",
                first.source,
                six_digits(first.rate),
                other.source,
                six_digits(other.rate)
            ),
            "find out which is right, and write the file again without the other",
        )),
    }
}

/// A number with at most six digits.
pub(crate) fn six_digits(value: f64) -> String {
    match format!("{value:.5e}").parse::<f64>() {
        Ok(rounded) => rounded.to_string(),
        Err(_) => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_use_have_a_meaning_in_any_case() {
        let role = |name: &str| {
            let all = NAMES.map(|(role, _)| role);
            meaning(name, &all).map(|m| (m.role, m.numerator / m.divisor))
        };
        for name in ["sr", "fs", "Fs", "FS", "SampleFrequency", "sample_rate", "Sampling Rate", "fs_Hz"] {
            assert_eq!(role(name), Some((Role::Rate, 1.0)), "{name}");
        }
        assert_eq!(role("fs_kHz"), Some((Role::Rate, 1000.0)));
        assert_eq!(role("dt"), Some((Role::Step, 1.0)));
        assert_eq!(role("dt_ms").map(|(role, _)| role), Some(Role::Step));
        assert_eq!(role("Delta_X"), Some((Role::Step, 1.0)));
        assert_eq!(role("NPTS"), Some((Role::Count, 1.0)));
        for name in ["t", "Time", "X_Value", "time_s"] {
            assert_eq!(role(name), Some((Role::Times, 1.0)), "{name}");
        }
        for name in ["freq", "Freq_domain", "f", "freq_hz"] {
            assert_eq!(role(name), Some((Role::Frequencies, 1.0)), "{name}");
        }
        // A force, a time in metres and a data set of any other name are no axis.
        for name in ["force", "fs_m", "load", "X105_DE_time", ""] {
            assert_eq!(role(name), None, "{name}");
        }
    }

    #[test]
    fn rates_are_the_same_within_three_digits() {
        let rate = |name: &str, value: f64| {
            StatedRate::of(&meaning(name, &[Role::Rate, Role::Step]).unwrap(), name, value)
        };
        // 12 kHz as a step of three digits: 8.33e-5 s.
        let same = [rate("fs", 12_000.0).unwrap(), rate("dt", 8.33e-5).unwrap()];
        check_same(&same).unwrap();
        let two = [rate("fs", 12_000.0).unwrap(), rate("dt", 1e-4).unwrap()];
        let error = check_same(&two).unwrap_err();
        assert_eq!(
            error.problem,
            "it states two sampling rates: `fs` (12000) is 12000 Hz, `dt` (0.0001) is 10000 Hz"
        );
        for impossible in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
            assert_eq!(rate("fs", impossible), None, "{impossible}");
        }
    }
}
