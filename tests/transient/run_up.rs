//! Run-up of the rig: spectrogram ridges on the lines of linear theory, energy balance, halved step.

use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::model::study::{CampbellStudy, OrderStudy, RunUpStudy, SpectrogramStudy, WindowKind};
use rotordyn::results::{History, SpectrogramResult};
use rotordyn::study::{Machine, Recorder};
use rotordyn::transient::run::{End, Report};

const TAU: f64 = std::f64::consts::TAU;
const RPM: f64 = std::f64::consts::PI / 30.0;

fn run(machine: &Machine, step: f64) -> (History, Report) {
    let study = RunUpStudy { step, ..machine.model.studies.run_up.clone().expect("the rig has a run-up") };
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    (recorder.into_history(), report)
}

/// Amplitudes of a frame.
fn row(found: &SpectrogramResult, frame: usize) -> Vec<f64> {
    let bins = found.spectrogram.frequencies.len();
    found.spectrogram.amplitude.read(frame * bins..(frame + 1) * bins).unwrap().into_owned()
}

fn spectrogram_study(channel: &str) -> SpectrogramStudy {
    SpectrogramStudy {
        channels: vec![channel.into()],
        window: WindowKind::Hann,
        length: 1.0,
        overlap: 0.9,
        max_frequency: 250.0,
        dynamic_range_db: 80.0,
        orders: vec![1.0],
    }
}

#[test]
fn synchronous_ridge_energy_balance_and_step_size() {
    let machine = Machine::new(variant(None, &[])).unwrap();
    let (history, report) = run(&machine, 2.5e-5);
    // Work: a matrix serves as long as (Ω − Ω_f) h < 3e-4, 12 rad/s here, on the way to 125.7 rad/s; from the
    // extrapolated force most steps take one Newton iteration.
    assert!((10..=12).contains(&report.refactored), "{report:?}");
    assert!((1.0..1.3).contains(&(report.iterations as f64 / report.steps as f64)), "{report:?}");
    let e = report.energy;
    println!("{report:?} {}", e.residual() / e.exchanged());
    assert!(e.residual().abs() < 1e-4 * e.exchanged(), "{} of {}", e.residual(), e.exchanged());

    // 1x of the disc: the strongest line at every speed above the noise of the start, within one bin.
    let shown = &machine.spectrograms(&spectrogram_study("disc_x"), &history).unwrap()[0];
    let bin = shown.spectrogram.frequencies[1];
    let mut frames = 0;
    for (frame, speed) in shown.speed.iter().enumerate() {
        let hz = speed / TAU;
        if hz < 6.0 {
            continue;
        }
        let row = row(shown, frame);
        // BPFO passes through the first bending pair below 500 rpm: search 1x near its frequency only.
        let near: Vec<usize> =
            (0..row.len()).filter(|k| (shown.spectrogram.frequencies[*k] - hz).abs() < 0.3 * hz).collect();
        let strongest = near.into_iter().max_by(|a, b| row[*a].total_cmp(&row[*b])).unwrap();
        let found = shown.spectrogram.frequencies[strongest];
        assert!((found - hz).abs() <= bin, "{found} Hz at {hz} rev/s");
        frames += 1;
    }
    assert!(frames > 50);

    // Halving the step changes every order cut by less than 1 %.
    let (finer, _) = run(&machine, 1.25e-5);
    let study = OrderStudy {
        channels: vec!["B_ax".into(), "B_ay".into(), "disc_x".into(), "disc_y".into()],
        resolution: 0.05,
        max_order: 20.0,
        max_order_is_default: false,
        overlap: 0.75,
        window: WindowKind::Hann,
        cuts: vec![1.0, 2.0],
        bandwidth: None,
    };
    let (coarse, fine) = (machine.orders(&study, &history).unwrap(), machine.orders(&study, &finer).unwrap());
    for (a, b) in coarse.iter().zip(&fine) {
        for ((line, p), (_, q)) in a.cuts.iter().zip(&b.cuts) {
            let scale = q.rms.iter().copied().fold(0.0, f64::max);
            let worst = p.rms.iter().zip(&q.rms).map(|(x, y)| (x - y).abs() / scale).fold(0.0, f64::max);
            println!("{} {}: {scale:.3e}, changes by {worst:.2e}", a.channel, line.label);
            assert!(worst < 0.01, "{} {}: {worst}", a.channel, line.label);
        }
    }
}

