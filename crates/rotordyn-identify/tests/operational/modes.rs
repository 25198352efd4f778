//! All modes are found, and nothing else.

use std::f64::consts::TAU;

use rotordyn_identify::mac::mac;
use rotordyn_identify::operational::{OperationalModes, OperationalSettings, identify_operational};
use rotordyn_linalg::Complex64;

use crate::machine::{Machine, rms};

pub fn print(found: &OperationalModes) {
    for m in &found.modes {
        println!(
            "{:9.4} ± {:.4} Hz  {:.4} ± {:.4} %  MPC {:.3}  support {:.2}  order {}  part {:.1e} {:?}",
            m.frequency_hz(),
            m.frequency_error,
            100.0 * m.damping_ratio(),
            100.0 * m.damping_error,
            m.collinearity,
            m.support,
            m.order,
            m.contribution,
            m.notes,
        );
    }
    println!(
        "dropped {:#?}\nwarnings {:#?}\nharmonics {:#?}",
        found.dropped, found.warnings, found.harmonics
    );
}

/// Modes of the machine in the order of frequency; panics unless the found ones are these.
pub fn check(machine: &Machine, found: &OperationalModes) {
    check_shapes(machine, found, 0.98);
}

fn check_shapes(machine: &Machine, found: &OperationalModes, least_mac: f64) {
    print(found);
    assert_eq!(found.modes.len(), machine.modes.len());
    for (k, m) in found.modes.iter().enumerate() {
        let (_, zeta, shape) = &machine.modes[k];
        let off = (m.frequency_hz() - machine.hz(k)).abs();
        assert!(off < 4.0 * m.frequency_error && off < 5e-3 * machine.hz(k), "mode {k}: {off:.4} Hz");
        let off = (m.damping_ratio() - zeta).abs();
        assert!(off < 4.0 * m.damping_error && off < 0.5 * zeta, "mode {k}: damping {off:.5}");
        let shape: Vec<Complex64> = shape.iter().map(|v| Complex64::from(*v)).collect();
        let like = mac(&m.shape, &shape);
        assert!(like > least_mac, "mode {k}: MAC {like:.4}");
        assert!(m.contribution > 0.0 && m.contribution < 1.5, "mode {k}: part {:.3}", m.contribution);
    }
}

/// Five modes of 0.3 to 3 % in 600 s, white and coloured forces.
#[test]
fn modes_of_a_machine_under_random_forces() {
    let modes = [(12.0, 0.01), (31.0, 0.006), (47.0, 0.02), (61.0, 0.003), (88.0, 0.03)];
    for (seed, colour) in [(1, 0.0), (2, 0.0), (3, 0.7), (4, 0.7)] {
        let machine = Machine { colour, ..Machine::new(&modes, 6, 256.0, 600.0) };
        let found = identify_operational(&machine.record(seed), &OperationalSettings::default()).unwrap();
        check(&machine, &found);
        assert!(found.warnings.is_empty(), "{:?}", found.warnings);
        // The quick look has a peak at every mode, of its shape.
        for (k, (_, zeta, shape)) in machine.modes.iter().enumerate() {
            let shape: Vec<Complex64> = shape.iter().map(|v| Complex64::from(*v)).collect();
            let width = (zeta * machine.hz(k)).max(0.3);
            let peak = found.spectrum.peaks.iter().find(|p| (p.frequency - machine.hz(k)).abs() < width);
            let like = peak.map_or(0.0, |p| mac(&p.shape, &shape));
            println!("peak of mode {k}: {:?}, MAC {like:.3}", peak.map(|p| p.frequency));
            assert!(like > 0.9, "mode {k}");
        }
    }
}

/// A pair 1 % apart at 1 % damping whose peaks are one, with different shapes. The separation is half a half-power bandwidth, so
/// that over 900 s the shapes scatter by some tenths of each other.
#[test]
fn close_pair() {
    for seed in 1..=4 {
        let machine = Machine::new(&[(40.0, 0.01), (40.4, 0.01), (70.0, 0.005)], 6, 200.0, 900.0);
        let found = identify_operational(&machine.record(seed), &OperationalSettings::default()).unwrap();
        // A bandwidth apart, the shapes of both mix within their standard errors: 0.95 and more seen.
        check_shapes(&machine, &found, 0.85);
    }
}

