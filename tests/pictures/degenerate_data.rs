//! Degenerate data must not make a figure panic, hang or write an invalid image.

use rotordyn::plot::png;

use super::samples::all;

/// Every kind of figure is a valid SVG without a NaN, of reasonable size, and renders.
fn assert_renders(x: &[f64], y: &[f64], name: &str, what: &str) {
    for figure in all(x, y, name) {
        let kind = format!("{figure:?}");
        let kind = kind.split('(').next().unwrap_or_default();
        let svg = figure.svg().unwrap();
        let text_free = strip_text(&svg);
        assert!(!text_free.contains("NaN") && !text_free.contains("inf"), "{kind} of {what}");
        assert!(svg.len() < 1_200_000, "{kind} of {what}: {} bytes", svg.len());
        if let Err(error) = png(&svg) {
            panic!("{kind} of {what}: {error}");
        }
    }
}

/// The tags of the document without the text between them (labels may contain anything).
fn strip_text(svg: &str) -> String {
    svg.split('<').filter_map(|part| part.split('>').next()).filter(|tag| !tag.starts_with("image")).collect()
}

#[test]
fn no_data() {
    assert_renders(&[], &[], "", "nothing");
    assert_renders(&[1.0, 2.0, 3.0], &[], "x only", "x only");
    assert_renders(&[], &[1.0, 2.0], "y only", "y only");
}

#[test]
fn one_point() {
    assert_renders(&[5.0], &[7.0], "one", "one point");
    assert_renders(&[0.0], &[0.0], "zero", "one zero");
}

#[test]
fn all_equal() {
    assert_renders(&[2.0; 50], &[3.0; 50], "equal", "all equal");
    assert_renders(&[0.0; 50], &[0.0; 50], "zeros", "all zero");
}

#[test]
fn not_finite() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    assert_renders(&[nan; 9], &[nan; 9], "NaN", "all NaN");
    assert_renders(&[inf, -inf, nan], &[-inf, inf, nan], "inf", "all infinite");
    assert_renders(&[0.0, 1.0, nan, 3.0, inf, 5.0], &[1.0, nan, 2.0, inf, 3.0, -inf], "gaps", "gaps");
}

#[test]
fn extreme_magnitudes() {
    assert_renders(&[-f64::MAX, 0.0, f64::MAX], &[f64::MAX, -f64::MAX, 1.0], "max", "largest doubles");
    assert_renders(&[1e-320, 2e-320, 3e-320], &[1e-310, 1e-320, 5e-324], "min", "denormal doubles");
    assert_renders(&[1e15, 1e15 + 1.0, 1e15 + 2.0], &[1.0, 1.0 + 1e-15, 1.0], "close", "nearly equal");
    assert_renders(&[1e300, 1.0, -1e300, 1e-300], &[1e-300, 1e300, 5.0, -1e300], "mixed", "mixed magnitudes");
}

#[test]
fn unordered_data_of_unequal_lengths() {
    assert_renders(&[3.0, 1.0, 2.0, 1.0, 9.0], &[0.1, -5.0, 200.0], "mess", "unordered, uneven lengths");
}

#[test]
fn labels_with_xml_special_characters() {
    let name = "<b>&\"'\u{0}\u{1b}\u{ffff}]]>\n\t§ 軸受 🙂";
    assert_renders(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], name, "XML in labels");
    assert_renders(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], &"long ".repeat(5000), "long labels");
}

#[test]
fn long_data_stay_small() {
    let x: Vec<f64> = (0..2000).map(f64::from).collect();
    let y: Vec<f64> = x.iter().map(|x| (x * x * 0.37).sin() * 50.0).collect();
    assert_renders(&x, &y, "long", "2000 points");
}
