//! No line crosses a text and no two texts overlap, read back by the renderer's parser.

use std::sync::Arc;

use resvg::tiny_skia::PathSegment;
use resvg::usvg::{self, fontdb};

use super::machines::{PEDESTALS, SPINDLE, pictures};

type Box4 = [f64; 4];
type Line = [[f64; 2]; 2];

/// Texts with the outline of their glyphs, and all drawn lines except pale grid lines \[px\].
fn parts(svg: &str) -> (Vec<(String, Box4)>, Vec<Line>) {
    let mut database = fontdb::Database::new();
    database.load_font_data(include_bytes!("../../assets/fonts/DejaVuSans.ttf").to_vec());
    database.set_sans_serif_family("DejaVu Sans");
    let options = usvg::Options {
        fontdb: Arc::new(database),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).unwrap();
    let (mut texts, mut lines) = (Vec::new(), Vec::new());
    collect(tree.root(), &mut texts, &mut lines);
    (texts, lines)
}

fn collect(group: &usvg::Group, texts: &mut Vec<(String, Box4)>, lines: &mut Vec<Line>) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => collect(inner, texts, lines),
            usvg::Node::Text(text) => {
                let b = text.flattened().abs_bounding_box();
                let content = text.chunks().iter().map(|c| c.text()).collect::<String>();
                texts.push((content, [b.left(), b.top(), b.right(), b.bottom()].map(f64::from)));
            }
            usvg::Node::Path(path) => {
                let pale = match path.stroke().map(|s| s.paint()) {
                    None => true,
                    Some(usvg::Paint::Color(c)) => c.red.min(c.green).min(c.blue) > 220,
                    Some(_) => false,
                };
                if !pale {
                    segments(path, lines);
                }
            }
            usvg::Node::Image(_) => {}
        }
    }
}

/// Straight pieces of a path; curves (circles) by chords.
fn segments(path: &usvg::Path, lines: &mut Vec<Line>) {
    let transform = path.abs_transform();
    let (mut last, mut first) = ([0.0; 2], [0.0; 2]);
    let mut to = |last: &mut [f64; 2], p: [f64; 2]| {
        lines.push([*last, p]);
        *last = p;
    };
    let map = |mut p: resvg::tiny_skia::Point| {
        transform.map_point(&mut p);
        [f64::from(p.x), f64::from(p.y)]
    };
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(p) => (last, first) = (map(p), map(p)),
            PathSegment::LineTo(p) => to(&mut last, map(p)),
            PathSegment::QuadTo(c, p) => {
                let (a, c, p) = (last, map(c), map(p));
                for k in 1..=16 {
                    let t = f64::from(k) / 16.0;
                    let s = 1.0 - t;
                    to(&mut last, [0, 1].map(|i| s * s * a[i] + 2.0 * s * t * c[i] + t * t * p[i]));
                }
            }
            PathSegment::CubicTo(c, d, p) => {
                let (a, c, d, p) = (last, map(c), map(d), map(p));
                for k in 1..=16 {
                    let t = f64::from(k) / 16.0;
                    let s = 1.0 - t;
                    to(
                        &mut last,
                        [0, 1].map(|i| {
                            s * s * s * a[i]
                                + 3.0 * s * s * t * c[i]
                                + 3.0 * s * t * t * d[i]
                                + t * t * t * p[i]
                        }),
                    );
                }
            }
            PathSegment::Close => to(&mut last, first),
        }
    }
}

/// Whether a line passes through a box.
fn crosses([a, b]: &Line, [left, top, right, bottom]: Box4) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (start, step, low, high) in [(a[0], b[0] - a[0], left, right), (a[1], b[1] - a[1], top, bottom)] {
        if step.abs() < 1e-9 {
            if start < low || start > high {
                return false;
            }
            continue;
        }
        let (t0, t1) = ((low - start) / step, (high - start) / step);
        (from, to) = (from.max(t0.min(t1)), to.min(t0.max(t1)));
    }
    from <= to
}

/// Every crossing in a picture.
fn problems(svg: &str) -> Vec<String> {
    let (texts, lines) = parts(svg);
    assert!(!texts.is_empty() && !lines.is_empty());
    let mut out = Vec::new();
    for (k, (text, area)) in texts.iter().enumerate() {
        let [left, top, right, bottom] = *area;
        let inner = [left + 0.3, top + 0.3, right - 0.3, bottom - 0.3];
        if let Some(line) = lines.iter().find(|line| crosses(line, inner)) {
            out.push(format!("{text:?} is crossed by {line:?}"));
        }
        for (other, o) in &texts[..k] {
            if left < o[2] && right > o[0] && top < o[3] && bottom > o[1] {
                out.push(format!("{text:?} overlaps {other:?}"));
            }
        }
    }
    out
}

#[test]
fn no_text_is_crossed_in_the_figures_of_several_machines() {
    let mut all = Vec::new();
    for text in [
        PEDESTALS,
        SPINDLE,
        include_str!("../../models/overhung_rig.toml"),
        include_str!("../../models/two_disc_pedestals.toml"),
        include_str!("../../models/jeffcott.toml"),
        include_str!("../../models/nelson_mcvaugh.toml"),
        include_str!("../../models/atef_2022.toml"),
    ] {
        let title = text.lines().find(|l| l.starts_with("title")).unwrap_or_default();
        for (name, svg) in pictures(text) {
            all.extend(problems(&svg).into_iter().map(|p| format!("{title} {name}: {p}")));
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn a_crossed_text_is_noticed() {
    let page = |line: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"30\" font-family=\"'DejaVu Sans'\">\
             <path d=\"{line}\" stroke=\"#202024\" stroke-width=\"1\"/><text x=\"20\" y=\"20\" font-size=\"12\">rotor</text></svg>"
        )
    };
    assert_eq!(problems(&page("M0 16 90 15")).len(), 1);
    assert_eq!(problems(&page("M0 26 90 25")).len(), 0);
}
