//! Sensitivities: derivatives of eigenvalues, mode shapes and FRFs with respect to a parameter of the model.
//!
//! The derivatives of the matrices are central differences of assemblies at p ± h: exact to rounding where a
//! matrix is linear in the parameter (stiffness and damping of housings, bushings, belts and linear
//! bearings), with an error of order h² elsewhere. With nonlinear bearings the equilibrium depends on the
//! parameter, and so do the tangents: q′ follows by implicit differentiation, (K + K_t) q′ = ∂r/∂p, and the
//! tangents are evaluated at q ± h q′. All else is analytic, from left and right eigenvectors; no eigenvalue
//! is computed twice.

use super::equilibrium::{
    CageTreatment, Equilibrium, Sites, bearing_stiffness_matrix, equilibrium, external_load, residual_force,
};
use super::harmonic::HarmonicSystem;
use super::mode::inner;
use super::preload::with_mounted_preload;
use super::table_range;
use crate::assembly::rigid_body_modes::{motion_of, unconstrained_motion};
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use crate::model::{Model, Quantity};
use rotordyn_bearing::{Reaction, SiteTangent};
use rotordyn_linalg::refinement::{PreciseResidual, refine};
use rotordyn_linalg::{BandLayout, Complex64, SparseMatrix, SparseRow, Triplets};
use std::f64::consts::TAU;

use super::frf::derivative_factor as time_derivative;

/// A machine linearised about its equilibrium at one speed, ball bearings averaged over the cage angle.
#[derive(Clone, Debug)]
pub struct Linearised {
    pub model: Model,
    pub assembly: Assembly,
    pub equilibrium: Equilibrium,
    /// Equilibrium at standstill, for modal damping at another speed.
    standstill: Option<Equilibrium>,
    pub system: LinearSystem,
}

impl Linearised {
    /// Assembles, finds the equilibrium at `speed` Ω \[rad/s\] from `start` or from q = 0, and linearises.
    ///
    /// # Errors
    /// A mass matrix that is not definite, or no equilibrium.
    pub fn new(model: Model, speed: f64, start: Option<&[f64]>) -> Result<Self, PhysicsError> {
        table_range::check_tables(&model, "the linearised machine", [speed; 2])?;
        let mut assembly = Assembly::new(&model)?;
        let model = with_mounted_preload(&model, &assembly)?.unwrap_or(model);
        let start = start.filter(|q| q.len() == assembly.dofs.len());
        let found = equilibrium(&model, &assembly, speed, CageTreatment::Averaged, start)?;
        // Modal damping is that of the machine at standstill.
        let standstill = if speed != 0.0 && !assembly.modal_damping.is_empty() {
            Some(equilibrium(&model, &assembly, 0.0, CageTreatment::Averaged, Some(&found.q))?)
        } else {
            None
        };
        assembly.set_standstill(&standstill.as_ref().unwrap_or(&found).tangents())?;
        let system = LinearSystem::new(&assembly, &found.tangents(), speed)?;
        Ok(Self { model, assembly, equilibrium: found, standstill, system })
    }

    /// dM/dp, dD/dp and dS/dp from the models at p − h and p + h, `width` = 2h in units of p.
    ///
    /// # Errors
    /// A parameter that changes the mesh or the free DOFs, or a singular tangent stiffness.
    pub fn derivative(
        &self,
        below: &Model,
        above: &Model,
        width: f64,
    ) -> Result<SystemDerivative, PhysicsError> {
        let side = |model: &Model| -> Result<PerturbedAssembly, PhysicsError> {
            let assembly = Assembly::new(model)?;
            if assembly.dofs.free != self.assembly.dofs.free {
                let reason = "it changes the mesh or which motions are free".into();
                return Err(PhysicsError::NoDerivative { reason });
            }
            let solved = with_mounted_preload(model, &assembly)?;
            let model = solved.as_ref().unwrap_or(model);
            let sites = |at: &Equilibrium| Sites::new(model, at.speed, CageTreatment::Averaged);
            Ok(PerturbedAssembly {
                assembly,
                sites: sites(&self.equilibrium),
                standstill: self.standstill.as_ref().map(sites),
            })
        };
        let (mut below, mut above) = (side(below)?, side(above)?);
        if let Some(standstill) = &self.standstill {
            let [low, high] = self.perturbed_tangents(standstill, [&below, &above], width)?;
            below.assembly.set_standstill(&low)?;
            above.assembly.set_standstill(&high)?;
        }
        let [low, high] = self.perturbed_tangents(&self.equilibrium, [&below, &above], width)?;
        let speed = self.system.speed;
        let (low, high) = (
            LinearSystem::new(&below.assembly, &low, speed)?,
            LinearSystem::new(&above.assembly, &high, speed)?,
        );
        let slope =
            |a: &SparseMatrix, b: &SparseMatrix| SparseMatrix::sum(&[(1.0 / width, b), (-1.0 / width, a)]);
        Ok(SystemDerivative {
            mass: slope(&low.mass, &high.mass),
            damping: slope(&low.full_damping(), &high.full_damping()),
            stiffness: slope(&low.stiffness, &high.stiffness),
        })
    }

