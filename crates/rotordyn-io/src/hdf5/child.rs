//! An HDF5 file that another process reads: a crash, an endless loop or a want of memory of the HDF5 library is an error.

use std::cell::RefCell;
use std::io::{BufReader, ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};

use nalgebra::Complex;

use super::protocol::{Answer, Question, receive, receive_complex, receive_numbers, send};
use super::reader::{Links, OpenFile, Reader, damaged};
use super::{Array, Attribute};
use crate::budget::{Budget, Limits, regular_size};
use crate::error::Error;

/// First argument of the program when it is to read a file for another process.
pub(super) const READER_ARGUMENT: &str = "hdf5-reader";

/// Opens a file for reading: in a process of its own if the limits name its program, else in this one.
///
/// # Errors
/// The file cannot be read, is no HDF5 file, or the process cannot be started.
pub fn open_reader(path: impl AsRef<Path>, limits: &Limits) -> Result<Box<dyn Reader>, Error> {
    let path = path.as_ref();
    match &limits.hdf5_program {
        Some(program) => Ok(Box::new(Process::start(path, program, limits)?)),
        None => Ok(Box::new(OpenFile::open(path, limits)?)),
    }
}

/// The process that reads a file.
#[derive(Debug)]
struct Process {
    path: PathBuf,
    memory: u64,
    child: RefCell<Connection>,
}

#[derive(Debug)]
struct Connection {
    process: Child,
    questions: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Process {
    fn start(path: &Path, program: &Path, limits: &Limits) -> Result<Self, Error> {
        let file = std::fs::File::open(path).map_err(Error::of_file("open", path))?;
        let size = regular_size(path, &file)?;
        let memory = limits.memory_of(size);
        let mut command = Command::new(program);
        command.arg(READER_ARGUMENT).arg(memory.to_string()).arg(path);
        // What the HDF5 library says before it crashes helps nobody.
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        // Ctrl-C in a terminal goes to this process alone, which ends the other one.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let start_error = Error::of_file::<std::io::Error>("start a process to read", path);
        let mut process = command.spawn().map_err(&start_error)?;
        let (Some(questions), Some(answers)) = (process.stdin.take(), process.stdout.take()) else {
            return Err(start_error(ErrorKind::BrokenPipe.into()));
        };
        let answers = BufReader::with_capacity(1 << 16, answers);
        let connection = Connection { process, questions: Some(questions), answers };
        let started = Self { path: path.into(), memory, child: RefCell::new(connection) };
        match started.answer()? {
            Answer::Open => Ok(started),
            other => Err(started.unexpected(other)),
        }
    }

    /// Asks and returns the answer, without the numbers behind it.
    fn ask(&self, question: &Question) -> Result<Answer, Error> {
        let sent = {
            let questions = &mut self.child.borrow_mut().questions;
            questions.as_mut().ok_or(ErrorKind::BrokenPipe.into()).and_then(|out| {
                send(out, question)?;
                out.flush()
            })
        };
        sent.map_err(|error| self.lost(&error))?;
        self.answer()
    }

    fn answer(&self) -> Result<Answer, Error> {
        // Names and texts take more memory here than on their way.
        let answer = receive(&mut self.child.borrow_mut().answers, self.memory);
        answer.map_err(|error| self.lost(&error))
    }

    /// The error of an answer that was not given.
    fn unexpected(&self, answer: Answer) -> Error {
        match answer {
            Answer::Failed(problem, advice) => Error::Content { path: self.path.clone(), problem, advice },
            _ => damaged(&self.path, "the answer of the reading process does not fit the question".into()),
        }
    }

    /// The error of a process that answers no more.
    fn lost(&self, error: &std::io::Error) -> Error {
        let mut connection = self.child.borrow_mut();
        connection.questions = None;
        // The pipe is closed when the process has ended; else it said what cannot be understood.
        if error.kind() == ErrorKind::InvalidData {
            let _ = connection.process.kill();
            return damaged(&self.path, format!("the reading process gave no proper answer: {error}"));
        }
        let problem = match connection.process.wait() {
            Ok(status) => end_of_process(status),
            Err(error) => format!("the HDF5 library ended on this file ({error})"),
        };
        damaged(&self.path, problem)
    }

    /// A list for as many values as a shape has.
    fn list<T>(&self, name: &str, shape: &[usize]) -> Result<(usize, Vec<T>), Error> {
        let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
        let count = count.unwrap_or(usize::MAX);
        let list = Budget::of_memory(self.memory).list(|| name.to_owned(), count);
        Ok((count, list.map_err(|exceeded| exceeded.of_file(&self.path))?))
    }

    fn numbers(&self, name: &str, question: &Question) -> Result<Array<f64>, Error> {
        match self.ask(question)? {
            Answer::Numbers(shape) => {
                let (count, mut data) = self.list(name, &shape)?;
                let read = receive_numbers(&mut self.child.borrow_mut().answers, &mut data, count);
                read.map_err(|error| self.lost(&error))?;
                Ok(Array { shape, data })
            }
            other => Err(self.unexpected(other)),
        }
    }
}

/// Why a process ended before it was asked to.
fn end_of_process(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return match signal {
            // SIGXCPU
            24 => "the HDF5 library came to no end on this file (signal 24)".into(),
            // SIGABRT, SIGKILL
            6 | 9 => format!(
                "the HDF5 library was ended on this file (signal {signal}), as it is when memory runs out"
            ),
            _ => format!("the HDF5 library crashed on this file (signal {signal})"),
        };
    }
    format!("the process that reads this file ended ({status})")
}

