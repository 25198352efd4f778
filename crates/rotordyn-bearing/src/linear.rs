//! Linear bearing: K and C, constant or tabulated over speed, over whirl frequency or over both.

use std::sync::Arc;

use crate::model::{BearingElement, BearingModel, BearingSymbol, BeyondTable, SpeedRange};
use crate::{BearingContact, Reaction, Rotation, SiteTangent};
use rotordyn_linalg::pchip::Pchip;

/// Linear bearing: stiffness and damping matrices, constant or tabulated over speed and whirl frequency.
///
/// Over whirl frequency they hold for a motion of that frequency, an excitation or a whirl. FRFs take them at their own
/// frequencies; all studies of synchronous motion, and modes, take the frequency of rotation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinearBearing {
    /// Rows sorted by speed \[rad/s\], and for each speed one for each of `whirl`; one row means constant. Interpolated by
    /// monotone cubic (PCHIP), over speed first; beyond its first and last row see `beyond`.
    pub table: Vec<LinearBearingRow>,
    /// Whirl frequencies \[rad/s\], increasing; none: the same for all.
    pub whirl: Vec<f64>,
    /// Studies at speeds beyond the table.
    pub beyond: BeyondTable,
}

impl LinearBearing {
    /// First and last speed of the table \[rad/s\]; `None` for constant stiffness and damping.
    pub fn table_range(&self) -> Option<[f64; 2]> {
        match self.table.as_slice() {
            [first, .., last] if last.speed > first.speed => Some([first.speed, last.speed]),
            _ => None,
        }
    }
}

/// One row of a [`LinearBearing`]'s table.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearBearingRow {
    /// Speed Ω \[rad/s\].
    pub speed: f64,
    /// Stiffness K, order u_x u_y u_z θ_x θ_y θ_z.
    pub stiffness: [[f64; 6]; 6],
    /// Damping C, same order.
    pub damping: [[f64; 6]; 6],
}

/// A linear bearing prepared for evaluation.
#[derive(Clone, Debug)]
pub struct LinearElement {
    /// First and last speed of the table \[rad/s\]; `None` for matrices that are the same at all speeds.
    range: Option<[f64; 2]>,
    /// Whether the curves go on beyond the table.
    extrapolates: bool,
    /// Whirl frequencies \[rad/s\]; none: the same for all.
    whirl: Vec<f64>,
    /// Entries that are not identically zero: row, column, a curve over speed for each whirl frequency.
    stiffness: Vec<Entry>,
    damping: Vec<Entry>,
}

type Entry = (usize, usize, Vec<Pchip>);

impl LinearElement {
    /// Prepares a bearing; an empty table or non-increasing speeds give zero force.
    pub fn new(bearing: &LinearBearing) -> Self {
        let columns = bearing.whirl.len().max(1);
        let speeds: Vec<f64> = bearing.table.iter().step_by(columns).map(|r| r.speed).collect();
        let curves = |pick: &dyn Fn(usize, usize, usize) -> f64| {
            let mut out = Vec::new();
            for a in 0..6 {
                for b in 0..6 {
                    if (0..bearing.table.len()).all(|k| pick(k, a, b) == 0.0) {
                        continue;
                    }
                    let curve = |column: usize| {
                        let rows = (column..bearing.table.len()).step_by(columns);
                        Pchip::new(&speeds, &rows.map(|k| pick(k, a, b)).collect::<Vec<_>>())
                    };
                    if let Some(curves) = (0..columns).map(curve).collect::<Option<Vec<_>>>() {
                        out.push((a, b, curves));
                    }
                }
            }
            out
        };
        Self {
            range: bearing.table_range(),
            extrapolates: bearing.beyond == BeyondTable::Extrapolate,
            whirl: bearing.whirl.clone(),
            stiffness: curves(&|k, a, b| bearing.table[k].stiffness[a][b]),
            damping: curves(&|k, a, b| bearing.table[k].damping[a][b]),
        }
    }

    /// Whether stiffness or damping is tabulated over speed, or over whirl frequency.
    pub fn depends_on_speed(&self) -> bool {
        self.range.is_some() || !self.whirl.is_empty()
    }

    /// Stiffness K and damping C of synchronous motion at a speed Ω \[rad/s\], order u_x u_y u_z θ_x θ_y θ_z.
    pub fn matrices(&self, speed: f64) -> ([[f64; 6]; 6], [[f64; 6]; 6]) {
        self.matrices_at(speed, speed)
    }

