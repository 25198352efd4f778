//! Names of records: natural order, dates and numbers in them.

use std::cmp::Ordering;

/// Order of names in which the digits in them count as numbers: rec2 before rec10.
pub fn natural_order(a: &str, b: &str) -> Ordering {
    let (parts, others) = (parts(a), parts(b));
    let part = |(x, y): (&&str, &&str)| match (is_number(x), is_number(y)) {
        (true, true) => {
            let [x, y] = [x, y].map(|digits| digits.trim_start_matches('0'));
            x.len().cmp(&y.len()).then(x.cmp(y))
        }
        _ => x.cmp(y),
    };
    let by_parts = parts.iter().zip(&others).map(part).find(|order| order.is_ne());
    by_parts.unwrap_or_else(|| parts.len().cmp(&others.len())).then_with(|| a.cmp(b))
}

fn is_number(part: &str) -> bool {
    part.starts_with(|c: char| c.is_ascii_digit())
}

/// Digits and what is between them, in turn.
fn parts(name: &str) -> Vec<&str> {
    let mut out = Vec::new();
    let mut rest = name;
    while let Some(first) = rest.chars().next() {
        let same = |c: char| c.is_ascii_digit() == first.is_ascii_digit();
        let end = rest.find(|c| !same(c)).unwrap_or(rest.len());
        let (part, after) = rest.split_at(end);
        out.push(part);
        rest = after;
    }
    out
}

/// The date in a name as "2004-02-12 10:32:39"; the time of day as far as the name has it.
pub fn date(name: &str) -> Option<String> {
    let parts = parts(name);
    (0..parts.len()).find_map(|k| date_from(&parts[k..]))
}

/// A date that begins with the first part: 2004.02.12.10.32.39, 2004-02-12_103239, 20040212T103239, 20040212103239.
fn date_from(parts: &[&str]) -> Option<String> {
    let digits = |k: usize, length: usize| {
        let part = parts.get(k).filter(|part| is_number(part) && part.len() == length)?;
        // What separates two numbers of a date is one character.
        (k == 0 || parts[k - 1].chars().count() == 1).then_some(*part)
    };
    let clock = |k: usize| -> String {
        if let (Some(hour), Some(minute)) = (digits(k, 2), digits(k + 2, 2)) {
            let second = digits(k + 4, 2).unwrap_or("00");
            return format!(" {hour}:{minute}:{second}");
        }
        let packed = digits(k, 6).or_else(|| digits(k, 4));
        packed.map(in_clock).unwrap_or_default()
    };
    let first = parts.first().filter(|part| is_number(part))?;
    let (year, month, day, time) = match first.len() {
        4 => (*first, digits(2, 2)?, digits(4, 2)?, clock(6)),
        8 => (&first[..4], &first[4..6], &first[6..8], clock(2)),
        12 | 14 => (&first[..4], &first[4..6], &first[6..8], in_clock(&first[8..])),
        _ => return None,
    };
    let within = |text: &str, range: std::ops::RangeInclusive<u32>| {
        text.parse().is_ok_and(|number: u32| range.contains(&number))
    };
    let is_date = within(year, 1900..=2199) && within(month, 1..=12) && within(day, 1..=31);
    is_date.then(|| format!("{year}-{month}-{day}{time}"))
}

/// "103239" as " 10:32:39", "1032" as " 10:32:00".
fn in_clock(digits: &str) -> String {
    let second = digits.get(4..6).unwrap_or("00");
    format!(" {}:{}:{second}", &digits[..2], &digits[2..4])
}

/// A number that differs between names which are otherwise the same.
#[derive(Clone, Debug, PartialEq)]
pub struct NameNumbers {
    /// The word before it; "number" without one.
    pub name: String,
    /// The word that follows it directly, such as hp; empty without one.
    pub unit: String,
    pub values: Vec<f64>,
}

