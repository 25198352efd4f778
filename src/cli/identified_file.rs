//! What `identify` found, and the files it writes.

use std::path::{Path, PathBuf};

use rotordyn::document::Section;
use rotordyn::figures::{self, Named};
use rotordyn::identify::ModalIdentification;
use rotordyn::identify::operational::OperationalModes;
use rotordyn::io::hdf5::Store;
use rotordyn::io::{identified_modes, measured, operational_modes, results_file};
use rotordyn::signal::record::{FrfMatrix, MeasuredData};

use super::csv_files::write_csv;
use super::failure::Failure;
use super::store::FILE;
use super::terminal::Terminal;
use super::{identify_tables, operational_tables};

/// Modes of a measurement.
#[derive(Clone, Debug)]
pub struct Identified {
    /// Name of the first file, without its ending.
    pub stem: String,
    pub measured: MeasuredData,
    pub modes: Modes,
    pub warnings: Vec<String>,
}

/// Modes by what they come from.
#[derive(Clone, Debug)]
pub enum Modes {
    OfFrfs { frfs: FrfMatrix, found: ModalIdentification },
    InOperation(OperationalModes),
}

impl Identified {
    pub fn title(&self) -> &str {
        if self.measured.title.is_empty() { &self.stem } else { &self.measured.title }
    }

    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        match &self.modes {
            Modes::OfFrfs { found, .. } => identified_modes::section(found),
            Modes::InOperation(found) => operational_modes::section(found),
        }
    }

    /// Mode shapes for other programs; `None` without a mode in operation.
    pub fn shapes(&self) -> Option<MeasuredData> {
        let geometry = &self.measured.geometry;
        match &self.modes {
            Modes::OfFrfs { found, .. } => Some(identified_modes::mode_shapes(found, geometry)),
            Modes::InOperation(found) if found.modes.is_empty() => None,
            Modes::InOperation(found) => Some(operational_modes::mode_shapes(found, geometry)),
        }
    }

    pub fn figures(&self) -> Vec<Named> {
        let (geometry, title) = (&self.measured.geometry, self.title());
        match &self.modes {
            Modes::OfFrfs { frfs, found } => figures::identification::figures(found, frfs, geometry, title),
            Modes::InOperation(found) => figures::identification::operational_figures(found, geometry, title),
        }
    }

    pub fn print(&self, terminal: &Terminal) {
        match &self.modes {
            Modes::OfFrfs { frfs, found } => identify_tables::tables(terminal, found, frfs),
            Modes::InOperation(found) => operational_tables::tables(terminal, found),
        }
    }

    /// Writes results.h5, modes.uff, tables and figures; returns the files.
    pub fn write(
        &self,
        folder: &Path,
        csv: bool,
        drawn: bool,
        terminal: &Terminal,
    ) -> Result<Vec<PathBuf>, Failure> {
        let path = folder.join(FILE);
        self.write_results(&path)?;
        let mut files = vec![path];
        if let Some(shapes) = self.shapes() {
            let path = folder.join("modes.uff");
            measured::write(&path, &shapes)?;
            files.push(path);
        }
        if csv {
            files.extend(write_csv(folder, &[self.section()])?);
        }
        if drawn {
            let spinner = terminal.spinner("figures");
            let all: Vec<_> = self.figures().into_iter().map(|named| (named, Vec::new())).collect();
            files.extend(figures::write_all(&all, folder)?);
            spinner.finish_and_clear();
        }
        Ok(files)
    }

    /// Writes the results file.
    pub fn write_results(&self, path: &Path) -> Result<(), Failure> {
        let store = Store::replace(path)?;
        store.set_attribute("/meta", "program", "rotordyn")?;
        store.set_attribute("/meta", "version", env!("CARGO_PKG_VERSION"))?;
        store.set_attribute("/meta", "title", self.title())?;
        results_file::write_section(&store, "", &self.section())?;
        store.commit()?;
        Ok(())
    }
}
