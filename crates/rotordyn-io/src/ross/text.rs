//! The text of a model file: tables, keys with units, comments.

/// Text under construction.
#[derive(Default)]
pub struct Text(String);

impl Text {
    /// A line of its own; comments only.
    pub fn comment(&mut self, text: &str) {
        // names of the other file may hold any character, even ends of lines
        let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        self.0.push_str(&format!("# {plain}\n"));
    }

    /// The header of a table after an empty line, such as `[bearing.a]`.
    pub fn table(&mut self, header: &str) {
        self.0.push_str(&format!("\n{header}\n"));
    }

    /// A key with a value as it is written.
    pub fn raw(&mut self, key: &str, value: &str) {
        self.0.push_str(&format!("{key} = {value}\n"));
    }

    /// A key with a text.
    pub fn text(&mut self, key: &str, value: &str) {
        self.raw(key, &quoted(value));
    }

    /// A key with a quantity in a unit.
    pub fn quantity(&mut self, key: &str, value: f64, unit: &str) {
        self.quantities(key, &[value], unit);
    }

    /// A key with quantities in a unit.
    pub fn quantities(&mut self, key: &str, values: &[f64], unit: &str) {
        let list: Vec<String> = values.iter().map(|v| number(*v)).collect();
        self.raw(key, &format!("\"{} {unit}\"", list.join(", ")));
    }

    pub fn finish(self) -> String {
        self.0
    }
}

/// A TOML string; control characters of the other file become spaces.
pub fn quoted(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("\"{}\"", plain.replace('\\', "\\\\").replace('"', "\\\""))
}

/// The shortest text that reads as the same number.
pub fn number(value: f64) -> String {
    // without the sign of zero
    let value = value + 0.0;
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// Names for the items of one table: letters, digits and _, none twice.
#[derive(Default)]
pub struct Names(Vec<String>);

impl Names {
    /// The name of an element by its tag: "Bearing 0" gives `bearing_0`.
    pub fn of(&mut self, tag: &str) -> String {
        let plain: String = tag
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' })
            .take(40)
            .collect();
        let plain = plain.trim_matches('_');
        let base = if plain.is_empty() { "item" } else { plain };
        let mut name = base.to_string();
        let mut count = 1;
        while self.0.contains(&name) {
            count += 1;
            name = format!("{base}_{count}");
        }
        self.0.push(name.clone());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        for (value, text) in
            [(0.25, "0.25"), (1e20, "1e20"), (-0.0, "0"), (8.117e10, "8.117e10"), (7810.0, "7810")]
        {
            assert_eq!(number(value), text);
        }
        let third = 1.0 / 3.0;
        assert_eq!(number(third).parse::<f64>().ok(), Some(third));
    }

    #[test]
    fn names_differ_and_are_plain() {
        let mut names = Names::default();
        let of: Vec<String> = ["Bearing 0", "bearing-0", "  ", "Lager Ä"].map(|tag| names.of(tag)).into();
        assert_eq!(of, ["bearing_0", "bearing_0_2", "item", "lager"]);
        assert_eq!(quoted("a\"b\\c\nd"), "\"a\\\"b\\\\c d\"");
    }
}
