//! Embedded font (DejaVu Sans): for the renderer and for text width.

use std::sync::{Arc, LazyLock};

use resvg::usvg::fontdb;
use skrifa::prelude::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

static FILE: &[u8] = include_bytes!("../../../assets/fonts/DejaVuSans.ttf");

static DATABASE: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut database = fontdb::Database::new();
    database.load_font_data(FILE.to_vec());
    database.set_sans_serif_family("DejaVu Sans");
    Arc::new(database)
});

static FONT: LazyLock<Option<FontRef<'static>>> = LazyLock::new(|| FontRef::new(FILE).ok());

/// The font for the renderer, loaded once.
pub fn database() -> Arc<fontdb::Database> {
    DATABASE.clone()
}

/// Width of a text \[px\] at a font size \[px\].
pub fn width(text: &str, size: f64) -> f64 {
    // Upper estimate, used only if the embedded font cannot be read.
    const FALLBACK_CHAR_WIDTH: f64 = 0.65;
    let Some(font) = FONT.as_ref() else { return FALLBACK_CHAR_WIDTH * size * text.chars().count() as f64 };
    let metrics = font.glyph_metrics(Size::new(size as f32), LocationRef::default());
    let charmap = font.charmap();
    text.chars()
        .map(|c| {
            charmap
                .map(c)
                .and_then(|glyph| metrics.advance_width(glyph))
                .map_or(FALLBACK_CHAR_WIDTH * size, f64::from)
        })
        .sum()
}

/// Text truncated to a number of characters, with an ellipsis.
pub fn shorten(text: &str, longest: usize) -> String {
    if text.chars().count() <= longest {
        return text.to_string();
    }
    text.chars().take(longest.saturating_sub(1)).chain(['…']).collect()
}

/// Text truncated to a width \[px\], with an ellipsis.
pub fn fit(text: &str, size: f64, room: f64) -> String {
    let text = shorten(text, 160);
    if width(&text, size) <= room {
        return text;
    }
    let mut count = text.chars().count();
    while count > 1 && width(&shorten(&text, count), size) > room {
        count -= 1;
    }
    shorten(&text, count)
}

/// Text broken between words into lines of a width \[px\]; what `most` lines do not hold is cut with an ellipsis.
pub fn wrapped(text: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = lines.len() >= most;
        match lines.last_mut() {
            Some(line) if full || width(&format!("{line} {word}"), size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines.iter().map(|line| fit(line, size, room)).collect()
}
