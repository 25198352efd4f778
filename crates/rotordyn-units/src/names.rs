//! Names: the known name nearest to a misspelt one, and names of files.

/// The known name most similar to a word, if it is similar enough to be meant.
///
/// Ignores case and whether words are joined by `-`, `_` or a space. Similar enough: a Jaro-Winkler similarity above
/// 0.87, or at most as many edits (Damerau-Levenshtein) as a third of the word's letters. Ties: first in the alphabet.
pub fn nearest<'n>(word: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let plain = |s: &str| s.to_lowercase().replace(['-', ' '], "_");
    let word = plain(word);
    let score = |name: &str| strsim::jaro_winkler(&word, &plain(name));
    let scored = known.into_iter().map(|name| (score(name), name));
    let (similar, best) = scored.max_by(|(a, x), (b, y)| a.total_cmp(b).then(y.cmp(x)))?;
    let close = strsim::damerau_levenshtein(&word, &plain(best)) <= word.chars().count() / 3;
    (close || similar > 0.87).then_some(best)
}

/// Similarity of two names from 0 to 1 (Jaro-Winkler), case ignored.
pub fn similarity(a: &str, b: &str) -> f64 {
    strsim::jaro_winkler(&a.to_lowercase(), &b.to_lowercase())
}

/// Longest name of an item, a model or a variant \[bytes\]: two of them in one name stay below [`MAX_FILE_NAME`].
pub const MAX_NAME: usize = 96;

/// Longest name of a file or folder \[bytes\]; common file systems allow 255, with the extension.
pub const MAX_FILE_NAME: usize = 200;

/// Names that Windows gives to devices, with any extension.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Portable file name: one part of a path on every system, whatever the name is.
///
/// Characters other than letters, digits, dot, underscore and dash become `_`, as do a dot at either end; names of
/// devices get a `_`, and a name above [`MAX_FILE_NAME`] is cut and ends with its hash. Different names can have the same file
/// name: use [`file_names`] for the files of one folder.
pub fn file_name(name: &str) -> String {
    let mut out: String =
        name.chars().map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect();
    if out.starts_with('.') {
        out.replace_range(..1, "_");
    }
    if out.ends_with('.') {
        out.pop();
        out.push('_');
    }
    if out.is_empty() || is_device(&out) {
        out.insert(0, '_');
    }
    if out.len() > MAX_FILE_NAME {
        let hash = format!("-{:08x}", hash(name));
        while out.len() + hash.len() > MAX_FILE_NAME {
            out.pop();
        }
        out += &hash;
    }
    out
}

/// File names of different names, none twice, not even in other case: a later one of two gets a number.
pub fn file_names<'n>(names: impl IntoIterator<Item = &'n str>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    let one = |name: &str| {
        let plain = file_name(name);
        let mut out = plain.clone();
        let mut number = 1;
        while taken.contains(&out.to_lowercase()) {
            number += 1;
            out = format!("{plain}_{number}");
        }
        taken.push(out.to_lowercase());
        out
    };
    names.into_iter().map(one).collect()
}

/// Name of a group or data set in an HDF5 file, where `/` divides paths and `.` is the group itself.
///
/// A name that must be changed ends with its hash, so that `a/b` is another group than `a_b`.
pub fn group_name(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c == '/' || c.is_control() { '_' } else { c }).collect();
    match plain.as_str() {
        "" | "." | ".." => format!("_-{:08x}", hash(name)),
        same if same == name => plain,
        _ => format!("{plain}-{:08x}", hash(name)),
    }
}

/// The name of a folder: the name itself if it can be one, else its file name.
pub fn folder_name(name: &str) -> String {
    match folder_problem(name) {
        None => name.into(),
        Some(_) => file_name(name),
    }
}

/// Why a name of the model file cannot be one of a folder of results on every system; `None` if it can.
pub fn folder_problem(name: &str) -> Option<String> {
    let forbidden = |c: &char| c.is_control() || r#"/\<>:"|?*"#.contains(*c);
    if let Some(c) = name.chars().find(forbidden) {
        return Some(format!("it contains {c:?}"));
    }
    let stated = |problem: &str| Some(problem.to_string());
    match name {
        "" => stated("it is empty"),
        _ if name.starts_with('.') => stated("it begins with a dot"),
        _ if name.ends_with('.') => stated("it ends with a dot"),
        _ if name.trim() != name => stated("it begins or ends with a blank"),
        _ if is_device(name) => stated("Windows has a device of this name"),
        _ => length_problem(name),
    }
}

