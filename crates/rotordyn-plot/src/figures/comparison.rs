//! FRFs, unbalance responses and Campbell diagrams of cases of a machine on common axes, with measured FRFs.

use super::display_unit::{quantity, typographic_unit, unit};
use super::{Named, TO_RPM, campbell};
use crate::{Bode, BodeCurve, Curve, Figure, Frf, FrfCurve, Lines};
use rotordyn_core::analysis::Mode;
use rotordyn_core::results::{
    CampbellResult, CaseFrf, CaseUnbalance, ComparedFrf, ComparedUnbalance, FrfComparison,
    UnbalanceComparison,
};

/// What of the cases is drawn; `note` stands below the titles.
#[derive(Clone, Copy)]
pub struct LinearComparison<'a> {
    pub note: &'a str,
    pub frfs: Option<&'a FrfComparison>,
    pub unbalance: Option<&'a UnbalanceComparison>,
    /// By the names of the cases.
    pub campbell: &'a [(&'a str, &'a CampbellResult)],
}

pub fn figures(compared: LinearComparison) -> Vec<Named> {
    let note = compared.note;
    let frfs =
        compared.frfs.iter().flat_map(|found| found.pairs.iter().map(move |pair| frf(found, pair, note)));
    let unbalance =
        compared.unbalance.iter().flat_map(|found| found.probes.iter().map(move |p| bode(p, note)));
    frfs.chain(unbalance).chain(diagrams(compared.campbell, note)).collect()
}

/// One response to one excitation.
fn frf(found: &FrfComparison, pair: &ComparedFrf, note: &str) -> Named {
    let curve = |c: &CaseFrf| FrfCurve {
        label: c.case.clone(),
        hz: c.points.iter().map(|p| p.hz).collect(),
        re: c.points.iter().map(|p| p.value.re).collect(),
        im: c.points.iter().map(|p| p.value.im).collect(),
        coherence: c.points.iter().filter_map(|p| p.coherence).collect(),
    };
    let figure = Frf {
        title: format!("FRF: response {}, force at {}", pair.response, pair.excitation),
        note: note.into(),
        quantity: found.quantity.clone(),
        unit: typographic_unit(&pair.unit),
        curves: pair.curves.iter().map(curve).collect(),
        apart: false,
    };
    (format!("comparison_frf_{}_{}", pair.excitation, pair.response), Figure::Frf(figure))
}

/// The synchronous response of one probe.
fn bode(probe: &ComparedUnbalance, note: &str) -> Named {
    let shown = unit(&probe.unit);
    let curve = |c: &CaseUnbalance| BodeCurve {
        label: c.case.clone(),
        rpm: c.points.iter().map(|p| p.rpm).collect(),
        amplitude: c.points.iter().map(|p| p.amplitude * shown.factor).collect(),
        phase_deg: c.points.iter().map(|p| p.phase_deg).collect(),
    };
    let figure = Bode {
        title: format!("Unbalance response, {}", probe.probe),
        note: note.into(),
        quantity: format!("{}, 0–peak", quantity(&probe.unit)),
        unit: shown.name.into(),
        curves: probe.curves.iter().map(curve).collect(),
        log: true,
        criticals: Vec::new(),
    };
    (format!("comparison_unbalance_{}", probe.probe), Figure::Bode(figure))
}

/// Mode branches of all cases, one line style per case.
fn diagrams(cases: &[(&str, &CampbellResult)], note: &str) -> Option<Named> {
    let top =
        cases.iter().map(|(_, c)| campbell::max_frequency(&campbell::branches(c), c)).fold(0.0, f64::max);
    let mut curves = Vec::new();
    for (name, found) in cases {
        let mut curve = Curve { label: (*name).into(), ..Curve::default() };
        for branch in &found.diagram.branches {
            for (speed, mode) in found.diagram.speeds.iter().zip(&branch.modes) {
                curve.x.push(speed * TO_RPM);
                let hz = mode.as_ref().map(Mode::frequency_hz).filter(|hz| *hz <= top);
                curve.y.push(hz.unwrap_or(f64::NAN));
            }
            // NaN separates the branches.
            curve.x.push(f64::NAN);
            curve.y.push(f64::NAN);
        }
        curves.push(curve);
    }
    let figure = Lines {
        title: "Campbell diagrams".into(),
        note: note.into(),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        y_name: "natural frequency".into(),
        y_unit: "Hz".into(),
        from_zero: true,
        curves,
        ..Lines::default()
    };
    (figure.curves.len() > 1).then(|| ("comparison_campbell".into(), Figure::Lines(figure)))
}
