//! SVG writer: shapes, text, embedded PNG; deterministic (fixed number format).

use std::fmt::Write;

use base64::Engine;

use super::font;

/// A point on the page \[px\], y downwards.
pub type Point = [f64; 2];

/// Pixels of the PNG per px of the SVG.
pub const PNG_SCALE: f32 = 2.0;

/// Largest coordinate written \[px\]; f32 renderers fail beyond it.
const MAX_COORDINATE: f64 = 1e5;
/// Longest label written \[characters\].
const MAX_LABEL_CHARS: usize = 160;

/// sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

/// Dash pattern of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Long,
    Short,
    DashDot,
    Dotted,
}

impl Dash {
    fn pattern(self) -> &'static str {
        match self {
            Dash::Solid => "",
            Dash::Long => "8 3",
            Dash::Short => "4 3",
            Dash::DashDot => "8 3 1.5 3",
            Dash::Dotted => "1.5 2.5",
        }
    }
}

/// Fill and stroke of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub fill: Option<Color>,
    pub stroke: Option<Color>,
    pub width: f64,
    pub dash: Dash,
    pub opacity: f64,
}

impl Style {
    /// A line.
    pub const fn stroke(color: Color, width: f64) -> Self {
        Style { fill: None, stroke: Some(color), width, dash: Dash::Solid, opacity: 1.0 }
    }

    /// A filled shape without an edge.
    pub const fn fill(color: Color) -> Self {
        Style { fill: Some(color), stroke: None, width: 0.0, dash: Dash::Solid, opacity: 1.0 }
    }

    /// The same with another dash pattern.
    pub const fn dashed(self, dash: Dash) -> Self {
        Style { dash, ..self }
    }

    /// The same, filled.
    pub const fn filled(self, color: Color) -> Self {
        Style { fill: Some(color), ..self }
    }

    /// The same with an opacity from 0 to 1.
    pub const fn faint(self, opacity: f64) -> Self {
        Style { opacity, ..self }
    }

    /// The same with another line width \[px\].
    pub const fn thick(self, width: f64) -> Self {
        Style { width, ..self }
    }
}

/// Horizontal alignment of text at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set; its point is on the baseline.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    pub size: f64,
    pub color: Color,
    pub anchor: Anchor,
    /// Rotated by 90° anticlockwise, for y axes.
    pub upright: bool,
    /// White outline, readable over lines.
    pub halo: bool,
}

impl Text {
    pub const fn new(size: f64, color: Color) -> Self {
        Text { size, color, anchor: Anchor::Start, upright: false, halo: false }
    }

    pub const fn middle(self) -> Self {
        Text { anchor: Anchor::Middle, ..self }
    }

    pub const fn end(self) -> Self {
        Text { anchor: Anchor::End, ..self }
    }

    pub const fn upright(self) -> Self {
        Text { upright: true, ..self }
    }

    pub const fn halo(self) -> Self {
        Text { halo: true, ..self }
    }
}

/// An SVG page being written; shapes with a non-finite coordinate are omitted.
#[derive(Clone, Debug)]
pub struct Svg {
    pub width: f64,
    /// May be set until `finish`.
    pub height: f64,
    body: String,
    clips: usize,
}

impl Svg {
    /// An empty white page \[px\].
    pub fn new(width: f64, height: f64) -> Self {
        Svg { width, height, body: String::new(), clips: 0 }
    }

