//! Records of the Case Western Reserve University Bearing Data Center: the damaged race is diagnosed.

use crate::agree;
use rotordyn::io::measured;
use rotordyn::results::BearingWithOrders;
use rotordyn::signal::bearing_lines::BearingPart;
use rotordyn::signal::diagnosis::BandRule;
use rotordyn::study::signal::{
    Analysis, AnalysisSelection, ShaftMotion, SignalChannel, SignalSettings, analyse,
};

/// 6205-2RS JEM as the centre states it: nine balls of 7.94 mm on 39.04 mm.
fn drive_end() -> BearingWithOrders {
    let gamma = 7.94004 / 39.0398;
    let orders = rotordyn::bearing::CharacteristicOrders {
        ftf: 0.5 * (1.0 - gamma),
        bpfo: 4.5 * (1.0 - gamma),
        bpfi: 4.5 * (1.0 + gamma),
        bsf: 0.5 / gamma * (1.0 - gamma * gamma),
    };
    BearingWithOrders {
        name: "6205-2RS".into(),
        source: "stated".into(),
        orders,
        balls: 9,
        raceway_radii: None,
    }
}

#[test]
fn faults_of_inner_and_outer_race() {
    for (file, part, rms, kurtosis) in [
        ("cwru/105_IR007_0hp_12k.mat", BearingPart::InnerRace, 0.29153, 5.396),
        ("cwru/130_OR007at6_0hp_12k.mat", BearingPart::OuterRace, 0.66951, 7.649),
    ] {
        let Some(path) = crate::measured_data::measured(file) else { return };
        let found = measured::read(&path).unwrap();
        let speed = found.records[0].speed_rpm.unwrap() / 60.0;
        let shaft = ShaftMotion::constant(speed, "the file".into());
        let ends = ["DE_time", "FE_time", "BA_time"];
        let accelerometers = found.records.iter().filter(|r| ends.iter().any(|end| r.name.ends_with(end)));
        assert_eq!(accelerometers.clone().count(), 3, "{file}");
        // At the drive end, where the bearing is, at the fan end and on the base.
        for (place, record) in accelerometers.enumerate() {
            let channel = SignalChannel {
                name: record.name.clone(),
                unit: String::new(),
                sample_rate: 12_000.0,
                start: 0.0,
                samples: record.time_samples().unwrap().to_vec(),
                orthogonal: None,
            };
            for rule in [BandRule::Lines, BandRule::Kurtosis, BandRule::Whole, BandRule::Given(500.0, 5500.0)]
            {
                let settings = SignalSettings {
                    analyses: AnalysisSelection::Only(vec![Analysis::Envelope]),
                    band: Some(rule),
                    ..SignalSettings::default()
                };
                let found = analyse(&channel, Some(&shaft), Some(&drive_end()), &settings).unwrap();
                let envelope = found.envelope.unwrap();
                let statement = envelope.statement().unwrap();
                let what = format!("{} {rule:?}: {statement}", record.name);
                let lines = envelope.lines.unwrap();
                assert_eq!(lines.diagnosis, Some(part), "{what}");
                if place > 0 {
                    continue;
                }
                agree::absolute(format_args!("{file}: RMS"), found.statistics.rms, rms, 5e-6);
                agree::absolute(
                    format_args!("{file}: kurtosis"),
                    found.statistics.kurtosis.unwrap(),
                    kurtosis,
                    5e-4,
                );
                // The faults are plain to see in these records.
                assert!(envelope.graded.unwrap().probability > 0.8, "{what}");
                let strongest = lines.strongest_line().unwrap();
                assert_eq!((strongest.part, strongest.modulation), (part, None), "{what}");
                // Within 0.5 % of the catalogue.
                agree::relative(
                    format_args!("{what}: strongest line [Hz]"),
                    strongest.frequency,
                    strongest.expected,
                    5e-3,
                );
            }
        }
    }
}

/// Without shaft angle, order analyses are errors if requested and warnings otherwise.
#[test]
fn order_analyses_need_the_shaft_angle() {
    let channel = SignalChannel {
        name: "A".into(),
        unit: "m/s^2".into(),
        sample_rate: 1000.0,
        start: 0.0,
        samples: (0..4000).map(|k| f64::from(k * 7919 % 2003) / 1001.0 - 1.0).collect(),
        orthogonal: None,
    };
    for (analysis, words) in [
        (Analysis::Orders, "order tracking needs the shaft's angle"),
        (Analysis::Average, "an average over the shaft's turns needs the shaft's angle"),
    ] {
        let settings =
            SignalSettings { analyses: AnalysisSelection::Only(vec![analysis]), ..SignalSettings::default() };
        let error = analyse(&channel, None, None, &settings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
        let all = SignalSettings { analyses: AnalysisSelection::All, ..settings };
        let found = analyse(&channel, None, None, &all).unwrap();
        assert!(found.orders.is_none() && found.envelope.is_some() && found.cyclic.is_some());
        assert!(found.warnings.iter().any(|w| w.contains(words)), "{:?}", found.warnings);
    }
}
