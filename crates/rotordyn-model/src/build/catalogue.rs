//! Catalogue of common ball bearings: `assets/bearings.csv`, and clearance classes of ISO 5753-1.

use rotordyn_core::element::Material;

/// Catalogue data of one designation; lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct CatalogueEntry {
    pub designation: &'static str,
    pub bore: f64,
    pub outside_diameter: f64,
    pub width: f64,
    /// Smallest chamfer dimension r_s min.
    pub chamfer: f64,
    /// Number of balls Z.
    pub balls: usize,
    pub ball_diameter: f64,
    pub pitch_diameter: f64,
    /// Groove radius over ball diameter, inner and outer race.
    pub osculation: [f64; 2],
    /// Nominal contact angle \[rad\].
    pub contact_angle: f64,
    /// Ratings that a manufacturer publishes for this size, if a source is held.
    pub published: Option<PublishedRating>,
    /// Whether the internal geometry is estimated.
    pub estimated: bool,
    /// Source of the internal geometry.
    pub origin: &'static str,
}

/// Load ratings of a manufacturer's catalogue \[N\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedRating {
    pub dynamic: f64,
    pub static_rating: f64,
    pub fatigue: Option<f64>,
    pub source: &'static str,
}

const TEXT: &str = include_str!("../../../../assets/bearings.csv");

/// Default material: bearing steel.
pub fn bearing_steel() -> Material {
    let (young, poisson) = (207e9, 0.3);
    Material {
        name: "bearing steel".into(),
        young,
        shear: young / (2.0 * (1.0 + poisson)),
        poisson,
        density: 7850.0,
    }
}

/// Every bearing of the catalogue.
pub fn entries() -> impl Iterator<Item = CatalogueEntry> {
    // rows that do not parse are skipped; a test verifies that there are none
    rows().filter_map(row)
}

/// Number of rows in the catalogue's text.
pub fn row_count() -> usize {
    rows().count()
}

fn rows() -> impl Iterator<Item = &'static str> {
    TEXT.lines().filter(|l| !l.starts_with('#') && !l.starts_with("designation,") && !l.is_empty())
}

fn row(line: &'static str) -> Option<CatalogueEntry> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    let number = |k: usize| fields.get(k)?.parse::<f64>().ok();
    let rating = |dynamic: f64| {
        let source = match *fields.get(14)? {
            "NTN" => "NTN CAT. No. 2203/E",
            "CRAFT" => "CRAFT Bearings catalogue",
            _ => return None,
        };
        Some(PublishedRating { dynamic, static_rating: number(12)?, fatigue: number(13), source })
    };
    let origin = origin(fields.get(15)?)?;
    Some(CatalogueEntry {
        designation: fields.first()?,
        bore: number(1)? / 1e3,
        outside_diameter: number(2)? / 1e3,
        width: number(3)? / 1e3,
        chamfer: number(4)? / 1e3,
        balls: fields.get(5)?.parse().ok()?,
        ball_diameter: number(6)? / 1e3,
        pitch_diameter: number(7)? / 1e3,
        osculation: [number(8)?, number(9)?],
        contact_angle: number(10)?.to_radians(),
        published: number(11).and_then(rating),
        estimated: origin.starts_with("estimated"),
        origin,
    })
}

/// Text of a key of the column `origin`, from the comments at the head of the file.
fn origin(key: &str) -> Option<&'static str> {
    let texts = TEXT.lines().map_while(|line| line.strip_prefix('#'));
    texts
        .filter_map(|line| line.trim().strip_prefix("origin ")?.split_once(": "))
        .find_map(|(name, text)| (name == key).then_some(text))
}

/// Entry of a designation, case-insensitive, spaces ignored, under its own name or another one of the same bearing.
pub fn find(designation: &str) -> Option<CatalogueEntry> {
    let name = |line: &'static str| line.split(',').next().unwrap_or_default();
    let plain: String = designation.split_whitespace().collect::<String>().to_uppercase();
    let found = |wanted: &str| rows().find(|line| name(line).eq_ignore_ascii_case(wanted)).and_then(row);
    found(&plain).or_else(|| found(&standard_name(&plain)))
}

