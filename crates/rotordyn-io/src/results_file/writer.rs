//! The one writer of a results file, which never opens it for writing: every version of it is a new file, renamed when
//! it is complete and on the disk.
//!
//! | file | contents |
//! |---|---|
//! | `results.h5` | the results of a command that ended, by itself, by an error or by a signal |
//! | `results_unfinished.h5` | the studies finished so far and the samples so far of a command under way, or of one that was killed |
//! | `results_previous.h5` | the finished results before those of another version of the model, or of a run that was stopped |
//! | `results_unfinished_previous.h5` | what a killed command left, before another one began |

use super::provenance::{Provenance, results_state, set_results_state, set_stored_files, stored_files};
use super::{remove_run, write_labels, write_section};
use crate::atomic_file::{NewFile, sync_folder_of};
use crate::error::Error;
use crate::hdf5::{COMPLETE, ChannelStream, RUNNING, RunFormat, Store, copy_run, preallocate_run};
use rotordyn_core::document::Section;
use rotordyn_core::study::Machine;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Name of the results file.
pub const FINISHED: &str = "results.h5";
/// Name of the results file of a command under way.
pub const UNFINISHED: &str = "results_unfinished.h5";
/// Name of the finished results before others.
pub const PREVIOUS: &str = "results_previous.h5";
/// Name of unfinished results before others.
pub const UNFINISHED_PREVIOUS: &str = "results_unfinished_previous.h5";

/// Results of a command on their way to a file.
#[derive(Debug)]
pub struct ResultsWriter {
    target: PathBuf,
    /// Whether the results are added to those of `target`.
    extends: bool,
    /// Whether `target` holds results that must be kept as the previous ones.
    keeps_previous: bool,
    provenance: Provenance,
    /// Whether `results_unfinished.h5` is of this writer.
    saved: bool,
    /// Whether there is a new run in place of an earlier one.
    has_run: bool,
    /// Sections in `results_unfinished.h5`.
    sections: BTreeSet<String>,
}

impl ResultsWriter {
    /// New results, in place of those of `target`; `keeps_previous`: which stay as the previous ones.
    pub fn create(target: &Path, provenance: Provenance, keeps_previous: bool) -> Self {
        Self {
            target: target.into(),
            extends: false,
            keeps_previous,
            provenance,
            saved: false,
            has_run: false,
            sections: BTreeSet::new(),
        }
    }

    /// Results added to those of `target`, which replace their earlier ones.
    pub fn extend(target: &Path, provenance: Provenance) -> Self {
        Self { extends: true, ..Self::create(target, provenance, false) }
    }

    /// The results file.
    pub fn path(&self) -> &Path {
        &self.target
    }

    /// Path of `results_unfinished.h5`.
    pub fn unfinished(&self) -> PathBuf {
        self.target.with_file_name(UNFINISHED)
    }

    /// Identity of the results.
    pub fn identity(&self) -> String {
        self.provenance.identity()
    }

    /// The file with the results so far, if there is one.
    pub fn newest(&self) -> Option<PathBuf> {
        if self.saved { Some(self.unfinished()) } else { self.base() }
    }

    fn base(&self) -> Option<PathBuf> {
        self.extends.then(|| self.target.clone())
    }

    /// The next version of `path`: a copy of `from`, or a new file with `/meta`.
    fn version(&self, path: &Path, from: Option<PathBuf>) -> Result<Store, Error> {
        match from {
            Some(from) => Store::replace_with_copy(path, &from),
            None => {
                let store = Store::replace(path)?;
                self.provenance.write(&store)?;
                Ok(store)
            }
        }
    }

    /// Writes the sections that are not in the file of this writer yet.
    fn add_sections(&mut self, store: &Store, sections: &[Section]) -> Result<(), Error> {
        for section in sections {
            if self.sections.insert(section.hdf5.to_string()) {
                write_section(store, "", section)?;
            }
        }
        Ok(())
    }

    /// Gives `results_unfinished.h5` its next version.
    fn commit_unfinished(&mut self, store: Store) -> Result<(), Error> {
        set_results_state(&store, RUNNING)?;
        let unfinished = self.unfinished();
        let saved = self.saved;
        store.commit_after(|| {
            if !saved && unfinished.exists() {
                let kept = unfinished.with_file_name(UNFINISHED_PREVIOUS);
                keep_as(&unfinished, &kept)?;
            }
            Ok(())
        })?;
        self.saved = true;
        Ok(())
    }

    /// Saves the finished studies in `results_unfinished.h5`, on the disk when it returns; what is there stays.
    ///
    /// # Errors
    /// The file cannot be written; its former version is unchanged.
    pub fn save(&mut self, sections: &[Section], machine: &Machine) -> Result<(), Error> {
        let store = self.version(&self.unfinished(), self.newest())?;
        write_labels(&store, machine)?;
        self.add_sections(&store, sections)?;
        self.commit_unfinished(store)
    }

