//! Output-only (operational) modal analysis: modes of a running machine from its responses alone.
//!
//! | module | contents |
//! |---|---|
//! | `settings`, `result` | record, shaft, settings; modes with standard errors, harmonics, what was dropped |
//! | `prepare` | band, decimation, scale |
//! | `lines`, `orders` | sines recognised by their amplitude distribution; order subtraction |
//! | `correlation` | correlations by blocks, block Hankel matrix |
//! | `subspace`, `uncertainty` | covariance-driven stochastic subspace identification (SSI-cov); standard errors |
//! | `selection` | modes by stabilisation over the orders; harmonics, spurious poles, doubts |
//! | `parts` | parts of the band identified by themselves where peaks are left over |
//! | `fdd` | frequency-domain decomposition |
//!
//! The unknown forces are taken for broadband and random. A peak of their spectrum is indistinguishable from a mode, and
//! a sine (unbalance, ball pass) is an undamped one: harmonics are removed or recognised.

mod correlation;
mod fdd;
mod lines;
mod orders;
mod parts;
mod prepare;
mod result;
mod selection;
mod settings;
mod subspace;
mod uncertainty;

pub use result::{Harmonic, OperationalMode, OperationalModes, SpectralDecomposition, SpectralPeak};
pub use settings::{OperationalSettings, OutputRecord, Shaft};

use correlation::{correlations, hankel, independent_channels};
use prepare::Prepared;
use selection::{Search, select};
use subspace::Subspace;

use crate::{IdentifyError, stabilisation};

/// Most reference channels that are chosen.
const MAX_REFERENCES: usize = 6;
/// Largest size of the Hankel matrix, rows and columns.
const MAX_ROWS: usize = 600;
const MAX_COLUMNS: usize = 200;
/// Blocks of the standard errors.
const MOST_BLOCKS: usize = 100;
const FEWEST_BLOCKS: usize = 10;

/// Identifies the modes of a machine from its responses to unknown random forces.
///
/// `record` y (channels by samples, SI), at least some thousand cycles of the lowest mode for its damping;
/// [`OperationalSettings`]. Harmonics are subtracted where the motion of the shaft is known, and recognised by their
/// amplitude distribution; none is returned as a mode. Standard errors from the scatter of the correlations between blocks.
///
/// # Errors
/// Values that are not finite, dead channels, too few samples, wrong settings, no mode.
pub fn identify_operational(
    record: &OutputRecord,
    settings: &OperationalSettings,
) -> Result<OperationalModes, IdentifyError> {
    let mut found = identify_band(record, settings)?;
    parts::resolve(record, settings, &mut found);
    found.warnings.extend(unexplained_peaks(&found).into_iter().map(|peak| {
        format!(
            "the spectrum has a peak of {:.0} dB at {:.3} Hz that no mode explains: too short a record for it, a peak of the \
             forces, or an unsteady harmonic",
            peak.height_db, peak.frequency
        )
    }));
    if found.modes.is_empty() && found.warnings.is_empty() {
        let poles = found.diagram.len();
        return Err(IdentifyError::NoMode {
            from: found.band[0],
            to: found.band[1],
            poles,
            orders: found.orders.len(),
        });
    }
    Ok(found)
}

