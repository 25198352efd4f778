//! Hits of an impact test: found in a record, and their quality.

use rotordyn_signal::SignalError;
use rotordyn_signal::impact::{Hit, ImpactTest, Limits, Trigger, frfs, inspect};
use rotordyn_signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Record, Values};

use crate::noise;

/// A half-sine of `length` samples from `at` on, added to a record.
fn strike(record: &mut [f64], at: usize, length: usize, peak: f64) {
    for n in 0..length {
        record[at + n] += peak * (std::f64::consts::PI * (n as f64 + 0.5) / length as f64).sin();
    }
}

/// Decay after a hit at `at`.
fn ring(n: usize, at: usize, samples: f64) -> Vec<f64> {
    let value = |k: f64| if k < 0.0 { 0.0 } else { (0.3 * k).sin() * (-k / samples).exp() };
    (0..n).map(|k| value(k as f64 - at as f64)).collect()
}

#[test]
fn hits_are_found_in_a_long_record() {
    let mut force: Vec<f64> = noise(5, 10_000).iter().map(|v| 0.01 * v).collect();
    for (at, peak) in [(500, 80.0), (3_000, 120.0), (3_060, 60.0), (6_000, 90.0), (9_500, 100.0)] {
        strike(&mut force, at, 8, peak);
    }
    let trigger = Trigger { level: 0.3, before: 20, length: 2_000 };
    let found = trigger.find(&force).unwrap();
    // Each begins where the force passes 36 N, within two samples; the last one's block is not whole.
    let starts: Vec<usize> = found.iter().map(|r| r.start).collect();
    assert!(starts.iter().zip([481, 2_980, 5_981]).all(|(a, b)| a.abs_diff(b) <= 2), "{starts:?}");
    assert!(found.len() == 3 && found.iter().all(|r| r.len() == 2_000));
    assert_eq!(trigger.find(&[0.0; 50]).unwrap(), []);
    // A hit at the very start has no samples before it.
    let early = Trigger { level: 0.5, before: 5, length: 10 }
        .find(&[9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(early.unwrap()[0], 0..10);
}

#[test]
fn contact_of_a_usable_hit() {
    let mut force = vec![0.0; 4_000];
    strike(&mut force, 100, 9, -50.0);
    // An anti-aliasing filter rings with changing sign.
    force[97..100].copy_from_slice(&[-4.0, 7.0, 9.0]);
    force[109..112].copy_from_slice(&[8.0, -5.0, 3.0]);
    let response = ring(4_000, 104, 300.0);
    let hit = Hit { force: &force, response: &response };
    let quality = inspect(&hit, &Limits::default(), None).unwrap();
    assert_eq!(quality.peak, (104, -50.0));
    assert_eq!(quality.contact, 100..109);
    assert!(quality.is_good() && !quality.truncated && quality.faults().is_empty(), "{quality:?}");
}

#[test]
fn double_hits_overloads_and_truncated_decays_are_reported() {
    let clean = ring(4_000, 100, 300.0);
    let mut single = vec![0.0; 4_000];
    strike(&mut single, 100, 9, 50.0);
    let limits = Limits::default();
    let look = |force: &[f64], response: &[f64], limits: &Limits| {
        inspect(&Hit { force, response }, limits, None).unwrap()
    };

    // A second hit of 30 %, before or after the first.
    for at in [40, 112, 700] {
        let mut double = single.clone();
        strike(&mut double, at, 9, 15.0);
        let quality = look(&double, &clean, &limits);
        assert!(
            quality.double_hit.is_some_and(|n| (at..at + 9).contains(&n)) && !quality.is_good(),
            "{quality:?}"
        );
        assert!(quality.faults()[0].ends_with("repeat the hit"));
        let generous = Limits { double_hit: 0.4, ..limits };
        assert!(look(&double, &clean, &generous).is_good());
    }

    // Clipped by the converter: three samples at the top; or beyond a range that is known.
    let clipped: Vec<f64> = single.iter().map(|f| f.min(40.0)).collect();
    let quality = look(&clipped, &clean, &limits);
    assert!(quality.overload[0].is_some_and(|n| (100..109).contains(&n)) && quality.overload[1].is_none());
    assert!(quality.faults()[0].contains("overload of the force"), "{:?}", quality.faults());
    let clipped: Vec<f64> = clean.iter().map(|x| x.clamp(-0.5, 0.5)).collect();
    let quality = look(&single, &clipped, &limits);
    assert!(quality.overload[0].is_none() && quality.overload[1].is_some());
    let known = Limits { full_scale: [Some(60.0), Some(0.9)], ..limits };
    let quality = look(&single, &clean, &known);
    assert!(quality.overload[0].is_none() && quality.overload[1].is_some_and(|n| clean[n].abs() >= 0.9));

    // A decay that the block cuts off, and an exponential window that ends it.
    let long = ring(4_000, 100, 4_000.0);
    let quality = look(&single, &long, &limits);
    assert!(quality.is_good() && quality.truncated && (0.2..0.4).contains(&quality.residual), "{quality:?}");
    assert!(quality.faults()[0].contains("take longer blocks or an exponential window"));
    let window: Vec<f64> = (0..4_000).map(|n| (-f64::from(n) / 1_000.0).exp()).collect();
    let hit = Hit { force: &single, response: &long };
    assert!(!inspect(&hit, &limits, Some(&window)).unwrap().truncated);
}

#[test]
fn unusable_records_are_errors() {
    let trigger = Trigger { level: 0.1, before: 0, length: 10 };
    assert!(matches!(trigger.find(&[f64::NAN]), Err(SignalError::NotFinite { .. })));
    assert!(Trigger { level: 1.5, ..trigger }.find(&[1.0]).is_err());
    assert!(Trigger { length: 0, ..trigger }.find(&[1.0]).is_err());
    assert!(Trigger { before: 10, ..trigger }.find(&[1.0]).is_err());
    let refuse = |force: &[f64], response: &[f64]| {
        inspect(&Hit { force, response }, &Limits::default(), None).unwrap_err()
    };
    assert!(matches!(refuse(&[0.0; 4], &[1.0; 4]), SignalError::OutOfRange { name: "largest force", .. }));
    assert!(matches!(refuse(&[1.0; 4], &[1.0; 3]), SignalError::LengthMismatch { .. }));
    assert!(matches!(refuse(&[], &[]), SignalError::Empty { .. }));
}

/// Three hits of a hammer, and a response of two modes, with offsets of both channels.
fn test_record(offsets: [f64; 2], rate: f64) -> MeasuredData {
    let n = 12_000;
    let mut force: Vec<f64> = noise(3, n).iter().map(|v| 0.001 * v + offsets[0]).collect();
    let mut response = vec![offsets[1]; n];
    for at in [1_000, 4_500, 8_000] {
        strike(&mut force, at, 6, 100.0);
        for (k, own) in response[at..].iter_mut().enumerate() {
            let k = k as f64;
            *own += (0.13 * k).sin() * (-k / 250.0).exp() + 2.0 * (0.7 * k).sin() * (-k / 100.0).exp();
        }
    }
    let channel = |name: &str, values: Vec<f64>, unit: &str| {
        let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / rate);
        Record::new(name, Kind::Time, axis, Values::Real(values), unit)
    };
    let records = vec![channel("hammer", force, "N"), channel("p1", response, "m/s^2")];
    MeasuredData { records, ..MeasuredData::default() }
}

/// An offset of the force of 20 % of the hit, or one of the response with an exponential window, leaves the FRF as it is.
#[test]
fn offsets_of_the_channels_do_not_change_the_frf() {
    let rate = 2048.0;
    for time_constant in [None, Some(0.3)] {
        let test = ImpactTest { block: Some(1.5), time_constant, ..ImpactTest::default() };
        let frf = |offsets: [f64; 2]| {
            let (records, _) = frfs(&[test_record(offsets, rate)], &test).unwrap();
            let record = records.into_iter().find(|r| r.kind == Kind::Frf).unwrap();
            record.frf().unwrap().to_vec()
        };
        let plain = frf([0.0, 0.0]);
        let largest = plain.iter().skip(3).map(|h| h.norm()).fold(0.0, f64::max);
        for offsets in [[20.0, 0.0], [-5.0, 0.0], [0.0, 30.0]] {
            let off =
                frf(offsets).iter().zip(&plain).skip(3).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            // The noise of the force leaves the offset uncertain; not removed, -5 N change the FRF by as much as it is,
            // and with 20 N no hit is found.
            assert!(off < 2e-4 * largest, "{time_constant:?}, {offsets:?}: {off} of {largest}");
        }
    }
}

/// AC coupling of all channels takes the same from force and response: their ratio stays, if the force keeps its undershoot. Noise
/// and offsets make none.
#[test]
fn ac_coupled_channels_do_not_change_the_frf() {
    let rate = 2048.0;
    let test = ImpactTest { block: Some(1.5), ..ImpactTest::default() };
    let frf = |corner_hz: f64| {
        let mut record = test_record([0.0, 0.0], rate);
        let keeps = 1.0 / (1.0 + std::f64::consts::TAU * corner_hz / rate);
        for channel in &mut record.records {
            let Values::Real(values) = &mut channel.values else { panic!() };
            let (mut before, mut out) = (values[0], 0.0);
            for v in values.iter_mut() {
                out = keeps * (out + *v - before);
                before = std::mem::replace(v, out);
            }
        }
        let (records, warnings) = frfs(&[record], &test).unwrap();
        let frf = records.into_iter().find(|r| r.kind == Kind::Frf).unwrap().frf().unwrap().to_vec();
        (frf, warnings.iter().any(|text| text.contains("AC-coupled")))
    };
    let (plain, named) = frf(0.0);
    assert!(!named);
    // 4 to 250 Hz, half of the frequency at which the hits have no power.
    let lines = 6..375;
    let largest = plain[lines.clone()].iter().map(|h| h.norm()).fold(0.0, f64::max);
    for corner in [0.3, 1.0, 3.0] {
        let (found, named) = frf(corner);
        assert!(named, "{corner} Hz");
        let off = lines.clone().map(|k| (found[k] - plain[k]).norm()).fold(0.0, f64::max);
        println!("{corner} Hz: {:.1e}", off / largest);
        assert!(off < 5e-3 * largest, "{corner} Hz: {off} of {largest}");
    }
}

/// The amplitude of each mode at the end of a block is e^{−σT}: of an acceleration of which the high mode makes the peak
/// the low one is still there.
#[test]
fn a_slow_low_mode_below_a_high_peak_is_truncated() {
    let mut force = vec![0.0; 1_100];
    strike(&mut force, 40, 6, 50.0);
    let response = |slow: f64| -> Vec<f64> {
        let mut values: Vec<f64> = noise(9, 1_100).iter().map(|v| 1e-3 * v).collect();
        for (k, own) in values[40..].iter_mut().enumerate() {
            let k = k as f64;
            *own += 0.15 * (0.13 * k).sin() * (-k / slow).exp() + 2.0 * (0.9 * k).sin() * (-k / 60.0).exp();
        }
        values
    };
    let look =
        |response: &[f64]| inspect(&Hit { force: &force, response }, &Limits::default(), None).unwrap();
    let long = look(&response(1_300.0));
    let left = (-1_055.0f64 / 1_300.0).exp();
    assert!(long.truncated && (long.residual - left).abs() < 0.05, "{} not {left}", long.residual);
    assert!(!look(&response(150.0)).truncated, "{:?}", look(&response(150.0)));
}
