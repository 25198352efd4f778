//! Figures of the machine: FRFs, mode shapes, unbalance, orbits, statics, history, sketch.

use std::f64::consts::TAU;

use rotordyn::plot::*;

use super::over_speed::{Noise, linspace, lorentz};

pub fn response(hz: &[f64], poles: &[(f64, f64, f64)]) -> (Vec<f64>, Vec<f64>) {
    let sum = |f: &f64| {
        poles.iter().fold([0.0, 0.0], |s, &(f0, zeta, k)| {
            let [re, im] = lorentz(*f, f0, zeta);
            [s[0] + re / k, s[1] + im / k]
        })
    };
    hz.iter().map(sum).map(|[re, im]| (re, im)).unzip()
}

pub fn frf() -> Figure {
    let hz = linspace(1.0, 250.0, 2000);
    let curve = |label: &str, shift: f64| {
        let poles = [
            (27.1 * shift, 0.012, 4e5),
            (68.0, 0.006, 9e6),
            (131.0 * shift, 0.02, -2e6),
            (205.0 * shift, 0.01, 8e6),
        ];
        let (re, im) = response(&hz, &poles);
        FrfCurve { label: label.to_string(), hz: hz.clone(), re, im, coherence: Vec::new() }
    };
    Figure::Frf(Frf {
        title: "Driving-point receptance at the disc, vertical".to_string(),
        note: "at standstill".to_string(),
        quantity: "receptance".to_string(),
        apart: false,
        unit: "m/N".to_string(),
        curves: vec![curve("spherical", 1.0), curve("cylindrical", 1.13), curve("ball bearings", 0.94)],
    })
}

pub fn frf_measured() -> Figure {
    let hz = linspace(1.0, 250.0, 1600);
    let poles = [(27.1, 0.012, 4e5), (131.0, 0.02, 2e6)];
    let scaled = |f: &f64, v: f64| v * -(TAU * f).powi(2);
    let (re, im) = response(&hz, &poles);
    let mut noise = Noise(5);
    let rough = |list: &[f64], noise: &mut Noise| -> Vec<f64> {
        list.iter().map(|v| v * (1.0 + 0.08 * noise.next()) + 4e-9 * noise.next()).collect()
    };
    let (mre, mim) = (rough(&re, &mut noise), rough(&im, &mut noise));
    let accelerance =
        |list: &[f64]| -> Vec<f64> { hz.iter().zip(list).map(|(f, v)| scaled(f, *v)).collect() };
    let coherence = hz
        .iter()
        .map(|f| {
            (1.0 - 0.6 * (-((f - 78.0) / 6.0).powi(2)).exp()
                - 0.5 * (-f / 3.0).exp()
                - 0.02 * noise.next().abs())
            .max(0.0)
        })
        .collect();
    Figure::Frf(Frf {
        title: "Accelerance at bearing B, vertical: model and test".to_string(),
        note: "hammer, 5 averages; FRAC 0.97".to_string(),
        quantity: "accelerance".to_string(),
        apart: false,
        unit: "m/s²/N".to_string(),
        curves: vec![
            FrfCurve {
                label: "test".to_string(),
                hz: hz.clone(),
                re: accelerance(&mre),
                im: accelerance(&mim),
                coherence,
            },
            FrfCurve {
                label: "model".to_string(),
                re: accelerance(&re),
                im: accelerance(&im),
                hz,
                coherence: Vec::new(),
            },
        ],
    })
}

