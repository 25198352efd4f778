//! Binary data of set 58b: header and byte format.

use super::ParseError;
use crate::error::snippet;

/// First line of a 58b.
pub(super) struct BinaryHeader {
    little_endian: bool,
    /// Lines of text before the data.
    pub header_lines: usize,
    /// Stated byte count of the data; wrong in the files of some programs.
    pub stated_bytes: usize,
}

/// Binary data of a block.
pub(super) struct Binary<'a> {
    pub header: BinaryHeader,
    pub data: &'a [u8],
}

impl BinaryHeader {
    /// Reads byte order, float format, header lines and byte count, `(I6,I6,I12,I12)`, after `58b`.
    pub fn of_header(fields: &str, line: usize) -> Result<BinaryHeader, ParseError> {
        let values: Vec<usize> = fields.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let fault = |problem: String, advice: &str| ParseError { line, problem, advice: advice.into() };
        let [order, format, header_lines, stated, ..] = values[..] else {
            let problem = format!("the header of binary set 58b is `{}`", snippet(fields.trim()));
            return Err(fault(problem, "export the file again, as ASCII if necessary"));
        };
        if format != 2 {
            let problem = format!("binary floats of format {format} (1 is DEC, 3 is IBM) are not read");
            return Err(fault(problem, "export the file with IEEE 754 floats (format 2), or as ASCII"));
        }
        if !matches!(order, 1 | 2) {
            let problem = format!("byte order {order} is neither 1 (little endian) nor 2 (big endian)");
            return Err(fault(problem, "export the file again, as ASCII if necessary"));
        }
        Ok(BinaryHeader { little_endian: order == 1, header_lines, stated_bytes: stated })
    }
}

impl Binary<'_> {
    /// The number of `bytes` in the block's byte order.
    pub fn number(&self, bytes: &[u8]) -> f64 {
        let ordered = |k: usize| bytes[if self.header.little_endian { k } else { bytes.len() - 1 - k }];
        match bytes.len() {
            4 => f64::from(f32::from_le_bytes(std::array::from_fn(ordered))),
            _ => f64::from_le_bytes(std::array::from_fn(ordered)),
        }
    }
}
