//! Smooth curve through a frequency response in the complex plane.

use super::svg::Point;
use rotordyn_linalg::Complex64;

/// Largest change of direction between two drawn pieces \[rad\].
const MAX_TURN: f64 = 0.05;
/// Largest turn of an arc between two samples \[rad\] if the samples on either side give the same arc, and if
/// they do not or one is missing; beyond it the samples are too far apart to tell the curve and are joined
/// straight.
const MAX_ARC: [f64; 2] = [1.9 * std::f64::consts::PI, 0.5 * std::f64::consts::PI];
/// Largest difference of two arcs in their middle, over their distance from the chord and over the chord.
const MAX_DIFFERENCE: [f64; 2] = [0.1, 0.05];

/// Points (x, w) of a response w(x) interpolated between samples in order of x.
///
/// Near a pole p a response is a + b/(x − p), a Möbius map of x, which passes through three samples along the
/// circle through them without overshoot; a real pole between samples is a gap. Between samples k and k+1 the maps of samples k−1, k, k+1 and of
/// k, k+1, k+2 are blended linearly in x; each runs on its circle, and the tangent is continuous.
///
/// `least`: distance of samples below which they are joined straight.
pub fn interpolate(samples: &[(f64, Point)], least: f64) -> Vec<(f64, Point)> {
    let finite = |(x, [a, b]): &(f64, Point)| x.is_finite() && a.is_finite() && b.is_finite();
    let mut out = Vec::with_capacity(4 * samples.len());
    for run in samples.chunk_by(|a, b| finite(a) && finite(b) && a.0 != b.0) {
        // A gap between runs stays one, unless only the abscissa repeats.
        let joined = out.last().is_some_and(finite) && finite(&run[0]);
        if !out.is_empty() && !joined {
            out.push((f64::NAN, [f64::NAN; 2]));
        }
        for k in 0..run.len().saturating_sub(1) {
            out.push(run[k]);
            between(run, k, least, &mut out);
        }
        out.extend(run.last());
    }
    out
}

/// Points strictly between samples k and k+1.
fn between(run: &[(f64, Point)], k: usize, least: f64, out: &mut Vec<(f64, Point)>) {
    let (x0, x1) = (run[k].0, run[k + 1].0);
    let (a, b) = (complex(run[k].1), complex(run[k + 1].1));
    if (b - a).norm() < least {
        return;
    }
    let three = |k: usize| run.get(k..k + 3).and_then(|s| Mobius::new([s[0], s[1], s[2]]));
    let maps = [k.checked_sub(1).and_then(three), three(k)];
    let middle = 0.5 * (x0 + x1);
    // A turn of 2π: the response of an undamped system, infinite at a pole between the samples.
    if maps.iter().flatten().all(|m| m.turn(x0, x1).abs() > MAX_ARC[0]) && maps.iter().flatten().count() == 2
    {
        out.push((middle, [f64::NAN; 2]));
        return;
    }
    let agree = match maps {
        [Some(first), Some(second)] => {
            let (first, second) = (first.at(middle), second.at(middle));
            let bulge = (first - 0.5 * (a + b)).norm();
            (first - second).norm() <= MAX_DIFFERENCE[0] * bulge + MAX_DIFFERENCE[1] * (b - a).norm()
        }
        _ => false,
    };
    let largest = MAX_ARC[usize::from(!agree)];
    let [before, after] = maps.map(|map| map.filter(|m| m.turn(x0, x1).abs() <= largest));
    let (Some(first), Some(second)) = (before.or(after), after.or(before)) else { return };
    let turn = first.turn(x0, x1).abs().max(second.turn(x0, x1).abs());
    // Equal steps in x are not equal steps of angle: twice as many as on a uniform arc.
    let steps = (2.0 * turn / MAX_TURN).ceil().clamp(1.0, 200.0) as usize;
    for step in 1..steps {
        let t = step as f64 / steps as f64;
        let x = x0 + t * (x1 - x0);
        let w = first.at(x) * (1.0 - t) + second.at(x) * t;
        if w.re.is_finite() && w.im.is_finite() {
            out.push((x, [w.re, w.im]));
        }
    }
}

fn complex([re, im]: Point) -> Complex64 {
    Complex64::new(re, im)
}

/// w(x) = w₀ + (x − x₀)/(p + q (x − x₀)).
#[derive(Clone, Copy, Debug)]
struct Mobius {
    origin: (f64, Complex64),
    p: Complex64,
    q: Complex64,
}

impl Mobius {
    /// Through three samples; None if two coincide.
    fn new(samples: [(f64, Point); 3]) -> Option<Self> {
        let origin = (samples[1].0, complex(samples[1].1));
        // (x − x₀)/(w − w₀) = p + q (x − x₀) is linear.
        let slope = |k: usize| {
            let (dx, dw) = (samples[k].0 - origin.0, complex(samples[k].1) - origin.1);
            (dw.norm() > 0.0).then(|| (dx, Complex64::new(dx, 0.0) / dw))
        };
        let ((xa, a), (xb, b)) = (slope(0)?, slope(2)?);
        let q = (b - a) / (xb - xa);
        let map = Self { origin, p: a - q * xa, q };
        (map.p.re.is_finite() && map.p.im.is_finite() && map.p.norm() > 0.0).then_some(map)
    }

    fn at(&self, x: f64) -> Complex64 {
        let d = x - self.origin.0;
        self.origin.1 + Complex64::new(d, 0.0) / (self.p + self.q * d)
    }

    /// Turn of the direction of w(x) from x0 to x1 \[rad\]: dw/dx = p/(p + q (x − x₀))².
    fn turn(&self, x0: f64, x1: f64) -> f64 {
        let at = |x: f64| self.p + self.q * (x - self.origin.0);
        -2.0 * (at(x1) / at(x0)).arg()
    }
}
