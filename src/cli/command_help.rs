//! Commands and their options, described from the declarations of the command line.

use clap::{Arg, Command, CommandFactory};
use serde_json::{Value, json};

use super::args::Cli;
use super::terminal::Terminal;

/// Long help of a command.
pub fn text(name: &str) -> Option<String> {
    let mut cli = Cli::command();
    let command = cli.find_subcommand_mut(name)?;
    Some(command.render_long_help().to_string())
}

/// Every command with what it does; the document also has the options of each.
pub fn all(terminal: &Terminal) -> Value {
    let cli = Cli::command();
    let rows: Vec<Vec<String>> = shown(&cli).map(|of| vec![of.get_name().into(), about(of)]).collect();
    terminal.table("Commands; `rotordyn COMMAND --help` explains one", &["command", "what it does"], &rows);
    let commands: Vec<Value> = shown(&cli).map(describe).collect();
    json!({
        "command": "help",
        "path": "commands",
        "commands": commands,
        "options_of_all": arguments(&cli),
        "after_help": styled(cli.get_after_long_help()),
    })
}

fn shown(cli: &Command) -> impl Iterator<Item = &Command> {
    cli.get_subcommands().filter(|command| !command.is_hide_set())
}

fn about(command: &Command) -> String {
    styled(command.get_about())
}

fn styled(text: Option<&clap::builder::StyledStr>) -> String {
    text.map_or_else(String::new, ToString::to_string)
}

fn describe(command: &Command) -> Value {
    json!({
        "name": command.get_name(),
        "about": about(command),
        "long_about": styled(command.get_long_about().or(command.get_about())),
        "arguments": arguments(command),
        "after_help": styled(command.get_after_long_help()),
    })
}

/// Arguments that are not hidden: first the positional ones.
fn arguments(command: &Command) -> Vec<Value> {
    let visible = |argument: &&Arg| !argument.is_hide_set() && argument.get_id() != "help";
    let (positional, options): (Vec<&Arg>, Vec<&Arg>) =
        command.get_arguments().filter(visible).partition(|argument| argument.is_positional());
    positional.into_iter().chain(options).map(argument).collect()
}

fn argument(of: &Arg) -> Value {
    let takes_value = of.get_action().takes_values();
    let value_names: Vec<&str> =
        of.get_value_names().unwrap_or_default().iter().map(|n| n.as_str()).collect();
    let defaults: Vec<_> = of.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    let words: Vec<String> = match takes_value {
        true => of.get_possible_values().iter().map(|value| value.get_name().to_string()).collect(),
        false => Vec::new(),
    };
    json!({
        "long": of.get_long(),
        "short": of.get_short(),
        "value": if takes_value { value_names.join(" ") } else { String::new() },
        "positional": of.is_positional(),
        "required": of.is_required_set(),
        "default": if takes_value { defaults.join(",") } else { String::new() },
        "words": words,
        "help": styled(of.get_long_help().or(of.get_help())),
    })
}
