//! Binary data of set 58b: extent and values.

use super::ParseError;
use super::binary::{Binary, BinaryHeader};
use super::block::{Block, CUT_OFF_HINT, is_delimiter};
use super::data_form::DataForm;

impl BinaryHeader {
    /// The data at the start of `rest`, the bytes up to the line after the closing -1, and whether that -1
    /// was found.
    ///
    /// Tries the stated byte count and the one computed from the number of values, and takes the one after
    /// which the block ends. Programs add line ends, pad with zeros or count wrongly. From `blank_from` on the rest
    /// is blank.
    pub fn locate_data<'a>(
        &self,
        block: &Block,
        rest: &'a [u8],
        blank_from: usize,
    ) -> Result<(&'a [u8], usize, bool), ParseError> {
        let layout = DataForm::of(block)?;
        let sizes = layout.binary_sizes();
        for size in [self.stated_bytes].into_iter().chain(sizes) {
            if let Some(end) = rest.get(size..).filter(|_| size > 0).and_then(end_of_delimiter) {
                return Ok((&rest[..size], size + end, true));
            }
        }
        // A file may end directly after the data.
        for size in sizes {
            if rest.len() >= size && size >= blank_from {
                return Ok((&rest[..size], rest.len(), false));
            }
        }
        // Padded, or fewer values than stated: up to the next end mark.
        let from = rest.windows(6).position(|w| w == b"    -1");
        let marks = from
            .into_iter()
            .flat_map(|first| (first..rest.len()).filter(|&at| rest[at..].starts_with(b"    -1")));
        for mark in marks {
            if let Some(end) = end_of_delimiter(&rest[mark..]) {
                return Ok((&rest[..mark], mark + end, true));
            }
        }
        let needed = sizes[0];
        Err(block.error_at(
            self.header_lines,
            format!(
                "the binary data is cut off: {} values need {needed} bytes, {} are left in the file",
                layout.count,
                rest.len()
            ),
            CUT_OFF_HINT,
        ))
    }
}

/// Most line ends and zeros between data and closing -1: programs pad to blocks of some kB.
const MAX_PADDING: usize = 65_536;
/// Longest line of a closing -1, which is padded to 80 columns.
const MAX_DELIMITER: usize = 256;

/// Start of the line after a closing -1, if only line ends and zeros precede that -1. It looks at so many bytes and no
/// further, since it is asked at every place where -1 stands.
fn end_of_delimiter(rest: &[u8]) -> Option<usize> {
    let near = &rest[..rest.len().min(MAX_PADDING)];
    let start = near.iter().position(|&b| !(b == b'\r' || b == b'\n' || b == 0))?;
    let line = &rest[start..rest.len().min(start + MAX_DELIMITER)];
    let end = match line.iter().position(|&b| b == b'\n') {
        Some(at) => start + at + 1,
        None if line.len() < MAX_DELIMITER => rest.len(),
        None => return None,
    };
    is_delimiter(&rest[start..end]).then_some(end)
}

impl Binary<'_> {
    /// The numbers of the block, including abscissae.
    ///
    /// With double-precision values the abscissa has 4 bytes by the format, 8 in files of some programs.
    pub fn numbers(&self, layout: &DataForm) -> Vec<f64> {
        let ordinate = if layout.double { 8 } else { 4 };
        let abscissa = match (layout.even, layout.double) {
            (false, true) if self.data.len() < layout.binary_sizes()[0] => 4,
            _ => ordinate,
        };
        let mut numbers = Vec::with_capacity(self.data.len() / ordinate);
        let (mut rest, mut column) = (self.data, 0);
        loop {
            let size = if column == 0 { abscissa } else { ordinate };
            let Some((bytes, after)) = rest.split_at_checked(size) else { return numbers };
            numbers.push(self.number(bytes));
            rest = after;
            column = (column + 1) % layout.width();
        }
    }
}
