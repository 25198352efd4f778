//! Summary and spectra of a run-up as data sets.

use super::GroupWriter;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::results::{
    CagePhaseBand, CagePhaseLine, ChannelPair, History, OrderResult, RunUpResult, SpectrogramResult,
    StepErrorLine,
};
use rotordyn_core::transient::run::End;
use rotordyn_signal::segment::Level;

pub fn summary(store: &Store, found: &RunUpResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/run_up")?;
    let (report, energy) = (&found.report, &found.report.energy);
    let end = match &report.end {
        End::Complete => "complete".to_string(),
        End::Stopped => "stopped".to_string(),
        End::Failed(error) => format!("failed: {error}"),
    };
    writer.set_attribute("end", end)?;
    for (name, value) in [
        ("reduced_modes", found.modes as i64),
        ("static_correction_modes", found.corrections as i64),
        ("samples", report.samples as i64),
        ("steps", report.steps as i64),
        ("iterations", report.iterations as i64),
        ("halvings", report.halvings as i64),
    ] {
        writer.set_attribute(name, value)?;
    }
    for (name, value) in [
        ("requested_step", found.requested_step),
        ("static_error", found.static_error),
        ("frequency_error", found.frequency_error),
        ("energy_work", energy.work),
        ("energy_drive_work", energy.drive),
        ("energy_parametric_work", energy.parametric),
        ("energy_damping_loss", energy.damping_loss),
        ("energy_contact_loss", energy.contact_loss),
        ("energy_residual", energy.residual()),
    ] {
        writer.set_attribute(name, value)?;
    }
    if let Some(step) = report.step {
        writer.set_attribute("step", step)?;
    }
    for (bearing, angle) in &found.cage_angles {
        writer.set_attribute(&format!("initial_cage_angle_{bearing}"), *angle)?;
    }
    let Some(error) = &found.step_error else { return Ok(()) };
    let writer = GroupWriter::new(store, "/run_up/step_error")?;
    for (name, value) in [
        ("start", error.stretch[0]),
        ("end", error.stretch[1]),
        ("speed", error.speed),
        ("share_of_steps", error.cost),
    ] {
        writer.set_attribute(name, value)?;
    }
    let (lines, count) = (&error.lines, error.lines.len());
    let texts = |pick: fn(&StepErrorLine) -> &str| lines.iter().map(pick).collect::<Vec<_>>();
    let values = |pick: fn(&StepErrorLine) -> f64| lines.iter().map(pick).collect::<Vec<_>>();
    writer.write_texts("channel", &[count], &texts(|l| &l.channel))?;
    writer.write_texts("label", &[count], &texts(|l| &l.line.label))?;
    writer.write_array("order", &[count], &values(|l| l.line.order), "1/revolution")?;
    writer.write_array("relative_error", &[count], &values(|l| l.error), "1")
}

/// Ranges of the order cuts over the initial cage phases.
pub fn cage_phases(store: &Store, found: &CagePhaseBand) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/run_up/cage_phases")?;
    let bearings: Vec<&str> = found.bearings.iter().map(String::as_str).collect();
    writer.write_texts("bearing", &[bearings.len()], &bearings)?;
    let angles: Vec<f64> = found.angles.iter().flatten().copied().collect();
    writer.write_array("angle", &[found.angles.len(), bearings.len()], &angles, "rad")?;
    for channel in &found.channels {
        let Some(first) = channel.lines.first() else { continue };
        let writer = GroupWriter::new(store, &format!("/run_up/cage_phases/{}", channel.channel))?;
        let (count, windows) = (channel.lines.len(), first.cut.rpm.len());
        let all = |pick: fn(&CagePhaseLine) -> &[f64]| {
            channel.lines.iter().flat_map(|l| pick(l).iter().copied()).collect::<Vec<_>>()
        };
        let labels: Vec<&str> = channel.lines.iter().map(|l| l.line.label.as_str()).collect();
        writer.write_texts("label", &[count], &labels)?;
        writer.write_array("rpm", &[windows], &first.cut.rpm, "rpm")?;
        writer.write_array("rms", &[count, windows], &all(|l| &l.cut.rms), &channel.unit)?;
        writer.write_array("minimum", &[count, windows], &all(|l| &l.minimum), &channel.unit)?;
        writer.write_array("maximum", &[count, windows], &all(|l| &l.maximum), &channel.unit)?;
    }
    Ok(())
}