/// Designation in the catalogue's form: 68, 69, 78 and 79 are 618, 619, 718 and 719; the suffix A is omitted, CD is C, ACD
/// is AC and BE is B.
fn standard_name(name: &str) -> String {
    let digits = name.find(|c: char| !c.is_ascii_digit()).unwrap_or(name.len());
    let (number, suffix) = name.split_at(digits);
    let number = match number.as_bytes() {
        [kind @ (b'6' | b'7'), width @ (b'8' | b'9'), rest @ ..] if rest.len() == 2 => {
            format!("{}1{}{}", char::from(*kind), char::from(*width), String::from_utf8_lossy(rest))
        }
        _ => number.to_string(),
    };
    let suffix = match suffix.trim_start_matches('-') {
        "A" => "",
        "CD" => "C",
        "ACD" => "AC",
        "BE" => "B",
        other => other,
    };
    number + suffix
}

/// Designations nearest to one that is not in the catalogue: the one that it may be a misspelling of, then of its series
/// those with the nearest bores, else those with the most similar spelling.
pub fn nearest(designation: &str, count: usize) -> Vec<&'static str> {
    let wanted = standard_name(&designation.split_whitespace().collect::<String>().to_uppercase());
    let mut all: Vec<CatalogueEntry> = entries().collect();
    let parts = |name: &str| -> Option<(String, f64)> {
        let digits = name.find(|c: char| !c.is_ascii_digit()).unwrap_or(name.len());
        let (number, suffix) = name.split_at(digits);
        let suffix = suffix.trim_start_matches('-');
        (number.len() > 3).then(|| {
            let (series, code) = number.split_at(number.len() - 2);
            (format!("{series}{suffix}"), code.parse().unwrap_or(0.0))
        })
    };
    let score = |name: &str| {
        let series = match (parts(&wanted), parts(name)) {
            (Some((a, code)), Some((b, other))) if a == b => (code - other).abs(),
            _ => f64::INFINITY,
        };
        (series, rotordyn_units::names::similarity(&wanted, name))
    };
    all.sort_by(|a, b| {
        let (a, b) = (score(a.designation), score(b.designation));
        a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1))
    });
    let sorted = || all.iter().map(|e| e.designation);
    let meant = rotordyn_units::names::nearest(&wanted, sorted());
    meant.into_iter().chain(sorted().filter(|name| Some(*name) != meant)).take(count).collect()
}

/// Whether a designation is one of a cylindrical, needle, tapered or spherical roller bearing: NU 206, HK 2012, 30206,
/// 22210.
pub fn is_roller_bearing(designation: &str) -> bool {
    let plain: String = designation.split_whitespace().collect::<String>().to_uppercase();
    let (letters, digits) = plain.split_at(plain.find(|c: char| c.is_ascii_digit()).unwrap_or(plain.len()));
    let count = digits.chars().take_while(char::is_ascii_digit).count();
    match letters {
        "" => count == 5 && plain.starts_with(['2', '3']),
        _ => {
            ["N", "NA", "NJ", "NN", "NU", "NUP", "RNA", "RNU", "HK", "BK", "K"].contains(&letters)
                && count >= 3
        }
    }
}

/// What the suffix of a designation says of the contact angle; none for a deep groove bearing.
pub fn angle_note(entry: &CatalogueEntry) -> Option<String> {
    let suffix = entry.designation.trim_start_matches(|c: char| c.is_ascii_digit());
    let angle = entry.contact_angle.to_degrees();
    entry.designation.starts_with('7').then(|| match suffix {
        "" => format!("{angle:.0} deg without suffix (C 15 deg, AC 25 deg, B 40 deg)"),
        _ => format!("{angle:.0} deg by the suffix (30 deg without)"),
    })
}

/// Names of the clearance classes.
pub const CLEARANCE_CLASSES: [&str; 5] = ["C2", "CN", "C3", "C4", "C5"];

/// Radial internal clearance of ISO 5753-1, deep groove ball bearings: bore up to \[mm\], then minimum and
/// maximum \[µm\] of C2, CN, C3, C4, C5.
#[rustfmt::skip]
const ISO_5753_CLEARANCE: [(f64, [[f64; 2]; 5]); 14] = [
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
    (160.0, [[2.0, 23.0], [18.0, 53.0], [46.0, 91.0], [81.0, 130.0], [120.0, 180.0]]),
    (180.0, [[2.0, 25.0], [20.0, 61.0], [53.0, 102.0], [91.0, 147.0], [135.0, 200.0]]),
    (200.0, [[2.0, 30.0], [25.0, 71.0], [63.0, 117.0], [107.0, 163.0], [150.0, 230.0]]),
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