pub fn modes() -> Figure {
    let z = linspace(0.0, 0.6, 25);
    let shape = |f: &dyn Fn(f64) -> f64, way: f64, ratio: f64| -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
        // u_x = cos, u_y = sin for forward whirl: Re(-i e^{iωt}) = sin ωt.
        (
            z.iter().map(|z| [f(z / 0.6), 0.0]).collect(),
            z.iter().map(|z| [0.0, -way * ratio * f(z / 0.6)]).collect(),
        )
    };
    let first = |s: f64| if s < 0.2 { 0.1 * (0.2 - s) } else { -(s - 0.2).powf(1.5) * (s - 0.05) * 1.6 };
    let second = |s: f64| (4.6 * (s - 0.1)).sin() * (0.3 + 0.4 * s);
    let still = |_: f64| 0.0;
    let mode = |title: &str, whirl, (u_x, u_y): (Vec<[f64; 2]>, Vec<[f64; 2]>)| ModeShape {
        title: title.to_string(),
        whirl,
        u_x,
        u_y,
        u_z: Vec::new(),
        theta_x: Vec::new(),
        theta_y: Vec::new(),
        theta_z: Vec::new(),
        bodies: vec![BodyMotion::default(); 2],
    };
    let mut torsion = mode("68.0 Hz, 1st torsion", Whirl::Torsion, shape(&still, 1.0, 1.0));
    torsion.theta_z = z.iter().map(|z| [1.0 - 1.8 * (z / 0.6) * (2.0 - z / 0.6), 0.0]).collect();
    let mut axial = mode("97.5 Hz, axial", Whirl::Axial, shape(&still, 1.0, 1.0));
    axial.u_z = z.iter().map(|_| [1.0, 0.0]).collect();
    let mut rocking =
        mode("158.0 Hz, pedestal rocking", Whirl::Mixed, shape(&|s| 0.3 * (3.0 * s).cos(), 1.0, 0.05));
    rocking.bodies = vec![
        BodyMotion { u: [[0.8, 0.0], [0.05, 0.1], [0.0, 0.0]], ..BodyMotion::default() },
        BodyMotion { u: [[-0.6, 0.0], [0.0, 0.1], [0.0, 0.0]], ..BodyMotion::default() },
    ];
    Figure::ModeShapes(ModeShapes {
        title: "Overhung rig: mode shapes at 1200 rpm".to_string(),
        note: String::new(),
        rotor: Rotor {
            discs: vec![RotorDisc { node: 23, radius: 0.09 }],
            supports: [0.12, 0.36].map(|z| RotorSupport { z, symbol: SupportSymbol::Ball }).to_vec(),
            bodies: [("A", 0.12), ("B", 0.36)]
                .map(|(name, z)| BodyBox {
                    name: name.to_string(),
                    centre: [0.0, 0.0, z],
                    half_edges: [[0.05, 0.0, 0.0], [0.0, 0.05, 0.0], [0.0, 0.0, 0.02]],
                    to_ground: (true, false),
                })
                .to_vec(),
            z: z.clone(),
            orbit_nodes: Vec::new(),
        },
        modes: vec![
            mode("25.3 Hz, 1st bending, backward", Whirl::Backward, shape(&first, -1.0, 0.8)),
            mode("29.2 Hz, 1st bending, forward", Whirl::Forward, shape(&first, 1.0, 0.9)),
            torsion,
            axial,
            mode("119.0 Hz, 2nd bending, backward", Whirl::Backward, shape(&second, -1.0, 1.0)),
            mode("145.2 Hz, 2nd bending, forward", Whirl::Forward, shape(&second, 1.0, 1.0)),
            rocking,
        ],
    })
}

/// Unbalance response over speed: (rpm, amplitude [µm], phase [deg]).
pub fn unbalance(critical: f64, zeta: f64, scale: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let rpm = linspace(100.0, 3000.0, 600);
    let at = |r: &f64| {
        let [re, im] = lorentz(*r, critical, zeta);
        let a = scale * (r / critical).powi(2);
        (a * re.hypot(im), im.atan2(re).to_degrees())
    };
    let (amplitude, phase) = rpm.iter().map(at).unzip();
    (rpm, amplitude, phase)
}

pub fn bode() -> Figure {
    let curve = |label: &str, critical, scale| {
        let (rpm, amplitude, phase_deg) = unbalance(critical, 0.03, scale);
        BodeCurve { label: label.to_string(), rpm, amplitude, phase_deg }
    };
    Figure::Bode(Bode {
        title: "Unbalance response".to_string(),
        note: "G6.3 at the disc, phase 0°".to_string(),
        quantity: "amplitude 0–peak".to_string(),
        unit: "µm".to_string(),
        curves: vec![curve("disc horizontal", 1502.0, 12.0), curve("disc vertical", 1790.0, 12.0)],
        log: false,
        criticals: vec![
            Critical { rpm: 1502.0, hz: 25.0, label: "1502 rpm".to_string() },
            Critical { rpm: 1790.0, hz: 29.8, label: "1790 rpm".to_string() },
        ],
    })
}

