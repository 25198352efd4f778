//! Changes of single bits, bytes and binary numbers.

use fastrand::Rng;

pub fn flip_bit(rng: &mut Rng, input: &mut [u8]) {
    if !input.is_empty() {
        input[rng.usize(0..input.len())] ^= 1 << rng.u8(0..8);
    }
}

pub fn set_byte(rng: &mut Rng, input: &mut [u8]) {
    if !input.is_empty() {
        let value = match rng.u8(0..3) {
            0 => rng.u8(..),
            1 => *rng.choice(&[0, 1, 0x7f, 0x80, 0xff]).unwrap_or(&0),
            _ => *rng.choice(b"\0\n\r\t ,;-+.eE\"'[]{}=#").unwrap_or(&0),
        };
        input[rng.usize(0..input.len())] = value;
    }
}

/// Adds to or replaces an integer of 1, 2, 4 or 8 bytes in either byte order.
pub fn edit_integer(rng: &mut Rng, input: &mut [u8]) {
    let width = 1 << rng.u32(0..4);
    if input.len() < width {
        return;
    }
    let length = input.len() as u64;
    // Numbers of file formats mostly lie on a multiple of their width.
    let mut start = rng.usize(0..=input.len() - width);
    if rng.u8(0..4) > 0 {
        start -= start % width;
    }
    let place = &mut input[start..start + width];
    let big_endian = rng.bool();
    if big_endian {
        place.reverse();
    }
    let mut bytes = [0; 8];
    bytes[..width].copy_from_slice(place);
    let value = u64::from_le_bytes(bytes);
    let ones = u64::MAX >> (64 - 8 * width);
    let new = match rng.u8(0..5) {
        0 | 1 => value.wrapping_add(rng.u64(1..36)),
        2 => value.wrapping_sub(rng.u64(1..36)),
        3 => value.wrapping_mul(*rng.choice(&[2, 8, 256, 1 << 16, 1 << 20]).unwrap_or(&2)),
        _ => {
            let extremes = [
                0,
                1,
                ones,
                ones - 1,
                ones >> 1,
                (ones >> 1) + 1,
                1 << 28,
                1 << 31,
                (1 << 32) - 1,
                1 << 40,
                1 << 61,
                length,
                length + 1,
                length.saturating_sub(1),
                length / 2,
            ];
            *rng.choice(&extremes).unwrap_or(&0)
        }
    };
    place.copy_from_slice(&new.to_le_bytes()[..width]);
    if big_endian {
        place.reverse();
    }
}

/// Replaces four or eight bytes by a floating-point number at the end of its range.
pub fn set_float(rng: &mut Rng, input: &mut [u8]) {
    let extremes = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        -1.0,
        1e300,
        f64::MIN_POSITIVE / 4.0,
        1e-300,
        f64::MAX,
        9.3e18,
        1e10,
        0.5,
    ];
    let value = *rng.choice(&extremes).unwrap_or(&0.0);
    let mut bytes = match rng.bool() {
        true => value.to_le_bytes().to_vec(),
        false => (value as f32).to_le_bytes().to_vec(),
    };
    if rng.u8(0..4) == 0 {
        bytes.reverse();
    }
    if input.len() >= bytes.len() {
        let mut start = rng.usize(0..=input.len() - bytes.len());
        if rng.u8(0..4) > 0 {
            start -= start % 4;
        }
        input[start..start + bytes.len()].copy_from_slice(&bytes);
    }
}
