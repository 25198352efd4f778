//! Modes in one band of a record: harmonics subtracted, subspace identification, selection, spectrum.

use super::correlation::{correlations, hankel, independent_channels};
use super::prepare::Prepared;
use super::result::{Harmonic, OperationalMode, OperationalModes, SpectralDecomposition};
use super::selection::{Search, select};
use super::settings::{OperationalSettings, OutputRecord, Shaft};
use super::subspace::Subspace;
use super::{fdd, lines, orders};
use crate::{IdentifyError, stabilisation};

/// Most reference channels that are chosen.
const MAX_REFERENCES: usize = 6;
/// Largest size of the Hankel matrix, rows and columns.
const MAX_ROWS: usize = 600;
const MAX_COLUMNS: usize = 200;
/// Blocks of the standard errors.
const MOST_BLOCKS: usize = 100;
const FEWEST_BLOCKS: usize = 10;

/// Modes of one band.
///
/// # Errors
/// As [`identify_operational`](super::identify_operational), but none without a mode.
pub(super) fn identify_band(
    record: &OutputRecord,
    settings: &OperationalSettings,
) -> Result<OperationalModes, IdentifyError> {
    let unless_stopped = || IdentifyError::if_stopped(&settings.stop);
    let whole = Prepared::new(record, settings)?;
    let first = without_harmonics(whole.clone(), settings);
    // The harmonics are fitted again without a transient at the start, whose remains would look like some.
    let start = first.data.transient();
    let left_out = start as f64 / first.data.rate;
    let RandomPart { data, shaft_speed, speeds, mut harmonics } = match start {
        0 => first,
        start => without_harmonics(whole.without_start(start), settings),
    };
    unless_stopped()?;
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
    unless_stopped()?;
    let correlations = correlations(&data, &references, lags, blocks);
    unless_stopped()?;
    let space = Subspace::new(&hankel(&correlations.mean, rows), channels, inputs, data.rate)?;
    let highest = highest.min(space.s.len().saturating_sub(1) & !1);
    let orders: Vec<usize> = (1..=highest / 2).map(|k| 2 * k).collect();
    let candidates = space.candidates(&orders, data.band, settings.largest_damping)?;
    unless_stopped()?;
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
    unless_stopped()?;
    let channels_of_spectrum = independent_channels(&data, fdd::MAX_CHANNELS);
    let spectrum = fdd::decomposition(&data, &channels_of_spectrum, &harmonics)?;
    note_possible_pairs(&spectrum, &mut found.modes);
    found.warnings.extend(impulsive);
    found.warnings.extend(speed_warning(speeds));
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

/// What is left of a record without its harmonics.
struct RandomPart {
    data: Prepared,
    /// \[rev/s\].
    shaft_speed: Option<f64>,
    /// Speeds below and above which the shaft is for a tenth of the record each \[rev/s\].
    speeds: Option<[f64; 2]>,
    harmonics: Vec<Harmonic>,
}

/// Rounds of subtraction: a strong line hides weak ones near it.
const ROUNDS: usize = 3;

/// Subtracts the orders of the shaft, if its motion is known, and sines of constant frequency.
fn without_harmonics(mut data: Prepared, settings: &OperationalSettings) -> RandomPart {
    let (mut shaft_speed, mut speeds, mut harmonics) = (None, None, Vec::new());
    if let Some((theta, speed)) = orders::shaft_angle(&data, &settings.shaft, settings.speed_tolerance) {
        let other = match settings.shaft {
            Shaft::Steady(_) => orders::refined_orders(&data, speed, &settings.orders),
            _ => settings.orders.clone(),
        };
        harmonics = orders::subtract(&mut data, &theta, speed, &other);
        shaft_speed = Some(speed);
        speeds = Some(orders::usual_speeds(&data, &theta));
    }
    for _ in 0..ROUNDS {
        let lines = lines::constant_sines(&data);
        if lines.is_empty() {
            break;
        }
        harmonics.extend(orders::subtract_sines(&mut data, lines));
    }
    RandomPart { data, shaft_speed, speeds, harmonics }
}

/// Difference of the usual speeds over the larger one from which modes are told to be means.
const SPEED_SPREAD: f64 = 0.05;

/// Warning of a record over a range of speeds.
fn speed_warning(speeds: Option<[f64; 2]>) -> Option<String> {
    let [low, high] = speeds.filter(|[low, high]| high - low > SPEED_SPREAD * high)?;
    Some(format!(
        "the shaft runs from {:.0} to {:.0} rpm in this record: modes that depend on the speed (gyroscopic moments, bearings) are \
         means over it, with too much damping; cut out a part at one speed",
        60.0 * low,
        60.0 * high
    ))
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
