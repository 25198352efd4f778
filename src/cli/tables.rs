//! Tables of study results on the terminal.

use rotordyn::analysis::Mode;
use rotordyn::analysis::critical_speed::CriticalSpeed;
use rotordyn::analysis::equilibrium::{CageTreatment, Equilibrium};
use rotordyn::analysis::unbalance::Orbit;
use rotordyn::linalg::Complex64;
use rotordyn::model::Model;
use rotordyn::results::{
    CampbellResult, CriticalResult, FrfResult, ModalResult, OrderResult, RunUpResult, SpectrogramResult,
    UnbalanceResult, UndampedPeak, is_rotation, unit_of,
};
use rotordyn::series::SeriesError;
use rotordyn::study::Machine;

use super::equilibrium_loads;
use super::printed;
use super::rotor_tables;
use super::terminal::{Terminal, counted, number, rpm};
use super::unbalance_tables;

/// Largest number of rows printed; the rest is in results.h5.
const MAX_ROWS: usize = 40;

pub fn equilibrium(terminal: &Terminal, found: &Equilibrium) {
    let cage = match found.cage {
        CageTreatment::FixedAngle => "at the cage angle of the model",
        CageTreatment::Averaged => "averaged over the cage angle",
    };
    equilibrium_loads::belts(terminal, &found.belts);
    equilibrium_loads::preloads(terminal, &found.preloads);
    equilibrium_loads::shaft(terminal, found);
    if found.bearings.is_empty() {
        terminal.heading("Static equilibrium: the machine has only joints and springs, no bearings");
        return;
    }
    let rows: Vec<Vec<String>> = found
        .bearings
        .iter()
        .map(|b| {
            let mut row = vec![b.name.clone()];
            row.extend(b.force[..5].iter().map(|f| number(*f, 4)));
            row.extend(b.displacement[..3].iter().map(|d| format!("{:.2}", 1e6 * d)));
            row
        })
        .collect();
    terminal.table(
        &format!("Bearing forces on the shaft at {:.0} rpm, {cage}", rpm(found.speed)),
        &["bearing", "F_x N", "F_y N", "F_z N", "M_x N m", "M_y N m", "u_x um", "u_y um", "u_z um"],
        &rows,
    );
    let rows: Vec<Vec<String>> = found
        .bearings
        .iter()
        .map(|b| {
            let mut row = vec![b.name.clone()];
            row.extend((0..5).map(|k| number(b.tangent.stiffness[k][k], 4)));
            row
        })
        .collect();
    let header = ["bearing", "k_xx N/m", "k_yy N/m", "k_zz N/m", "k_tilt,x N m/rad", "k_tilt,y N m/rad"];
    terminal.table("Bearing stiffness (diagonal; full matrix in results.h5)", &header, &rows);
    let rows: Vec<Vec<String>> = found
        .bearings
        .iter()
        .flat_map(|b| {
            b.balls.iter().enumerate().filter(|(_, ball)| ball.load > 0.0).map(|(j, ball)| {
                vec![
                    b.name.clone(),
                    (j + 1).to_string(),
                    format!("{:.1}", ball.position.to_degrees()),
                    number(ball.load, 4),
                    format!("{:.2}", ball.contact_angle.to_degrees()),
                    format!("{:.3}", 1e6 * ball.deflection),
                    number(b.largest_ball_load, 4),
                ]
            })
        })
        .collect();
    if !rows.is_empty() {
        let header =
            ["bearing", "ball", "position deg", "load N", "contact angle deg", "deflection um", "max load N"];
        terminal.table(
            "Loaded balls at the cage angle of the model; max load over all cage angles",
            &header,
            &rows,
        );
    }
}

