//! The fit of `update`: free parameters fitted to what is measured, and what is written and printed of it.

use std::path::Path;

use rotordyn::document::Document;
use rotordyn::figures::{self, Named, Stage};
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured::test_data::TestData;
use rotordyn::io::model_file_edit::{self, Change};
use rotordyn::io::results_file;
use rotordyn::linalg::Complex64;
use rotordyn::model::{self, Model, Options};
use rotordyn::update::correlation::Correlation;
use rotordyn::update::frf::{FrfFitting, rms_difference_db};
use rotordyn::update::frf_scale::{FrfScale, common_scale};
use rotordyn::update::parameter::{FreeParameter, ModelNumber};
use rotordyn::update::residual::Fitting;
use rotordyn::update::{
    Findings, IdentifiabilityClass, Update, UpdateError, UpdateFailure, UpdateJob, update,
};

use super::args::{FitResidual, UpdateArgs};
use super::failure::Failure;
use super::machine::ModelSource;
use super::measured::{self, band};
use super::terminal::{Terminal, number};
use super::{ehl_films, free_parameters, update_findings, update_warnings};

/// Where models with other values come from.
pub struct UpdateContext<'a> {
    pub origin: &'a ModelSource,
    /// Folder for fields of EHL films that do not converge.
    pub folder: &'a Path,
    pub terminal: &'a Terminal,
}

impl UpdateContext<'_> {
    /// The model with its EHL film tables.
    pub fn with_films(&self, mut model: Model) -> Result<Model, Failure> {
        ehl_films::prepare_machine_films(&mut model, self.folder, self.terminal)?;
        Ok(model)
    }

    fn load(&self, set: &[(String, String)]) -> Result<Model, UpdateError> {
        let origin = self.origin;
        let mut options: Options = origin.options.clone();
        options.set.extend_from_slice(set);
        if self.terminal.stop.is_requested() {
            return Err(UpdateError::new("the update was stopped", "start it again"));
        }
        let changed = |e: &dyn std::fmt::Display| {
            let advice = "set --bounds that keep the free parameters valid";
            UpdateError::new(format!("{}: {e}", origin.name), advice)
        };
        let model = model::load(&origin.name, &origin.text, &options).map_err(|e| changed(&e))?.model;
        self.with_films(model).map_err(|e| changed(&e.message()))
    }
}

/// FRFs of a model at the measured points, `[response][reference][line]`, if FRFs were measured.
type Frfs = Option<Vec<Vec<Vec<Complex64>>>>;

/// A finished fit with what it was made of.
pub struct Fit {
    title: String,
    pub parameters: Vec<FreeParameter>,
    pub read: TestData,
    fitting: Fitting,
    iterations: usize,
    /// Parameters that are not free but could be.
    fixed: Vec<FreeParameter>,
    pub found: Update,
    before: Frfs,
    after: Frfs,
}

impl Fit {
    /// Fits the parameters; `title` is that of the model.
    ///
    /// # Errors
    /// FRFs to be fitted that are not measured, or a model that fails on the way.
    pub fn new(
        args: &UpdateArgs,
        context: &UpdateContext,
        title: String,
        parameters: Vec<FreeParameter>,
        read: TestData,
    ) -> Result<Self, Failure> {
        let fitting = fitting(args, band(&read.target));
        if fitting.frf.is_some() && read.target.frfs.is_none() {
            return Err(Failure::Input(if read.source.contains("FRF") {
                "--fit frf: the file's FRFs cannot be compared with the model's (see the warning); give the points and \
                 directions of responses and forces with --mapping, or leave frf out of --fit"
                    .into()
            } else {
                "--fit frf needs FRFs, but the measured file contains none; give FRFs (universal file dataset 58), or fit \
                 frequency, damping and mac"
                    .into()
            }));
        }
        let fixed = free_parameters::candidates(&parameters, context.origin)?;
        let bar = context.terminal.spinner("updating");
        let found = update(&UpdateJob {
            parameters: &parameters,
            target: &read.target,
            fitting: &fitting,
            load: &|set| context.load(set),
            max_iterations: args.iterations,
            fixed: &fixed,
        });
        bar.finish_and_clear();
        let found = context.terminal.unless_stopped(found)?;
        let frfs = |state| Ok::<_, UpdateFailure>(Correlation::new(&read.target, state)?.frfs);
        let (before, after) = (frfs(&found.before)?, frfs(&found.after)?);
        let iterations = args.iterations;
        Ok(Self { title, parameters, read, fitting, iterations, fixed, found, before, after })
    }

