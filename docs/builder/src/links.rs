//! Links of the built pages: files and anchors that they lead to must exist.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Links that lead nowhere, each with its page; and the number of links inside the book.
///
/// # Errors
/// A page that cannot be read.
pub fn dead(root: &Path) -> Result<(Vec<String>, usize), String> {
    let mut pages = HashMap::new();
    collect(root, &mut pages)?;
    let anchors: HashMap<&PathBuf, HashSet<&str>> =
        pages.iter().map(|(path, html)| (path, attributes(html, &["id", "name"]).collect())).collect();
    let (mut dead, mut count) = (Vec::new(), 0);
    for (page, html) in &pages {
        for link in attributes(html, &["href", "src"]) {
            if link.is_empty()
                || link.contains("://")
                || link.starts_with("data:")
                || link.starts_with("mailto:")
            {
                continue;
            }
            count += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let file = file.split('?').next().unwrap_or_default();
            let folder = page.parent().unwrap_or(root);
            let target = match file {
                "" => page.clone(),
                _ => match file.strip_prefix('/') {
                    Some(absolute) => root.join(absolute),
                    None => normal(&folder.join(file)),
                },
            };
            let exists = target.is_file() || target.join("index.html").is_file();
            let anchored = anchor.is_empty()
                || anchors.get(&target).is_some_and(|known| known.contains(unescaped(anchor).as_str()));
            if !exists || !anchored {
                dead.push(format!("{}: {link}", page.strip_prefix(root).unwrap_or(page).display()));
            }
        }
    }
    dead.sort();
    dead.dedup();
    Ok((dead, count))
}

fn collect(folder: &Path, pages: &mut HashMap<PathBuf, String>) -> Result<(), String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(told)? {
        let path = entry.map_err(told)?.path();
        if path.is_dir() {
            collect(&path, pages)?;
        } else if path.extension().is_some_and(|e| e == "html") {
            pages.insert(path.clone(), fs::read_to_string(&path).map_err(told)?);
        }
    }
    Ok(())
}

/// Values of attributes with these names, as they stand in the page.
fn attributes<'h>(html: &'h str, names: &'h [&str]) -> impl Iterator<Item = &'h str> {
    names.iter().flat_map(move |name| {
        html.match_indices(*name).filter_map(move |(at, _)| {
            let before = html[..at].chars().next_back();
            let value = html[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
            let quote = value.chars().next().filter(|c| ['"', '\''].contains(c))?;
            before
                .is_some_and(char::is_whitespace)
                .then(|| value[1..].split(quote).next().unwrap_or_default())
        })
    })
}

/// A path without `..`.
fn normal(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            Component::CurDir => {}
            part => out.push(part),
        }
    }
    out
}

/// Percent signs of an anchor as characters.
fn unescaped(anchor: &str) -> String {
    let bytes = anchor.as_bytes();
    let (mut out, mut k) = (Vec::new(), 0);
    while k < bytes.len() {
        let hex = bytes.get(k + 1..k + 3).and_then(|two| std::str::from_utf8(two).ok());
        match hex.and_then(|two| u8::from_str_radix(two, 16).ok()) {
            Some(byte) if bytes[k] == b'%' => {
                out.push(byte);
                k += 3;
            }
            _ => {
                out.push(bytes[k]);
                k += 1;
            }
        }
    }
    String::from_utf8_lossy(&out).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dead_links_and_anchors_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir(root.join("sub")).unwrap();
        fs::write(root.join("a.html"), "<a href=\"sub/b.html#here\">b</a> <a href = '#no'>n</a>").unwrap();
        let page = "<h1 id=\"here\">h</h1><img src=\"../gone.svg\"><a href=\"../a.html\">a</a><a href=\"https://x.y/\">x</a>";
        fs::write(root.join("sub/b.html"), page).unwrap();
        let (dead, count) = dead(root).unwrap();
        assert_eq!(dead, ["a.html: #no", "sub/b.html: ../gone.svg"]);
        assert_eq!(count, 4);
    }
}
