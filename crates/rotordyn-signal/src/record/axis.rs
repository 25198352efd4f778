//! Axes of records: uniform, listed point by point, or unknown.

/// Axis of a record: quantity and points.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub quantity: AxisQuantity,
    pub points: Points,
}

/// Quantity of an axis with its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AxisQuantity {
    #[default]
    Unknown,
    /// s.
    Time,
    /// Hz.
    Frequency,
    /// rpm.
    Speed,
    /// Orders: multiples of the rotational speed.
    Order,
}

/// Points of an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Points {
    /// Uniform, x_k = start + k step.
    Uniform { start: f64, step: f64 },
    /// Non-uniform points x_k.
    NonUniform(Vec<f64>),
    /// Not given by the file.
    Unknown,
}

/// Tolerated deviation from uniform points over the step (rounding of printed digits, clock jitter).
const MAX_JITTER: f64 = 0.05;

impl Axis {
    /// An unknown axis.
    pub const UNKNOWN: Axis = Axis { quantity: AxisQuantity::Unknown, points: Points::Unknown };

    /// A uniform axis.
    pub fn uniform(quantity: AxisQuantity, start: f64, step: f64) -> Self {
        Axis { quantity, points: Points::Uniform { start, step } }
    }

    /// The axis through given points: uniform if they deviate by at most 5 % of a step from a uniform one.
    ///
    /// 1/step is rounded to a whole number if this is within the scatter of the points: times printed with
    /// few digits then still give 12000 Hz.
    pub fn from_points(quantity: AxisQuantity, points: Vec<f64>) -> Self {
        let even = uniform_points(&points);
        Axis { quantity, points: even.unwrap_or(Points::NonUniform(points)) }
    }

    /// The first `count` points; `None` if unknown.
    pub fn points(&self, count: usize) -> Option<Vec<f64>> {
        match &self.points {
            Points::Uniform { start, step } => Some((0..count).map(|k| start + k as f64 * step).collect()),
            Points::NonUniform(points) => Some(points[..count.min(points.len())].to_vec()),
            Points::Unknown => None,
        }
    }

    /// The first point; 0 if unknown.
    pub fn start(&self) -> f64 {
        match &self.points {
            Points::Uniform { start, .. } => *start,
            Points::NonUniform(points) => points.first().copied().unwrap_or(0.0),
            Points::Unknown => 0.0,
        }
    }

    /// Description of the axis, "401 points from 0 Hz by 0.5 Hz".
    pub fn describe(&self, count: usize) -> String {
        let unit = self.quantity.unit();
        match &self.points {
            Points::Uniform { start, step } => format!("{count} points from {start} {unit} by {step} {unit}"),
            Points::NonUniform(p) => {
                let (first, last) = (p.first().unwrap_or(&f64::NAN), p.last().unwrap_or(&f64::NAN));
                format!("{count} non-uniform points from {first} {unit} to {last} {unit}")
            }
            Points::Unknown => format!("{count} points without an axis"),
        }
    }
}

impl AxisQuantity {
    /// Unit of the axis; empty if it has none.
    pub fn unit(self) -> &'static str {
        match self {
            AxisQuantity::Unknown | AxisQuantity::Order => "",
            AxisQuantity::Time => "s",
            AxisQuantity::Frequency => "Hz",
            AxisQuantity::Speed => "rpm",
        }
    }
}

fn uniform_points(points: &[f64]) -> Option<Points> {
    let (first, last) = (*points.first()?, *points.last()?);
    let intervals = points.len().checked_sub(1).filter(|&n| n > 0)? as f64;
    let step = (last - first) / intervals;
    let off = points
        .iter()
        .enumerate()
        .map(|(k, x)| (x - (first + k as f64 * step)).abs())
        // NaN must not count as uniform.
        .fold(0.0, |worst: f64, d| if d.is_nan() { f64::INFINITY } else { worst.max(d) });
    if !(step > 0.0 && off <= MAX_JITTER * step) {
        return None;
    }
    let whole = 1.0 / (1.0 / step).round();
    let scatter = 2.0 * off + 1e-12 * last.abs().max(first.abs());
    let step = if whole.is_finite() && intervals * (whole - step).abs() <= scatter { whole } else { step };
    Some(Points::Uniform { start: first, step })
}

/// The step that deviates most from the mean: the index of its first point, the step, the mean.
pub(super) fn largest_step_deviation(points: &[f64]) -> (usize, f64, f64) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return (0, f64::NAN, f64::NAN) };
    let mean = (last - first) / (points.len() - 1).max(1) as f64;
    let steps = points.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
    let distance = |step: f64| if step.is_nan() { f64::INFINITY } else { (step - mean).abs() };
    let (index, step) = steps.max_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).unwrap_or((0, f64::NAN));
    (index, step, mean)
}
