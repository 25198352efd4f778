//! Equations in TeX become MathML, which browsers show without scripts.

use pulldown_cmark::{Event, Options, Parser};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Storage, push_mathml};
use std::ops::Range;

/// Options of the Markdown that the book is written in.
pub const MARKDOWN: Options = Options::ENABLE_TABLES.union(Options::ENABLE_MATH);

/// Replaces `$...$` and `$$...$$` outside code.
///
/// # Errors
/// An equation that is no TeX, with its text.
pub fn replace_equations(text: &str) -> Result<String, String> {
    let mut out = String::new();
    let mut done = 0;
    for (event, range) in Parser::new_ext(text, MARKDOWN).into_offset_iter() {
        let (tex, display) = match &event {
            Event::InlineMath(tex) => (tex, DisplayMode::Inline),
            Event::DisplayMath(tex) => (tex, DisplayMode::Block),
            _ => continue,
        };
        let Range { start, end } = range;
        out += &text[done..start];
        out += &mathml(tex, display)?;
        done = end;
    }
    Ok(out + &text[done..])
}

fn mathml(tex: &str, display_mode: DisplayMode) -> Result<String, String> {
    let storage = Storage::new();
    let parser = pulldown_latex::Parser::new(tex, &storage);
    let events: Vec<_> = parser.collect();
    if let Some(error) = events.iter().find_map(|event| event.as_ref().err()) {
        return Err(format!("the equation `{tex}`: {error}"));
    }
    let mut out = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    push_mathml(&mut out, events.into_iter(), config)
        .map_err(|error| format!("the equation `{tex}`: {error}"))?;
    Ok(inert(&out))
}

/// On one line, without characters that Markdown would take for its own.
fn inert(html: &str) -> String {
    let mut out = String::new();
    for c in html.chars() {
        match c {
            '*' | '_' | '|' | '`' | '[' | ']' | '~' | '\\' => out += &format!("&#{};", u32::from(c)),
            '\n' => out.push(' '),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_become_mathml_and_code_stays() {
        let text = "An $a_1 = b^2$ and `$HOME`.\n\n```sh\n$ ls $x\n```\n\n$$\\frac{1}{2}$$\n";
        let got = replace_equations(text).unwrap();
        assert_eq!(got.matches("<math").count(), 2, "{got}");
        assert!(got.contains("`$HOME`") && got.contains("$ ls $x"), "{got}");
        assert!(got.contains("<msub>") && got.contains("<mfrac>"), "{got}");
        assert!(!got.contains("a_1"), "{got}");
    }

    #[test]
    fn an_unknown_command_of_tex_is_an_error() {
        let error = replace_equations("$\\nosuchcommand{x}$").unwrap_err();
        assert!(error.contains("nosuchcommand"), "{error}");
    }
}
