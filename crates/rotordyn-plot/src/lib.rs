//! Plots as SVG and PNG, each drawn from a plain data struct of numbers and names.
//!
//! | layer | files |
//! |---|---|
//! | page | [`svg`], `font`, `color_map`, `style` |
//! | axes | [`scale`], [`axes`], [`labels`], `leaders`, `obstacles`, `symbols`, `arcs`, `decimate`, `heat` |
//! | figures | one file each, one variant of [`Figure`] each |
//!
//! A new figure is one file, one variant and its match arm. Non-finite data give a gap; no data give empty
//! axes. Output is deterministic: equal data give equal bytes.

mod error;
pub mod figures;

mod arcs;
pub mod axes;
mod color_map;
mod contour;
mod decimate;
mod font;
mod footnote;
mod heat;
mod identity;
pub mod labels;
mod leaders;
mod mode_data;
pub mod scale;
mod style;
pub mod svg;
mod vector;

mod ball_load;
mod bearing_section;
mod bifurcation;
mod bode;
mod campbell;
mod cursor_spectrum;
mod deflection;
mod film_map;
mod frf;
mod grid;
mod heat_map;
mod history;
mod lines;
mod machine_layout;
mod matrix;
mod mode_motion;
mod mode_shape;
mod mode_view;
mod obstacles;
mod orbit;
mod order_map;
mod over_time;
mod panel_row;
mod panels;
mod phase_plane;
mod polar;
mod sheet;
mod spectrogram;
mod stabilisation;
mod stack;
mod symbols;
mod waterfall;
mod wireframe;

use rotordyn_core::series::SeriesError;
use rotordyn_core::warning::Warning;
use rotordyn_io::atomic_file;
use std::path::Path;

use resvg::{tiny_skia, usvg};

pub use error::FigureError;

pub use ball_load::{BallLoads, BallRow};
pub use bearing_section::{BearingSection, GrooveSection};
pub use bifurcation::{Bifurcation, SweepPoints};
pub use bode::{Bode, BodeCurve};
pub use campbell::{Branch, Campbell, Critical, OrderLine, Whirl};
pub use cursor_spectrum::{Cursor, CursorLines, CursorMark, CursorPanel};
pub use deflection::{Deflection, Mark};
pub use film_map::FilmMap;
pub use frf::{Frf, FrfCurve};
pub use grid::{Grid, GridPanel};
pub use heat_map::{HeatMap, MarkedRegion};
pub use history::{Channel, History, SecondScale};
pub use lines::{Curve, Lines};
pub use machine_layout::{
    LayoutBearing, LayoutBelt, LayoutBlock, LayoutRow, LayoutSection, LayoutSpring, LayoutSupport,
    MachineLayout,
};
pub use matrix::Matrix;
pub use mode_shape::{BodyBox, BodyMotion, ModeShape, ModeShapes, Rotor, RotorDisc, RotorSupport};
pub use orbit::{Orbit, Orbits};
pub use order_map::OrderMap;
pub use phase_plane::{PhasePlane, PhasePlanes};
pub use polar::{Polar, PolarCurve};
pub use sheet::Sheet;
pub use spectrogram::{Spectrogram, SpectrogramPanel};
pub use stabilisation::{PoleStability, Stabilisation};
pub use stack::{Stack, StackPanel};
pub use svg::PNG_SCALE;
pub use symbols::{JointSymbol, SupportSymbol};
pub use waterfall::{Waterfall, WaterfallPanel};
pub use wireframe::{WireShape, Wireframe};

/// Any figure, with its data.
#[derive(Clone, Debug)]
pub enum Figure {
    Campbell(Campbell),
    Spectrogram(Spectrogram),
    Waterfall(Waterfall),
    OrderMap(OrderMap),
    Frf(Frf),
    ModeShapes(ModeShapes),
    Bode(Bode),
    Polar(Polar),
    Sheet(Sheet),
    Orbits(Orbits),
    PhasePlanes(PhasePlanes),
    Bifurcation(Bifurcation),
    BallLoads(BallLoads),
    BearingSection(BearingSection),
    Deflection(Deflection),
    History(History),
    Lines(Lines),
    Grid(Grid),
    CursorLines(CursorLines),
    HeatMap(HeatMap),
    FilmMap(FilmMap),
    Matrix(Matrix),
    MachineLayout(MachineLayout),
    Stabilisation(Stabilisation),
    Stack(Stack),
    Wireframe(Wireframe),
}

impl Figure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    /// Samples of a time history, or levels of a map, that cannot be read.
    pub fn svg(&self) -> Result<String, SeriesError> {
        Ok(self.page()?.finish())
    }

    /// As [`Self::svg`], with the warnings of the results below it.
    ///
    /// # Errors
    /// As [`Self::svg`].
    pub fn svg_with_warnings(&self, warnings: &[Warning]) -> Result<String, SeriesError> {
        let mut page = self.page()?;
        footnote::add(&mut page, warnings);
        Ok(page.finish())
    }

    fn page(&self) -> Result<svg::Svg, SeriesError> {
        Ok(match self {
            Figure::Campbell(data) => campbell::draw(data),
            Figure::Spectrogram(data) => spectrogram::draw(data)?,
            Figure::Waterfall(data) => waterfall::draw(data),
            Figure::OrderMap(data) => order_map::draw(data)?,
            Figure::Frf(data) => frf::draw(data),
            Figure::ModeShapes(data) => mode_shape::draw(data),
            Figure::Bode(data) => bode::draw(data),
            Figure::Polar(data) => polar::draw(data),
            Figure::Sheet(data) => sheet::draw(data),
            Figure::Orbits(data) => orbit::draw(data),
            Figure::PhasePlanes(data) => phase_plane::draw(data),
            Figure::Bifurcation(data) => bifurcation::draw(data),
            Figure::BallLoads(data) => ball_load::draw(data),
            Figure::Deflection(data) => deflection::draw(data),
            Figure::History(data) => history::draw(data)?,
            Figure::Lines(data) => lines::draw(data),
            Figure::Grid(data) => grid::draw(data),
            Figure::CursorLines(data) => cursor_spectrum::draw(data),
            Figure::HeatMap(data) => heat_map::draw(data),
            Figure::FilmMap(data) => film_map::draw(data),
            Figure::BearingSection(data) => bearing_section::draw(data),
            Figure::Matrix(data) => matrix::draw(data),
            Figure::MachineLayout(data) => machine_layout::draw(data),
            Figure::Stabilisation(data) => stabilisation::draw(data),
            Figure::Stack(data) => stack::draw(data),
            Figure::Wireframe(data) => wireframe::draw(data),
        })
    }
}

