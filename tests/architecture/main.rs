//! Dependency rules of CONTRIBUTING.md (module layers, foreign crates), checked on the source text.

mod imports;
mod references;
mod terms;

use std::fs;
use std::path::{Path, PathBuf};

/// Layers of modules inside a crate, lowest first; a module may use its own layer and lower ones. `""` stands for the
/// files beside the modules named. Between crates the compiler keeps the order.
const LAYERS: [(&str, &[&[&str]]); 3] = [
    (
        "rotordyn-core",
        &[
            &["conventions", "series"],
            &["document"],
            &["warning"],
            &["element"],
            &["model"],
            &["geometry"],
            &["assembly"],
            &["analysis"],
            &["transient"],
            &["results", "study"],
        ],
    ),
    ("rotordyn-bearing", &[&["material"], &["contact"], &[""]]),
    ("rotordyn-plot", &[&[""], &["figures"]]),
];

/// Foreign crates and the files that may use them.
const OWNERS: [(&[&str], &[&str]); 15] = [
    (&["faer"], &["rotordyn-linalg/"]),
    (&["rapier3d", "rapier3d_f64"], &["rotordyn-core/geometry/rapier"]),
    (&["parry3d", "parry3d_f64"], &["rotordyn-core/geometry/parry"]),
    (&["hdf5"], &["rotordyn-io/hdf5"]),
    (&["flate2"], &["rotordyn-io/inflate", "rotordyn-report/arrays"]),
    (&["rmp_serde"], &["rotordyn-io/saved_results", "rotordyn-io/hdf5"]),
    (&["serde_path_to_error"], &["rotordyn-io/saved_results"]),
    (&["zip"], &["rotordyn-io/npy"]),
    (&["hound"], &["rotordyn-io/wav"]),
    (&["resvg", "usvg", "tiny_skia", "png"], &["rotordyn-plot/"]),
    (&["rustix"], &["cli/system"]),
    (&["clap", "miette"], &["main.rs", "cli/", "rotordyn-python/"]),
    (&["indicatif", "signal_hook", "humantime", "similar"], &["main.rs", "cli/"]),
    (&["pyo3", "numpy"], &["rotordyn-python/"]),
    (&["siphasher"], &["rotordyn-io/run_identity"]),
];

/// Crates that access files; all others compute.
const WITH_FILES: [&str; 4] = ["rotordyn-io", "rotordyn-model", "rotordyn-plot", "rotordyn-report"];

const MAX_LINES: usize = 500;

/// A source file: its path below src, its text, and its text without comments.
struct Source {
    path: String,
    lines: usize,
    text: String,
    code: String,
}

impl Source {
    fn new(path: String, text: String) -> Self {
        let code = text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>();
        Self { path, lines: code.len(), code: code.join("\n"), text }
    }
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut roots =
        vec![(String::new(), root.join("src")), ("rotordyn-python/".into(), root.join("python/src"))];
    for entry in fs::read_dir(root.join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        roots.push((format!("{}/", folder.file_name().unwrap().to_str().unwrap()), folder.join("src")));
    }
    roots.sort();
    let mut found = Vec::new();
    for (name, root) in roots {
        let mut folders = vec![root.clone()];
        let mut files: Vec<PathBuf> = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                match path.extension() {
                    _ if path.is_dir() => folders.push(path),
                    Some(extension) if extension == "rs" => files.push(path),
                    _ => {}
                }
            }
        }
        files.sort();
        found.extend(files.into_iter().map(|file| {
            let path = file.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
            Source::new(format!("{name}{path}"), fs::read_to_string(&file).unwrap())
        }));
    }
    found
}

/// Crate and path below its src of a file; an empty crate for the root.
fn crate_of(path: &str) -> (&str, &str) {
    path.split_once('/').filter(|(name, _)| name.starts_with("rotordyn-")).unwrap_or(("", path))
}

/// The name of the top module that a path below src belongs to.
fn module(path: &str) -> &str {
    path.split('/').next().unwrap_or(path).trim_end_matches(".rs")
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The top modules named by `crate::a` and `crate::{a, b::c}` in `code`.
fn used_modules(code: &str) -> Vec<String> {
    let first_name = |text: &str| text.trim().chars().take_while(|&c| is_name(c)).collect::<String>();
    let mut used = Vec::new();
    for (start, found) in code.match_indices("crate::") {
        let rest = &code[start + found.len()..];
        match rest.strip_prefix('{') {
            None => used.push(first_name(rest)),
            Some(group) => {
                let mut depth = 0;
                let mut item = String::new();
                for c in group.chars() {
                    match c {
                        '}' if depth == 0 => break,
                        '{' => depth += 1,
                        '}' => depth -= 1,
                        ',' if depth == 0 => used.push(first_name(&std::mem::take(&mut item))),
                        _ => {}
                    }
                    if !(c == ',' && depth == 0) {
                        item.push(c);
                    }
                }
                used.push(first_name(&item));
            }
        }
    }
    used.retain(|name| name.chars().next().is_some_and(char::is_lowercase));
    used
}

/// Whether `code` uses the foreign crate `name`: `name::` not preceded by a path, or `use name`.
fn uses_crate(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(start, _)| {
        let (before, after) = (&code[..start], &code[start + name.len()..]);
        let whole = !before.ends_with(is_name) && !after.starts_with(is_name);
        let statement = before.rsplit([';', '\n']).next().unwrap_or("").trim_start();
        let in_path =
            before.ends_with("::") && !before.ends_with(" ::") || statement.starts_with("use crate::");
        whole && !in_path && (after.starts_with("::") || statement.ends_with("use "))
    })
}

