//! Settings of the steady-speed studies (`poincare`, `lyapunov`, `bifurcation`) from their flags.

use rotordyn::model::Model;

use super::args::keys::{default, default_words};
use super::args::{BifurcationArgs, PoincareArgs, SteadyArgs};
use super::settings::{Settings, SettingsBuilder, toml_array, toml_string, top_speed, written};

fn common(draft: &mut SettingsBuilder, args: &SteadyArgs) {
    draft.set_flag("speed", args.speed.as_ref().map(|text| toml_string(text)));
    draft.set_flag("section", args.section.as_ref().map(|text| toml_string(text)));
    draft.set_flag("bearing", args.bearing.as_ref().map(|text| toml_string(text)));
    draft.set_flag("phase", args.phase.as_ref().map(|text| toml_string(text)));
    draft.set_flag("transient_periods", args.transient_periods.map(|n| n.to_string()));
    draft.set_flag("transient_limit", args.transient_limit.map(|n| n.to_string()));
    draft.set_flag("periods", args.periods.map(|n| n.to_string()));
    draft.set_flag("step", args.step.as_ref().map(|text| toml_string(text)));
    draft.set_flag("integrator", args.integrator.as_ref().map(|text| toml_string(text)));
}

/// Note on the defaults used if the file lacks the study.
fn default_note(model: &Model, study: &str) -> String {
    let [transient_periods, periods] =
        ["transient_periods", "periods"].map(|key| default_words(&format!("study.{study}.{key}")));
    let speed = match top_speed(model) {
        Some(top) => format!("{top} rpm, "),
        None => String::new(),
    };
    format!("{speed}{transient_periods} shaft revolutions discarded, {periods} recorded")
}

pub fn poincare(model: &Model, args: &PoincareArgs) -> Settings {
    let mut draft = SettingsBuilder::new("poincare");
    common(&mut draft, &args.steady);
    draft.set_as_written("planes", toml_array(&args.plane), written("--plane", &args.plane));
    let missing = model.studies.poincare.is_none();
    draft.defaults(
        missing,
        &default_note(model, "poincare"),
        &[("section", default("study.poincare.section"))],
    )
}

pub fn lyapunov(model: &Model, args: &SteadyArgs) -> Settings {
    let mut draft = SettingsBuilder::new("lyapunov");
    common(&mut draft, args);
    let missing = model.studies.lyapunov.is_none();
    draft.defaults(
        missing,
        &default_note(model, "lyapunov"),
        &[("section", default("study.lyapunov.section"))],
    )
}

pub fn bifurcation(model: &Model, args: &BifurcationArgs) -> Settings {
    let missing = model.studies.bifurcation.is_none();
    let mut draft = SettingsBuilder::new("bifurcation");
    common(&mut draft, &args.steady);
    draft.set_flag("parameter", toml_array(&args.parameter));
    let ends = [
        ("from", args.from.as_ref().map(|text| toml_string(text))),
        ("to", args.to.as_ref().map(|text| toml_string(text))),
    ];
    let values = ends.into_iter().chain([("count", args.count.map(|n| n.to_string()))]);
    let given: Vec<(&str, String)> = values.filter_map(|(key, value)| Some((key, value?))).collect();
    // A different parameter replaces all values; otherwise a flag replaces a single entry of the file.
    if missing || !args.parameter.is_empty() {
        let table: Vec<String> = given.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        let values = (!given.is_empty()).then(|| format!("{{ {} }}", table.join(", ")));
        let flags: Vec<String> = given.iter().map(|(key, value)| format!("--{key} {value}")).collect();
        draft.set_as_written("values", values, (!given.is_empty()).then(|| flags.join(" ")));
    } else {
        for (key, value) in given {
            let written = format!("--{key} {value}");
            draft.set_as_written(&format!("values.{key}"), Some(value), Some(written));
        }
    }
    draft.set_flag("sweep", args.sweep.as_ref().map(|text| toml_string(text)));
    draft.set_flag("start", args.start.as_ref().map(|text| toml_string(text)));
    draft.set_flag("channels", toml_array(&args.channels));
    draft.set_flag("lyapunov", args.lyapunov.then(|| "true".into()));
    draft.defaults(
        missing,
        &default_note(model, "bifurcation"),
        &[("section", default("study.bifurcation.section"))],
    )
}
