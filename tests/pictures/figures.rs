//! Properties of every figure: equal bytes for equal data, a PNG of twice the SVG's size, small even with long data.

use resvg::{tiny_skia, usvg};
use rotordyn::plot::*;

use super::samples::all;

fn sample_figures() -> Vec<Figure> {
    let x: Vec<f64> = (0..60).map(|k| 10.0 * f64::from(k)).collect();
    let y: Vec<f64> = (0..60).map(|k| 3.0 + 0.5 * f64::from(k) + (f64::from(k) * 0.3).sin()).collect();
    all(&x, &y, "disc")
}

#[test]
fn equal_data_give_equal_bytes() {
    for (a, b) in sample_figures().into_iter().zip(sample_figures()) {
        let (a, b) = (a.svg().unwrap(), b.svg().unwrap());
        assert_eq!(a, b);
        assert_eq!(png(&a).unwrap(), png(&b).unwrap());
    }
}

#[test]
fn svg_parses_and_png_is_twice_its_size() {
    let folder = tempfile::tempdir().unwrap();
    for (k, figure) in sample_figures().iter().enumerate() {
        let stem = folder.path().join(format!("figure_{k}.5_hz"));
        write(figure, &[], &stem).unwrap();
        let path = |extension| folder.path().join(format!("figure_{k}.5_hz.{extension}"));
        let svg = std::fs::read_to_string(path("svg")).unwrap();
        let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
        let picture = tiny_skia::Pixmap::decode_png(&std::fs::read(path("png")).unwrap()).unwrap();
        let size = tree.size().to_int_size();
        assert_eq!((picture.width(), picture.height()), (2 * size.width(), 2 * size.height()));
        // Neither blank nor filled: text and lines cover some of the page, not most of it; one of thin lines has 0.16 % of dark pixels.
        let inked = picture.pixels().iter().filter(|p| p.red() < 128 || p.blue() < 128).count();
        let share = inked as f64 / (picture.width() * picture.height()) as f64;
        assert!((0.001..0.7).contains(&share), "figure {k}: {share}");
    }
}

#[test]
fn text_is_drawn_with_the_embedded_font() {
    // The same page with and without its text differ where the text is.
    let page = |text: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\"><text x=\"2\" y=\"15\" font-size=\"14\" font-family=\"'DejaVu Sans', sans-serif\">{text}</text></svg>"
        )
    };
    assert_ne!(png(&page("BPFO")).unwrap(), png(&page("")).unwrap());
}

#[test]
fn unwritable_path_is_an_environment_error() {
    let figure = Figure::Lines(Lines::default());
    let error = write(&figure, &[], std::path::Path::new("/nonexistent/folder/figure")).unwrap_err();
    assert!(error.to_string().contains("figure.svg"), "{error}");
}

/// A long note is broken between words into lines, not cut at the right edge.
#[test]
fn notes_are_wrapped() {
    let note = "12000 rpm, load 0, -3.9, 0 N: slip 13.703 %, BPFO 2.63358 of 3.05224 kinematic (Light spindle with free \
                balls and cage in one bearing)";
    let svg = Figure::Orbits(Orbits { note: note.into(), ..Orbits::default() }).svg().unwrap();
    let texts = svg.split("</text>").filter_map(|part| part.rsplit('>').next());
    let grey: Vec<&str> = texts.filter(|text| note.contains(text.trim()) && text.contains(' ')).collect();
    assert!(grey.len() > 1, "{grey:?}");
    assert_eq!(grey.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" "), note);
    assert!(!svg.contains('…'));
}

