//! Free parameters of `update` from `--free`, `--bounds` and `--prior`.

use rotordyn::model::parameter_paths::{all_values, resolve_parameter_path};
use rotordyn::model::renamed_path;
use rotordyn::units::leading_number;
use rotordyn::update::parameter::{self, FreeParameter, ModelNumber};

use super::args::UpdateArgs;
use super::failure::Failure;
use super::machine::ModelSource;
use super::terminal::Terminal;

/// The free parameters, or all errors of the three flags at once.
pub fn parameters(
    args: &UpdateArgs,
    origin: &ModelSource,
    terminal: &Terminal,
) -> Result<Vec<FreeParameter>, Failure> {
    for path in args.free.iter().flat_map(|name| name.split('+')).map(str::trim) {
        if let Some(present) = renamed_path(path) {
            terminal.note(&format!("--free: `{path}` is now `{present}`; the old spelling still works"));
        }
    }
    let mut problems = Vec::new();
    let mut out: Vec<FreeParameter> = Vec::new();
    for name in &args.free {
        match parse_parameter(name, args, origin) {
            Ok(parameter) => out.push(parameter),
            Err(problem) => problems.push(problem),
        }
    }
    for (i, parameter) in out.iter().enumerate() {
        for place in &parameter.numbers {
            let twice = out[..i].iter().any(|p| p.numbers.iter().any(|other| other.path == place.path));
            if twice {
                problems.push(format!("{} is listed twice in --free; list it once", place.path));
            }
        }
    }
    let known = |name: &str| args.free.iter().any(|free| free == name);
    for (name, _) in args.bounds.iter().chain(&args.prior).filter(|(name, _)| !known(name)) {
        problems
            .push(format!("{name} is not in --free; --bounds and --prior take the names given to --free"));
    }
    if problems.is_empty() { Ok(out) } else { Err(Failure::Input(problems.join("\n"))) }
}

/// Numbers of the model file that are not free but could be.
pub fn candidates(free: &[FreeParameter], origin: &ModelSource) -> Result<Vec<FreeParameter>, Failure> {
    let values = all_values(&origin.text, &origin.options).map_err(Failure::Input)?;
    let numbers: Vec<ModelNumber> =
        values.iter().filter_map(|v| ModelNumber::read(&v.path, &v.text, v.quoted)).collect();
    Ok(parameter::candidates(&numbers, free))
}

fn parse_parameter(name: &str, args: &UpdateArgs, origin: &ModelSource) -> Result<FreeParameter, String> {
    let mut places: Vec<ModelNumber> = Vec::new();
    for path in name.split('+') {
        for found in resolve_parameter_path(&origin.text, &origin.options, path.trim())? {
            let place = ModelNumber::read(&found.path, &found.text, found.quoted);
            // A designation such as "6205" is a name, not a number.
            let place = place.filter(|place| !(place.quoted && place.unit.is_empty()));
            places.push(place.ok_or_else(|| {
                format!("{}: \"{}\" is not a single number with its unit", found.path, found.text)
            })?);
        }
    }
    let Some(first) = places.first().cloned() else {
        return Err(format!("{name} matches no value of the file"));
    };
    if let Some(other) = places.iter().find(|p| p.unit != first.unit) {
        return Err(format!(
            "{name}: {} is in {} and {} in {}; write them in the same unit to link them",
            first.path, first.unit, other.path, other.unit
        ));
    }
    let of = |list: &[(String, String)]| list.iter().find(|(n, _)| n == name).map(|(_, text)| text.clone());
    let quantity = |text: &str, what: &str| -> Result<f64, String> {
        let text = text.trim();
        let (value, length) =
            leading_number(text).ok_or_else(|| format!("{what} of {name}: \"{text}\" is not a number"))?;
        let unit = text[length..].trim();
        match unit == first.unit {
            true => Ok(value),
            false => Err(format!(
                "{what} of {name}: \"{text}\" is not in the unit of the file; expected unit: {}",
                if first.unit.is_empty() { "none" } else { &first.unit }
            )),
        }
    };
    let bounds = match of(&args.bounds) {
        Some(text) => {
            let (low, high) = text.split_once("..").ok_or_else(|| {
                format!("bounds of {name}: \"{text}\" is not a range; write \"1e6 N/m .. 1e8 N/m\"")
            })?;
            // A unit after the second number applies to both.
            let low = low.trim();
            let low =
                if low.parse::<f64>().is_ok() { format!("{low} {}", first.unit) } else { low.to_string() };
            Some([quantity(&low, "bounds")?, quantity(high, "bounds")?])
        }
        None => None,
    };
    let positive = places.iter().all(|p| p.value > 0.0) && bounds.is_none_or(|[low, _]| low > 0.0);
    let (mean, deviation) = match of(&args.prior) {
        Some(text) => parse_prior(name, &text, &first, positive, &quantity)?,
        None => (None, None),
    };
    let mut parameter = FreeParameter::new(name, places, positive, deviation).ok_or_else(|| {
        format!("{name} is 0, so its default prior has no scale; give a standard deviation, --prior {name}=\"+- ...\"")
    })?;
    if let Some(mean) = mean {
        parameter.mean = parameter.coordinate(mean);
    }
    if let Some([low, high]) = bounds {
        if low >= high {
            return Err(format!(
                "bounds of {name}: {low} .. {high}: the lower bound must be below the upper bound"
            ));
        }
        let start = parameter.value(parameter.mean);
        if start < low || start > high {
            return Err(format!(
                "bounds of {name}: {low} .. {high} {} exclude the start value {start} {}; widen them, or change the \
                 start with --set",
                first.unit, first.unit
            ));
        }
        (parameter.lower, parameter.upper) = (parameter.coordinate(low), parameter.coordinate(high));
    }
    Ok(parameter)
}

/// "6e6 +- 2e6 N/m", "+- 30 %": mean, if stated, and standard deviation of the coordinate.
fn parse_prior(
    name: &str,
    text: &str,
    first: &ModelNumber,
    positive: bool,
    quantity: &dyn Fn(&str, &str) -> Result<f64, String>,
) -> Result<(Option<f64>, Option<f64>), String> {
    let shape =
        || format!("prior of {name}: \"{text}\" is not a prior; write \"+- 30 %\" or \"6e6 +- 2e6 N/m\"");
    let (mean, spread) = text.split_once("+-").or_else(|| text.split_once('±')).ok_or_else(shape)?;
    let mean = match mean.trim() {
        "" => None,
        stated if stated.parse::<f64>().is_ok() => {
            Some(quantity(&format!("{stated} {}", first.unit), "prior")?)
        }
        stated => Some(quantity(stated, "prior")?),
    };
    let centre = mean.unwrap_or(first.value);
    let spread = spread.trim();
    let width = match spread.strip_suffix('%') {
        Some(share) => 0.01 * share.trim().parse::<f64>().map_err(|_| shape())? * centre.abs(),
        None => quantity(spread, "prior")?,
    };
    if width <= 0.0 || width.is_nan() {
        return Err(format!("prior of {name}: \"{text}\" has no positive standard deviation"));
    }
    // Standard deviation of ln(value), from one standard deviation above the mean.
    let deviation = if positive { (1.0 + width / centre.abs()).ln() } else { width };
    Ok((mean, Some(deviation)))
}
