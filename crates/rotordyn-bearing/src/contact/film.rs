//! Hamrock-Dowson elastohydrodynamic (EHL) film thickness, and the spring of a Hertzian contact in series
//! with it.

use super::{ContactLoad, EllipticContact, Lubricant};
use std::sync::LazyLock;

/// EHL film thickness of a rolling contact, fully flooded and isothermal (Hamrock-Dowson).
///
/// With U = η₀ u/(E′ R_x), G = α E′, W = Q/(E′ R_x²), E′ = 2 E*, and κ the ellipse ratio (across/along rolling):
/// h_c = 2.69 R_x U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^{−0.73 κ}),
/// h_min = 3.63 R_x U^0.68 G^0.49 W^−0.073 (1 − e^{−0.68 κ}).
///
/// Source: Hamrock & Dowson 1977; Bal 2022 eq. 5. Fitted for hard contacts with κ from 1 to 8; the formula
/// is unbounded as Q → 0 (for the regularisation see [`FilmSpring`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmFormula {
    /// Thickness at u = 1 m/s and Q = 1 N \[m\].
    central: f64,
    minimum: f64,
}

impl FilmFormula {
    /// Film of a contact under a lubricant.
    pub fn new(contact: &EllipticContact, lubricant: &Lubricant) -> Self {
        let modulus = 2.0 * contact.modulus;
        let radius = contact.rolling_radius;
        let speed = lubricant.viscosity / (modulus * radius);
        let material = lubricant.pressure_viscosity * modulus;
        let load = 1.0 / (modulus * radius * radius);
        let slender = contact.transverse_radius.abs() >= radius;
        let ellipticity = if slender { contact.ratio } else { 1.0 / contact.ratio };
        Self {
            central: 2.69
                * radius
                * speed.powf(0.67)
                * material.powf(0.53)
                * load.powf(-0.067)
                * (1.0 - 0.61 * (-0.73 * ellipticity).exp()),
            minimum: 3.63
                * radius
                * speed.powf(0.68)
                * material.powf(0.49)
                * load.powf(-0.073)
                * (1.0 - (-0.68 * ellipticity).exp()),
        }
    }

    /// Central thickness h_c \[m\] at an entrainment speed u \[m/s\] under a load Q > 0 \[N\].
    pub fn central(&self, speed: f64, load: f64) -> f64 {
        self.central * speed.powf(0.67) * load.powf(-0.067)
    }

    /// Minimum thickness h_min \[m\] at an entrainment speed u \[m/s\] under a load Q > 0 \[N\].
    pub fn minimum(&self, speed: f64, load: f64) -> f64 {
        self.minimum * speed.powf(0.68) * load.powf(-0.073)
    }
}

/// Film parameter (lambda ratio) λ = h/√(R_q1² + R_q2²) with the RMS roughness of both surfaces \[m\].
pub fn lambda_ratio(thickness: f64, roughness: [f64; 2]) -> f64 {
    thickness / roughness[0].hypot(roughness[1])
}

/// One Hertzian contact, or the two of a ball in series, with films of central thickness h(Q) at one speed.
///
/// Q = K s^{3/2} with the elastic deformation s = δ + h(Q), h = C Q^−0.067 summed over the contacts. Below
/// Q_t = [`FilmSpring::THRESHOLD`] the film is continued by its tangent in s, so that it remains finite,
/// h₀ ≈ 1.1 h(Q_t) at zero load: the contact is there a softer Hertzian spring, unloaded for δ ≤ −h₀. Q and
/// dQ/dδ are continuous, Q increases with δ, and zero speed gives the dry contact.
///
/// In units of the length λ = (C K^−0.067)^{1/(1+q)}, q = 1.5 · 0.067, every such spring follows the same
/// curve σ − σ^−q = δ/λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSpring {
    /// K \[N/m^1.5\].
    stiffness: f64,
    /// λ \[m\].
    length: f64,
    /// Deformation s/λ and film h/λ at the threshold load.
    knee: f64,
    knee_film: f64,
    /// B in b = B √s, semi-axis of the contacts along rolling, film-weighted mean \[m^0.5\].
    width: f64,
}

/// Exponent of the load in h, and q = 1.5 times it.
const LOAD_POWER: f64 = 0.067;
const DEFORMATION_POWER: f64 = 1.5 * LOAD_POWER;

/// Scaling of the film springs with entrainment speed u: λ by u^{0.67/(1+q)}.
pub(super) struct FilmSpeedScaling {
    length: f64,
    /// `length` to the power q.
    film: f64,
}

