//! What is said of several records: changes that are significant together, and parts that are named.

use rotordyn::bearing::CharacteristicOrders;
use rotordyn::results::{
    BearingWithOrders, RecordDiagnosis, RecordState, TrendAxis, TrendRecord, TrendResult,
};
use rotordyn::signal::bearing_lines::BearingPart;
use rotordyn::signal::statistics::statistics;
use rotordyn::study::trend::{complete, differences};

/// A record with a probability and a part, whose values are those of a sine times a level.
fn record(k: usize, level: f64, part: Option<BearingPart>, probability: f64) -> TrendRecord {
    let samples: Vec<f64> = (0..100).map(|n| level * (0.3 * f64::from(n)).sin()).collect();
    let diagnosis = RecordDiagnosis {
        statement: String::new(),
        part,
        candidate: part.unwrap_or(BearingPart::Cage),
        probability,
        band: (0.0, 500.0),
        lines: None,
    };
    TrendRecord {
        name: format!("r{k}"),
        position: k as f64,
        state: Some(RecordState {
            channel: "a".into(),
            unit: "m/s^2".into(),
            sample_rate: 1000.0,
            samples: 100,
            statistics: statistics(&samples).unwrap(),
            band_rms: Vec::new(),
            speed: None,
            speed_source: String::new(),
            diagnosis: Some(diagnosis),
        }),
        problem: None,
    }
}

fn trend(records: Vec<TrendRecord>) -> TrendResult {
    let orders = CharacteristicOrders { ftf: 0.4, bpfo: 3.6, bpfi: 5.4, bsf: 2.3 };
    complete(TrendResult {
        axis: TrendAxis { name: "time".into(), unit: "h".into(), source: String::new() },
        unit: String::new(),
        bearing: Some(BearingWithOrders {
            name: "b".into(),
            source: String::new(),
            orders,
            balls: 9,
            raceway_radii: None,
        }),
        line_band: None,
        rms_bands: Vec::new(),
        records,
        changes: Vec::new(),
        statements: Vec::new(),
    })
}

/// Named with 90 % in the records of a text of o (outer race), i (inner race) and dots.
fn named(pattern: &str) -> Vec<String> {
    let part = |c: char| match c {
        'o' => Some(BearingPart::OuterRace),
        'i' => Some(BearingPart::InnerRace),
        _ => None,
    };
    let records = pattern.chars().enumerate().map(|(k, c)| record(k, 1.0, part(c), 0.9));
    trend(records.collect()).statements.into_iter().filter(|text| text.contains("named")).collect()
}

#[test]
fn named_parts_in_words() {
    assert_eq!(named("oooo"), ["outer race named in all 4 records, up to 90 %"]);
    assert_eq!(named("....oooo"), ["outer race named from record 5 (r4) on, up to 90 %"]);
    assert_eq!(named("..o.oooo"), ["outer race named from record 5 (r4) on, once before (r2), up to 90 %"]);
    assert_eq!(
        named("..o.oi..........oo...oooo"),
        [
            "outer race named from record 22 (r21) on, 4 times before (first in r2), up to 90 %",
            "inner race named in 1 of 25 records (r5), not in the last, 90 %; 25 healthy records give as many with a \
             probability of up to 100 %"
        ]
    );
    assert_eq!(
        named(".........o"),
        [
            "outer race named in the last record only (r9), 90 %; 10 healthy records give as many with a probability of up to 67 %"
        ]
    );
    assert_eq!(named("o"), ["outer race named in r0, 90 %"]);
    assert_eq!(named("...."), ["no part is named in 4 judged records"]);
}

/// A rise of a few records in a thousandth of its height is stated as such, in both directions; by the number of
/// quantities that are tested a strict order of six records is the first that counts.
#[test]
fn changes_are_stated_if_significant() {
    let rising = |n: usize, sign: f64| {
        let records = (0..n).map(|k| record(k, 2.0 + sign * 0.001 * k as f64, None, 0.1));
        trend(records.collect()).statements
    };
    let up = rising(10, 1.0);
    assert!(
        up[0].starts_with("RMS rises from 1.4") && up[0].contains("m/s^2 (medians of the first 2 and"),
        "{up:?}"
    );
    assert!(rising(10, -1.0)[0].starts_with("RMS falls from 1.4"), "{:?}", rising(10, -1.0));
    assert!(
        rising(4, 1.0)[0].starts_with("4 records: too few to tell a trend from chance"),
        "{:?}",
        rising(4, 1.0)
    );
    assert!(
        rising(10, 0.0)[0].starts_with("no quantity has a significant trend over time"),
        "{:?}",
        rising(10, 0.0)
    );
}

/// Rows are sorted by position, those without one at the end; other units and failures are no error.
#[test]
fn rows_without_position_or_unit() {
    let mut records: Vec<TrendRecord> = [3, 1, 2].map(|k| record(k, 1.0, None, 0.1)).into();
    records[0].position = f64::NAN;
    records[1].state = None;
    if let Some(state) = &mut records[2].state {
        state.unit = "m/s".into();
        state.sample_rate = 500.0;
    }
    let texts = differences(&records, str::to_owned);
    assert!(texts[0].contains("1000 Hz (r3), 500 Hz (r2)"), "{texts:?}");
    assert!(
        texts[1].starts_with("units differ") && texts[1].contains("levels are not compared"),
        "{texts:?}"
    );
    assert!(texts[2].starts_with("durations differ"), "{texts:?}");
    let found = trend(records);
    let names: Vec<&str> = found.records.iter().map(|r| r.name.as_str()).collect();
    assert_eq!((names, found.unit.as_str()), (vec!["r1", "r2", "r3"], ""));
    assert!(found.quantities().iter().all(|quantity| quantity.name != "RMS"));
}