pub fn modes(terminal: &Terminal, found: &[ModalResult], model: &Model) {
    for at in found {
        let rigid = at.rigid_body_modes.iter().map(|motion| {
            let cells = ["-", "0.000", "0.0", "-", "-", "rigid body", motion, ""];
            cells.map(String::from).to_vec()
        });
        let elastic = at.modes.iter().enumerate().map(|(k, mode)| {
            vec![
                (k + 1).to_string(),
                format!("{:.3}", mode.frequency_hz()),
                format!("{:.1}", rpm(mode.omega())),
                format!("{:.3}", 100.0 * mode.zeta()),
                format!("{:.4}", mode.log_dec()),
                mode.kind.name().to_string(),
                mode.label.clone(),
                energy_shares(mode, model),
            ]
        });
        let rows: Vec<Vec<String>> = rigid.chain(elastic).collect();
        let header = ["no", "Hz", "rpm", "zeta %", "log dec", "kind", "label", "energy %"];
        terminal.table(&format!("Modes at {:.0} rpm", rpm(at.speed)), &header, &rows);
    }
}

/// The two largest shares of the kinetic energy of a mode, in per cent.
fn energy_shares(mode: &Mode, model: &Model) -> String {
    let e = &mode.energy;
    let shaft = [("x", e.bending_x), ("y", e.bending_y), ("axial", e.axial), ("torsion", e.torsion)];
    let mut all: Vec<(&str, f64)> = shaft.to_vec();
    let bodies = model.bodies.iter().zip(&e.bodies);
    all.extend(bodies.map(|(body, by_direction)| (body.name.as_str(), by_direction.iter().sum())));
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let shown = all.iter().take(2).filter(|(_, share)| *share >= 0.01);
    shown.map(|(name, share)| format!("{name} {:.0}", 100.0 * share)).collect::<Vec<_>>().join(", ")
}

pub fn campbell(terminal: &Terminal, found: &CampbellResult) {
    let diagram = &found.diagram;
    let (Some(first), Some(last)) = (diagram.speeds.first(), diagram.speeds.last()) else { return };
    let hz = |mode: Option<&Mode>| mode.map_or("-".into(), |m| format!("{:.3}", m.frequency_hz()));
    let rows: Vec<Vec<String>> = diagram
        .branches
        .iter()
        .map(|branch| {
            let end = branch.modes.last().and_then(Option::as_ref);
            let name = match end {
                Some(end) if end.label != branch.label => format!("{} -> {}", branch.label, end.label),
                _ => branch.label.clone(),
            };
            vec![
                name,
                hz(branch.modes.first().and_then(Option::as_ref)),
                hz(end),
                end.map_or("-".into(), |m| format!("{:.3}", 100.0 * m.zeta())),
            ]
        })
        .collect();
    let (from, to) = (format!("Hz at {:.0} rpm", rpm(*first)), format!("Hz at {:.0} rpm", rpm(*last)));
    let zeta = format!("zeta % at {:.0} rpm", rpm(*last));
    let header = ["mode", from.as_str(), to.as_str(), zeta.as_str()];
    terminal.table(&format!("Campbell diagram over {} speeds", diagram.speeds.len()), &header, &rows);
    if !found.crossings.list.is_empty() {
        crossings(terminal, "Crossings with order lines", &found.crossings.list);
    }
    let count = diagram.branches.len();
    for (order, modes) in &found.crossings.omitted {
        terminal.print(&format!(
            "  order {}: {modes} more modes lie below the line at {:.0} rpm than the {count} of this diagram;\n  \
             raise 'modes' or use 'critical', which lists all crossings",
            order_text(*order),
            rpm(*last)
        ));
    }
    rotor_tables::stability(terminal, found);
    for threshold in &found.thresholds {
        let side = if threshold.unstable_above { "above" } else { "below" };
        terminal.print(&format!(
            "  {} is unstable {side} {:.1} rpm",
            threshold.mode.label,
            rpm(threshold.speed)
        ));
    }
}

pub fn critical(terminal: &Terminal, found: &CriticalResult) {
    let title = format!("Critical speeds up to {:.0} rpm", rpm(found.max_speed));
    let speeds = &found.crossings.list;
    if speeds.is_empty() {
        terminal.heading(&format!("{title}: none"));
    } else {
        crossings(terminal, &title, speeds);
    }
}

