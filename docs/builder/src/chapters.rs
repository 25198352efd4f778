//! Chapters on their way from `docs/src` to the sources of the book: commands run, pictures of their results copied,
//! equations rendered.

use crate::console::{Console, without_options};
use crate::math::{MARKDOWN, replace_equations};
use pulldown_cmark::{Event, Parser, Tag};
use std::fs;
use std::path::{Path, PathBuf};

/// What a chapter's commands left.
#[derive(Debug, Default)]
pub struct Report {
    pub commands: usize,
    /// Differences between the output shown and the output printed.
    pub changed: Vec<String>,
}

/// Where chapters come from and go to.
#[derive(Debug)]
pub struct Places {
    /// `docs/src`.
    pub sources: PathBuf,
    /// Sources of the book as mdBook reads them.
    pub prepared: PathBuf,
    /// Folders in which the commands run.
    pub work: PathBuf,
}

/// Prepares the chapter at a path; with `write` its shown output is replaced.
///
/// # Errors
/// A command that does not end as stated, a missing picture, an equation that is no TeX.
pub fn prepare(path: &str, places: &Places, console: &Console, write: bool) -> Result<Report, String> {
    let source = places.sources.join(path);
    let told = |error: std::io::Error| format!("{}: {error}", source.display());
    let text = fs::read_to_string(&source).map_err(told)?;
    let key = folder_name(&text).unwrap_or_else(|| path.trim_end_matches(".md").replace('/', "-"));
    let folder = places.work.join(&key);
    let ran = console.run(&text, &folder).map_err(|problem| format!("{path}: {problem}"))?;
    let mut report = Report { commands: ran.commands, changed: Vec::new() };
    if ran.text != text {
        if write {
            fs::write(&source, &ran.text).map_err(told)?;
        }
        let difference = |[command, shown, printed]: &[String; 3]| {
            format!("{path}: `{command}` shows\n{shown}and prints\n{printed}")
        };
        report.changed = ran.changed.iter().map(difference).collect();
    }
    let text = with_pictures(&ran.text, path, &key, &folder, places)?;
    let text = replace_equations(&without_options(&text)).map_err(|problem| format!("{path}: {problem}"))?;
    write_prepared(path, &text, places)?;
    Ok(report)
}

/// A chapter as mdBook reads it.
///
/// # Errors
/// The file cannot be written.
pub fn write_prepared(path: &str, text: &str, places: &Places) -> Result<(), String> {
    let target = places.prepared.join(path);
    let told = |error: std::io::Error| format!("{}: {error}", target.display());
    if let Some(folder) = target.parent() {
        fs::create_dir_all(folder).map_err(told)?;
    }
    fs::write(&target, text).map_err(told)
}

/// Chapters with the same `<!-- folder: NAME -->` run their commands in one folder, one after the other.
fn folder_name(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("<!-- folder: ")?;
    rest.split_once(" -->").map(|(name, _)| name.to_string())
}

/// Pictures that are not in `docs/src` come from the folder of the chapter's commands.
fn with_pictures(
    text: &str,
    path: &str,
    key: &str,
    folder: &Path,
    places: &Places,
) -> Result<String, String> {
    let (mut out, mut done) = (String::new(), 0);
    let beside = places.sources.join(path).parent().map(Path::to_path_buf).unwrap_or_default();
    for (event, range) in Parser::new_ext(text, MARKDOWN).into_offset_iter() {
        let Event::Start(Tag::Image { dest_url, .. }) = event else { continue };
        if beside.join(&*dest_url).exists() || dest_url.contains("://") {
            continue;
        }
        let made = folder.join(&*dest_url);
        let name = format!("pictures/{key}/{}", dest_url.replace('/', "-"));
        let target = places.prepared.join(&name);
        if let Some(folder) = target.parent() {
            fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        fs::copy(&made, &target).map_err(|_| format!("{path}: no command made the picture {dest_url}"))?;
        let up = "../".repeat(path.matches('/').count());
        let Some(at) = text[range.clone()].rfind(&*dest_url) else { continue };
        out += &text[done..range.start + at];
        out += &format!("{up}{name}");
        done = range.start + at + dest_url.len();
    }
    Ok(out + &text[done..])
}
