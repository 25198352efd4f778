//! Comparison of unbalance responses over cases of a machine.

use super::case_comparison::near;
use crate::analysis::peaks::{Peak, peaks};
use crate::model::Probe;
use crate::results::{
    CaseUnbalance, ComparedUnbalance, UnbalanceComparison, UnbalancePeak, UnbalancePoint, UnbalanceResult,
};
use std::f64::consts::TAU;

/// Synchronous responses of cases at the probes that two or more of them have.
pub fn compare_unbalance(cases: &[(&str, &UnbalanceResult)]) -> UnbalanceComparison {
    let mut probes: Vec<&Probe> = Vec::new();
    for probe in cases.iter().flat_map(|(_, found)| found.channels.iter().map(|c| &c.probe)) {
        if probes.iter().all(|known| known.name != probe.name) {
            probes.push(probe);
        }
    }
    let mut out = UnbalanceComparison::default();
    for probe in probes {
        let mut unit = "";
        let mut curves = Vec::new();
        for (name, found) in cases {
            let Some(channel) = found.channels.iter().find(|c| c.probe.name == probe.name) else { continue };
            let other = &channel.probe;
            let same = near(&other.at.offset, &probe.at.offset) && near(&other.direction, &probe.direction);
            if !same || other.quantity != probe.quantity {
                let why = "its point, direction or quantity is not that of the first case with it";
                out.left_out.push(format!("{} of {name}: {why}", probe.name));
                continue;
            }
            unit = channel.unit();
            curves.extend(curve(name, found, &channel.amplitude));
        }
        if curves.len() > 1 {
            out.probes.push(ComparedUnbalance { probe: probe.name.clone(), unit: unit.into(), curves });
        }
    }
    out
}

/// `None` if the unbalance does not move the probe.
fn curve(case: &str, found: &UnbalanceResult, amplitude: &[[f64; 2]]) -> Option<CaseUnbalance> {
    // An undamped peak is infinite: no point of the curve.
    let points: Vec<UnbalancePoint> = found
        .speeds
        .iter()
        .zip(amplitude)
        .filter(|(_, [re, _])| re.is_finite())
        .map(|(speed, [re, im])| UnbalancePoint {
            rpm: speed * 60.0 / TAU,
            amplitude: re.hypot(*im),
            phase_deg: im.atan2(*re).to_degrees(),
        })
        .collect();
    let largest = points.iter().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))?;
    if largest.amplitude == 0.0 {
        return None;
    }
    let rpm: Vec<f64> = points.iter().map(|p| p.rpm).collect();
    let sizes: Vec<f64> = points.iter().map(|p| p.amplitude).collect();
    let peak =
        |p: Peak| UnbalancePeak { rpm: p.at, amplitude: p.amplitude, amplification: p.amplification() };
    Some(CaseUnbalance {
        case: case.into(),
        largest: [largest.rpm, largest.amplitude],
        peaks: peaks(&rpm, &sizes).into_iter().map(peak).collect(),
        points,
    })
}
