//! Common style of all figures: sizes, colours, line styles.

use super::svg::{Color, Dash, Style};

/// Width of a normal figure \[px\].
pub const WIDTH: f64 = 760.0;
/// Left margin of a panel with a y axis \[px\].
pub const LEFT: f64 = 74.0;
/// Right margin of a panel without end labels \[px\].
pub const RIGHT: f64 = 24.0;
/// Margin below a panel for tick labels and the axis label \[px\].
pub const BOTTOM: f64 = 48.0;
/// Gap between stacked panels with a common x axis \[px\].
pub const GAP: f64 = 16.0;

pub const TITLE: f64 = 14.0;
pub const LABEL: f64 = 12.0;
pub const TICK: f64 = 11.0;
pub const SMALL: f64 = 10.0;

pub const WHITE: Color = Color(255, 255, 255);
pub const INK: Color = Color(32, 32, 36);
pub const MUTED: Color = Color(102, 102, 108);
pub const PALE: Color = Color(170, 170, 176);
pub const GRID: Color = Color(231, 231, 235);
pub const STEEL: Color = Color(214, 220, 228);
pub const BLUE: Color = Color(25, 98, 181);
pub const RED: Color = Color(204, 42, 42);
pub const GREEN: Color = Color(0, 128, 92);
pub const PURPLE: Color = Color(128, 66, 172);
pub const ORANGE: Color = Color(201, 104, 12);

/// Frame of a panel.
pub const FRAME: Style = Style::stroke(Color(70, 70, 76), 0.9);

/// Line style of curve number k: colour, dash and lightness differ, so that it is also readable in grey.
pub fn curve(k: usize) -> Style {
    const COLORS: [Color; 6] = [BLUE, RED, INK, GREEN, PURPLE, ORANGE];
    const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::DashDot, Dash::Dotted];
    Style::stroke(COLORS[k % COLORS.len()], 1.5).dashed(DASHES[k % DASHES.len()])
}
