//! `update`: model updating of free parameters to measured modes and FRFs, with their identifiability.

use rotordyn::document::Section;
use rotordyn::figures;
use rotordyn::io::measured::test_data::{self, TestData};
use rotordyn::io::{atomic_file, json};
use rotordyn::model::Model;
use rotordyn::signal::record::MeasuredData;
use serde_json::json;

use super::args::UpdateArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::machine::ModelSource;
use super::measured::{self, folder};
use super::terminal::Terminal;
use super::update_fit::{Fit, UpdateContext};
use super::{Outcome, free_parameters, print_model_warnings, print_written_files, update_findings};

pub fn run(args: &UpdateArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let loaded = origin.load(&[])?;
    print_model_warnings(terminal, &loaded);
    let parameters = free_parameters::parameters(args, &origin, terminal)?;
    update_findings::check_profiles(&args.profile, &parameters)?;
    let name = match &origin.options.variant {
        Some(variant) => format!("{}_{variant}", loaded.model.name),
        None => loaded.model.name.clone(),
    };
    let folder = folder(args.study.out.as_ref(), &name, "updated");
    let _lock = FolderLock::take(&folder, terminal)?;
    let context = UpdateContext { origin: &origin, folder: &folder, terminal };
    let model = context.with_films(loaded.model)?;
    let read = read(args, &model, None, terminal)?;
    terminal.print(&format!("{}: {}", args.measured.measured[0].display(), read.source));
    let fit = Fit::new(args, &context, model.title, parameters, read)?;

    fit.print(terminal)?;
    let findings = fit.findings(&context, &args.profile)?;
    update_findings::print(terminal, &fit.parameters, &fit.found, &findings);
    fit.warn(terminal, &findings);

    let path = args.write.clone().unwrap_or_else(|| {
        let stem = args.study.model.model.file_stem().unwrap_or_default().to_string_lossy();
        folder.join(format!("{stem}_updated.toml"))
    });
    atomic_file::write(&path, fit.model_text(&origin)?.as_bytes())
        .map_err(|e| Failure::environment("write the model file", &path, e))?;
    let mut files = vec![path];
    let path = folder.join("update.h5");
    fit.write_results(&findings, &path)?;
    files.push(path);
    if !args.study.no_figures {
        let all: Vec<_> = fit.figures(&findings).into_iter().map(|named| (named, Vec::new())).collect();
        files.extend(figures::write_all(&all, &folder)?);
    }
    let section = Section::new("update", "update", fit.document(&findings));
    if args.study.csv {
        files.extend(write_csv(&folder, std::slice::from_ref(&section))?);
    }
    print_written_files(terminal, &folder, &files);
    let mut document = json::document(&section.content);
    document["command"] = json!("update");
    document["model"] = json!(fit.found.after.linearised.model.name);
    document["measured"] = json!(args.measured.measured);
    document["source"] = json!(fit.read.source);
    document["files"] = json!(files);
    Ok(document.into())
}

/// What is measured: that of the only file, or what is in memory in its place.
pub fn read(
    args: &UpdateArgs,
    model: &Model,
    given: Option<MeasuredData>,
    terminal: &Terminal,
) -> Result<TestData, Failure> {
    if args.measured.measured.len() > 1 {
        return Err(Failure::Input(
            "update takes a single measured file; merge the FRFs into one file".into(),
        ));
    }
    let read = measured::read_one(&args.measured, 0, model, given, terminal)?;
    Ok(read.ok_or_else(|| test_data::no_test_data(&args.measured.measured[0]))?)
}
