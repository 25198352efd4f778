//! The cases of a comparison: variants, values of a path given more than once, named cases.

use rotordyn::study::MEASURED;

use super::super::args::CompareArgs;
use super::super::failure::Failure;
use super::super::machine::ModelSource;
use super::super::settings::Settings;

/// Largest number of cases.
const MAX_CASES: usize = 64;

/// One case: the model file with its variant and values.
pub struct Case {
    pub name: String,
    pub origin: ModelSource,
    /// Values of the case alone, with the text of the command line that gives them.
    pub settings: Settings,
}

/// Values of one case beside those of every case.
struct Values {
    name: String,
    /// Which of the values of `--set` it takes.
    set: Vec<(String, String)>,
    settings: Settings,
}

/// All cases of the command line.
///
/// # Errors
/// Fewer than two (one beside a measurement), two of one name or of the same values, a case that is not written as such.
pub fn cases(args: &CompareArgs, source: &ModelSource) -> Result<Vec<Case>, Failure> {
    let values = match (repeated(&args.study.model.set), &args.case[..]) {
        (repeated, []) if repeated.is_empty() => vec![Values {
            name: String::new(),
            set: args.study.model.set.clone(),
            settings: Settings::default(),
        }],
        (repeated, []) => of_repeated(&args.study.model.set, &repeated)?,
        (repeated, named) if repeated.is_empty() => {
            named.iter().map(|text| named_case(text, &args.study.model.set)).collect::<Result<_, _>>()?
        }
        (repeated, _) => {
            return Err(Failure::Input(format!(
                "--set {} is given more than once beside --case: give the values of a case in --case",
                repeated[0]
            )));
        }
    };
    let own_cases = values.len() > 1 || !args.case.is_empty();
    let variants: Vec<String> = match &args.variants[..] {
        [] if own_cases || args.measured.is_some() || args.study.model.variant.is_some() => {
            vec![source.options.variant.clone().unwrap_or_else(|| "base".into())]
        }
        [] => std::iter::once("base".to_string()).chain(source.variants()).collect(),
        names => names.to_vec(),
    };
    let mut cases = Vec::new();
    for variant in &variants {
        for of in &values {
            let name = match (of.name.as_str(), variants.len()) {
                ("", _) => variant.clone(),
                (name, 1) => name.to_string(),
                (name, _) => format!("{variant}, {name}"),
            };
            let mut origin = source.with_variant(variant);
            origin.options.set.clone_from(&of.set);
            cases.push(Case { name, origin, settings: of.settings.clone() });
        }
    }
    check(&cases, args, source)?;
    Ok(cases)
}

fn check(cases: &[Case], args: &CompareArgs, source: &ModelSource) -> Result<(), Failure> {
    for (k, case) in cases.iter().enumerate() {
        let named = |other: &&Case| other.name == case.name;
        if case.name == MEASURED {
            return Err(Failure::Input(format!(
                "a case cannot be named `{MEASURED}`, as the measurement is"
            )));
        }
        if cases[..k].iter().any(|other| named(&other)) {
            return Err(Failure::Input(format!("two cases are named `{}`", case.name)));
        }
        let values = |case: &Case| {
            let mut all = [&case.origin.options.set[..], &case.settings.set[..]].concat();
            all.sort();
            (case.origin.options.variant.clone(), all)
        };
        if let Some(other) = cases[..k].iter().find(|other| values(other) == values(case)) {
            return Err(Failure::Input(format!(
                "the cases `{}` and `{}` are the same",
                other.name, case.name
            )));
        }
    }
    if cases.len() > MAX_CASES {
        return Err(Failure::Input(format!("{} cases are more than {MAX_CASES}", cases.len())));
    }
    if cases.len() < 2 && args.measured.is_none() {
        return Err(Failure::Input(too_few(args, source)));
    }
    Ok(())
}

/// Paths that are given more than once, each once.
fn repeated(set: &[(String, String)]) -> Vec<&str> {
    let mut paths: Vec<&str> = Vec::new();
    for (k, (path, _)) in set.iter().enumerate() {
        if !paths.contains(&path.as_str()) && set[k + 1..].iter().any(|(other, _)| other == path) {
            paths.push(path);
        }
    }
    paths
}

/// A case for every value of the repeated paths, which go together.
fn of_repeated(set: &[(String, String)], repeated: &[&str]) -> Result<Vec<Values>, Failure> {
    let values = |of: &str| -> Vec<&str> {
        set.iter().filter(|(path, _)| path == of).map(|(_, value)| value.as_str()).collect()
    };
    let count = values(repeated[0]).len();
    if let Some(other) = repeated.iter().find(|path| values(path).len() != count) {
        return Err(Failure::Input(format!(
            "{} is given {count} times and {other} {} times: values of paths that are given more than once go together, \
             case by case; or name the cases, such as --case \"tight: {}={}; {other}={}\"",
            repeated[0],
            values(other).len(),
            repeated[0],
            values(repeated[0])[0],
            values(other)[0]
        )));
    }
    let of_case = |k: usize| {
        let mut seen = vec![0; repeated.len()];
        let taken = |(path, _): &&(String, String)| match repeated.iter().position(|of| of == path) {
            Some(place) => {
                seen[place] += 1;
                seen[place] == k + 1
            }
            None => true,
        };
        let own: Vec<(String, String)> = set.iter().filter(taken).cloned().collect();
        let of: Vec<(&str, &str)> = repeated.iter().map(|path| (*path, values(path)[k])).collect();
        Values { name: name_of(&of), set: own, settings: Settings::default() }
    };
    Ok((0..count).map(of_case).collect())
}

