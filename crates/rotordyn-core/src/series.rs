//! Numbers in order, in memory or read from where they are stored.

use serde::de::Deserializer;
use serde::ser::{Error as _, Serializer};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Numbers of a block: 256 kB.
const BLOCK: usize = 32_768;

/// Numbers that are read in parts, such as a data set of a file.
pub trait SeriesSource: Send + Sync {
    /// How many there are.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Those of a range within the length.
    ///
    /// # Errors
    /// The source cannot be read.
    fn read(&self, range: Range<usize>) -> Result<Vec<f64>, SeriesError>;
}

/// Stored numbers that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("read {place}: {reason}")]
pub struct SeriesError {
    /// Where they are stored, a file with the name in it.
    pub place: String,
    pub reason: String,
}

/// What becomes of numbers that were computed: left in memory, or stored elsewhere.
pub type Keep<'a> = &'a mut dyn FnMut(Vec<f64>) -> Result<Series, SeriesError>;

/// Numbers in order: samples of a channel, in memory or in a file of which parts are read.
///
/// Cloning copies no numbers. Serialised, it holds all numbers.
#[derive(Clone)]
pub struct Series(Place);

#[derive(Clone)]
enum Place {
    Memory(Arc<Vec<f64>>),
    Stored(Arc<dyn SeriesSource>),
}

impl Series {
    /// Numbers that stay where they are stored.
    pub fn stored(source: impl SeriesSource + 'static) -> Self {
        Self(Place::Stored(Arc::new(source)))
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        match &self.0 {
            Place::Memory(values) => values.len(),
            Place::Stored(source) => source.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All values, if they are in memory.
    pub fn in_memory(&self) -> Option<&[f64]> {
        match &self.0 {
            Place::Memory(values) => Some(values),
            Place::Stored(_) => None,
        }
    }

    /// The values of a range; those beyond the end are left out.
    ///
    /// # Errors
    /// The numbers are stored and cannot be read.
    pub fn read(&self, range: Range<usize>) -> Result<Cow<'_, [f64]>, SeriesError> {
        let end = range.end.min(self.len());
        let range = range.start.min(end)..end;
        match &self.0 {
            Place::Memory(values) => Ok(Cow::Borrowed(&values[range])),
            Place::Stored(source) => source.read(range).map(Cow::Owned),
        }
    }

    /// All values.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn all(&self) -> Result<Cow<'_, [f64]>, SeriesError> {
        self.read(0..self.len())
    }

    /// The values in blocks, one after another.
    pub fn blocks(&self) -> impl Iterator<Item = Result<Cow<'_, [f64]>, SeriesError>> {
        (0..self.len()).step_by(BLOCK).map(|first| self.read(first..first + BLOCK))
    }

    /// The value at a place; `None` beyond the end.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn at(&self, index: usize) -> Result<Option<f64>, SeriesError> {
        if index >= self.len() {
            return Ok(None);
        }
        Ok(self.read(index..index + 1)?.first().copied())
    }

    /// The first and the last value; `None` without values.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn ends(&self) -> Result<Option<[f64; 2]>, SeriesError> {
        let Some(first) = self.at(0)? else { return Ok(None) };
        Ok(self.at(self.len() - 1)?.map(|last| [first, last]))
    }

    /// Fold over all values in their order, block by block.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn fold<T>(&self, start: T, mut step: impl FnMut(T, f64) -> T) -> Result<T, SeriesError> {
        self.blocks().try_fold(start, |seen, block| Ok(block?.iter().copied().fold(seen, &mut step)))
    }

    /// A function of every value, computed when it is read.
    pub fn mapped(&self, function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::stored(Mapped { values: self.clone(), function })
    }

    /// Every value times a factor, computed when it is read.
    pub fn scaled(&self, factor: f64) -> Self {
        self.mapped(move |value| value * factor)
    }

    /// Adds a value to those in memory; stored ones do not grow.
    pub(crate) fn push(&mut self, value: f64) {
        match &mut self.0 {
            Place::Memory(values) => Arc::make_mut(values).push(value),
            Place::Stored(_) => debug_assert!(false, "a stored series does not grow"),
        }
    }
}

impl Default for Series {
    fn default() -> Self {
        Self(Place::Memory(Arc::default()))
    }
}

impl From<Vec<f64>> for Series {
    fn from(values: Vec<f64>) -> Self {
        Self(Place::Memory(Arc::new(values)))
    }
}

impl FromIterator<f64> for Series {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        Self::from(values.into_iter().collect::<Vec<_>>())
    }
}

impl fmt::Debug for Series {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Place::Memory(values) => values.fmt(f),
            Place::Stored(source) => write!(f, "{} stored values", source.len()),
        }
    }
}

/// Equal numbers, wherever they are; numbers that cannot be read equal nothing.
impl PartialEq for Series {
    fn eq(&self, other: &Self) -> bool {
        let mut blocks = self.blocks().zip(other.blocks());
        self.len() == other.len() && blocks.all(|pair| matches!(pair, (Ok(a), Ok(b)) if a == b))
    }
}

impl Serialize for Series {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.all().map_err(S::Error::custom)?.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Series {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::from)
    }
}

struct Mapped<F> {
    values: Series,
    function: F,
}

impl<F: Fn(f64) -> f64 + Send + Sync> SeriesSource for Mapped<F> {
    fn len(&self) -> usize {
        self.values.len()
    }

    fn read(&self, range: Range<usize>) -> Result<Vec<f64>, SeriesError> {
        Ok(self.values.read(range)?.iter().map(|v| (self.function)(*v)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3 ... of which the thousandth block cannot be read.
    struct Counted(usize, Option<usize>);

    impl SeriesSource for Counted {
        fn len(&self) -> usize {
            self.0
        }

        fn read(&self, range: Range<usize>) -> Result<Vec<f64>, SeriesError> {
            assert!(range.end <= self.0, "a range within the length");
            match self.1 {
                Some(broken) if range.contains(&broken) => {
                    Err(SeriesError { place: "counted".into(), reason: "broken".into() })
                }
                _ => Ok(range.map(|k| 1.0 + k as f64).collect()),
            }
        }
    }

    #[test]
    fn stored_numbers_are_those_in_memory() {
        let count = 2 * BLOCK + 17;
        let stored = Series::stored(Counted(count, None));
        let memory: Series = (1..=count).map(|k| k as f64).collect();
        assert_eq!(stored, memory);
        assert_ne!(stored, Series::stored(Counted(count - 1, None)));
        assert_eq!(stored.ends().unwrap(), Some([1.0, count as f64]));
        assert_eq!(stored.read(3..5).unwrap(), memory.read(3..5).unwrap());
        assert_eq!(stored.read(count - 1..count + 9).unwrap().len(), 1);
        assert_eq!((stored.at(count).unwrap(), Series::default().ends().unwrap()), (None, None));
        // n (n + 1)/2, exact in f64.
        let sum = stored.fold(0.0, |sum, v| sum + v).unwrap();
        assert_eq!(sum, (count * (count + 1) / 2) as f64);
        assert_eq!(stored.scaled(2.0).at(4).unwrap(), Some(10.0));
    }

    #[test]
    fn numbers_that_cannot_be_read_are_an_error() {
        let broken = Series::stored(Counted(3 * BLOCK, Some(BLOCK + 1)));
        assert!(broken.all().is_err() && broken.scaled(2.0).fold(0.0, f64::max).is_err());
        assert!(broken.read(0..BLOCK).is_ok() && broken != broken.clone());
        assert_eq!(broken.all().unwrap_err().to_string(), "read counted: broken");
    }
}
