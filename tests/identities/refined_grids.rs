//! FRFs and unbalance responses on refined grids, against brute force on fine ones.

use crate::modal_damping::{CROSS, ISOTROPIC, RATIO, TABLE, overhung};
use rotordyn::io::machine_records::frf_records;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{FrfStudy, UnbalanceStudy};
use rotordyn::results::{FrfResult, UnbalanceResult};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

const RPM: f64 = TAU / 60.0;

/// Largest amplitude of the first probe in a range of speeds.
fn largest(found: &UnbalanceResult, range: [f64; 2]) -> f64 {
    let inside = |speed: &f64| (range[0]..=range[1]).contains(speed);
    let sizes = found.speeds.iter().zip(&found.channels[0].amplitude);
    sizes.filter(|(speed, _)| inside(speed)).map(|(_, [re, im])| re.hypot(*im)).fold(0.0, f64::max)
}

fn fine(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}

#[test]
fn every_peak_of_a_coarse_grid_is_that_of_a_fine_one() {
    for (name, bearings, ratio) in [
        ("cross", CROSS, RATIO),
        ("table", TABLE, RATIO),
        ("isotropic", ISOTROPIC, RATIO),
        ("light", ISOTROPIC, "[2e-4, 1e-3]"),
    ] {
        let machine = Machine::new(overhung(6, bearings, ratio)).unwrap();
        let study = machine.model.studies.unbalance.clone().unwrap();
        let run = |speeds: Vec<f64>, refine: bool| {
            machine.unbalance(&UnbalanceStudy { speeds, refine, ..study.clone() }).unwrap()
        };
        let grid = fine(300.0 * RPM, 9000.0 * RPM, 7);
        let found = run(grid.clone(), true);
        assert!(found.requested.iter().zip(&grid).all(|(&k, speed)| found.speeds[k] == *speed));
        let peaks: Vec<_> = found.peaks.iter().filter(|p| p.response == "wheel_x").collect();
        println!("{name}: {} points, {peaks:?}", found.speeds.len());
        assert!(!peaks.is_empty(), "{name}");
        // No peak of a fine grid over the whole range is missing.
        let whole = run(fine(300.0 * RPM, 9000.0 * RPM, 1500), false);
        let top = largest(&found, [0.0, 1e9]);
        assert!(top > 0.999 * largest(&whole, [0.0, 1e9]), "{name}");
        for own in whole.peaks.iter().filter(|p| p.response == "wheel_x") {
            let near = peaks.iter().any(|p| (p.peak.at - own.peak.at).abs() < 10.0 * RPM);
            assert!(near, "{name}: {own:?} is missing in {peaks:?}");
        }
        for found_peak in peaks {
            let peak = found_peak.peak;
            let Some([low, high]) = peak.half_power else { continue };
            // Half-power points and amplitude by brute force around the peak.
            let around = run(fine(low - 0.2 * (high - low), high + 0.2 * (high - low), 1201), false);
            let exact = largest(&around, [0.0, 1e9]);
            assert!((peak.amplitude / exact - 1.0).abs() < 1e-3, "{name}: {peak:?} {exact}");
            assert!((largest(&found, [low, high]) / exact - 1.0).abs() < 1e-3, "{name}: {peak:?} {exact}");
            let above: Vec<f64> = around
                .speeds
                .iter()
                .zip(&around.channels[0].amplitude)
                .filter(|(_, [re, im])| re.hypot(*im) >= exact / 2f64.sqrt())
                .map(|(speed, _)| *speed)
                .collect();
            let width = above[above.len() - 1] - above[0];
            let factor = peak.at / width;
            // The brute-force grid resolves the width to 2/858.
            let amplification = peak.amplification().unwrap();
            assert!((amplification / factor - 1.0).abs() < 5e-3, "{name}: {amplification} {factor}");
        }
    }
}

/// FRFs of a coarse grid have the peaks of a fine one; exports have the requested, equally spaced frequencies.
#[test]
fn frf_peaks_and_exports() {
    let machine = Machine::new(overhung(8, CROSS, "[1e-3, 4e-3]")).unwrap();
    let study = machine.model.studies.frf.clone().unwrap();
    let run = |frequencies: Vec<f64>, refine: bool| -> FrfResult {
        machine.frf(&FrfStudy { frequencies, refine, ..study.clone() }).unwrap()
    };
    let coarse: Vec<f64> = (0..25).map(|k| 4.0 + 16.0 * f64::from(k)).collect();
    let found = run(coarse.clone(), true);
    let peak = |h: &FrfResult| h.frf.values[0][0].iter().map(Complex64::norm_sqr).fold(0.0, f64::max).sqrt();
    let at = (0..found.frf.frequencies.len())
        .max_by(|&a, &b| found.frf.values[0][0][a].norm().total_cmp(&found.frf.values[0][0][b].norm()))
        .map(|k| found.frf.frequencies[k])
        .unwrap();
    let exact = peak(&run(fine(0.98 * at, 1.02 * at, 8001), false));
    let error = peak(&found) / exact - 1.0;
    let unrefined = peak(&run(coarse.clone(), false)) / exact - 1.0;
    println!("refined {error:.1e}, not refined {unrefined:.1e}, {} points", found.frf.frequencies.len());
    assert!(error.abs() < 1e-3 && unrefined < -0.1, "{error:e} {unrefined:e}");
    assert!(found.undamped.is_empty());

    let records = frf_records(&found, &machine);
    assert_eq!(records.records[0].axis.points(coarse.len()).unwrap(), coarse);
    let plain = run(coarse, false);
    let exported = found.at_requested();
    assert_eq!(exported.frf.frequencies, plain.frf.frequencies);
    for (a, b) in exported.frf.values[0][0].iter().zip(&plain.frf.values[0][0]) {
        assert!((a - b).norm() <= 1e-12 * b.norm());
    }
}