impl Drop for Connection {
    fn drop(&mut self) {
        // Without questions it ends by itself, unless it is in a loop.
        self.questions = None;
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Reader for Process {
    fn path(&self) -> &Path {
        &self.path
    }

    fn memory(&self) -> u64 {
        self.memory
    }

    fn contains(&self, name: &str) -> Result<bool, Error> {
        match self.ask(&Question::Contains(name.into()))? {
            Answer::Contains(there) => Ok(there),
            other => Err(self.unexpected(other)),
        }
    }

    fn members(&self, group: &str) -> Result<Vec<String>, Error> {
        match self.ask(&Question::Members(group.into()))? {
            Answer::Names(names) => Ok(names),
            other => Err(self.unexpected(other)),
        }
    }

    fn links(&self, group: &str) -> Result<Links, Error> {
        match self.ask(&Question::Links(group.into()))? {
            Answer::Links(links) => Ok(links),
            other => Err(self.unexpected(other)),
        }
    }

    fn attribute(&self, object: &str, name: &str) -> Result<Option<Attribute>, Error> {
        match self.ask(&Question::Attribute(object.into(), name.into()))? {
            Answer::Attribute(found) => Ok(found),
            other => Err(self.unexpected(other)),
        }
    }

    fn attributes(&self, object: &str) -> Result<Vec<(String, Attribute)>, Error> {
        match self.ask(&Question::Attributes(object.into()))? {
            Answer::Attributes(found) => Ok(found),
            other => Err(self.unexpected(other)),
        }
    }

    fn read(&self, name: &str) -> Result<Array<f64>, Error> {
        self.numbers(name, &Question::Read(name.into()))
    }

    fn read_range(&self, name: &str, range: Range<usize>) -> Result<Vec<f64>, Error> {
        Ok(self.numbers(name, &Question::ReadRange(name.into(), range))?.data)
    }

    fn read_complex(&self, name: &str) -> Result<Array<Complex<f64>>, Error> {
        match self.ask(&Question::ReadComplex(name.into()))? {
            Answer::ComplexNumbers(shape) => {
                let (count, mut data) = self.list(name, &shape)?;
                let read = receive_complex(&mut self.child.borrow_mut().answers, &mut data, count);
                read.map_err(|error| self.lost(&error))?;
                Ok(Array { shape, data })
            }
            other => Err(self.unexpected(other)),
        }
    }

    fn references(&self, name: &str) -> Result<Vec<String>, Error> {
        match self.ask(&Question::References(name.into()))? {
            Answer::Names(marks) => Ok(marks),
            other => Err(self.unexpected(other)),
        }
    }

    fn read_texts(&self, name: &str) -> Result<Vec<String>, Error> {
        match self.ask(&Question::ReadTexts(name.into()))? {
            Answer::Names(texts) => Ok(texts),
            other => Err(self.unexpected(other)),
        }
    }
}
