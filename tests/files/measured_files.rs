//! Third-party measured records: CWRU bearings, modal test of a plane, tacho pulses of a run-up, beam FRFs.

use rotordyn::io::measured::read;
use rotordyn::signal::record::{Dof, Kind, MeasuredData, Points, Values};
use rotordyn::signal::statistics::statistics;

use crate::measured_data::measured;

#[test]
fn cwru_bearing_records() {
    for (file, number, rpm, length, rms, kurtosis) in [
        ("cwru/105_IR007_0hp_12k.mat", "105", 1797.0, 121_265, 0.29153, 5.396),
        ("cwru/130_OR007at6_0hp_12k.mat", "130", 1796.0, 121_991, 0.66951, 7.649),
    ] {
        let Some(path) = measured(file) else { return };
        let mut found = read(&path).unwrap();
        let names: Vec<&str> = found.records.iter().map(|r| r.name.as_str()).collect();
        let wanted = ["DE", "FE", "BA"].map(|place| format!("X{number}_{place}_time"));
        assert_eq!(names, wanted);
        assert_eq!(found.scalars, [(format!("X{number}RPM"), rpm)]);
        let drive_end = found.record(&wanted[0]).unwrap();
        assert_eq!((drive_end.values.len(), drive_end.speed_rpm), (length, Some(rpm)));
        // The file states neither rate nor unit.
        let text = drive_end.sample_rate().unwrap_err().to_string();
        assert!(text.contains("does not state its sampling rate; give it, such as \"12 kHz\""), "{text}");
        assert!(drive_end.si_unit().is_err());
        found.set_missing_rate(12000.0);
        let drive_end = found.record(&wanted[0]).unwrap();
        assert_eq!(drive_end.sample_rate(), Ok(12000.0));
        // To the digits of the data set's README, in g as stored.
        let of = statistics(drive_end.time_samples().unwrap()).unwrap();
        assert!((of.rms - rms).abs() < 5e-6, "{}", of.rms);
        let found = of.kurtosis.unwrap();
        assert!((found - kurtosis).abs() < 5e-4, "{found}");
    }
}

#[test]
fn analyser_file_with_blocks_spectra_and_frfs() {
    let Some(path) = measured("plane_ema/lab1_DPsv00001.mat") else { return };
    let found = read(&path).unwrap();
    assert_eq!(found.records.len(), 35);
    let force = found.record("X1").unwrap();
    assert_eq!((force.kind, force.unit.as_str(), force.values.len()), (Kind::Time, "N", 8192));
    assert_eq!(force.axis.points, Points::Uniform { start: -0.009765625, step: 1.0 / 512.0 });
    let response = found.record("X2").unwrap();
    assert_eq!((response.unit.as_str(), response.response), ("m/s^2", Dof::new(2, 0)));
    // g in the file.
    assert!((response.time_samples().unwrap()[0] / 9.80665 - 0.12508522).abs() < 1e-8);
    let frf = found.record("H1_2").unwrap();
    assert_eq!((frf.kind, frf.unit.as_str()), (Kind::Frf, "(m/s^2)/N"));
    assert_eq!((frf.response, frf.reference), (Dof::new(2, 0), Dof::new(1, 0)));
    assert_eq!((frf.file_unit.as_str(), frf.axis.points(3201).unwrap()[3200]), ("g / N", 200.0));
    let matrix = found.frf_matrix().unwrap();
    assert_eq!((matrix.responses.len(), matrix.references.len()), (3, 1));
    let coherence = matrix.coherence.unwrap();
    assert!(coherence.iter().flatten().flatten().all(|c| (0.0..=1.0 + 1e-9).contains(c)));
    assert!((matrix.values[0][0][0].re / 9.80665 - 2.43418503).abs() < 1e-8);
}

#[test]
fn frfs_of_74_hits_and_3_accelerometers() {
    let Some(path) = measured("plane_ema/lab2_frf.npz") else { return };
    let found = read(&path).unwrap();
    let matrix = found.frf_matrix().unwrap();
    assert_eq!((matrix.responses.len(), matrix.references.len(), matrix.frequencies.len()), (74, 3, 1601));
    assert_eq!((matrix.frequencies[1], matrix.frequencies[1600]), (0.125, 200.0));
    assert!(matrix.coherence.is_some());
    let hit = found.record("H[5,2]").unwrap();
    assert_eq!((hit.response.node, hit.reference.node), (5, 2));
}

#[test]
fn tacho_pulses_of_a_run_up() {
    let (Some(times), Some(speeds)) =
        (measured("tacho_run_up/time_s.csv"), measured("tacho_run_up/speed_rpm.csv"))
    else {
        return;
    };
    let one = |found: &MeasuredData| match &found.records[0].values {
        Values::Real(values) => values.clone(),
        Values::Complex(_) => panic!(),
    };
    let (times, speeds) = (read(&times).unwrap(), read(&speeds).unwrap());
    assert_eq!((times.records[0].name.as_str(), times.records[0].unit.as_str()), ("time", "s"));
    assert_eq!((speeds.records[0].name.as_str(), speeds.records[0].unit.as_str()), ("speed", "rpm"));
    let (t, n) = (one(&times), one(&speeds));
    assert_eq!((t.len(), n.len()), (489, 489));
    // Speed in rpm is 60 s over the interval before the pulse.
    assert!(t.windows(2).zip(&n[1..]).all(|(t, n)| ((t[1] - t[0]) * n / 60.0 - 1.0).abs() < 1e-3));
}

#[test]
fn beam_frfs_as_complex_text() {
    let peaks = [52, 142, 279, 460, 687, 959];
    for file in ["meas_point_1.txt", "meas_point_2.txt", "meas_point_3.txt"] {
        let Some(path) = measured(&format!("uff/{file}")) else { return };
        let mut found = read(&path).unwrap();
        found.set_missing_frequency_step(1.0);
        let frf = found.records[0].frf().unwrap();
        assert_eq!(frf.len(), 1001);
        // Resonances of the free-free beam are peaks of magnitude here, except modes with a node at the
        // point.
        let is_peak = |k: usize| {
            (k - 3..=k + 3)
                .all(|j| frf[j].norm() <= frf[k - 1..=k + 1].iter().map(|h| h.norm()).fold(0.0, f64::max))
        };
        let seen = peaks.iter().filter(|&&k| is_peak(k)).count();
        assert!(seen >= 4, "{file}: {seen}");
    }
}