    /// Tangents of the bearings at p ∓ h about the equilibria `of` ∓ h q′, `width` = 2h.
    fn perturbed_tangents(
        &self,
        of: &Equilibrium,
        sides: [&PerturbedAssembly; 2],
        width: f64,
    ) -> Result<[Vec<SiteTangent>; 2], PhysicsError> {
        let [below, above] = sides.map(|side| side.residual_force(of));
        let change = above.iter().zip(below).map(|(a, b)| (a - b) / width).collect();
        let shift = self.equilibrium_derivative(of, change)?;
        let at = |side: &PerturbedAssembly, way: f64| {
            let there: Vec<f64> = of.q.iter().zip(&shift).map(|(q, m)| q + way * 0.5 * width * m).collect();
            side.reactions(of, &there).iter().map(SiteTangent::from).collect()
        };
        Ok([at(sides[0], -1.0), at(sides[1], 1.0)])
    }

    /// Derivative of an equilibrium, q′ of (K + K_t) q′ = `change`.
    fn equilibrium_derivative(
        &self,
        of: &Equilibrium,
        mut change: Vec<f64>,
    ) -> Result<Vec<f64>, PhysicsError> {
        if change.iter().all(|r| *r == 0.0) {
            return Ok(change);
        }
        let sites = Sites::new(&self.model, of.speed, CageTreatment::Averaged);
        let reactions = sites.reactions(&self.assembly, &of.q);
        let bearings = bearing_stiffness_matrix(&self.assembly, &reactions);
        let (mass, stiffness) = (&self.assembly.mass, &self.assembly.stiffness);
        let layout = BandLayout::new(&[mass, stiffness, &bearings]);
        // (2π · 0.002 Hz)² M regularises rigid-body modes; negligible compared with any spring.
        const MASS_SHIFT: f64 = 1e-4;
        let tangent = SparseMatrix::sum(&[(1.0, stiffness), (1.0, &bearings), (MASS_SHIFT, mass)]);
        let lu = layout
            .factor::<f64>(layout.scatter(&tangent))
            .map_err(|p| PhysicsError::Singular { motion: motion_of(&self.assembly, p.unknown) })?;
        let load = change.clone();
        lu.solve(&mut change);
        // Shafts of many elements need more digits than a direct solution has; their sum would round them away.
        refine(&mut change, |slope| {
            let mut residual = PreciseResidual::of(&load);
            for (factor, matrix) in [(1.0, stiffness), (1.0, &bearings), (MASS_SHIFT, mass)] {
                residual.subtract(factor, matrix, slope);
            }
            let mut correction = residual.values();
            lu.solve(&mut correction);
            correction
        });
        Ok(change)
    }
}

/// The assembly at one of the two perturbed parameter values.
struct PerturbedAssembly {
    assembly: Assembly,
    sites: Sites,
    /// The bearings at standstill, where the equilibrium is at another speed.
    standstill: Option<Sites>,
}

impl PerturbedAssembly {
    /// Reactions of the bearings at the speed of an equilibrium, at displacements q.
    fn reactions(&self, of: &Equilibrium, q: &[f64]) -> Vec<Reaction> {
        let standstill = self.standstill.as_ref().filter(|_| of.speed == 0.0);
        standstill.unwrap_or(&self.sites).reactions(&self.assembly, q)
    }

    fn residual_force(&self, of: &Equilibrium) -> Vec<f64> {
        residual_force(&self.assembly, external_load(&self.assembly), &of.q, &self.reactions(of, &of.q))
    }
}

/// Derivatives of M, D and S with respect to one parameter, including the shift of the equilibrium.
#[derive(Clone, Debug)]
pub struct SystemDerivative {
    pub mass: SparseMatrix,
    pub damping: SparseMatrix,
    pub stiffness: SparseMatrix,
}

