//! Tables: decimal signs, thousands, units in names, rounded times.

use crate::{names, rate, read, values, vibration};
use rotordyn_signal::record::MeasuredData;

/// A table of 400 lines, each of an index and a number.
fn table(head: &str, line: impl Fn(usize, f64) -> String) -> String {
    head.chars()
        .chain((0..400).flat_map(|k| (line(k, vibration(k)) + "\n").chars().collect::<Vec<_>>()))
        .collect()
}

fn table_of(head: &str, line: impl Fn(usize, f64) -> String) -> MeasuredData {
    read("t.csv", table(head, line).as_bytes(), None).unwrap()
}

fn comma(value: f64) -> String {
    format!("{value:.5}").replace('.', ",")
}

fn integer(value: f64) -> i32 {
    (1000.0 * value) as i32
}

#[test]
fn thousands_of_a_rate_follow_the_decimal_sign_of_the_table() {
    for text in ["12,800 Hz", "12800", "12.8 kHz", "12,800.0 Hz", "12 800 Hz", "12'800 Hz"] {
        let found = table_of(&format!("Sampling rate: {text}\nx\n"), |_, x| format!("{x:.5}"));
        assert_eq!(rate(&found, "x"), 12_800.0, "{text}");
    }
    for text in ["102.400 Hz", "102400", "102,4 kHz", "102,400 kHz", "102.400,0 Hz"] {
        let found =
            table_of(&format!("Abtastrate: {text}\nx;y\n"), |_, x| format!("{};{}", comma(x), comma(-x)));
        assert_eq!(rate(&found, "y"), 102_400.0, "{text}");
    }
    // Commas between whole numbers are no decimal signs.
    let found = table_of("fs: 51,200\nx,y\n", |k, x| format!("{},{k}", integer(x)));
    assert_eq!(rate(&found, "x"), 51_200.0);
}

#[test]
fn thousands_of_a_rate_follow_the_time_column() {
    // A rate in the other spelling than the numbers.
    for (text, step) in [("12.800 Hz", 1.0 / 12_800.0), ("12.800 Hz", 1.0 / 12.8)] {
        let found =
            table_of(&format!("fs: {text}\nTime [s],x\n"), |k, x| format!("{:.9},{x:.5}", step * k as f64));
        assert!((rate(&found, "x") * step - 1.0).abs() < 1e-6, "{}", rate(&found, "x"));
    }
}

#[test]
fn a_rate_that_may_be_two_is_asked_for() {
    for text in ["51,200", "51.200 Hz", "51,200 kHz"] {
        let of = |rate| {
            read(
                "t.csv",
                table(&format!("fs: {text}\nx;y\n"), |k, x| format!("{};{k}", integer(x))).as_bytes(),
                rate,
            )
        };
        let error = of(None).unwrap_err();
        assert!(error.contains("`fs`") && error.contains("51200") && error.contains("--rate"), "{error}");
        let found = of(Some(51_200.0)).unwrap();
        assert!(
            found.notes.iter().any(|note| note.contains("51200 Hz is used, as given")),
            "{:?}",
            found.notes
        );
    }
    // kHz are not written in groups of thousands with points.
    let found = table_of("fs: 12.800 kHz\nx;y\n", |k, x| format!("{};{k}", integer(x)));
    assert_eq!(rate(&found, "x"), 12_800.0);
}

#[test]
fn one_column_with_decimal_commas_is_one_channel() {
    for head in ["Abtastrate: 1000 Hz\nBeschleunigung\n", "x\n", "", "Abtastrate: 1000 Hz\n"] {
        let found = table_of(head, |_, x| comma(x));
        let [name] = names(&found)[..] else { panic!("{head:?}: {:?}", names(&found)) };
        assert!((values(&found, name)[7] - vibration(7)).abs() < 1e-5, "{head:?}");
        if head.contains("1000") {
            assert_eq!(rate(&found, name), 1000.0);
        }
    }
    // Numbers that end in zeros are written without them.
    let found = table_of("x\n", |k, x| if k % 5 == 0 { "1".into() } else { comma(x) });
    assert_eq!((names(&found), values(&found, "x")[5]), (vec!["x"], 1.0));
    // Few numbers: the line of names decides.
    let found = read("t.csv", b"Beschleunigung\n0,137\n0,486\n1,162\n", None).unwrap();
    assert_eq!(values(&found, "Beschleunigung"), [0.137, 0.486, 1.162]);
}

