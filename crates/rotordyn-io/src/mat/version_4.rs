//! MATLAB v4 .mat files: numeric and text matrices, one after the other, each with a header of five numbers.
//!
//! Type (byte order, number format, class), rows, columns, whether complex, length of the name. Format: MATLAB MAT-File
//! Format, The MathWorks, R2019b, "Version 4".

use super::elements::{Contents, DAMAGED_SIZE, Fault, Reader, to_row_major};
use crate::budget::Budget;
use crate::measured::arrays::{Array, Data};
use rotordyn_signal::Complex;

const HEADER: usize = 20;
const CUT_OFF: &str = "the file is cut off";
/// Longest name that counts as one; of 19 letters in MATLAB 4, of 63 today.
const MAX_NAME: usize = 64;

/// What the header of a matrix states.
struct Header {
    little: bool,
    /// 0 double, 1 single, 2 and 3 integers of 32 and 16 bits, 4 unsigned 16 bits, 5 unsigned 8 bits.
    format: u32,
    /// 0 numbers, 1 text, 2 sparse.
    class: u32,
    rows: usize,
    columns: usize,
    complex: bool,
    name_length: usize,
}

/// Whether a file starts with a matrix: its header is in range, and a name of letters follows.
pub(super) fn is_array(head: &[u8]) -> bool {
    let Some(header) = header(head) else { return false };
    let name = head.get(HEADER..HEADER + header.name_length.min(head.len()));
    let Some((&0, letters)) = name.and_then(|name| name.split_last()) else { return false };
    letters.first().is_some_and(u8::is_ascii_alphabetic)
        && letters.iter().all(|c| c.is_ascii_alphanumeric() || *c == b'_')
}

fn header(bytes: &[u8]) -> Option<Header> {
    let fields = bytes.get(..HEADER)?;
    let read = |little: bool| -> [u32; 5] {
        let reader = Reader { rest: &[], little };
        std::array::from_fn(|k| reader.u32(&fields[4 * k..4 * k + 4]))
    };
    // The type has at most four decimal digits: in the wrong byte order it is larger, or the zero of both.
    let little = read(true)[0] <= 9999;
    let [kind, rows, columns, complex, name_length] = read(little);
    let (machine, format, class) = (kind / 1000, kind / 10 % 10, kind % 10);
    let known = machine == u32::from(!little) && kind / 100 % 10 == 0 && format <= 5 && class <= 2;
    let sound = known && complex <= 1 && (2..=MAX_NAME as u32).contains(&name_length);
    sound.then_some(Header {
        little,
        format,
        class,
        rows: rows as usize,
        columns: columns as usize,
        complex: complex == 1,
        name_length: name_length as usize,
    })
}

/// Every matrix of a file.
pub(super) fn parse(mut bytes: &[u8], budget: &Budget) -> Result<Contents, Fault> {
    let mut found = Contents::default();
    while !bytes.is_empty() {
        budget.objects("arrays", 1)?;
        let header = header(bytes).ok_or("the header of a version 4 array is damaged")?;
        let Header { format, rows, columns, .. } = header;
        let (name, rest) = bytes[HEADER..].split_at_checked(header.name_length).ok_or(CUT_OFF)?;
        let name = String::from_utf8_lossy(name).trim_end_matches('\0').to_owned();
        let size = [8, 4, 4, 2, 2, 1][format as usize];
        let count = rows.checked_mul(columns).ok_or(DAMAGED_SIZE)?;
        let bytes_of_part = count.checked_mul(size).ok_or(DAMAGED_SIZE)?;
        let (re, rest) = rest.split_at_checked(bytes_of_part).ok_or(CUT_OFF)?;
        let (im, rest) =
            if header.complex { rest.split_at_checked(bytes_of_part).ok_or(CUT_OFF)? } else { (re, rest) };
        bytes = rest;
        if header.class == 2 {
            found.1.push(format!("{name} (a sparse matrix)"));
            continue;
        }
        let shape = vec![rows, columns];
        let re = values(re, &header, budget)?;
        let data = match (header.class, header.complex) {
            (1, _) => {
                let letter = |code: &f64| char::from_u32(*code as u32).unwrap_or('?');
                let row = |k: usize| re.iter().skip(k).step_by(rows).map(letter).collect::<String>();
                let texts: Vec<String> = (0..if count == 0 { 0 } else { rows })
                    .map(|k| row(k).trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned())
                    .collect();
                found.0.push(Array { name, shape: vec![texts.len()], data: Data::Text(texts) });
                continue;
            }
            (_, false) => Data::Real(to_row_major(&re, &shape)),
            (_, true) => {
                let im = values(im, &header, budget)?;
                let pairs: Vec<_> = re.iter().zip(&im).map(|(&re, &im)| Complex::new(re, im)).collect();
                Data::Complex(to_row_major(&pairs, &shape))
            }
        };
        found.0.push(Array { name, shape, data });
    }
    Ok(found)
}

/// Numbers of a part of a matrix, in columns.
fn values(bytes: &[u8], header: &Header, budget: &Budget) -> Result<Vec<f64>, Fault> {
    let reader = Reader { rest: &[], little: header.little };
    let size = [8, 4, 4, 2, 2, 1][header.format as usize];
    let mut out = budget.list(|| "an array".into(), bytes.len() / size)?;
    let number = |b: &[u8]| match header.format {
        0 => f64::from_le_bytes(reader.number(b)),
        1 => f64::from(f32::from_le_bytes(reader.number(b))),
        2 => f64::from(i32::from_le_bytes(reader.number(b))),
        3 => f64::from(i16::from_le_bytes(reader.number(b))),
        4 => f64::from(u16::from_le_bytes(reader.number(b))),
        _ => f64::from(b[0]),
    };
    out.extend(bytes.chunks_exact(size).map(number));
    Ok(out)
}