pub fn polar() -> Figure {
    let curve = |label: &str, critical, scale| {
        let (rpm, amplitude, phase_deg) = unbalance(critical, 0.05, scale);
        PolarCurve { label: label.to_string(), rpm, amplitude, phase_deg }
    };
    Figure::Polar(Polar {
        title: "Unbalance response, polar".to_string(),
        note: "labels: shaft speed [rpm]".to_string(),
        unit: "µm".to_string(),
        curves: vec![curve("disc horizontal", 1502.0, 12.0), curve("disc vertical", 1790.0, 9.0)],
    })
}

pub fn orbits() -> Figure {
    let orbit = |title: &str, a: f64, b: f64, way: f64, ripple: f64| {
        let mut noise = Noise(11);
        let turn = |k: usize| TAU * k as f64 / 256.0;
        let x1 = |k: usize| 1e-6 * a * turn(k).cos();
        let y1 = |k: usize| 1e-6 * b * (way * turn(k) + 0.5).sin();
        Orbit {
            title: title.to_string(),
            x: (0..2048)
                .map(|k| x1(k) + 1e-6 * ripple * ((3.57 * turn(k)).cos() + 0.2 * noise.next()))
                .collect(),
            y: (0..2048)
                .map(|k| y1(k) + 1e-6 * ripple * ((3.57 * turn(k)).sin() + 0.2 * noise.next()))
                .collect(),
            filtered_x: (0..=256).map(x1).collect(),
            filtered_y: (0..=256).map(y1).collect(),
            keyphasor: (0..8).map(|k| 256 * k).collect(),
            clearance: Some(20e-6),
        }
    };
    Figure::Orbits(Orbits {
        title: "Steady-state orbits, 1200 rpm".to_string(),
        note: String::new(),
        orbits: vec![orbit("disc", 14.0, 9.0, 1.0, 1.2), orbit("bearing B", 4.0, 6.0, -1.0, 0.7)],
    })
}

pub fn ball_loads() -> Figure {
    let row = |title: &str, note: &str, count: usize, pull: f64, turn: f64| {
        let angle_deg: Vec<f64> = (0..count).map(|k| turn + 360.0 * k as f64 / count as f64).collect();
        let load =
            angle_deg.iter().map(|a| pull * (-(a.to_radians().sin()) - 0.15).max(0.0).powf(1.5)).collect();
        BallRow {
            title: title.to_string(),
            note: note.to_string(),
            angle_deg,
            load,
            radial_load: [0.0, -pull],
        }
    };
    Figure::BallLoads(BallLoads {
        title: "Static ball loads at standstill".to_string(),
        note: "gravity and belt pull; bars to one scale".to_string(),
        rows: vec![
            row("bearing A, 6205", "F = (0, 84, 0) N", 9, 60.0, 10.0),
            row("bearing B, 6205", "F = (0, 263, 12) N", 9, 190.0, 0.0),
        ],
    })
}

pub fn deflection() -> Figure {
    let z = linspace(0.0, 0.6, 41);
    let mark = |label: &str, z| Mark { label: label.to_string(), z };
    Figure::Deflection(Deflection {
        title: "Static deflection under gravity and belt pull".to_string(),
        note: String::new(),
        u_x: z.iter().map(|z| 4e-6 * (1.0 - z / 0.12) * (1.0 - z / 0.36)).collect(),
        u_y: z.iter().map(|z| -60e-6 * (z / 0.12 - 1.0) * (z / 0.36 - 1.0) * (0.2 + z)).collect(),
        z,
        stations: vec![
            mark("pulley", 0.01),
            mark("bearing A", 0.12),
            mark("bearing B", 0.36),
            mark("disc", 0.58),
            mark("disc end", 0.595),
        ],
    })
}

