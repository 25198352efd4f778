//! Former spellings of keys and keywords: read as the present ones, with one hint each.

use rotordyn::io::model_file_edit::{Change, rewrite};
use rotordyn::model::parameter_paths::resolve_parameter_path;
use rotordyn::model::{self, Kind, Loaded, Options};
use std::path::Path;

/// A rotor on two ball bearings that uses every renamed key and keyword.
const TEXT: &str = r#"[model]
name = "renamed"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
element_length = "100 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]
[station]
A = "0 mm"
B = "400 mm"
C = "200 mm"
[bearing.A]
station = "A"
model = "ball"
designation = "6205"
off_size = [{ ball = 3, diameter_difference = "0.2 um" }]
[bearing.B]
station = "B"
model = "radial_ball"
designation = "6205"
stiffness_damping = "1e-4 s"
tensile_contact = true
[joint.axial]
between = ["C", "ground"]
constrain = ["z", "tz"]
[joint.support]
between = ["A", "ground"]
kind = "cylindrical"
axial = "fixed"
[probe.B_x]
at = "B"
direction = "x"
[speed]
profile = "constant"
speed = "1200 rpm"
duration = "1 s"
[study.campbell]
speeds = "0, 600 rpm"
speed_dependent_bearings = false
[study.bearing]
constrain = ["x", "theta_y"]
[study.poincare]
transient_periods = 20
[study.lyapunov]
transient_periods = 30
[study.bifurcation]
parameter = "bearing.A.off_size.0.diameter_difference"
values = ["0 um", "0.1 um", "0.2 um"]
transient_periods = 40
start = "continuation"
"#;

/// Present line, former line, and the key or keyword in both spellings as the hint states them.
const RENAMED: [[&str; 4]; 11] = [
    [
        "off_size = [{ ball = 3, diameter_difference = \"0.2 um\" }]",
        "off_size = [{ ball = 3, by = \"0.2 um\" }]",
        "bearing.A.off_size.0.by",
        "bearing.A.off_size.0.diameter_difference",
    ],
    [
        "tensile_contact = true",
        "contacts_pull = true",
        "bearing.B.contacts_pull",
        "bearing.B.tensile_contact",
    ],
    ["constrain = [\"z\", \"tz\"]", "hold = [\"z\", \"tz\"]", "joint.axial.hold", "joint.axial.constrain"],
    [
        "axial = \"fixed\"",
        "axial = \"held\"",
        "joint.support.axial = \"held\"",
        "joint.support.axial = \"fixed\"",
    ],
    [
        "speed_dependent_bearings = false",
        "follow_bearings = false",
        "study.campbell.follow_bearings",
        "study.campbell.speed_dependent_bearings",
    ],
    [
        "constrain = [\"x\", \"theta_y\"]",
        "hold = [\"x\", \"theta_y\"]",
        "study.bearing.hold",
        "study.bearing.constrain",
    ],
    ["transient_periods = 20", "settle = 20", "study.poincare.settle", "study.poincare.transient_periods"],
    ["transient_periods = 30", "settle = 30", "study.lyapunov.settle", "study.lyapunov.transient_periods"],
    [
        "parameter = \"bearing.A.off_size.0.diameter_difference\"",
        "parameter = \"bearing.A.off_size.0.by\"",
        "bearing.A.off_size.0.by",
        "bearing.A.off_size.0.diameter_difference",
    ],
    [
        "transient_periods = 40",
        "settle = 40",
        "study.bifurcation.settle",
        "study.bifurcation.transient_periods",
    ],
    [
        "start = \"continuation\"",
        "start = \"carried\"",
        "study.bifurcation.start = \"carried\"",
        "study.bifurcation.start = \"continuation\"",
    ],
];

fn load(text: &str, options: &Options) -> Loaded {
    model::load("renamed.toml", text, options).unwrap_or_else(|errors| panic!("{errors}"))
}

fn hints(loaded: &Loaded) -> Vec<String> {
    assert!(loaded.hints.iter().all(|hint| hint.kind == Kind::FormerName));
    loaded.hints.iter().map(|hint| hint.message.clone()).collect()
}

fn hint(old: &str, new: &str) -> String {
    format!("`{old}` is now `{new}`; the old spelling still works")
}

fn with_set(path: &str, value: &str) -> Options {
    Options { set: vec![(path.into(), value.into())], ..Options::default() }
}