/// Why a name cannot be that of an item (station, bearing, probe ...); `None` if it can.
///
/// Names of items become paths of groups of the results file and parts of file names. A bearing may be named by its
/// designation, `60/22`.
pub fn item_problem(name: &str) -> Option<String> {
    if let Some(c) = name.chars().find(|c| c.is_control()) {
        return Some(format!("it contains {c:?}"));
    }
    match name.split('/').find(|part| matches!(*part, "" | "." | "..")) {
        Some("") if name.is_empty() => Some("it is empty".into()),
        Some("") => Some("it begins or ends with a `/`, or has two of them together".into()),
        Some(part) => Some(format!("`{part}` stands for a folder")),
        None => length_problem(name),
    }
}

fn length_problem(name: &str) -> Option<String> {
    let length = name.len();
    (length > MAX_NAME).then(|| format!("it has {length} bytes, more than {MAX_NAME}"))
}

fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_ascii_lowercase();
    let numbered = |of: &str| {
        let number = stem.strip_prefix(of);
        number.is_some_and(|n| n.len() == 1 && n.bytes().all(|b| (b'1'..=b'9').contains(&b)))
    };
    DEVICES.contains(&stem.as_str()) || numbered("com") || numbered("lpt")
}

/// FNV-1a hash: the same on every system and in every version.
pub fn hash(text: &str) -> u32 {
    text.bytes().fold(0x811c_9dc5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::{Component, Path};

    /// Names that lead elsewhere, to a device or to nothing as they are.
    const HOSTILE: [&str; 24] = [
        "",
        ".",
        "..",
        "...",
        "/",
        "/etc/passwd",
        "../x",
        "/../../../escaped",
        "a/b",
        "a\\b",
        "C:\\x",
        "a:b",
        "~",
        "~/x",
        "a\0b",
        "a\nb",
        " ",
        "a.",
        "a ",
        "CON",
        "con.txt",
        "LPT1",
        "e\u{301}",
        ".hidden",
    ];

    #[test]
    fn every_file_name_is_one_plain_part_of_a_path() {
        let long = "x".repeat(300);
        let wide = "\u{1F600}\u{e9}".repeat(150);
        for name in HOSTILE.iter().copied().chain([long.as_str(), wide.as_str()]) {
            let safe = file_name(name);
            let parts: Vec<Component> = Path::new(&safe).components().collect();
            assert!(matches!(parts[..], [Component::Normal(_)]), "{name:?} gives {safe:?}");
            assert!(safe.len() <= MAX_FILE_NAME, "{name:?} gives {safe:?}");
            assert!(safe.len() > MAX_NAME || folder_problem(&safe).is_none(), "{name:?} gives {safe:?}");
            assert_eq!(file_name(&safe), safe);
        }
        assert_eq!(file_name("spectrogram_B_ax.y-1"), "spectrogram_B_ax.y-1");
        assert_ne!(file_name(&long), file_name(&format!("{long}y")));
    }

    #[test]
    fn different_names_have_different_file_names() {
        let names = ["a/b", "a_b", "A_b", "a b", "a_b_2", "\u{e9}", "e\u{301}", "e_", "CON", "_con", "", "_"];
        let files = file_names(names);
        let mut lower: Vec<String> = files.iter().map(|f| f.to_lowercase()).collect();
        lower.sort();
        lower.dedup();
        assert_eq!(lower.len(), names.len(), "{files:?}");
        assert_eq!(files[..4], ["a_b", "a_b_2", "A_b_3", "a_b_4"]);
        assert_eq!(files[4], "a_b_2_2");
    }

    #[test]
    fn groups_of_different_names_differ() {
        assert_eq!(group_name("B.ax y"), "B.ax y");
        let names = ["a/b", "a_b", "a\0b", "a\nb", "", ".", ".."];
        let mut groups: Vec<String> = names.iter().map(|name| group_name(name)).collect();
        assert!(groups.iter().all(|g| !g.contains(['/', '\0']) && g != "." && g != ".." && !g.is_empty()));
        groups.sort();
        groups.dedup();
        assert_eq!(groups.len(), names.len());
    }

    #[test]
    fn names_of_items_and_folders_are_refused_with_a_reason() {
        for name in ["", "/a", "a//b", "../a", "..", "a\tb", &"x".repeat(300)] {
            assert!(item_problem(name).is_some() && folder_problem(name).is_some(), "{name:?}");
        }
        for name in ["CON", "aux.h5", "a:b", "a?", ".a", "a.", " a", "com7", "60/22", "a\\b"] {
            assert!(item_problem(name).is_none() && folder_problem(name).is_some(), "{name:?}");
        }
        for name in ["loose", "clearance 20 um", "1.2", "M\u{fc}ller", "confirmed", "com77", "console"] {
            assert_eq!((item_problem(name), folder_problem(name)), (None, None), "{name:?}");
        }
        assert_eq!(folder_problem("/../../../escaped").as_deref(), Some("it contains '/'"));
    }
}