pub fn history() -> Figure {
    let time = linspace(0.0, 13.0, 1_000_000);
    let mut noise = Noise(17);
    let ramp = |t: f64| (t - 1.0).clamp(0.0, 10.0);
    let speed: Vec<f64> = time.iter().map(|t| 120.0 * ramp(*t)).collect();
    let value = time
        .iter()
        .map(|t| {
            let n = 2.0 * ramp(*t);
            let [re, im] = lorentz(n, 13.0, 0.04);
            0.02 * n * n / 10.0 * re.hypot(im) * (TAU * ramp(*t).powi(2)).sin() + 0.02 * noise.next()
        })
        .collect();
    let channel = |label: &str, quantity: &str, unit: &str, time: &[f64], value: Vec<f64>| Channel {
        label: label.to_string(),
        quantity: quantity.to_string(),
        unit: unit.to_string(),
        time: time.to_vec().into(),
        value: value.into(),
        ..Channel::default()
    };
    Figure::History(History {
        title: "Run-up of the overhung rig".to_string(),
        note: "1 s at rest, 10 s ramp to 1200 rpm, 2 s at constant speed; 10⁶ samples".to_string(),
        legend: Default::default(),
        channels: vec![
            channel("speed", "speed", "rpm", &time, speed),
            channel("bearing B vertical", "acceleration", "m/s²", &time, value),
        ],
    })
}

pub fn stiffness() -> Figure {
    let load = linspace(5.0, 2000.0, 120);
    let curve = |label: &str, factor: f64| Curve {
        label: label.to_string(),
        y: load.iter().map(|f| factor * 1.1e7 * f.powf(0.31)).collect(),
        x: load.clone(),
        points: false,
    };
    let reference = Curve {
        label: "reference".to_string(),
        x: vec![100.0, 500.0, 1000.0, 1500.0],
        y: [100.0f64, 500.0, 1000.0, 1500.0].iter().map(|f| 1.12e7 * f.powf(0.31)).collect(),
        points: true,
    };
    Figure::Lines(Lines {
        title: "Radial stiffness of the 6205 over load".to_string(),
        x_name: "radial load".to_string(),
        x_unit: "N".to_string(),
        y_name: "radial stiffness".to_string(),
        y_unit: "N/m".to_string(),
        curves: vec![curve("no clearance", 1.0), curve("clearance 20 µm", 0.82), reference],
        from_zero: true,
        ..Default::default()
    })
}

pub fn rig() -> Figure {
    let cylinder = |a: f64, b: f64, r: f64| LayoutSection { z: [a, b], outer: [r, r], inner: [0.0, 0.0] };
    let block = |label: &str, z, y, rotating| LayoutBlock { label: label.to_string(), z, y, rotating };
    let bearing = |label: &str, z| LayoutBearing {
        label: label.to_string(),
        bore: 0.0125,
        outside: 0.026,
        rows: vec![LayoutRow { z, width: 0.015, pitch: 0.0193, ball: 0.004, contact_angle: 0.0 }],
    };
    let spring =
        |z| LayoutSpring { from: [z, -0.07], to: [z, -0.12], spring: true, damper: true, grounded: true };
    Figure::MachineLayout(MachineLayout {
        title: "Overhung rig: model sketch".to_string(),
        note: "shaft and bodies to scale; rotating parts dark".to_string(),
        sections: vec![
            cylinder(0.0, 0.1, 0.010),
            cylinder(0.1, 0.38, 0.0125),
            LayoutSection { z: [0.38, 0.42], outer: [0.0125, 0.009], inner: [0.0, 0.0] },
            cylinder(0.42, 0.6, 0.009),
        ],
        blocks: vec![
            block("housing", [0.08, 0.40], [-0.07, 0.05], false),
            block("pulley", [0.0, 0.025], [-0.03, 0.03], true),
            block("disc", [0.57, 0.59], [-0.09, 0.09], true),
        ],
        bearings: vec![bearing("bearing A", 0.12), bearing("bearing B", 0.36)],
        supports: Vec::new(),
        springs: vec![spring(0.1), spring(0.38)],
        belts: vec![LayoutBelt {
            label: "belt 120 N".to_string(),
            z: 0.0125,
            radius: 0.03,
            pull: [0.0, -120.0],
        }],
        stations: [
            ("P", 0.0125),
            ("A", 0.12),
            ("M", 0.24),
            ("B", 0.36),
            ("step", 0.42),
            ("D", 0.58),
            ("end", 0.6),
        ]
        .map(|(n, z)| (n.to_string(), z))
        .to_vec(),
    })
}
