//! Messages about measured speed profiles.

use crate::render::render;
use rotordyn::model::{self, ExternalColumn, ExternalFile, Loaded, ModelErrors, Options};

const MACHINE: &str = r#"[model]
name = "measured"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[shaft]
element_length = "200 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]

[station]
A = "0 mm"
B = "400 mm"

[bearing.A]
station = "A"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"
k_zz = "1e7 N/m"

[bearing.B]
station = "B"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"

[speed]
profile = "measured"
"#;

fn column(name: &str, unit: &str, values: &[f64]) -> ExternalColumn {
    ExternalColumn { name: name.into(), unit: unit.into(), values: values.to_vec() }
}

fn load(keys: &str, content: Result<Vec<ExternalColumn>, String>) -> Result<Loaded, ModelErrors> {
    let files = [ExternalFile { path: "tacho.csv".into(), content }];
    model::load_with("measured.toml", format!("{MACHINE}{keys}\n"), &Options::default(), &files)
}

fn refused(keys: &str, content: Result<Vec<ExternalColumn>, String>) -> String {
    let errors = load(keys, content).expect_err("the input is bad");
    render(&errors.diagnostics, &errors.sources, miette::Severity::Error, false)
}

const FILE: &str = "file = \"tacho.csv\"";
const TURNS: [f64; 6] = [0.1, 0.3, 0.48, 0.64, 0.78, 0.9];

/// A file of these pulse times.
fn pulses(times: &[f64]) -> String {
    refused(FILE, Ok(vec![column("time", "s", times)]))
}

fn speeds(times: &[f64], rpm: &[f64]) -> String {
    refused(FILE, Ok(vec![column("time", "s", times), column("speed", "rpm", rpm)]))
}

#[test]
fn valid_pulses_have_no_warnings() {
    for keys in [FILE.to_string(), "pulses = \"0.1, 0.3, 0.48, 0.64, 0.78, 0.9 s\"".into()] {
        let loaded = load(&keys, Ok(vec![column("time", "s", &TURNS)])).unwrap();
        assert_eq!(loaded.warnings, []);
        assert!((loaded.model.profile.duration() - 0.8).abs() < 1e-12);
    }
}

cases! {
    file_that_is_not_there: refused(FILE, Err("cannot read tacho.csv: No such file or directory".into()));
    file_that_was_not_read: refused("file = \"other.csv\"", Ok(Vec::new()));
    no_source: refused("", Ok(Vec::new()));
    file_and_pulses: refused(&format!("{FILE}\npulses = \"0.1, 0.3, 0.48, 0.64 s\""), Ok(vec![column("time", "s", &TURNS)]));
    several_columns: refused(FILE, Ok(vec![column("time", "s", &TURNS), column("a", "rpm", &TURNS), column("b", "rpm", &TURNS)]));
    unknown_column: refused(&format!("{FILE}\ncolumn = \"spede\""), Ok(vec![column("time", "s", &TURNS), column("speed", "rpm", &TURNS)]));
    column_without_unit: refused(FILE, Ok(vec![column("tacho", "", &TURNS)]));
    column_in_volts: refused(FILE, Ok(vec![column("tacho", "V", &TURNS)]));
    times_that_fall: pulses(&[0.1, 0.3, 0.28, 0.64, 0.78, 0.9]);
    times_with_nan: pulses(&[0.1, 0.3, f64::NAN, 0.64, 0.78, 0.9]);
    too_few_pulses: pulses(&[0.1, 0.3, 0.48]);
    pulses_that_fall: refused("pulses = \"0.1, 0.3, 0.2, 0.5 s\"", Ok(Vec::new()));
    pulses_without_unit: refused("pulses = [0.1, 0.3, 0.48, 0.64]", Ok(Vec::new()));
    part_without_pulses: refused(&format!("{FILE}\nfrom = \"3 s\"\nto = \"4 s\""), Ok(vec![column("time", "s", &TURNS)]));
    negative_speeds: speeds(&[0.0, 1.0, 2.0], &[100.0, 50.0, -3.0]);
    speeds_without_times: refused(FILE, Ok(vec![column("speed", "rpm", &[100.0, 200.0])]));
    smoothing_wider_than_the_train: refused(&format!("{FILE}\nsmoothing = 5"), Ok(vec![column("time", "s", &TURNS)]));
    key_of_another_profile: refused(&format!("{FILE}\nramp = \"1 s\""), Ok(vec![column("time", "s", &TURNS)]));
}
