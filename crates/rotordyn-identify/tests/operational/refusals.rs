//! Error messages with hints for records that cannot be identified.

use rotordyn_identify::operational::{OperationalSettings, OutputRecord, Shaft, identify_operational};

use crate::machine::Machine;

fn message(change: impl FnOnce(&mut OutputRecord, &mut OperationalSettings)) -> String {
    let mut record = Machine::new(&[(20.0, 0.02)], 3, 128.0, 60.0).record(1);
    let mut settings = OperationalSettings::default();
    change(&mut record, &mut settings);
    match identify_operational(&record, &settings) {
        Err(error) => error.to_string(),
        Ok(found) => panic!("{:?}", found.modes),
    }
}

#[test]
fn errors_contain_hints() {
    let cases: [(String, [&str; 2]); 9] = [
        (
            message(|r, _| r.samples[1][640] = f64::NAN),
            ["2:+y is NaN or infinite at 5.000", "leave the channel out"],
        ),
        (message(|r, _| r.samples[2].fill(3.0)), ["response 3:+y", "dead channel"]),
        (message(|r, _| r.samples[2].truncate(9)), ["7680 and 9 samples", "recorded together"]),
        (message(|r, _| r.samples.iter_mut().for_each(|c| c.truncate(300))), ["300 samples", "too few"]),
        (message(|_, s| s.band = Some([70.0, 90.0])), ["70.000 .. 90.000 Hz", "half the sampling rate"]),
        (message(|_, s| s.references = Some(vec![7])), ["reference channels", "[7] of 3"]),
        (message(|_, s| s.max_order = Some(5000)), ["5000 is too high", "or less is possible"]),
        (message(|_, s| s.shaft = Shaft::Steady(-1.0)), ["shaft speed", "not positive"]),
        (message(|_, s| s.shaft = Shaft::Angle(vec![0.0; 5])), ["shaft angle", "5 values for 7680 samples"]),
    ];
    for (text, parts) in &cases {
        println!("{text}");
        assert!(parts.iter().all(|part| text.contains(part)), "{parts:?} is not in\n{text}");
    }
}

#[test]
fn a_request_ends_the_identification() {
    assert_eq!(message(|_, settings| settings.stop.request()), "the identification was stopped");
}
