//! MATLAB files of version 5.

use crate::bytes_refused;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

fn header() -> Vec<u8> {
    let mut out = vec![b' '; 124];
    out.extend([0, 1, b'I', b'M']);
    out
}

fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut out = [kind.to_le_bytes(), (data.len() as u32).to_le_bytes()].concat();
    out.extend(data);
    out.resize(out.len().next_multiple_of(8), 0);
    out
}

/// Flags, dimensions, name and further elements of an array.
fn array(class: u32, dimensions: &[u8], rest: &[Vec<u8>]) -> Vec<u8> {
    let mut body = element(6, &[class.to_le_bytes(), [0; 4]].concat());
    body.extend(dimensions);
    body.extend(element(1, b"a"));
    body.extend(rest.concat());
    element(14, &body)
}

fn sizes(sizes: &[u32]) -> Vec<u8> {
    element(6, &sizes.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>())
}

fn zlib(data: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(data).unwrap();
    encoder.finish().unwrap()
}

fn refused(elements: &[u8], parts: &[&str]) {
    bytes_refused("a.mat", &[header(), elements.to_vec()].concat(), parts);
}

#[test]
fn texts_of_more_rows_than_letters() {
    let fewer = "a text has fewer characters than its size states";
    refused(&array(4, &sizes(&[1 << 31, 1]), &[element(16, b"a")]), &[fewer]);
    refused(&array(4, &sizes(&[u32::MAX, 1]), &[element(4, b"ab")]), &[fewer]);
    refused(
        &array(4, &sizes(&[1 << 31, 1 << 31, 1 << 31]), &[element(16, b"a")]),
        &["an array's size is damaged"],
    );
}

#[test]
fn sizes_that_no_array_has() {
    let values = element(9, &[0; 16]);
    let damaged = "an array's size is damaged";
    let negative = element(5, &[(-1_i32).to_le_bytes(), 2_i32.to_le_bytes()].concat());
    refused(&array(6, &negative, std::slice::from_ref(&values)), &[damaged]);
    let nan = element(9, &[f64::INFINITY.to_le_bytes(), f64::INFINITY.to_le_bytes()].concat());
    refused(&array(6, &nan, std::slice::from_ref(&values)), &[damaged]);
    refused(&array(6, &sizes(&[1; 100_000]), &[element(9, &[0; 8])]), &[damaged]);
    refused(&array(6, &sizes(&[u32::MAX, u32::MAX]), &[values]), &["fewer values than its size states"]);
    refused(&[14, 0, 0, 0, 0xff, 0xff, 0xff, 0xff], &["the file is cut off"]);
}

#[test]
fn compressed_arrays_that_grow() {
    // The tag states a gigabyte.
    let mut inner = [14_u32.to_le_bytes(), 1_000_000_000_u32.to_le_bytes()].concat();
    inner.resize(1_000_000, 0);
    refused(&element(15, &zlib(&inner)), &["a compressed array would need", "--read-limit"]);
    // The tag states little, and more follows.
    let mut inner = [14_u32.to_le_bytes(), 100_u32.to_le_bytes()].concat();
    inner.resize(10_000_000, 0);
    refused(&element(15, &zlib(&inner)), &["a compressed array is damaged"]);
    // A checksum that does not fit.
    let mut packed = zlib(&array(6, &sizes(&[1, 2]), &[element(9, &[0; 16])]));
    *packed.last_mut().unwrap() ^= 1;
    refused(&element(15, &packed), &["a compressed array is damaged"]);
    // Compressed again and again.
    let nested = (0..50).fold(Vec::new(), |inner, _| element(15, &zlib(&inner)));
    refused(&nested, &["a compressed element contains no array"]);
}

#[test]
fn structures_within_each_other() {
    let mut inner = array(6, &sizes(&[1, 1]), &[element(9, &[0; 8])]);
    for _ in 0..2000 {
        let names = [element(5, &[8, 0, 0, 0]), element(1, b"a\0\0\0\0\0\0\0")].concat();
        inner = array(2, &sizes(&[1, 1]), &[names, inner]);
    }
    refused(&inner, &["a.mat: "]);
}

/// A field name of 50 kB for every element, of which a tag of 8 bytes is there.
#[test]
fn a_long_field_name_of_many_elements() {
    let length = 50_000_u32;
    let mut letters = vec![b'f'; length as usize];
    letters[length as usize - 1] = 0;
    let names = [element(5, &length.to_le_bytes()), element(1, &letters)].concat();
    let elements = element(14, b"").repeat(50_000);
    refused(
        &array(2, &sizes(&[1, 50_000]), &[names, elements]),
        &["the names of structures and cells would need", "--read-limit"],
    );
}

#[test]
fn cells_and_structures_of_any_size() {
    refused(&array(1, &sizes(&[u32::MAX, u32::MAX]), &[]), &["a.mat: "]);
    refused(&array(1, &sizes(&[1 << 31, 1]), &[element(14, b"")]), &["the file is cut off"]);
    let names = [element(5, &4_u32.to_le_bytes()), element(1, &b"abc\0".repeat(200_000))].concat();
    refused(&array(2, &sizes(&[1, 1]), &[names]), &["it would need 200001 fields or more"]);
    let odd = [element(5, &3_u32.to_le_bytes()), element(1, b"abcd")].concat();
    refused(&array(2, &sizes(&[1, 1]), &[odd]), &["the names of a structure's fields are damaged"]);
}

/// Version 4: sizes are in every header.
#[test]
fn headers_of_version_4() {
    let matrix = |kind: u32, rows: u32, columns: u32, data: &[u8]| {
        let mut out: Vec<u8> = [kind, rows, columns, 0, 2].iter().flat_map(|n| n.to_le_bytes()).collect();
        out.extend(b"a\0");
        out.extend(data);
        out
    };
    let refused = |bytes: &[u8], parts: &[&str]| bytes_refused("a.mat", bytes, parts);
    refused(&matrix(0, u32::MAX, u32::MAX, &[0; 16]), &["a.mat: "]);
    refused(&matrix(0, 1 << 20, 1 << 20, &[0; 16]), &["the file is cut off"]);
    refused(&matrix(51, 1 << 31, 0, b""), &["contains no channel"]);
    refused(
        &[matrix(0, 1, 1, &[0; 8]), vec![1; 19]].concat(),
        &["the header of a version 4 array is damaged"],
    );
    refused(&matrix(0, 0, 0, b"").repeat(200_000), &["arrays or more"]);
}
