//! Former spellings are accepted, with a note: those of flags, of their values and of keys of the model file.

use rotordyn::model::{Diagnostic, Source};

use super::args::Command;
use super::failure::Failure;
use super::terminal::Terminal;

/// Renamed flags: commands, former and present spelling. The aliases themselves are in the arguments (clap).
const FLAGS: &[(&[&str], &str, &str)] = &[
    (&["static"], "--cage-as-placed", "--fixed-cage-angle"),
    (&["bearing"], "--hold", "--constrain"),
    (&["bearing"], "--averaged", "--cage-average"),
    (&["signal", "validate"], "--pulses-per-turn", "--pulses-per-rev"),
    (&["identify"], "--window", "--exponential-window"),
    (&["poincare", "lyapunov", "bifurcation"], "--settle", "--transient-periods"),
    (&["signal"], "--rates", "--bearing-orders"),
    (&["signal"], "--beside", "--quadrature-channel"),
    (&["signal"], "--datum", "--reference-time"),
    (&["signal"], "--against", "--compare-with"),
    (&["signal"], "--against-channel", "--compare-channel"),
    (&["signal"], "--against-rate", "--compare-rate"),
    (&["signal"], "--against-unit", "--compare-unit"),
    (&["signal"], "--against-speed", "--compare-speed"),
    (&["signal"], "--against-time", "--compare-time"),
];

/// Replaces former values of flags and notes every former spelling.
///
/// # Errors
/// A flag given in both spellings.
pub fn resolve(command: &mut Command, terminal: &Terminal) -> Result<(), Failure> {
    let args: Vec<String> =
        std::env::args_os().skip(1).map(|arg| arg.to_string_lossy().into_owned()).collect();
    let mut notes = flag_notes(name(command), &args).map_err(Failure::Input)?;
    notes.extend(resolve_values(command));
    notes.iter().for_each(|note| terminal.note(note));
    Ok(())
}

/// Name of a command that has renamed flags.
fn name(command: &Command) -> &'static str {
    match command {
        Command::Static { .. } => "static",
        Command::Bearing(_) => "bearing",
        Command::Signal(_) => "signal",
        Command::Validate(_) => "validate",
        Command::Identify(_) => "identify",
        Command::Poincare(_) => "poincare",
        Command::Lyapunov(_) => "lyapunov",
        Command::Bifurcation(_) => "bifurcation",
        _ => "",
    }
}

/// Notes on the former flags of a command line, or the flag that is given in both spellings.
fn flag_notes(command: &str, args: &[String]) -> Result<Vec<String>, String> {
    let flags = || args.iter().take_while(|arg| *arg != "--");
    let given = |flag: &str| flags().any(|arg| arg.split('=').next() == Some(flag));
    let mut notes = Vec::new();
    for (_, old, new) in FLAGS.iter().filter(|(commands, old, _)| commands.contains(&command) && given(old)) {
        if given(new) {
            return Err(format!("{old} is the former name of {new}: give only {new}"));
        }
        notes.push(format!("{old} is now {new}"));
    }
    Ok(notes)
}

/// Replaces former values of flags by the present ones; notes on each.
fn resolve_values(command: &mut Command) -> Vec<String> {
    let mut notes = Vec::new();
    let mut replace = |flag: &str, value: &mut String, old: &str, new: &str| {
        if value == old {
            *value = new.into();
            notes.push(format!("{flag} {old} is now {flag} {new}"));
        }
    };
    match command {
        Command::Bifurcation(args) => {
            if let Some(start) = &mut args.start {
                replace("--start", start, "carried", "continuation");
            }
        }
        Command::Signal(args) => {
            if let Some(band) = &mut args.diagnosis.band {
                replace("--band", band, "whole", "full");
            }
            for analysis in &mut args.analyses {
                replace("--analyses", analysis, "average", "synchronous-average");
                replace("--analyses", analysis, "cyclic", "cyclic-coherence");
            }
        }
        _ => {}
    }
    notes
}

/// Notes the hints of a model file, with file and line number.
pub fn print_hints(hints: &[Diagnostic], sources: &[Source], terminal: &Terminal) {
    for hint in hints {
        let place = sources.get(hint.source).map_or(String::new(), |source| {
            let line = source.text.bytes().take(hint.span.start).filter(|byte| *byte == b'\n').count() + 1;
            match source.text.split(' ').next() {
                _ if hint.source == 0 => format!("{}:{line}: ", source.name),
                Some(flag) if !flag.is_empty() => format!("{flag}: "),
                _ => String::new(),
            }
        });
        terminal.note(&format!("{place}{}", hint.message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::Cli;
    use clap::{CommandFactory, Parser};

    fn words(line: &str) -> Vec<String> {
        line.split(' ').map(String::from).collect()
    }

    #[test]
    fn every_former_flag_is_a_hidden_alias() {
        let cli = Cli::command();
        for (commands, old, new) in FLAGS {
            for name in *commands {
                let command = cli.find_subcommand(name).unwrap();
                let flag = command.get_arguments().find(|a| a.get_long() == Some(&new[2..])).unwrap();
                assert_eq!(flag.get_all_aliases(), Some(vec![&old[2..]]), "{name} {new}");
                assert!(flag.get_visible_aliases().is_none_or(|visible| visible.is_empty()), "{name} {new}");
            }
        }
        cli.debug_assert();
    }

    #[test]
    fn notes_on_former_flags() {
        let notes = |command: &str, line: &str| flag_notes(command, &words(line));
        assert_eq!(notes("bearing", "bearing m.toml --hold x").unwrap(), ["--hold is now --constrain"]);
        assert_eq!(notes("bearing", "bearing m.toml --hold=x").unwrap(), ["--hold is now --constrain"]);
        for line in ["bearing m.toml --constrain x", "bearing m.toml -- --hold"] {
            assert!(notes("bearing", line).unwrap().is_empty());
        }
        // `spectrogram --window` keeps its name.
        assert!(notes("", "spectrogram out --window hann").unwrap().is_empty());
        let both = notes("bearing", "bearing m.toml --hold x --constrain=y").unwrap_err();
        assert_eq!(both, "--hold is the former name of --constrain: give only --constrain");
    }

    #[test]
    fn former_values_are_replaced() {
        let mut cli = Cli::parse_from(words(
            "rotordyn signal r.mat --band whole --analyses envelope,average,cyclic,synchronous-average",
        ));
        let notes = resolve_values(&mut cli.command);
        let Command::Signal(args) = cli.command else { panic!() };
        assert_eq!(args.diagnosis.band.as_deref(), Some("full"));
        assert_eq!(
            args.analyses,
            ["envelope", "synchronous-average", "cyclic-coherence", "synchronous-average"]
        );
        assert_eq!(
            notes,
            [
                "--band whole is now --band full",
                "--analyses average is now --analyses synchronous-average",
                "--analyses cyclic is now --analyses cyclic-coherence"
            ]
        );
        let mut cli = Cli::parse_from(words("rotordyn bifurcation m.toml --start carried"));
        assert_eq!(resolve_values(&mut cli.command), ["--start carried is now --start continuation"]);
    }
}