/// The first number that has another value in every name, if all names are the same but for numbers.
pub fn numbers(names: &[&str]) -> Option<NameNumbers> {
    let split: Vec<Vec<&str>> = names.iter().map(|name| decimal_parts(name)).collect();
    let first = split.first().filter(|_| names.len() > 1)?;
    let fixed = |parts: &Vec<&str>| -> Vec<Option<String>> {
        parts.iter().map(|part| (!is_number(part)).then(|| part.to_string())).collect()
    };
    let skeleton = fixed(first);
    if split.iter().any(|parts| fixed(parts) != skeleton) {
        return None;
    }
    let values = |k: usize| -> Option<Vec<f64>> { split.iter().map(|parts| parts[k].parse().ok()).collect() };
    let differ = |values: &Vec<f64>| {
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.windows(2).all(|pair| pair[0] < pair[1])
    };
    (0..first.len()).filter(|&k| is_number(first[k])).find_map(|k| {
        let values = values(k).filter(differ)?;
        let word = |text: Option<&&str>, last: bool| -> String {
            let letters =
                |text: &str| text.split(|c: char| !c.is_alphabetic()).map(str::to_owned).collect::<Vec<_>>();
            let words = letters(text.copied().unwrap_or_default());
            let word = if last { words.iter().rfind(|word| !word.is_empty()) } else { words.first() };
            word.cloned().unwrap_or_default()
        };
        let before = if k == 0 { None } else { first.get(k - 1) };
        let name = Some(word(before, true)).filter(|name| !name.is_empty());
        let (name, unit) = (name.unwrap_or_else(|| "number".into()), word(first.get(k + 1), false));
        Some(NameNumbers { name, unit, values })
    })
}

/// As [`parts`], but a point between digits belongs to a decimal number: load_1.5.
fn decimal_parts(name: &str) -> Vec<&str> {
    let mut out: Vec<&str> = Vec::new();
    let mut at = 0;
    let pieces = parts(name);
    let mut k = 0;
    while k < pieces.len() {
        let decimal = is_number(pieces[k])
            && pieces.get(k + 1) == Some(&".")
            && pieces.get(k + 2).is_some_and(|next| is_number(next))
            && pieces.get(k + 3) != Some(&".")
            && (k < 2 || pieces[k - 1] != ".");
        let count = if decimal { 3 } else { 1 };
        let length: usize = pieces[k..k + count].iter().map(|piece| piece.len()).sum();
        out.push(&name[at..at + length]);
        at += length;
        k += count;
    }
    out
}

/// Most names in a message.
pub const MAX_NAMES: usize = 6;

/// A few names, and the number of the others.
pub fn few<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<&str> = names.collect();
    match names.len() {
        n if n > MAX_NAMES => format!("{} and {} more", names[..MAX_NAMES].join(", "), n - MAX_NAMES),
        _ => names.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_ordered_as_numbers() {
        let mut names =
            vec!["rec10.mat", "rec2.mat", "rec02b.mat", "a.mat", "rec1.mat", "rec.mat", "rec002.mat"];
        names.sort_by(|a, b| natural_order(a, b));
        assert_eq!(
            names,
            ["a.mat", "rec1.mat", "rec002.mat", "rec2.mat", "rec02b.mat", "rec10.mat", "rec.mat"]
        );
    }

    #[test]
    fn dates_in_names() {
        for (name, expected) in [
            ("2003.10.22.12.06.24", "2003-10-22 12:06:24"),
            ("pump 2004-02-12_103239.csv", "2004-02-12 10:32:39"),
            ("20040212T1032.mat", "2004-02-12 10:32:00"),
            ("P7_20040212103239_A.wav", "2004-02-12 10:32:39"),
            ("rec_2004-02-12.uff", "2004-02-12"),
        ] {
            assert_eq!(date(name).as_deref(), Some(expected), "{name}");
        }
        // No month 13, no date of two lines, and plain numbers.
        for name in ["2004-13-12.csv", "2004--02-12.csv", "105.mat", "12000_20.mat", "20043112.csv", "ä2004"]
        {
            assert_eq!(date(name), None, "{name}");
        }
    }

    #[test]
    fn numbers_that_differ_between_names() {
        let found = |names: &[&str]| numbers(names).map(|n| (n.name, n.unit, n.values));
        let expected =
            |name: &str, unit: &str, values: &[f64]| Some((name.into(), unit.into(), values.to_vec()));
        assert_eq!(found(&["rec2.mat", "rec10.mat"]), expected("rec", "", &[2.0, 10.0]));
        assert_eq!(
            found(&["6205_load_0hp_12k.mat", "6205_load_3hp_12k.mat"]),
            expected("load", "hp", &[0.0, 3.0])
        );
        assert_eq!(found(&["105.mat", "106.mat"]), expected("number", "", &[105.0, 106.0]));
        assert_eq!(found(&["a_1.5.csv", "a_0.25.csv"]), expected("a", "", &[1.5, 0.25]));
        assert_eq!(found(&["a_1.5.mat", "a_2.mat"]), expected("a", "", &[1.5, 2.0]));
        // One value twice, other names, a single one.
        assert_eq!(found(&["a1.mat", "a2.mat", "a1.csv"]), None);
        assert_eq!(found(&["IR007_0.mat", "OR007at6_0.mat"]), None);
        assert_eq!(found(&["a1.mat"]), None);
    }
}
