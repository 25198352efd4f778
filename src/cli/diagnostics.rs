//! Prints errors and warnings of a model file, each with the TOML lines that it refers to (miette).

use miette::{
    Diagnostic as Report, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError,
    MietteSpanContents, Severity, SourceCode, SourceSpan, SpanContents,
};
use rotordyn::model::{Diagnostic, Source};
use std::fmt;

/// Largest number of problems shown; the rest is counted.
const MAX_PROBLEMS: usize = 25;
/// Longest snippet shown without truncation \[bytes\]: generated lines can be megabytes long.
const MAX_SNIPPET_BYTES: usize = 2000;
/// Context kept on each side of the problem in a truncated snippet \[bytes\].
const SNIPPET_CONTEXT_BYTES: usize = 50;

/// Render errors (or warnings) with their snippets.
pub fn render(diagnostics: &[Diagnostic], sources: &[Source], severity: Severity, colour: bool) -> String {
    let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(110).with_links(false);
    let snippets: Vec<Snippet> = sources.iter().map(Snippet::new).collect();
    let mut out = String::new();
    for diagnostic in diagnostics.iter().take(MAX_PROBLEMS) {
        let problem = Problem { diagnostic, snippet: snippets.get(diagnostic.source), severity };
        if handler.render_report(&mut out, &problem).is_err() {
            out += &diagnostic.message;
        }
        out.push('\n');
    }
    if diagnostics.len() > MAX_PROBLEMS {
        out += &format!("... and {} more\n", diagnostics.len() - MAX_PROBLEMS);
    }
    out
}

/// One problem as a miette diagnostic.
#[derive(Debug)]
struct Problem<'a> {
    diagnostic: &'a Diagnostic,
    snippet: Option<&'a Snippet>,
    severity: Severity,
}

impl fmt::Display for Problem<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diagnostic.message)
    }
}

impl std::error::Error for Problem<'_> {}

impl Report for Problem<'_> {
    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        // without a snippet there is no label for what is expected
        let expected = self.diagnostic.expected.as_ref().filter(|_| self.source_code().is_none());
        let help: Vec<String> = expected
            .map(|expected| format!("expected {expected}"))
            .into_iter()
            .chain(self.diagnostic.hint.clone())
            .collect();
        (!help.is_empty()).then(|| Box::new(help.join("; ")) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.snippet.filter(|s| !s.text.trim().is_empty()).map(|s| s as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.diagnostic.span.clone();
        let text = self.diagnostic.expected.as_ref().map_or("here".into(), |e| format!("expected {e}"));
        // only the first line of a long value is underlined
        let shown = self.snippet.and_then(|s| s.text.get(span.clone())).unwrap_or_default();
        let line = shown
            .lines()
            .next()
            .unwrap_or_default()
            .len()
            .min(SNIPPET_CONTEXT_BYTES.max(shown.len().min(MAX_SNIPPET_BYTES / 20)));
        Some(Box::new(std::iter::once(LabeledSpan::new(Some(text), span.start, line))))
    }
}

/// Printable source text: control characters are masked, byte by byte.
#[derive(Debug)]
struct Snippet {
    name: String,
    text: String,
}

impl Snippet {
    fn new(source: &Source) -> Self {
        let mask = |c: char| if c.is_ascii_control() && !matches!(c, '\n' | '\r' | '\t') { '?' } else { c };
        Self { name: source.name.clone(), text: source.text.chars().map(mask).collect() }
    }
}

impl SourceCode for Snippet {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let whole = self.text.read_span(span, before, after)?;
        let (mut data, mut start) = (*whole.span(), whole.span().offset());
        let (mut line, mut column, mut lines) = (whole.line(), whole.column(), whole.line_count());
        if data.len() > MAX_SNIPPET_BYTES {
            let boundary = |mut at: usize, step: isize| {
                while !self.text.is_char_boundary(at) {
                    at = at.saturating_add_signed(step);
                }
                at
            };
            start = boundary(span.offset().saturating_sub(SNIPPET_CONTEXT_BYTES).max(start), 1);
            let end = boundary((span.offset() + span.len() + SNIPPET_CONTEXT_BYTES).min(self.text.len()), -1);
            // one line only
            let around = &self.text[start..end];
            let offset = span.offset() - start;
            let from = around[..offset].rfind('\n').map_or(0, |n| n + 1);
            let to = around[offset..].find('\n').map_or(around.len(), |n| n + offset);
            data = (start + from, to - from).into();
            line = self.text[..span.offset()].matches('\n').count();
            column = 0;
            lines = 1;
        }
        let bytes = &self.text.as_bytes()[data.offset()..data.offset() + data.len()];
        let contents = MietteSpanContents::new_named(self.name.clone(), bytes, data, line, column, lines);
        Ok(Box::new(contents))
    }
}
