//! Identifiers of the old private vocabulary do not come back: old_identifiers.txt has them with the standard term.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

const OLD: &str = include_str!("old_identifiers.txt");

/// Old identifier and the standard one.
fn old_identifiers() -> HashMap<&'static str, &'static str> {
    OLD.lines().filter_map(|line| line.split_once('\t')).collect()
}

/// Source files below the folders of the crate, without the tests of this folder.
fn rust_files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders: Vec<_> = ["src", "crates", "tests", "benches", "examples"].map(|f| root.join(f)).into();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() && path.ends_with("tests/architecture") => {}
                _ if path.is_dir() => folders.push(path),
                Some(extension) if extension == "rs" => files.push(path),
                _ => {}
            }
        }
    }
    files.sort();
    files
}

/// Identifiers of a source text, without those in comments and in string and character literals.
fn identifiers(text: &str) -> Vec<&str> {
    let bytes = text.as_bytes();
    let is_word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b >= 0x80;
    let end_of =
        |from: usize, close: &str| text[from..].find(close).map_or(text.len(), |k| from + k + close.len());
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text[at..];
        if rest.starts_with("//") {
            at = end_of(at, "\n");
        } else if rest.starts_with("/*") {
            at = end_of(at, "*/");
        } else if let Some(hashes) = raw_string(rest) {
            let open = rest.find('"').unwrap_or(0) + 1;
            at = end_of(at + open, &format!("\"{}", "#".repeat(hashes)));
        } else if bytes[at] == b'"' {
            at += 1;
            while at < bytes.len() && bytes[at] != b'"' {
                at += if bytes[at] == b'\\' { 2 } else { 1 };
            }
            at += 1;
        } else if let Some(length) = character(rest) {
            at += length;
        } else if is_word(bytes[at]) {
            let start = at;
            while at < bytes.len() && is_word(bytes[at]) {
                at += 1;
            }
            found.push(&text[start..at]);
        } else {
            at += 1;
        }
    }
    found
}

/// Number of `#` of a raw string literal that begins here.
fn raw_string(text: &str) -> Option<usize> {
    let tail = text.strip_prefix("br").or(text.strip_prefix('r'))?;
    let hashes = tail.bytes().take_while(|b| *b == b'#').count();
    tail[hashes..].starts_with('"').then_some(hashes)
}

/// Length of a character literal that begins here; a lifetime is none.
fn character(text: &str) -> Option<usize> {
    let tail = text.strip_prefix('\'')?;
    let escaped = tail.starts_with('\\');
    let first = tail.chars().next()?.len_utf8();
    let close = if escaped { tail[2..].find('\'')? + 2 } else { first };
    (tail.as_bytes().get(close) == Some(&b'\'')).then_some(close + 2)
}

#[test]
fn old_identifiers_are_not_used() {
    let old = old_identifiers();
    assert!(old.len() > 100);
    let mut wrong = Vec::new();
    for path in rust_files() {
        let text = fs::read_to_string(&path).unwrap();
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("");
        let mut used: Vec<_> =
            identifiers(&text).into_iter().chain([stem]).filter(|word| old.contains_key(word)).collect();
        used.sort_unstable();
        used.dedup();
        wrong.extend(used.iter().map(|word| format!("{}: `{word}` is now {}", path.display(), old[word])));
    }
    assert!(wrong.is_empty(), "old identifiers:\n{}", wrong.join("\n"));
}

/// The check above depends on this scanner.
#[test]
fn scanner_finds_identifiers_outside_of_comments_and_literals() {
    let text = r##"
        // fling
        /* lean */ fn settle<'twin>(x: &'twin str) -> char { let y = r#"told "said""#; let c = 'b'; '\'' }
        struct RingSum { text: &'static str } const A: &str = "blow \" grain";
    "##;
    let found = identifiers(text);
    for word in ["settle", "twin", "RingSum", "A", "c", "char"] {
        assert!(found.contains(&word), "{word} in {found:?}");
    }
    for word in ["fling", "lean", "told", "said", "blow", "grain", "b"] {
        assert!(!found.contains(&word), "{word} in {found:?}");
    }
}
