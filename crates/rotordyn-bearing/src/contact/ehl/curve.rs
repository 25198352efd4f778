//! EHL contact law at one speed, interpolated over the load.

use crate::contact::ContactLoad;
use rotordyn_linalg::pchip::Pchip;

/// Load and approach of a lubricated contact at one speed: δ = D − s(Q), Q = K D^{3/2}.
///
/// s = δ_dry − δ is the film shift; ln s is a monotone cubic (PCHIP) of ln Q, so that δ increases with Q
/// wherever s decreases. Outside the computed loads it blends into s ~ Q^−0.067 within a decade (Hamrock and
/// Dowson's film). Below [`Curve::THRESHOLD`] it continues along its tangent in D, so that the film is finite
/// at zero load: no load for δ ≤ −s(0). Q, dQ/dδ and ∫Q dδ are continuous.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    stiffness: f64,
    film: Option<Film>,
}

#[derive(Clone, Debug, PartialEq)]
struct Film {
    /// ln s, ln h_c and ln h_min over ln Q.
    shift: Pchip,
    central: Pchip,
    minimum: Pchip,
    /// ln Q of the knots and ∫ Q ds up to them, from the first.
    knots: Vec<f64>,
    work: Vec<f64>,
    /// Start of the tangent continuation: D, s, ds/dD, ∫ Q ds there.
    threshold: [f64; 4],
}

/// Exponents of the load in Hamrock and Dowson's central and minimum film.
const LOAD_POWER: f64 = -0.067;
const MINIMUM_LOAD_POWER: f64 = -0.073;