#[test]
fn former_spelling_is_read_with_a_hint() {
    let present = load(TEXT, &Options::default());
    assert_eq!((hints(&present), &present.warnings[..]), (vec![], &[][..]));
    let mut all = TEXT.to_string();
    for [new_line, old_line, old, new] in RENAMED {
        assert_eq!(TEXT.matches(new_line).count(), 1, "{new_line}");
        let text = TEXT.replace(new_line, old_line);
        let former = load(&text, &Options::default());
        assert_eq!(former.model, present.model, "{old_line}");
        assert_eq!((hints(&former), &former.warnings[..]), (vec![hint(old, new)], &[][..]));
        let span = former.hints[0].span.clone();
        assert!(old_line.contains(&text[span.clone()]) && former.hints[0].source == 0, "{}", &text[span]);
        all = all.replace(new_line, old_line);
    }
    let former = load(&all, &Options::default());
    assert_eq!(former.model, present.model);
    // The parameter path of the bifurcation diagram is the key with the first hint.
    assert_eq!(hints(&former).len(), RENAMED.len() - 1);
}

#[test]
fn both_spellings_are_an_error() {
    for [new_line, old_line, ..] in RENAMED {
        let [new_key, old_key] = [new_line, old_line].map(|line| line.split(' ').next().unwrap());
        let both = match (new_key == old_key, new_line.contains("ball = 3")) {
            (false, _) => format!("{new_line}\n{old_line}"),
            (true, true) => {
                "off_size = [{ ball = 3, diameter_difference = \"0.2 um\", by = \"0.2 um\" }]".into()
            }
            // One key with one keyword: both cannot be given.
            (true, false) => continue,
        };
        let errors = model::load("renamed.toml", TEXT.replace(new_line, &both), &Options::default());
        let errors = errors.unwrap_err().diagnostics;
        assert_eq!(errors.len(), 1, "{errors:?}");
        assert_eq!(errors[0].kind, Kind::Conflict);
        assert!(errors[0].message.ends_with("are the same key"), "{}", errors[0].message);
        assert!(errors[0].hint.as_ref().unwrap().contains("give only `"), "{errors:?}");
    }
}

#[test]
fn former_spelling_in_set() {
    for (old_path, new_path, value) in [
        ("bearing.A.off_size.0.by", "bearing.A.off_size.0.diameter_difference", "0.3 um"),
        ("bearing.B.contacts_pull", "bearing.B.tensile_contact", "false"),
        ("joint.axial.hold", "joint.axial.constrain", "[\"z\"]"),
        ("study.campbell.follow_bearings", "study.campbell.speed_dependent_bearings", "true"),
        ("study.bearing.hold", "study.bearing.constrain", "[\"y\"]"),
        ("study.poincare.settle", "study.poincare.transient_periods", "21"),
        ("study.lyapunov.settle", "study.lyapunov.transient_periods", "31"),
        ("study.bifurcation.settle", "study.bifurcation.transient_periods", "41"),
    ] {
        let present = load(TEXT, &with_set(new_path, value));
        assert_eq!(hints(&present), [""; 0]);
        assert_ne!(present.model, load(TEXT, &Options::default()).model, "{new_path}");
        let former = load(TEXT, &with_set(old_path, value));
        assert_eq!(former.model, present.model, "{old_path}");
        assert_eq!(hints(&former), [hint(old_path, new_path)]);
        let place = &former.hints[0];
        let source = &former.sources[place.source];
        assert_eq!(source.name, "--set");
        assert_eq!(Some(&source.text[place.span.clone()]), old_path.rsplit('.').next());
    }
    // Keywords, and keys inside of a value.
    let text = TEXT.replace("axial = \"fixed\"\n", "");
    let former = load(&text, &with_set("joint.support.axial", "held"));
    assert_eq!(former.model, load(TEXT, &Options::default()).model);
    assert_eq!(hints(&former), [hint("joint.support.axial = \"held\"", "joint.support.axial = \"fixed\"")]);
    let list = |key: &str| format!("[{{ ball = 1, {key} = \"0.4 um\" }}]");
    let former = load(TEXT, &with_set("bearing.A.off_size", &list("by")));
    let present = load(TEXT, &with_set("bearing.A.off_size", &list("diameter_difference")));
    assert_eq!((&former.model, hints(&former).len()), (&present.model, 1));
}

