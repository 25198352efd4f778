//! The whole book: chapters of `docs/src`, generated chapters, pages by mdBook, links.

use crate::chapters::{Places, prepare, write_prepared};
use crate::console::Console;
use crate::reference::{self, Chapter};
use crate::step_accuracy::Section;
use crate::{Arguments, links, same_bytes, scaling, speed, step_accuracy, validation};
use mdbook_core::config::Config;
use mdbook_driver::MDBook;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Makes a section of the speed chapter from the text of a file.
type MakeSection = fn(&str) -> Result<Section, String>;

/// The line of `SUMMARY.md` below which the chapters of the model file's tables stand.
const MODEL_LINE: &str = "  - [Tables](reference/model.md)";

/// Builds the book, twice if asked for, and tells what was done.
///
/// # Errors
/// As of one build; two builds that differ.
pub fn build(arguments: &Arguments) -> Result<String, String> {
    let summary = build_once(arguments)?;
    if !arguments.twice {
        return Ok(summary);
    }
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let html = absolute(&root, &arguments.out).join("html");
    let first = same_bytes::digests(&html)?;
    build_once(arguments)?;
    let differ = same_bytes::differences(&first, &same_bytes::digests(&html)?);
    match differ.is_empty() {
        true => Ok(format!("{summary}, {} files the same in a second build", first.len())),
        false => Err(format!("a second build has other bytes in:\n{}", differ.join("\n"))),
    }
}

/// Builds the book, and tells what was done.
///
/// # Errors
/// A command of the book whose output is not the one shown, a generated chapter that fails, a dead link.
fn build_once(arguments: &Arguments) -> Result<String, String> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().map_err(|error| format!("{}: {error}", root.display()))?;
    let program = absolute(&root, &arguments.program);
    if !program.is_file() {
        return Err(format!("no program at {}: build it, or give --program", program.display()));
    }
    let out = absolute(&root, &arguments.out);
    let places =
        Places { sources: root.join("docs/src"), prepared: out.join("src"), work: out.join("commands") };
    for folder in [&places.prepared, &places.work] {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    copy_others(&places.sources, &places.prepared)?;
    let summary = read(&places.sources.join("SUMMARY.md"))?;

    let generated = generated_chapters(&program)?;
    let rows = validation::chapter(&absolute(&root, &arguments.validation), &root)?;
    if arguments.complete && rows.rows < validation::LEAST_ROWS {
        return Err(format!(
            "the validation chapter has {} rows, fewer than {}",
            rows.rows,
            validation::LEAST_ROWS
        ));
    }
    for (name, svg) in &rows.pictures {
        write_prepared(&format!("pictures/{name}"), svg, &places)?;
    }
    let validation =
        Chapter { title: "Validation".into(), path: "validation.md".into(), text: rows.text.clone() };
    let kept = |file: &str| fs::read_to_string(root.join("benches").join(file)).ok();
    let mut speed = Chapter {
        title: "Speed".into(),
        path: "speed.md".into(),
        text: speed::chapter(kept("times.json").as_deref())?,
    };
    let sections: [(&str, MakeSection); 2] =
        [("step_accuracy.json", step_accuracy::section), ("scaling.json", scaling::section)];
    for (file, section) in sections {
        let Some(points) = kept(file) else { continue };
        let section = section(&points)?;
        speed.text += &section.text;
        for (name, svg) in &section.pictures {
            write_prepared(&format!("pictures/{name}"), svg, &places)?;
        }
    }
    for chapter in generated.iter().chain([&validation, &speed]) {
        write_prepared(&chapter.path, &chapter.text, &places)?;
    }

    let program_folder = program.parent().map(Path::to_path_buf).unwrap_or_default();
    let console = Console { program_folder, models: root.join("models") };
    let is_generated = |path: &str| places.prepared.join(path).exists();
    let (mut commands, mut changed) = (0, Vec::new());
    for path in paths(&summary).into_iter().filter(|path| !is_generated(path)) {
        let report = prepare(&path, &places, &console, arguments.write)?;
        commands += report.commands;
        changed.extend(report.changed);
    }
    if !changed.is_empty() && !arguments.write {
        let hint = "`cargo run --bin book -- --write` puts the printed output into docs/src";
        return Err(format!("{}\n{hint}", changed.join("\n")));
    }
    write_prepared("SUMMARY.md", &with_tables(&summary, &generated)?, &places)?;

    let mut config: Config =
        read(&root.join("docs/book.toml"))?.parse().map_err(|e| format!("book.toml: {e:#}"))?;
    config.book.src = "src".into();
    config.build.build_dir = "html".into();
    config.build.create_missing = false;
    let book = MDBook::load_with_config(&out, config).map_err(|error| format!("{error:#}"))?;
    book.build().map_err(|error| format!("{error:#}"))?;
    let (dead, links) = links::dead(&out.join("html"))?;
    if !dead.is_empty() {
        return Err(format!("links that lead nowhere:\n{}", dead.join("\n")));
    }
    let counts = format!(
        "{commands} commands run, {} rows and {} curves of validation, {links} links",
        rows.rows,
        rows.pictures.len()
    );
    let written =
        if changed.is_empty() { String::new() } else { format!(", {} outputs rewritten", changed.len()) };
    Ok(format!("{}: {counts}{written}", out.join("html/index.html").display()))
}

