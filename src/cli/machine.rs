//! From a model file to a machine: read, vary, check, look for overlapping parts.

use std::path::{Path, PathBuf};

use rotordyn::bearing::BallBearing;
use rotordyn::edge::parry::BearingShapes;
use rotordyn::edge::side_file;
use rotordyn::model::{
    self, Diagnostic, Kind, Loaded, LoadedBearings, ModelErrors, Options, SideFile, Source,
};

use super::args::ModelArgs;
use super::failure::Failure;

/// How far a ball may stand in a race, as a share of its diameter: interference fits squeeze balls by some
/// micrometres, a wrong groove or clearance by far more.
const ELASTIC: f64 = 5e-3;

/// The text of a model file, and what the user laid over it.
#[derive(Clone, Debug)]
pub struct Origin {
    /// What messages call the file.
    pub name: String,
    pub text: Vec<u8>,
    pub options: Options,
    /// Folder that the paths in it count from.
    pub folder: PathBuf,
    /// The files that it names, where they are known already: those of a stored run.
    pub files: Option<Vec<SideFile>>,
}

impl Origin {
    pub fn read(args: &ModelArgs) -> Result<Self, Failure> {
        let text = std::fs::read(&args.model)
            .map_err(|error| Failure::environment("read the model file", &args.model, error))?;
        let variant = args.variant.clone().filter(|name| name != "base");
        let options = Options { variant, set: args.set.clone() };
        let folder = args.model.parent().map(PathBuf::from).unwrap_or_default();
        Ok(Self { name: args.model.display().to_string(), text, options, folder, files: None })
    }

    /// The checked model, with settings of a command laid over those of the user.
    pub fn load(&self, settings: &[(String, String)]) -> Result<Loaded, Failure> {
        let mut options = self.options.clone();
        options.set.extend_from_slice(settings);
        let files = self.side_files(&options);
        let loaded = model::load_with(&self.name, &self.text, &options, &files)?;
        let balls =
            loaded.model.bearings.iter().filter_map(|site| Some((site.name.as_str(), site.bearing.ball()?)));
        overlaps(balls, &loaded.text, &loaded.sources)?;
        Ok(loaded)
    }

    /// The checked ball bearings of a machine or of a file of bearings alone, with settings laid over.
    pub fn load_bearings(&self, settings: &[(String, String)]) -> Result<LoadedBearings, Failure> {
        let mut options = self.options.clone();
        options.set.extend_from_slice(settings);
        let files = self.side_files(&options);
        let loaded = model::load_bearings_with(&self.name, &self.text, &options, &files)?;
        let balls = loaded.bearings.iter().map(|(name, ball)| (name.as_str(), ball));
        overlaps(balls, &loaded.text, &loaded.sources)?;
        Ok(loaded)
    }

    /// The files that the model names, varied as told.
    pub fn side_files(&self, options: &Options) -> Vec<SideFile> {
        let read = || model::side_files(&self.text, options);
        let named = || read().iter().map(|path| side_file::read(&self.folder, path)).collect();
        self.files.clone().unwrap_or_else(named)
    }

    /// The same file with another variant; `base` is none.
    pub fn with_variant(&self, variant: &str) -> Self {
        let mut other = self.clone();
        other.options.variant = Some(variant.to_string()).filter(|name| name != "base");
        other
    }

    /// Names of the variants in the file.
    pub fn variants(&self) -> Vec<String> {
        std::str::from_utf8(&self.text).map(model::variants).unwrap_or_default()
    }

    /// `out/NAME` or `out/NAME_VARIANT`, unless told otherwise.
    pub fn folder(&self, out: Option<&PathBuf>, model_name: &str) -> PathBuf {
        let name = match &self.options.variant {
            Some(variant) => format!("{model_name}_{variant}"),
            None => model_name.to_string(),
        };
        out.cloned().unwrap_or_else(|| Path::new("out").join(name))
    }
}

/// Balls, pockets and rings of every ball bearing must not share space.
fn overlaps<'a>(
    bearings: impl Iterator<Item = (&'a str, &'a BallBearing)>,
    text: &str,
    sources: &[Source],
) -> Result<(), ModelErrors> {
    let mut diagnostics = Vec::new();
    for (name, ball) in bearings {
        let shapes = BearingShapes::new(&ball.geometry, ball.cage_pocket_diameter);
        let found = shapes.overlaps(&shapes.centred(ball.cage_angle), ELASTIC * ball.geometry.ball_diameter);
        let Some(worst) = found.iter().max_by(|a, b| a.depth.total_cmp(&b.depth)) else { continue };
        let more = match found.len() {
            1 => String::new(),
            n => format!(" (the deepest of {n} overlaps)"),
        };
        diagnostics.push(Diagnostic {
            kind: Kind::Geometry,
            source: 0,
            span: model::place_of(text, &["bearing", name]),
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
