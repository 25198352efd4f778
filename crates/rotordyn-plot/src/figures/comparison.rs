//! FRFs and Campbell diagrams of model variants on common axes.

use super::display_unit::typographic_unit;
use super::response::frf_curve;
use super::{Named, TO_RPM, campbell};
use crate::{Curve, Figure, Frf, Lines};
use rotordyn_core::analysis::Mode;
use rotordyn_core::results::FrfResult;
use rotordyn_core::study::Results;

pub fn figures(variants: &[(String, &Results)]) -> Vec<Named> {
    let mut figures = frfs(variants);
    figures.extend(campbell(variants));
    figures
}

/// One figure for every excitation and response present in at least two variants.
fn frfs(variants: &[(String, &Results)]) -> Vec<Named> {
    let with: Vec<(&str, &FrfResult)> =
        variants.iter().filter_map(|(name, r)| Some((name.as_str(), r.frf.as_ref()?))).collect();
    let mut ends: Vec<(&String, &String)> = Vec::new();
    for (_, found) in &with {
        for end in found.excitations.iter().flat_map(|e| found.responses.iter().map(move |r| (e, r))) {
            if !ends.contains(&end) {
                ends.push(end);
            }
        }
    }
    let mut figures = Vec::new();
    for (excitation, response) in ends {
        let mut unit = "";
        let mut name = "";
        let mut curves = Vec::new();
        for (variant, found) in &with {
            let e = found.excitations.iter().position(|n| n == excitation);
            let r = found.responses.iter().position(|n| n == response);
            if let (Some(e), Some(r)) = (e, r)
                && found.is_coupled(r, e)
            {
                (unit, name) = (&found.units[r][e], found.name());
                curves.push(frf_curve(found, r, e, variant));
            }
        }
        if curves.len() > 1 {
            let figure = Frf {
                title: format!("FRF: response {response}, force at {excitation}"),
                note: "by variant".into(),
                quantity: name.into(),
                unit: typographic_unit(unit),
                curves,
            };
            figures.push((format!("comparison_frf_{excitation}_{response}"), Figure::Frf(figure)));
        }
    }
    figures
}

/// Mode branches of all variants, one line style per variant.
fn campbell(variants: &[(String, &Results)]) -> Option<Named> {
    let found = || variants.iter().filter_map(|(name, results)| Some((name, results.campbell.as_ref()?)));
    let top = found().map(|(_, c)| campbell::max_frequency(&campbell::branches(c), c)).fold(0.0, f64::max);
    let mut curves = Vec::new();
    for (name, found) in found() {
        let mut curve = Curve { label: name.clone(), ..Curve::default() };
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
        note: "by variant".into(),
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