/// The band: the record is decimated, and only modes inside are returned, with the same values.
#[test]
fn modes_of_a_band() {
    let machine =
        Machine::new(&[(30.0, 0.01), (180.0, 0.01), (420.0, 0.01), (900.0, 0.008)], 4, 2560.0, 120.0);
    let settings = OperationalSettings { band: Some([100.0, 500.0]), ..Default::default() };
    let found = identify_operational(&machine.record(5), &settings).unwrap();
    assert!((found.sample_rate - 1300.0).abs() < 2.0, "{}", found.sample_rate);
    let inside = Machine { modes: machine.modes[1..3].to_vec(), ..machine };
    check(&inside, &found);
}

/// A record of 40 time constants of the lowest mode says so; a mode that it does determine has no note.
#[test]
fn short_record_is_named() {
    let machine = Machine::new(&[(10.0, 0.005), (45.0, 0.02)], 4, 128.0, 100.0);
    let found = identify_operational(&machine.record(7), &OperationalSettings::default()).unwrap();
    print(&found);
    let low = |w: &&String| w.contains("too short a record") || w.contains("short record: the mode at");
    let text = found.warnings.iter().find(low).unwrap();
    assert!(text.contains("at 10.") || text.contains("at 9.9"), "{text}");
    let high = found.modes.iter().find(|m| (m.frequency_hz() - 45.0).abs() < 1.0).unwrap();
    assert!(high.notes.is_empty() && found.warnings.len() == 1, "{:?}", found.warnings);
}

/// Displacements at two points and velocities at four: the shapes are those of one quantity, with their phase.
#[test]
fn shapes_of_displacements_and_velocities() {
    let modes = [(12.0, 0.01), (31.0, 0.006), (47.0, 0.02)];
    let machine = Machine { displacements: 2, ..Machine::new(&modes, 6, 160.0, 600.0) };
    let found = identify_operational(&machine.record(7), &OperationalSettings::default()).unwrap();
    check(&machine, &found);
    for (k, (_, zeta, shape)) in machine.modes.iter().enumerate() {
        let shape: Vec<Complex64> = shape.iter().map(|v| Complex64::from(*v)).collect();
        let width = (zeta * machine.hz(k)).max(0.3);
        let peak = found.spectrum.peaks.iter().find(|p| (p.frequency - machine.hz(k)).abs() < width).unwrap();
        assert!(mac(&peak.shape, &shape) > 0.9, "peak of mode {k}");
    }
}

/// Two weak low modes below strong ones of ten times their frequency: the band is taken apart where their peaks are left over.
#[test]
fn weak_low_modes_of_a_wide_band() {
    let modes = [(24.0, 0.005), (29.0, 0.005), (160.0, 0.012), (222.0, 0.03), (300.0, 0.04), (380.0, 0.02)];
    let mut machine = Machine::new(&modes, 8, 1000.0, 400.0);
    machine.modes[..2].iter_mut().for_each(|(_, _, shape)| shape.iter_mut().for_each(|v| *v *= 0.25));
    machine.sensor_noise = 0.01;
    let found = identify_operational(&machine.record(9), &OperationalSettings::default()).unwrap();
    check(&machine, &found);
}

/// A free decay of 60 times the usual level at the start, as of a machine switched on: left out, so that it moves no mode.
#[test]
fn transient_at_the_start() {
    let modes = [(12.0, 0.01), (31.0, 0.006), (47.0, 0.02)];
    let machine = Machine::new(&modes, 6, 160.0, 600.0);
    let mut record = machine.record(10);
    for (channel, shape) in record.samples.iter_mut().zip(&machine.modes[0].2) {
        let level = 60.0 * rms(channel) * shape;
        for (k, x) in channel.iter_mut().enumerate() {
            let t = k as f64 / machine.rate;
            // Near the first mode, and not of it.
            *x += level * (-t / 3.0).exp() * (TAU * 12.4 * t).cos();
        }
    }
    let found = identify_operational(&record, &OperationalSettings::default()).unwrap();
    check(&machine, &found);
    assert!((6.0..60.0).contains(&found.left_out), "{}", found.left_out);
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
}
