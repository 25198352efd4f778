//! NumPy files: .npy and .npz.

use crate::{bytes_refused, read_without};
use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::io::Write;

/// A .npy of version 1.
pub fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((header.len() as u16).to_le_bytes());
    out.extend(header.as_bytes());
    out.extend(data);
    out
}

/// A file of a ZIP archive.
pub struct Entry {
    name: String,
    packed: Vec<u8>,
    size: u32,
    crc: u32,
    method: u16,
}

impl Entry {
    pub fn stored(name: &str, data: &[u8]) -> Self {
        Self { packed: data.to_vec(), method: 0, ..Self::deflated(name, data) }
    }

    pub fn deflated(name: &str, data: &[u8]) -> Self {
        Self::repeated(name, data, b"", 0)
    }

    /// A compressed file of `head` and `times` the same part, which is never in memory as a whole.
    pub fn repeated(name: &str, head: &[u8], part: &[u8], times: usize) -> Self {
        let mut crc = Crc::new();
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        for piece in std::iter::once(head).chain(std::iter::repeat_n(part, times)) {
            crc.update(piece);
            encoder.write_all(piece).unwrap();
        }
        let packed = encoder.finish().unwrap();
        Self {
            name: name.into(),
            packed,
            size: (head.len() + part.len() * times) as u32,
            crc: crc.sum(),
            method: 8,
        }
    }

    /// Fields common to the header before the data and the one in the directory.
    fn fields(&self) -> Vec<u8> {
        let mut out = vec![20, 0, 0, 0];
        out.extend(self.method.to_le_bytes());
        out.extend([0, 0, 0x21, 0]);
        for field in [self.crc, self.packed.len() as u32, self.size] {
            out.extend(field.to_le_bytes());
        }
        out.extend((self.name.len() as u16).to_le_bytes());
        out.extend([0, 0]);
        out
    }
}

/// A ZIP archive.
pub fn zip(entries: &[Entry]) -> Vec<u8> {
    let places: Vec<(usize, String)> = entries.iter().map(|entry| entry.name.clone()).enumerate().collect();
    zip_at(entries, &places)
}

/// A ZIP archive whose directory has these places among the entries, with names of as many letters as theirs.
fn zip_at(entries: &[Entry], places: &[(usize, String)]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut starts = Vec::new();
    for entry in entries {
        starts.push(out.len() as u32);
        out.extend(b"PK\x03\x04");
        out.extend(entry.fields());
        out.extend(entry.name.as_bytes());
        out.extend(&entry.packed);
    }
    let directory = out.len() as u32;
    for (place, name) in places {
        out.extend(b"PK\x01\x02\x14\x00");
        out.extend(entries[*place].fields());
        out.extend([0; 10]);
        out.extend(starts[*place].to_le_bytes());
        out.extend(name.as_bytes());
    }
    let length = out.len() as u32 - directory;
    out.extend(b"PK\x05\x06\0\0\0\0");
    out.extend([(places.len() as u16).to_le_bytes(), (places.len() as u16).to_le_bytes()].concat());
    out.extend(length.to_le_bytes());
    out.extend(directory.to_le_bytes());
    out.extend([0, 0]);
    out
}

#[test]
fn counts_of_values_without_width() {
    bytes_refused("a.npy", &npy("<U0", "(9000000000000000000,)", b""), &["would need", "--read-limit"]);
    bytes_refused("a.npy", &npy("<U0", "(2000000000,)", b""), &["would need 48 GB", "--read-limit 60GB"]);
    bytes_refused("a.npy", &npy("|S0", "(2000000000,)", b""), &["would need 48 GB"]);
    bytes_refused("a.npy", &npy("|V0", "(9000000000000000000,)", b""), &["would need"]);
}

#[test]
fn counts_and_widths_that_wrap() {
    for (descr, shape) in [
        ("<U4611686018427387905", "(4,)"),
        ("<f8", "(2305843009213693953,)"),
        ("<f8", "(4294967296, 4294967296)"),
        ("<f99999999999999999999", "(1,)"),
        ("<f8", "(-1,)"),
        ("<f8", "(1e3,)"),
    ] {
        bytes_refused("a.npy", &npy(descr, shape, &[0; 64]), &["its header is damaged"]);
    }
    bytes_refused("a.npy", &npy("<f8", "(1000000000000,)", &[0; 64]), &["the file is cut off"]);
    let many = format!("({})", "1,".repeat(20_000));
    bytes_refused("a.npy", &npy("<f8", &many, &[0; 8]), &["its header is damaged"]);
}