#[test]
fn two_columns_of_whole_numbers_stay_two() {
    for head in ["", "x,y\n", "Pump test\n", "fs: 1000 Hz\n"] {
        let found = table_of(head, |k, x| format!("{},{}", integer(x), 100 + k % 7));
        assert_eq!(found.records.len(), 2, "{head:?}");
    }
    let found = table_of("Pump test\n", |k, x| format!("{k},{}", 3000 + integer(x)));
    assert_eq!(found.records.len(), 2, "a counter and a channel: {:?}", names(&found));
    let error = read(
        "t.csv",
        table("t,x\n", |k, x| format!("{},{}", comma(1e-3 * k as f64), comma(x))).as_bytes(),
        None,
    )
    .unwrap_err();
    assert!(error.contains("4 cells between commas for 2 names"), "{error}");
}

#[test]
fn a_first_line_without_decimal_sign_does_not_decide() {
    for head in ["time;x;y\n", ""] {
        let found = table_of(head, |k, x| match k {
            0 => "0;0;0".into(),
            k => format!("{};{};{}", comma(1e-3 * k as f64), comma(x), comma(-x)),
        });
        assert_eq!((found.records.len(), found.records[0].sample_rate().unwrap()), (2, 1000.0), "{head}");
        assert_eq!(found.records[0].values.len(), 400);
    }
}

#[test]
fn units_of_names_scale_and_are_no_times() {
    for (name, unit, factor) in [
        ("Acc m/s^2", "m/s^2", 1.0),
        ("a in m/s²", "m/s^2", 1.0),
        ("acc_ms2", "m/s^2", 1.0),
        ("v in mm/s", "m/s", 1e-3),
        ("Vel mm/s", "m/s", 1e-3),
        ("acc, g", "m/s^2", 9.80665),
        ("acc_g", "m/s^2", 9.80665),
        ("acc in g/1000", "", 1.0),
        ("Sensor V", "", 1.0),
    ] {
        let found = table_of(&format!("time;{name}\n"), |k, x| format!("{:.3};{x:.9}", 1e-3 * k as f64));
        let [record] = &found.records[..] else { panic!("{name}: {:?}", names(&found)) };
        assert_eq!((record.unit.as_str(), record.sample_rate().unwrap()), (unit, 1000.0), "{name}");
        let value = record.time_samples().unwrap()[3] / vibration(3);
        assert!((value / factor - 1.0).abs() < 1e-6, "{name}: {value}");
    }
}

#[test]
fn rounded_times_are_uniform_within_their_digits() {
    let times =
        |decimals: usize| move |k: usize, x: f64| format!("{:.decimals$},{x:.5}", k as f64 / 12_800.0);
    let of = |head: &str, decimals: usize, rate: Option<f64>| {
        let text: String = (0..20_000).map(|k| times(decimals)(k, vibration(k)) + "\n").collect();
        read("t.csv", format!("{head}{text}").as_bytes(), rate)
    };
    // Five decimals: an error of the rate of 1e-5/1.56; four: 1e-4/1.56.
    for decimals in [5, 4] {
        let found = of("Time [s],x\n", decimals, None).unwrap();
        assert!((rate(&found, "x") / 12_800.0 - 1.0).abs() < 1e-4, "{decimals}: {}", rate(&found, "x"));
        assert!(found.notes.is_empty(), "{:?}", found.notes);
    }
    // With the rate: exactly that.
    for (head, given) in [("Time [s],x\n", Some(12_800.0)), ("fs: 12800 Hz\nTime [s],x\n", None)] {
        for decimals in [5, 4, 3] {
            assert_eq!(rate(&of(head, decimals, given).unwrap(), "x"), 12_800.0, "{head} {decimals}");
        }
    }
    // 999 Hz in ms: with the rate alone.
    let slow: String = (0..3000).map(|k| format!("{:.3},{:.5}\n", k as f64 / 999.5, vibration(k))).collect();
    let slow = |rate| read("t.csv", format!("Time [s],x\n{slow}").as_bytes(), rate).unwrap();
    assert!((rate(&slow(Some(999.5)), "x") / 999.5 - 1.0).abs() < 1e-12);
    assert!(slow(None).record("x").unwrap().sample_rate().is_err());
    // Another rate is stated than the column has.
    let error = of("fs: 25600 Hz\nTime [s],x\n", 4, None).unwrap_err();
    assert!(error.contains("two sampling rates") && error.contains("25600"), "{error}");
    // 100 samples in two digits: the rate is not known well enough.
    let few: String = (0..100).map(|k| times(2)(k, vibration(k)) + "\n").collect();
    let error = read("t.csv", format!("Time [s],x\n{few}").as_bytes(), None).unwrap_err();
    assert!(error.contains("too few digits") && error.contains("--rate"), "{error}");
    // The ends alone admit rates of 0.05 % around; all times together tell it.
    for (expected, decimals, count) in
        [(2000.0, 3, 2001), (2000.0, 3, 2500), (1652.0, 3, 1700), (51_200.0, 4, 9000)]
    {
        for cut in [0.0, 0.5] {
            let unit = 10.0_f64.powi(-decimals);
            let line = |k: usize| {
                let time = ((k as f64 / expected / unit + 0.5 - cut + 1e-9).floor() * unit).abs();
                format!("{time:.*},{:.5}\n", decimals as usize, vibration(k))
            };
            let text: String = (0..count).map(line).collect();
            let found = read("t.csv", format!("Time [s],x\n{text}").as_bytes(), None).unwrap();
            assert_eq!(rate(&found, "x").round(), expected, "{decimals} {count} {cut}");
        }
    }
    let exponents = table_of("Time [s],x\n", |k, x| format!("{:.3e},{x:.5}", k as f64 / 12_800.0));
    assert!((rate(&exponents, "x") / 12_800.0 - 1.0).abs() < 1e-3);
}

