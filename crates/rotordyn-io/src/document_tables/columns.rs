//! Columns of texts, and tables collected from them.

/// A table of texts; numbers have all their digits.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTable {
    pub name: String,
    /// Names of the columns with their units.
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// Columns of equal length with their titles.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    columns: Vec<(String, Vec<String>)>,
    rows: usize,
}

/// Tables by name, each from one or more sets of columns.
#[derive(Default)]
pub(super) struct Tables(Vec<(String, Vec<Columns>)>);

/// A name within another; an empty one is left out.
pub(super) fn joined(name: &str, inner: &str) -> String {
    match (name, inner) {
        (name, "") => name.into(),
        ("", inner) => inner.into(),
        (name, inner) => format!("{name}_{inner}"),
    }
}

impl Columns {
    /// One row without columns.
    pub(super) fn one_row() -> Self {
        Self::of_rows(1)
    }

    /// Rows without columns.
    pub(super) fn of_rows(rows: usize) -> Self {
        Self { columns: Vec::new(), rows }
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    pub(super) fn len(&self) -> usize {
        self.columns.len()
    }

    /// Adds a column; one of a title that is there is not repeated.
    pub(super) fn add(&mut self, title: impl Into<String>, cells: Vec<String>) {
        let title = title.into();
        if self.columns.iter().all(|(other, _)| *other != title) {
            self.rows = cells.len();
            self.columns.push((title, cells));
        }
    }

    pub(super) fn append(&mut self, other: Self) {
        other.columns.into_iter().for_each(|(title, cells)| self.add(title, cells));
    }

    /// Adds columns; `name` stands before a title that is there.
    pub(super) fn append_named(&mut self, other: Self, name: &str) {
        for (title, cells) in other.columns {
            let is_taken = self.columns.iter().any(|(own, _)| *own == title);
            self.add(if is_taken { joined(name, &title) } else { title }, cells);
        }
    }

    /// Every row as often as `counts` says.
    pub(super) fn repeated(&self, counts: &[usize]) -> Self {
        let times = |cells: &Vec<String>| {
            let each = cells.iter().zip(counts);
            each.flat_map(|(cell, count)| std::iter::repeat_n(cell.clone(), *count)).collect()
        };
        let columns = self.columns.iter().map(|(title, cells)| (title.clone(), times(cells)));
        Self { columns: columns.collect(), rows: counts.iter().sum() }
    }

    /// All rows, again and again.
    pub(super) fn cycled(&self, times: usize) -> Self {
        let again = |cells: &Vec<String>| cells.iter().cycle().take(cells.len() * times).cloned().collect();
        let columns = self.columns.iter().map(|(title, cells)| (title.clone(), again(cells)));
        Self { columns: columns.collect(), rows: self.rows * times }
    }
}

impl Tables {
    pub(super) fn add(&mut self, name: &str, columns: Columns) {
        match self.0.iter_mut().find(|(other, _)| other == name) {
            Some((_, parts)) => parts.push(columns),
            None => self.0.push((name.into(), vec![columns])),
        }
    }

    /// Tables with the columns of all their parts; cells that a part does not have are empty.
    pub(super) fn finished(self) -> Vec<TextTable> {
        let mut out = Vec::new();
        for (name, parts) in self.0 {
            let mut header: Vec<String> = Vec::new();
            for (title, _) in parts.iter().flat_map(|part| &part.columns) {
                if !header.contains(title) {
                    header.push(title.clone());
                }
            }
            let mut rows = Vec::new();
            for part in parts {
                let start = rows.len();
                rows.resize(start + part.rows, vec![String::new(); header.len()]);
                for (title, cells) in part.columns {
                    let Some(at) = header.iter().position(|other| *other == title) else { continue };
                    rows[start..].iter_mut().zip(cells).for_each(|(row, cell)| row[at] = cell);
                }
            }
            if !rows.is_empty() && !header.is_empty() {
                out.push(TextTable { name, header, rows });
            }
        }
        out
    }
}

impl TextTable {
    /// The table as CSV (RFC 4180); texts with a separator, quote or line break are quoted.
    pub fn csv(&self) -> String {
        std::iter::once(&self.header).chain(&self.rows).map(|cells| line(cells)).collect()
    }
}

fn line(cells: &[String]) -> String {
    let quoted = |cell: &String| match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    };
    cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n"
}
