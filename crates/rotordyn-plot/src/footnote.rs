//! Footnotes of a figure: the warnings of its results, by code and item; lists.

use super::font;
use super::style::{LEFT, MUTED, RIGHT, SMALL};
use super::svg::{Svg, Text};
use rotordyn_core::warning::Warning;

/// Distance of two lines \[px\].
const LINE: f64 = 14.0;

/// Adds the warnings below everything drawn; nothing without any.
pub(crate) fn add(page: &mut Svg, warnings: &[Warning]) {
    let mut parts: Vec<String> = Vec::new();
    for warning in warnings {
        let item = if warning.item.is_empty() { String::new() } else { format!(" ({})", warning.item) };
        let part = format!("{}{item}", warning.code.name());
        if !parts.contains(&part) {
            parts.push(part);
        }
    }
    list(page, "Warnings:", &parts, ",");
}

/// Adds parts behind a heading below everything drawn, in lines of the page's width; nothing without any.
pub(crate) fn list(page: &mut Svg, heading: &str, parts: &[String], separator: &str) {
    if parts.is_empty() {
        return;
    }
    let room = page.width - LEFT - RIGHT;
    let mut lines = vec![String::from(heading)];
    for (k, part) in parts.iter().enumerate() {
        let word = format!(" {part}{}", if k + 1 < parts.len() { separator } else { "" });
        let last = lines.len() - 1;
        if font::width(&format!("{}{word}", lines[last]), SMALL) > room {
            lines.push(word);
        } else {
            lines[last].push_str(&word);
        }
    }
    for line in &lines {
        page.text([LEFT, page.height + 4.0], line.trim_start(), Text::new(SMALL, MUTED));
        page.height += LINE;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::warning::Code;

    #[test]
    fn every_warning_stands_below_the_figure_once() {
        let mut page = Svg::new(300.0, 100.0);
        add(&mut page, &[]);
        assert_eq!(page.height, 100.0);
        let warning = |code, item: &str| Warning::new(code, item, "text");
        let of = ["A", "B", "B"].map(|name| warning(Code::BearingUnloaded, &format!("bearing.{name}")));
        add(&mut page, &[&of[..], &[warning(Code::FreeMotion, "")]].concat());
        assert!(page.height > 100.0 + LINE);
        let svg = page.finish();
        for (text, count) in
            [("bearing-unloaded (bearing.A)", 1), ("bearing-unloaded (bearing.B)", 1), ("free-motion", 1)]
        {
            assert_eq!(svg.matches(text).count(), count, "{svg}");
        }
    }
}
