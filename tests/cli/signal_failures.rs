//! `signal` command: all problems of files and flags are reported, with hints.

use std::path::Path;

use crate::rotordyn;
use crate::signal::faulty_bearing_file;
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record};

/// Standard error of a command that must fail, run inside the folder.
fn refusal(folder: &Path, file: &str, flags: &[&str]) -> String {
    let mut command = rotordyn();
    command.current_dir(folder).args(["signal", file, "--no-figures", "--out", "out"]).args(flags);
    let assert = command.assert().code(2);
    let output = assert.get_output();
    assert!(output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8_lossy(&output.stderr).trim().to_string()
}

fn write(folder: &Path, name: &str, records: Vec<Record>) {
    measured::write(&folder.join(name), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
}

#[test]
fn bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    faulty_bearing_file(folder, "good.h5", 12_000.0, "m/s^2");
    faulty_bearing_file(folder, "slow.h5", 1000.0, "m/s^2");
    let plain = |name: &str, rate: f64, values: Vec<f64>| Record::samples(name, rate, 0.0, values, "m/s^2");
    let wave = |n: usize| (0..n).map(|k| (0.3 * k as f64).sin()).collect::<Vec<_>>();
    write(folder, "short.h5", vec![plain("A_ax", 12_000.0, wave(3000))]);
    let mut broken = wave(40_000);
    broken[123] = f64::NAN;
    write(folder, "broken.h5", vec![plain("A_ax", 12_000.0, broken)]);
    let dead = Record::samples("tacho", 12_000.0, 0.0, vec![0.0; 40_000], "V");
    let one =
        Record::samples("pulse", 12_000.0, 0.0, (0..40_000).map(|k| f64::from(k == 900)).collect(), "V");
    write(folder, "tachos.h5", vec![plain("A_ax", 12_000.0, wave(40_000)), dead, one]);
    std::fs::write(folder.join("bare.csv"), "A_ax\n1.0\n2.0\n-1.0\n0.5\n0.1\n").unwrap();
    let uneven: String = (0..50).map(|k| format!("{},{}\n", k * k, k)).collect();
    std::fs::write(folder.join("uneven.csv"), format!("time_s,A_ax_m_s2\n{uneven}")).unwrap();
    std::fs::write(folder.join("prose.txt"), "Dear colleague,\nthe record follows by post.\n").unwrap();
    std::fs::write(folder.join("empty.mat"), "").unwrap();

    let bearing = ["--bearing", "6205-2RS", "--speed", "1800 rpm"];
    let with = |flags: &[&'static str]| [&bearing[..], flags].concat();
    let cases: Vec<(&str, &str, Vec<&str>)> = vec![
        ("no_rate", "bare.csv", vec![]),
        ("rate_without_unit", "bare.csv", vec!["--rate", "12000"]),
        ("rate_of_zero", "bare.csv", vec!["--rate", "0 Hz"]),
        ("rate_too_low_for_the_lines", "slow.h5", with(&[])),
        ("too_short_for_the_cage", "short.h5", with(&[])),
        ("too_short_for_the_resolution", "short.h5", vec!["--analyses", "psd", "--resolution", "1 Hz"]),
        ("uneven_steps", "uneven.csv", vec![]),
        ("not_a_number", "broken.h5", vec![]),
        ("unknown_channel", "good.h5", vec!["--channel", "A_az"]),
        ("unknown_bearing", "good.h5", vec!["--bearing", "6205-2RX"]),
        ("no_speed", "short.h5", vec!["--bearing", "6205-2RS"]),
        ("speed_without_unit", "good.h5", vec!["--bearing", "6205-2RS", "--speed", "1800"]),
        ("band_beyond_half_the_rate", "good.h5", with(&["--band", "500 Hz .. 7 kHz"])),
        ("band_the_wrong_way", "good.h5", with(&["--band", "5 kHz .. 500 Hz"])),
        ("band_by_lines_of_no_bearing", "good.h5", vec!["--band", "lines"]),
        ("unknown_analysis", "good.h5", vec!["--analyses", "envelop,cepstrum"]),
        ("orders_without_an_angle", "good.h5", vec!["--analyses", "orders"]),
        ("text_that_is_no_record", "prose.txt", vec![]),
        ("an_empty_file", "empty.mat", vec![]),
        ("a_tacho_that_stands", "tachos.h5", vec!["--tacho", "tacho"]),
        ("a_tacho_of_one_pulse", "tachos.h5", vec!["--tacho", "pulse"]),
        ("no_such_tacho", "tachos.h5", vec!["--tacho", "tachi"]),
        ("a_line_without_range", "good.h5", vec!["--track", "1"]),
        (
            "rates_that_are_no_bearing",
            "good.h5",
            vec!["--speed", "1800 rpm", "--bearing-orders", "BPFO=5.9,BPFI=3.6"],
        ),
        ("rates_misspelt", "good.h5", vec!["--speed", "1800 rpm", "--bearing-orders", "BPO=3.6,BPFI=x"]),
        ("no_time_left", "good.h5", vec!["--time", "7 s .. 8 s"]),
        ("against_without_rate", "good.h5", with(&["--compare-with", "bare.csv"])),
        ("against_too_slow", "good.h5", with(&["--compare-with", "slow.h5"])),
        (
            "several_at_once",
            "bare.csv",
            vec!["--channel", "B", "--bearing", "62", "--band", "x", "--race", "middle"],
        ),
    ];
    let outputs: Vec<String> = cases
        .iter()
        .map(|(name, file, flags)| format!("# {name}\n{}\n", refusal(folder, file, flags)))
        .collect();
    insta::assert_snapshot!("bad_input_of_signal", outputs.join("\n"));
}

/// Questionable input gives warnings, and the analysis is computed.
#[test]
fn warnings() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    faulty_bearing_file(folder, "good.h5", 12_000.0, "m/s^2");
    // A tacho at 25 rev/s with every seventh pulse missing.
    let pulse = |k: usize| {
        let turns = 25.0 * k as f64 / 12_000.0;
        f64::from(turns.fract() < 0.2 && (turns as usize) % 7 != 6)
    };
    let wave = (0..36_000).map(|k| (0.3 * k as f64).sin()).collect();
    let records = vec![
        Record::samples("A_ax", 12_000.0, 0.0, wave, "m/s^2"),
        Record::samples("tacho", 12_000.0, 0.0, (0..36_000).map(pulse).collect(), "V"),
    ];
    write(folder, "gaps.h5", records);
    let warned = |file: &str, flags: &[&str]| {
        let mut command = rotordyn();
        command.current_dir(folder).args(["signal", file, "--no-figures", "--out", "out"]).args(flags);
        let assert = command.assert().success();
        String::from_utf8_lossy(&assert.get_output().stderr).trim().to_string()
    };
    let rate = warned("good.h5", &["--rate", "48 kHz", "--analyses", "psd"]);
    assert!(
        rate.contains("the file states 12000 Hz") && rate.contains("48000 Hz of --rate is used"),
        "{rate}"
    );
    let unit = warned("good.h5", &["--unit", "g", "--analyses", "psd"]);
    assert!(unit.contains("--unit g is ignored"), "{unit}");
    let tacho = warned("gaps.h5", &["--tacho", "tacho", "--analyses", "orders"]);
    assert!(tacho.contains("missing pulses added"), "{tacho}");
}