    /// The finished document.
    pub fn finish(self) -> String {
        let (w, h) = (number(self.width), number(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"'DejaVu Sans', Verdana, sans-serif\" stroke-linejoin=\"round\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\" shape-rendering=\"crispEdges\"/>\n{}</svg>\n",
            self.body
        )
    }

    pub fn line(&mut self, a: Point, b: Point, style: Style) {
        self.polyline(&[a, b], style);
    }

    /// An open line through the points, broken at non-finite ones.
    pub fn polyline(&mut self, points: &[Point], style: Style) {
        self.path(points, false, style);
    }

    /// A closed shape.
    pub fn polygon(&mut self, points: &[Point], style: Style) {
        self.path(points, true, style);
    }

    fn path(&mut self, points: &[Point], close: bool, style: Style) {
        let mut d = String::new();
        for run in points.split(|p| !finite(p)).filter(|run| run.len() > 1) {
            for (k, p) in run.iter().enumerate() {
                d.push(if k == 0 { 'M' } else { ' ' });
                push_number(&mut d, p[0]);
                d.push(' ');
                push_number(&mut d, p[1]);
            }
            if close {
                d.push('Z');
            }
        }
        if !d.is_empty() {
            self.element(&format!("path d=\"{d}\""), style);
        }
    }

    pub fn rect(&mut self, x: f64, y: f64, w: f64, h: f64, style: Style) {
        if finite(&[x, y]) && finite(&[w, h]) && w >= 0.0 && h >= 0.0 {
            let (x, y, w, h) = (number(x), number(y), number(w), number(h));
            self.element(&format!("rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\""), style);
        }
    }

    pub fn circle(&mut self, center: Point, radius: f64, style: Style) {
        if finite(&center) && radius.is_finite() && radius >= 0.0 {
            let (x, y, r) = (number(center[0]), number(center[1]), number(radius));
            self.element(&format!("circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\""), style);
        }
    }

    /// Round dots of one size as one path; dots in the same 0.1 px cell are drawn once.
    pub fn dots(&mut self, centers: impl Iterator<Item = Point>, radius: f64, color: Color) {
        let mut seen = std::collections::BTreeSet::new();
        let mut d = String::new();
        for p in centers.filter(finite) {
            if seen.insert([(10.0 * p[0]).round() as i64, (10.0 * p[1]).round() as i64]) {
                d.push('M');
                push_number(&mut d, p[0]);
                d.push(' ');
                push_number(&mut d, p[1]);
                // Short non-zero length: renderers may skip zero-length lines.
                d.push_str("h.01");
            }
        }
        if !d.is_empty() {
            let style = Style::stroke(color, 2.0 * radius);
            self.element(&format!("path d=\"{d}\" stroke-linecap=\"round\""), style);
        }
    }

    /// An arrow from `a` to `b` with a filled head of the given length \[px\].
    pub fn arrow(&mut self, a: Point, b: Point, head: f64, color: Color, width: f64) {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if !length.is_finite() || length == 0.0 {
            return;
        }
        let head = head.min(length);
        let (ux, uy) = (dx / length, dy / length);
        let base = [b[0] - head * ux, b[1] - head * uy];
        let half = 0.38 * head;
        self.line(a, base, Style::stroke(color, width));
        self.polygon(
            &[b, [base[0] - half * uy, base[1] + half * ux], [base[0] + half * uy, base[1] - half * ux]],
            Style::fill(color),
        );
    }

    pub fn text(&mut self, at: Point, text: &str, how: Text) {
        if !finite(&at) || text.is_empty() {
            return;
        }
        let (x, y) = (number(at[0]), number(at[1]));
        let _ = write!(self.body, "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"", number(how.size));
        push_color(&mut self.body, how.color);
        self.body.push('"');
        match how.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.body.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.body.push_str(" text-anchor=\"end\""),
        }
        if how.upright {
            let _ = write!(self.body, " transform=\"rotate(-90 {x} {y})\"");
        }
        if how.halo {
            self.body.push_str(" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
        }
        self.body.push('>');
        push_escaped(&mut self.body, text);
        self.body.push_str("</text>\n");
    }

    /// Puts what `draw` draws into a group with a class.
    pub fn group(&mut self, class: &str, draw: impl FnOnce(&mut Self)) {
        self.body.push_str("<g class=\"");
        push_escaped(&mut self.body, class);
        self.body.push_str("\">\n");
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// An embedded PNG stretched over a rectangle.
    pub fn image(&mut self, x: f64, y: f64, w: f64, h: f64, png: &[u8]) {
        let data = base64::engine::general_purpose::STANDARD.encode(png);
        let _ = writeln!(
            self.body,
            "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{data}\"/>",
            number(x),
            number(y),
            number(w),
            number(h)
        );
    }

    /// Clips everything until `unclip` to the rectangle.
    pub fn clip(&mut self, x: f64, y: f64, w: f64, h: f64) {
        let id = self.clips;
        self.clips += 1;
        let (x, y, w, h) = (number(x), number(y), number(w), number(h));
        let _ = writeln!(
            self.body,
            "<clipPath id=\"c{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g clip-path=\"url(#c{id})\">"
        );
    }

    /// Puts another page on this one, its upper left corner at a point.
    pub fn place(&mut self, page: Svg, [x, y]: Point) {
        // Clips have names of their own in one document.
        let first = self.clips;
        self.clips += page.clips;
        let mut body = page.body;
        for id in (0..page.clips).rev() {
            body = body
                .replace(&format!("<clipPath id=\"c{id}\""), &format!("<clipPath id=\"c{}\"", first + id));
            body = body.replace(&format!("\"url(#c{id})\""), &format!("\"url(#c{})\"", first + id));
        }
        let (x, y) = (number(x), number(y));
        // Writing to a text cannot fail.
        let _ = write!(self.body, "<g transform=\"translate({x} {y})\">\n{body}</g>\n");
    }

    pub fn unclip(&mut self) {
        self.body.push_str("</g>\n");
    }

    fn element(&mut self, shape: &str, style: Style) {
        let _ = write!(self.body, "<{shape} fill=\"");
        match style.fill {
            Some(color) => push_color(&mut self.body, color),
            None => self.body.push_str("none"),
        }
        self.body.push('"');
        if let Some(color) = style.stroke {
            self.body.push_str(" stroke=\"");
            push_color(&mut self.body, color);
            let _ = write!(self.body, "\" stroke-width=\"{}\"", number(style.width));
            if style.dash != Dash::Solid {
                let _ = write!(self.body, " stroke-dasharray=\"{}\"", style.dash.pattern());
            }
        }
        if style.opacity != 1.0 {
            // Of a shape with both, one opacity would show the inner half of its edge over the fill; the renderer draws it on a
            // layer of its own, which takes far longer.
            let of = match (style.fill, style.stroke) {
                (Some(_), None) => "fill-opacity",
                (None, Some(_)) => "stroke-opacity",
                _ => "opacity",
            };
            let _ = write!(self.body, " {of}=\"{}\"", number(style.opacity));
        }
        self.body.push_str("/>\n");
    }
}

fn finite(p: &Point) -> bool {
    p[0].is_finite() && p[1].is_finite()
}

/// A length with at most two decimals.
fn number(value: f64) -> String {
    let mut text = String::new();
    push_number(&mut text, value);
    text
}

fn push_number(out: &mut String, value: f64) {
    let hundredths = (value.clamp(-MAX_COORDINATE, MAX_COORDINATE) * 100.0).round() as i64;
    if hundredths < 0 {
        out.push('-');
    }
    let (whole, part) = (hundredths.abs() / 100, hundredths.abs() % 100);
    let _ = write!(out, "{whole}");
    if part != 0 {
        let _ = if part % 10 == 0 { write!(out, ".{}", part / 10) } else { write!(out, ".{part:02}") };
    }
}

fn push_color(out: &mut String, Color(r, g, b): Color) {
    let _ = write!(out, "#{r:02x}{g:02x}{b:02x}");
}

fn push_escaped(out: &mut String, text: &str) {
    for c in font::shorten(text, MAX_LABEL_CHARS).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // Control characters and the two non-characters are not allowed in XML.
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => out.push(' '),
            c => out.push(c),
        }
    }
}
