//! Sheet: several figures on one page, in rows.

use super::Figure;
use super::labels::page_heading;
use super::svg::Svg;
use rotordyn_core::series::SeriesError;

/// Data of a sheet.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    pub title: String,
    pub note: String,
    /// Figures of every row, from left to right.
    pub rows: Vec<Vec<Figure>>,
}

/// Left edge of the heading, gap between figures \[px\].
const LEFT: f64 = 20.0;
const GAP: f64 = 14.0;

/// # Errors
/// Numbers of a figure that cannot be read.
pub fn draw(data: &Sheet) -> Result<Svg, SeriesError> {
    let rows: Vec<Vec<Svg>> = data
        .rows
        .iter()
        .map(|row| row.iter().map(Figure::page).collect::<Result<Vec<Svg>, SeriesError>>())
        .collect::<Result<_, _>>()?;
    let width = |row: &[Svg]| row.iter().map(|page| page.width + GAP).sum::<f64>() - GAP;
    let widest = rows.iter().map(|row| width(row)).fold(430.0, f64::max);
    let (mut svg, mut y) = page_heading(widest, LEFT, &data.title, &data.note, &[]);
    for row in rows {
        let height = row.iter().map(|page| page.height).fold(0.0, f64::max);
        let mut x = 0.0;
        for page in row {
            let next = x + page.width + GAP;
            svg.place(page, [x, y]);
            x = next;
        }
        y += height + GAP;
    }
    svg.height = y;
    Ok(svg)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Curve, Lines};
    use std::collections::BTreeSet;

    #[test]
    fn clips_of_several_figures_have_names_of_their_own() {
        let curve = Curve { x: vec![0.0, 1.0], y: vec![0.0, 2.0], ..Curve::default() };
        let lines = || Figure::Lines(Lines { curves: vec![curve.clone()], ..Lines::default() });
        let of =
            |rows| Figure::Sheet(Sheet { title: "sheet".into(), rows, ..Sheet::default() }).svg().unwrap();
        let svg = of(vec![vec![lines(), lines()], vec![lines()]]);
        let names = |start: &str, end: char| -> Vec<String> {
            svg.split(start).skip(1).filter_map(|rest| rest.split(end).next()).map(String::from).collect()
        };
        let (made, used) = (names("id=\"", '"'), names("url(#", ')'));
        let known: BTreeSet<&String> = made.iter().collect();
        assert!(made.len() == 3 * names_of_one(&lines()) && known.len() == made.len(), "{made:?}");
        assert!(used.iter().all(|name| known.contains(name)) && !used.is_empty(), "{used:?}");
        // The second figure stands to the right of the first one, the third below.
        assert_eq!(svg.matches("<g transform=\"translate(0 ").count(), 2, "{svg}");
    }

    fn names_of_one(figure: &Figure) -> usize {
        figure.svg().unwrap().matches("<clipPath").count()
    }
}
