//! Tables of text.

use crate::{bytes_refused, run};

#[test]
fn one_line_of_six_megabytes() {
    bytes_refused(
        "a.csv",
        &b"1,2,".repeat(1_500_000),
        &["columns or more, more than the 100000", "--read-limit"],
    );
    bytes_refused("a.csv", &b"1 ".repeat(3_000_000), &["it would need 3000000 columns"]);
    bytes_refused("a.csv", &b"x".repeat(6_000_000), &["no line of numbers"]);
    bytes_refused(
        "a.csv",
        &[b"a,b\n1,2\n1,".to_vec(), b"y".repeat(6_000_000)].concat(),
        &["`yyy", " ...` in line 3"],
    );
    bytes_refused("a.csv", &[b"a\n".to_vec(), b"(".repeat(6_000_000)].concat(), &["no line of numbers"]);
}

#[test]
fn a_million_columns() {
    let text = format!("{}c\n{}1\n", "c,".repeat(999_999), "1,".repeat(999_999));
    bytes_refused("a.csv", text.as_bytes(), &["columns or more", "--read-limit"]);
}

#[test]
fn brackets_within_each_other() {
    let name = format!("a [{}", "(".repeat(1_000_000));
    let seen = {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, format!("{name}]\n1\n2\n3\n")).unwrap();
        run(&["identify", path.to_str().unwrap()])
    };
    assert_eq!(seen.code, Some(2), "{}", &seen.reported[..seen.reported.len().min(500)]);
    crate::is_cheap(&seen);
}

/// The unit of a name is behind one of its underscores.
#[test]
fn a_name_of_a_million_underscores() {
    let text = format!("{}\n1\n2\n3\n", "a_".repeat(1_000_000));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, text).unwrap();
    crate::is_cheap(&run(&["identify", path.to_str().unwrap()]));
}

#[test]
fn half_letters_in_utf_16() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    // A name with a high surrogate alone, then numbers, and half a letter at the end.
    let mut units: Vec<u16> = "time_s,a".encode_utf16().collect();
    units.push(0xd800);
    let rows: String = (0..1000).map(|k| format!("\n{}e-3,{}", k, (k * k) % 7)).collect();
    units.extend(rows.encode_utf16());
    for (mark, order) in
        [([0xff, 0xfe], u16::to_le_bytes as fn(u16) -> [u8; 2]), ([0xfe, 0xff], u16::to_be_bytes)]
    {
        let mut bytes = mark.to_vec();
        bytes.extend(units.iter().flat_map(|unit| order(*unit)));
        bytes.push(0);
        std::fs::write(&path, bytes).unwrap();
        let seen = run(&["signal", path.to_str().unwrap()]);
        assert_eq!(seen.code, Some(0), "{}", seen.reported);
        assert!(seen.reported.contains("2 characters are not valid UTF-16"), "{}", seen.reported);
    }
}

const LABVIEW: &str = "LabVIEW Measurement\t\nMulti_Headings\tYes\nX_Columns\tOne\n***End_of_Header***\t\n";

#[test]
fn labview_headers_that_lie() {
    let refused =
        |rest: &str, parts: &[&str]| bytes_refused("a.lvm", format!("{LABVIEW}{rest}").as_bytes(), parts);
    refused("", &["no line of numbers behind a line `X_Value`"]);
    refused("***Start_Special***\n1\n", &["the special block of line 5 has no end"]);
    refused(&"Channels\t9999999\n".repeat(100_000), &["no line of numbers"]);
    refused(&format!("X_Value\t{}\n", "a\t".repeat(200_000)), &["channels or more"]);
    refused("X_Value\ta\n0\t1\n0\tx\n", &["`x` in line 7, channel `a`, is not a number"]);
    refused("X_Value\ta\n0\t1\n0\t2\n", &["`X_Value` of `a` does not increase after its value 1"]);
    refused("Channels\t0\nX_Value\ta\n0\t1\n", &["names no channel"]);
    // A header for every value.
    let segment = "Channels\t1\nDelta_X\t1\nX0\t5\nX_Value\ta\n0\t1\n";
    refused(&segment.repeat(120_000), &["more than the 100000"]);
}

#[test]
fn dates_that_are_none() {
    bytes_refused(
        "a.csv",
        b"31.12.2026 0:00;1\n32.12.2026 0:00;2\n",
        &["`32.12.2026 0:00` in line 2 is not a date"],
    );
    bytes_refused("a.csv", b"99/99/9999 0:00,1\n", &["no line of numbers"]);
    bytes_refused("a.csv", b"9999-12-31 23:59:60,1\n0001-01-01 0:00,2\n", &["`dates` does not increase"]);
}
