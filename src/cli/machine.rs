//! Loads a model file: reads it, applies variant and overrides, validates it, checks bearing parts for
//! overlap.

use std::path::{Path, PathBuf};

use rotordyn::bearing::BallBearing;
use rotordyn::error::Error;
use rotordyn::geometry::BearingShapes;
use rotordyn::geometry::parry::Part;
use rotordyn::io::{budget, external_file};
use rotordyn::model::{
    self, Diagnostic, ExternalFile, Kind, Loaded, LoadedBearings, ModelErrors, Options, Source,
};

use super::args::ModelArgs;
use super::failure::Failure;
use super::limits::limits;
use super::setting_sources;
use super::settings::Settings;

/// Allowed overlap of ball and race as a fraction of the ball diameter: negative clearance overlaps by some
/// micrometres, a wrong groove radius or clearance by far more.
const MAX_BALL_RACE_OVERLAP: f64 = 5e-3;

/// Text of a model file, with variant and overrides of the user.
#[derive(Clone, Debug)]
pub struct ModelSource {
    /// File name used in messages.
    pub name: String,
    pub text: Vec<u8>,
    pub options: Options,
    /// Base folder of relative paths in the file.
    pub folder: PathBuf,
    /// Referenced files, if already read (from a stored run).
    pub files: Option<Vec<ExternalFile>>,
}

impl ModelSource {
    pub fn read(args: &ModelArgs) -> Result<Self, Failure> {
        let (text, _) = budget::read_file(&args.model, limits()).map_err(|error| match error {
            Error::Environment { path, source, .. } => {
                Error::Environment { operation: "read the model file", path, source }
            }
            other => other,
        })?;
        let variant = args.variant.clone().filter(|name| name != "base");
        let options = Options { variant, set: args.set.clone() };
        let folder = args.model.parent().map(PathBuf::from).unwrap_or_default();
        Ok(Self { name: args.model.display().to_string(), text, options, folder, files: None })
    }

    /// Validated model, with settings applied after those of the user.
    pub fn load(&self, settings: &[(String, String)]) -> Result<Loaded, Failure> {
        self.load_with(&Settings { set: settings.to_vec(), ..Settings::default() })
    }

    /// Validated model, with settings of the command applied after those of the user.
    pub fn load_with(&self, settings: &Settings) -> Result<Loaded, Failure> {
        let options = self.options_with(settings);
        let files = self.side_files(&options);
        let mut loaded = model::load_with(&self.name, &self.text, &options, &files)
            .map_err(|errors| self.located(errors, settings))?;
        let found = loaded.warnings.iter_mut().chain(&mut loaded.hints).chain(&mut loaded.conflicts);
        setting_sources::as_written(&mut loaded.sources, found, self.options.set.len(), &settings.flags);
        let balls =
            loaded.model.bearings.iter().filter_map(|site| Some((site.name.as_str(), site.bearing.ball()?)));
        check_overlaps(balls, &loaded.text, &loaded.sources)?;
        Ok(loaded)
    }

    /// Validated ball bearings of a machine or of a file with bearings only, with settings applied.
    pub fn load_bearings(&self, settings: &Settings) -> Result<LoadedBearings, Failure> {
        let options = self.options_with(settings);
        let files = self.side_files(&options);
        let mut loaded = model::load_bearings_with(&self.name, &self.text, &options, &files)
            .map_err(|errors| self.located(errors, settings))?;
        let found = loaded.warnings.iter_mut().chain(&mut loaded.hints);
        setting_sources::as_written(&mut loaded.sources, found, self.options.set.len(), &settings.flags);
        let balls = loaded.bearings.iter().map(|(name, ball)| (name.as_str(), ball));
        check_overlaps(balls, &loaded.text, &loaded.sources)?;
        Ok(loaded)
    }

    /// Whether the file states bearings alone, without a machine.
    pub fn has_bearings_only(&self) -> bool {
        model::has_bearings_only(&self.text, &self.options)
    }

