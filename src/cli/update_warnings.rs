//! Warnings of `update`.

use rotordyn::update::culprits::{Culprit, ReleasedBounds};
use rotordyn::update::goodness::MIN_PROBABILITY;
use rotordyn::update::parameter::FreeParameter;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Target, TargetMode};
use rotordyn::update::{Findings, IdentifiabilityClass, Outcome, Update};
use rotordyn::warning::{Code, Warning};

use super::measured;
use super::terminal::{Terminal, number};
use super::update_findings::{change_per_cent, listed, per_cent};

/// Change in standard deviations of the prior above which data and prior are reported as inconsistent.
const PRIOR_SHIFT_LIMIT: f64 = 3.0;
/// Relative frequency difference of a mode pair above which model and data are far apart.
const FAR: f64 = 0.1;
/// Culprits, and pairs of the start, that are named.
const SHOWN: usize = 3;

/// Warns about shapes whose error is larger than what is assumed of all: by noise, and by a doubt of the identification.
pub fn warn_of_uncertain_shapes<'a>(
    terminal: &Terminal,
    fitted: impl Iterator<Item = &'a TargetMode>,
    least: f64,
) {
    let uncertain = fitted.filter(|mode| mode.shape_error > least);
    let (doubtful, noisy): (Vec<_>, Vec<_>) = uncertain.partition(|mode| !mode.quality_warnings.is_empty());
    for (modes, advice) in [
        (noisy, "excite these modes at another point for better shapes"),
        (
            doubtful,
            "more references, a finer resolution or another --band may separate what is mixed in them",
        ),
    ] {
        if !modes.is_empty() {
            terminal.warn(&uncertain_shapes(&modes, least).advise(advice));
        }
    }
}

fn uncertain_shapes(modes: &[&TargetMode], least: f64) -> Warning {
    let all = |of: &dyn Fn(&TargetMode) -> String| modes.iter().map(|mode| of(mode)).collect::<Vec<_>>();
    let hz = all(&|mode| match mode.quality_text() {
        text if text.is_empty() => format!("{:.3} Hz", mode.frequency_hz),
        text => format!("{:.3} Hz ({text})", mode.frequency_hz),
    });
    let errors = all(&|mode| number(mode.shape_error, 2));
    let (shapes, have) = if modes.len() == 1 { ("shape", "has") } else { ("shapes", "have") };
    Warning::new(
        Code::MeasuredData,
        "",
        format!(
            "the {shapes} measured at {} {have} a large standard error and a small weight: standard deviation of \
             sqrt(1 - MAC) {} instead of {}",
            listed(&hz),
            listed(&errors),
            number(least, 2)
        ),
    )
}

/// Warnings of the fit: a model that does not explain the data, correlated parameters, active bounds, no convergence.
pub fn warn(
    terminal: &Terminal,
    parameters: &[FreeParameter],
    target: &Target,
    found: &Update,
    findings: &Findings,
) {
    if let Some(scale) = &findings.frf_scale {
        terminal.warn(&measured::scale_warning(scale));
    }
    if found.goodness.is_rejected() {
        terminal.warn(&lack_of_fit(parameters, target, found, findings));
    }
    for group in &findings.groups {
        let names: Vec<String> = group.members.iter().map(|&j| parameters[j].name.clone()).collect();
        terminal.warn_of(
            Code::ModelUpdate,
            format!(
                "the data do not separate {}: one combination of them is known to {} %, another only to {} %; free one of \
                 them alone, or link them with +",
                listed(&names),
                number(100.0 * group.determined.error, 2),
                number(100.0 * group.undetermined.error, 2)
            ),
        );
    }
    for warning in dependence_warnings(parameters, found) {
        terminal.warn(&warning);
    }
    for (parameter, outcome) in parameters.iter().zip(&found.outcomes) {
        if outcome.class == IdentifiabilityClass::AtBound {
            terminal.warn_of(
                Code::ModelUpdate,
                format!(
                    "{} is at its bound: the bound may exclude the right value, or it compensates another model error",
                    parameter.name
                ),
            );
        }
        if let Some(text) = prior_shift(parameter, outcome) {
            terminal.warn_of(Code::ModelUpdate, text);
        }
    }
    if !found.converged {
        terminal.warn_of(
            Code::ModelUpdate,
            "the update did not converge: increase --iterations, or reduce the number of free parameters",
        );
    }
}

/// What is said of a fitted value that is far from the prior's mean.
fn prior_shift(parameter: &FreeParameter, outcome: &Outcome) -> Option<String> {
    let shift = ((outcome.fitted - parameter.mean) / parameter.deviation).abs();
    if shift <= PRIOR_SHIFT_LIMIT {
        return None;
    }
    let away = format!("{} prior standard deviations away from the prior mean", number(shift, 2));
    let name = &parameter.name;
    Some(if outcome.is_reset() {
        let value = format!("{} {}", number(parameter.value(outcome.fitted), 5), parameter.unit());
        format!(
            "{name}: the fit went to {}, {away}, where the data do not determine it; the start value was kept",
            value.trim_end()
        )
    } else {
        format!("{name}: the fitted value is {away}; data and prior are inconsistent")
    })
}

/// Measured modes that are far from the model, as text: a pair that differs by more than 10 % in frequency, and with such
/// pairs also modes without one. Empty if no pair differs so much.
fn distant_modes(target: &Target, state: &ModelState) -> Vec<String> {
    let mut far = Vec::new();
    let mut any = false;
    for (k, measured) in target.modes.iter().enumerate() {
        let hz = measured.frequency_hz;
        let Some((mode, _)) = state.paired_mode(k) else {
            far.push(format!("{hz:.3} Hz with none"));
            continue;
        };
        let off = mode.frequency_hz() / hz - 1.0;
        if off.abs() > FAR {
            any = true;
            far.push(format!("{hz:.3} Hz with {:.3} Hz ({:+.1} %)", mode.frequency_hz(), 100.0 * off));
        }
    }
    if any { far } else { Vec::new() }
}

