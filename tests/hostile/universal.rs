//! Universal files.

use crate::{bytes_refused, run};

/// Records 1 to 11 of a function of `count` values of type 4, evenly spaced.
fn function(count: &str) -> String {
    format!(
        "NONE\nNONE\nNONE\nNONE\nNONE\n    1         0    0         0       NONE         1   1       NONE         0   0\n\
         \x20        4{count:>10}         1  0.00000E+00  1.00000E-03  0.00000E+00\n\
         \x20       17    0    0    0                 NONE                 NONE\n\
         \x20        0    0    0    0                 NONE                 NONE\n\
         \x20        0    0    0    0                 NONE                 NONE\n\
         \x20        0    0    0    0                 NONE                 NONE\n"
    )
}

fn binary(lines: &str, bytes: &str, body: &[u8]) -> Vec<u8> {
    let head =
        format!("    -1\n    58b     1     2{lines:>22}{bytes:>22}     0     0           0           0\n");
    [head.as_bytes(), function("3").as_bytes(), body].concat()
}

#[test]
fn headers_that_promise_lines_and_bytes_without_end() {
    let most = u64::MAX.to_string();
    let body = b"\0\0\0\0\0\0\0\0\n    -1\n";
    bytes_refused("a.uff", &binary(&most, "24", body), &["a.uff: line", "cut off"]);
    bytes_refused("a.uff", &binary("11", &most, &body[..4]), &["cut off"]);
    bytes_refused("a.uff", &binary("0", "0", body), &["a.uff: line"]);
    let text = format!("    -1\n    58\n{}  1.0\n    -1\n", function(" 999999999"));
    bytes_refused("a.uff", text.as_bytes(), &["at least 2"]);
}

#[test]
fn two_megabytes_of_delimiters() {
    bytes_refused("a.uff", &b"    -1\n".repeat(300_000), &["contains no channel"]);
    bytes_refused("a.uff", &b"-1\n".repeat(700_000), &["contains no channel"]);
    // Binary data whose end is nowhere, with and without line ends.
    bytes_refused(
        "a.uff",
        &binary("11", "24", &[b"    -1".repeat(350_000), b"x".to_vec()].concat()),
        &["cut off"],
    );
    bytes_refused("a.uff", &binary("11", "24", &b"    -1x\n".repeat(250_000)), &["cut off"]);
    // Every block states that its data ends before the zeros at the end of the file.
    let block = |at: usize| {
        let rest = (4000 - at) * 700 + 8;
        [binary("11", &rest.to_string(), b"\0\0\0\0\0\0\0\0\n"), b"    -1\n".to_vec()].concat()
    };
    let mut bytes: Vec<u8> = (0..2000).flat_map(block).collect();
    bytes.resize(bytes.len() + 1_000_000, 0);
    bytes.push(b'x');
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.uff");
    std::fs::write(&path, bytes).unwrap();
    crate::is_cheap(&run(&["signal", path.to_str().unwrap()]));
}

#[test]
fn data_sets_of_every_number() {
    let text: String = (3000..63_000).map(|k| format!("    -1\n{k:>6}\n    -1\n")).collect();
    bytes_refused("a.uff", text.as_bytes(), &["not read: data sets 3000, 3001", ", ..."]);
    let text = "    -1\n   151\n    -1\n".repeat(150_000);
    bytes_refused("a.uff", text.as_bytes(), &["it would need 100001 data sets or more", "--read-limit"]);
}

#[test]
fn counts_of_nodes_and_values() {
    let element = "    -1\n  2412\n1 91 1 1 7 -5\n1 91 1 1 7 9223372036854775807\n1 2 3\n    -1\n";
    bytes_refused("a.uff", element.as_bytes(), &["line"]);
    let lines = "    -1\n    82\n1 -3 7\nNONE\n1 2 3 0 4\n    -1\n";
    bytes_refused("a.uff", lines.as_bytes(), &["contains no channel"]);
    // A line of numbers that are none, and empty lines without end.
    let line = format!("    -1\n    15\n{}\n    -1\n", "z".repeat(3_000_000));
    bytes_refused("a.uff", line.as_bytes(), &["` is expected to be a number"]);
    let blank = format!("    -1\n    15\n{}    -1\n", "\n".repeat(2_000_000));
    bytes_refused("a.uff", blank.as_bytes(), &["a.uff: "]);
}
