//! One record of a trend: read, analysed, and reduced to its state before the next is read.

use std::f64::consts::TAU;

use rotordyn::results::{BearingWithOrders, LineLevel, SignalResult, TrendRecord};
use rotordyn::signal::diagnosis::BandRule;
use rotordyn::study::signal::{Analysis, AnalysisSelection, SignalChannel, SignalSettings, dead_text};
use rotordyn::study::trend::{line_levels, record_state};
use rotordyn::warning::Code;

use super::super::failure::Failure;
use super::super::signal::channel::analyse_channel;
use super::super::signal::input::{self, ChannelSelection, File, InputProblems, plain_name};
use super::super::signal::shaft_source::ShaftSource;
use super::args::TrendArgs;
use super::files::Source;

/// What holds for all records.
pub struct Job<'a> {
    pub args: &'a TrendArgs,
    pub bearing: Option<BearingWithOrders>,
    pub settings: SignalSettings,
    pub rms_bands: Vec<[f64; 2]>,
    /// Number of the files that is the axis.
    pub number: Option<String>,
}

/// A record and what its file states.
pub struct Analysed {
    pub record: TrendRecord,
    /// As written in the file; empty without one.
    pub date: String,
    /// The number that is the axis, and the names of all of them.
    pub number: Option<f64>,
    pub number_names: Vec<String>,
    /// Contents of the file that were not read.
    pub left_out: Option<String>,
    pub warnings: Vec<String>,
    /// Gaps, absurd samples and a limit of the channel.
    pub dropouts: Vec<(Code, String)>,
    /// Whether the shaft speed was searched in the record and not found.
    pub speed_not_found: bool,
    pub failure: Option<Failure>,
}

/// The channel of a file with its shaft.
struct Opened {
    file: File,
    channel: SignalChannel,
    shaft: ShaftSource,
    warnings: Vec<String>,
}

