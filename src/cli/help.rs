//! `help`: the keys of the model file as they are declared, or the help of a command.

use rotordyn::model::keys::{self, Found, KeyDescription, KindName};
use rotordyn::names;
use rotordyn::warning::Code;
use serde_json::{Value, json};

use super::command_help;
use super::failure::Failure;
use super::terminal::Terminal;

/// Widest line.
const WIDTH: usize = 118;
/// Greatest widths of the columns key, value with range, without it; the meaning has the rest.
const GREATEST: [usize; 3] = [24, 40, 32];
/// At least as many keys in a row with the same meaning become one line.
const COLLAPSED: usize = 4;

/// Explains a path of the model file, else a command.
///
/// # Errors
/// Neither a declared path nor a command.
pub fn run(path: Option<&str>, terminal: &Terminal) -> Result<Value, Failure> {
    let path = path.unwrap_or_default().trim();
    if path == "warnings" {
        return Ok(all_codes(terminal));
    }
    if path == "commands" {
        return Ok(command_help::all(terminal));
    }
    if let Some(code) = Code::ALL.iter().find(|code| code.name() == path) {
        print_code(*code, terminal);
        return Ok(json!({ "command": "help", "path": path, "warning": code_to_json(*code) }));
    }
    let found = match keys::find(path) {
        Ok(found) => found,
        Err(unknown) => {
            let help = command_help::text(path).ok_or_else(|| {
                let lists = "`rotordyn help` lists the tables, `rotordyn help commands` the commands, \
                             `rotordyn help warnings` the codes of warnings";
                let meant =
                    nearest_code(path).map(|code| format!("; did you mean the warning {}?", code.name()));
                Failure::Input(format!("{unknown}{} ({lists})", meant.unwrap_or_default()))
            })?;
            terminal.print(&help);
            return Ok(json!({ "command": "help", "path": path, "text": help }));
        }
    };
    if let Some(former) = &found.former {
        terminal.note(&format!("`{former}` is now `{}`", found.path));
    }
    print(&found, terminal);
    if !path.is_empty() && command_help::text(path).is_some() {
        terminal.print(&format!("\nThe command of this name: rotordyn {path} --help"));
    }
    Ok(Value::from(&found))
}

/// The JSON Schema of the model file.
pub fn schema(terminal: &Terminal) -> Value {
    let schema = rotordyn::model::schema::json_schema();
    terminal.print(&format!("{schema:#}"));
    json!({ "command": "help", "schema_of_model_file": schema })
}

/// The code of a warning that a word is part of or resembles.
fn nearest_code(word: &str) -> Option<Code> {
    let word = word.to_lowercase().replace(['_', ' '], "-");
    let part =
        Code::ALL.iter().find(|code| word.len() > 2 && code.name().split('-').any(|part| part == word));
    part.copied().or_else(|| {
        let near = names::nearest(&word, Code::ALL.iter().map(|code| code.name()))?;
        Code::ALL.iter().copied().find(|code| code.name() == near)
    })
}

/// One code of a warning.
fn print_code(code: Code, terminal: &Terminal) {
    terminal.heading(&format!("warning {} ({})", code.name(), code.severity().name()));
    terminal.print_wrapped(code.when());
    terminal.print_wrapped(&format!("What to do: {}", code.advice()));
}

/// Every code in a table.
fn all_codes(terminal: &Terminal) -> Value {
    let rows: Vec<Vec<String>> = Code::ALL
        .iter()
        .map(|code| {
            [code.name(), code.severity().name(), first_sentence(code.when())].map(String::from).into()
        })
        .collect();
    terminal.table("Warnings; `rotordyn help CODE` explains one", &["code", "severity", "given when"], &rows);
    let codes: Vec<Value> = Code::ALL.iter().map(|code| code_to_json(*code)).collect();
    json!({ "command": "help", "path": "warnings", "warnings_explained": codes })
}

fn first_sentence(text: &str) -> &str {
    let end = [". ", ": "].iter().filter_map(|mark| text.find(mark)).min().unwrap_or(text.len());
    text[..end].trim_end_matches('.')
}