impl SystemDerivative {
    /// (λ² dM + λ dD + dS) φ.
    pub fn apply(&self, value: Complex64, shape: &[Complex64]) -> Vec<Complex64> {
        let [m, d, s] = [&self.mass, &self.damping, &self.stiffness].map(|matrix| matrix.mul_complex(shape));
        (0..s.len()).map(|i| value * value * m[i] + value * d[i] + s[i]).collect()
    }

    /// Whether all derivatives vanish.
    pub fn is_zero(&self) -> bool {
        [&self.mass, &self.damping, &self.stiffness].iter().all(|m| m.max_abs() == 0.0)
    }
}

/// One eigenpair with its left eigenvector, for derivatives with respect to any number of parameters.
pub struct ModeSensitivity<'a> {
    system: &'a LinearSystem,
    value: Complex64,
    right: &'a [Complex64],
    left: Vec<Complex64>,
    /// ψᵀ (2λ M + D) φ.
    norm: Complex64,
    /// (2λ M + D) φ.
    weighted: Vec<Complex64>,
    other: Option<DoublePartner<'a>>,
}

/// The other mode of a double eigenvalue, scaled so that ψ_bᵀ (2λ M + D) φ_a = 0 and ψ_bᵀ (2λ M + D) φ_b = 1.
struct DoublePartner<'a> {
    right: &'a [Complex64],
    left: Vec<Complex64>,
    weighted: Vec<Complex64>,
}

/// D and S count as symmetric when mirrored entries agree within this fraction of the largest.
const SYMMETRY_TOLERANCE: f64 = 1e-9;

impl<'a> ModeSensitivity<'a> {
    /// Computes the left eigenvector of an eigenpair λ, φ of (λ² M + λ D + S) φ = 0: φ itself for symmetric
    /// matrices, else by inverse iteration on the transposed problem.
    ///
    /// # Errors
    /// A defective eigenvalue, whose left and right vectors are orthogonal: it has no derivative.
    pub fn new(
        system: &'a LinearSystem,
        value: Complex64,
        right: &'a [Complex64],
    ) -> Result<Self, PhysicsError> {
        let left = left_vector(system, value, right)?;
        let (m, d) = (system.mass.mul_complex(right), system.damp(right));
        let weighted: Vec<Complex64> = m.iter().zip(&d).map(|(m, d)| 2.0 * value * m + d).collect();
        let norm = bilinear_product(&left, &weighted);
        let size = inner(&left, &left).re.sqrt() * inner(&weighted, &weighted).re.sqrt();
        if norm.norm() <= 1e-12 * size {
            let reason = format!("the eigenvalue at {:.3} Hz is defective", value.im / TAU);
            return Err(PhysicsError::NoDerivative { reason });
        }
        Ok(Self { system, value, right, left, norm, weighted, other: None })
    }

    /// One mode of a double (repeated) eigenvalue, with `other`; left and right vectors are biorthogonal.
    ///
    /// The derivatives of the two eigenvalues are the eigenvalues of the 2×2 matrix −Ψᵀ (λ² dM + λ dD + dS)
    /// Φ. This gives its diagonal for the given shapes, and [`Self::coupling`] its off-diagonal entries.
    /// Intended for shapes fixed by other data, such as those of a test: a parameter that splits the pair
    /// selects the modes' own planes discontinuously, so that their rotation has no derivative.
    ///
    /// # Errors
    /// A defective eigenvalue.
    pub fn of_double_eigenvalue(
        system: &'a LinearSystem,
        value: Complex64,
        right: &'a [Complex64],
        other: &'a [Complex64],
    ) -> Result<Self, PhysicsError> {
        let lefts = [left_vector(system, value, right)?, left_vector(system, value, other)?];
        let weighted = [right, other].map(|v| {
            let (m, d) = (system.mass.mul_complex(v), system.damp(v));
            m.iter().zip(&d).map(|(m, d)| 2.0 * value * m + d).collect::<Vec<Complex64>>()
        });
        // Ψ = L G⁻ᵀ with G = Lᵀ (2λ M + D) Φ has Ψᵀ (2λ M + D) Φ = 1.
        let g = [0, 1].map(|i| [0, 1].map(|j| bilinear_product(&lefts[i], &weighted[j])));
        let determinant = g[0][0] * g[1][1] - g[0][1] * g[1][0];
        let size = |v: &[Complex64]| inner(v, v).re;
        let scale = (size(&lefts[0]) * size(&lefts[1]) * size(&weighted[0]) * size(&weighted[1])).sqrt();
        if determinant.norm() <= 1e-12 * scale {
            let reason = format!("the double eigenvalue at {:.3} Hz is defective", value.im / TAU);
            return Err(PhysicsError::NoDerivative { reason });
        }
        let combined = |a: Complex64, b: Complex64| -> Vec<Complex64> {
            lefts[0].iter().zip(&lefts[1]).map(|(v, w)| (v * a + w * b) / determinant).collect()
        };
        let left = combined(g[1][1], -g[0][1]);
        let across = combined(-g[1][0], g[0][0]);
        let [weighted, other_weighted] = weighted;
        let other = Some(DoublePartner { right: other, left: across, weighted: other_weighted });
        Ok(Self { system, value, right, left, norm: 1.0.into(), weighted, other })
    }

