//! Catalogue of common ball bearings: `assets/bearings.csv`, and clearance classes of ISO 5753-1.

/// Catalogue data of one designation; lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct CatalogueEntry {
    pub designation: &'static str,
    pub bore: f64,
    pub outside_diameter: f64,
    pub width: f64,
    /// Number of balls Z.
    pub balls: usize,
    pub ball_diameter: f64,
    pub pitch_diameter: f64,
    /// Groove radius over ball diameter, inner and outer race.
    pub osculation: [f64; 2],
    /// Nominal contact angle \[rad\].
    pub contact_angle: f64,
    /// Basic static load rating C_0r quoted by manufacturers \[N\], if it was used to check the internal
    /// geometry.
    pub static_rating: Option<f64>,
    /// Source of the internal geometry.
    pub origin: &'static str,
}

const TEXT: &str = include_str!("../../../assets/bearings.csv");

/// Every bearing of the catalogue.
pub fn entries() -> impl Iterator<Item = CatalogueEntry> {
    // rows that do not parse are skipped; a test verifies that there are none
    TEXT.lines().filter(|line| !line.starts_with('#') && !line.starts_with("designation,")).filter_map(row)
}

/// Number of rows in the catalogue's text.
pub fn row_count() -> usize {
    TEXT.lines().filter(|l| !l.starts_with('#') && !l.starts_with("designation,") && !l.is_empty()).count()
}

fn row(line: &'static str) -> Option<CatalogueEntry> {
    let fields: Vec<&str> = line.splitn(12, ',').map(str::trim).collect();
    let number = |k: usize| fields.get(k)?.parse::<f64>().ok();
    Some(CatalogueEntry {
        designation: fields.first()?,
        bore: number(1)? / 1e3,
        outside_diameter: number(2)? / 1e3,
        width: number(3)? / 1e3,
        balls: fields.get(4)?.parse().ok()?,
        ball_diameter: number(5)? / 1e3,
        pitch_diameter: number(6)? / 1e3,
        osculation: [number(7)?, number(8)?],
        contact_angle: number(9)?.to_radians(),
        static_rating: number(10),
        origin: fields.get(11)?,
    })
}

/// Entry of a designation, case-insensitive.
pub fn find(designation: &str) -> Option<CatalogueEntry> {
    entries().find(|e| e.designation.eq_ignore_ascii_case(designation.trim()))
}

/// Names of the clearance classes.
pub const CLEARANCE_CLASSES: [&str; 5] = ["C2", "CN", "C3", "C4", "C5"];

/// Radial internal clearance of ISO 5753-1, deep groove ball bearings: bore up to \[mm\], then minimum and
/// maximum \[µm\] of C2, CN, C3, C4, C5.
#[rustfmt::skip]
const ISO_5753_CLEARANCE: [(f64, [[f64; 2]; 5]); 11] = [
    (10.0, [[0.0, 7.0], [2.0, 13.0], [8.0, 23.0], [14.0, 29.0], [20.0, 37.0]]),
    (18.0, [[0.0, 9.0], [3.0, 18.0], [11.0, 25.0], [18.0, 33.0], [25.0, 45.0]]),
    (24.0, [[0.0, 10.0], [5.0, 20.0], [13.0, 28.0], [20.0, 36.0], [28.0, 48.0]]),
    (30.0, [[1.0, 11.0], [5.0, 20.0], [13.0, 28.0], [23.0, 41.0], [30.0, 53.0]]),
    (40.0, [[1.0, 11.0], [6.0, 20.0], [15.0, 33.0], [28.0, 46.0], [40.0, 64.0]]),
    (50.0, [[1.0, 11.0], [6.0, 23.0], [18.0, 36.0], [30.0, 51.0], [45.0, 73.0]]),
    (65.0, [[1.0, 15.0], [8.0, 28.0], [23.0, 43.0], [38.0, 61.0], [55.0, 90.0]]),
    (80.0, [[1.0, 15.0], [10.0, 30.0], [25.0, 51.0], [46.0, 71.0], [65.0, 105.0]]),
    (100.0, [[1.0, 18.0], [12.0, 36.0], [30.0, 58.0], [53.0, 84.0], [75.0, 120.0]]),
    (120.0, [[2.0, 20.0], [15.0, 41.0], [36.0, 66.0], [61.0, 97.0], [90.0, 140.0]]),
    (140.0, [[2.0, 23.0], [18.0, 48.0], [41.0, 81.0], [71.0, 114.0], [105.0, 160.0]]),
];

/// Minimum and maximum radial internal clearance (diametral) \[m\] of a class at a bore \[m\]; `None` outside
/// the table.
pub fn clearance(class: &str, bore: f64) -> Option<[f64; 2]> {
    let class = CLEARANCE_CLASSES.iter().position(|c| c.eq_ignore_ascii_case(class.trim()))?;
    // the bore in mm is rounded, so that 10 mm stays in the row that ends at 10
    let bore_mm = (bore * 1e6).round() / 1e3;
    let (_, row) = ISO_5753_CLEARANCE.iter().find(|(up_to, _)| bore_mm <= *up_to)?;
    (bore_mm >= 2.5).then(|| row[class].map(|um| um / 1e6))
}
