//! Orders tracked by the Vold-Kalman filter: of a simulated run-up against the unbalance response, of measured pulses.

use std::f64::consts::TAU;
use std::path::PathBuf;

use crate::signal::measured_data;
use crate::{json_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::linalg::Complex64;
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

/// The times of measured tacho pulses, and their file.
fn measured_pulses() -> Option<(PathBuf, Vec<f64>)> {
    let path = measured_data::measured("tacho_run_up/time_s.csv")?;
    let Values::Real(pulses) = measured::read(&path).unwrap().records.remove(0).values else {
        panic!("the file holds times");
    };
    Some((path, pulses))
}

/// Shaft angle at increasing times: cubic between the pulses with the slopes of central differences, not the spline of the
/// command.
fn angle_between(pulses: &[f64]) -> impl FnMut(f64) -> f64 {
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(pulses.len() - 1));
        (b - a) as f64 / (pulses[b] - pulses[a])
    };
    let mut k = 0;
    move |t: f64| {
        while k + 2 < pulses.len() && pulses[k + 1] <= t {
            k += 1;
        }
        let width = pulses[k + 1] - pulses[k];
        let s = (t - pulses[k]) / width;
        let (from, to) = (width * slope(k), width * slope(k + 1));
        TAU * (k as f64 + s * (from + s * (3.0 - 2.0 * from - to + s * (from + to - 2.0))))
    }
}

