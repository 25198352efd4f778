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
