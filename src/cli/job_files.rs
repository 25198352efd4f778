//! Files of a sequence of studies: the results saved after each study, figures and tables at the end.

use std::time::Instant;

use rotordyn::figures::{self, FigureFolder};
use rotordyn::io::document_tables;
use rotordyn::io::hdf5::{COMPLETE, Store};
use rotordyn::io::results_file;

use super::args::OutputFiles;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::report_page;
use super::studies::Job;

impl Job<'_> {
    /// Saves the finished studies, so that nothing that happens later can take them.
    pub fn save(&mut self) -> Result<(), Failure> {
        let sections = self.results.sections(&self.machine.assembly.dofs);
        // The warnings follow at the end.
        let finished: Vec<_> = sections.into_iter().filter(|section| section.json != "warnings").collect();
        self.output.writer.save(&finished, &self.machine).map_err(|error| {
            let lost = format!("not stored: {}", self.unsaved.join(", "));
            Failure::from(error).with_consequence(&lost)
        })?;
        self.unsaved.clear();
        Ok(())
    }

    /// Writes and draws the results so far, also after failures.
    pub fn write(&mut self, written: OutputFiles) -> Result<(), Failure> {
        let start = Instant::now();
        let sections = self.results.sections(&self.machine.assembly.dofs);
        let spinner = self.terminal.spinner("figures");
        let drawn = if written.figures {
            figures::all_with_warnings(&self.results, &self.machine)?
        } else {
            Vec::new()
        };
        let tables = if written.csv { document_tables::tables(&sections) } else { Vec::new() };
        let mut listed = figures::file_names(&drawn);
        listed.extend(document_tables::csv_names(&tables).iter().map(|name| format!("csv/{name}")));
        let page = written.page.then(|| self.folder.join(report_page::FILE));
        listed.extend(page.iter().map(|_| report_page::FILE.to_string()));
        let state = match self.failures.first() {
            None => COMPLETE.to_string(),
            Some((study, why)) => format!("stopped: {study}: {}", why.message()),
        };
        let machine = &self.machine;
        let add = |store: &Store| results_file::write_labels(store, machine);
        let file = self.output.writer.finish(&state, &listed, &sections, add).map_err(|error| {
            let lost = match self.unsaved.len() {
                0 => "the results so far are in results_unfinished.h5".to_string(),
                _ => format!("not stored: {}", self.unsaved.join(", ")),
            };
            Failure::from(error).with_consequence(&lost)
        })?;
        self.unsaved.clear();
        let results = file.clone();
        self.files.push(file);
        self.output.earlier.move_aside(&self.folder, &listed, self.terminal)?;
        if written.csv {
            self.files.extend(write_csv(&self.folder, &sections)?);
        }
        let identity = self.output.writer.identity();
        let place = FigureFolder::new(&self.folder).with_identity(&identity);
        self.files.extend(figures::write_all(&drawn, place)?);
        spinner.finish_and_clear();
        self.seconds.push(("files and figures", start.elapsed().as_secs_f64()));
        if let Some(page) = page {
            let start = Instant::now();
            report_page::write(&results, &page, Some(&self.machine), &self.values, Vec::new())?;
            self.files.push(page);
            self.seconds.push(("report", start.elapsed().as_secs_f64()));
        }
        Ok(())
    }
}
