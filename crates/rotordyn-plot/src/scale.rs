//! Axis ranges, ticks and the map from values to page coordinates.

/// Largest magnitude of an axis.
const MAX_MAGNITUDE: f64 = 1e150;
/// Largest number of decades of a logarithmic axis.
const MAX_DECADES: i32 = 9;

/// A range of values, `lo < hi`, both finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub lo: f64,
    pub hi: f64,
}

impl Range {
    /// A range of two finite bounds in either order, widened if they are equal or nearly so.
    pub fn new(a: f64, b: f64) -> Self {
        let (a, b) = (bounded(a), bounded(b));
        let (lo, hi) = (a.min(b), a.max(b));
        let least = (1e-9 * lo.abs().max(hi.abs())).max(1e-150);
        if hi - lo >= least {
            return Range { lo, hi };
        }
        let half = if lo == 0.0 && hi == 0.0 { 0.5 } else { (0.05 * lo.abs().max(hi.abs())).max(1e-150) };
        Range { lo: lo - half, hi: hi + half }
    }

    /// The range of the finite values; 0 to 1 if there is none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        match extremes(values) {
            Some((lo, hi)) => Range::new(lo, hi),
            None => Range { lo: 0.0, hi: 1.0 },
        }
    }

    /// The range of the finite values and zero.
    pub fn with_zero(values: impl IntoIterator<Item = f64>) -> Self {
        match extremes(values) {
            Some((lo, hi)) if lo != 0.0 || hi != 0.0 => Range::new(lo.min(0.0), hi.max(0.0)),
            _ => Range { lo: 0.0, hi: 1.0 },
        }
    }

    /// The range of the positive values, at most nine decades; 0.1 to 10 if there is none.
    pub fn positive(values: impl IntoIterator<Item = f64>) -> Self {
        match extremes(values.into_iter().filter(|v| *v > 0.0)) {
            Some((lo, hi)) => {
                let hi = hi.clamp(1e-140, MAX_MAGNITUDE);
                let lo = lo.clamp(hi * 10f64.powi(-MAX_DECADES), hi);
                if hi > 1.2 * lo { Range { lo, hi } } else { Range { lo: lo / 3.0, hi: hi * 3.0 } }
            }
            None => Range { lo: 0.1, hi: 10.0 },
        }
    }

    /// Wider by a fraction of its span on each side.
    pub fn padded(self, fraction: f64) -> Self {
        let by = fraction * (self.hi - self.lo);
        Range { lo: self.lo - by, hi: self.hi + by }
    }

    /// Extended to zero if the range starts slightly above it.
    pub fn near_zero(self) -> Self {
        Range { lo: if self.lo > 0.0 && self.lo < 0.06 * self.hi { 0.0 } else { self.lo }, hi: self.hi }
    }

    /// Wider at the top by a fraction of its span.
    pub fn padded_top(self, fraction: f64) -> Self {
        Range { lo: self.lo, hi: self.hi + fraction * (self.hi - self.lo) }
    }

    /// A logarithmic range with a margin on both sides.
    pub fn log_padded(self, fraction: f64) -> Self {
        let by = (self.hi / self.lo).powf(fraction);
        Range { lo: self.lo / by, hi: self.hi * by }
    }

    pub fn contains(self, value: f64) -> bool {
        (self.lo..=self.hi).contains(&value)
    }
}

fn bounded(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE) }
}

/// Smallest and largest finite value.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().fold(None, widened)
}

/// Smallest and largest finite value with one more value.
pub fn widened(seen: Option<(f64, f64)>, value: f64) -> Option<(f64, f64)> {
    match seen {
        _ if !value.is_finite() => seen,
        None => Some((value, value)),
        Some((lo, hi)) => Some((f64::min(lo, value), f64::max(hi, value))),
    }
}

/// Step 1, 2 or 5 times a power of ten that gives about `count` steps over the span.
pub fn nice_step(span: f64, count: f64) -> f64 {
    let raw = (span / count.max(1.0)).max(1e-200);
    let power = 10f64.powf(raw.log10().floor());
    let lead = raw / power;
    let factor = if lead <= 1.0 + 1e-9 {
        1.0
    } else if lead <= 2.0 + 1e-9 {
        2.0
    } else if lead <= 5.0 + 1e-9 {
        5.0
    } else {
        10.0
    };
    factor * power
}

/// Round values in the range, about `count` of them but at least three, and their step.
pub fn linear_ticks(range: Range, count: f64) -> (Vec<f64>, f64) {
    let counts = [count, 1.5 * count, 2.5 * count, 5.0 * count];
    let mut found = (Vec::new(), 0.0);
    for count in counts {
        found = ticks_of_count(range, count);
        if found.0.len() >= 3 {
            break;
        }
    }
    found
}

fn ticks_of_count(range: Range, count: f64) -> (Vec<f64>, f64) {
    let step = nice_step(range.hi - range.lo, count);
    let slack = 1e-9 * (range.hi - range.lo) / step;
    let first = (range.lo / step - slack).ceil();
    let number = ((range.hi / step + slack).floor() - first).clamp(-1.0, 60.0) as i64;
    // Adding 0.0 turns a negative zero into zero.
    ((0..=number).map(|k| (first + k as f64) * step + 0.0).collect(), step)
}

