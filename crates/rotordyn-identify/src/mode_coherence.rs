//! Coherence at the resonances: low where leakage or noise spoils what the modes are read from.

use rotordyn_signal::record::FrfMatrix;

use super::ModalIdentification;

/// Coherence γ² at a resonance below which its damping and amplitude are doubtful.
const LOW: f64 = 0.7;

/// What is said of modes at whose frequencies the coherence is low; `None` without any, or without coherence.
///
/// Mean of γ² over the FRFs at the line nearest to the mode, weighted by |H|²: FRFs that hardly hold the mode say nothing of it.
/// A resonance narrower than a line leaks: its damping is too high and its peak too low, in all FRFs alike.
pub fn low_coherence(frfs: &FrfMatrix, found: &ModalIdentification) -> Option<String> {
    let coherence = frfs.coherence.as_ref()?;
    let at = |hz: f64| {
        let nearest = |a: &usize, b: &usize| {
            (frfs.frequencies[*a] - hz).abs().total_cmp(&(frfs.frequencies[*b] - hz).abs())
        };
        let k = (0..frfs.frequencies.len()).min_by(nearest)?;
        let pairs = frfs.values.iter().flatten().zip(coherence.iter().flatten());
        let (sum, weights) = pairs.fold((0.0, 0.0), |(sum, weights), (h, own)| {
            let weight = h[k].norm_sqr();
            (sum + weight * own[k], weights + weight)
        });
        (weights > 0.0).then(|| sum / weights)
    };
    let low: Vec<(f64, f64)> = found
        .modes
        .iter()
        .filter_map(|mode| Some((mode.frequency_hz(), at(mode.frequency_hz())?)))
        .filter(|(_, own)| *own < LOW)
        .collect();
    if low.is_empty() {
        return None;
    }
    let names: Vec<String> = low.iter().map(|(hz, own)| format!("{own:.2} at {hz:.2} Hz")).collect();
    Some(format!(
        "the coherence at resonances is low ({}): noise, or leakage of resonances narrower than a line, whose damping is too high; \
         measure longer blocks, with a burst or hits that decay within them",
        names.join(", ")
    ))
}
