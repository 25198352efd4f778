//! Orders tracked by the Vold-Kalman filter: of a simulated run-up against the unbalance response, of measured pulses.

use std::f64::consts::TAU;

use crate::signal::measured_data;
use crate::{json_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record, Values};
use serde_json::Value;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Place of the value nearest to another.
fn nearest(values: &[f64], to: f64) -> usize {
    (0..values.len()).min_by(|&a, &b| (values[a] - to).abs().total_cmp(&(values[b] - to).abs())).unwrap()
}

/// Far from the critical speed the order 1 of a slow run-up is the steady unbalance response, amplitude and phase: of two
/// commands that share neither solver nor signal analysis. The free vibration after the critical speed (28 Hz) is
/// 0.5 orders away at 3000 rpm and 25 s old, ζ ω t = 20: what remains is the lag of the ramp, below 1 %.
#[test]
fn order_one_of_a_run_up_is_the_unbalance_response() {
    let folder = tempfile::tempdir().unwrap();
    let model = "models/jeffcott.toml";
    let mut run = rotordyn();
    run.args(["run-up", model, "--no-figures", "--out"]).arg(folder.path().join("run"));
    run.args([
        "--set",
        "speed.profile=\"ramp\"",
        "--set",
        "speed.ramp=\"50 s\"",
        "--set",
        "study.orders.cuts=[1]",
    ]);
    run.args(["--set", "study.orders.bandwidth=0.1", "--set", "study.orders.channels=[\"disc_x\"]"]);
    let document = json_of(&mut run);
    let tracked = &document["orders"][0]["vold_kalman"];
    let rpm = numbers(&tracked["rpm"]);
    let amplitude = numbers(&tracked["tracks"][0]["amplitude"]);
    let phase = numbers(&tracked["tracks"][0]["phase_rad"]);

    let mut steady = rotordyn();
    steady.args(["unbalance", model, "--no-figures", "--out"]).arg(folder.path().join("unbalance"));
    steady.args(["--set", "study.unbalance.speeds=\"1000, 2600, 2800 rpm\""]);
    let steady = &json_of(&mut steady)["unbalance"];
    let speeds = numbers(&steady["speeds_rpm"]);
    let response = steady["responses"].as_array().unwrap().iter().find(|r| r["name"] == "disc_x").unwrap();
    let [re, im] = ["re", "im"].map(|part| numbers(&response[part]));
    for speed in [1000.0, 2600.0, 2800.0] {
        let (k, n) = (nearest(&rpm, speed), nearest(&speeds, speed));
        let (expected, angle) = (re[n].hypot(im[n]), im[n].atan2(re[n]));
        let error = amplitude[k] / expected - 1.0;
        let turned = (phase[k] - angle + 3.0 * TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        println!("{speed} rpm: {:.3e} m, error {error:.4}, {:.2} deg", expected, turned.to_degrees());
        assert!(error.abs() < 0.01, "{speed} rpm: {} {expected}", amplitude[k]);
        assert!(turned.to_degrees().abs() < 2.0, "{speed} rpm: {turned}");
    }
}

/// Orders 7 and 7.144 with a drifting offset over the shaft angle of measured tacho pulses, as asked for by number and by
/// name; both amplitudes change slowly.
#[test]
fn close_orders_over_measured_tacho_pulses() {
    let Some(times) = measured_data::measured("tacho_run_up/time_s.csv") else { return };
    let Values::Real(pulses) = measured::read(&times).unwrap().records.remove(0).values else {
        panic!("the file holds times");
    };
    let rate = 5120.0;
    let duration = pulses[pulses.len() - 1];
    // Cubic between the pulses with the slopes of central differences, not the spline of the command.
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(pulses.len() - 1));
        (b - a) as f64 / (pulses[b] - pulses[a])
    };
    let mut k = 0;
    let sample = |n: usize| {
        let t = n as f64 / rate;
        while k + 2 < pulses.len() && pulses[k + 1] <= t {
            k += 1;
        }
        let width = pulses[k + 1] - pulses[k];
        let s = (t - pulses[k]) / width;
        let (from, to) = (width * slope(k), width * slope(k + 1));
        let theta = TAU * (k as f64 + s * (from + s * (3.0 - 2.0 * from - to + s * (from + to - 2.0))));
        (1.0 + t / duration) * (7.0 * theta).cos() + 0.7 * (7.144 * theta + 1.0).cos() + 2.0 * t / duration
    };
    let x = (0..(duration * rate) as usize).map(sample).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.h5");
    let records = vec![Record::samples("A_ax", rate, 0.0, x, "m/s^2")];
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    let out = folder.path().join("out");
    let signal = |flags: &[&str]| {
        let mut command = rotordyn();
        command.arg("signal").arg(&path).args(["--tacho"]).arg(&times).arg("--out").arg(&out);
        json_of(
            command.args(["--analyses", "orders", "--bearing-orders", "BPFO=3.572,BPFI=5.428"]).args(flags),
        )
    };
    let document = signal(&["--orders", "7,2 BPFO", "--bandwidth", "0.15"]);
    let tracked = &document["channels"][0]["orders"]["vold_kalman"];
    let [rpm, time] = ["rpm", "time"].map(|name| numbers(&tracked[name]));
    let fast = |k: &usize| rpm[*k] > 900.0;
    for (row, label, expected) in [(0, "7x", [1.0, 1.0]), (1, "2 BPFO", [0.7, 0.0])] {
        let track = &tracked["tracks"][row];
        assert_eq!(track["label"], label);
        let amplitude = numbers(&track["amplitude"]);
        let errors = (0..rpm.len())
            .filter(fast)
            .map(|k| (amplitude[k] - expected[0] - expected[1] * time[k] / duration).abs());
        let worst = errors.fold(0.0, f64::max);
        println!("{label}: {worst:.4}");
        // Seven times the difference of the two interpolations of the angle modulates the order.
        assert!(worst < 0.1, "{label}: {worst}");
    }
    assert!(document["channels"][0]["warnings"].as_array().unwrap().is_empty());
    assert!(out.join("signal_order_tracks_A_ax.svg").exists());
    let wide = signal(&["--orders", "7,7.144", "--bandwidth", "0.3", "--no-figures"]);
    assert!(
        wide["channels"][0]["warnings"][0].as_str().unwrap().contains("7x and 7.144x lie in one pass band")
    );
}
