//! Profile likelihood of the parameters of a model update, with the limits of the 68 % and 95 % intervals.

use super::Named;
use super::display_unit::typographic_unit;
use crate::{Curve, Figure, Lines};
use rotordyn_update::Update;
use rotordyn_update::parameter::FreeParameter;
use rotordyn_update::profile::{DELTA_68, DELTA_95, Profile};

/// Largest increase of χ² that is drawn.
const TOP: f64 = 8.0;
/// Points of the parabola of the standard error.
const PARABOLA_POINTS: usize = 81;

/// One figure per profile.
pub fn figures(
    title: &str,
    found: &Update,
    parameters: &[FreeParameter],
    profiles: &[Profile],
) -> Vec<Named> {
    profiles.iter().map(|profile| figure(title, found, &parameters[profile.parameter], profile)).collect()
}

fn figure(title: &str, found: &Update, parameter: &FreeParameter, profile: &Profile) -> Named {
    let rise = |chi_squared: f64| (chi_squared - profile.least) / profile.scale;
    let inside: Vec<usize> = (0..profile.x.len()).filter(|&k| rise(profile.chi_squared[k]) <= TOP).collect();
    let x: Vec<f64> = inside.iter().map(|&k| parameter.value(profile.x[k])).collect();
    let y: Vec<f64> = inside.iter().map(|&k| rise(profile.chi_squared[k])).collect();
    let ends = [x.first(), x.last()].map(|end| end.copied().unwrap_or(f64::NAN));
    let level = |label: &str, delta: f64| Curve {
        label: label.into(),
        x: ends.to_vec(),
        y: vec![delta; 2],
        points: false,
    };
    let profile_curve = Curve { label: "other parameters fitted again".into(), x, y, points: false };
    let curves = vec![
        profile_curve,
        parabola(found, parameter, profile),
        level("68 %", DELTA_68),
        level("95 %", DELTA_95),
    ];
    let interval = match profile.interval_95.map(|end| end.map(|x| parameter.value(x))) {
        [Some(low), Some(high)] => format!("95 % interval {} to {}", short(low), short(high)),
        [Some(low), None] => format!("95 % interval from {}, open above", short(low)),
        [None, Some(high)] => format!("95 % interval to {}, open below", short(high)),
        [None, None] => "95 % interval open on both sides".into(),
    };
    let unit = typographic_unit(parameter.unit());
    let figure = Lines {
        title: format!("Profile likelihood of {}", parameter.name),
        note: format!("{title}; {}", format!("{interval} {unit}").trim_end()),
        x_name: parameter.name.clone(),
        x_unit: unit,
        y_name: "increase of χ²".into(),
        y_unit: String::new(),
        curves,
        x_range: Some(ends),
        from_zero: true,
        ..Lines::default()
    };
    (format!("update_profile_{}", parameter.name), Figure::Lines(figure))
}

fn short(value: f64) -> String {
    rotordyn_core::document::number(value, 4)
}

/// ((x − x̂)/error)², as the standard error has it, over the range of the profile.
fn parabola(found: &Update, parameter: &FreeParameter, profile: &Profile) -> Curve {
    let error = found.outcomes[profile.parameter].error;
    let (first, last) = (profile.x.first(), profile.x.last());
    let (from, to) = (first.copied().unwrap_or(0.0), last.copied().unwrap_or(0.0));
    let points = (0..PARABOLA_POINTS).map(|k| from + (to - from) * k as f64 / (PARABOLA_POINTS - 1) as f64);
    let rise = |x: f64| ((x - profile.best) / error).powi(2);
    let (x, y) = points.filter(|x| rise(*x) <= TOP).map(|x| (parameter.value(x), rise(x))).unzip();
    Curve { label: "by the standard error".into(), x, y, points: false }
}
