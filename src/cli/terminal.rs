//! Terminal output: tables on standard output, progress, warnings and errors on standard error.

use std::io::{self, IsTerminal, Write, stderr, stdout};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use rotordyn::linalg::StopRequest;
use rotordyn::warning::{Code, Warning};

use super::args::Output;
use super::failure::Failure;
use super::interrupt;

pub use rotordyn::document::number;

/// A number with the noun for one or for several.
pub fn counted(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// Width of printed sentences [characters].
const WIDTH: usize = 118;

/// Output streams and what is printed to them.
#[derive(Debug)]
pub struct Terminal {
    tables: bool,
    /// Whether the command ends with a JSON document.
    pub json: bool,
    progress: bool,
    notes_shown: bool,
    warnings_shown: bool,
    bold: bool,
    pub colour: bool,
    /// The user's request to end the command.
    pub stop: StopRequest,
    /// All warnings, for the JSON document.
    warnings: Mutex<Vec<Warning>>,
    /// Notes printed so far.
    notes: Mutex<Vec<String>>,
    /// Why standard output could not be written, other than by a closed pipe.
    lost: Mutex<Option<io::Error>>,
}

impl Terminal {
    pub fn new(output: &Output) -> Self {
        let dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
        let colour_allowed = !dumb && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
        Self {
            tables: !output.quiet && !output.json,
            json: output.json,
            progress: !output.quiet && !dumb && stderr().is_terminal(),
            notes_shown: !output.quiet,
            warnings_shown: true,
            bold: colour_allowed && stdout().is_terminal(),
            colour: colour_allowed && stderr().is_terminal(),
            stop: interrupt::stop_request(),
            warnings: Mutex::default(),
            notes: Mutex::default(),
            lost: Mutex::default(),
        }
    }

    /// The same without tables; its warnings are its own.
    pub fn without_tables(&self) -> Self {
        Self { tables: false, ..self.alike() }
    }

    /// The same without tables and warnings.
    pub fn without_warnings(&self) -> Self {
        Self { tables: false, warnings_shown: false, ..self.alike() }
    }

    fn alike(&self) -> Self {
        let Self { tables, json, progress, notes_shown, warnings_shown, bold, colour, .. } = *self;
        let (warnings, notes, lost) = (Mutex::default(), Mutex::default(), Mutex::default());
        let stop = self.stop.clone();
        Self {
            tables,
            json,
            progress,
            notes_shown,
            warnings_shown,
            bold,
            colour,
            stop,
            warnings,
            notes,
            lost,
        }
    }

    /// What a computation found, unless the user asked for its end.
    ///
    /// # Errors
    /// That of the computation, or [`Failure::Interrupted`].
    pub fn unless_stopped<T>(&self, found: Result<T, impl Into<Failure>>) -> Result<T, Failure> {
        if self.stop.is_requested() { Err(Failure::Interrupted) } else { found.map_err(Into::into) }
    }

    /// Prints one or more lines to standard output.
    pub fn print(&self, text: &str) {
        if self.tables {
            self.note_loss(writeln!(stdout(), "{text}"));
        }
    }

    /// Prints text that is not a table, such as JSON, also with `--quiet`.
    pub fn print_document(&self, text: &str) {
        self.note_loss(stdout().write_all(text.as_bytes()));
    }

    /// Prints rendered diagnostics to standard error, also with `--quiet`.
    pub fn diagnostics(&self, text: &str) {
        let _ = write!(stderr(), "{text}");
    }

    /// The first failure of standard output; a closed pipe (EPIPE) is none, its reader has seen enough.
    fn note_loss(&self, written: io::Result<()>) {
        if let Err(error) = written
            && error.kind() != io::ErrorKind::BrokenPipe
        {
            self.lost.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
    }

    /// Why standard output could not be written completely, if so.
    pub fn lost_output(&self) -> Option<io::Error> {
        self.note_loss(stdout().flush());
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Prints a sentence with two spaces before each of its lines, broken at words.
    pub fn print_wrapped(&self, text: &str) {
        let mut line = String::from(" ");
        for word in text.split_whitespace() {
            if line.chars().count() + word.chars().count() + 1 > WIDTH {
                self.print(&line);
                line = String::from(" ");
            }
            line.push(' ');
            line.push_str(word);
        }
        self.print(&line);
    }

    /// Prints a heading with a blank line before it.
    pub fn heading(&self, text: &str) {
        if self.bold {
            self.print(&format!("\n\x1b[1m{text}\x1b[0m"))
        } else {
            self.print(&format!("\n{text}"))
        }
    }

    /// Prints a heading and a table (see [`table`]).
    pub fn table(&self, title: &str, header: &[&str], rows: &[Vec<String>]) {
        self.heading(title);
        self.print(table(header, rows).trim_end());
    }

    /// Prints an error to standard error, also with `--quiet`.
    pub fn error(&self, text: &str) {
        let word = self.coloured(31, "error");
        let _ = writeln!(stderr(), "{word}: {text}");
    }

    /// Prints a warning with its code to standard error, also with `--quiet`.
    pub fn warn(&self, warning: &Warning) {
        self.record_warning(warning.clone());
        if self.warnings_shown {
            let word = self.coloured(33, &format!("warning[{}]", warning.code.name()));
            let _ = writeln!(stderr(), "{word}: {warning}");
        }
    }

    /// A warning about the whole of a measured file or an analysis.
    pub fn warn_of(&self, code: Code, text: impl Into<String>) {
        self.warn(&Warning::new(code, "", text));
    }

    fn coloured(&self, code: u8, word: &str) -> String {
        if self.colour { format!("\x1b[1;{code}m{word}\x1b[0m") } else { word.to_string() }
    }

    /// Prints a note to standard error, once and not with `--quiet`.
    pub fn note(&self, text: &str) {
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        if self.notes_shown && !notes.iter().any(|known| known == text) {
            let _ = writeln!(stderr(), "note: {text}");
            notes.push(text.into());
        }
    }

    /// Records a warning that is printed elsewhere.
    pub fn record_warning(&self, warning: Warning) {
        self.lock_warnings().push(warning);
    }

    fn lock_warnings(&self) -> MutexGuard<'_, Vec<Warning>> {
        self.warnings.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Warnings so far.
    pub fn warnings(&self) -> Vec<Warning> {
        self.lock_warnings().clone()
    }

    /// Spinner for work of unknown length.
    pub fn spinner(&self, what: &str) -> ProgressBar {
        let bar = self.bar(None);
        bar.set_style(style(SPINNER));
        bar.set_message(what.to_string());
        if self.progress {
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        bar
    }

    /// Progress bar over simulated time in ms; its message is set by the caller.
    pub fn time_bar(&self, duration: f64) -> ProgressBar {
        let bar = self.bar(Some((1e3 * duration).round() as u64));
        bar.set_style(time_style());
        bar
    }

    /// Progress bar over a number of equal work items; length and message are set by the caller.
    pub fn count_bar(&self) -> ProgressBar {
        let bar = self.bar(Some(0));
        bar.set_style(style(COUNT));
        bar
    }

    /// Progress bar over a completed fraction.
    pub fn fraction_bar(&self) -> ProgressBar {
        let bar = self.bar(Some(0));
        bar.set_style(style(FRACTION));
        bar
    }

    fn bar(&self, length: Option<u64>) -> ProgressBar {
        let target = if self.progress { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        ProgressBar::with_draw_target(length, target)
    }
}

/// Progress lines; they fit 40 columns, for which long messages are cut.
const SPINNER: &str = "{spinner} {elapsed} {wide_msg}";
const COUNT: &str = "{bar:8} {pos} of {len}, {eta} {wide_msg}";
const FRACTION: &str = "{bar:8} {percent} %, {eta} {wide_msg}";
const TIME: &str = "{wide_bar} {simulated}, {msg}, {eta}";

fn time_style() -> ProgressStyle {
    let seconds = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        let total = state.len().unwrap_or(0) as f64 / 1e3;
        let _ = write!(out, "{:.2} of {total:.2} s", state.pos() as f64 / 1e3);
    };
    style(TIME).with_key("simulated", seconds)
}

fn style(template: &str) -> ProgressStyle {
    // The templates are constants and valid; fall back to the default bar.
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// A number without the sign of zero: "-0.00" becomes "0.00"; other text is unchanged.
fn without_negative_zero(word: &str) -> &str {
    match word.strip_prefix('-') {
        Some(rest) if rest.parse::<f64>() == Ok(0.0) => rest,
        _ => word,
    }
}

/// Aligned text table: numeric columns right-aligned, text columns left-aligned, two spaces between; no number is
/// printed as negative zero.
pub fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let plain = |text: &String| text.split(' ').map(without_negative_zero).collect::<Vec<_>>().join(" ");
    let rows: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(plain).collect()).collect();
    let cell = |row: &'_ [String], k: usize| row.get(k).map(String::as_str).unwrap_or_default().to_string();
    let numeric = |k: usize| {
        rows.iter().all(|row| {
            let text = cell(row, k);
            text.is_empty() || text == "-" || text.parse::<f64>().is_ok()
        })
    };
    let columns: Vec<(usize, bool)> = header
        .iter()
        .enumerate()
        .map(|(k, title)| {
            let cells = rows.iter().map(|row| cell(row, k).chars().count());
            (cells.chain([title.chars().count()]).max().unwrap_or(0), numeric(k))
        })
        .collect();
    let mut out = String::new();
    let titles: Vec<String> = header.iter().map(|h| (*h).to_string()).collect();
    for row in std::iter::once(&titles).chain(&rows) {
        let mut line = String::new();
        for (k, &(width, right)) in columns.iter().enumerate() {
            let text = cell(row, k);
            // A width in a format has 16 bits, and a list of names can be longer; the last column needs no blanks behind it.
            let blanks = " ".repeat(width - text.chars().count());
            let [before, after] = match right {
                true => [blanks.as_str(), ""],
                false if k + 1 == columns.len() => ["", ""],
                false => ["", blanks.as_str()],
            };
            line.extend(["  ", before, &text, after]);
        }
        out += line.trim_end();
        out.push('\n');
    }
    out
}

/// rad/s as rpm.
pub fn rpm(speed: f64) -> f64 {
    speed * 30.0 / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_alignment() {
        let rows = vec![vec!["a".into(), "1.5".into()], vec!["long".into(), "-".into()]];
        assert_eq!(table(&["name", "Hz"], &rows), "  name   Hz\n  a     1.5\n  long    -\n");
        let names = "name, ".repeat(20_000);
        let rows = vec![vec!["a".into(), names.clone()], vec![names.clone(), "b".into()]];
        let text = table(&["name", "names"], &rows);
        assert_eq!(text.lines().nth(2), Some(format!("  {names}  b").as_str()));
    }

    #[test]
    fn table_has_no_negative_zero() {
        let row = |text: &str| vec![vec!["A".to_string(), text.to_string()]];
        for (given, shown) in
            [("-0.000", "0.000"), ("-0", "0"), ("-0.0e0 mm", "0.0e0 mm"), ("1 to -0.00", "1 to 0.00")]
        {
            assert!(table(&["", "x"], &row(given)).ends_with(&format!("  {shown}\n")), "{given}");
        }
        for given in ["-0.001", "-", "-0-", "- 0.0", "-1e-300"] {
            assert!(table(&["", "x"], &row(given)).ends_with(&format!("  {given}\n")), "{given}");
        }
    }

    /// A terminal of 40 columns that keeps what is drawn.
    #[derive(Clone, Debug, Default)]
    struct Narrow(std::sync::Arc<Mutex<String>>);

    impl indicatif::TermLike for Narrow {
        fn width(&self) -> u16 {
            40
        }
        fn move_cursor_up(&self, _: usize) -> std::io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> std::io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> std::io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> std::io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> std::io::Result<()> {
            self.write_str(&format!("{text}\n"))
        }
        fn write_str(&self, text: &str) -> std::io::Result<()> {
            self.0.lock().unwrap().push_str(text);
            Ok(())
        }
        fn clear_line(&self) -> std::io::Result<()> {
            self.write_str("\n")
        }
        fn flush(&self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn progress_fits_40_columns() {
        let film = "EHL film of bearing drive_end, outer race";
        for (style, message, length, shown) in [
            (style(SPINNER), "reading /data/measured/run_up.mat, 3 channels", 1, "reading"),
            (style(COUNT), film, 1000, "10 of 1000"),
            (style(FRACTION), "bifurcation diagram", 1000, "1 %"),
            (time_style(), "12000 rpm", 130_000, "0.01 of 130.00 s, 12000 rpm"),
        ] {
            let screen = Narrow::default();
            let target = ProgressDrawTarget::term_like(Box::new(screen.clone()));
            let bar = ProgressBar::with_draw_target(Some(length), target);
            bar.set_style(style);
            bar.set_message(message);
            bar.set_position(10);
            bar.tick();
            bar.abandon();
            let drawn = screen.0.lock().unwrap().clone();
            let last = drawn.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default().to_string();
            assert!(last.contains(shown), "{drawn:?}");
            assert!(drawn.lines().all(|line| line.trim_end().chars().count() <= 40), "{drawn:?}");
        }
    }
}
