//! Motor rig of the Case Western Reserve University Bearing Data Center: the simulation of
//! models/cwru_6205.toml gives the same bearing diagnosis as the measured records 105 and 130.

use crate::agree;
use rotordyn::bearing::Bearing;
use rotordyn::model::{self, Options};
use rotordyn::signal::bearing_lines::{BearingPart, DefectFrequencies, LineSettings};
use rotordyn::signal::diagnosis::{BandRule, Diagnosis, ShaftRotation, diagnose};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::ops::ControlFlow;

/// Defect orders of the 6205-2RS from the data center's catalogue.
const BPFO: f64 = 3.5848;
const BPFI: f64 = 5.4152;

/// Shaft frequency and diagnosis of the drive-end accelerometer, given the nominal defect frequencies.
fn diagnosis(variant: &str, rule: BandRule) -> (f64, Diagnosis) {
    let text = include_str!("../../models/cwru_6205.toml");
    let options = Options { variant: Some(variant.into()), ..Options::default() };
    let machine = Machine::new(model::load("cwru_6205.toml", text, &options).unwrap().model).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let channel = machine.model.probes.iter().position(|p| p.name == "DE").unwrap();
    let settled = (0.25 * study.sample_rate) as usize;
    let mut record = Vec::new();
    let report = machine.run_up(&study, &machine.reduce(&study).unwrap(), |sample| {
        if sample.index >= settled {
            record.push(sample.channels[channel]);
        }
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let Bearing::Ball(ball) = &machine.model.bearings[0].bearing else { panic!() };
    let shaft = 1797.0 / 60.0;
    let orders = ball.geometry.characteristic_orders(0.0);
    let rates = DefectFrequencies {
        shaft,
        cage: orders.ftf * shaft,
        outer: orders.bpfo * shaft,
        inner: orders.bpfi * shaft,
        ball: orders.bsf * shaft,
    };
    let settings = LineSettings::default();
    let found =
        diagnose(&record, study.sample_rate, ShaftRotation::ConstantSpeed, &rates, rule, &settings).unwrap();
    (shaft, found)
}

/// Diagnosis, defect frequencies within 0.5 % of the catalogue, and the fault's defect frequency as the
/// strongest bearing line, with automatic selection of the band.
#[test]
fn diagnosis_of_race_faults() {
    for (variant, part, order) in
        [("inner_race", BearingPart::InnerRace, BPFI), ("outer_race", BearingPart::OuterRace, BPFO)]
    {
        for rule in [BandRule::Lines, BandRule::Kurtosis] {
            let (shaft, found) = diagnosis(variant, rule);
            let lines = &found.lines;
            let strongest = lines.strongest_line().unwrap();
            let what = format!("{variant}, {:.0} to {:.0} Hz: {strongest:?}", found.band.0, found.band.1);
            assert_eq!(lines.diagnosis, Some(part), "{what}");
            let found = lines.family(part).frequency;
            agree::relative(
                format_args!("{variant}, {rule:?}: defect frequency [Hz]"),
                found,
                order * shaft,
                0.005,
            );
            assert_eq!((strongest.part, strongest.harmonic), (part, 1), "{what}");
        }
    }
}