#[test]
fn headers_that_are_no_headers() {
    let mut long = b"\x93NUMPY\x02\x00\xff\xff\xff\x7f".to_vec();
    long.extend([b' '; 100]);
    bytes_refused("a.npy", &long, &["the file is cut off"]);
    let mut code = b"\x93NUMPY\x01\x00".to_vec();
    let text = b"__import__('os').system('touch pwned')\n";
    code.extend((text.len() as u16).to_le_bytes());
    code.extend(text);
    bytes_refused("a.npy", &code, &["its header is damaged"]);
    bytes_refused("a.npy", b"\x93NUMPY", &["the file is cut off"]);
}

#[test]
fn values_of_two_in_every_dimension_are_too_many_channels() {
    let shape = format!("({})", "2,".repeat(21));
    let bytes = npy("|u1", &shape, &vec![1; 1 << 21]);
    bytes_refused("a.npy", &bytes, &["it would need 1048576 channels or more", "--read-limit"]);
}

#[test]
fn archive_that_inflates_a_thousandfold() {
    let entry = Entry::deflated("a.npy", &npy("|u1", "(1000000000,)", &vec![0; 1_000_000]));
    // The same packed zeros again and again: 1 MB that becomes 1 GB.
    let once = Entry { packed: entry.packed.repeat(1000), size: 1_000_000_000, ..entry };
    bytes_refused("a.npz", &zip(&[once]), &["`a` would need", "more than the", "--read-limit"]);
    // A size that is not the stated one.
    let mut small = Entry::deflated("a.npy", &npy("|u1", "(3000000,)", &vec![0; 3_000_000]));
    small.size = 100;
    bytes_refused("a.npz", &zip(&[small]), &["`a`:"]);
}

#[test]
fn files_that_share_their_bytes() {
    let entry = Entry::deflated("000.npy", &npy("<f8", "(100000,)", &vec![0; 800_000]));
    let places: Vec<(usize, String)> = (0..500).map(|k| (0, format!("{k:03}.npy"))).collect();
    bytes_refused("a.npz", &zip_at(&[entry], &places), &["overlap"]);
    let entries = [
        Entry::deflated("a.npy", &npy("<f8", "(100000,)", &vec![0; 800_000])),
        Entry::deflated("b.npy", &npy("<f8", "(100000,)", &vec![0; 800_000])),
    ];
    let mut bytes = zip(&entries);
    // The second header in the directory refers to the data of the first.
    let at = bytes.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap() + 42;
    bytes[at..at + 4].copy_from_slice(&[0; 4]);
    bytes_refused("a.npz", &bytes, &["overlap"]);
}

#[test]
fn wrong_checksums() {
    let data = npy("<f8", "(1000,)", &[7; 8000]);
    for entry in [Entry::stored("a.npy", &data), Entry::deflated("a.npy", &data)] {
        let bytes = zip(&[entry]);
        // In the header before the data, in the directory, and by the data.
        let directory = bytes.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap();
        for at in [14, directory + 16] {
            let mut wrong = bytes.clone();
            wrong[at] ^= 1;
            bytes_refused("a.npz", &wrong, &["`a`: its checksum (CRC) does not fit"]);
        }
    }
    let mut wrong = zip(&[Entry::stored("a.npy", &data)]);
    wrong[4000] ^= 1;
    bytes_refused("a.npz", &wrong, &["its checksum (CRC) does not fit"]);
}

#[test]
fn members_that_are_no_arrays_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let samples: Vec<u8> = (0..4096).flat_map(|k| f64::from(k).sin().to_le_bytes()).collect();
    let entries = [
        Entry::stored("fs.npy", &npy("<f8", "()", &1000.0_f64.to_le_bytes())),
        Entry::stored("wave.npy", &npy("<f8", "(4096,)", &samples)),
        Entry::stored("notes.txt", b"a text"),
    ];
    std::fs::write(&path, zip(&entries)).unwrap();
    read_without(&path, &["not read: notes.txt"]);
}
