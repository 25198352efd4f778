//! Decimal signs, thousands and quoted cells of tables.

use crate::{names, rate, read, values, vibration};

/// Values of 0 to 3000, of which some have thousands.
fn thousands(k: usize) -> f64 {
    (1500.0 * (1.0 + 0.6 * vibration(k))).round()
}

/// "2,635" with marks between thousands.
fn grouped(value: f64, mark: char) -> String {
    let digits = format!("{:.0}", value.abs());
    let (lead, last) = digits.split_at(digits.len().saturating_sub(3));
    let sign = if value < 0.0 { "-" } else { "" };
    if lead.is_empty() { format!("{sign}{last}") } else { format!("{sign}{lead}{mark}{last}") }
}

fn lines(head: &str, line: impl Fn(usize) -> String) -> String {
    format!("{head}\n{}\n", (0..400).map(line).collect::<Vec<_>>().join("\n"))
}

#[test]
fn thousands_follow_the_decimal_sign_of_the_other_columns() {
    for separator in [';', '\t', ' '] {
        for (decimal, mark) in [('.', ','), (',', '.')] {
            let time = |k: usize| format!("{:.7}", k as f64 / 5120.0).replace('.', &decimal.to_string());
            let head = format!("time_s{separator}x{separator}count");
            let text = lines(&head, |k| {
                format!("{}{separator}{}{separator}{k}", time(k), grouped(thousands(k), mark))
            });
            let found = read("t.csv", text.as_bytes(), None).unwrap();
            assert!((rate(&found, "x") / 5120.0 - 1.0).abs() < 1e-4);
            for k in 0..400 {
                assert_eq!(values(&found, "x")[k], thousands(k), "{separator:?} {decimal} line {k}");
            }
        }
    }
}

#[test]
fn thousands_follow_other_values_of_the_column() {
    for mark in [',', '.'] {
        // A number with two marks of one kind, and one with both.
        for first in ["1_234_567".replace('_', &mark.to_string()), {
            let decimal = if mark == ',' { '.' } else { ',' };
            format!("1{mark}234{decimal}5")
        }] {
            let text =
                lines("x;y", |k| if k == 300 { first.clone() } else { grouped(thousands(k), mark) } + ";1");
            let found = read("t.csv", text.as_bytes(), Some(1000.0)).unwrap();
            assert_eq!(values(&found, "x")[..300], (0..300).map(thousands).collect::<Vec<_>>()[..]);
        }
    }
}

#[test]
fn a_table_that_leaves_its_decimal_sign_open_is_refused() {
    let table = |head: &str, mark: char| lines(&format!("{head}x;y"), |k| grouped(thousands(k), mark) + ";1");
    for mark in [',', '.'] {
        let error = read("t.csv", table("", mark).as_bytes(), Some(1000.0)).unwrap_err();
        assert!(error.contains("may be") && error.contains("# decimal sign:"), "{error}");
        for (line, factor) in [("# decimal sign: ,\n", ','), ("Decimal separator;.\n", '.')] {
            let found = read("t.csv", table(line, mark).as_bytes(), Some(1000.0)).unwrap();
            let expected = |k: usize| {
                let value = thousands(k);
                if factor == mark && value.abs() >= 1000.0 { value / 1000.0 } else { value }
            };
            assert_eq!(values(&found, "x"), (0..400).map(expected).collect::<Vec<_>>(), "{mark} {line}");
        }
    }
    // One column of thousands with commas.
    let text = lines("acc [mg]", |k| grouped(thousands(k), ','));
    let error = read("t.csv", text.as_bytes(), Some(1000.0)).unwrap_err();
    assert!(error.contains("# decimal sign:"), "{error}");
    let found = read("t.csv", format!("# decimal sign: .\n{text}").as_bytes(), Some(1000.0)).unwrap();
    assert!((values(&found, "acc")[7] / (thousands(7) * 9.80665e-3) - 1.0).abs() < 1e-12);
    // Three decimals in all values: points are decimal signs.
    let text = lines("x;y", |k| format!("{:.3};1", 3.0 + vibration(k)));
    let found = read("t.csv", text.as_bytes(), Some(1000.0)).unwrap();
    assert!((values(&found, "x")[5] - 3.0 - vibration(5)).abs() < 1e-3);
}

#[test]
fn two_decimal_signs_are_refused() {
    let text = lines("time;x", |k| {
        format!("{:.4};{}", 1e-3 * k as f64, format!("{:.5}", vibration(k)).replace('.', ","))
    });
    let error = read("t.csv", text.as_bytes(), None).unwrap_err();
    assert!(error.contains("decimal points") && error.contains("decimal commas"), "{error}");
    let text = lines("# decimal sign: ,\ntime;x", |k| format!("{:.4};{:.5}", 1e-3 * k as f64, vibration(k)));
    let error = read("t.csv", text.as_bytes(), None).unwrap_err();
    assert!(error.contains("another decimal sign"), "{error}");
    // A mark at a place where no thousands end.
    let text =
        lines("time;x", |k| format!("{:.4};{}", 1e-3 * k as f64, if k == 9 { "1,000,00" } else { "1,000" }));
    assert!(read("t.csv", text.as_bytes(), None).is_err());
}

#[test]
fn quoted_cells_hold_separators() {
    for separator in [',', ';', '\t'] {
        let text =
            lines(&format!("\"time, s [s]\"{separator}x{separator}\"speed \"\"A\"\", n [rpm]\""), |k| {
                let speed = grouped(1500.0 + k as f64, ',') + ".5";
                format!("{:.4}{separator}{:.5}{separator}\"{speed}\"", 1e-3 * k as f64, vibration(k))
            });
        let text = text.replace("time, s [s]", "time [s]");
        let found = read("t.csv", text.as_bytes(), None).unwrap();
        assert_eq!(names(&found), ["x", "speed \"A\", n"], "{separator:?}");
        assert_eq!(values(&found, "speed \"A\", n")[10], 1510.5);
        assert_eq!(rate(&found, "x"), 1000.0);
    }
    // Decimal commas between quotes.
    let text = lines("\"time [s]\",\"x\"", |k| {
        format!("\"{:.4}\",\"{:.5}\"", 1e-3 * k as f64, vibration(k))
            .replace('.', ",")
            .replace("\",,\"", "\",\"")
    });
    let found = read("t.csv", text.as_bytes(), None).unwrap();
    assert_eq!((names(&found), rate(&found, "x")), (vec!["x"], 1000.0));
    assert!((values(&found, "x")[3] - vibration(3)).abs() < 1e-5);
    // Lines that are quoted as a whole.
    let text = lines("\"time,x\"", |k| format!("\"{:.4},{:.5}\"", 1e-3 * k as f64, vibration(k)));
    assert_eq!(names(&read("t.csv", text.as_bytes(), None).unwrap()), ["x"]);
}