impl FilmSpeedScaling {
    pub(super) fn new(speed: f64) -> Self {
        let length = speed.powf(0.67 / (1.0 + DEFORMATION_POWER));
        Self { length, film: length.powf(DEFORMATION_POWER) }
    }
}

impl FilmSpring {
    /// Load below which the film is continued linearly \[N\].
    ///
    /// A thousandth of a newton: far below relevant loads, far above round-off.
    pub const THRESHOLD: f64 = 1e-3;

    /// Spring at u = 1 m/s of contacts in series under the same load, with series stiffness K.
    pub fn new(contacts: &[(&EllipticContact, &FilmFormula)], stiffness: f64) -> Self {
        let film: f64 = contacts.iter().map(|(_, film)| film.central).sum();
        let width: f64 = contacts
            .iter()
            .map(|(contact, film)| contact.patch(1.0).semi_minor * stiffness.cbrt() * film.central)
            .sum();
        let length = (film * stiffness.powf(-LOAD_POWER)).powf(1.0 / (1.0 + DEFORMATION_POWER));
        let knee = (Self::THRESHOLD / stiffness).powf(2.0 / 3.0) / length;
        Self { stiffness, length, knee, knee_film: knee.powf(-DEFORMATION_POWER), width: width / film }
    }

    /// The spring at another speed, scaled from 1 m/s.
    pub(super) fn scaled(&self, growth: &FilmSpeedScaling) -> Self {
        Self {
            length: self.length * growth.length,
            knee: self.knee / growth.length,
            knee_film: self.knee_film * growth.film,
            ..*self
        }
    }

    /// Whether a film exists: requires non-zero speed and viscosity.
    pub(super) fn exists(&self) -> bool {
        self.length.is_normal() && self.knee.is_normal() && self.knee_film.is_normal()
    }

    /// Film h₀ at zero load \[m\]: no load for δ ≤ −h₀.
    pub fn zero_load_film(&self) -> f64 {
        self.length * self.knee_film * (1.0 + DEFORMATION_POWER)
    }

    /// Film under a load Q ≥ 0 \[m\]; h₀ at Q = 0.
    pub fn film(&self, load: f64) -> f64 {
        let deformation = (load.max(0.0) / self.stiffness).powf(2.0 / 3.0) / self.length;
        if deformation > self.knee {
            self.length * deformation.powf(-DEFORMATION_POWER)
        } else {
            self.length * self.knee_film * (1.0 + DEFORMATION_POWER * (1.0 - deformation / self.knee))
        }
    }

    /// Load, slope and energy at the approach δ \[m\] of the bodies.
    ///
    /// dQ/dδ = (3/2) K √s/(1 + q h/s); ∫Q dδ = K (2/5 s^{5/2} + q/(3/2 − q) h s^{3/2}) + const, with
    /// zero energy at zero load.
    pub fn load(&self, approach: f64) -> ContactLoad {
        let (knee, knee_film) = (self.knee, self.knee_film);
        let reduced = approach / self.length;
        let force = self.stiffness * self.length * self.length.sqrt();
        if reduced < knee - knee_film {
            let stretch = 1.0 + DEFORMATION_POWER * knee_film / knee;
            let s = (reduced + knee_film * (1.0 + DEFORMATION_POWER)) / stretch;
            if s <= 0.0 {
                return ContactLoad::default();
            }
            let load = force * s * s.sqrt();
            return ContactLoad {
                load,
                slope: 1.5 * force * s.sqrt() / (stretch * self.length),
                energy: 0.4 * load * stretch * s * self.length,
            };
        }
        let (s, film) = deformation(reduced);
        let root = s.sqrt();
        let below =
            DEFORMATION_POWER * (0.4 - 1.0 / (1.5 - DEFORMATION_POWER)) * knee_film * knee * knee.sqrt();
        ContactLoad {
            load: force * s * root,
            slope: 1.5 * force * root / ((1.0 + DEFORMATION_POWER * film / s) * self.length),
            energy: force
                * self.length
                * ((0.4 * s + DEFORMATION_POWER / (1.5 - DEFORMATION_POWER) * film) * s * root + below),
        }
    }

