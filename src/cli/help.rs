//! `help`: the keys of the model file as they are declared, or the help of a command.

use clap::CommandFactory;
use rotordyn::model::keys::{self, Found, KeyDescription, KindName};
use serde_json::{Value, json};

use super::args::Cli;
use super::failure::Failure;
use super::terminal::Terminal;

/// Widths of the columns: key, value with range, without it, meaning; 118 columns with two spaces between.
const WIDTHS: [usize; 4] = [22, 34, 22, 32];
/// At least as many keys in a row with the same meaning become one line.
const COLLAPSED: usize = 4;

/// Explains a path of the model file, else a command.
///
/// # Errors
/// Neither a declared path nor a command.
pub fn run(path: Option<&str>, terminal: &Terminal) -> Result<Value, Failure> {
    let path = path.unwrap_or_default().trim();
    let found = match keys::find(path) {
        Ok(found) => found,
        Err(unknown) => {
            let help = command_help(path)
                .ok_or_else(|| Failure::Input(format!("{unknown} (`rotordyn help` lists the tables)")))?;
            terminal.print(&help);
            return Ok(json!({ "command": "help", "path": path, "text": help }));
        }
    };
    if let Some(former) = &found.former {
        terminal.note(&format!("`{former}` is now `{}`", found.path));
    }
    print(&found, terminal);
    if !path.is_empty() && command_help(path).is_some() {
        terminal.print(&format!("\nThe command of this name: rotordyn {path} --help"));
    }
    Ok(json!({
        "command": "help",
        "path": found.path,
        "keys": found.keys.iter().map(to_json).collect::<Vec<_>>(),
        "members": found.members.iter().map(to_json).collect::<Vec<_>>(),
    }))
}

/// Long help of a command.
fn command_help(name: &str) -> Option<String> {
    let mut cli = Cli::command();
    let command = cli.find_subcommand_mut(name)?;
    Some(command.render_long_help().to_string())
}

fn to_json(key: &KeyDescription) -> Value {
    json!({
        "path": key.path,
        "name": key.name,
        "kind": key.kind.name(),
        "value": key.value,
        "unit": key.unit,
        "range": key.range,
        "words": key.words,
        "required": key.required,
        "default": key.default,
        "absent": key.absent,
        "conditions": key.conditions,
        "meaning": key.meaning,
        "example": key.example,
        "members": key.members,
    })
}

fn print(found: &Found, terminal: &Terminal) {
    if found.path.is_empty() {
        terminal.print(keys::meaning());
        terminal.print("Units are written in the values; `rotordyn help TABLE` lists the keys of a table.");
    }
    for key in &found.keys {
        print_key(key, terminal);
    }
    let mut rest = found.members.as_slice();
    let mut condition = None;
    while let Some(first) = rest.first() {
        let heading = first.conditions.iter().map(|words| leading(words)).collect::<Vec<_>>();
        if condition.as_ref() != Some(&heading) {
            terminal.print("");
            if !heading.iter().all(String::is_empty) {
                terminal.print(&format!("with {}:", heading.join(" or ")));
            } else if condition.is_none() {
                terminal.print(&line(["key", "value", "without it", "meaning"].map(String::from)));
            }
            condition = Some(heading);
        }
        let alike = rest.iter().take_while(|key| key.meaning == first.meaning && key.kind == first.kind);
        let count = match alike.count() {
            count if count >= COLLAPSED && first.kind == KindName::Quantities => count,
            _ => 1,
        };
        print_row(&rest[..count], terminal);
        rest = &rest[count..];
    }
}

/// The condition of a group, without that of the key itself.
fn leading(condition: &str) -> String {
    condition.split(", ").next().filter(|words| words.starts_with("model =")).unwrap_or_default().into()
}

/// One key in full.
fn print_key(key: &KeyDescription, terminal: &Terminal) {
    let title = match key.kind {
        KindName::NamedTables => format!("[{}.NAME]", key.path),
        KindName::TableList => format!("[[{}]]", key.path),
        KindName::Table => format!("[{}]", key.path),
        _ => key.path.clone(),
    };
    terminal.heading(&title);
    terminal.print_wrapped(key.meaning);
    let say = |what: &str, text: &str| {
        if !text.is_empty() {
            terminal.print_wrapped(&format!("{what}: {text}"));
        }
    };
    if key.members == 0 || key.kind == KindName::Spaced {
        say("value", &value(key));
        say("example", &example(key));
    }
    say("without it", &key.absent);
    let conditions: Vec<&str> =
        key.conditions.iter().map(String::as_str).filter(|words| !words.is_empty()).collect();
    say("only with", &conditions.join(" or "));
}

fn example(key: &KeyDescription) -> String {
    if key.example.is_empty() { String::new() } else { format!("{} = {}", key.name, key.example) }
}

/// Type, unit and range of the value in words.
fn value(key: &KeyDescription) -> String {
    let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
    let range = if key.range.is_empty() { String::new() } else { format!(", {}", key.range) };
    format!("{}{unit}{range}", key.value)
}

/// One line of a list of keys, or one for several keys with the same meaning.
fn print_row(keys: &[KeyDescription], terminal: &Terminal) {
    let [first, .., last] = keys else {
        let key = &keys[0];
        terminal.print(&line([key.name.into(), value(key), key.absent.clone(), key.meaning.into()]));
        return;
    };
    let mut units: Vec<&str> = keys.iter().map(|key| key.unit).collect();
    units.sort_unstable();
    units.dedup();
    let names = format!("{} ... {}", first.name, last.name);
    let values = format!("{} components [{}]", keys.len(), units.join(", "));
    terminal.print(&line([names, values, first.absent.clone(), first.meaning.into()]));
}

/// Four cells side by side, each broken at words into the width of its column.
fn line(cells: [String; 4]) -> String {
    let broken: Vec<Vec<String>> =
        cells.iter().zip(WIDTHS).map(|(cell, width)| broken(cell, width)).collect();
    let height = broken.iter().map(Vec::len).max().unwrap_or(0);
    let row = |k: usize| {
        let part = |(lines, width): (&Vec<String>, usize)| {
            let text = lines.get(k).map_or("", String::as_str);
            format!("{text}{}", " ".repeat(width.saturating_sub(text.chars().count())))
        };
        let parts: Vec<String> = broken.iter().zip(WIDTHS).map(part).collect();
        format!("  {}", parts.join("  ")).trim_end().to_string()
    };
    (0..height).map(row).collect::<Vec<_>>().join("\n")
}

fn broken(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let used = lines[last].chars().count();
        if used > 0 && used + 1 + word.chars().count() > width {
            lines.push(word.into());
            continue;
        }
        if used > 0 {
            lines[last].push(' ');
        }
        lines[last].push_str(word);
    }
    lines
}
