//! Sheet: several figures on one page, in rows.

use super::labels::page_heading;
use super::svg::Svg;

/// Data of a sheet.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    pub title: String,
    pub note: String,
    /// Drawn figures of every row, from left to right.
    pub rows: Vec<Vec<Svg>>,
}

/// Left edge of the heading, gap between figures \[px\].
const LEFT: f64 = 20.0;
const GAP: f64 = 14.0;

pub fn draw(data: &Sheet) -> Svg {
    let width = |row: &[Svg]| row.iter().map(|page| page.width + GAP).sum::<f64>() - GAP;
    let widest = data.rows.iter().map(|row| width(row)).fold(430.0, f64::max);
    let (mut svg, mut y) = page_heading(widest, LEFT, &data.title, &data.note, &[]);
    for row in &data.rows {
        let mut x = 0.0;
        for page in row {
            svg.place(page.clone(), [x, y]);
            x += page.width + GAP;
        }
        y += row.iter().map(|page| page.height).fold(0.0, f64::max) + GAP;
    }
    svg.height = y;
    svg
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// A page with two clips.
    fn page() -> Svg {
        let mut svg = Svg::new(100.0, 50.0);
        for _ in 0..2 {
            svg.clip(0.0, 0.0, 10.0, 10.0);
            svg.unclip();
        }
        svg
    }

    #[test]
    fn clips_of_several_figures_have_names_of_their_own() {
        let rows = vec![vec![page(), page()], vec![page()]];
        let svg = draw(&Sheet { title: "sheet".into(), rows, ..Sheet::default() }).finish();
        let names = |start: &str, end: char| -> Vec<String> {
            svg.split(start).skip(1).filter_map(|rest| rest.split(end).next()).map(String::from).collect()
        };
        let (made, used) = (names("id=\"", '"'), names("url(#", ')'));
        assert_eq!((made.len(), made.iter().collect::<BTreeSet<_>>().len()), (6, 6), "{made:?}");
        assert_eq!(made, used);
        // The second figure stands to the right of the first one, the third below.
        assert_eq!(svg.matches("<g transform=\"translate(0 ").count(), 2, "{svg}");
        assert_eq!(svg.matches("<g transform=\"translate(114 ").count(), 1, "{svg}");
    }
}