#[test]
fn second_bending_pair_follows_the_campbell_lines() {
    let machine = Machine::new(variant(Some("wavy"), &[])).unwrap();
    let (history, report) = run(&machine, 2.5e-5);
    let e = report.energy;
    println!("{} {}", e.residual(), e.exchanged());
    assert!(e.residual().abs() < 1e-4 * e.exchanged(), "{} of {}", e.residual(), e.exchanged());
    let study = CampbellStudy {
        speeds: (0..=24).map(|k| 50.0 * RPM * f64::from(k)).collect(),
        modes: 8,
        orders: vec![7.0, 8.0, 9.0],
        speed_dependent_bearings: false,
    };
    let campbell = machine.campbell(&study).unwrap();
    let pair: Vec<_> = campbell
        .diagram
        .branches
        .iter()
        .filter(|b| b.kind.is_bending() && (100.0..170.0).contains(&(b.omega(24).unwrap() / TAU)))
        .collect();
    assert_eq!(pair.len(), 2);
    let shown = SpectrogramStudy { length: 0.5, overlap: 0.95, ..spectrogram_study("B_ax") };
    let shown = &machine.spectrograms(&shown, &history).unwrap()[0];
    let axis = &shown.spectrogram.frequencies;
    for branch in pair {
        // Level along the branch, and the bin of the strongest line within 8 Hz of it.
        let mut along: Vec<(f64, f64, f64)> = Vec::new();
        for (frame, speed) in shown.speed.iter().enumerate() {
            let x = speed / (50.0 * RPM);
            let k = (x as usize).min(23);
            let (a, b) = (branch.omega(k).unwrap(), branch.omega(k + 1).unwrap());
            let hz = (a + (x - k as f64) * (b - a)) / TAU;
            let row = row(shown, frame);
            let level = |k: &usize| row[*k];
            let within = |width: f64| (0..row.len()).filter(move |k| (axis[*k] - hz).abs() <= width);
            let strongest = within(8.0).max_by(|p, q| row[*p].total_cmp(&row[*q])).expect("bins within 8 Hz");
            let on_line = within(axis[1]).map(|k| level(&k)).fold(0.0, f64::max);
            along.push((speed / RPM, on_line, (axis[strongest] - hz) / axis[1]));
        }
        // Excited: where the level along the branch peaks over half a second, well above the median.
        let mut levels: Vec<f64> = along.iter().filter(|p| p.0 > 300.0).map(|p| p.1).collect();
        levels.sort_by(f64::total_cmp);
        let median = levels[levels.len() / 2];
        let mut excited = 0;
        for k in 10..along.len() - 10 {
            let (rpm, level, off) = along[k];
            let top = along[k - 10..=k + 10].iter().all(|p| p.1 <= level);
            if top && level > 2.0 * median && rpm < 1190.0 {
                println!("{}: {rpm:.0} rpm, {level:.2e} m/s^2, {off:+.2} bins off", branch.label);
                assert!(off.abs() <= 1.0, "{} at {rpm:.0} rpm: ridge {off} bins off", branch.label);
                excited += 1;
            }
        }
        assert!(excited >= 2, "{} is excited {excited} times", branch.label);
    }

    // The crossings of 7x, 8x and 9x with the pair are peaks of their order cuts.
    let study = OrderStudy {
        channels: vec!["B_ax".into()],
        resolution: 0.05,
        max_order: 12.0,
        max_order_is_default: false,
        overlap: 0.75,
        window: WindowKind::Hann,
        cuts: vec![7.0, 8.0, 9.0],
        bandwidth: None,
    };
    let orders = &machine.orders(&study, &history).unwrap()[0];
    for (line, cut) in &orders.cuts {
        let crossings: Vec<f64> = campbell
            .crossings
            .list
            .iter()
            .filter(|c| c.order == line.order && c.mode.omega() > 100.0 * TAU && c.mode.kind.is_bending())
            .map(|c| c.speed / RPM)
            .collect();
        assert!(!crossings.is_empty());
        let below = |rpm: f64| (500.0..750.0).contains(&rpm);
        let quiet: Vec<f64> =
            cut.rpm.iter().zip(&cut.rms).filter(|(rpm, _)| below(**rpm)).map(|(_, rms)| *rms).collect();
        let quiet = quiet.iter().sum::<f64>() / quiet.len() as f64;
        for crossing in crossings {
            let near = cut.rpm.iter().zip(&cut.rms).filter(|(rpm, _)| (**rpm - crossing).abs() < 40.0);
            let level = near.map(|(_, rms)| *rms).fold(0.0, f64::max);
            println!("{} at {crossing:.0} rpm: {:.1} times its level below", line.label, level / quiet);
            assert!(level > 3.0 * quiet, "{} at {crossing} rpm: {level} over {quiet}", line.label);
        }
    }
}
