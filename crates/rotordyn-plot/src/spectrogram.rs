//! Spectrogram over shaft speed (Campbell diagram from the signal), with order lines and linear natural
//! frequencies.

use super::axes::Axes;
use super::campbell::{Branch, OrderLine, branch_ends, order_lines, order_lines_over_time};
use super::heat::{self, COLOR_BAR_WIDTH, color_bar};
use super::labels::{Entry, end_label_width, end_labels, page_heading};
use super::over_time::OverTime;
use super::panel_row::PanelRow;
use super::scale::{Range, widened};
use super::style::*;
use super::svg::{Style, Svg};
use rotordyn_core::series::{Series, SeriesError};
use rotordyn_linalg::piecewise_within;

/// Spectrogram of one run.
#[derive(Clone, Debug, Default)]
pub struct SpectrogramPanel {
    /// Panel name, shown if there are several, e.g. "measured".
    pub name: String,
    /// Shaft speed of each spectrum \[rpm\], and its time \[s\], over which it is drawn if the speed is constant,
    /// or rises and falls.
    pub rpm: Vec<f64>,
    pub time: Vec<f64>,
    /// Frequencies \[Hz\].
    pub hz: Vec<f64>,
    /// Levels \[dB\], `level_db[i * hz.len() + j]` at `rpm[i]`, `hz[j]`.
    pub level_db: Series,
    /// Lines of this run alone; without any those of the figure.
    pub orders: Vec<OrderLine>,
    pub branches: Vec<Branch>,
}

impl SpectrogramPanel {
    fn orders<'a>(&'a self, figure: &'a Spectrogram) -> &'a [OrderLine] {
        if self.orders.is_empty() { &figure.orders } else { &self.orders }
    }

    fn branches<'a>(&'a self, figure: &'a Spectrogram) -> &'a [Branch] {
        if self.branches.is_empty() { &figure.branches } else { &self.branches }
    }
}

/// Data of a spectrogram over speed; several panels are drawn in rows on common scales.
#[derive(Clone, Debug, Default)]
pub struct Spectrogram {
    pub title: String,
    pub note: String,
    pub panels: Vec<SpectrogramPanel>,
    /// Quantity and unit of the levels, e.g. "acceleration level" and "dB re 1 m/s²".
    pub quantity: String,
    pub unit: String,
    /// Dynamic range \[dB\].
    pub span_db: f64,
    pub orders: Vec<OrderLine>,
    pub branches: Vec<Branch>,
    /// Upper end of the frequency axis \[Hz\]; by default the highest frequency.
    pub max_hz: Option<f64>,
}

