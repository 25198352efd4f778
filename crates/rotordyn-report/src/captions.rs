//! Which drawn figures stand in the page, and what is seen in them.

/// Figures whose data the page shows itself.
const INTERACTIVE: [&str; 9] = [
    "machine_layout",
    "campbell",
    "frf_",
    "unbalance_bode",
    "spectrogram_",
    "waterfall_",
    "orders_",
    "order_cuts_",
    "run_up_",
];
/// Figures with such a name that the page does not show otherwise.
const STILL_DRAWN: [&str; 2] = ["run_up_energy", "run_up_bearing_"];

/// Beginning of a figure's name, what is seen.
const CAPTIONS: [(&str, &str); 25] = [
    ("static_deflection", "Static deflection of the shaft."),
    ("static_shaft_loads", "Deflection, shear force and bending moment along the shaft at rest."),
    ("unbalance_shaft_loads", "Amplitudes of deflection, shear force and bending moment along the shaft."),
    ("unbalance_bearing_forces", "Dynamic bearing forces under unbalance, with the static forces."),
    ("ball_loads", "Loads of the balls in every bearing at static equilibrium."),
    ("stability", "Log decrement of the least damped modes over speed: below zero the machine is unstable."),
    ("critical_map", "Undamped critical speeds over bearing stiffness; crossings with the bearings' own."),
    ("torsional_interference", "Torsional natural frequencies and orders of excitation."),
    ("torsional_modes", "Twist along the shaft in the torsional modes."),
    ("modes_", "Mode shapes with their orbits."),
    ("unbalance_polar", "Response to unbalance as polar plot."),
    ("unbalance_orbits", "Orbits under unbalance."),
    ("run_up_energy", "Energy balance of the run-up: the residual is the error of the integration."),
    ("run_up_bearing_", "Bearing over the run-up."),
    ("order_tracks_", "Orders of the run-up by the Vold-Kalman filter: amplitude and phase."),
    ("poincare_orbits", "Orbits at constant speed."),
    ("poincare_sections", "Poincaré sections at constant speed."),
    ("lyapunov", "Convergence of the largest Lyapunov exponent."),
    ("bifurcation_", "Bifurcation diagram, swept up and down."),
    ("bearing_", "Bearing analysis."),
    ("signal_", "Signal analysis."),
    ("trend", "Statistics, bearing lines and diagnoses of several records."),
    ("stabilisation", "Stabilisation diagram."),
    ("validation_", "Model and measurement."),
    ("update_", "Before and after the update."),
];

/// What is seen in the figure of a name; `None` if the page shows its data otherwise.
pub fn caption(name: &str) -> Option<String> {
    let still = STILL_DRAWN.iter().any(|start| name.starts_with(start));
    if !still && INTERACTIVE.iter().any(|start| name.starts_with(start)) {
        return None;
    }
    let words = CAPTIONS.iter().find(|(start, _)| name.starts_with(start)).map_or("", |(_, words)| *words);
    Some(format!("{words} ({name})").trim().into())
}

#[cfg(test)]
mod tests {
    use super::caption;

    #[test]
    fn figures_without_interactive_form_have_a_caption() {
        assert_eq!(caption("frf_rim"), None);
        assert_eq!(caption("run_up_disc_x"), None);
        assert!(caption("run_up_energy").unwrap().starts_with("Energy balance"));
        assert!(caption("modes_1200rpm").unwrap().ends_with("(modes_1200rpm)"));
    }
}