    /// Groups of parameters, profiles of those named, and culprits if the model does not explain the data.
    pub fn findings(&self, context: &UpdateContext, profile: &[String]) -> Result<Findings, Failure> {
        let job = UpdateJob {
            parameters: &self.parameters,
            target: &self.read.target,
            fitting: &self.fitting,
            load: &|set| context.load(set),
            max_iterations: self.iterations,
            fixed: &self.fixed,
        };
        let terminal = context.terminal;
        let found = update_findings::findings(terminal, &job, &self.found, profile);
        Ok(Findings { frf_scale: self.frf_scale(), ..terminal.unless_stopped(found)? })
    }

    /// Common scale of the FRFs, if they are fitted, by the model that shows it more clearly. That before has not taken it into its
    /// parameters yet; that after may be nearer.
    fn frf_scale(&self) -> Option<FrfScale> {
        let band = self.fitting.frf?.band;
        let stages = self.correlations();
        let found = stages.iter().filter_map(|stage| {
            let (measured, computed) = stage.measured_and_computed()?;
            common_scale(measured, computed, band)
        });
        found.min_by(|a, b| a.spread.total_cmp(&b.spread))
    }

    /// The measurement beside the model before and after.
    fn correlations(&self) -> [Correlation<'_>; 2] {
        let of = |state, frfs: &Frfs| Correlation { target: &self.read.target, state, frfs: frfs.clone() };
        [of(&self.found.before, &self.before), of(&self.found.after, &self.after)]
    }

    /// RMS difference of the FRFs before and after \[dB\].
    fn frf_difference_db(&self, [before, after]: &[Correlation; 2]) -> Option<[f64; 2]> {
        let difference = |stage: &Correlation| -> Option<f64> {
            let (measured, computed) = stage.measured_and_computed()?;
            Some(rms_difference_db(measured, computed, self.fitting.frf.as_ref()?))
        };
        Some([difference(before)?, difference(after)?])
    }

    /// What is written to files.
    pub fn document<'a>(&'a self, findings: &'a Findings) -> Document<'a> {
        let stages = self.correlations();
        let difference = self.frf_difference_db(&stages);
        let [before, after] = &stages;
        self.found.document(&self.parameters, findings, [before, after], difference)
    }

    /// Writes update.h5.
    pub fn write_results(&self, findings: &Findings, path: &Path) -> Result<(), Failure> {
        let store = Store::replace(path)?;
        results_file::write_document(&store, "", &self.document(findings))?;
        store.commit()?;
        Ok(())
    }

    pub fn figures(&self, findings: &Findings) -> Vec<Named> {
        let stages = [
            Stage { name: "before", state: &self.found.before, frfs: self.before.as_deref() },
            Stage { name: "after", state: &self.found.after, frfs: self.after.as_deref() },
        ];
        let mut out = figures::of_validation("update", &self.title, &self.read.target, &stages);
        let profiles =
            figures::of_update_profiles(&self.title, &self.found, &self.parameters, &findings.profiles);
        out.extend(profiles);
        out
    }

    /// Every updated number of the file, with its place there.
    pub fn changes(&self) -> Vec<(&ModelNumber, Change)> {
        let mut changes = Vec::new();
        for (parameter, outcome) in self.parameters.iter().zip(&self.found.outcomes) {
            if outcome.class == IdentifiabilityClass::NotIdentifiable {
                continue;
            }
            for place in &parameter.numbers {
                let value = parameter.value_of(place, outcome.x);
                let error = if parameter.logarithmic { outcome.error * value.abs() } else { outcome.error };
                changes.push((place, Change { path: place.path.clone(), value, error }));
            }
        }
        changes
    }

    /// Text of the model file with the updated values; the rest is unchanged.
    pub fn model_text(&self, origin: &ModelSource) -> Result<String, Failure> {
        let changes: Vec<Change> = self.changes().into_iter().map(|(_, change)| change).collect();
        let text = String::from_utf8_lossy(&origin.text);
        model_file_edit::rewrite(&text, origin.options.variant.as_deref(), &changes)
            .map_err(|e| Failure::Input(format!("{}: {e}", origin.name)))
    }

    /// Warns about pairs of modes that may be none, and about fitted shapes of low weight.
    pub fn pair_warnings(&self, terminal: &Terminal) -> Result<(), Failure> {
        measured::pair_warnings(terminal, &self.read.target, &self.found.after)?;
        if let Some(least) = self.fitting.shape {
            let modes = self.found.fitted_modes.iter().map(|&k| &self.read.target.modes[k]);
            update_warnings::warn_of_uncertain_shapes(terminal, modes, least);
        }
        Ok(())
    }

    /// Warnings of the fit and of what was found of it.
    pub fn warn(&self, terminal: &Terminal, findings: &Findings) {
        update_warnings::warn(terminal, &self.parameters, &self.read.target, &self.found, findings);
    }

