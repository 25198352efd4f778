//! Archives (.npz): the checksums of changed members.

const LOCAL: &[u8] = b"PK\x03\x04";
const CENTRAL: &[u8] = b"PK\x01\x02";

pub fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(LOCAL)
}

/// Sets the CRC-32 of every stored (not compressed) member to that of its bytes, in both of its headers.
pub fn correct_checksums(bytes: &mut [u8]) {
    let places = |bytes: &[u8], mark: &[u8]| -> Vec<usize> {
        bytes.windows(4).enumerate().filter(|(_, window)| *window == mark).map(|(at, _)| at).collect()
    };
    let half = |bytes: &[u8], at: usize| Some(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?));
    let word = |bytes: &[u8], at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let mut sums: Vec<(u32, u32)> = Vec::new();
    for at in places(bytes, LOCAL) {
        let stored = half(bytes, at + 8) == Some(0);
        let sizes = (|| {
            let name = usize::from(half(bytes, at + 26)?) + usize::from(half(bytes, at + 28)?);
            Some((at + 30 + name, word(bytes, at + 18)? as usize))
        })();
        let Some(content) = sizes.and_then(|(start, size)| bytes.get(start..start.checked_add(size)?)) else {
            continue;
        };
        if stored {
            let sum = crc32fast::hash(content);
            bytes[at + 14..at + 18].copy_from_slice(&sum.to_le_bytes());
            sums.push((at as u32, sum));
        }
    }
    for at in places(bytes, CENTRAL) {
        let member = word(bytes, at + 42);
        if let Some((_, sum)) = sums.iter().find(|(start, _)| Some(*start) == member) {
            bytes[at + 16..at + 20].copy_from_slice(&sum.to_le_bytes());
        }
    }
}