#[test]
fn decimation_of_a_million_samples_keeps_the_peak() {
    let time: Vec<f64> = (0..1_000_000).map(|k| f64::from(k) * 1e-5).collect();
    let mut value: Vec<f64> = time.iter().map(|t| (t * 3000.0).sin()).collect();
    // One sample in a million stands out; the axis and the curve must both show it.
    value[654_321] = 9.0;
    let channel = Channel { time: time.into(), value: value.into(), ..Default::default() };
    let svg = Figure::History(History { channels: vec![channel], ..Default::default() }).svg().unwrap();
    assert!(svg.len() < 150_000, "{} bytes", svg.len());
    let curve = svg
        .split("<path d=\"")
        .skip(1)
        .map(|p| p.split('"').next().unwrap())
        .max_by_key(|d| d.len())
        .unwrap();
    let numbers: Vec<f64> = curve.split(['M', ' ']).filter_map(|n| n.parse().ok()).collect();
    let mut heights: Vec<f64> = numbers.chunks(2).map(|p| p[1]).collect();
    heights.sort_by(f64::total_cmp);
    assert!(heights[1] - heights[0] > 100.0, "the peak is above all other points: {:?}", &heights[..3]);
}

#[test]
fn nan_gaps_break_a_curve() {
    let curve = |y: Vec<f64>| Curve { x: vec![0.0, 1.0, 2.0, 3.0, 4.0], y, ..Default::default() };
    let pieces = |y| {
        let svg = Figure::Lines(Lines { curves: vec![curve(y)], ..Default::default() }).svg().unwrap();
        let path =
            svg.split("<path d=\"").filter_map(|p| p.split('"').next()).max_by_key(|d| d.len()).unwrap();
        path.matches('M').count()
    };
    assert_eq!(pieces(vec![1.0, 2.0, 1.5, 2.0, 1.0]), 1);
    assert_eq!(pieces(vec![1.0, 2.0, f64::NAN, 2.0, 1.0]), 2);
}

#[test]
fn phase_jumps_are_not_joined() {
    let hz: Vec<f64> = (0..100).map(f64::from).collect();
    // A phasor rotating backwards three times: three phase jumps from -180 to 180 deg.
    let turn = |k: &f64| 6.0 * std::f64::consts::PI * k / 100.0;
    let curve = FrfCurve {
        re: hz.iter().map(|k| turn(k).cos()).collect(),
        im: hz.iter().map(|k| -turn(k).sin()).collect(),
        hz,
        ..Default::default()
    };
    let svg = Figure::Frf(Frf { curves: vec![curve], ..Default::default() }).svg().unwrap();
    let most =
        svg.split("<path d=\"").filter_map(|p| p.split('"').next()).map(|d| d.matches('M').count()).max();
    assert_eq!(most, Some(4));
}

#[test]
fn heat_map_shows_a_single_cell_peak_at_its_place() {
    // One high cell in a fine grid must be visible at its place.
    let (nx, ny) = (3000, 2000);
    let (rpm, hz): (Vec<f64>, Vec<f64>) =
        ((0..nx).map(f64::from).collect(), (0..ny).map(f64::from).collect());
    let mut level_db = vec![-100.0; (nx * ny) as usize];
    level_db[(750 * ny + 1500) as usize] = 0.0;
    let panels = vec![SpectrogramPanel { rpm, hz, level_db: level_db.into(), ..Default::default() }];
    let map = Spectrogram { panels, span_db: 80.0, ..Default::default() };
    let svg = Figure::Spectrogram(map).svg().unwrap();
    let picture = tiny_skia::Pixmap::decode_png(&png(&svg).unwrap()).unwrap();
    let attribute = |name: &str| -> f64 {
        let image = svg.split("<image ").nth(1).unwrap();
        image.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let (x, y, w, h) = (attribute("x"), attribute("y"), attribute("width"), attribute("height"));
    // Axes from 0 to 2999 rpm and 1999 Hz.
    let (px, py) = (2.0 * (x + w * 750.0 / 2999.0), 2.0 * (y + h * (1.0 - 1500.0 / 1999.0)));
    let dark = |px: f64, py: f64| picture.pixel(px as u32, py as u32).unwrap().green() < 120;
    let around =
        |px: f64, py: f64| (-3..=3).any(|i| (-3..=3).any(|j| dark(px + f64::from(i), py + f64::from(j))));
    assert!(around(px, py));
    assert!(!around(px + 200.0, py - 100.0));
}