    /// −ψ_bᵀ (λ² dM + λ dD + dS) φ_a / ψ_bᵀ (2λ M + D) φ_b with the other mode b of a double eigenvalue; 0 for a simple one.
    pub fn coupling(&self, by: &SystemDerivative) -> Complex64 {
        let change =
            |other: &DoublePartner| -bilinear_product(&other.left, &by.apply(self.value, self.right));
        self.other.as_ref().map_or_else(Complex64::default, change)
    }

    /// λ′ = −ψᵀ (λ² dM + λ dD + dS) φ / ψᵀ (2λ M + D) φ.
    pub fn eigenvalue_derivative(&self, by: &SystemDerivative) -> Complex64 {
        -bilinear_product(&self.left, &by.apply(self.value, self.right)) / self.norm
    }

    /// φ′ for every parameter, its largest component fixed (Nelson's method, one factorisation for all).
    ///
    /// Any multiple of φ may be added: it only scales the shape.
    ///
    /// # Errors
    /// A double eigenvalue, whose individual shapes are not unique.
    pub fn shape_derivatives(&self, by: &[&SystemDerivative]) -> Result<Vec<Vec<Complex64>>, PhysicsError> {
        let fixed = self.fixed_components();
        let without = |a: &SparseMatrix, diagonal: f64| {
            let mut out = Triplets::new(a.rows(), a.cols());
            let kept = a.iter().filter(|(i, j, _)| !fixed.contains(i) && !fixed.contains(j));
            kept.for_each(|(i, j, v)| out.add(i, j, v));
            fixed.iter().for_each(|&k| out.add(k, k, diagonal));
            out.build()
        };
        let system = self.system;
        let scale = system.stiffness.get(fixed[0], fixed[0]).abs().max(f64::MIN_POSITIVE);
        let matrices = [
            without(&system.mass, 0.0),
            without(&system.full_damping(), 0.0),
            without(&system.stiffness, scale),
        ];
        let layout = BandLayout::new(&[&matrices[0], &matrices[1], &matrices[2]]);
        let [m, d, s] = matrices.each_ref().map(|a| layout.scatter(a));
        let value = self.value;
        let values = (0..s.len()).map(|k| value * value * m[k] + value * d[k] + s[k]).collect();
        let lu = layout.factor::<Complex64>(values).map_err(|_| PhysicsError::NoDerivative {
            reason: format!("two modes share {:.3} Hz, and their shapes are not unique", value.im / TAU),
        })?;
        let solve = |by: &&SystemDerivative| {
            let slope = self.eigenvalue_derivative(by);
            let mut b: Vec<Complex64> = by
                .apply(value, self.right)
                .iter()
                .zip(&self.weighted)
                .map(|(f, w)| -(f + slope * w))
                .collect();
            if let Some(other) = &self.other {
                // The rotation within the subspace of the two shapes is excluded.
                let across = self.coupling(by);
                b.iter_mut().zip(&other.weighted).for_each(|(b, w)| *b -= across * w);
            }
            fixed.iter().for_each(|&k| b[k] = Complex64::default());
            lu.solve(&mut b);
            b
        };
        Ok(by.iter().map(solve).collect())
    }

    /// Fixed components in Nelson's method: where right and left vectors (of both double modes) are large.
    fn fixed_components(&self) -> Vec<usize> {
        let largest = |size: &dyn Fn(usize) -> f64| {
            (0..self.right.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0)
        };
        let Some(other) = &self.other else {
            return vec![largest(&|i| (self.right[i] * self.left[i]).norm_sqr())];
        };
        let all = |i: usize| {
            let of = |a: &[Complex64], b: &[Complex64]| a[i].norm_sqr() + b[i].norm_sqr();
            of(self.right, other.right) * of(&self.left, &other.left)
        };
        let first = largest(&all);
        let minor =
            |a: &[Complex64], b: &[Complex64], i: usize| (a[first] * b[i] - a[i] * b[first]).norm_sqr();
        vec![first, largest(&|i| minor(self.right, other.right, i) * minor(&self.left, &other.left, i))]
    }
}