#[test]
fn former_spelling_in_a_variant() {
    let variants = "[variant.present]\njoint.axial.constrain = [\"z\"]\nstudy.poincare.transient_periods = 9\n\
        [variant.former]\njoint.axial.hold = [\"z\"]\nstudy.poincare.settle = 9\n\
        [variant.removed]\nremove = [\"study.campbell.follow_bearings\"]\n\
        [variant.both]\njoint.axial.hold = [\"z\"]\njoint.axial.constrain = [\"z\"]\n";
    let file = format!("{TEXT}{variants}");
    let old_base = file.replace("constrain = [\"z\", \"tz\"]", "hold = [\"z\", \"tz\"]");
    let variant = |name: &str| Options { variant: Some(name.into()), ..Options::default() };
    let present = load(&file, &variant("present"));
    assert_eq!(hints(&present), [""; 0]);
    for text in [&file, &old_base] {
        let former = load(text, &variant("former"));
        assert_eq!(former.model, present.model);
        assert_eq!(hints(&former).len(), 2, "{:?}", former.hints);
        assert_eq!(load(text, &variant("present")).model, present.model);
    }
    let removed = load(&file, &variant("removed"));
    let campbell = removed.model.studies.campbell.as_ref().unwrap();
    assert!(campbell.speed_dependent_bearings, "the default");
    assert_eq!(
        hints(&removed),
        [hint("study.campbell.follow_bearings", "study.campbell.speed_dependent_bearings")]
    );
    let errors = model::load("renamed.toml", &file, &variant("both")).unwrap_err();
    assert_eq!(errors.diagnostics[0].kind, Kind::Conflict);
    // Unused variants give no hint.
    assert_eq!(hints(&load(&file, &Options::default())), [""; 0]);
}

/// `update` finds a number by either spelling and changes it in the file, whichever spelling the file has.
#[test]
fn former_spelling_in_parameter_paths() {
    let old_text = TEXT.replace("3, diameter_difference =", "3, by =");
    let (old, new) = ("bearing.A.off_size.0.by", "bearing.A.off_size.0.diameter_difference");
    for (text, written) in [(TEXT, new), (&old_text, old)] {
        for path in [old, new, "bearing.*.off_size.*.by", "bearing.A.off_size.*.diameter_difference"] {
            let found = resolve_parameter_path(text.as_bytes(), &Options::default(), path).unwrap();
            assert_eq!((found.len(), &*found[0].path, &*found[0].text), (1, written, "0.2 um"), "{path}");
            let change = Change { path: found[0].path.clone(), value: 0.5, error: 0.01 };
            let changed = rewrite(text, None, &[change]).unwrap();
            let set = load(text, &with_set(new, "0.5 um"));
            assert_eq!(load(&changed, &Options::default()).model, set.model);
        }
    }
    assert_eq!(model::renamed_path(old).as_deref(), Some(new));
    assert_eq!(model::renamed_path(new), None);
}

#[test]
fn errors_name_the_key_as_written() {
    let text = TEXT.replace("constrain = [\"z\", \"tz\"]", "hold = [\"z\", \"z\"]");
    let errors = model::load("renamed.toml", text, &Options::default()).unwrap_err();
    assert_eq!(errors.to_string(), "joint.axial.hold names z twice");
    // Only present spellings are suggested.
    for (misspelt, meant) in [("constrian", "constrain"), ("holt", "constrain")] {
        let text = TEXT.replace("constrain = [\"z\", \"tz\"]", &format!("{misspelt} = [\"z\", \"tz\"]"));
        let errors = model::load("renamed.toml", text, &Options::default()).unwrap_err();
        let advice: Vec<&str> = errors.diagnostics.iter().filter_map(|d| d.hint.as_deref()).collect();
        assert!(advice.iter().any(|text| text.contains(meant)), "{advice:?}");
        assert!(!advice.iter().any(|text| text.contains("`hold`") || text.contains(" hold")), "{advice:?}");
    }
}

/// The example models in their former spelling are the same machines.
#[test]
fn models_in_former_spelling() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut translated = 0;
    for name in ["atef_2022", "bal_2022", "overhung_rig", "upadhyay_2009", "varying_compliance", "zhang_2016"]
    {
        let text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
        let former = [
            ("speed_dependent_bearings =", "follow_bearings ="),
            ("tensile_contact", "contacts_pull"),
            ("\nconstrain =", "\nhold ="),
            ("\ntransient_periods =", "\nsettle ="),
            (" diameter_difference =", " by ="),
            ("axial = \"fixed\"", "axial = \"held\""),
        ]
        .iter()
        .fold(text.clone(), |text, (new, old)| text.replace(new, old));
        assert_ne!(former, text, "{name}");
        let variants = model::variants(&text);
        for variant in [None].into_iter().chain(variants.into_iter().map(Some)) {
            let options = Options { variant: variant.clone(), ..Options::default() };
            let (new, old) = (load(&text, &options), load(&former, &options));
            assert_eq!(new.model, old.model, "{name} {variant:?}");
            assert_eq!((hints(&new).len(), new.warnings), (0, old.warnings.clone()));
            translated += hints(&old).len();
        }
    }
    assert!(translated > 20, "{translated}");
}
