//! Surface of a race or ball over its angle: waviness and local defects.

use super::input::{Shape, Wave};
use super::spall::SpallPath;
use crate::lanes::Lanes;
use pulp::Simd;
use std::f64::consts::{PI, TAU};

/// Deviations of one surface over its own angle: waviness and defects.
#[derive(Clone, Debug, Default)]
pub(super) struct Raceway {
    waves: Waves,
    defects: Vec<Feature>,
}

/// A local defect, prepared for evaluation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Feature {
    /// Start angle, in [0, 2π), and angular extent \[rad\].
    pub start: f64,
    pub angle: f64,
    pub path: Path,
}

/// The ball's path over a feature.
#[derive(Clone, Copy, Debug)]
pub(super) enum Path {
    /// h sin(π p/Δφ).
    HalfSine {
        height: f64,
    },
    /// Circular arc of a radius over a chord `width` \[m\]; `sign` −1 for a dent.
    Cap {
        radius: f64,
        width: f64,
        sign: f64,
    },
    Spall {
        path: SpallPath,
        width: f64,
    },
}

impl Raceway {
    pub fn new(waves: &[Wave], defects: Vec<Feature>) -> Self {
        let waves: Vec<Wave> = waves.iter().copied().filter(|w| w.amplitude != 0.0).collect();
        Self { waves: Waves::new(&waves), defects }
    }

    pub fn is_perfect(&self) -> bool {
        !self.has_waves() && self.defects.is_empty()
    }

    pub fn has_waves(&self) -> bool {
        !self.waves.coefficients.is_empty()
    }

    pub fn has_defects(&self) -> bool {
        !self.defects.is_empty()
    }

    /// Deviation by waviness and its derivative by the angle, from the angle's cosine and sine.
    #[inline]
    pub fn waves(&self, cos: f64, sin: f64) -> [f64; 2] {
        self.waves.at(cos, sin)
    }

    /// The same at several angles at once.
    #[inline(always)]
    pub fn waves_in_lanes<S: Simd>(&self, simd: S, cos: Lanes<S>, sin: Lanes<S>) -> [Lanes<S>; 2] {
        self.waves.in_lanes(simd, cos, sin)
    }

    /// Deviation by defects and its derivative by the angle, at an angle in [0, 2π); overlapping defects add
    /// up.
    #[inline]
    pub fn defects(&self, angle: f64) -> [f64; 2] {
        let mut out = [0.0; 2];
        for feature in &self.defects {
            if let Some([value, slope]) = feature.at(angle) {
                out[0] += value;
                out[1] += slope;
            }
        }
        out
    }

    /// Calls `visit` with the number k of every ball on a defect, ball k being at `angle` + k `spacing`,
    /// `angle` in [0, 2π); k is not reduced to one revolution.
    #[inline]
    pub fn each_on_defect(&self, angle: f64, spacing: f64, mut visit: impl FnMut(usize)) {
        // Tolerance in ball spacings, larger than round-off: no ball on a defect is missed.
        const SLACK: f64 = 1e-9;
        for feature in &self.defects {
            // Offset by two revolutions, so that the quotient is positive.
            let start = (2.0 * TAU + feature.start - angle) / spacing;
            let end = start + feature.angle / spacing + SLACK;
            let mut k = (start - SLACK) as usize + 1;
            while k as f64 <= end {
                visit(k);
                k += 1;
            }
        }
    }

    /// Whether one of the balls at multiples of `spacing`, a whole part of 2π, is on a defect at some time while the first one
    /// moves from an angle to another \[rad\], both ends included.
    pub fn meets_defect(&self, [from, to]: [f64; 2], spacing: f64) -> bool {
        let (low, high) = (from.min(to), from.max(to));
        // Ball k is on it at some time from (start − high)/spacing to (start + extent − low)/spacing.
        let meets = |f: &Feature| {
            ((f.start + f.angle - low) / spacing).floor() >= ((f.start - high) / spacing).ceil()
        };
        self.defects.iter().any(meets)
    }