/// Powers of ten in a positive range, and the 2 to 9 between them.
pub fn log_ticks(range: Range, count: f64) -> (Vec<f64>, Vec<f64>) {
    let (first, last) = (range.lo.log10().floor() as i32, range.hi.log10().ceil() as i32);
    let stride = ((f64::from(last - first) / count.max(1.0)).ceil() as i32).max(1);
    let inside = |v: &f64| *v >= range.lo * (1.0 - 1e-9) && *v <= range.hi * (1.0 + 1e-9);
    let major = (first..=last).filter(|e| e.rem_euclid(stride) == 0).map(|e| 10f64.powi(e));
    let minor = (first..=last).flat_map(|e| {
        let leads = if stride == 1 { 2..=9 } else { 1..=1 };
        leads.map(move |lead| f64::from(lead) * 10f64.powi(e))
    });
    (major.filter(inside).collect(), minor.filter(inside).collect())
}

/// Linear or logarithmic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Linear,
    Log,
}

/// A labelled tick of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub value: f64,
    pub label: String,
}

/// Map from values to page coordinates along one axis, with ticks.
#[derive(Clone, Debug)]
pub struct Scale {
    pub kind: Kind,
    pub range: Range,
    /// Page coordinates of the ends of the range \[px\]; swap them to reverse the axis.
    pub page: [f64; 2],
    pub ticks: Vec<Tick>,
    pub minor: Vec<f64>,
    /// Tick labels are in units of 10^exponent.
    pub exponent: i32,
}

impl Scale {
    /// Linear axis with a tick about every `spacing` px.
    pub fn linear(range: Range, page: [f64; 2], spacing: f64) -> Self {
        let (values, step) = linear_ticks(range, ((page[1] - page[0]).abs() / spacing).max(2.0));
        let exponent = exponent(range.lo.abs().max(range.hi.abs()));
        let unit = 10f64.powi(exponent);
        let decimals = (-(step / unit).log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
        let ticks = values
            .into_iter()
            .map(|value| Tick { value, label: minus(format!("{:.decimals$}", value / unit + 0.0)) })
            .collect();
        Scale { kind: Kind::Linear, range, page, ticks, minor: Vec::new(), exponent }
    }

    /// Logarithmic axis of a positive range; linear ticks below one decade.
    pub fn log(range: Range, page: [f64; 2], spacing: f64) -> Self {
        let count = ((page[1] - page[0]).abs() / spacing).max(2.0);
        let (major, minor) = log_ticks(range, count);
        if major.len() < 2 {
            return Scale { kind: Kind::Log, ..Scale::linear(range, page, spacing) };
        }
        let ticks = major.into_iter().map(|value| Tick { value, label: power(value.log10().round() as i32) });
        Scale { kind: Kind::Log, range, page, ticks: ticks.collect(), minor, exponent: 0 }
    }

    /// The same with ticks at given values.
    pub fn at_ticks(self, values: &[f64]) -> Self {
        let ticks = values.iter().filter(|v| self.range.contains(**v));
        let ticks = ticks.map(|v| Tick { value: *v, label: minus(format!("{v}")) }).collect();
        Scale { ticks, minor: Vec::new(), exponent: 0, ..self }
    }

    /// The same with named ticks at given values.
    pub fn named(self, ticks: &[(f64, String)]) -> Self {
        let inside = ticks.iter().filter(|(value, _)| self.range.contains(*value));
        let ticks = inside.map(|(value, label)| Tick { value: *value, label: label.clone() }).collect();
        Scale { ticks, minor: Vec::new(), exponent: 0, ..self }
    }

    /// Page coordinate of a value \[px\]; NaN if it has none (a non-positive value on a logarithmic axis).
    pub fn px(&self, value: f64) -> f64 {
        let Range { lo, hi } = self.range;
        let part = match self.kind {
            Kind::Linear => (value - lo) / (hi - lo),
            Kind::Log if value > 0.0 => (value / lo).ln() / (hi / lo).ln(),
            Kind::Log => f64::NAN,
        };
        self.page[0] + part * (self.page[1] - self.page[0])
    }

    /// Axis label "name \[unit\]" with the power of ten of the tick labels.
    pub fn label(&self, name: &str, unit: &str) -> String {
        match (self.exponent, unit) {
            (0, "") => name.to_string(),
            (0, unit) => format!("{name} [{unit}]"),
            (exponent, "") => format!("{name} [{}]", power(exponent)),
            (exponent, unit) => format!("{name} [{} {unit}]", power(exponent)),
        }
    }
}

/// Power of ten (a multiple of three) factored out of tick labels; 0 from 0.01 to 10⁵.
fn exponent(largest: f64) -> i32 {
    if largest == 0.0 || (1e-2..1e5).contains(&largest) {
        return 0;
    }
    3 * (largest.log10() / 3.0).floor() as i32
}

/// 10 with a superscript, e.g. 10⁻³.
pub fn power(exponent: i32) -> String {
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let superscript = exponent.to_string();
    let superscript = superscript.chars().map(|c| match c.to_digit(10) {
        Some(d) => digits.chars().nth(d as usize).unwrap_or('?'),
        None => '⁻',
    });
    "10".chars().chain(superscript).collect()
}

/// A number with a true minus sign.
fn minus(text: String) -> String {
    text.replace('-', "−")
}