/// Gauss-Legendre nodes and weights on \[−1, 1\].
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl Curve {
    /// Load below which the film follows its tangent \[N\]: far below relevant loads.
    pub const THRESHOLD: f64 = 1e-3;

    /// Dry law, without a film.
    pub(super) fn dry(stiffness: f64) -> Self {
        Self { stiffness, film: None }
    }

    /// Law from the logarithms of shift, central and minimum film at increasing loads.
    pub(super) fn new(stiffness: f64, loads: &[f64], [shift, central, minimum]: [&[f64]; 3]) -> Self {
        // Two extra knots on either side on the power law, for a smooth transition to it.
        let step = 0.5 * std::f64::consts::LN_10;
        let inside: Vec<f64> = loads.iter().map(|q| q.ln()).collect();
        let extend = |values: &[f64], power: f64| -> Vec<f64> {
            let (Some(first), Some(last)) = (values.first(), values.last()) else { return Vec::new() };
            let end = |value: f64, steps: f64| value + power * steps * step;
            let mut all = vec![end(*first, -2.0), end(*first, -1.0)];
            all.extend(values);
            all.extend([end(*last, 1.0), end(*last, 2.0)]);
            all
        };
        let knots = extend(&inside, 1.0);
        let pchip = |values: &[f64], power: f64| Pchip::new(&knots, &extend(values, power));
        let (Some(shift), Some(central), Some(minimum)) =
            (pchip(shift, LOAD_POWER), pchip(central, LOAD_POWER), pchip(minimum, MINIMUM_LOAD_POWER))
        else {
            return Self::dry(stiffness);
        };
        let mut film =
            Film { shift, central, minimum, work: vec![0.0; knots.len()], knots, threshold: [0.0; 4] };
        for k in 1..film.knots.len() {
            film.work[k] = film.work[k - 1] + film.gauss(film.knots[k - 1], film.knots[k]);
        }
        let deformation = (Self::THRESHOLD / stiffness).powf(2.0 / 3.0);
        let [s, power] = film.shift_at(Self::THRESHOLD.ln());
        film.threshold = [deformation, s, 1.5 * power * s / deformation, film.work_at(Self::THRESHOLD.ln())];
        Self { stiffness, film: Some(film) }
    }

    /// Law of two contacts in series under the same load: deformations and films add up.
    ///
    /// K⁻²ᐟ³ = Σ Kᵢ⁻²ᐟ³, s = Σ sᵢ, at this contact's loads; exact there if both were computed at the same
    /// loads.
    pub fn in_series(&self, other: &Self) -> Self {
        let compliance = self.stiffness.powf(-2.0 / 3.0) + other.stiffness.powf(-2.0 / 3.0);
        let stiffness = compliance.powf(-1.5);
        let (first, second) = match (&self.film, &other.film) {
            (Some(first), Some(second)) => (first, Some(second)),
            (Some(film), None) | (None, Some(film)) => (film, None),
            (None, None) => return Self::dry(stiffness),
        };
        // The two outermost knots on either side belong to the power law and are added again by `new`.
        let knots = &first.knots[2..first.knots.len() - 2];
        let sum = |of: fn(&Film) -> &Pchip| -> Vec<f64> {
            let value = |film: &Film, knot: f64| of(film).evaluate(knot)[0].exp();
            knots
                .iter()
                .map(|&t| (value(first, t) + second.map_or(0.0, |film| value(film, t))).ln())
                .collect()
        };
        let loads: Vec<f64> = knots.iter().map(|t| t.exp()).collect();
        let films = [sum(|film| &film.shift), sum(|film| &film.central), sum(|film| &film.minimum)];
        Self::new(stiffness, &loads, films.each_ref().map(Vec::as_slice))
    }

    /// Approach δ \[m\] and its slope dδ/dQ \[m/N\] at a load Q > 0 \[N\].
    pub fn approach(&self, load: f64) -> [f64; 2] {
        let deformation = (load / self.stiffness).powf(2.0 / 3.0);
        let [shift, slope] = self.shift(deformation);
        [deformation - shift, (1.0 - slope) * deformation / (1.5 * load)]
    }

    /// Central film h_c \[m\] under a load Q > 0 \[N\]; 0 when dry.
    pub fn central_film(&self, load: f64) -> f64 {
        self.film.as_ref().map_or(0.0, |film| film.central.evaluate(load.max(Self::THRESHOLD).ln())[0].exp())
    }

    /// Minimum film h_min \[m\] under a load Q > 0 \[N\]; 0 when dry.
    pub fn minimum_film(&self, load: f64) -> f64 {
        self.film.as_ref().map_or(0.0, |film| film.minimum.evaluate(load.max(Self::THRESHOLD).ln())[0].exp())
    }

    /// Film thickness s(0) at zero load \[m\]: no load for δ ≤ −s(0).
    pub fn zero_load_film(&self) -> f64 {
        self.shift(0.0)[0]
    }

    /// Load, slope and energy at the approach δ \[m\].
    ///
    /// Newton's method in D, bracketed; dQ/dδ = (3/2) K √D/(1 − ds/dD), ∫Q dδ = (2/5) K D^{5/2} − ∫Q ds.
    pub fn load(&self, approach: f64) -> ContactLoad {
        let reach = self.zero_load_film();
        if approach <= -reach {
            return ContactLoad::default();
        }
        // δ(0) = −s(0) < δ, and s ≤ s(0) where s decreases with load.
        let (mut low, mut high) = (0.0, approach + reach);
        let mut deformation = high.min((approach + self.shift(approach.max(0.0))[0]).max(0.5 * high));
        let [mut shift, mut slope] = self.shift(deformation);
        for _ in 0..100 {
            let error = deformation - shift - approach;
            if error > 0.0 {
                high = deformation;
            } else {
                low = deformation;
            }
            let newton = deformation - error / (1.0 - slope);
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            let moved = (next - deformation).abs();
            deformation = next;
            [shift, slope] = self.shift(deformation);
            // Round-off of the logarithms: a few units in the last place of D + s.
            if moved <= 2e-15 * (deformation + shift) {
                break;
            }
        }
        let root = self.stiffness * deformation.sqrt();
        let load = root * deformation;
        ContactLoad {
            load,
            slope: 1.5 * root / (1.0 - slope),
            energy: 0.4 * load * deformation - self.work(deformation, load),
        }
    }

    /// s and ds/dD at a deformation D ≥ 0.
    fn shift(&self, deformation: f64) -> [f64; 2] {
        let Some(film) = &self.film else { return [0.0; 2] };
        let [knee, s, slope, _] = film.threshold;
        if deformation <= knee {
            return [s + slope * (deformation - knee), slope];
        }
        let [s, power] = film.shift_at(self.stiffness.ln() + 1.5 * deformation.ln());
        [s, 1.5 * power * s / deformation]
    }

    /// ∫ Q ds from zero load.
    fn work(&self, deformation: f64, load: f64) -> f64 {
        let Some(film) = &self.film else { return 0.0 };
        let [knee, _, slope, work] = film.threshold;
        let tangent = |d: f64| 0.4 * slope * self.stiffness * d * d * d.sqrt();
        if deformation <= knee {
            return tangent(deformation);
        }
        tangent(knee) + film.work_at(load.ln()) - work
    }
}

impl Film {
    /// s and d ln s/d ln Q at ln Q.
    fn shift_at(&self, log_load: f64) -> [f64; 2] {
        let [value, slope, _] = self.shift.evaluate(log_load);
        [value.exp(), slope]
    }

    /// ∫ Q ds over ln Q between two points of one interval, by Gauss-Legendre quadrature.
    fn gauss(&self, from: f64, to: f64) -> f64 {
        let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
        let term = |(node, weight): (f64, f64)| {
            let t = centre + half * node;
            let [s, power] = self.shift_at(t);
            weight * t.exp() * s * power
        };
        half * GAUSS.into_iter().map(term).sum::<f64>()
    }

    /// ∫ Q ds from the first knot; outside the knots the power law in closed form, m/(1 + m) Q s.
    fn work_at(&self, log_load: f64) -> f64 {
        let last = self.knots.len() - 1;
        for (end, outside) in [(0, log_load <= self.knots[0]), (last, log_load >= self.knots[last])] {
            if outside {
                let closed = |t: f64| {
                    let [s, power] = self.shift_at(t);
                    power / (1.0 + power) * t.exp() * s
                };
                return self.work[end] + closed(log_load) - closed(self.knots[end]);
            }
        }
        let k = self.knots.partition_point(|&knot| knot <= log_load).clamp(1, last) - 1;
        self.work[k] + self.gauss(self.knots[k], log_load)
    }
}