    /// Film damping per unit of relaxation factor and 1/u, b K_f (1 − K_f/K_e) \[N\], and its slope with δ
    /// \[N/m\].
    ///
    /// K_e = (3/2) K √s is the stiffness at constant film, K_f = dQ/dδ of `elastic`; with r = K_e/K_f − 1 = q h/s
    /// this is b K_e r/(1 + r)². See [`super::ContactDamping::Film`].
    pub(super) fn film_damping(&self, elastic: &ContactLoad) -> (f64, f64) {
        if elastic.load <= 0.0 {
            return (0.0, 0.0);
        }
        let root = (elastic.load / self.stiffness).cbrt();
        let elastic_stiffness = 1.5 * self.stiffness * root;
        let r = (elastic_stiffness / elastic.slope - 1.0).max(0.0);
        let value = self.width * root * elastic.slope * r / (1.0 + r);
        // r ∝ s^−(1+q) on the film formula, constant below the threshold.
        let fall = if elastic.load > Self::THRESHOLD { 1.0 + DEFORMATION_POWER } else { 0.0 };
        (value, value / (root * root) * (1.0 - fall * (1.0 - r) / (1.0 + r)) / (1.0 + r))
    }
}

/// Solves σ − σ^−q = d for σ > 0; returns σ and σ^−q to machine precision.
///
/// Halley iteration in ln σ from a tabulated initial value: one step for d between −4 and 64, a few outside.
fn deformation(d: f64) -> (f64, f64) {
    let mut log = initial_log_deformation(d);
    for _ in 0..60 {
        let (s, film) = (log.exp(), (-DEFORMATION_POWER * log).exp());
        let residual = s - film - d;
        let (first, second) =
            (s + DEFORMATION_POWER * film, s - DEFORMATION_POWER * DEFORMATION_POWER * film);
        let newton = -residual / first;
        let step = newton / (1.0 + 0.5 * newton * second / first);
        // The error after a step is of third order in it: series expansion of σ and σ^−q is exact to
        // round-off.
        if step.abs() < 1e-5 {
            let grow = |x: f64| 1.0 + x * (1.0 + 0.5 * x * (1.0 + x / 3.0));
            return (s * grow(step), film * grow(-DEFORMATION_POWER * step));
        }
        log += step;
    }
    (log.exp(), (-DEFORMATION_POWER * log).exp())
}

const TABLE_START: f64 = -4.0;
const TABLE_END: f64 = 64.0;
const TABLE_NODES_PER_UNIT: f64 = 16.0;

/// Lookup table of ln σ and its slope over d from `TABLE_START` to `TABLE_END`, the range of nearly all evaluations.
static DEFORMATION_TABLE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let mut log: f64 = -13.8;
    (0..=((TABLE_END - TABLE_START) * TABLE_NODES_PER_UNIT) as usize)
        .map(|k| {
            let d = TABLE_START + k as f64 / TABLE_NODES_PER_UNIT;
            // Newton from the previous node.
            let slope = (0..8).fold(0.0, |_, _| {
                let (s, film) = (log.exp(), (-DEFORMATION_POWER * log).exp());
                log -= (s - film - d) / (s + DEFORMATION_POWER * film);
                1.0 / (s + DEFORMATION_POWER * film)
            });
            [log, slope]
        })
        .collect()
});

/// Initial value of ln σ, to about 1e-6 by cubic Hermite interpolation of the table; outside it, asymptotes.
fn initial_log_deformation(d: f64) -> f64 {
    if d >= TABLE_END {
        return (d + d.powf(-DEFORMATION_POWER)).ln();
    }
    if d < TABLE_START {
        return -(-d).ln() / DEFORMATION_POWER;
    }
    let x = (d - TABLE_START) * TABLE_NODES_PER_UNIT;
    let k = x as usize;
    let t = x - k as f64;
    let ([y0, m0], [y1, m1]) = (DEFORMATION_TABLE[k], DEFORMATION_TABLE[k + 1]);
    let (m0, m1) = (m0 / TABLE_NODES_PER_UNIT, m1 / TABLE_NODES_PER_UNIT);
    let rise = y1 - y0;
    y0 + t * (m0 + t * (3.0 * rise - 2.0 * m0 - m1 + t * (m0 + m1 - 2.0 * rise)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deformation_solved_to_round_off() {
        let mut d = -30.0;
        while d < 1e6 {
            let (s, film) = deformation(d);
            let scale = s + film;
            assert!(
                (s - film - d).abs() <= 4e-16 * scale * (1.0 + (-DEFORMATION_POWER * s.ln()).abs()),
                "d = {d}"
            );
            assert!((film / (-DEFORMATION_POWER * s.ln()).exp() - 1.0).abs() < 2e-15, "d = {d}");
            d += 0.01 * (1.0 + d.abs() / 3.0);
        }
    }
}
