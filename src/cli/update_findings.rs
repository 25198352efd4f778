//! What `update` says of its fit: probability of chi^2, culprits of a misfit, groups of parameters, profiles.

use rotordyn::update::culprits::{self, Culprit, CulpritSearch};
use rotordyn::update::data_kind::KindFit;
use rotordyn::update::goodness::FitQuality;
use rotordyn::update::groups::{self, Combination};
use rotordyn::update::parameter::FreeParameter;
use rotordyn::update::profile::{Profile, profile};
use rotordyn::update::{Findings, Update, UpdateJob};

use super::failure::Failure;
use super::terminal::{Terminal, number};

/// Culprits that are printed.
const SHOWN: usize = 3;

/// Checks that the parameters of `--profile` are free.
pub fn check_profiles(names: &[String], parameters: &[FreeParameter]) -> Result<(), Failure> {
    let free = |name: &String| parameters.iter().any(|p| p.name == *name);
    let unknown: Vec<String> = names
        .iter()
        .filter(|name| !free(name))
        .map(|name| format!("{name} is not in --free; --profile takes the names given to --free"))
        .collect();
    if unknown.is_empty() { Ok(()) } else { Err(Failure::Input(unknown.join("\n"))) }
}

/// Groups, the profiles of the parameters `names`, and culprits if the model does not explain the data.
pub fn findings(
    terminal: &Terminal,
    job: &UpdateJob,
    found: &Update,
    names: &[String],
) -> Result<Findings, Failure> {
    let mut out =
        Findings { groups: groups::groups(&found.identifiability, job.parameters), ..Findings::default() };
    if found.goodness.is_rejected() {
        let bar = terminal.spinner("searching the parameters that explain the misfit");
        let searched = culprits::search(job, found);
        bar.finish_and_clear();
        out.culprits = Some(searched?);
    }
    let bar = terminal.spinner("profiles");
    let chosen = (0..job.parameters.len()).filter(|&j| names.contains(&job.parameters[j].name));
    let profiles: Result<Vec<Profile>, _> = chosen.map(|j| profile(job, found, j)).collect();
    bar.finish_and_clear();
    out.profiles = profiles?;
    Ok(out)
}

/// chi^2 with its probability.
pub fn print_fit(terminal: &Terminal, found: &Update) {
    let goodness = &found.goodness;
    terminal.print(&format!(
        "\nchi^2 = {} with {} degrees of freedom (probability of a larger one {} %), {} iterations{}",
        number(goodness.chi_squared, 3),
        number(goodness.degrees_of_freedom, 3),
        per_cent(goodness.probability()),
        found.iterations.len() - 1,
        if found.converged { "" } else { ", not converged" }
    ));
    if goodness.by_kind.len() > 1 {
        let one = |fit: &KindFit| {
            let [chi_squared, degrees] = [fit.chi_squared, fit.degrees_of_freedom].map(|v| number(v, 3));
            let probability = match fit.is_tested() {
                true => format!("{} %", per_cent(fit.probability())),
                false => "not tested".into(),
            };
            format!("{} {chi_squared} with {degrees} ({probability})", fit.kind.label())
        };
        let kinds: Vec<String> = goodness.by_kind.iter().map(one).collect();
        terminal.print(&format!("  of these, {}", kinds.join(", ")));
    }
    match goodness.quality() {
        FitQuality::DeviationsTooLarge => terminal.print_wrapped(
            "The differences left are smaller than the standard deviations of the data (1 % or less of all fits are that \
             close): the stated accuracies are cautious, and so are the standard errors. State better ones with \
             --frequency-accuracy and --frf-accuracy if they are known.",
        ),
        FitQuality::NotTested => terminal.print_wrapped(
            "There are no more data than parameters: that the model fits says nothing. Fit more modes or points, or free \
             fewer parameters.",
        ),
        FitQuality::Explained | FitQuality::NotExplained => {}
    }
}

/// A probability in per cent.
pub fn per_cent(probability: f64) -> String {
    match probability {
        p if p > 0.999 => "above 99.9".into(),
        p if p < 1e-6 => "below 1e-4".into(),
        p => number(100.0 * p, 2),
    }
}

/// Groups, dependence on fixed values, culprits and profiles.
pub fn print(terminal: &Terminal, parameters: &[FreeParameter], found: &Update, findings: &Findings) {
    group_table(terminal, parameters, findings);
    dependence_table(terminal, parameters, found);
    inseparable_table(terminal, parameters, found);
    if let Some(search) = &findings.culprits {
        culprit_table(terminal, found, search);
    }
    profile_table(terminal, parameters, &findings.profiles);
}

fn group_table(terminal: &Terminal, parameters: &[FreeParameter], findings: &Findings) {
    let mut rows = Vec::new();
    for group in &findings.groups {
        let row = |what: &str, found: &Combination| {
            let terms: Vec<String> = group
                .members
                .iter()
                .zip(&found.weights)
                .map(|(&j, w)| format!("{w:+.2} {}", parameters[j].name))
                .collect();
            vec![what.into(), terms.join(" "), number(100.0 * found.error, 2)]
        };
        rows.push(row("determined", &group.determined));
        rows.push(row("not determined", &group.undetermined));
    }
    if !rows.is_empty() {
        let header = ["combination", "relative changes", "standard error %"];
        terminal.table("Parameters that the data cannot separate", &header, &rows);
    }
}