fn crossings(terminal: &Terminal, title: &str, found: &[CriticalSpeed]) {
    let rows: Vec<Vec<String>> = found
        .iter()
        .take(MAX_ROWS)
        .map(|c| {
            vec![
                format!("{:.2}", rpm(c.speed)),
                format!("{:.3}", c.mode.frequency_hz()),
                order_text(c.order),
                c.mode.kind.name().to_string(),
                format!("{:.3}", 100.0 * c.mode.zeta()),
                format!("{:.4}", c.mode.log_dec()),
                c.mode.label.clone(),
            ]
        })
        .collect();
    terminal.table(title, &["rpm", "Hz", "order", "whirl", "zeta %", "log dec", "mode"], &rows);
    print_omitted_count(terminal, found.len());
}

/// An order without trailing zeros.
fn order_text(order: f64) -> String {
    number(order, 4).trim_end_matches('0').trim_end_matches('.').to_string()
}

fn print_omitted_count(terminal: &Terminal, count: usize) {
    if count > MAX_ROWS {
        terminal.print(&format!("  ... and {} more in results.h5", count - MAX_ROWS));
    }
}

pub fn frf(terminal: &Terminal, found: &FrfResult, machine: &Machine) {
    let frequencies = &found.frf.frequencies;
    let mut rows = Vec::new();
    for (r, response) in found.responses.iter().enumerate() {
        for (e, excitation) in found.excitations.iter().enumerate().filter(|(e, _)| found.is_coupled(r, *e)) {
            let size = |k: &usize| found.frf.values[r][e][*k].norm();
            let Some(peak) = (0..frequencies.len()).max_by(|a, b| size(a).total_cmp(&size(b))) else {
                continue;
            };
            let pair = format!("{response}/{excitation}");
            let infinite = infinite_at(&found.undamped, &pair, |hz| number(hz, 6));
            let [at, height] =
                infinite.unwrap_or_else(|| [number(frequencies[peak], 6), number(size(&peak), 4)]);
            rows.push(vec![
                machine.excitation_label(excitation),
                response.clone(),
                at,
                height,
                found.units[r][e].clone(),
            ]);
        }
    }
    let count = rows.len();
    rows.truncate(MAX_ROWS);
    let (given, added) = points_text(found.requested.len(), frequencies.len());
    let title = format!("{} at {:.0} rpm, {given} frequencies{added}: peaks", found.name(), rpm(found.speed));
    terminal.table(&title, &["excitation", "response", "peak Hz", "peak magnitude", "unit"], &rows);
    print_omitted_count(terminal, count);
}

/// Number of the given points of a grid, and the note on those added at resonances.
fn points_text(given: usize, all: usize) -> (usize, String) {
    (given, if all > given { format!(" and {} at resonances", all - given) } else { String::new() })
}

/// Where a response is infinite, and that it is; `None` without an undamped mode in it.
fn infinite_at(
    undamped: &[UndampedPeak],
    response: &str,
    text: impl Fn(f64) -> String,
) -> Option<[String; 2]> {
    let at: Vec<String> = UndampedPeak::of(undamped, response).map(text).collect();
    (!at.is_empty()).then(|| [at.join(", "), "infinite".into()])
}