    /// Begins a run of up to `samples` samples in `results_unfinished.h5`, with the finished studies.
    ///
    /// # Errors
    /// The file cannot be written, or there is no space on the disk for all samples.
    pub fn begin_run(
        &mut self,
        run: &RunFormat,
        samples: usize,
        (sections, machine): (&[Section], &Machine),
    ) -> Result<ChannelStream, Error> {
        let store = self.version(&self.unfinished(), self.newest())?;
        remove_run(&store)?;
        write_labels(&store, machine)?;
        self.add_sections(&store, sections)?;
        preallocate_run(&store, "", run, samples)?;
        self.commit_unfinished(store)?;
        self.has_run = true;
        ChannelStream::start(&self.unfinished(), "")
    }

    /// Goes on with the run in the `results_unfinished.h5` that a killed or stopped program left, after `samples`.
    ///
    /// # Errors
    /// There is no such file or run, or it has fewer samples.
    pub fn resume_run(&mut self, samples: usize) -> Result<ChannelStream, Error> {
        let stream = ChannelStream::resume(&self.unfinished(), "", samples)?;
        (self.saved, self.has_run) = (true, true);
        Ok(stream)
    }

    /// Ends a run: `results_unfinished.h5` then holds its samples alone, compressed where it pays, with the finished studies and what `add` writes.
    ///
    /// `state`: "complete" or "stopped: reason".
    ///
    /// # Errors
    /// The file cannot be written; the samples stay in its former version.
    pub fn end_run(
        &mut self,
        stream: ChannelStream,
        state: &str,
        (sections, machine): (&[Section], &Machine),
        add: impl FnOnce(&Store) -> Result<(), Error>,
    ) -> Result<(), Error> {
        stream.finish()?;
        let unfinished = self.unfinished();
        let store = self.version(&unfinished, self.base())?;
        remove_run(&store)?;
        copy_run(&Store::open(&unfinished)?, &store, "", state)?;
        add(&store)?;
        write_labels(&store, machine)?;
        self.sections.clear();
        self.add_sections(&store, sections)?;
        self.commit_unfinished(store)
    }

    /// Gives the results file its new version: the results so far, `sections` and what `add` writes.
    ///
    /// `state`: "complete" or "stopped: reason"; `files`: figures and tables of the results, relative to the folder.
    ///
    /// # Errors
    /// The file cannot be written; its former version is unchanged.
    pub fn finish(
        &mut self,
        state: &str,
        files: &[String],
        sections: &[Section],
        add: impl FnOnce(&Store) -> Result<(), Error>,
    ) -> Result<PathBuf, Error> {
        let store = self.version(&self.target, self.newest())?;
        let earlier = if self.extends { stored_files(&store)? } else { Vec::new() };
        let all: BTreeSet<String> = earlier.into_iter().chain(files.iter().cloned()).collect();
        set_stored_files(&store, &Vec::from_iter(all))?;
        let replaces = !self.extends || self.has_run;
        if replaces {
            set_results_state(&store, state)?;
        } else if self.saved {
            // The studies added do not end a run that was stopped.
            set_results_state(&store, &results_state(&Store::open(&self.target)?)?)?;
        }
        store.remove("/warnings")?;
        self.sections.remove("/warnings");
        add(&store)?;
        self.add_sections(&store, sections)?;
        let stopped = replaces && state != COMPLETE && is_complete(&self.target);
        let keeps = self.target.exists() && (self.keeps_previous || stopped);
        let previous = self.target.with_file_name(PREVIOUS);
        store.commit_after(|| if keeps { keep_as(&self.target, &previous) } else { Ok(()) })?;
        if self.saved {
            let unfinished = self.unfinished();
            std::fs::remove_file(&unfinished).map_err(Error::of_file("remove", &unfinished))?;
            sync_folder_of(&unfinished);
            self.saved = false;
        }
        Ok(self.target.clone())
    }
}

/// Whether a file holds results that ended.
fn is_complete(path: &Path) -> bool {
    path.exists() && Store::open(path).and_then(|store| results_state(&store)).is_ok_and(|s| s == COMPLETE)
}

/// Gives a file a second name, in place of another file: at no instant is one of them missing.
fn keep_as(path: &Path, kept: &Path) -> Result<(), Error> {
    let new = NewFile::replacing(kept);
    let part = new.part();
    // Some file systems have no hard links.
    std::fs::hard_link(path, part)
        .or_else(|_| std::fs::copy(path, part).map(drop))
        .and_then(|()| new.publish())
        .map_err(Error::of_file("keep as", kept))
}

/// The results file of a folder to be read: `results_unfinished.h5` if it is newer than `results.h5` or alone.
pub fn newest_results(folder: &Path) -> PathBuf {
    let [finished, unfinished] = [FINISHED, UNFINISHED].map(|name| folder.join(name));
    let modified = |path: &Path| std::fs::metadata(path).and_then(|found| found.modified()).ok();
    match (modified(&finished), modified(&unfinished)) {
        (None, Some(_)) => unfinished,
        (Some(end), Some(last)) if last > end => unfinished,
        _ => finished,
    }
}
