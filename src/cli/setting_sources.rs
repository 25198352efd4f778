//! Where messages about settings point: to the command line as it was written, never to text of the program.

use rotordyn::model::{Diagnostic, Source};

/// Name of the source of a setting.
const COMMAND_LINE: &str = "command line";

/// Replaces the texts of the settings, all sources behind the file, by those of the command line, and moves the spans
/// of the messages there: `--set PATH=VALUE` of the user first, then those that a flag sets. A setting of the program
/// has no text.
///
/// `set_count`: number of `--set`; `flags`: path and text of every flag that gives a setting.
pub fn as_written<'d>(
    sources: &mut [Source],
    diagnostics: impl Iterator<Item = &'d mut Diagnostic>,
    set_count: usize,
    flags: &[(String, String)],
) {
    const SET: &str = "--set ";
    let flag = |source: &Source| {
        let path = source.text.split_once('=').map_or(source.text.as_str(), |(path, _)| path);
        flags.iter().find(|(of, _)| of == path).map(|(_, text)| text.as_str())
    };
    for diagnostic in diagnostics.filter(|diagnostic| diagnostic.source > 0) {
        diagnostic.span = match sources.get(diagnostic.source).map(flag) {
            _ if diagnostic.source <= set_count => {
                diagnostic.span.start + SET.len()..diagnostic.span.end + SET.len()
            }
            Some(Some(text)) => text.find(' ').map_or(0, |at| at + 1)..text.len(),
            _ => 0..0,
        };
    }
    for (k, source) in sources.iter_mut().enumerate().skip(1) {
        source.text = match flag(source) {
            _ if k <= set_count => format!("{SET}{}", source.text),
            given => given.unwrap_or_default().into(),
        };
        source.name = COMMAND_LINE.into();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn::model::Kind;

    fn source(text: &str) -> Source {
        Source { name: "--set".into(), text: text.into() }
    }

    #[test]
    fn messages_point_to_the_command_line() {
        let mut sources = [
            source("the file"),
            source("disc.a.mass=3"),
            source("study.modal.speeds=\"3000\""),
            source("study.modal.modes=12"),
        ];
        let at = |source: usize, span: std::ops::Range<usize>| Diagnostic {
            kind: Kind::MissingUnit,
            warning: None,
            source,
            span,
            message: String::new(),
            expected: None,
            hint: None,
        };
        let mut found = [at(0, 4..8), at(1, 12..13), at(2, 19..25), at(3, 6..11)];
        let flags = [("study.modal.speeds".to_string(), "--speed \"3000\"".to_string())];
        as_written(&mut sources, found.iter_mut(), 1, &flags);
        let shown = found.map(|d| sources[d.source].text[d.span].to_string());
        assert_eq!(shown, ["file", "3", "\"3000\"", ""]);
        let texts = sources.map(|source| source.text);
        assert_eq!(texts, ["the file", "--set disc.a.mass=3", "--speed \"3000\"", ""]);
    }
}