pub fn unbalance(terminal: &Terminal, found: &UnbalanceResult) {
    let speeds = &found.speeds;
    let peak = |sizes: Vec<f64>| {
        let at = (0..sizes.len()).max_by(|a, b| sizes[*a].total_cmp(&sizes[*b]))?;
        Some((rpm(*speeds.get(at)?), sizes[at], at))
    };
    let largest = |name: &str, speed: f64, size: f64| {
        let infinite = infinite_at(&found.undamped, name, |at| format!("{:.1}", rpm(at)));
        infinite.unwrap_or_else(|| [format!("{speed:.1}"), number(size, 4)])
    };
    let mut rows = Vec::new();
    for channel in &found.channels {
        let sizes = channel.amplitude.iter().map(|[re, im]| re.hypot(*im)).collect();
        if let Some((speed, size, _)) = peak(sizes) {
            let unit = unit_of(channel.probe.quantity, is_rotation(&channel.probe.direction));
            let name = channel.probe.name.clone();
            let [at, size] = largest(&name, speed, size);
            rows.push(vec![name, at, size, unit.into()]);
        }
    }
    for disc in &found.orbits {
        let orbit = |k: usize| {
            let complex = |[re, im]: [f64; 2]| Complex64::new(re, im);
            Orbit::new(complex(disc.x[k]), complex(disc.y[k]))
        };
        if let Some((speed, size, k)) = peak((0..disc.x.len()).map(|k| orbit(k).major).collect()) {
            let whirl = if orbit(k).minor < 0.0 { "backward" } else { "forward" };
            let name = format!("orbit of disc.{}", disc.name);
            let [at, size] = largest(&name, speed, size);
            rows.push(vec![format!("{name} ({whirl})"), at, size, "m".into()]);
        }
    }
    let (given, added) = points_text(found.requested.len(), speeds.len());
    let title = format!("Unbalance response (1x) over {given} speeds{added}: peak amplitudes");
    terminal.table(&title, &["response", "at rpm", "amplitude", "unit"], &rows);
    unbalance_peaks(terminal, found);
    unbalance_tables::margins(terminal, found);
    unbalance_tables::bearing_forces(terminal, found);
    unbalance_tables::shaft(terminal, found);
}

/// Resonance peaks with amplification factors and separation margins.
fn unbalance_peaks(terminal: &Terminal, found: &UnbalanceResult) {
    if found.peaks.is_empty() {
        return;
    }
    let text = |value: Option<f64>, digits: usize| value.map_or("-".into(), |v| format!("{v:.digits$}"));
    let percent = |value: Option<f64>| text(value.map(|v| 100.0 * v), 1);
    let mut rows: Vec<Vec<String>> = found
        .peaks
        .iter()
        .map(|p| {
            let peak = &p.peak;
            let half_power = peak.half_power.map(|ends| ends.map(rpm));
            let mut row = vec![
                p.response.clone(),
                format!("{:.1}", rpm(peak.at)),
                number(peak.amplitude, 4),
                p.unit.clone(),
                text(peak.amplification(), 2),
                half_power.map_or("-".into(), |[low, high]| format!("{low:.1} to {high:.1}")),
            ];
            if let Some(speed) = found.operating_speeds {
                row.push(percent(Some(peak.separation(speed))));
                row.push(percent(peak.required_separation(speed)));
            }
            row
        })
        .collect();
    let count = rows.len();
    rows.truncate(MAX_ROWS);
    let mut header = vec!["response", "peak rpm", "amplitude", "unit", "AF", "half power rpm"];
    if found.operating_speeds.is_some() {
        header.extend(["margin %", "required %"]);
    }
    terminal.table("Resonance peaks: amplification factor AF", &header, &rows);
    print_omitted_count(terminal, count);
}