/// Orders 7 and 7.144 with a drifting offset over the shaft angle of measured tacho pulses, as asked for by number and by
/// name; both amplitudes change slowly.
#[test]
fn close_orders_over_measured_tacho_pulses() {
    let Some((times, pulses)) = measured_pulses() else { return };
    let rate = 5120.0;
    let duration = pulses[pulses.len() - 1];
    let mut angle = angle_between(&pulses);
    let sample = |n: usize| {
        let t = n as f64 / rate;
        let theta = angle(t);
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
    let warning = wide["warnings"].as_array().unwrap().iter().find(|w| w["code"] == "orders-in-one-band");
    let text = warning.expect("a warning of its code").to_string();
    assert!(text.contains("7x and 7.144x lie in one pass band"), "{text}");
}

/// Order 2 through a resonance at 60 Hz (1800 rpm, passed within a second up and down) over measured pulses, beside a
/// steady order 7: the Vold-Kalman track, the cut of the resampled record, and sines fitted to three revolutions by least
/// squares, against the complex response of the oscillator, integrated beside the record.
#[test]
fn order_through_a_resonance_over_measured_pulses() {
    let Some((times, pulses)) = measured_pulses() else { return };
    let (rate, substeps) = (5120.0, 4);
    let (omega, zeta) = (TAU * 60.0, 0.03);
    let count = (pulses[pulses.len() - 1] * rate) as usize;
    let step = 1.0 / (rate * f64::from(substeps));
    let mut at = angle_between(&pulses);
    // Before the first pulse the shaft stands.
    let mut angle = |t: f64| if t < pulses[0] { 0.0 } else { at(t) };
    // z'' + 2 zeta omega z' + omega^2 z = omega^2 e^(2 j theta), by Runge-Kutta: z e^(-2 j theta) is the amplitude.
    let mut state = [Complex64::new(0.0, 0.0); 2];
    let drive = |theta: f64| Complex64::from_polar(1.0, 2.0 * theta);
    let slope =
        |[z, v]: [Complex64; 2], force: Complex64| [v, omega * omega * (force - z) - 2.0 * zeta * omega * v];
    let moved = |s: [Complex64; 2], k: [Complex64; 2], h: f64| [s[0] + h * k[0], s[1] + h * k[1]];
    let (mut x, mut theta, mut truth) = (Vec::new(), Vec::new(), Vec::new());
    for n in 0..count {
        let t = n as f64 / rate;
        let here = angle(t);
        x.push(state[0].re + 0.5 * (7.0 * here).cos());
        theta.push(here);
        truth.push(state[0] * Complex64::from_polar(1.0, -2.0 * here));
        for k in 0..substeps {
            let t = t + f64::from(k) * step;
            let [a, b, c] = [t, t + 0.5 * step, t + step].map(|t| drive(angle(t)));
            let k1 = slope(state, a);
            let k2 = slope(moved(state, k1, 0.5 * step), b);
            let k3 = slope(moved(state, k2, 0.5 * step), b);
            let k4 = slope(moved(state, k3, step), c);
            for (i, value) in state.iter_mut().enumerate() {
                *value += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.h5");
    let records = vec![Record::samples("A_ax", rate, 0.0, x.clone(), "m/s^2")];
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    let mut command = rotordyn();
    command.arg("signal").arg(&path).arg("--tacho").arg(&times).arg("--out").arg(folder.path().join("out"));
    command.args([
        "--analyses",
        "orders",
        "--orders",
        "2,7",
        "--bandwidth",
        "0.4",
        "--order-resolution",
        "0.1",
    ]);
    let document = json_of(command.arg("--no-figures"));
    let orders = &document["channels"][0]["orders"];
    let track = &orders["vold_kalman"]["tracks"][0];
    let time = numbers(&orders["vold_kalman"]["time"]);
    let (amplitude, phase) = (numbers(&track["amplitude"]), numbers(&track["phase_rad"]));
    // The angle of the command begins at the first pulse, as here; up to the end of the run-up.
    let places: Vec<(usize, usize)> = (0..time.len())
        .map(|k| (k, (time[k] * rate).round() as usize))
        .filter(|(_, n)| *n < truth.len())
        .collect();
    let peak_of = |range: std::ops::Range<f64>| {
        let within = places.iter().filter(|(k, _)| range.contains(&time[*k]));
        *within.max_by(|a, b| truth[a.1].norm().total_cmp(&truth[b.1].norm())).unwrap()
    };
    // Sines over the revolutions about a sample.
    let fitted = |n: usize, turns: f64| {
        let near: Vec<usize> =
            (0..count).filter(|&m| (theta[m] - theta[n]).abs() <= 0.5 * turns * TAU).collect();
        let mut normal = nalgebra::Matrix4::zeros();
        let mut right = nalgebra::Vector4::zeros();
        for &m in &near {
            let [two, seven] = [2.0, 7.0].map(|order| order * theta[m]);
            let row = nalgebra::Vector4::new(two.cos(), -two.sin(), seven.cos(), -seven.sin());
            normal += row * row.transpose();
            right += row * x[m];
        }
        let found = normal.cholesky().unwrap().solve(&right);
        Complex64::new(found[0], found[1])
    };
    let cuts = orders["cuts"].as_array().unwrap();
    let highest_cut = numbers(&cuts[0]["rms"]).into_iter().fold(0.0, f64::max) * 2f64.sqrt();
    let middle = 0.5 * (pulses[0] + pulses[pulses.len() - 1]);
    for (name, range) in [("up", 0.0..middle), ("down", middle..1e9)] {
        let (k, n) = peak_of(range);
        let tracked = Complex64::from_polar(amplitude[k], phase[k]);
        let sines = fitted(n, 3.0);
        let turned = |z: Complex64| (z / truth[n]).arg().to_degrees();
        let [error, of_sines] = [tracked, sines].map(|z| (z / truth[n] - 1.0).norm());
        let of_cut = (highest_cut / truth[n].norm() - 1.0).abs();
        println!(
            "{name} at {:.2} s: true {:.3}, tracked {:.3} {:+.1} deg, fitted {:.3} {:+.1} deg, highest cut {highest_cut:.3}",
            time[k],
            truth[n].norm(),
            tracked.norm(),
            turned(tracked),
            sines.norm(),
            turned(sines)
        );
        // In 0.4 orders, 2.5 revolutions, the amplitude changes by its curvature at the peak: some 2 %.
        assert!(error < 0.03 && turned(tracked).abs() < 3.0, "{name}: {tracked} {}", truth[n]);
        // Sines over three revolutions agree with it as far as the amplitude is constant over these, the cut of ten less.
        assert!(of_sines < 0.1 && of_sines > error, "{name}: {sines} {}", truth[n]);
        assert!(of_cut > 2.0 * error && of_cut < 0.2, "{name}: {highest_cut} {}", truth[n]);
    }
}
