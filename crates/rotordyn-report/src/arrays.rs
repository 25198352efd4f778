//! Numbers packed into the page: one block of bytes with a place for every array.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde_json::{Value, json};
use std::io::Write;

/// Arrays with more values are stored in single precision: seven digits, of which the page shows five.
const DOUBLE_UP_TO: usize = 4096;

/// Arrays of a page.
#[derive(Debug, Default)]
pub(crate) struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    /// Adds an array; the JSON names its place, number of values and type.
    ///
    /// Bytes of equal significance stand together, which compresses better: all first bytes, then all second ones.
    pub fn add(&mut self, values: &[f64]) -> Value {
        let offset = self.bytes.len();
        let name = if values.len() > DOUBLE_UP_TO {
            let single: Vec<[u8; 4]> = values.iter().map(|v| (*v as f32).to_le_bytes()).collect();
            self.push(&single);
            "f4"
        } else {
            let double: Vec<[u8; 8]> = values.iter().map(|v| v.to_le_bytes()).collect();
            self.push(&double);
            "f8"
        };
        json!({ "offset": offset, "count": values.len(), "type": name })
    }

    fn push<const N: usize>(&mut self, values: &[[u8; N]]) {
        for byte in 0..N {
            self.bytes.extend(values.iter().map(|value| value[byte]));
        }
    }

    /// Head and arrays as one compressed block: length of the head as u32 in little-endian order, head, arrays.
    pub fn packed(&self, head: &Value) -> std::io::Result<Vec<u8>> {
        let head = head.to_string();
        let length = u32::try_from(head.len())
            .map_err(|_| std::io::Error::other("the texts of the page exceed 4 GB"))?;
        let mut out = ZlibEncoder::new(Vec::new(), Compression::new(6));
        out.write_all(&length.to_le_bytes())?;
        out.write_all(head.as_bytes())?;
        out.write_all(&self.bytes)?;
        out.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    /// The reading half, as in the page's script.
    fn unpacked(packed: &[u8]) -> (Value, Vec<u8>) {
        let mut bytes = Vec::new();
        ZlibDecoder::new(packed).read_to_end(&mut bytes).unwrap();
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        (serde_json::from_slice(&bytes[4..4 + length]).unwrap(), bytes[4 + length..].to_vec())
    }

    #[test]
    fn arrays_come_back() {
        let mut arrays = Arrays::default();
        let short = [1.5, f64::NAN, -2e-300, f64::INFINITY];
        let long: Vec<f64> = (0..5000).map(|k| 0.1 * f64::from(k)).collect();
        let places = [arrays.add(&short), arrays.add(&long)];
        let (head, bytes) = unpacked(&arrays.packed(&json!({ "places": places })).unwrap());
        let value = |place: &Value, k: usize| {
            let (offset, count) = (place["offset"].as_u64().unwrap(), place["count"].as_u64().unwrap());
            let byte = |b: usize| bytes[offset as usize + b * count as usize + k];
            match place["type"].as_str().unwrap() {
                "f8" => f64::from_le_bytes(std::array::from_fn(byte)),
                _ => f64::from(f32::from_le_bytes(std::array::from_fn(byte))),
            }
        };
        for (k, x) in short.iter().enumerate() {
            assert_eq!(value(&head["places"][0], k).to_bits(), x.to_bits());
        }
        for (k, x) in long.iter().enumerate() {
            // Half a unit of the last place of single precision.
            assert!((value(&head["places"][1], k) - x).abs() <= 6e-8 * x);
        }
    }
}