#[test]
fn imports_follow_layer_order() {
    let mut wrong = Vec::new();
    for Source { path, code, .. } in sources() {
        let (name, below) = crate_of(&path);
        let Some((_, layers)) = LAYERS.iter().find(|(of, _)| *of == name) else { continue };
        let exact = |module: &str| layers.iter().position(|layer| layer.contains(&module));
        let layer = |module: &str| exact(module).or_else(|| exact(""));
        let Some(own) = layer(module(below)) else {
            assert_eq!(below, "lib.rs", "{path} belongs to no layer: add it to LAYERS");
            continue;
        };
        for used in used_modules(&code) {
            if below != "lib.rs" && layer(&used).is_none_or(|layer| layer > own) {
                wrong.push(format!("{path} uses crate::{used}"));
            }
        }
    }
    assert!(wrong.is_empty(), "imports that violate the layer order:\n{}", wrong.join("\n"));
}

#[test]
fn foreign_crates_are_used_only_by_their_modules() {
    let mut wrong = Vec::new();
    for Source { path, code, .. } in sources() {
        for (crates, owners) in OWNERS {
            let owned = owners.iter().any(|owner| path.starts_with(owner));
            for name in crates.iter().filter(|name| !owned && uses_crate(&code, name)) {
                wrong.push(format!("{path} uses {name}, which belongs to {owners:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn computing_modules_do_not_access_files() {
    let touches =
        |code: &str| ["std::fs", "std::io"].iter().any(|m| code.contains(m)) || uses_crate(code, "fs");
    let computes = |path: &str| {
        let name = crate_of(path).0;
        !name.is_empty() && !WITH_FILES.contains(&name)
    };
    let wrong: Vec<_> = sources().into_iter().filter(|s| computes(&s.path) && touches(&s.code)).collect();
    assert!(
        wrong.is_empty(),
        "modules that access files: {:?}",
        wrong.iter().map(|s| &s.path).collect::<Vec<_>>()
    );
}

/// Files are replaced as a whole (`atomic_file`, `Store::replace`), and what is printed is checked (`terminal`).
#[test]
fn files_and_prints_go_through_one_place() {
    const IN_PLACE: [&str; 5] =
        ["fs::write(", "File::create(", "Store::create(", "Store::append(", "println!("];
    // The stores of library users; the temporary copy of a file inside the program.
    const ALLOWED: [&str; 2] = ["rotordyn-io/hdf5.rs", "rotordyn-io/hdf5/scale.rs"];
    let mut wrong = Vec::new();
    for Source { path, code, .. } in sources().into_iter().filter(|s| !ALLOWED.contains(&s.path.as_str())) {
        let program = code.split("#[cfg(test)]").next().unwrap_or("");
        let found = IN_PLACE.iter().filter(|call| program.contains(**call));
        wrong.extend(found.map(|call| format!("{path} uses {call}...)")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn source_files_stay_below_line_limit() {
    let long: Vec<_> =
        sources().into_iter().filter(|s| s.lines > MAX_LINES).map(|s| (s.path, s.lines)).collect();
    assert!(long.is_empty(), "over {MAX_LINES} lines: {long:?}");
}

/// The checks above depend on this source scanner.
#[test]
fn source_scanner_detects_modules_and_crates() {
    assert_eq!(
        used_modules("use crate::model::Model; crate::{a, b::{c, d}, e::f}"),
        ["model", "a", "b", "e"]
    );
    assert!(used_modules("use super::x; pub(crate) fn f() {}").is_empty());
    for code in ["use hdf5::File;", "use hdf5;", "let x = hdf5::open();", "use ::hdf5::File;", "f(hdf5::A)"] {
        assert!(uses_crate(code, "hdf5"), "{code}");
    }
    for code in
        ["use crate::io::hdf5::Store;", "io::hdf5::Store", "use crate::io::hdf5::Store;", "my_hdf5::x"]
    {
        assert!(!uses_crate(code, "hdf5"), "{code}");
    }
}
