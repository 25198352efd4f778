//! Reference chapters from what `rotordyn help --json` tells: keys of the model file, commands, warnings.
//!
//! The program describes itself from the declarations that its reader and its command line use.

use serde_json::Value;
use std::collections::HashSet;
use std::fmt::Write;

/// Answers `rotordyn help WORDS --json`.
pub type Ask<'a> = &'a dyn Fn(&str) -> Result<Value, String>;

/// A generated chapter.
#[derive(Debug)]
pub struct Chapter {
    pub title: String,
    /// Path in the sources of the book.
    pub path: String,
    pub text: String,
}

fn text_of<'v>(of: &'v Value, name: &str) -> &'v str {
    of[name].as_str().unwrap_or_default()
}

fn list<'v>(of: &'v Value, name: &str) -> &'v [Value] {
    of[name].as_array().map_or(&[], Vec::as_slice)
}

fn words(of: &Value, name: &str) -> Vec<String> {
    list(of, name).iter().filter_map(Value::as_str).map(String::from).collect()
}

/// Text that stands as it is in a table of Markdown.
pub fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '|' | '*' | '[' | ']' | '_' | '`' | '$' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            '\n' => out.push(' '),
            _ => out.push(c),
        }
    }
    out
}

/// Code in a table of Markdown.
fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{}`", text.replace('|', "\\|")) }
}

/// One chapter for every table at the top of the model file, after an overview.
pub fn model_chapters(ask: Ask) -> Result<Vec<Chapter>, String> {
    let top = ask("")?;
    let mut overview = String::from(
        "# The model file\n\nGenerated from the declarations that the reader uses; `rotordyn help KEY` shows the same \
         in the terminal, and `rotordyn help --schema` gives a JSON Schema of it for editors.\n\n\
         Values are written with their unit, `\"20 um\"`; a bare number is an error where a unit is needed.\n\n",
    );
    let mut anchors = HashSet::new();
    overview += &key_tables(list(&top, "members"), &mut anchors);
    let mut chapters = Vec::new();
    let mut seen = HashSet::new();
    for key in list(&top, "members") {
        if !is_table(key) || !seen.insert(text_of(key, "path").to_string()) {
            continue;
        }
        let name = text_of(key, "name");
        let mut text = format!("# {}\n", plain(&header(key)));
        sections(key, 2, ask, &mut text)?;
        chapters.push(Chapter { title: name.into(), path: format!("reference/model/{name}.md"), text });
    }
    let links = chapters.iter().map(|of| format!("[{}](model/{}.md)", of.title, of.title));
    let _ = write!(overview, "\nTables: {}.\n", links.collect::<Vec<_>>().join(", "));
    let overview =
        Chapter { title: "The model file".into(), path: "reference/model.md".into(), text: overview };
    chapters.insert(0, overview);
    Ok(chapters)
}

fn is_table(key: &Value) -> bool {
    key["members"].as_u64().unwrap_or(0) > 0
}

/// How the table is headed in a file.
fn header(key: &Value) -> String {
    let path = text_of(key, "path");
    match text_of(key, "kind") {
        "named tables" => format!("[{path}.NAME]"),
        "list of tables" => format!("[[{path}]]"),
        _ => format!("[{path}]"),
    }
}

/// The keys of a table, then the tables in it.
fn sections(table: &Value, level: usize, ask: Ask, out: &mut String) -> Result<(), String> {
    let path = text_of(table, "path");
    let found = ask(path)?;
    for form in list(&found, "keys") {
        let _ = write!(out, "\n{}\n", plain(text_of(form, "meaning")));
        let without = text_of(form, "absent");
        if !without.is_empty() {
            let _ = write!(out, "\nWithout it: {}.\n", plain(without));
        }
    }
    out.push('\n');
    let members = list(&found, "members");
    let mut anchors = HashSet::new();
    *out += &key_tables(members, &mut anchors);
    let mut seen = HashSet::new();
    for key in members.iter().filter(|key| is_table(key)) {
        if seen.insert(text_of(key, "path").to_string()) {
            let _ = write!(out, "\n{} {}\n", "#".repeat(level.min(5)), plain(&header(key)));
            sections(key, level + 1, ask, out)?;
        }
    }
    Ok(())
}

