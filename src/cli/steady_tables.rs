//! Tables of Poincaré sections, Lyapunov exponents and bifurcation diagrams.

use rotordyn::results::{
    BifurcationPoint, BifurcationResult, BifurcationSweep, LyapunovResult, PlaneSection, PoincareResult,
    RecordedPeriods, SectionClock, SteadyMotion,
};
use rotordyn::signal::lyapunov::LyapunovExponent;

use super::terminal::{Terminal, number, rpm};

/// Largest number of rows printed of a sweep; the rest is in results.h5.
const MAX_ROWS: usize = 40;
/// Number of standard errors from zero at which the sign of an exponent is significant.
const SIGNIFICANT_STANDARD_ERRORS: f64 = 3.0;

pub fn poincare(terminal: &Terminal, found: &PoincareResult) {
    let points = found.planes.first().map_or(0, |p| p.section[0].len());
    let m = &found.motion;
    let chaos = if m.zero_one_k.is_nan() { "-".into() } else { format!("{:.3}", m.zero_one_k) };
    terminal.table(
        &format!(
            "Motion at {:.1} rpm, {points} section points, one per {}{}",
            rpm(found.speed),
            describe_clock(&found.clock),
            stopped_after(found.partial)
        ),
        &["motion", "recurrence", "K of 0-1 test", "clusters", "transient periods"],
        &[vec![
            m.motion.name(),
            format!("{:.1e}", m.recurrence),
            chaos,
            found.groups.to_string(),
            found.transient_periods.to_string(),
        ]],
    );
    let span = |v: &mut dyn Iterator<Item = &f64>, unit: &str| {
        let (l, h) = v.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (v.min(l), v.max(h)));
        format!("{} {unit}", number(h - l, 4))
    };
    let row = |p: &PlaneSection| {
        let mut row = vec![p.name.clone()];
        for k in 0..2 {
            // Only the last periods of the orbit are stored.
            row.push(span(&mut p.orbit[k].iter().chain(&p.section[k]), &p.axes[k].unit));
            row.push(span(&mut p.section[k].iter(), &p.axes[k].unit));
        }
        row.push(p.whirl.as_ref().map_or("-".into(), |w| w.name().to_string()));
        row.push(p.whirl.as_ref().map_or("-".into(), |w| {
            format!("{} {}", number(w.synchronous.semi_axes().0, 3), p.axes[0].unit)
        }));
        row
    };
    let rows: Vec<Vec<String>> = found.planes.iter().map(row).collect();
    terminal.table(
        "Orbits and Poincaré sections, peak to peak",
        &["plane", "x orbit", "x section", "y orbit", "y section", "whirl", "1x semi-axis"],
        &rows,
    );
}

pub fn lyapunov(terminal: &Terminal, found: &LyapunovResult) {
    let e = &found.exponent;
    let frequency = found.clock.frequency;
    let last = e.times.last().copied().unwrap_or(0.0);
    terminal.table(
        &format!(
            "Largest Lyapunov exponent at {:.1} rpm over {} periods ({last:.3} s), one per {}{}",
            rpm(found.speed),
            e.times.len(),
            describe_clock(&found.clock),
            stopped_after(found.partial)
        ),
        &["1/s", "standard error", "per period", "motion"],
        &[vec![
            number(e.value, 4),
            number(e.standard_error, 2),
            number(e.value / frequency, 3),
            classify_exponent(e).to_string(),
        ]],
    );
}

/// Class of the motion by the sign of the exponent, if significant.
fn classify_exponent(e: &LyapunovExponent) -> &'static str {
    if e.value > SIGNIFICANT_STANDARD_ERRORS * e.standard_error {
        "divergent: chaotic"
    } else if e.value < -SIGNIFICANT_STANDARD_ERRORS * e.standard_error {
        "convergent: regular"
    } else {
        "not significantly different from zero"
    }
}

pub fn bifurcation(terminal: &Terminal, found: &BifurcationResult) {
    let parameter = &found.parameter;
    let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
    for sweep in &found.sweeps {
        let rows = motion_ranges(sweep);
        let mut shown: Vec<Vec<String>> =
            rows.iter().take(MAX_ROWS).map(|run| run.row(&sweep.points)).collect();
        if rows.len() > MAX_ROWS {
            shown.push(vec![format!("and {} more ranges in results.h5", rows.len() - MAX_ROWS)]);
        }
        let title = format!(
            "Motion over {}{unit}, sweep {}, one section per {}",
            parameter.name(),
            sweep.name,
            found.clock
        );
        let header = ["from", "to", "values", "motion", "Lyapunov exponent 1/s"];
        terminal.table(&title, &header, &shown);
    }
    if found.seams > 0 {
        terminal.print(&format!(
            "  {} boundaries between chunks computed in parallel; {} chunks recomputed from the previous one",
            found.seams, found.rerun_chunks
        ));
    }
}

/// Range of successive values with the same kind of motion.
struct MotionRange {
    first: usize,
    last: usize,
    kind: String,
}

fn motion_ranges(sweep: &BifurcationSweep) -> Vec<MotionRange> {
    let mut runs: Vec<MotionRange> = Vec::new();
    for (k, point) in sweep.points.iter().enumerate() {
        let kind = kind(point);
        match runs.last_mut() {
            Some(run) if run.kind == kind => run.last = k,
            _ => runs.push(MotionRange { first: k, last: k, kind }),
        }
    }
    runs
}

fn kind(point: &BifurcationPoint) -> String {
    match &point.motion {
        Ok(SteadyMotion { motion, .. }) => motion.motion.name(),
        Err(reason) => format!("none: {reason}"),
    }
}

impl MotionRange {
    fn row(&self, points: &[BifurcationPoint]) -> Vec<String> {
        let exponents: Vec<f64> = points[self.first..=self.last]
            .iter()
            .filter_map(|p| p.motion.as_ref().ok()?.exponent.as_ref().map(|e| e.value))
            .collect();
        let (low, high) =
            exponents.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (v.min(l), v.max(h)));
        let exponent = match exponents.len() {
            0 => "-".to_string(),
            1 => number(low, 3),
            _ => format!("{} to {}", number(low, 3), number(high, 3)),
        };
        vec![
            number(points[self.first].value, 6),
            number(points[self.last].value, 6),
            (self.last - self.first + 1).to_string(),
            self.kind.clone(),
            exponent,
        ]
    }
}

/// How much there is of a record that was stopped; else nothing.
fn stopped_after(partial: Option<RecordedPeriods>) -> String {
    partial.map_or_else(String::new, |partial| format!("; stopped after {}", partial.words()))
}

/// "shaft revolution at 0 deg (20 Hz)".
fn describe_clock(clock: &SectionClock) -> String {
    let phase =
        if clock.phase == 0.0 { String::new() } else { format!(" at {:.1} deg", clock.phase.to_degrees()) };
    format!("{}{phase} ({} Hz)", clock.name, number(clock.frequency, 5))
}
