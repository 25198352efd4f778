//! Comparisons with references go through `agree`, so that the validation chapter has them all.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders of tests that compare with references, in the root and in the crates.
const FOLDERS: [&str; 3] = ["tests/literature", "tests/cross", "tests/analytic"];

/// Conditions that are no comparison with a reference: file, part of the condition, reason.
const NO_REFERENCE: [(&str, &str, &str); 2] = [
    (
        "zhang_2016_contacts.rs",
        "number(&reference[\"maxerrN\"])",
        "bound: our fit is not worse than the reference's",
    ),
    ("rapier_cage.rs", "farthest < clearance", "bound: the ball stays within its pocket"),
];

/// Names of deviations from a reference.
const DEVIATIONS: [&str; 7] = ["worst", "off", "error", "deviation", "difference", "farthest", "distance"];

/// Conditions of all `assert!` of a source without comments, and of `if` statements, with their lines.
fn conditions(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (start, word) in code.match_indices("assert!(").chain(code.match_indices(" if ")) {
        let rest = &code[start + word.len()..];
        let is_assert = word.starts_with('a');
        let mut depth = 0;
        let mut end = rest.len();
        for (at, c) in rest.char_indices() {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' if depth == 0 => end = end.min(at),
                ')' | ']' => depth -= 1,
                ',' if depth == 0 && is_assert => end = end.min(at),
                '{' if depth == 0 && !is_assert => end = end.min(at),
                _ => {}
            }
            if at >= end {
                break;
            }
        }
        let line = code[..start].lines().count().max(1);
        found.push((line, rest[..end].split_whitespace().collect::<Vec<_>>().join(" ")));
    }
    found
}

/// Whether a condition bounds the deviation of a value from another: `(a − b).abs() < …`, `(a/b − 1).abs() < …`,
/// `(a − b).norm() < …`, `worst < …`.
fn bounds_a_deviation(condition: &str) -> bool {
    let sizes = [".abs()", ".norm()"];
    let size =
        sizes.iter().flat_map(|size| condition.match_indices(size).map(move |(at, _)| (at, size.len())));
    let of_difference = |(at, length): (usize, usize)| {
        let before = &condition[..at];
        let Some(open) = opening(before) else { return false };
        let after = condition[at + length..].trim_start();
        let bounded = after.starts_with(['<', '>']) || after.starts_with('/') && after.contains(['<', '>']);
        before[open..].contains(" - ") && bounded
    };
    let by_name = condition.split("&&").any(|part| {
        let part = part.trim();
        DEVIATIONS
            .iter()
            .any(|name| part.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('<')))
    });
    size.into_iter().any(of_difference) || by_name
}

/// Where the parenthesis opens that closes at the end of a text.
fn opening(text: &str) -> Option<usize> {
    if !text.ends_with(')') {
        return None;
    }
    let mut depth = 0;
    for (at, c) in text.char_indices().rev() {
        match c {
            ')' => depth += 1,
            '(' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// Comparisons without `agree` in a source.
fn found_in(name: &str, text: &str) -> Vec<String> {
    let code: String =
        text.lines().map(|line| format!("{}\n", line.split("//").next().unwrap_or(""))).collect();
    let excused = |condition: &str| {
        NO_REFERENCE.iter().any(|(file, part, _)| *file == name && condition.contains(part))
    };
    // A filter of values that are near is no assertion: only `if` statements that record a failure are.
    let fails =
        |line: usize| code.lines().skip(line.saturating_sub(1)).take(3).any(|l| l.contains(".push(format!"));
    let asserts = code.match_indices("assert!(").map(|(at, _)| code[..at].lines().count().max(1));
    let assert_lines: Vec<usize> = asserts.collect();
    let mut out: Vec<String> = conditions(&code)
        .into_iter()
        .filter(|(_, condition)| bounds_a_deviation(condition) && !excused(condition))
        .filter(|(line, _)| assert_lines.contains(line) || fails(*line))
        .map(|(line, condition)| format!("{name}:{line}: {condition}"))
        .collect();
    for other in ["assert_relative_eq!", "assert_abs_diff_eq!", "assert_ulps_eq!"] {
        out.extend(code.contains(other).then(|| format!("{name}: {other}")));
    }
    out
}

fn files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let roots = crates.chain([root.to_path_buf()]);
    let folders =
        roots.flat_map(|root| FOLDERS.map(|folder| root.join(folder))).filter(|folder| folder.is_dir());
    let entries = folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let mut out: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == "rs")).collect();
    out.sort();
    out
}

#[test]
fn comparisons_with_references_leave_rows() {
    let files = files();
    assert!(files.len() > 40, "{} files", files.len());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_string();
    let wrong: Vec<String> =
        files.iter().flat_map(|path| found_in(&name(path), &fs::read_to_string(path).unwrap())).collect();
    assert!(wrong.is_empty(), "compare with `agree`, or state why in NO_REFERENCE:\n{}", wrong.join("\n"));
    // Each exception is still there.
    for (file, part, _) in NO_REFERENCE {
        let path = files.iter().find(|path| name(path) == file).unwrap_or_else(|| panic!("no file {file}"));
        assert!(fs::read_to_string(path).unwrap().contains(part), "{file} has no `{part}`");
    }
}

/// The check above depends on this scanner.
#[test]
fn the_scanner_finds_comparisons_and_no_others() {
    let refused = [
        "assert!((a - b).abs() < 1e-9);",
        "assert!(\n    (ours / theirs - 1.0).abs() < 1e-6,\n    \"{ours}\"\n);",
        "assert!((a - b).norm() / size <= tolerance);",
        "assert!(worst < 1e-6, \"{worst}\");",
        "assert!(x > 0.0 && off < 1e-6);",
        "for x in y {\n    if (x / y - 1.0).abs() > tolerance {\n        wrong.push(format!(\"{x}\"));\n    }\n}",
        "assert_relative_eq!(a, b);",
    ];
    for code in refused {
        assert_eq!(found_in("a.rs", code).len(), 1, "{code}: {:?}", found_in("a.rs", code));
    }
    let accepted = [
        "agree::relative(\"x\", a, b, 1e-9);",
        "assert!(a < b);",
        "assert!((shaft / TAU).abs() > 6.0);",
        "let near = all.iter().filter(|g| (*g - f).abs() < 2.5);",
        "// assert!((a - b).abs() < 1e-9);",
        "if (a - b).abs() < 1e-9 {\n    return;\n}",
        "assert!(force.norm() > 2.0, \"{}\", (a - b).abs());",
    ];
    for code in accepted {
        assert!(found_in("a.rs", code).is_empty(), "{code}: {:?}", found_in("a.rs", code));
    }
}