/// `root` is empty, or the group that the spectra belong to.
pub fn spectrogram(store: &Store, root: &str, found: &SpectrogramResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, &format!("{root}/spectra/{}/spectrogram", found.channel))?;
    let s = &found.spectrogram;
    let rpm: Vec<f64> = found.speed.iter().map(|w| w * 60.0 / std::f64::consts::TAU).collect();
    let (frames, bins) = (s.times.len(), s.frequencies.len());
    writer.set_attribute("level", level(s.level))?;
    writer.set_attribute("noise_bandwidth_bins", s.noise_bandwidth_bins)?;
    writer.write_array("amplitude", &[frames, bins], &s.amplitude, &found.unit)?;
    writer.write_array("rpm", &[frames], &rpm, "rpm")?;
    writer.write_array("time", &[frames], &s.times, "s")?;
    writer.write_array("frequency", &[bins], &s.frequencies, "Hz")?;
    writer.attach_scale("amplitude", 0, "rpm")?;
    writer.attach_scale("amplitude", 0, "time")?;
    writer.attach_scale("amplitude", 1, "frequency")
}

pub fn orders(store: &Store, root: &str, found: &OrderResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, &format!("{root}/spectra/{}/orders", found.channel))?;
    let s = &found.spectrogram;
    let (windows, bins) = (s.times.len(), s.orders.len());
    writer.set_attribute("level", level(s.level))?;
    writer.set_attribute("noise_bandwidth_bins", s.noise_bandwidth_bins)?;
    writer.write_array("amplitude", &[windows, bins], &s.amplitude, &found.unit)?;
    writer.write_array("rpm", &[windows], &s.rpm, "rpm")?;
    writer.write_array("time", &[windows], &s.times, "s")?;
    writer.write_array("order", &[bins], &s.orders, "1/revolution")?;
    writer.attach_scale("amplitude", 0, "rpm")?;
    writer.attach_scale("amplitude", 0, "time")?;
    writer.attach_scale("amplitude", 1, "order")?;
    if found.cuts.is_empty() {
        return Ok(());
    }
    let rms: Vec<f64> = found.cuts.iter().flat_map(|(_, cut)| cut.rms.iter().copied()).collect();
    let labels: Vec<&str> = found.cuts.iter().map(|(line, _)| line.label.as_str()).collect();
    let orders: Vec<f64> = found.cuts.iter().map(|(_, cut)| cut.order).collect();
    writer.write_array("cuts/rms", &[labels.len(), windows], &rms, &found.unit)?;
    writer.attach_scale("cuts/rms", 1, "rpm")?;
    writer.write_texts("cuts/label", &[labels.len()], &labels)?;
    writer.write_array("cuts/order", &[labels.len()], &orders, "1/revolution")
}

/// Measured and computed run as two groups, each with its channels over time and their spectra.
pub fn run_up_correlation(store: &Store, pairs: &[ChannelPair], runs: [&History; 2]) -> Result<(), Error> {
    for (k, (name, run)) in ["/measured", "/computed"].iter().zip(runs).enumerate() {
        let writer = GroupWriter::new(store, name)?;
        let count = run.time.len();
        writer.set_attribute("sample_rate", run.sample_rate)?;
        writer.write_array("time/t", &[count], &run.time, "s")?;
        writer.write_array("time/theta", &[count], &run.angle, "rad")?;
        writer.write_array("time/speed", &[count], &run.speed, "rad/s")?;
        for pair in pairs {
            if let Some(channel) = run.channels.iter().find(|c| c.name == pair.channel) {
                writer.write_array(
                    &format!("channels/{}", pair.channel),
                    &[count],
                    &channel.values,
                    &pair.unit,
                )?;
            }
            spectrogram(store, name, &pair.spectrograms[k])?;
            orders(store, name, &pair.orders[k])?;
        }
    }
    Ok(())
}

fn level(level: Level) -> &'static str {
    match level {
        Level::Peak => "peak",
        Level::Rms => "RMS",
    }
}
