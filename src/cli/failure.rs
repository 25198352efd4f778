//! Failures of a command and their exit codes.

use rotordyn::assembly::PhysicsError;
use rotordyn::error::Error;
use rotordyn::model::ModelErrors;
use rotordyn::plot::FigureError;
use rotordyn::series::SeriesError;
use rotordyn::signal::SignalError;
use rotordyn::signal::record::RecordError;
use rotordyn::study::StudyError;
use rotordyn::update::UpdateFailure;
use serde_json::{Value, json};

use super::interrupt;

/// Reason for which a command failed.
#[derive(Debug)]
pub enum Failure {
    /// Errors of the model file or of `--set`, each with its location.
    Model(ModelErrors),
    /// Other invalid input: arguments, settings, measured data.
    Input(String),
    /// Error of the library: no solution, invalid data or a file operation.
    Library(Error),
    /// Samples of a run of this job that a study cannot use: no file and no argument is wrong.
    AfterRun(SignalError),
    /// Ctrl-C, SIGTERM or SIGHUP.
    Interrupted,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Library(error)
    }
}

impl From<PhysicsError> for Failure {
    fn from(error: PhysicsError) -> Self {
        Self::Library(error.into())
    }
}

impl From<SignalError> for Failure {
    fn from(error: SignalError) -> Self {
        Self::Library(error.into())
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        Self::Library(error.into())
    }
}

impl From<SeriesError> for Failure {
    fn from(error: SeriesError) -> Self {
        Self::Library(error.into())
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        Self::Library(error.into())
    }
}

impl From<UpdateFailure> for Failure {
    fn from(error: UpdateFailure) -> Self {
        Self::Library(error.into())
    }
}

impl From<FigureError> for Failure {
    fn from(FigureError { operation, path, source }: FigureError) -> Self {
        Self::Library(Error::Environment { operation, path, source })
    }
}

impl From<ModelErrors> for Failure {
    fn from(errors: ModelErrors) -> Self {
        Self::Model(errors)
    }
}

impl Failure {
    /// A file operation that failed.
    pub fn environment(operation: &'static str, path: &std::path::Path, source: std::io::Error) -> Self {
        Self::Library(Error::of_file(operation, path)(source))
    }

    /// Tables or a JSON document that standard output did not take.
    pub fn lost_output(source: std::io::Error) -> Self {
        let lost = format!("{source}; what is printed there is incomplete, files are not affected");
        Self::environment("write to", std::path::Path::new("standard output"), std::io::Error::other(lost))
    }

    /// The same failure with what it means for the results.
    pub fn with_consequence(self, consequence: &str) -> Self {
        match self {
            Self::Library(Error::Environment { operation, path, source }) => {
                Self::Library(Error::Environment {
                    operation,
                    path,
                    source: format!("{source}; {consequence}").into(),
                })
            }
            other => other,
        }
    }

    /// Failure of a study of the samples of a run; `computed`: the run is one of this job, not one that the user named.
    pub fn of_samples(error: StudyError, computed: bool) -> Self {
        match error.into() {
            Error::Signal(error) if computed => Self::AfterRun(error),
            other => Self::Library(other),
        }
    }

    /// The same failure with the file it concerns, if its message does not name it.
    pub fn of_file(self, path: &std::path::Path) -> Self {
        let name = path.display().to_string();
        let message = self.message();
        match self {
            Self::Library(Error::Environment { .. }) | Self::Interrupted => self,
            other if message.contains(&name) => other,
            _ => Self::Input(format!("{name}: {message}")),
        }
    }

    /// 2 input, 3 physics, 4 environment, 130 Ctrl-C, 143 SIGTERM, 129 SIGHUP.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Model(_) | Self::Input(_) => 2,
            Self::Library(
                Error::Signal(_)
                | Error::Record(_)
                | Error::Identify(_)
                | Error::Update(_)
                | Error::Content { .. },
            ) => 2,
            Self::Library(Error::Physics(_)) | Self::AfterRun(_) => 3,
            Self::Library(Error::Environment { .. }) => 4,
            Self::Interrupted => interrupt::exit_code(),
        }
    }

    fn kind(&self) -> &'static str {
        match self.exit_code() {
            2 => "input",
            3 => "physics",
            4 => "environment",
            _ => "interrupted",
        }
    }

    /// Message in one line.
    pub fn message(&self) -> String {
        match self {
            Self::Model(errors) => errors.to_string(),
            Self::Input(message) => message.clone(),
            Self::Library(error) => error.to_string(),
            Self::AfterRun(error) => error.to_string(),
            Self::Interrupted => format!("ended by {}", interrupt::cause()),
        }
    }

    /// JSON: kind, exit_code, message, and the locations in the model file.
    pub fn to_json(&self) -> Value {
        let problems = match self {
            Self::Model(errors) => errors
                .diagnostics
                .iter()
                .map(|d| {
                    json!({
                        "kind": format!("{:?}", d.kind),
                        "source": errors.sources.get(d.source).map(|s| &s.name),
                        "span": [d.span.start, d.span.end],
                        "message": d.message,
                        "expected": d.expected,
                        "hint": d.hint,
                    })
                })
                .collect(),
            _ => Vec::new(),
        };
        json!({
            "kind": self.kind(),
            "exit_code": self.exit_code(),
            "message": self.message(),
            "problems": problems,
        })
    }
}