/// # Errors
/// Levels that cannot be read.
pub fn draw(data: &Spectrogram) -> Result<Svg, SeriesError> {
    let mut kinds: Vec<Entry> = Vec::new();
    let branches = || data.panels.iter().flat_map(|p| p.branches(data)).chain(&data.branches);
    let orders = || data.panels.iter().flat_map(|p| p.orders(data)).chain(&data.orders);
    for whirl in branches().flat_map(|b| b.whirl.iter().copied()) {
        if kinds.iter().all(|k| k.text != whirl.name()) {
            kinds.push(Entry::line(whirl.name(), Style::stroke(whirl.color(), 1.3)));
        }
    }
    let names = branches().map(|b| &b.label).chain(orders().map(|o| &o.label));
    let room = end_label_width(names.cloned());
    let row = PanelRow::new(data.panels.len(), WIDTH - LEFT - room - COLOR_BAR_WIDTH);
    let page = LEFT + row.width() + room + COLOR_BAR_WIDTH;
    let over_time = OverTime::of(data.panels.iter().map(|p| [&p.rpm[..], &p.time]));
    let note = OverTime::note(over_time, &data.note);
    let (mut svg, top) = page_heading(page, LEFT, &data.title, &note, &kinds);
    let all_values = |of: fn(&SpectrogramPanel) -> &[f64]| data.panels.iter().flat_map(of).copied();
    let y = match data.max_hz.filter(|hz| hz.is_finite() && *hz > 0.0) {
        Some(hz) => Range::new(0.0, hz),
        None => Range::of(all_values(|p| &p.hz)).near_zero(),
    };
    let x = match over_time {
        Some(_) => Range::of(all_values(|p| &p.time)),
        None => Range::of(all_values(|p| &p.rpm)).near_zero(),
    };
    let levels = data.panels.iter().try_fold(None, |seen, p| p.level_db.fold(seen, widened))?;
    let bounds = heat::bounds_between(levels, data.span_db);
    let count = data.panels.len().max(1);
    let none = SpectrogramPanel::default();
    // The panels of a row have the same lines as a rule: only those of its last are labelled.
    for k in 0..count {
        let axes = Axes::linear(row.frame(k, top + 16.0, 420.0), x, y);
        let panel = data.panels.get(k).unwrap_or(&none);
        let places = if over_time.is_some() { &panel.time } else { &panel.rpm };
        heat::draw_rows(&mut svg, &axes, bounds, [places, &panel.hz], &panel.level_db)?;
        // Speeds along the axis of an order line.
        let ends = [x.lo, x.hi];
        let course = if over_time.is_some() { [&panel.time[..], &panel.rpm] } else { [&ends[..], &ends] };
        // A pale edge keeps the dashes visible on dark levels.
        for order in panel.orders(data) {
            let hz: Vec<f64> = course[1].iter().map(|rpm| order.hz(*rpm)).collect();
            axes.curve(&mut svg, course[0], &hz, Style::stroke(WHITE, 2.0).faint(0.45));
        }
        let (mut labels, branches) = match over_time {
            Some(_) => {
                let along = |branch: &Branch| branch_over_time(branch, course);
                let labels = order_lines_over_time(&mut svg, &axes, panel.orders(data), course);
                (labels, panel.branches(data).iter().filter_map(along).collect())
            }
            None => (order_lines(&mut svg, &axes, panel.orders(data)), panel.branches(data).to_vec()),
        };
        for branch in &branches {
            // A white edge separates the thin line from the ridge below.
            axes.curve(&mut svg, &branch.rpm, &branch.hz, Style::stroke(WHITE, 2.6).faint(0.75));
            branch.curves(&mut svg, &axes, &branch.hz, |whirl| Style::stroke(whirl.color(), 1.1));
        }
        labels.extend(branch_ends(&axes, &branches));
        let below = if over_time.is_some() { ("time", "s") } else { ("shaft speed", "rpm") };
        row.border(&mut svg, &axes, k, below, ("frequency", "Hz"));
        row.name(&mut svg, axes.frame, &panel.name);
        if row.ends_row(k) {
            end_labels(&mut svg, &axes, &labels);
            let label = format!("{} [{}]", data.quantity, data.unit);
            let right = axes.frame.right() + room;
            color_bar(&mut svg, axes.frame, right, bounds, &label);
            svg.height = axes.frame.bottom() + BOTTOM;
        }
    }
    Ok(svg)
}

/// A branch along the speeds \[rpm\] at some times, with times in place of its speeds; `None` where it is known at none of them.
fn branch_over_time(branch: &Branch, [times, rpm]: [&[f64]; 2]) -> Option<Branch> {
    let points: Vec<[f64; 2]> = branch.rpm.iter().zip(&branch.hz).map(|(x, y)| [*x, *y]).collect();
    let last = branch.whirl.len().checked_sub(1)?;
    let hz: Vec<f64> =
        rpm.iter().map(|rpm| piecewise_within(&points, *rpm).map_or(f64::NAN, |[_, hz]| hz)).collect();
    let whirl_at = |rpm: &f64| branch.whirl[branch.rpm.partition_point(|x| x < rpm).min(last)];
    hz.iter().any(|hz| hz.is_finite()).then(|| Branch {
        label: branch.label.clone(),
        whirl: rpm.iter().map(whirl_at).collect(),
        rpm: times.to_vec(),
        hz,
        log_decrement: Vec::new(),
    })
}