#[test]
fn times_that_are_not_uniform_are_not_taken_for_rounded_ones() {
    // A gap of five samples.
    let found = table_of("Time [s],x\n", |k, x| {
        format!("{:.5},{x:.5}", (k + if k > 200 { 5 } else { 0 }) as f64 / 12_800.0)
    });
    assert!(found.record("x").unwrap().sample_rate().is_err());
    // One lost sample where the last digit is the step: 999.33 Hz and 1 kHz with a gap look alike.
    for lost in [200, 350] {
        let text =
            table("Time [s],x\n", |k, x| format!("{:.3},{x:.5}", 1e-3 * (k + usize::from(k > lost)) as f64));
        for rate in [None, Some(1000.0)] {
            let found = read("t.csv", text.as_bytes(), rate).unwrap();
            assert!(found.record("x").unwrap().sample_rate().is_err(), "{lost} {rate:?}");
        }
        let stated = read("t.csv", format!("fs: 1000 Hz\n{text}").as_bytes(), None).unwrap();
        assert!(stated.record("x").unwrap().sample_rate().is_err(), "{lost}");
    }
    // A line twice.
    let twice =
        table("Time [s],x\n", |k, x| format!("{:.3},{x:.5}", 1e-3 * (k - usize::from(k > 200)) as f64));
    let error = read("t.csv", twice.as_bytes(), None).unwrap_err();
    assert!(error.contains("value 201") && error.contains("remove duplicate"), "{error}");
    // Days.
    let days = table("Time,x\n", |k, x| format!("{:.8},{x:.5}", 45_000.0 + k as f64 / 86_400_000.0));
    assert!(read("t.csv", days.as_bytes(), None).unwrap().record("x").unwrap().sample_rate().is_err());
    // Whole seconds with pauses.
    let found = read("t.csv", b"t,x\n0,1.5\n1,2.5\n2,1.5\n4,0.5\n5,1.5\n", None).unwrap();
    assert!(
        found.record("x").unwrap().sample_rate().is_err() && found.notes[0].contains("not uniformly spaced")
    );
    let text = table("Time [s],x\n", |k, x| format!("{:.4},{x:.5}", (k - k % 3) as f64 / 1000.0));
    let error = read("t.csv", text.as_bytes(), Some(1000.0)).unwrap_err();
    assert!(error.contains("does not increase") && error.contains("--rate"), "{error}");
}