/// Modes of one band.
fn identify_band(
    record: &OutputRecord,
    settings: &OperationalSettings,
) -> Result<OperationalModes, IdentifyError> {
    let whole = Prepared::new(record, settings)?;
    let first = without_harmonics(whole.clone(), settings);
    // The harmonics are fitted again without a transient at the start, whose remains would look like some.
    let start = first.data.transient();
    let left_out = start as f64 / first.data.rate;
    let Steady { data, shaft_speed, mut harmonics } = match start {
        0 => first,
        start => without_harmonics(whole.without_start(start), settings),
    };
    let impulsive = impulsive_warning(&data, record);
    harmonics.extend(lines::sines(&data));
    harmonics.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));

    let references = match &settings.references {
        Some(list) => list.clone(),
        None => independent_channels(&data, MAX_REFERENCES),
    };
    let (channels, inputs) = (data.channels(), references.len());
    let (rows, highest) = sizes(&data, settings, channels, inputs)?;
    let lags = 2 * rows - 1;
    let most = ((data.len() - lags) / (2 * lags)).clamp(1, MOST_BLOCKS);
    let blocks = settings.blocks.unwrap_or(most).min((data.len() - lags) / 2);
    if blocks < FEWEST_BLOCKS {
        return Err(IdentifyError::ShortRecord {
            duration: data.duration(),
            needed: (2 * FEWEST_BLOCKS + 1) as f64 * lags as f64 / data.rate,
            lowest: data.band[0],
        });
    }
    let correlations = correlations(&data, &references, lags, blocks);
    let space = Subspace::new(&hankel(&correlations.mean, rows), channels, inputs, data.rate)?;
    let highest = highest.min(space.s.len().saturating_sub(1) & !1);
    let orders: Vec<usize> = (1..=highest / 2).map(|k| 2 * k).collect();
    let candidates = space.candidates(&orders, data.band, settings.largest_damping)?;
    let diagram = stabilisation::diagram(&candidates, &orders);
    let search = Search {
        data: &data,
        space: &space,
        correlations: &correlations,
        rows,
        orders: &orders,
        candidates: &candidates,
        harmonics: &harmonics,
        dofs: &record.dofs,
    };
    let mut found = select(&search)?;
    let channels_of_spectrum = independent_channels(&data, fdd::MAX_CHANNELS);
    let spectrum = fdd::decomposition(&data, &channels_of_spectrum, &harmonics)?;
    note_possible_pairs(&spectrum, &mut found.modes);
    found.warnings.extend(impulsive);
    Ok(OperationalModes {
        modes: found.modes,
        dofs: record.dofs.clone(),
        references,
        band: data.band,
        sample_rate: data.rate,
        duration: data.duration(),
        left_out,
        blocks,
        block_length: (data.len() - lags) as f64 / blocks as f64 / data.rate,
        longest_lag: lags as f64 / data.rate,
        shaft_speed,
        spectrum,
        diagram,
        orders,
        harmonics,
        dropped: found.dropped,
        warnings: found.warnings,
    })
}

/// A record without harmonics.
struct Steady {
    data: Prepared,
    /// \[rev/s\].
    shaft_speed: Option<f64>,
    harmonics: Vec<Harmonic>,
}

/// Rounds of subtraction: a strong line hides weak ones near it.
const ROUNDS: usize = 3;

/// Subtracts the orders of the shaft, if its motion is known, and sines of constant frequency.
fn without_harmonics(mut data: Prepared, settings: &OperationalSettings) -> Steady {
    let (mut shaft_speed, mut harmonics) = (None, Vec::new());
    if let Some((theta, speed)) = orders::shaft_angle(&data, &settings.shaft, settings.speed_tolerance) {
        let other = match settings.shaft {
            Shaft::Steady(_) => orders::refined_orders(&data, speed, &settings.orders),
            _ => settings.orders.clone(),
        };
        harmonics = orders::subtract(&mut data, &theta, speed, &other);
        shaft_speed = Some(speed);
    }
    for _ in 0..ROUNDS {
        let lines = lines::constant_sines(&data);
        if lines.is_empty() {
            break;
        }
        harmonics.extend(orders::subtract_sines(&mut data, lines));
    }
    Steady { data, shaft_speed, harmonics }
}

/// Excess kurtosis from which a response is one of hits; 0 under random forces, whatever the modes.
const IMPULSIVE_KURTOSIS: f64 = 5.0;