impl Job<'_> {
    /// Reads and analyses a record; `speed` \[rad/s\] if one is given.
    pub fn analyse(&self, source: &Source, speed: Option<f64>) -> Analysed {
        let mut out = Analysed {
            record: TrendRecord { name: source.name.clone(), position: f64::NAN, state: None, problem: None },
            date: String::new(),
            number: None,
            number_names: Vec::new(),
            left_out: None,
            warnings: Vec::new(),
            dropouts: Vec::new(),
            speed_not_found: false,
            failure: None,
        };
        if let Err(failure) = self.analyse_into(source, speed, &mut out) {
            out.record.problem = Some(failure.message());
            out.failure = Some(failure.of_file(&source.path));
        }
        out
    }

    fn analyse_into(&self, source: &Source, speed: Option<f64>, out: &mut Analysed) -> Result<(), Failure> {
        let Opened { file, channel, shaft, warnings } = self.open(source, speed)?;
        out.left_out = file.measured.left_out_text();
        let is_missing_rate = |note: &String| note.starts_with("no sampling rate");
        let notes = file
            .measured
            .notes
            .iter()
            .filter(|note| self.args.record.rate.is_none() || !is_missing_rate(note));
        out.warnings = notes.cloned().chain(warnings).collect();
        let own = file.measured.records.iter().find(|r| r.name == channel.name);
        out.date = own.map(|r| r.date.clone()).unwrap_or_default();
        let plain = |name: &str| name.rsplit('.').next().unwrap_or(name).to_lowercase();
        if let Some(wanted) = &self.number {
            let scalars = &file.measured.scalars;
            let exact = scalars.iter().find(|(name, _)| name == wanted);
            let found =
                exact.or_else(|| scalars.iter().find(|(name, _)| plain(name) == wanted.to_lowercase()));
            out.number = found.map(|(_, value)| *value).filter(|value| value.is_finite());
            out.number_names = scalars.iter().map(|(name, _)| name.clone()).take(MAX_NUMBERS).collect();
        }
        if !file.stored_run {
            // A dead sensor has no state: levels of zero are no healthy machine.
            if let Some(reason) = dead_text(&channel.samples) {
                return Err(Failure::Input(format!("`{}`: {reason}", channel.name)));
            }
            out.dropouts = input::dropout_texts(&channel);
            out.dropouts.extend(input::clipping_text(&channel).map(|text| (Code::ClippedRecord, text)));
        }
        drop(file);
        let judged = match &self.bearing {
            Some(_) if !shaft.is_known() => Err(Failure::Input(
                "no bearing diagnosis: the file does not state the shaft speed; give --speed, such as \"1797 rpm\"".into(),
            )),
            bearing => analyse_channel(&channel, &shaft, bearing.as_ref(), &self.settings),
        };
        let (found, failure) = match judged {
            Ok(found) => (found, None),
            // Its statistics need neither speed nor bearing.
            Err(failure) => {
                let none =
                    SignalSettings { analyses: AnalysisSelection::Only(Vec::new()), ..self.settings.clone() };
                (analyse_channel(&channel, &ShaftSource::Unknown, None, &none)?, Some(failure))
            }
        };
        out.warnings.extend(found.warnings.iter().cloned());
        out.speed_not_found = found.unconfirmed_speed().is_some();
        let mut state = record_state(&found, &self.rms_bands)?;
        if let (Some(diagnosis), Some(BandRule::Given(..) | BandRule::Whole)) =
            (&mut state.diagnosis, self.settings.band)
        {
            diagnosis.lines = line_levels(&found);
        }
        out.record.state = Some(state);
        match failure {
            Some(failure) => Err(failure),
            None => Ok(()),
        }
    }

    /// Line levels of a record in a band; `None` if the record does not contain it or the file has changed since.
    pub fn line_levels(
        &self,
        source: &Source,
        speed: Option<f64>,
        band: (f64, f64),
    ) -> Option<[LineLevel; 4]> {
        let Opened { channel, shaft, .. } = self.open(source, speed).ok()?;
        if band.1 > 0.5 * channel.sample_rate * (1.0 + 1e-12) {
            return None;
        }
        let settings =
            SignalSettings { band: Some(BandRule::Given(band.0, band.1)), ..self.settings.clone() };
        let found: SignalResult = analyse_channel(&channel, &shaft, self.bearing.as_ref(), &settings).ok()?;
        line_levels(&found)
    }

    /// Reads the file of a record.
    fn open(&self, source: &Source, speed: Option<f64>) -> Result<Opened, Failure> {
        let args = self.args;
        let file = File::read(&source.path, args.record.rate.as_deref())?;
        let mut findings = InputProblems::default();
        let tacho: Vec<&str> = args.shaft.tacho.as_deref().into_iter().collect();
        let names: Vec<String> = args.channel.iter().map(|name| channel_name(&file, name)).collect();
        let choice = ChannelSelection {
            names: &names,
            excluded: &tacho,
            quadrature: None,
            rate: args.record.rate.as_deref(),
            unit: args.record.unit.as_deref(),
            time: args.record.time.as_deref(),
            flag_prefix: "--",
        };
        let channels = input::channels(&file, &choice, &mut findings);
        let shaft = match speed {
            Some(speed) => ShaftSource::Steady(speed / TAU, "as given".into()),
            None => ShaftSource::of(&args.shaft, args.record.rate.as_deref(), &file, &mut findings),
        };
        findings.to_result()?;
        let Some(channel) = channels.into_iter().next() else {
            return Err(Failure::Input("the file contains no vibration channel".into()));
        };
        let mut warnings = findings.warnings;
        warnings.extend(findings.coded.into_iter().map(|(_, text)| text));
        Ok(Opened { file, channel, shaft, warnings })
    }
}

/// Most names of numbers of a file that are kept.
const MAX_NUMBERS: usize = 64;

/// The analyses of every record.
pub fn analyses(bearing: Option<&BearingWithOrders>) -> AnalysisSelection {
    AnalysisSelection::Only(bearing.map(|_| Analysis::Envelope).into_iter().collect())
}

/// The channel's name in this file, which may have the number of the record in front.
fn channel_name(file: &File, wanted: &str) -> String {
    let names = || file.measured.records.iter().map(|r| &r.name);
    let plain = || names().find(|name| plain_name(name) == plain_name(wanted));
    names().find(|name| *name == wanted).or_else(plain).cloned().unwrap_or_else(|| wanted.to_string())
}