/// Writes a figure with the warnings of its results below it as `stem.svg` and `stem.png`.
///
/// # Errors
/// A file cannot be written, or its numbers cannot be read.
pub fn write(figure: &Figure, warnings: &[Warning], stem: &Path) -> Result<(), FigureError> {
    write_of_run(figure, warnings, stem, None)
}

/// As [`write()`], with the identity of the run that the figure shows as metadata of both files.
///
/// # Errors
/// A file cannot be written, or its numbers cannot be read.
pub fn write_of_run(
    figure: &Figure,
    warnings: &[Warning],
    stem: &Path,
    identity: Option<&str>,
) -> Result<(), FigureError> {
    let svg = figure.svg_with_warnings(warnings)?;
    let name = |extension: &str| {
        // Not `with_extension`: a stem such as "mode_27.1_hz" contains a dot.
        let mut name = stem.as_os_str().to_owned();
        name.push(extension);
        std::path::PathBuf::from(name)
    };
    let put = |path: std::path::PathBuf, bytes: &[u8]| {
        atomic_file::write_derived(&path, bytes).map_err(FigureError::of_file("write figure", &path))
    };
    let png = png(&svg).map_err(FigureError::of_file("render figure", &name(".png")))?;
    let (svg, png) = match identity {
        Some(identity) => (identity::mark_svg(&svg, identity), identity::mark_png(&png, identity)),
        None => (svg, png),
    };
    put(name(".svg"), svg.as_bytes())?;
    put(name(".png"), &png)
}

/// Renders an SVG document as PNG at [`PNG_SCALE`].
///
/// # Errors
/// The document is not SVG, or is too large to render.
pub fn png(svg: &str) -> Result<Vec<u8>, Box<dyn std::error::Error + Send + Sync>> {
    let options = usvg::Options {
        fontdb: font::database(),
        font_family: "DejaVu Sans".to_string(),
        // Maps have the pixels of the PNG.
        image_rendering: usvg::ImageRendering::OptimizeSpeed,
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let (w, h) = (size.width() as f32 * PNG_SCALE, size.height() as f32 * PNG_SCALE);
    let mut pixmap = tiny_skia::Pixmap::new(w as u32, h as u32).ok_or("the figure is too large to render")?;
    // White: a page whose size is no whole number of pixels does not cover the last row.
    pixmap.fill(tiny_skia::Color::WHITE);
    resvg::render(&tree, tiny_skia::Transform::from_scale(PNG_SCALE, PNG_SCALE), &mut pixmap.as_mut());
    Ok(opaque_png(&pixmap)?)
}

/// A picture without transparency as PNG.
///
/// Flat areas repeat better than their differences: rows without a filter at this level take half the time of filtered rows
/// and fewer bytes.
fn opaque_png(picture: &tiny_skia::Pixmap) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_deflate_compression(png::DeflateCompression::Level(2));
    let mut colors = vec![[0; 3]; picture.pixels().len()];
    for (color, p) in colors.iter_mut().zip(picture.pixels()) {
        *color = [p.red(), p.green(), p.blue()];
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(colors.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of black on white, whichever part is faint; where fill and edge overlap the edge hides the fill.
    #[test]
    fn faint_shapes_have_the_same_colours_with_and_without_a_layer() {
        let black = svg::Color(0, 0, 0);
        let shapes = [
            svg::Style::fill(black),
            svg::Style::stroke(black, 8.0),
            svg::Style::stroke(black, 8.0).filled(black),
        ];
        for (k, style) in shapes.into_iter().enumerate() {
            let mut svg = svg::Svg::new(40.0, 40.0);
            svg.rect(10.0, 10.0, 20.0, 20.0, style.faint(0.5));
            let text = svg.finish();
            assert_eq!(text.contains(" opacity="), k == 2, "{text}");
            let bytes = png(&text).unwrap();
            let picture = tiny_skia::Pixmap::decode_png(&bytes).unwrap();
            let at = |x: f32, y: f32| {
                picture
                    .pixel((svg::PNG_SCALE * x) as u32, (svg::PNG_SCALE * y) as u32)
                    .map(|pixel| pixel.red())
            };
            let grey = |value: Option<u8>| value.is_some_and(|value| (126..=129).contains(&value));
            // The middle, the inner half of the edge, the outer half, the page.
            let seen = [at(20.0, 20.0), at(12.0, 20.0), at(8.0, 20.0), at(2.0, 2.0)];
            let expected = [[true, true, false], [false, true, true], [true; 3]][k];
            assert_eq!([grey(seen[0]), grey(seen[1]), grey(seen[2])], expected, "{k}: {seen:?}");
            assert_eq!(seen[3], Some(255));
        }
    }
}