    /// Tables of the fit, and warnings about its pairs of modes.
    pub fn print(&self, terminal: &Terminal) -> Result<(), Failure> {
        let (found, target) = (&self.found, &self.read.target);
        parameter_table(terminal, &self.parameters, found);
        singular_table(terminal, &self.parameters, found);
        measured::mode_table(terminal, "Modes before", target, &found.before);
        measured::mode_table(terminal, "Modes after", target, &found.after);
        self.pair_warnings(terminal)?;
        let stages = self.correlations();
        if let Some([before, now]) = self.frf_difference_db(&stages) {
            measured::frf_level_tables(terminal, &stages[1]);
            terminal.print(&format!(
                "\nFRF difference {} dB after the update, {} dB before (RMS over the fitted frequency lines)",
                number(now, 2),
                number(before, 2)
            ));
        }
        update_findings::print_fit(terminal, found);
        Ok(())
    }
}

fn fitting(args: &UpdateArgs, band: [f64; 2]) -> Fitting {
    let is_fitted = |word: FitResidual| args.fit.contains(&word);
    let standard = Fitting::default();
    let frf = |complex| FrfFitting { deviation: 0.01 * args.frf_accuracy, ..FrfFitting::new(complex, band) };
    Fitting {
        frequency: is_fitted(FitResidual::Frequency).then_some(0.01 * args.frequency_accuracy),
        damping: is_fitted(FitResidual::Damping).then_some(0.1),
        shape: is_fitted(FitResidual::Mac).then_some(standard.shape.unwrap_or(0.05)),
        frf: if is_fitted(FitResidual::FrfComplex) {
            Some(frf(true))
        } else {
            is_fitted(FitResidual::Frf).then(|| frf(false))
        },
    }
}

fn value(parameter: &FreeParameter, x: f64) -> String {
    format!("{} {}", number(parameter.value(x), 5), parameter.unit()).trim_end().to_string()
}

/// Standard error of a parameter in per cent of its value.
fn error_per_cent(parameter: &FreeParameter, x: f64, error: f64) -> f64 {
    100.0 * (error * parameter.derivative(x) / parameter.value(x)).abs()
}

fn parameter_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let rows: Vec<Vec<String>> = parameters
        .iter()
        .zip(&found.outcomes)
        .map(|(p, o)| {
            vec![
                p.name.clone(),
                value(p, 0.0),
                value(p, o.x),
                format!("{:+.1}", 100.0 * (p.value(o.x) / p.value(0.0) - 1.0)),
                number(error_per_cent(p, o.fitted, o.error), 2),
                number(100.0 * o.prior_share, 2),
                o.class.label().into(),
            ]
        })
        .collect();
    let header = [
        "parameter",
        "start",
        "updated",
        "change %",
        "standard error %",
        "prior variance left %",
        "identifiability",
    ];
    terminal.table("Free parameters", &header, &rows);
    terminal.print(
        "  prior variance left = posterior variance / prior variance. Identifiable: at most 10 % left and a standard\n  \
         error of at most 10 %; poorly identifiable: at most 50 % left; otherwise not identifiable, start value kept",
    );
    if found.outcomes.iter().any(|outcome| outcome.fixed.depends_on.is_some()) {
        terminal.print(
            "  depends on a fixed value: the data would change a parameter that is not free, and this value with it by more\n  \
             than one standard error",
        );
    }
    if found.outcomes.iter().any(|outcome| outcome.class == IdentifiabilityClass::InseparableFromFixed) {
        terminal.print(
            "  inseparable from a fixed value: identifiable only if a parameter that is not free is exact; if it were free too,\n  \
             the standard error would be many times that large",
        );
    }
    if found.goodness.is_rejected() {
        terminal.print(
            "  poor fit: the model does not explain the data, so that no parameter is identified; the standard errors do not\n  \
             cover that error",
        );
    }
}

fn singular_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let identifiability = &found.identifiability;
    let rows: Vec<Vec<String>> = identifiability
        .singular_values
        .iter()
        .zip(&identifiability.directions)
        .map(|(sigma, direction)| {
            let mut parts: Vec<(f64, &str)> =
                direction.iter().zip(parameters).map(|(v, p)| (*v, p.name.as_str())).collect();
            parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
            let turn = if parts.first().is_some_and(|p| p.0 < 0.0) { -1.0 } else { 1.0 };
            let words: Vec<String> = parts
                .iter()
                .filter(|p| p.0.abs() > 0.15)
                .map(|(v, name)| format!("{:+.2} {name}", turn * v))
                .collect();
            vec![number(*sigma, 3), words.join(" ")]
        })
        .collect();
    let header = ["sigma", "direction"];
    terminal.table(
        "Singular values of the scaled sensitivity matrix (below 1: the prior dominates the data)",
        &header,
        &rows,
    );
}
