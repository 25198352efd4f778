//! Failures as exceptions of `rotordyn.errors`, with the text that the command prints and the problems as data.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

use miette::Severity;
use pyo3::prelude::*;
use pyo3::types::PyType;
use rotordyn::linalg::StopRequest;
use rotordyn::model::ModelErrors;

use crate::cli::diagnostics::render;
use crate::cli::failure::Failure;

/// The prefix of a change by the user in the sources of the messages.
const SET: &str = "--set ";

/// Why something was not done.
pub enum Stop {
    Failure(Failure),
    /// A panic: a bug of the program.
    Bug(String),
    /// An exception of Python, such as that of a progress function.
    Python(PyErr),
}

impl<E: Into<Failure>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failure(error.into())
    }
}

/// Computes without the interpreter's lock; a panic becomes an error.
pub fn detached<T: Send>(
    py: Python<'_>,
    compute: impl FnOnce() -> Result<T, Stop> + Send,
) -> Result<T, PyErr> {
    py.detach(|| guarded(compute)).map_err(|stop| to_python(py, stop))
}

/// Time between two looks at the interpreter: for Ctrl-C, and for the progress of a run.
pub const LOOK: Duration = Duration::from_millis(50);
/// Longest wait for the end of a computation after Ctrl-C; one that does not look at the request goes on for nobody.
const PATIENCE: Duration = Duration::from_secs(1);
/// Stack of a computation: that of the main thread of a program.
const STACK: usize = 8 << 20;

/// Computes in a thread of its own, while this one looks for Ctrl-C, which requests the end of the computation and raises
/// `KeyboardInterrupt`.
pub fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    compute: impl FnOnce(&StopRequest) -> Result<T, Stop> + Send + 'static,
) -> PyResult<T> {
    let request = StopRequest::default();
    let (send, receive) = sync_channel(1);
    let own = request.clone();
    let computation = move || {
        // Nobody waits any more after a request.
        let _ = send.send(guarded(|| compute(&own)));
    };
    thread::Builder::new().name("rotordyn".into()).stack_size(STACK).spawn(computation)?;
    let wait = move || loop {
        match receive.recv_timeout(LOOK) {
            Ok(found) => return found,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Stop::Bug("a computation without an end".into()));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(raised) = Python::attach(|py| py.check_signals()) {
            request.request();
            let _ = receive.recv_timeout(PATIENCE);
            return Err(Stop::Python(raised));
        }
    };
    py.detach(wait).map_err(|stop| to_python(py, stop))
}

/// A panic as an error.
fn guarded<T>(compute: impl FnOnce() -> Result<T, Stop>) -> Result<T, Stop> {
    catch_unwind(AssertUnwindSafe(compute)).unwrap_or_else(|bug| {
        let text = bug.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| bug.downcast_ref::<&str>().copied());
        Err(Stop::Bug(text.unwrap_or("a panic").into()))
    })
}

/// The exception of a failure.
pub fn to_python(py: Python<'_>, stop: Stop) -> PyErr {
    let (class, text, problems) = match stop {
        Stop::Python(error) => return error,
        Stop::Bug(text) => {
            let advice = "please report this bug, with the model file and the call";
            ("InternalError", format!("{text}; {advice}"), String::from("[]"))
        }
        Stop::Failure(failure) => {
            let failure = match failure {
                Failure::Model(errors) => Failure::Model(in_words_of_python(errors)),
                other => other,
            };
            let class = match failure.exit_code() {
                2 => "InputError",
                4 => "FileError",
                _ => "PhysicsError",
            };
            let text = match &failure {
                Failure::Model(found) => {
                    let shown = render(&found.diagnostics, &found.sources, Severity::Error, false);
                    format!("{failure}\n{shown}", failure = failure.message())
                }
                _ => failure.message(),
            };
            let text = match &failure {
                Failure::Model(_) => text,
                _ => without_dashes(&text),
            };
            (class, text.trim_end().to_string(), failure.to_json()["problems"].to_string())
        }
    };
    let raise = || -> PyResult<PyErr> {
        let class = py.import("rotordyn.errors")?.getattr(class)?.cast_into::<PyType>()?;
        Ok(PyErr::from_value(class.call1((text, problems))?))
    };
    raise().unwrap_or_else(|error| error)
}

/// Messages about changes and arguments without the spelling of the command line: `--set PATH=VALUE` becomes `PATH=VALUE`,
/// `--max-speed "6000"` becomes `max_speed="6000"`.
pub fn in_words_of_python(mut errors: ModelErrors) -> ModelErrors {
    for (k, source) in errors.sources.iter_mut().enumerate().skip(1) {
        let cut = if let Some(rest) = source.text.strip_prefix(SET) {
            source.text = rest.to_string();
            source.name = "changed value".into();
            SET.len()
        } else if let Some((flag, value)) = source.text.strip_prefix("--").and_then(|t| t.split_once(' ')) {
            source.text = format!("{}={value}", flag.replace('-', "_"));
            source.name = "argument".into();
            "--".len()
        } else {
            continue;
        };
        for found in errors.diagnostics.iter_mut().filter(|found| found.source == k) {
            found.span = found.span.start.saturating_sub(cut)..found.span.end.saturating_sub(cut);
        }
    }
    errors
}

/// Text with the flags of the command line as arguments: `--max-speed` becomes `max_speed`.
fn without_dashes(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("--") {
        let (before, flag) = (&rest[..at], &rest[at + 2..]);
        out += before;
        let length = flag.bytes().take_while(|c| c.is_ascii_lowercase() || *c == b'-').count();
        let word = flag[..length].trim_end_matches('-');
        let starts = !before.ends_with(|c: char| c.is_alphanumeric() || c == '-');
        if starts && word.starts_with(|c: char| c.is_ascii_lowercase()) {
            out += &word.replace('-', "_");
            rest = &flag[word.len()..];
        } else {
            out += "--";
            rest = flag;
        }
    }
    out + rest
}