/// Warning of a record of hits or bursts.
fn impulsive_warning(data: &Prepared, record: &OutputRecord) -> Option<String> {
    let kurtosis = |samples: &Vec<f64>| {
        let n = samples.len() as f64;
        let moment = |power: i32| samples.iter().map(|x| x.powi(power)).sum::<f64>() / n;
        moment(4) / moment(2).powi(2) - 3.0
    };
    let all = data.samples.iter().map(kurtosis).zip(&record.dofs);
    let (largest, dof) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (largest > IMPULSIVE_KURTOSIS).then(|| {
        format!(
            "the response {dof} is impulsive (excess kurtosis {largest:.1}, random forces give 0): standard errors hold for \
             random forces; for an impact test add the channel of the force"
        )
    })
}

/// Second singular value over the first from which a peak may be two modes, and its height over the lines around \[dB\].
const PAIR_RATIO: f64 = 0.1;
const PAIR_DB: f64 = 6.0;

/// Notes modes in whose peak a second motion is nearly as large as the first, with no second mode there.
fn note_possible_pairs(spectrum: &SpectralDecomposition, modes: &mut [OperationalMode]) {
    let [first, second, ..] = &spectrum.values[..] else { return };
    let half_width = |m: &OperationalMode| m.damping_ratio() * m.frequency_hz();
    for k in 0..modes.len() {
        let (hz, width) = (modes[k].frequency_hz(), half_width(&modes[k]));
        let close = |(j, m): (usize, &OperationalMode)| {
            j != k && (m.frequency_hz() - hz).abs() < 2.0 * (width + half_width(m))
        };
        if modes.iter().enumerate().any(close) {
            continue;
        }
        let from = spectrum.frequencies.partition_point(|f| *f < hz - width);
        let to = spectrum.frequencies.partition_point(|f| *f <= hz + width).max(from + 1);
        let lines = from..to.min(second.len());
        let Some(top) = lines.max_by(|a, b| second[*a].total_cmp(&second[*b])) else { continue };
        if second[top] > PAIR_RATIO * first[top]
            && fdd::height_db(&spectrum.frequencies, second, top) > PAIR_DB
        {
            modes[k].notes.push(format!(
                "may be two close modes: a second motion is {:.0} dB below the first at {:.3} Hz",
                10.0 * (first[top] / second[top]).log10(),
                spectrum.frequencies[top]
            ));
        }
    }
}

/// Least height of a peak that a mode must explain \[dB\].
const CLEAR_PEAK_DB: f64 = 10.0;

/// Peaks of the spectrum that are neither a mode nor a harmonic.
fn unexplained_peaks(found: &OperationalModes) -> Vec<SpectralPeak> {
    let step = match found.spectrum.frequencies[..] {
        [a, b, ..] => b - a,
        _ => return Vec::new(),
    };
    let explained = |peak: &SpectralPeak| {
        let near = |m: &OperationalMode| {
            let width = m.damping_ratio() * m.frequency_hz() + 3.0 * m.frequency_error + 2.0 * step;
            (m.frequency_hz() - peak.frequency).abs() < width
        };
        peak.harmonic || found.modes.iter().any(near)
    };
    found.spectrum.peaks.iter().filter(|p| p.height_db > CLEAR_PEAK_DB && !explained(p)).cloned().collect()
}

/// Block rows of the Hankel matrix, and the highest order.
fn sizes(
    data: &Prepared,
    settings: &OperationalSettings,
    channels: usize,
    inputs: usize,
) -> Result<(usize, usize), IdentifyError> {
    let limit = (MAX_ROWS / channels).min(MAX_COLUMNS / inputs).max(4);
    // Two cycles of the lowest frequency over all lags, within the size, and a twentieth of the record.
    let cycles = (2.0 * data.rate / data.band[0].max(1e-9)).min(1e6) as usize;
    let rows = cycles.clamp(20.min(limit), limit).min(data.len() / 40).max(4);
    let possible = ((rows - 1) * channels).min(rows * inputs).saturating_sub(2) & !1;
    match settings.max_order {
        Some(order) if order > possible => Err(IdentifyError::Setting {
            what: "highest order",
            reason: format!("{order} is too high for the record; {possible} or less is possible"),
        }),
        Some(order) => Ok((rows, order & !1)),
        None => Ok((rows, possible.min(60))),
    }
}