/// Relative change of a parameter's value in per cent, for a change of its coordinate.
pub fn change_per_cent(parameter: &FreeParameter, from: f64, change: f64) -> f64 {
    100.0 * (parameter.value(from + change) / parameter.value(from) - 1.0)
}

fn dependence_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let rows: Vec<Vec<String>> = found
        .dependences(parameters)
        .map(|(parameter, outcome, dependence)| {
            vec![
                parameter.name.clone(),
                dependence.on.name.clone(),
                format!("{:+.2}", change_per_cent(&dependence.on, dependence.on.mean, dependence.change)),
                number(dependence.gain, 3),
                per_cent(dependence.probability),
                format!("{:+.2}", change_per_cent(parameter, outcome.x, dependence.shift)),
                format!("{:+.1}", dependence.shift / outcome.error),
            ]
        })
        .collect();
    if rows.is_empty() {
        return;
    }
    let header = [
        "value",
        "depends on",
        "its change %",
        "gain in chi^2",
        "by chance %",
        "change of the value %",
        "in standard errors",
    ];
    terminal.table("Values that would change if one parameter more were free (predicted)", &header, &rows);
}

fn inseparable_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let rows: Vec<Vec<String>> = found
        .inseparable(parameters)
        .map(|(parameter, outcome, fixed)| {
            let error = |of: f64| number(change_per_cent(parameter, outcome.x, of).abs(), 2);
            vec![
                parameter.name.clone(),
                fixed.from.name.clone(),
                error(outcome.error),
                error(fixed.error),
                format!("{:+.2}", change_per_cent(parameter, outcome.x, fixed.change_for_one_per_cent())),
            ]
        })
        .collect();
    if rows.is_empty() {
        return;
    }
    let header = [
        "value",
        "fixed value",
        "standard error %",
        "if it were free %",
        "change % for 1 % of the fixed value",
    ];
    terminal.table("Values that the data do not separate from one that is not free", &header, &rows);
}

fn culprit_table(terminal: &Terminal, found: &Update, search: &CulpritSearch) {
    let alone = search.explaining().next().is_some();
    let shown: Vec<&Culprit> = match alone {
        true => search.explaining().take(SHOWN).collect(),
        false => search.culprits.iter().take(SHOWN).collect(),
    };
    let title = match alone {
        true => "Parameters that are not free and would explain the misfit, each alone",
        false => "Parameters that are not free and would reduce the misfit most, each alone",
    };
    let header = ["parameter", "now", "would be", "change %", "gain in chi^2", "chi^2 left", "probability %"];
    let row = |c: &&Culprit| {
        let [from, to] = [c.parameter.mean, c.x].map(|x| c.parameter.value(x));
        let text = |value: f64| format!("{} {}", number(value, 5), c.parameter.unit()).trim_end().to_string();
        vec![
            c.parameter.name.clone(),
            text(from),
            text(to),
            format!("{:+.1}", change_per_cent(&c.parameter, c.parameter.mean, c.x - c.parameter.mean)),
            number(c.gain, 3),
            number(c.goodness.chi_squared, 3),
            per_cent(c.goodness.probability()),
        ]
    };
    if !shown.is_empty() {
        terminal.table(title, &header, &shown.iter().map(row).collect::<Vec<_>>());
    }
    for culprit in shown.iter().filter(|c| !c.alike.is_empty()) {
        terminal.print_wrapped(&format!(
            "The data cannot tell {} from {}.",
            culprit.parameter.name,
            listed(&culprit.alike)
        ));
    }
    if search.together.len() > 1 {
        let explained = search.together.last().is_some_and(|last| !last.goodness.is_rejected());
        let title = if explained {
            "Parameters that would explain the misfit together, each besides those above it"
        } else {
            "Parameters that would reduce the misfit most together, each besides those above it"
        };
        let rows: Vec<&Culprit> = search.together.iter().collect();
        terminal.table(title, &header, &rows.iter().map(row).collect::<Vec<_>>());
    }
    terminal.print_wrapped(&format!(
        "{} parameters that are not free were tried, {} of them change the data; chi^2 is {} without them.",
        search.candidates,
        search.with_influence,
        number(found.goodness.chi_squared, 3)
    ));
}

fn profile_table(terminal: &Terminal, parameters: &[FreeParameter], profiles: &[Profile]) {
    if profiles.is_empty() {
        return;
    }
    let row = |profile: &Profile| {
        let parameter = &parameters[profile.parameter];
        let end = |x: Option<f64>| x.map_or("open".into(), |x| number(parameter.value(x), 5));
        let range = |[low, high]: [Option<f64>; 2]| {
            format!("{} .. {} {}", end(low), end(high), parameter.unit()).trim_end().to_string()
        };
        let best = format!("{} {}", number(parameter.value(profile.best), 5), parameter.unit());
        vec![
            parameter.name.clone(),
            best.trim_end().to_string(),
            range(profile.interval_68),
            range(profile.interval_95),
        ]
    };
    let header = ["parameter", "least chi^2 at", "68 % interval", "95 % interval"];
    let rows: Vec<Vec<String>> = profiles.iter().map(row).collect();
    terminal.table("Profile likelihood (all other parameters fitted again)", &header, &rows);
}

/// "a, b and c".
pub fn listed(names: &[String]) -> String {
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}
