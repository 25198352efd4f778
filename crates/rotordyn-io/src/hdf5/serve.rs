//! The process that reads an HDF5 file for another one: it answers questions from standard input on standard output.

use std::ffi::OsString;
use std::io::{BufWriter, ErrorKind, Read, Result, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;

use super::Array;
use super::child::READER_ARGUMENT;
use super::protocol::{Answer, MAX_QUESTION, Question, receive, send, send_complex, send_numbers};
use super::reader::{OpenFile, Reader};
use crate::budget::Limits;
use crate::error::Error;

/// What the process is about to do: the caller sets the limits of the operating system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The file will be opened.
    Started,
    /// The file is open, and no other file is needed.
    Opened,
    /// A question will be answered, about a file of so many bytes, with so many bytes of data.
    Question { file: u64, data: u64 },
}

/// Reads a file for the process that started this one, if the arguments of the program say so; whether it ended well.
///
/// `prepare` is called with the size of the largest data set to be read \[bytes\].
pub fn serve_if_asked(
    arguments: impl IntoIterator<Item = OsString>,
    prepare: &dyn Fn(Stage, u64),
) -> Option<ExitCode> {
    let mut arguments = arguments.into_iter().skip(1);
    if arguments.next()? != READER_ARGUMENT {
        return None;
    }
    let (memory, file) = (arguments.next()?, arguments.next()?);
    let memory: u64 = memory.to_str()?.parse().ok()?;
    let prepare = |stage| prepare(stage, memory);
    prepare(Stage::Started);
    let mut questions = std::io::stdin().lock();
    let served = serve(Path::new(&file), memory, &mut questions, std::io::stdout().lock(), &prepare);
    Some(if served.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Opens `file` and answers questions until the asking process closes the pipe.
///
/// `memory`: for one data set \[bytes\].
///
/// # Errors
/// The pipes cannot be read or written. Problems of the file are answers.
fn serve(
    file: &Path,
    memory: u64,
    questions: &mut impl Read,
    answers: impl Write,
    prepare: &dyn Fn(Stage),
) -> Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, answers);
    let limits = Limits { memory: Some(memory), hdf5_program: None };
    let size = std::fs::metadata(file).map_or(0, |found| found.len());
    prepare(Stage::Question { file: size, data: 0 });
    let reader = match OpenFile::open(file, &limits) {
        Ok(reader) => reader,
        Err(error) => {
            send(&mut out, &failed(error))?;
            return out.flush();
        }
    };
    prepare(Stage::Opened);
    send(&mut out, &Answer::Open)?;
    out.flush()?;
    loop {
        let question = match receive::<Question>(questions, MAX_QUESTION) {
            Ok(question) => question,
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(error),
        };
        prepare(Stage::Question { file: size, data: 0 });
        // A panic of the hdf5 crate on a strange file is an answer, too.
        let found = catch_unwind(AssertUnwindSafe(|| {
            let data = asked_bytes(&reader, &question);
            if data > 0 {
                prepare(Stage::Question { file: size, data: data.min(memory) });
            }
            found(&reader, question)
        }));
        let found = found.unwrap_or_else(|_| {
            let problem = "the HDF5 library gave an answer that cannot be";
            Ok(Found::Answer(Answer::Failed(problem.into(), "copy the file again".into())))
        });
        match found {
            Ok(Found::Answer(answer)) => send(&mut out, &answer)?,
            Ok(Found::Numbers(Array { shape, data })) => {
                send(&mut out, &Answer::Numbers(shape))?;
                send_numbers(&mut out, &data)?;
            }
            Ok(Found::Complex(Array { shape, data })) => {
                send(&mut out, &Answer::ComplexNumbers(shape))?;
                send_complex(&mut out, &data)?;
            }
            Err(error) => send(&mut out, &failed(error))?,
        }
        out.flush()?;
    }
}

/// Size of the data that a question asks for \[bytes\]; zero for what is no data or not there.
fn asked_bytes(reader: &OpenFile, question: &Question) -> u64 {
    match question {
        Question::ReadRange(_, range) => 8 * range.len() as u64,
        Question::Read(name) => 8 * reader.values_in(name),
        Question::ReadComplex(name) => 16 * reader.values_in(name),
        // A text has a length and a place elsewhere in the file.
        Question::ReadTexts(name) => 64 * reader.values_in(name),
        _ => 0,
    }
}

/// An answer with its numbers.
enum Found {
    Answer(Answer),
    Numbers(Array<f64>),
    Complex(Array<nalgebra::Complex<f64>>),
}

fn found(reader: &OpenFile, question: Question) -> std::result::Result<Found, Error> {
    let answer = match question {
        Question::Contains(name) => Answer::Contains(reader.contains(&name)?),
        Question::Members(group) => Answer::Names(reader.members(&group)?),
        Question::Links(group) => Answer::Links(reader.links(&group)?),
        Question::Attribute(object, name) => Answer::Attribute(reader.attribute(&object, &name)?),
        Question::Attributes(object) => Answer::Attributes(reader.attributes(&object)?),
        Question::ReadTexts(name) => Answer::Names(reader.read_texts(&name)?),
        Question::References(name) => Answer::Names(reader.references(&name)?),
        Question::Read(name) => return reader.read(&name).map(Found::Numbers),
        Question::ReadComplex(name) => return reader.read_complex(&name).map(Found::Complex),
        Question::ReadRange(name, range) => {
            let data = reader.read_range(&name, range)?;
            return Ok(Found::Numbers(Array { shape: vec![data.len()], data }));
        }
    };
    Ok(Found::Answer(answer))
}

fn failed(error: Error) -> Answer {
    match error {
        Error::Content { problem, advice, .. } => Answer::Failed(problem, advice),
        other => Answer::Failed(other.to_string(), "look at the file".into()),
    }
}