/// `needed`: time \[s\] and turns of the shaft that the estimate of the step's error needs.
pub fn run_up(terminal: &Terminal, found: &RunUpResult, check_seconds: f64, needed: (f64, f64)) {
    let (report, history, summary) = (&found.report, &found.history, &found.summary);
    terminal.heading("Run-up");
    let newton = match report.iterations {
        0 => String::new(),
        n => format!(", {:.2} Newton iterations per step", n as f64 / report.steps.max(1) as f64),
    };
    terminal.print(&format!(
        "  {:.3} s simulated up to {:.1} rpm: {} steps{newton}, {} halved or rejected steps, {} samples",
        summary.end_time,
        rpm(summary.fastest()),
        report.steps,
        report.halvings,
        report.samples
    ));
    super::run_up_tables::step_and_cages(terminal, found, check_seconds, needed);
    terminal.print(&format!(
        "  reduced model: {} modes and {} static correction modes; relative error {:.1e} of the static deflection,\n  \
         {:.1e} of the frequencies up to half the cutoff",
        found.modes, found.corrections, found.static_error, found.frequency_error
    ));
    let e = &report.energy;
    let driven = e.drive != 0.0;
    let rows: Vec<Vec<String>> = [
        (if driven { "work of loads" } else { "work of loads, unbalance and drive" }, e.work),
        ("work of the drive torque", e.drive),
        ("parametric work (cage rotation, cross-coupling)", e.parametric),
        ("dissipated by damping", -e.damping_loss),
        ("dissipated in bearings", -e.contact_loss),
        ("residual", e.residual()),
        ("change of the stored energy, the sum of these", e.stored() - e.start),
        ("stored at the start (kinetic, strain, contacts)", e.start),
        ("stored at the end", e.stored()),
    ]
    .iter()
    .filter(|(name, _)| driven || *name != "work of the drive torque")
    .map(|(name, value)| vec![(*name).to_string(), number(*value, 6)])
    .collect();
    terminal.table("Energy balance of the run-up", &["", "J"], &rows);
    let rows: Vec<Vec<String>> = history
        .channels
        .iter()
        .zip(&summary.channels)
        .filter(|(c, _)| ["displacement", "velocity", "acceleration", "force"].contains(&c.quantity.as_str()))
        .map(|(c, levels)| {
            let [mean, rms, peak] = [levels.mean, levels.rms_about_mean, levels.peak_about_mean];
            vec![c.name.clone(), number(mean, 4), number(rms, 4), number(peak, 4), c.unit.clone()]
        })
        .collect();
    let header = ["channel", "mean", "RMS", "peak", "unit"];
    terminal.table("Channels of the run-up (RMS and peak about the mean)", &header, &rows);
}

pub fn spectrograms(terminal: &Terminal, found: &[SpectrogramResult]) -> Result<(), SeriesError> {
    let mut rows = Vec::new();
    for s in found {
        let bins = s.spectrogram.frequencies.len();
        let amplitude = s.spectrogram.amplitude.all()?;
        // skip the DC component: main lobe of the window around 0 Hz
        let least = 3.min(bins.saturating_sub(1));
        let without_mean = (0..amplitude.len()).filter(|k| k % bins >= least);
        let Some(at) = without_mean.max_by(|a, b| amplitude[*a].total_cmp(&amplitude[*b])) else { continue };
        rows.push(vec![
            s.channel.clone(),
            number(amplitude[at], 4),
            s.unit.clone(),
            number(s.spectrogram.frequencies[at % bins], 5),
            format!("{:.1}", rpm(s.speed[at / bins])),
        ]);
    }
    terminal.table("Spectrograms: peak amplitudes", &["channel", "amplitude", "unit", "Hz", "at rpm"], &rows);
    Ok(())
}

pub fn orders(terminal: &Terminal, found: &[OrderResult]) {
    let mut rows = Vec::new();
    for result in found {
        for (line, cut) in &result.cuts {
            let Some(at) = (0..cut.rms.len()).max_by(|a, b| cut.rms[*a].total_cmp(&cut.rms[*b])) else {
                continue;
            };
            rows.push(vec![
                result.channel.clone(),
                line.label.clone(),
                number(line.order, 5),
                number(cut.rms[at], 4),
                result.unit.clone(),
                format!("{:.1}", cut.rpm[at]),
            ]);
        }
    }
    let count = rows.len();
    rows.truncate(MAX_ROWS);
    let header = ["channel", "order line", "order", "peak RMS", "unit", "at rpm"];
    terminal.table("Order cuts: peak levels", &header, &rows);
    print_omitted_count(terminal, count);
    let speeds = found.iter().flat_map(|result| &result.cuts).map(|(_, cut)| cut.rpm.as_slice());
    if let Some(rpm) = speeds.max_by_key(|rpm| rpm.len()) {
        let [low, high] = [f64::min, f64::max].map(|of| rpm.iter().copied().reduce(of).unwrap_or(f64::NAN));
        terminal.print(&format!(
            "  {} of revolutions, centred from {low:.1} to {high:.1} rpm",
            counted(rpm.len(), "window", "windows")
        ));
    }
    found.iter().for_each(|result| printed::tables(terminal, &result.section().content));
}