/// aᵀ b, not conjugated.
fn bilinear_product(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn is_symmetric(a: &SparseMatrix) -> bool {
    let largest = a.max_abs();
    a.iter().all(|(i, j, v)| (v - a.get(j, i)).abs() <= SYMMETRY_TOLERANCE * largest)
}

/// Left eigenvector ψ of ψᵀ (λ² M + λ D + S) = 0, by inverse iteration.
fn left_vector(
    system: &LinearSystem,
    value: Complex64,
    right: &[Complex64],
) -> Result<Vec<Complex64>, PhysicsError> {
    if is_symmetric(&system.damping) && is_symmetric(&system.stiffness) {
        return Ok(right.to_vec());
    }
    let damping = system.full_damping();
    let matrices = [&system.mass, &damping, &system.stiffness].map(SparseMatrix::transposed);
    let layout = BandLayout::new(&[&matrices[0], &matrices[1], &matrices[2]]);
    let [m, d, s] = matrices.each_ref().map(|a| layout.scatter(a));
    // Shifted slightly off the eigenvalue, so that the factors exist and one step gains eight digits.
    let near = value * (1.0 + 1e-8);
    let values = (0..s.len()).map(|k| near * near * m[k] + near * d[k] + s[k]).collect();
    let lu = layout.factor::<Complex64>(values).map_err(|_| PhysicsError::NoDerivative {
        reason: format!("the mode at {:.3} Hz has no left vector", value.im / TAU),
    })?;
    // ψ of a rotor is near the conjugate of φ.
    let mut left: Vec<Complex64> = right.iter().map(|v| v.conj()).collect();
    for _ in 0..4 {
        lu.solve(&mut left);
        let size = inner(&left, &left).re.sqrt();
        left.iter_mut().for_each(|v| *v /= size);
    }
    Ok(left)
}

/// FRFs and their derivatives with respect to parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct FrfSensitivity {
    /// H\[response\]\[excitation\]\[frequency\].
    pub values: Vec<Vec<Vec<Complex64>>>,
    /// dH/dp\[parameter\]\[response\]\[excitation\]\[frequency\].
    pub derivatives: Vec<Vec<Vec<Vec<Complex64>>>>,
}

/// H = (jω)^p r A⁻¹ eᵀ and H′ = −(jω)^p r A⁻¹ (dS − ω² dM + jω dD) A⁻¹ eᵀ, A = S − ω² M + jω D.
///
/// `frequencies` in Hz; one banded complex factorisation each.
///
/// # Errors
/// A frequency at which the dynamic stiffness is singular, naming the motion.
pub fn frf_sensitivity(
    at: &Linearised,
    frequencies: &[f64],
    excitations: &[SparseRow],
    responses: &[SparseRow],
    quantities: &[Quantity],
    by: &[&SystemDerivative],
) -> Result<FrfSensitivity, PhysicsError> {
    let system = &at.system;
    let harmonic = HarmonicSystem::new(system, None);
    let empty = vec![vec![Vec::with_capacity(frequencies.len()); excitations.len()]; responses.len()];
    let mut out = FrfSensitivity { values: empty.clone(), derivatives: vec![empty; by.len()] };
    let mut solver = harmonic.solver();
    for &hz in frequencies {
        let omega = TAU * hz;
        let value = Complex64::new(0.0, omega);
        solver.factor(omega).map_err(|pivot| {
            let motion = unconstrained_motion(&at.assembly, system, pivot.unknown);
            PhysicsError::Singular { motion: format!("at {hz} Hz {motion}") }
        })?;
        for (e, excitation) in excitations.iter().enumerate() {
            let mut q = vec![Complex64::default(); harmonic.size()];
            excitation.0.iter().for_each(|&(i, v)| q[i] += v);
            solver.solve(&mut q);
            let read = |q: &[Complex64], r: usize| {
                time_derivative(quantities[r], omega) * responses[r].dot_complex(q)
            };
            for (r, values) in out.values.iter_mut().enumerate() {
                values[e].push(read(&q, r));
            }
            for (slopes, by) in out.derivatives.iter_mut().zip(by) {
                let mut change = by.apply(value, &q);
                change.iter_mut().for_each(|v| *v = -*v);
                solver.solve(&mut change);
                for (r, slopes) in slopes.iter_mut().enumerate() {
                    slopes[e].push(read(&change, r));
                }
            }
        }
    }
    Ok(out)
}
