//! Piecewise-linear interpolation in a table.

/// Extrapolation of a table beyond its first and last row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    Zero,
    /// The values of the row at that end.
    Constant,
}

/// Row of a table at x: y = y₀ + (y₁ − y₀) (x − x₀)/(x₁ − x₀) between rows (x₀, y₀ …) and (x₁, y₁ …) with increasing x.
///
/// The first number of a row is x, the others are the values. An empty table is zero everywhere.
#[inline]
pub fn piecewise<const N: usize>(table: &[[f64; N]], x: f64, outside: Outside) -> [f64; N] {
    if let (Outside::Constant, Some(first), Some(last)) = (outside, table.first(), table.last()) {
        for (row, beyond) in [(first, x <= first[0]), (last, x >= last[0])] {
            if beyond {
                return *row;
            }
        }
    }
    piecewise_within(table, x).unwrap_or([0.0; N])
}

/// The same, but `None` outside the table; NaN at NaN.
#[inline]
pub fn piecewise_within<const N: usize>(table: &[[f64; N]], x: f64) -> Option<[f64; N]> {
    let (first, last) = (table.first()?, table.last()?);
    if x < first[0] || x > last[0] {
        return None;
    }
    let next = table.partition_point(|row| row[0] <= x).clamp(1, table.len().max(2) - 1);
    let left = &table[next - 1];
    Some(match table.get(next) {
        Some(right) if right[0] > left[0] => {
            std::array::from_fn(|k| left[k] + (right[k] - left[k]) * (x - left[0]) / (right[0] - left[0]))
        }
        _ => *left,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_and_beyond_the_rows() {
        let table = [[1.0, 2.0, 0.0], [2.0, 4.0, 1.0], [4.0, 0.0, 1.0]];
        for (x, inside) in [(1.0, [2.0, 0.0]), (1.5, [3.0, 0.5]), (2.0, [4.0, 1.0]), (3.0, [2.0, 1.0])] {
            for outside in [Outside::Zero, Outside::Constant] {
                assert_eq!(piecewise(&table, x, outside)[1..], inside);
            }
        }
        assert_eq!(piecewise(&table, 0.9, Outside::Zero)[1..], [0.0, 0.0]);
        assert_eq!(piecewise(&table, 4.1, Outside::Zero)[1..], [0.0, 0.0]);
        assert_eq!(piecewise(&table, 0.9, Outside::Constant)[1..], [2.0, 0.0]);
        assert_eq!(piecewise(&table, 9.0, Outside::Constant)[1..], [0.0, 1.0]);
        assert_eq!(piecewise_within(&table, 4.1), None);
        // One row, none, and no number.
        assert_eq!(piecewise_within(&[[1.0, 5.0]], 1.0), Some([1.0, 5.0]));
        assert_eq!(piecewise::<2>(&[], 1.0, Outside::Constant), [0.0; 2]);
        assert!(piecewise(&table, f64::NAN, Outside::Zero)[1].is_nan());
    }
}