/// Tables of keys: one for each condition under which keys apply.
fn key_tables(keys: &[Value], anchors: &mut HashSet<String>) -> String {
    let mut groups: Vec<(Vec<String>, Vec<&Value>)> = Vec::new();
    for key in keys {
        let conditions: Vec<String> =
            words(key, "conditions").into_iter().filter(|c| !c.is_empty()).collect();
        match groups.iter_mut().find(|(known, _)| *known == conditions) {
            Some((_, members)) => members.push(key),
            None => groups.push((conditions, vec![key])),
        }
    }
    let mut out = String::new();
    for (conditions, members) in groups {
        if !conditions.is_empty() {
            let each: Vec<String> = conditions.iter().map(|c| code(c)).collect();
            let _ = write!(out, "\nWith {}:\n\n", each.join(" or "));
        }
        out += "| key | value | without it | meaning |\n|---|---|---|---|\n";
        for key in members {
            out += &key_row(key, anchors);
        }
    }
    out
}

fn key_row(key: &Value, anchors: &mut HashSet<String>) -> String {
    let (path, name) = (text_of(key, "path"), text_of(key, "name"));
    let anchor = match anchors.insert(path.to_string()) {
        true => format!("<a id=\"{path}\"></a>"),
        false => String::new(),
    };
    let unit = text_of(key, "unit");
    let unit = if unit.is_empty() { String::new() } else { format!(" \\[{}\\]", plain(unit)) };
    let range = text_of(key, "range");
    let range = if range.is_empty() { String::new() } else { format!(", {}", plain(range)) };
    let example = text_of(key, "example");
    let example = match example {
        "" => String::new(),
        value => format!(" Example: {}", code(&format!("{name} = {value}"))),
    };
    let absent = match key["default"].as_str() {
        Some(default) if default == text_of(key, "absent") => code(default),
        _ => plain(text_of(key, "absent")),
    };
    format!(
        "| {anchor}{} | {}{unit}{range} | {absent} | {}{example} |\n",
        code(name),
        plain(text_of(key, "value")),
        plain(text_of(key, "meaning")),
    )
}

/// All commands with their options.
pub fn commands_chapter(ask: Ask) -> Result<Chapter, String> {
    let found = ask("commands")?;
    let mut out = String::from(
        "# Commands\n\nGenerated from the declarations of the command line; `rotordyn COMMAND --help` shows the same.\n\n\
         | command | what it does |\n|---|---|\n",
    );
    for command in list(&found, "commands") {
        let name = text_of(command, "name");
        let _ = writeln!(out, "| [`{name}`](#rotordyn-{name}) | {} |", plain(text_of(command, "about")));
    }
    out += "\n## Options of every command\n\n";
    out += &options(list(&found, "options_of_all"));
    for command in list(&found, "commands") {
        let _ = write!(out, "\n## rotordyn {}\n\n", text_of(command, "name"));
        for paragraph in text_of(command, "long_about").split("\n\n") {
            let _ = write!(out, "{}\n\n", plain(paragraph));
        }
        out += &options(list(command, "arguments"));
        let after = text_of(command, "after_help").trim();
        if !after.is_empty() {
            let _ = write!(out, "\n```text\n{after}\n```\n");
        }
    }
    let _ =
        write!(out, "\n## Units, files and exit codes\n\n```text\n{}\n```\n", text_of(&found, "after_help"));
    Ok(Chapter { title: "Commands".into(), path: "reference/commands.md".into(), text: out })
}

fn options(arguments: &[Value]) -> String {
    if arguments.is_empty() {
        return "No options of its own.\n".into();
    }
    let mut out = String::from("| argument | meaning |\n|---|---|\n");
    for argument in arguments {
        let value = text_of(argument, "value");
        let name = match argument["long"].as_str() {
            Some(long) if value.is_empty() => format!("--{long}"),
            Some(long) => format!("--{long} <{value}>"),
            None => format!("<{value}>"),
        };
        let short = argument["short"].as_str().map_or(String::new(), |short| format!("-{short}, "));
        let mut help = plain(text_of(argument, "help"));
        let words = words(argument, "words");
        if !words.is_empty() {
            let _ = write!(help, " One of {}.", words.iter().map(|w| code(w)).collect::<Vec<_>>().join(", "));
        }
        let default = text_of(argument, "default");
        if !default.is_empty() {
            let _ = write!(help, " Default: {}.", code(default));
        }
        let _ = writeln!(out, "| {} | {help} |", code(&format!("{short}{name}")));
    }
    out
}

