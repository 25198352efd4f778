//! What versions 4 and 5 of MATLAB files share: elements, faults, the order of values.

use crate::budget::{Budget, Exceeded};
use crate::measured::array::Array;

/// Data type of a compressed element.
pub(super) const COMPRESSED: u32 = 15;
pub(super) const CUT_OFF: &str = "the file is cut off";
pub(super) const DAMAGED_SIZE: &str = "an array's size is damaged";

/// Why a file cannot be used.
#[derive(Debug)]
pub(super) enum Fault {
    Damage(&'static str),
    Budget(Exceeded),
}

impl From<&'static str> for Fault {
    fn from(problem: &'static str) -> Self {
        Self::Damage(problem)
    }
}

impl From<Exceeded> for Fault {
    fn from(exceeded: Exceeded) -> Self {
        Self::Budget(exceeded)
    }
}

/// Arrays named by their path, and the names of what is not read, each with the reason.
pub(super) type Contents = (Vec<Array>, Vec<String>);

/// Reads data elements in sequence.
pub(super) struct Reader<'a> {
    pub rest: &'a [u8],
    pub little: bool,
}

impl<'a> Reader<'a> {
    pub fn number<const N: usize>(&self, bytes: &[u8]) -> [u8; N] {
        std::array::from_fn(|k| bytes[if self.little { k } else { N - 1 - k }])
    }

    pub fn u32(&self, bytes: &[u8]) -> u32 {
        u32::from_le_bytes(self.number(bytes))
    }

    /// Type and data of the next element; data of up to four bytes are stored within its tag.
    pub fn element(&mut self) -> Result<(u32, &'a [u8]), Fault> {
        let (tag, rest) = self.rest.split_at_checked(8).ok_or(CUT_OFF)?;
        let first = self.u32(&tag[..4]);
        let small = (first >> 16) as usize;
        if small > 0 {
            self.rest = rest;
            return Ok((first & 0xffff, tag.get(4..4 + small).ok_or("an element's tag is damaged")?));
        }
        let size = self.u32(&tag[4..]) as usize;
        let (data, after) = rest.split_at_checked(size).ok_or(CUT_OFF)?;
        let padding = if first == COMPRESSED { 0 } else { size.next_multiple_of(8) - size };
        self.rest = after.get(padding..).unwrap_or_default();
        Ok((first, data))
    }

    /// Numbers of an element of any numeric type.
    pub fn numbers(&mut self, budget: &Budget) -> Result<Vec<f64>, Fault> {
        let (kind, data) = self.element()?;
        let size = match kind {
            1 | 2 | 16 => 1,
            3 | 4 | 17 => 2,
            5 | 6 | 7 | 18 => 4,
            9 | 12 | 13 => 8,
            _ => return Err("an array's data is of an unknown type".into()),
        };
        let mut values = budget.list(|| "an array".into(), data.len() / size)?;
        macro_rules! read {
            ($type:ty) => {{
                const SIZE: usize = size_of::<$type>();
                let numbers = data.chunks_exact(SIZE).map(|b| <$type>::from_le_bytes(self.number(b)) as f64);
                values.extend(numbers)
            }};
        }
        match kind {
            1 => read!(i8),
            3 => read!(i16),
            4 | 17 => read!(u16),
            5 => read!(i32),
            6 | 18 => read!(u32),
            7 => read!(f32),
            9 => read!(f64),
            12 => read!(i64),
            13 => read!(u64),
            _ => read!(u8),
        }
        Ok(values)
    }
}

/// Column-major values (first index fastest) reordered to row-major (last index fastest).
pub(crate) fn to_row_major<T: Copy>(values: &[T], shape: &[usize]) -> Vec<T> {
    reorder(values, shape, shape.iter().scan(1, |stride, n| Some(std::mem::replace(stride, *stride * n))))
}

fn reorder<T: Copy>(values: &[T], shape: &[usize], strides: impl Iterator<Item = usize>) -> Vec<T> {
    let strides: Vec<usize> = strides.collect();
    let mut index = vec![0; shape.len()];
    let mut out = Vec::with_capacity(values.len());
    while out.len() < values.len() {
        let at: usize = index.iter().zip(&strides).map(|(i, s)| i * s).sum();
        let Some(value) = values.get(at) else { break };
        out.push(*value);
        for axis in (0..shape.len()).rev() {
            index[axis] += 1;
            if index[axis] < shape[axis] {
                break;
            }
            index[axis] = 0;
        }
    }
    out
}