    /// Stiffness K and damping C at a speed and a whirl frequency \[rad/s\]; beyond the table those of its end, or along its
    /// last slope.
    pub fn matrices_at(&self, speed: f64, whirl: f64) -> ([[f64; 6]; 6], [[f64; 6]; 6]) {
        let within = |x: f64, range: Option<[f64; 2]>| match range {
            Some([first, last]) if !self.extrapolates => x.max(first).min(last),
            _ => x,
        };
        let speed = within(speed, self.range);
        let ends = self.whirl.first().zip(self.whirl.last());
        let whirl = within(whirl.abs(), ends.map(|(first, last)| [*first, *last]));
        let fill = |entries: &[Entry]| {
            let mut m = [[0.0; 6]; 6];
            for (a, b, curves) in entries {
                m[*a][*b] = match &curves[..] {
                    [only] => only.evaluate(speed)[0],
                    several => {
                        let values: Vec<f64> = several.iter().map(|curve| curve.evaluate(speed)[0]).collect();
                        Pchip::new(&self.whirl, &values).map_or(0.0, |curve| curve.evaluate(whirl)[0])
                    }
                };
            }
            m
        };
        (fill(&self.stiffness), fill(&self.damping))
    }

    /// Stiffness and damping of synchronous motion at a speed Ω \[rad/s\] as a tangent.
    pub fn tangent(&self, speed: f64) -> SiteTangent {
        let (stiffness, damping) = self.matrices(speed);
        SiteTangent { stiffness, damping }
    }

    /// Force on the shaft f = −K d − C ḋ with its tangents; the symmetric part of K stores ½ dᵀ K d.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], speed: f64) -> Reaction {
        let (stiffness, damping) = self.matrices(speed);
        let mut out = Reaction { stiffness, damping, mean_cos: 1.0, ..Reaction::default() };
        for a in 0..6 {
            for b in 0..6 {
                out.force[a] -= stiffness[a][b] * d[b] + damping[a][b] * v[b];
                out.elastic_energy += 0.5 * d[a] * stiffness[a][b] * d[b];
                out.dissipated_power += v[a] * damping[a][b] * v[b];
                // Work of the skew-symmetric part of K (cross-coupling) is not stored: counted as input
                // power.
                out.parametric_power += 0.5 * v[a] * (stiffness[b][a] - stiffness[a][b]) * d[b];
            }
        }
        out
    }
}

impl BearingModel for LinearBearing {
    fn keyword(&self) -> &'static str {
        "linear"
    }

    fn description(&self) -> String {
        match self.table.len() {
            1 => "linear".into(),
            n if self.whirl.is_empty() => format!("linear, {n} speeds"),
            n => format!("linear, {} speeds, {} whirl frequencies", n / self.whirl.len(), self.whirl.len()),
        }
    }

    fn set_cage_angle(&mut self, _angle: f64) {}

    fn element(&self) -> Arc<dyn BearingElement> {
        Arc::new(LinearElement::new(self))
    }

    fn supports(&self) -> [bool; 6] {
        std::array::from_fn(|k| self.table.iter().any(|row| row.stiffness[k][k] != 0.0))
    }

    fn depends_on_speed(&self) -> bool {
        self.table.len() > 1
    }

    fn symbol(&self) -> BearingSymbol<'_> {
        BearingSymbol::Springs(self.table.iter().map(|row| [&row.stiffness, &row.damping]).collect())
    }

    fn nominal_stiffness(&self) -> [[f64; 6]; 6] {
        LinearElement::new(self).tangent(0.0).stiffness
    }

    fn table_speeds(&self) -> Vec<f64> {
        let mut speeds: Vec<f64> = self.table.iter().map(|row| row.speed).collect();
        speeds.dedup();
        if speeds.len() > 1 { speeds } else { Vec::new() }
    }

    fn speed_range(&self) -> Option<SpeedRange> {
        self.table_range().map(|speeds| SpeedRange { speeds, beyond: self.beyond })
    }
}

impl BearingElement for LinearElement {
    fn relative_dofs(&self) -> usize {
        6
    }

    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        Self::reaction(self, d, v, rotation.shaft_speed)
    }

    fn has_cheap_force(&self) -> bool {
        true
    }

    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, _angles: usize) -> Reaction {
        Self::reaction(self, d, &[0.0; 6], rotation.shaft_speed)
    }

    fn contact_loads(&self, _d: &[f64; 6], _rotation: &Rotation) -> Vec<BearingContact> {
        Vec::new()
    }

    fn depends_on_speed(&self) -> bool {
        Self::depends_on_speed(self)
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn tangent_at(&self, speed: f64, _standstill: SiteTangent) -> SiteTangent {
        self.tangent(speed)
    }

    fn tangent_at_whirl(&self, speed: f64, whirl: f64) -> Option<SiteTangent> {
        let at = |(stiffness, damping)| SiteTangent { stiffness, damping };
        (!self.whirl.is_empty()).then(|| at(self.matrices_at(speed, whirl)))
    }
}
