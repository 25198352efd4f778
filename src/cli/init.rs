//! `init`: writes a commented starter machine.

use std::path::{Path, PathBuf};

use rotordyn::io::atomic_file;
use serde_json::{Value, json};

use super::args::{InitArgs, STARTERS};
use super::failure::Failure;
use super::terminal::Terminal;

/// Writes the starter machine of a kind, or lists the kinds.
///
/// # Errors
/// An existing file without `--force`; a file that cannot be written.
pub fn run(args: &InitArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let Some(kind) = args.kind else {
        let rows: Vec<Vec<String>> =
            STARTERS.iter().map(|kind| vec![kind.name.into(), kind.meaning.into()]).collect();
        terminal.table("Starter machines of `rotordyn init KIND`", &["kind", "machine"], &rows);
        let kinds = STARTERS.map(|kind| json!({ "kind": kind.name, "machine": kind.meaning }));
        return Ok(json!({ "command": "init", "kinds": kinds }));
    };
    let mut document = json!({ "command": "init", "kind": kind.name, "machine": kind.meaning });
    let default = PathBuf::from(format!("{}.toml", kind.name));
    let path = args.output.as_ref().unwrap_or(&default);
    if path == Path::new("-") {
        terminal.print(kind.text.trim_end());
        document["text"] = kind.text.into();
        return Ok(document);
    }
    if path.exists() && !args.force {
        let message = format!("{} exists; --force overwrites it, -o FILE writes another", path.display());
        return Err(Failure::Input(message));
    }
    atomic_file::write(path, kind.text.as_bytes())
        .map_err(|error| Failure::environment("write", path, error))?;
    terminal.print(&format!("{} written: {}", path.display(), kind.meaning));
    let next: Vec<String> =
        ["check", "run"].iter().map(|command| format!("rotordyn {command} {}", path.display())).collect();
    terminal.print(&format!("next: {}", next.join(", then ")));
    document["file"] = json!(path);
    document["next"] = json!(next);
    Ok(document)
}