/// One warning for every fixed parameter that values depend on.
fn dependence_warnings(parameters: &[FreeParameter], found: &Update) -> Vec<Warning> {
    let mut names: Vec<&str> = Vec::new();
    for (_, _, dependence) in found.dependences(parameters) {
        if !names.contains(&dependence.on.name.as_str()) {
            names.push(&dependence.on.name);
        }
    }
    let one = |name: &&str| {
        let own: Vec<_> = found.dependences(parameters).filter(|(_, _, d)| d.on.name == *name).collect();
        let values: Vec<String> = own
            .iter()
            .map(|(p, o, d)| {
                let errors = number((d.shift / o.error).abs(), 2);
                let change = change_per_cent(p, o.x, d.shift);
                format!("{} by {change:+.1} % ({errors} standard errors)", p.name)
            })
            .collect();
        let dependence = own[0].2;
        let text = format!(
            "{name} is not free, but the data would change it by {:+.1} % (chi^2 falls by {}; by chance in {} %) and with \
             it {}",
            change_per_cent(&dependence.on, dependence.on.mean, dependence.change),
            number(dependence.gain, 3),
            per_cent(dependence.probability),
            listed(&values)
        );
        Warning::new(Code::ModelUpdate, "", text)
            .advise(format!("free {name} too, or make sure of its value by another measurement"))
    };
    names.iter().map(one).collect()
}

/// The warning of a model that does not explain the data.
fn lack_of_fit(
    parameters: &[FreeParameter],
    target: &Target,
    found: &Update,
    findings: &Findings,
) -> Warning {
    let goodness = &found.goodness;
    let all = (
        "data",
        [goodness.chi_squared, goodness.degrees_of_freedom],
        [goodness.probability(), MIN_PROBABILITY],
    );
    let (data, [chi_squared, degrees], [probability, limit]) = match goodness.misfit_kind() {
        Some(fit) if goodness.probability() >= MIN_PROBABILITY => (
            fit.kind.label(),
            [fit.chi_squared, fit.degrees_of_freedom],
            [fit.probability(), goodness.min_kind_probability()],
        ),
        _ => all,
    };
    let text = format!(
        "the updated model does not explain the {data}: chi^2 = {} with {} degrees of freedom has a probability of {} % \
         (at least {} % expected); no parameter is identified, and the standard errors do not cover the error of the model",
        number(chi_squared, 3),
        number(degrees, 3),
        per_cent(probability),
        number(100.0 * limit, 2)
    );
    Warning::new(Code::LackOfFit, "", text).advise(advice(parameters, target, found, findings))
}

/// What to do about a misfit: the likeliest cause first.
fn advice(parameters: &[FreeParameter], target: &Target, found: &Update, findings: &Findings) -> String {
    let search = findings.culprits.as_ref();
    let released = search.and_then(|search| search.released.as_ref());
    if findings.frf_scale.is_some() {
        return "mend the scale of the FRFs first".into();
    }
    if let Some(released) = released.filter(|released| !released.goodness.is_rejected()) {
        return format!("{}, which explains it", widened(parameters, released));
    }
    let explaining: Vec<String> =
        search.iter().flat_map(|search| search.explaining().take(SHOWN)).map(changed).collect();
    let or = explaining.join(" or ");
    let mut far = distant_modes(target, &found.before);
    // A fit that has come near the data does not suffer from its start.
    if !far.is_empty() && !distant_modes(target, &found.after).is_empty() {
        let more = if far.len() > SHOWN { ", ..." } else { "" };
        far.truncate(SHOWN);
        let names: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
        let besides = match explaining.is_empty() {
            true => "only then look for other causes".into(),
            false => format!("or free {or} besides, which would explain it"),
        };
        return format!(
            "the start is far from the data, so that modes may be paired wrongly (before the update {}{more}): start {} nearer \
             to the data (--set), {besides}",
            far.join(", "),
            listed(&names)
        );
    }
    let first = released.map(|released| {
        format!("{} (chi^2 falls by {}), or ", widened(parameters, released), number(released.gain, 3))
    });
    let first = first.unwrap_or_default();
    if explaining.is_empty() {
        return format!(
            "{first}no single parameter of the model explains it: check the mode pairs, the points, directions, signs and units \
             of the mapping, and what the model leaves out"
        );
    }
    format!("{first}free {or} besides, which would explain it, or check the mode pairs and the mapping")
}

/// "disc.d1.mass (+3.0 %)".
fn changed(culprit: &Culprit) -> String {
    let parameter = &culprit.parameter;
    let change = change_per_cent(parameter, parameter.mean, culprit.x - parameter.mean);
    format!("{} ({change:+.1} %)", parameter.name)
}

/// "widen the bounds of bearing.B.k_xx, which becomes 1.2000e7 N/m without them".
fn widened(parameters: &[FreeParameter], released: &ReleasedBounds) -> String {
    let all = |of: &dyn Fn(usize) -> String| released.parameters.iter().map(|&j| of(j)).collect::<Vec<_>>();
    let names = all(&|j| parameters[j].name.clone());
    let values = all(&|j| {
        let value = format!("{} {}", number(parameters[j].value(released.x[j]), 5), parameters[j].unit());
        value.trim_end().to_string()
    });
    let verb = if names.len() == 1 { "becomes" } else { "become" };
    format!("widen the bounds of {}, which {verb} {} without them", listed(&names), listed(&values))
}
