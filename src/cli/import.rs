//! `import`: a model file from a rotor of another program.

use std::path::{Path, PathBuf};

use rotordyn::io::atomic_file;
use rotordyn::io::ross::{self, ImportError};
use rotordyn::model::{self, Options};
use rotordyn::warning::{Code, Warning};
use serde_json::{Value, json};

use super::args::ImportArgs;
use super::failure::Failure;
use super::limits::limits;
use super::terminal::Terminal;

impl From<ImportError> for Failure {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::File(error) => Self::Library(error),
            ImportError::Content(errors) => Self::Model(errors),
        }
    }
}

/// Writes the model file of a rotor, and prints what was carried over and what was not.
///
/// # Errors
/// A file that is no rotor of ROSS, an existing file without `--force`, a file that cannot be written.
pub fn run(args: &ImportArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let stem = args.file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let default = PathBuf::from(format!("{stem}_machine.toml"));
    let path = args.output.as_ref().unwrap_or(&default);
    let to_terminal = path == Path::new("-");
    if !to_terminal && path.exists() && !args.force {
        let message = format!("{} exists; --force overwrites it, -o FILE writes another", path.display());
        return Err(Failure::Input(message));
    }
    let source = if to_terminal { &args.file } else { path };
    let name = source.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let found = ross::import(&args.file, &model_name(&name), limits())?;
    // what is written is a valid model; else its own errors say why not
    model::load(&path.display().to_string(), &found.text, &Options::default())?;

    let rows: Vec<Vec<String>> = found
        .carried
        .iter()
        .map(|row| vec![row.what.clone(), row.count.to_string(), row.into.clone()])
        .collect();
    let version = if found.version.is_empty() { "before 2.0" } else { &found.version };
    if to_terminal {
        terminal.print(found.text.trim_end());
    } else {
        terminal.table(
            &format!("Carried over from ROSS {version}"),
            &["in the file", "number", "in the model"],
            &rows,
        );
        let lost = found.not_carried.iter().map(|row| vec![row.item.clone(), row.why.clone()]);
        let lost: Vec<Vec<String>> = lost.collect();
        if !lost.is_empty() {
            terminal.table("Not carried over", &["in the file", "why"], &lost);
        }
        atomic_file::write(path, found.text.as_bytes())
            .map_err(|error| Failure::environment("write", path, error))?;
        terminal.print(&format!("{} written", path.display()));
    }
    for lost in &found.not_carried {
        let text = format!("{}: {}", lost.item, lost.why);
        terminal.warn(&Warning::new(Code::NotImported, "", text));
    }
    let mut document = json!({
        "command": "import",
        "file": args.file,
        "ross_version": found.version,
        "carried": found.carried.iter().map(|row| json!({
            "what": row.what, "count": row.count, "into": row.into,
        })).collect::<Vec<_>>(),
        "not_carried": found.not_carried.iter().map(|row| json!({
            "item": row.item, "why": row.why,
        })).collect::<Vec<_>>(),
    });
    if to_terminal {
        document["text"] = found.text.into();
    } else {
        let next: Vec<String> = ["check", "modal"]
            .iter()
            .map(|command| format!("rotordyn {command} {}", path.display()))
            .collect();
        terminal.print(&format!("next: {}", next.join(", then ")));
        document["model"] = json!(path);
        document["next"] = json!(next);
    }
    Ok(document)
}

/// A name that a model may have: letters, digits, `_`, `-` and `.`.
fn model_name(stem: &str) -> String {
    let plain: String = stem
        .chars()
        .map(|c| if c.is_alphanumeric() || matches!(c, '_' | '-' | '.') { c } else { '_' })
        .take(60)
        .collect();
    let plain = plain.trim_start_matches('.');
    if plain.is_empty() || rotordyn::names::folder_problem(plain).is_some() {
        return "rotor".into();
    }
    plain.into()
}
