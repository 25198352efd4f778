//! WAV files.

use crate::bytes_refused;

/// RIFF header, chunks before the format, format (PCM) and the size that the data chunk states.
fn wav(before: &[u8], channels: u16, rate: u32, size: u32, data: &[u8]) -> Vec<u8> {
    let block = 2 * channels;
    let mut out = b"RIFF\xff\xff\xff\xffWAVE".to_vec();
    out.extend(before);
    out.extend(b"fmt \x10\0\0\0\x01\0");
    out.extend(channels.to_le_bytes());
    out.extend(rate.to_le_bytes());
    out.extend(rate.wrapping_mul(block.into()).to_le_bytes());
    out.extend(block.to_le_bytes());
    out.extend(16_u16.to_le_bytes());
    out.extend(b"data");
    out.extend(size.to_le_bytes());
    out.extend(data);
    out
}

#[test]
fn data_of_any_size() {
    bytes_refused("a.wav", &wav(b"", 1, 8000, u32::MAX - 1, &[0; 1000]), &["cut off"]);
    bytes_refused("a.wav", &wav(b"", 2, 8000, u32::MAX - 3, b""), &["cut off"]);
    bytes_refused("a.wav", &wav(b"", 1, 8000, 0, b""), &["cut off"]);
    bytes_refused("a.wav", &wav(b"", 0, 8000, 100, &[0; 100]), &["a.wav: "]);
    bytes_refused("a.wav", &wav(b"", 1, 0, 100, &[0; 100]), &["the sampling rate is 0 Hz"]);
    bytes_refused("a.wav", &wav(b"", 32_767, 1, 65_534, &[0; 65_534]), &["at least 2"]);
}

#[test]
fn chunks_without_end() {
    let empty = b"junk\0\0\0\0".repeat(250_000);
    bytes_refused("a.wav", &wav(&empty, 1, 8000, 10, b""), &["cut off"]);
    bytes_refused("a.wav", &wav(b"junk\xff\xff\xff\xff", 1, 8000, 10, &[0; 10]), &["a.wav: "]);
    bytes_refused("a.wav", b"RIFF\0\0\0\0WAVE", &["a.wav: "]);
}

/// The format chunk of a file, and an RF64 file that states any size.
#[test]
fn formats_and_long_sizes_that_lie() {
    let with = |code: u16, block: u16, bits: u16| {
        let mut out = b"RIFF\xff\xff\xff\xffWAVEfmt \x10\0\0\0".to_vec();
        out.extend([code, 1, 8000, 0, 0, 0, block, bits].iter().flat_map(|n| n.to_le_bytes()));
        out.extend(b"data\x08\0\0\0\0\0\0\0\0\0\0\0");
        out
    };
    bytes_refused("a.wav", &with(3, 2, 16), &["floats of 16 bits in 2 bytes"]);
    bytes_refused("a.wav", &with(1, 5, 40), &["integers of 40 bits in 5 bytes"]);
    bytes_refused("a.wav", &with(1, 2, 64), &["integers of 64 bits in 2 bytes"]);
    bytes_refused("a.wav", &with(1, 0, 0), &["integers of 0 bits"]);
    bytes_refused("a.wav", &with(6, 1, 8), &["A-law"]);
    bytes_refused("a.wav", &with(0xfffe, 2, 16), &["damaged"]);
    let mut long = b"RF64\xff\xff\xff\xffWAVEds64\x18\0\0\0".to_vec();
    long.extend([0xff; 24]);
    long.extend(&wav(b"", 1, 8000, u32::MAX, &[0; 100])[12..]);
    bytes_refused("a.wav", &long, &["cut off"]);
    let named = wav(&b"abcd\0\0\0\0".repeat(100_000), 1, 8000, 0, b"");
    bytes_refused("a.wav", &named, &["cut off"]);
}