    /// Calls `visit` with the part of the way at every passage of such a ball over the start or the end of a defect.
    pub fn each_edge(&self, [from, to]: [f64; 2], spacing: f64, mut visit: impl FnMut(f64)) {
        let (low, high) = (from.min(to), from.max(to));
        for edge in self.defects.iter().flat_map(|f| [f.start, f.start + f.angle]) {
            // Ball k is there when the first one is at edge − k spacing.
            let mut k = ((edge - high) / spacing).floor() + 1.0;
            while edge - k * spacing > low {
                visit((edge - k * spacing - from) / (to - from));
                k += 1.0;
            }
        }
    }

    /// Σ ±|H|^{3/2} over the defects \[m^1.5\].
    pub fn signed_power_sum(&self, angle: f64) -> f64 {
        let power = |[h, _]: [f64; 2]| h * h.abs().sqrt();
        self.defects.iter().filter_map(|feature| feature.at(angle)).map(power).sum()
    }
}

impl Feature {
    #[inline]
    fn at(&self, angle: f64) -> Option<[f64; 2]> {
        let past = angle - self.start;
        let past = if past < 0.0 { past + TAU } else { past };
        (past < self.angle).then(|| self.path.at(past, self.angle))
    }
}

impl Path {
    /// Path over a dent or bump with this deviation at its middle.
    pub fn smooth(shape: Shape, height: f64, width: f64) -> Self {
        match shape {
            Shape::HalfSine => Self::HalfSine { height },
            Shape::Cap => {
                let (h, half) = (height.abs(), 0.5 * width);
                Self::Cap { radius: 0.5 * (half * half / h + h), width, sign: height.signum() }
            }
        }
    }

    /// Deviation and its derivative by the angle, at the angle `past` the start of a feature of extent
    /// `angle`.
    #[inline]
    fn at(&self, past: f64, angle: f64) -> [f64; 2] {
        match *self {
            Self::HalfSine { height } => {
                let (sin, cos) = (PI * past / angle).sin_cos();
                [height * sin, height * PI / angle * cos]
            }
            Self::Cap { radius, width, sign } => {
                let (half, x) = (0.5 * width, width * (past / angle - 0.5));
                let (root, ends) = ((radius * radius - x * x).sqrt(), (radius * radius - half * half).sqrt());
                // √(r² − x²) − √(r² − (w/2)²) without cancellation.
                let height = (half * half - x * x) / (root + ends);
                [sign * height, -sign * x / root * width / angle]
            }
            Self::Spall { path, width } => {
                let [sunk, slope] = path.at(width * past / angle);
                [-sunk, -slope * width / angle]
            }
        }
    }
}

/// Waviness as Fourier coefficients by order, summed by a rotation recurrence.
#[derive(Clone, Debug, Default)]
struct Waves {
    /// (Re, Im) of a e^{iϕ₀} for orders 0, 1, 2, ...
    coefficients: Vec<[f64; 2]>,
}

impl Waves {
    fn new(waves: &[Wave]) -> Self {
        let highest = waves.iter().map(|w| w.order as usize + 1).max().unwrap_or(0);
        let mut coefficients = vec![[0.0; 2]; highest];
        for wave in waves {
            coefficients[wave.order as usize][0] += wave.amplitude * wave.phase.cos();
            coefficients[wave.order as usize][1] += wave.amplitude * wave.phase.sin();
        }
        Self { coefficients }
    }

    /// Deviation Σ a cos(n φ + ϕ₀) and its derivative by φ, from cos φ and sin φ.
    fn at(&self, cos: f64, sin: f64) -> [f64; 2] {
        let (mut c, mut s) = (1.0, 0.0);
        let (mut value, mut slope) = (0.0, 0.0);
        for (n, [re, im]) in self.coefficients.iter().enumerate() {
            value += re * c - im * s;
            slope -= n as f64 * (re * s + im * c);
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
        }
        [value, slope]
    }

    #[inline(always)]
    fn in_lanes<S: Simd>(&self, simd: S, cos: Lanes<S>, sin: Lanes<S>) -> [Lanes<S>; 2] {
        let (mut c, mut s) = (Lanes::splat(simd, 1.0), Lanes::splat(simd, 0.0));
        let (mut value, mut slope) = (s, s);
        for (n, [re, im]) in self.coefficients.iter().enumerate() {
            value += c * *re - s * *im;
            slope += (s * *re + c * *im) * -(n as f64);
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
        }
        [value, slope]
    }
}