fn code_to_json(code: Code) -> Value {
    json!({
        "code": code.name(),
        "severity": code.severity().name(),
        "when": code.when(),
        "advice": code.advice(),
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
    let mut rows: Vec<(&[&str], Cells)> = Vec::new();
    let mut rest = found.members.as_slice();
    while let Some(first) = rest.first() {
        let alike = rest.iter().take_while(|key| key.meaning == first.meaning && key.kind == first.kind);
        let count = match alike.count() {
            count if count >= COLLAPSED && first.kind == KindName::Quantities => count,
            _ => 1,
        };
        rows.push((&first.groups, cells(&rest[..count])));
        rest = &rest[count..];
    }
    if rows.is_empty() {
        return;
    }
    let titles = ["key", "value", "without it", "meaning"].map(String::from);
    let widths = widths(rows.iter().map(|(_, cells)| cells).chain([&titles]));
    terminal.print("");
    terminal.print(&line(&titles, widths));
    let mut groups: &[&str] = &[""];
    for (of, cells) in rows {
        if of != groups {
            groups = of;
            terminal.print(&format!("\nwith {}:", of.join(" or ")));
        }
        terminal.print(&line(&cells, widths));
    }
}

/// Key, value, what holds without it, meaning.
type Cells = [String; 4];

/// Cells of one key, or of several keys with the same meaning.
fn cells(keys: &[KeyDescription]) -> Cells {
    let key = &keys[0];
    let meaning = match key.condition {
        "" => key.meaning.to_string(),
        condition => format!("{} (for example with {condition})", key.meaning),
    };
    let [first, .., last] = keys else {
        return [key.name.into(), value(key), key.absent.clone(), meaning];
    };
    let mut units: Vec<&str> = keys.iter().map(|key| key.unit).collect();
    units.sort_unstable();
    units.dedup();
    let names = format!("{} ... {}", first.name, last.name);
    let values = format!("{} components [{}]", keys.len(), units.join(", "));
    [names, values, first.absent.clone(), meaning]
}

fn widths<'c>(rows: impl Iterator<Item = &'c Cells>) -> [usize; 4] {
    let mut widths = [0; 4];
    for cells in rows {
        for (width, cell) in widths.iter_mut().zip(cells) {
            *width = cell.chars().count().max(*width);
        }
    }
    let [key, value, absent] = [0, 1, 2].map(|k| widths[k].min(GREATEST[k]));
    [key, value, absent, WIDTH - 8 - key - value - absent]
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
    say("only with", &key.groups.join(" or "));
    say("for example with", key.condition);
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

/// Least width of the column of meanings; below it they stand under their row.
const LEAST_MEANING: usize = 40;

/// Four cells side by side, each broken at words into the width of its column; the meaning under the others where its
/// column would be narrow.
fn line(cells: &Cells, widths: [usize; 4]) -> String {
    let [key, _, _, meaning] = widths;
    if meaning < LEAST_MEANING {
        let [name, value, absent, words] = cells.clone();
        let first = side_by_side(&[name, value, absent, String::new()], widths);
        let below = broken(&words, WIDTH - key - 6);
        let below = below.iter().map(|text| format!("\n  {}    {text}", " ".repeat(key)));
        return first + &below.collect::<String>();
    }
    side_by_side(cells, widths)
}

fn side_by_side(cells: &Cells, widths: [usize; 4]) -> String {
    let broken: Vec<Vec<String>> =
        cells.iter().zip(widths).map(|(cell, width)| broken(cell, width)).collect();
    let height = broken.iter().map(Vec::len).max().unwrap_or(0);
    let row = |k: usize| {
        let part = |(lines, width): (&Vec<String>, usize)| {
            let text = lines.get(k).map_or("", String::as_str);
            format!("{text}{}", " ".repeat(width.saturating_sub(text.chars().count())))
        };
        let parts: Vec<String> = broken.iter().zip(widths).map(part).collect();
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

#[cfg(test)]
mod tests {
    use super::super::args::Cli;
    use clap::CommandFactory;

    /// Help texts that come from a declaration are built with the command.
    #[test]
    fn help_of_flags_has_unit_and_default_of_the_key() {
        let cli = Cli::command();
        let help = |command: &str, flag: &str| {
            let command = cli.find_subcommand(command).unwrap();
            let flag = command.get_arguments().find(|argument| argument.get_long() == Some(flag)).unwrap();
            flag.get_help().unwrap().to_string()
        };
        assert_eq!(help("modal", "modes"), "Number of modes [default: 12]");
        assert!(help("run-up", "sample-rate").ends_with(" [default: 2 kHz]"));
        assert!(help("run-up", "step").contains(", such as \"100 us\" [default: 100 us, less at high speed"));
        assert!(help("run-up", "integrator").contains("newmark, rk4, dormand-prince"));
        assert!(help("bearing", "along").ends_with("[default: load]"));
    }
}
