//! Values that a file does not give: recorded, and default probes and excitations; and what a setting of the command
//! line replaces.

use rotordyn::model::study::Integrator;
use rotordyn::model::{self, Kind, Loaded, Options, Quantity};
use rotordyn::study::Machine;

const HEAD: &str = r#"
[model]
name = "machine"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
element_length = "50 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]
[station]
A = "50 mm"
fan = "200 mm"
B = "350 mm"
[disc.A]
station = "fan"
mass = "5 kg"
polar_inertia = "0.02 kg m^2"
diametral_inertia = "0.01 kg m^2"
[bearing.A]
station = "A"
model = "ball"
designation = "6205"
clearance = "C3"
[bearing.B]
station = "B"
model = "ball"
designation = "6205"
contact_damping = "200 N s/m"
"#;

fn load(text: &str, set: &[(&str, &str)]) -> Loaded {
    let set = set.iter().map(|(path, value)| (path.to_string(), value.to_string())).collect();
    let loaded = model::load("machine.toml", format!("{HEAD}{text}"), &Options { set, ..Options::default() });
    loaded.unwrap_or_else(|errors| panic!("{errors}"))
}

/// The disc and the bearing A have one name: the probes of the bearing are told apart.
#[test]
fn probes_and_excitations_of_a_file_without_any() {
    let loaded = load("[study.frf]\nfrequencies = \"1, 2 Hz\"\n", &[]);
    let model = &loaded.model;
    let names: Vec<&str> = model.probes.iter().map(|probe| probe.name.as_str()).collect();
    assert_eq!(names, ["A_x", "A_y", "bearing_A_x", "bearing_A_y", "B_x", "B_y"]);
    let nodes: Vec<Option<usize>> = model.probes.iter().map(|probe| probe.at.node).collect();
    let [disc, a, b] = [model.discs[0].node, model.bearings[0].node, model.bearings[1].node].map(Some);
    assert_eq!(nodes, [disc, disc, a, a, b, b]);
    assert_eq!(model.probes[0].direction, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(model.probes[1].direction, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let frf = model.studies.frf.as_ref().unwrap();
    assert_eq!(frf.responses, model.probes);
    let excitations: Vec<_> = frf.excitations.iter().map(|e| (e.name.as_str(), e.at.node)).collect();
    assert_eq!(excitations, [("x", disc), ("y", disc)]);
}

/// A probe of the file is the only one.
#[test]
fn given_probes_have_no_others_beside_them() {
    let text = "[probe.fan]\nat = \"station.fan\"\ndirection = \"x\"\nquantity = \"velocity\"\n";
    let probes = load(text, &[]).model.probes;
    assert_eq!((probes.len(), probes[0].quantity), (1, Quantity::Velocity));
}

/// BPFO of the 6205 is 3.57: the order spectrum holds its cuts, and a file that excludes one is told so before any run.
#[test]
fn order_spectrum_holds_the_highest_cut() {
    let run = "[speed]\nprofile = \"constant\"\nspeed = \"9 rpm\"\nduration = \"200 s\"\n[study.run_up]\n[study.orders]\n";
    let highest = |cuts: &str| {
        let found = load(&format!("{run}cuts = [{cuts}]\n"), &[]).model.studies.orders.unwrap();
        (found.max_order, found.cuts.iter().copied().fold(0.0, f64::max))
    };
    assert_eq!(highest("1, \"2 BPFO\"").0, 20.0);
    let (max_order, cut) = highest("1, \"9 BPFO\"");
    assert!(cut > 32.0 && (max_order / cut - 1.1).abs() < 1e-12, "{max_order} {cut}");
    let text = format!("{HEAD}{run}cuts = [1, \"9 BPFO\"]\nmax_order = 30\n");
    let errors = model::load("machine.toml", text, &Options::default()).unwrap_err().to_string();
    assert!(errors.contains("study.orders.max_order is below the cut at order 32.14"), "{errors}");
}

#[test]
fn defaults_are_recorded_with_their_keys() {
    let loaded =
        load("[speed]\nprofile = \"constant\"\nspeed = \"9 rpm\"\nduration = \"1 s\"\n[study.run_up]\n", &[]);
    let value = |path: &str| {
        let found = loaded.defaults.iter().filter(|default| default.path == path);
        let values: Vec<&str> = found.map(|default| default.value.as_str()).collect();
        assert!(values.len() <= 1, "{path}: {values:?}");
        values.first().copied()
    };
    assert_eq!(value("bearing.A.contact_damping"), Some("\"300 N s/m\""));
    assert_eq!(value("bearing.B.contact_damping"), None);
    assert_eq!(value("bearing.A.clearance"), None);
    assert_eq!(value("bearing.B.clearance"), Some("\"CN\""));
    assert_eq!(value("study.run_up.step"), Some("\"100 us\""));
    assert_eq!(value("study.run_up.cutoff"), Some("all modes"));
    assert_eq!(value("model.gravity"), Some("\"9.80665 m/s^2\""));
    assert_eq!(value("bearing.A.designation"), None);
}

/// Stated values give the same model as the defaults, and are then no defaults.
#[test]
fn a_recorded_default_can_be_set() {
    let loaded = load("", &[]);
    // probes are no value, the cage pocket is computed and rounded to 1 um
    let others = ["probe", "cage_pocket_diameter"];
    let fixed = |path: &str| !others.iter().any(|other| path.ends_with(other));
    for default in loaded.defaults.iter().filter(|default| fixed(&default.path)) {
        let with = load("", &[(&default.path, &default.value)]);
        assert!(with.model == loaded.model, "{default:?}");
        assert!(with.defaults.iter().all(|other| other.path != default.path), "{default:?}");
    }
}

/// The file has a clearance class, the command line a clearance.
#[test]
fn a_setting_replaces_the_key_that_excludes_it() {
    let clearance =
        |loaded: &Loaded| loaded.model.bearings[0].bearing.ball().unwrap().geometry.radial_clearance;
    assert!((clearance(&load("", &[])) - 20.5e-6).abs() < 1e-12);
    assert_eq!(clearance(&load("", &[("bearing.A.radial_clearance", "7 um")])), 7e-6);
}

#[test]
fn settings_of_another_integrator_are_ignored_with_a_note() {
    let text = "[speed]\nprofile = \"constant\"\nspeed = \"9 rpm\"\nduration = \"1 s\"\n[study.run_up]\nrho_infinity = 0.7\n";
    let loaded = load(text, &[("study.run_up.integrator", "newmark")]);
    assert_eq!(loaded.model.studies.run_up.unwrap().integrator, Integrator::Newmark);
    let [hint] = &loaded.hints[..] else { panic!("{:?}", loaded.hints) };
    assert_eq!((hint.kind, hint.source), (Kind::Ineffective, 0));
    assert!(hint.message.contains("study.run_up.rho_infinity"), "{}", hint.message);
    // in one file it stays an error
    let both = format!("{HEAD}{text}integrator = \"newmark\"\n");
    assert!(model::load("machine.toml", both, &Options::default()).is_err());
}

/// The step of a run-up divides the period of the highest order line at top speed by 90, between a slow and a fast machine.
#[test]
fn the_default_step_follows_the_fastest_line() {
    let step = |rpm: f64, more: &str| {
        let speed = format!("[speed]\nprofile = \"constant\"\nspeed = \"{rpm} rpm\"\nduration = \"1 s\"\n");
        let loaded = load(&format!("{speed}[study.run_up]\n{more}"), &[]);
        let written = loaded.defaults.iter().find(|default| default.path == "study.run_up.step");
        let written = written.map(|default| default.value.clone());
        (loaded.model.studies.run_up.unwrap().step, written)
    };
    // BPFO of a 6205: 3.572; 1e6/(90 · 3.572 · n/60) = 124, 20.7, 6.2 us.
    for (rpm, us, text) in [(1500.0, 100.0, "100 us"), (9000.0, 20.0, "20 us"), (30000.0, 6.2, "6.2 us")] {
        assert_eq!(step(rpm, ""), (us / 1e6, Some(format!("\"{text}\""))));
    }
    // An order cut above it: 1e6/(90 · 12 · 150).
    assert_eq!(step(9000.0, "[study.orders]\ncuts = [1, 12]\n").0, 6.1 / 1e6);
    assert_eq!(step(9000.0, "step = \"50 us\"\n"), (50.0 / 1e6, None));
}

/// The step on a defect divides its shortest passage at top speed by 40; runs at constant speed, whose steps are equal, take it.
#[test]
fn the_default_step_on_a_defect_follows_its_passage() {
    let text = "[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n[study.run_up]\n[study.poincare]\n\
                [[bearing.A.defect]]\nkind = \"dent\"\non = \"inner\"\nangle = \"0 deg\"\nwidth = \"0.8 mm\"\n";
    let defect_step = |set: &[(&str, &str)]| {
        let loaded = load(text, set);
        let written = loaded.defaults.iter().find(|default| default.path == "study.run_up.defect_step");
        let written = written.map(|default| default.value.clone());
        let studies = loaded.model.studies;
        (studies.run_up.unwrap().defect_step, studies.poincare.unwrap().steady.step, written)
    };
    // A ball of a 6205 (D 7.94 mm, D_pw 38.5 mm) moves over the inner race, of a radius of 15.28 mm, by
    // ½ (1 + 7.94/38.5) of the shaft's 314.2 rad/s: 0.8 mm in 276 us.
    assert_eq!(defect_step(&[]), (6.9e-6, 6.9e-6, Some("\"6.9 us\"".into())));
    let given = [("study.run_up.defect_step", "5 us"), ("study.poincare.step", "2 us")];
    assert_eq!(defect_step(&given), (5e-6, 2e-6, None));
    let perfect = load(
        "[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n[study.run_up]\n",
        &[],
    );
    assert_eq!(perfect.model.studies.run_up.unwrap().defect_step, f64::INFINITY);
}

/// The bearing A of the file has a clearance class.
#[test]
fn a_key_of_a_variant_takes_the_place_of_one_that_excludes_it() {
    let variants = "[variant.given]\nbearing.A.radial_clearance = \"7 um\"\n[variant.class]\nbased_on = \"given\"\n\
                    bearing.A.clearance = \"C4\"\n";
    let clearance = |variant: Option<&str>, set: &[(&str, &str)]| {
        let set = set.iter().map(|(path, value)| (path.to_string(), value.to_string())).collect();
        let options = Options { variant: variant.map(String::from), set };
        let loaded = model::load("machine.toml", format!("{HEAD}{variants}"), &options);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{variant:?}: {errors}"));
        1e6 * loaded.model.bearings[0].bearing.ball().unwrap().geometry.radial_clearance
    };
    let of_class = |class: &str| clearance(None, &[("bearing.A.clearance", class)]);
    assert!((clearance(Some("given"), &[]) - 7.0).abs() < 1e-9);
    // The last variant of a chain, then the command line.
    assert_eq!(clearance(Some("class"), &[]), of_class("C4"));
    assert!((clearance(Some("class"), &[("bearing.A.radial_clearance", "9 um")]) - 9.0).abs() < 1e-9);
    // Two of one variant exclude each other as in the file.
    let both = format!(
        "{HEAD}[variant.both]\nbearing.B.radial_clearance = \"7 um\"\nbearing.B.clearance = \"C4\"\n"
    );
    let options = Options { variant: Some("both".into()), ..Options::default() };
    let errors = model::load("machine.toml", both, &options).unwrap_err();
    assert!(errors.to_string().contains("mutually exclusive"), "{errors}");
}

/// A name that several bearings have stands for the line of each, of equal ones once; a bearing's own name for its line.
#[test]
fn an_order_without_bearing_is_that_of_every_bearing() {
    let text = HEAD.replacen(
        "[bearing.B]\nstation = \"B\"\nmodel = \"ball\"\ndesignation = \"6205\"",
        "[bearing.B]\nstation = \"B\"\nmodel = \"ball\"\ndesignation = \"6305\"",
        1,
    );
    let read = |text: &str, names: &str| {
        let study = format!("[study.campbell]\nspeeds = \"0, 3000 rpm\"\norders = [{names}]\n");
        model::load("machine.toml", format!("{text}{study}"), &Options::default()).map(|loaded| loaded.model)
    };
    let orders = |text: &str, names: &str| read(text, names).unwrap().studies.campbell.unwrap().orders;
    let [a, b] = ["\"A.BPFO\"", "\"B.BPFO\""].map(|name| orders(&text, name)[0]);
    assert!((a - b).abs() > 1e-3 && (a - 3.572).abs() < 1e-3, "{a} {b}");
    assert_eq!(orders(&text, "1, \"BPFO\""), [1.0, a, b]);
    assert_eq!(orders(&text, "\"A.BPFO\", \"BPFO\", \"2 BPFO\""), [a, b, 2.0 * a, 2.0 * b]);
    assert_eq!(orders(HEAD, "1, \"BPFO\""), [1.0, a]);
    let lines = Machine::new(read(&text, "1, \"BPFO\"").unwrap()).unwrap().order_lines(&[1.0, a, b, 2.0 * b]);
    let labels: Vec<_> = lines.iter().map(|line| line.label.as_str()).collect();
    assert_eq!(labels, ["1x", "A.BPFO", "B.BPFO", "2 B.BPFO"]);
    let message = read(&text, "\"C.BPFO\"").unwrap_err().to_string();
    assert!(message.contains("no ball bearing `C`; known are \"A.BPFO\", \"B.BPFO\""), "{message}");
}

#[test]
fn lubrication_is_a_default_only_with_a_lubricant() {
    let path = "bearing.A.lubrication";
    assert!(load("", &[]).defaults.iter().all(|default| default.path != path));
    let oil = "[lubricant.oil]\ngrade = \"ISO VG 22\"\ntemperature = \"50 degC\"\n";
    let oiled = load(oil, &[("bearing.A.lubricant", "oil")]);
    assert!(oiled.defaults.iter().any(|default| default.path == path));
}
