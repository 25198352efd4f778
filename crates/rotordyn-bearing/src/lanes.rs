//! Numbers of several balls at once: a SIMD vector with the operators of arithmetic.

use std::ops::{Add, AddAssign, Div, Mul, Sub};

use pulp::Simd;

/// A vector of numbers, one per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, values: simd.splat_f64s(value) }
    }

    #[inline(always)]
    pub fn new(simd: S, values: S::f64s) -> Self {
        Self { simd, values }
    }

    /// Zero where not above zero; NaN stays.
    #[inline(always)]
    pub fn positive_part(self) -> Self {
        self.if_positive(self.values)
    }

    /// 1 where above zero, 0 elsewhere; 1 for NaN.
    #[inline(always)]
    pub fn is_positive(self) -> Self {
        self.if_positive(self.simd.splat_f64s(1.0))
    }

    /// These values where above zero or NaN, 0 elsewhere.
    #[inline(always)]
    fn if_positive(self, then: S::f64s) -> Self {
        let Self { simd, values } = self;
        let zero = simd.splat_f64s(0.0);
        Self { simd, values: simd.select_f64s(simd.less_than_or_equal_f64s(values, zero), zero, then) }
    }

    /// The smaller of the number and 1; NaN stays.
    #[inline(always)]
    pub fn at_most_one(self) -> Self {
        let Self { simd, values } = self;
        let one = simd.splat_f64s(1.0);
        let is_above = simd.less_than_f64s(one, values);
        Self { simd, values: simd.select_f64s(is_above, one, values) }
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { simd: self.simd, values: self.simd.sqrt_f64s(self.values) }
    }

    /// Whether every lane is zero; of numbers that are not negative.
    #[inline(always)]
    pub fn is_zero(self) -> bool {
        self.sum() == 0.0
    }

    /// Sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        self.simd.reduce_sum_f64s(self.values)
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.add_f64s(self.values, other.values) }
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.sub_f64s(self.values, other.values) }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.mul_f64s(self.values, other.values) }
    }
}

/// Times the same number in every lane.
impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Self::splat(self.simd, factor)
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { simd: self.simd, values: self.simd.div_f64s(self.values, other.values) }
    }
}
