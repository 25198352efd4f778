//! Perceptually uniform colour map for levels: white, yellow, red, violet, near black.

use std::sync::LazyLock;

use super::svg::Color;

/// Number of colours.
pub const COUNT: usize = 200;

static TABLE: LazyLock<[Color; COUNT]> =
    LazyLock::new(|| std::array::from_fn(|k| shade(k as f64 / (COUNT - 1) as f64)));

/// Colour of each index, from the lowest level to the highest.
pub fn table() -> &'static [Color; COUNT] {
    &TABLE
}

/// Table index of a level between the bounds; levels outside are clamped. None for a non-finite level.
pub fn index(level: f64, lo: f64, hi: f64) -> Option<u8> {
    if !level.is_finite() {
        return None;
    }
    let part = ((level - lo) / (hi - lo)).clamp(0.0, 1.0);
    Some((part * (COUNT - 1) as f64).round() as u8)
}

/// Colour at 0 to 1: OKLab lightness decreases linearly, so that it is also readable in grey; the hue goes
/// from yellow over red to violet; the chroma follows a smooth curve limited by the sRGB gamut.
fn shade(t: f64) -> Color {
    let lightness = 0.995 - 0.83 * t;
    let hue = (100.0 - 175.0 * t).to_radians();
    let max_chroma = 0.19 * (std::f64::consts::PI * t.powf(0.75)).sin().max(0.0) + 0.02 * t;
    let mut chroma = max_chroma;
    let mut rgb = oklch(lightness, chroma, hue);
    while chroma > 0.0 && rgb.iter().any(|c| !(-1e-4..=1.0001).contains(c)) {
        chroma -= 0.002;
        rgb = oklch(lightness, chroma.max(0.0), hue);
    }
    let [r, g, b] = rgb.map(|c| (gamma(c.clamp(0.0, 1.0)) * 255.0).round() as u8);
    Color(r, g, b)
}

/// Linear sRGB of an OKLCh colour (Ottosson 2020, A perceptual color space for image processing).
fn oklch(lightness: f64, chroma: f64, hue: f64) -> [f64; 3] {
    let (a, b) = (chroma * hue.cos(), chroma * hue.sin());
    let l = (lightness + 0.3963377774 * a + 0.2158037573 * b).powi(3);
    let m = (lightness - 0.1055613458 * a - 0.0638541728 * b).powi(3);
    let s = (lightness - 0.0894841775 * a - 1.2914855480 * b).powi(3);
    [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ]
}

/// sRGB transfer function.
fn gamma(c: f64) -> f64 {
    if c <= 0.0031308 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}