#[test]
fn numbers_and_line_ends_of_other_programs() {
    let fortran = table_of("t x\n", |k, x| format!("{:.4e} {x:.6e}", 1e-3 * k as f64).replace('e', "D"));
    assert!((values(&fortran, "x")[9] - vibration(9)).abs() < 1e-5);
    assert_eq!(rate(&fortran, "x"), 1000.0);
    let missing = ["-nan(ind)", "1.#QNAN", "-1.#IND", "nan(snan)", "1.#INF", "-1.#INF"];
    let found = table_of("time,x\n", |k, x| {
        let text = missing.get(k).map_or(format!("{x:.5}"), |text| (*text).to_owned());
        format!("{:.3},{text}", 1e-3 * k as f64)
    });
    let first = &values(&found, "x")[..6];
    assert!(
        first[..4].iter().all(|v| v.is_nan()) && first[4..] == [f64::INFINITY, f64::NEG_INFINITY],
        "{first:?}"
    );
    let text = table("time,x\n", |k, x| format!("{:.3},{x:.5}", 1e-3 * k as f64)).replace('\n', "\r");
    let found = read("t.csv", text.as_bytes(), None).unwrap();
    assert_eq!((names(&found), found.records[0].values.len()), (vec!["x"], 400));
}

/// Nobody writes groups of thousands of kHz, and no direction is a unit.
#[test]
fn plain_numbers_and_directions_stay_what_they_are() {
    let found = table_of("fs [kHz]: 51.200\nx;y\n", |_, x| format!("{};{}", comma(x), comma(-x)));
    assert_eq!(rate(&found, "x"), 51_200.0);
    let found = table_of("fs: 1000\n\"DE, V\";\"DE, N\"\n", |_, x| format!("{x:.5};{:.5}", -x));
    assert_eq!(names(&found), ["DE, V", "DE, N"]);
    // A counter before whole numbers with leading zeros is no whole part of them.
    let text: String =
        (0..400).map(|k| format!("{k:05},{:05}\n", 300 + integer(vibration(k)).abs())).collect();
    let found = read("t.csv", text.as_bytes(), Some(1000.0)).unwrap();
    assert!(found.records.iter().all(|record| values(&found, &record.name)[5] >= 5.0));
}

#[test]
fn a_line_with_a_unit_is_no_name() {
    let found = read(
        "pump.csv",
        table("# Sampling rate: 5 kHz\n# unit: g\n", |_, x| format!("{x:.5}")).as_bytes(),
        None,
    );
    let found = found.unwrap();
    assert_eq!((names(&found), rate(&found, "pump")), (vec!["pump"], 5000.0));
    assert_eq!((found.records[0].file_unit.as_str(), found.records[0].unit.as_str()), ("g", "m/s^2"));
    assert!(found.left_out.is_empty(), "{:?}", found.left_out);
    let found =
        table_of("# unit: mm/s\ntime,a,b [g]\n", |k, x| format!("{},{x:.5},{x:.5}", 0.001 * k as f64));
    let units: Vec<&str> = found.records.iter().map(|record| record.file_unit.as_str()).collect();
    assert_eq!((names(&found), units), (vec!["a", "b"], vec!["mm/s", "g"]));
}

/// Two packets of a LabVIEW file with a header each: by the first abscissa, by the clock, and with neither.
#[test]
fn packets_of_a_labview_file_are_joined_or_named() {
    let file = |[start, next]: [&str; 2], x0: f64| {
        let packet = |from: usize, time: &str, x0: f64| {
            let numbers: String = (from..from + 100).map(|k| format!("\t{:.5}\n", vibration(k))).collect();
            format!(
                "Channels\t1\nSamples\t100\nDate\t2024/01/01\nTime\t{time}\nY_Unit_Label\tg\nX_Dimension\tTime\nX0\t{x0}\n\
                 Delta_X\t0.001\n***End_of_Header***\t\nX_Value\tAcc\tComment\n{numbers}\n"
            )
        };
        let head = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\tNo\nOperator\tme\n***End_of_Header***\t\n\t\n";
        let text = format!("{head}{}{}", packet(0, start, 0.0), packet(100, next, x0));
        read("p.lvm", text.as_bytes(), None).unwrap()
    };
    let same = ["10:00:00.0000"; 2];
    for found in [file(same, 0.1), file(["10:00:00.0000", "10:00:00.1001"], 0.0)] {
        assert_eq!((names(&found), values(&found, "Acc").len()), (vec!["Acc"], 200));
        assert!(found.notes.is_empty() && found.left_out.is_empty(), "{found:?}");
    }
    for times in [same, ["10:00:00", "10:00:00"], ["10:00:00.0000", "10:00:03.0000"]] {
        let found = file(times, 0.0);
        assert_eq!(names(&found), ["Acc", "Acc (2)"]);
        assert!(
            found.notes.iter().any(|note| note.starts_with("`Acc` comes in 2 packets")),
            "{:?}",
            found.notes
        );
    }
}