    /// Options of the user, with settings of the command after them.
    pub fn options_with(&self, settings: &Settings) -> Options {
        let mut options = self.options.clone();
        options.set.extend_from_slice(&settings.set);
        options
    }

    /// Errors located on the command line as it was written.
    fn located(&self, mut errors: ModelErrors, settings: &Settings) -> ModelErrors {
        let found = errors.diagnostics.iter_mut();
        setting_sources::as_written(&mut errors.sources, found, self.options.set.len(), &settings.flags);
        errors
    }

    /// Files referenced by the model with these options.
    pub fn side_files(&self, options: &Options) -> Vec<ExternalFile> {
        let read = || model::external_files(&self.text, options);
        let named = || {
            read()
                .iter()
                .map(|path| external_file::read_external_file(&self.folder, path, limits()))
                .collect()
        };
        self.files.clone().unwrap_or_else(named)
    }

    /// Paths and sizes \[bytes\] of the files that the model refers to with its options.
    pub fn side_file_sizes(&self) -> Result<Vec<(PathBuf, u64)>, Failure> {
        let named = model::external_files(&self.text, &self.options).into_iter();
        let size = |path: PathBuf| match std::fs::metadata(&path) {
            Ok(found) => Ok((path, found.len())),
            Err(error) => Err(Failure::environment("read", &path, error)),
        };
        named.map(|path| size(self.folder.join(path))).collect()
    }

    /// The same file with another variant; `base` means no variant.
    pub fn with_variant(&self, variant: &str) -> Self {
        let mut other = self.clone();
        other.options.variant = Some(variant.to_string()).filter(|name| name != "base");
        other
    }

    /// Names of the variants in the file.
    pub fn variants(&self) -> Vec<String> {
        std::str::from_utf8(&self.text).map(model::variants).unwrap_or_default()
    }

    /// Results folder; default `out/NAME` or `out/NAME_VARIANT`.
    pub fn results_folder(&self, out: Option<&PathBuf>, model_name: &str) -> PathBuf {
        let name = match &self.options.variant {
            Some(variant) => format!("{model_name}_{variant}"),
            None => model_name.to_string(),
        };
        out.cloned().unwrap_or_else(|| Path::new("out").join(name))
    }
}

/// Interference check: balls, cage pockets and rings of every ball bearing must not overlap.
fn check_overlaps<'a>(
    bearings: impl Iterator<Item = (&'a str, &'a BallBearing)>,
    text: &str,
    sources: &[Source],
) -> Result<(), ModelErrors> {
    let mut diagnostics = Vec::new();
    for (name, ball) in bearings {
        let shapes = BearingShapes::new(&ball.geometry, ball.cage_pocket_diameter);
        let mut found = shapes
            .overlaps(&shapes.centred(ball.cage_angle), MAX_BALL_RACE_OVERLAP * ball.geometry.ball_diameter);
        // Only a stated cage refuses a bearing, not the one assumed for drawings.
        if ball.cage_pocket_diameter == ball.geometry.default_cage_pocket() {
            let of_cage = |part| matches!(part, Part::Pocket(_) | Part::Cage);
            found.retain(|overlap| {
                overlap.second == Part::SideFace || !of_cage(overlap.first) && !of_cage(overlap.second)
            });
        }
        let Some(worst) = found.iter().max_by(|a, b| a.depth.total_cmp(&b.depth)) else { continue };
        let more = match found.len() {
            1 => String::new(),
            n => format!(" (the deepest of {n} overlaps)"),
        };
        diagnostics.push(Diagnostic {
            warning: None,
            kind: Kind::Geometry,
            source: 0,
            span: model::item_span(text, &["bearing", name]),
            message: format!("bearing.{name}: {worst}{more}"),
            expected: None,
            hint: Some("check ball and pitch diameter, osculation, clearance, pocket, bore and width".into()),
        });
    }
    match diagnostics.is_empty() {
        true => Ok(()),
        false => Err(ModelErrors { sources: sources.to_vec(), diagnostics }),
    }
}
