//! Fixed-column (Fortran) fields: tolerant reading, exact writing.

/// Splits a line into columns of the given widths; missing columns of a short line are empty.
pub(super) fn columns<const N: usize>(line: &str, widths: [usize; N]) -> [String; N] {
    let mut letters = line.chars();
    widths.map(|width| letters.by_ref().take(width).collect::<String>().trim().to_owned())
}

/// Numbers of a line, also without separating blanks (`1.0E+00-2.0E+00`), with Fortran exponents (`1.0D-3`,
/// `1.0-100`).
///
/// Asterisks, the Fortran sign of field overflow, are NaN. Error: the word that is not a number.
pub(super) fn numbers(line: &str) -> Result<Vec<f64>, String> {
    let mut found = Vec::new();
    let mut rest = line.trim_start();
    while !rest.is_empty() {
        let length = number_length(rest.as_bytes());
        if length > 0 {
            let (text, after) = rest.split_at(length);
            found.push(parse(text).ok_or(text)?);
            rest = after.trim_start();
            continue;
        }
        let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        found.push(match word.trim_start_matches(['-', '+']).to_ascii_lowercase().as_str() {
            "nan" => f64::NAN,
            "inf" | "infinity" if word.starts_with('-') => f64::NEG_INFINITY,
            "inf" | "infinity" => f64::INFINITY,
            stars if !stars.is_empty() && stars.bytes().all(|b| b == b'*') => f64::NAN,
            _ => return Err(word.to_owned()),
        });
        rest = after.trim_start();
    }
    Ok(found)
}

/// Length \[bytes\] of the number at the start of a text; 0 if there is none.
fn number_length(text: &[u8]) -> usize {
    let digits = |from: usize| text[from.min(text.len())..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(text.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    let whole = digits(end);
    end += whole;
    let point = text.get(end) == Some(&b'.');
    let fraction = if point { digits(end + 1) } else { 0 };
    end += usize::from(point) + fraction;
    if whole + fraction == 0 {
        return 0;
    }
    match text.get(end) {
        Some(b'E' | b'e' | b'D' | b'd') => {
            let exponent = digits(end + 1 + sign(end + 1));
            if exponent > 0 { end + 1 + sign(end + 1) + exponent } else { end }
        }
        // A three-digit exponent drops its letter: 1.00000-100. A following number has its own decimal point.
        Some(b'+' | b'-') if point && digits(end + 1) == 3 && text.get(end + 4) != Some(&b'.') => end + 4,
        _ => end,
    }
}

fn parse(text: &str) -> Option<f64> {
    if let Ok(number) = text.parse() {
        return Some(number);
    }
    let lettered = text.replace(['D', 'd'], "E");
    lettered.parse().ok().or_else(|| {
        let at = text.rfind(['+', '-']).filter(|&at| at > 0)?;
        format!("{}E{}", &text[..at], &text[at..]).parse().ok()
    })
}

/// `value` with `digits` decimals as a Fortran 1PE field, right-justified in `width`: "  1.52588E-05".
pub(super) fn scientific(value: f64, width: usize, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, size) = match exponent.strip_prefix('-') {
        Some(size) => ('-', size),
        None => ('+', exponent),
    };
    format!("{:>width$}", format!("{mantissa}E{sign}{size:0>2}"))
}

/// Text cut or padded to `width` columns.
pub(super) fn text(content: &str, width: usize) -> String {
    let clean: String = content.chars().map(|c| if c.is_control() { ' ' } else { c }).take(width).collect();
    format!("{clean:<width$}")
}

/// Text in ASCII, for fields that readers locate by byte offset.
pub(super) fn ascii(content: &str) -> String {
    content
        .chars()
        .map(|c| match c {
            '²' => '2',
            '³' => '3',
            'µ' | 'μ' => 'u',
            c if c.is_ascii_graphic() || c == ' ' => c,
            _ => '?',
        })
        .collect()
}

/// `NONE` for an empty text: ID lines must not be blank.
pub(super) fn or_none(content: &str) -> &str {
    if content.trim().is_empty() { "NONE" } else { content }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_numbers_in_fortran_formats() {
        let read = |line| numbers(line).unwrap();
        assert_eq!(read(" 0.00000E+00-4.11111E-02  1.5"), [0.0, -4.11111e-2, 1.5]);
        assert_eq!(read("  1.000000000000000D+03 -2.7D2"), [1000.0, -270.0]);
        assert_eq!(read(" 1.00000-100 1.00000+100-1.0"), [1e-100, 1e100, -1.0]);
        assert_eq!(read(" 1.5-123.25"), [1.5, -123.25]);
        assert_eq!(read(" 7 -3"), [7.0, -3.0]);
        assert!(read(" NaN ********")[1].is_nan());
        assert_eq!(numbers(" 1.0 x1"), Err("x1".into()));
        assert!(read("").is_empty());
    }

    #[test]
    fn fields_have_their_stated_width() {
        assert_eq!(scientific(1.52588e-5, 13, 5), "  1.52588E-05");
        assert_eq!(scientific(-1e-100, 13, 5), "-1.00000E-100");
        assert_eq!(scientific(0.0, 20, 12), "  0.000000000000E+00");
        assert_eq!(columns("   12ab cd", [5, 3, 10, 4]), ["12", "ab", "cd", ""]);
        assert_eq!(text("ab\n", 5), "ab   ");
        assert_eq!(ascii("m/s² ü"), "m/s2 ?");
    }
}