fn absolute(root: &Path, path: &Path) -> PathBuf {
    if path.is_absolute() { path.into() } else { root.join(path) }
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The reference, as the program describes itself.
fn generated_chapters(program: &Path) -> Result<Vec<Chapter>, String> {
    let ask = |path: &str| -> Result<Value, String> {
        let told = |error: &dyn std::fmt::Display| format!("rotordyn help {path}: {error}");
        let mut command = Command::new(program);
        command.args(["help", "--json"]).args((!path.is_empty()).then_some(path));
        let output = command.output().map_err(|error| told(&error))?;
        serde_json::from_slice(&output.stdout).map_err(|error| told(&error))
    };
    let mut chapters = reference::model_chapters(&ask)?;
    chapters.push(reference::commands_chapter(&ask)?);
    chapters.push(reference::warnings_chapter(&ask)?);
    Ok(chapters)
}

/// Files that are no chapters: pictures, data.
fn copy_others(from: &Path, to: &Path) -> Result<(), String> {
    let told = |error: std::io::Error| format!("{}: {error}", from.display());
    for entry in fs::read_dir(from).map_err(told)? {
        let path = entry.map_err(told)?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            fs::create_dir_all(&target).map_err(told)?;
            copy_others(&path, &target)?;
        } else if path.extension().is_none_or(|e| e != "md") {
            fs::copy(&path, &target).map_err(told)?;
        }
    }
    Ok(())
}

/// Paths of the chapters of a summary, in order.
fn paths(summary: &str) -> Vec<String> {
    let links = summary.lines().filter_map(|line| line.split_once("](")?.1.split_once(')'));
    links.map(|(path, _)| path.to_string()).filter(|path| path.ends_with(".md")).collect()
}

/// The summary with a chapter for every table of the model file.
fn with_tables(summary: &str, generated: &[Chapter]) -> Result<String, String> {
    if !summary.lines().any(|line| line == MODEL_LINE) {
        return Err(format!("SUMMARY.md has no line `{MODEL_LINE}`"));
    }
    let tables: String = generated
        .iter()
        .filter(|chapter| chapter.path.starts_with("reference/model/"))
        .map(|chapter| format!("    - [{}]({})\n", chapter.title, chapter.path))
        .collect();
    Ok(summary
        .lines()
        .map(|line| format!("{line}\n{}", if line == MODEL_LINE { &tables } else { "" }))
        .collect())
}