/// Name of a case by its values: the last key and the value if all are the same, else every path.
fn name_of(values: &[(&str, &str)]) -> String {
    let plain = |value: &str| value.trim_matches('"').to_string();
    let key = |path: &str| path.rsplit('.').next().unwrap_or(path).to_string();
    let (path, value) = values[0];
    if values.iter().all(|(p, v)| key(p) == key(path) && v == &value) {
        return format!("{} {}", key(path), plain(value));
    }
    values.iter().map(|(path, value)| format!("{path} {}", plain(value))).collect::<Vec<_>>().join(", ")
}

/// A case written as "NAME: PATH=VALUE; PATH=VALUE".
fn named_case(text: &str, set: &[(String, String)]) -> Result<Values, Failure> {
    let wrong = |why: &str| {
        Failure::Input(format!(
            "--case \"{text}\": {why}; write it as \"tight: bearing.A.radial_clearance=5 um; \
             bearing.B.radial_clearance=5 um\""
        ))
    };
    // A path has no colon, and a value only in quotes.
    let (name, rest) = text.split_once(':').ok_or_else(|| wrong("it has no name"))?;
    let name = name.trim();
    if name.is_empty() || name.contains('=') {
        return Err(wrong("it has no name"));
    }
    let mut settings = Settings::default();
    for part in parts(rest).into_iter().map(|part| part.trim().to_string()).filter(|part| !part.is_empty()) {
        let (path, value) =
            part.split_once('=').ok_or_else(|| wrong(&format!("`{part}` is not PATH=VALUE")))?;
        let (path, value) = (path.trim().to_string(), value.trim().to_string());
        if path.is_empty() || value.is_empty() {
            return Err(wrong(&format!("`{part}` is not PATH=VALUE")));
        }
        if settings.set.iter().any(|(known, _)| *known == path) {
            return Err(wrong(&format!("{path} is given twice")));
        }
        settings.flags.push((path.clone(), format!("--case {text}")));
        settings.set.push((path, value));
    }
    Ok(Values { name: name.into(), set: set.to_vec(), settings })
}

/// Parts between semicolons outside quotes, brackets and braces.
fn parts(text: &str) -> Vec<String> {
    let (mut parts, mut depth, mut quoted) = (vec![String::new()], 0i32, false);
    for c in text.chars() {
        match c {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            ';' if !quoted && depth <= 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(last) = parts.last_mut() {
            last.push(c);
        }
    }
    parts
}

/// What to do with a single case.
fn too_few(args: &CompareArgs, source: &ModelSource) -> String {
    let known = source.variants();
    let file = &source.name;
    let other =
        "other values of one path make cases too: --set bearing.A.clearance=C3 --set bearing.A.clearance=C4";
    if known.is_empty() {
        return format!(
            "{file} has no variants to compare; add one with the values that differ, for example\n\n[variant.loose]\n\
             bearing.A.clearance = \"C4\"\n\n{other}"
        );
    }
    let first = args.variants.first().or(args.study.model.variant.as_ref()).map_or("base", String::as_str);
    let second = known.iter().map(String::as_str).find(|name| *name != first).unwrap_or("base");
    format!(
        "compare needs two cases or more, such as --variants {first},{second}; the file has: {}; {other}",
        known.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(of: &[(&str, &str)]) -> Vec<(String, String)> {
        of.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect()
    }

    fn names(of: &[Values]) -> Vec<&str> {
        of.iter().map(|values| values.name.as_str()).collect()
    }

    #[test]
    fn values_of_a_repeated_path_are_cases() {
        let given = set(&[("a.x", "1"), ("g", "0"), ("a.x", "\"2 um\""), ("b.x", "1"), ("b.x", "\"2 um\"")]);
        let paths = repeated(&given);
        assert_eq!(paths, ["a.x", "b.x"]);
        let found = of_repeated(&given, &paths).unwrap();
        assert_eq!(names(&found), ["x 1", "x 2 um"]);
        assert_eq!(found[1].set, set(&[("g", "0"), ("a.x", "\"2 um\""), ("b.x", "\"2 um\"")]));
        let uneven = set(&[("a.x", "1"), ("a.x", "2"), ("b.x", "1"), ("b.x", "2"), ("b.x", "3")]);
        let Err(Failure::Input(text)) = of_repeated(&uneven, &repeated(&uneven)) else { panic!() };
        assert!(text.starts_with("a.x is given 2 times and b.x 3 times"), "{text}");
        let other = set(&[("a.x", "1"), ("a.x", "2"), ("b.y", "3"), ("b.y", "4")]);
        assert_eq!(names(&of_repeated(&other, &repeated(&other)).unwrap()), ["a.x 1, b.y 3", "a.x 2, b.y 4"]);
    }

    #[test]
    fn a_named_case_has_its_values() {
        let found = named_case("tight: a.x = 5 um; d=[{ k = \"v; w\" }]; ", &[]).unwrap();
        assert_eq!(found.name, "tight");
        assert_eq!(found.settings.set, set(&[("a.x", "5 um"), ("d", "[{ k = \"v; w\" }]")]));
        for (text, why) in [
            ("a.x=5 um", "it has no name"),
            (": a=1", "it has no name"),
            ("a=1: b=2", "it has no name"),
            ("t: a", "`a` is not PATH=VALUE"),
            ("t: a=", "`a=` is not PATH=VALUE"),
            ("t: a=1; a=2", "a is given twice"),
        ] {
            let Err(Failure::Input(found)) = named_case(text, &[]) else { panic!("{text}") };
            assert!(found.contains(why), "{found}");
        }
    }
}