/// All codes of warnings.
pub fn warnings_chapter(ask: Ask) -> Result<Chapter, String> {
    let found = ask("warnings")?;
    let mut out = String::from(
        "# Warnings\n\nEvery warning has a code. It is printed, stored in `results.h5`, and in the document of `--json`; \
         with `--strict` a command with warnings ends with exit code 5.\n\n",
    );
    for code in list(&found, "warnings_explained") {
        let _ = write!(
            out,
            "## {}\n\nSeverity: {}. {}\n\nWhat to do: {}.\n\n",
            text_of(code, "code"),
            text_of(code, "severity"),
            plain(text_of(code, "when")),
            plain(text_of(code, "advice").trim_end_matches('.')),
        );
    }
    Ok(Chapter { title: "Warnings".into(), path: "reference/warnings.md".into(), text: out })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_model::keys;
    use rotordyn_model::schema::json_schema;
    use std::collections::BTreeSet;

    /// What `rotordyn help PATH --json` prints, which is this document.
    fn help(path: &str) -> Result<Value, String> {
        keys::find(path).map(|found| Value::from(&found)).map_err(|unknown| unknown.to_string())
    }

    /// Paths of keys in a schema: of tables, of items of named tables and of lists, in all their forms.
    fn paths_of_schema(schema: &Value, path: &str, out: &mut BTreeSet<String>) {
        for form in list(schema, "anyOf") {
            paths_of_schema(form, path, out);
        }
        for inner in ["additionalProperties", "items"] {
            if schema[inner].is_object() {
                paths_of_schema(&schema[inner], path, out);
            }
        }
        for (name, of) in schema["properties"].as_object().into_iter().flatten() {
            let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
            paths_of_schema(of, &path, out);
            out.insert(path);
        }
    }

    /// Paths of the anchors of the generated chapters.
    fn paths_of_book(chapters: &[Chapter]) -> BTreeSet<String> {
        let anchors = chapters.iter().flat_map(|of| of.text.split("<a id=\"").skip(1));
        anchors.filter_map(|rest| rest.split('"').next()).map(String::from).collect()
    }

    /// Paths of the keys that `help` lists, from the top downwards.
    fn paths_of_help(path: &str, out: &mut BTreeSet<String>) {
        let found = help(path).unwrap();
        for key in list(&found, "members") {
            let inner = text_of(key, "path");
            out.insert(inner.into());
            // Another form of the same key may be no table.
            if is_table(key) {
                paths_of_help(inner, out);
            }
        }
    }

    /// One declaration: the keys that the reader accepts are those of `help`, of the schema and of the book.
    #[test]
    fn every_key_is_in_help_schema_and_book() {
        let read: BTreeSet<String> = keys::all().into_iter().map(|key| key.path).collect();
        assert!(read.len() > 350, "{} keys", read.len());
        let (mut in_help, mut in_schema) = (BTreeSet::new(), BTreeSet::new());
        paths_of_help("", &mut in_help);
        paths_of_schema(&json_schema(), "", &mut in_schema);
        let chapters = model_chapters(&help).unwrap();
        let in_book = paths_of_book(&chapters);
        for (place, found) in [("help", &in_help), ("schema", &in_schema), ("book", &in_book)] {
            let missing: Vec<&String> = read.difference(found).collect();
            let more: Vec<&String> = found.difference(&read).collect();
            assert!(missing.is_empty(), "not in {place}: {missing:?}");
            assert!(more.is_empty(), "in {place}, but not read: {more:?}");
        }
        // Each row of the book has the meaning of its key.
        let text: String = chapters.iter().map(|chapter| chapter.text.as_str()).collect();
        for key in keys::all() {
            assert!(text.contains(&plain(key.meaning)), "{}: {}", key.path, key.meaning);
        }
    }
}
