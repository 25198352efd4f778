//! Linear bearing: K and C, constant or tabulated over speed.

use crate::Reaction;
use rotordyn_linalg::pchip::Pchip;

/// Linear bearing: stiffness and damping matrices, constant or tabulated over speed.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearBearing {
    /// Rows sorted by speed \[rad/s\]; one row means constant. Interpolated by monotone cubic (PCHIP); beyond
    /// its first and last row the values of that row hold.
    pub table: Vec<LinearBearingRow>,
    /// Studies at speeds beyond the table.
    pub beyond: BeyondTable,
}

/// Treatment of studies at speeds beyond a bearing's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BeyondTable {
    /// The values of the table's end hold, with a warning.
    #[default]
    Hold,
    /// An error.
    Refuse,
}

impl LinearBearing {
    /// First and last speed of the table \[rad/s\]; `None` for constant stiffness and damping.
    pub fn table_range(&self) -> Option<[f64; 2]> {
        match self.table.as_slice() {
            [first, .., last] => Some([first.speed, last.speed]),
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

/// Stiffness and damping of a bearing between shaft node and housing point, linearised.
///
/// With d = (displacement of the shaft node) − (that of the housing's point), the force on the shaft is
/// f = −K d − C ḋ; order u_x u_y u_z θ_x θ_y θ_z.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SiteTangent {
    /// K \[N/m, N/rad, N m/m, N m/rad\].
    pub stiffness: [[f64; 6]; 6],
    /// C, same order \[N s/m ...\].
    pub damping: [[f64; 6]; 6],
}

impl From<&Reaction> for SiteTangent {
    fn from(reaction: &Reaction) -> Self {
        Self { stiffness: reaction.stiffness, damping: reaction.damping }
    }
}

/// A linear bearing prepared for evaluation.
#[derive(Clone, Debug)]
pub struct LinearElement {
    /// First and last speed of the table \[rad/s\]; `None` for constant matrices.
    range: Option<[f64; 2]>,
    /// Entries that are not identically zero: row, column, curve over speed.
    stiffness: Vec<(usize, usize, Pchip)>,
    damping: Vec<(usize, usize, Pchip)>,
}

impl LinearElement {
    /// Prepares a bearing; an empty table or non-increasing speeds give zero force.
    pub fn new(bearing: &LinearBearing) -> Self {
        let speeds: Vec<f64> = bearing.table.iter().map(|r| r.speed).collect();
        let curves = |pick: &dyn Fn(usize, usize, usize) -> f64| {
            let mut out = Vec::new();
            for a in 0..6 {
                for b in 0..6 {
                    let values: Vec<f64> = (0..speeds.len()).map(|k| pick(k, a, b)).collect();
                    if values.iter().any(|v| *v != 0.0)
                        && let Some(curve) = Pchip::new(&speeds, &values)
                    {
                        out.push((a, b, curve));
                    }
                }
            }
            out
        };
        Self {
            range: bearing.table_range(),
            stiffness: curves(&|k, a, b| bearing.table[k].stiffness[a][b]),
            damping: curves(&|k, a, b| bearing.table[k].damping[a][b]),
        }
    }

    /// Whether stiffness or damping is tabulated over speed.
    pub fn depends_on_speed(&self) -> bool {
        self.range.is_some()
    }

    /// Stiffness K and damping C at a speed Ω \[rad/s\], order u_x u_y u_z θ_x θ_y θ_z; those of the table's end
    /// beyond it.
    pub fn matrices(&self, speed: f64) -> ([[f64; 6]; 6], [[f64; 6]; 6]) {
        let speed = self.range.map_or(speed, |[first, last]| speed.max(first).min(last));
        let fill = |curves: &[(usize, usize, Pchip)]| {
            let mut m = [[0.0; 6]; 6];
            for (a, b, curve) in curves {
                m[*a][*b] = curve.evaluate(speed)[0];
            }
            m
        };
        (fill(&self.stiffness), fill(&self.damping))
    }

    /// Stiffness and damping at a speed Ω \[rad/s\] as a tangent.
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
