//! Figures over speed: Campbell, spectrogram, waterfall, order map and cuts.

use rotordyn::plot::*;

pub fn linspace(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| lo + (hi - lo) * k as f64 / (count - 1) as f64).collect()
}

/// Uniform pseudo-random noise from -1 to 1, the same in every run.
pub struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Branches of an overhung rotor: (label, kind, Hz at rest, change per rpm, log decrement).
pub fn branches() -> Vec<Branch> {
    let table = [
        ("1st bending B", Whirl::Backward, 27.1, -0.0016, 0.11),
        ("1st bending F", Whirl::Forward, 27.6, 0.0015, 0.09),
        ("1st torsion", Whirl::Torsion, 68.0, 0.0, 0.035),
        ("axial", Whirl::Axial, 97.5, 0.0, 0.21),
        ("2nd bending B", Whirl::Backward, 131.0, -0.0105, 0.15),
        ("2nd bending F", Whirl::Forward, 132.5, 0.0118, 0.13),
        ("pedestal rocking", Whirl::Mixed, 158.0, 0.0005, 0.30),
    ];
    let rpm = linspace(0.0, 3000.0, 41);
    let branch = |&(label, whirl, hz, slope, damping): &(&str, Whirl, f64, f64, f64)| Branch {
        label: label.to_string(),
        whirl: vec![whirl; rpm.len()],
        hz: rpm.iter().map(|r| hz + slope * r * (1.0 - 0.00008 * r)).collect(),
        log_decrement: rpm
            .iter()
            .map(|r| damping - if label == "1st bending F" { 4.5e-5 * r } else { 1.2e-6 * r })
            .collect(),
        rpm: rpm.clone(),
    };
    table.iter().map(branch).collect()
}

pub fn orders() -> Vec<OrderLine> {
    let order = |label: &str, order, bearing| OrderLine { label: label.to_string(), order, bearing };
    vec![
        order("1x", 1.0, false),
        order("2x", 2.0, false),
        order("3x", 3.0, false),
        order("BPFO", 3.57, true),
        order("2 BPFO", 7.14, true),
        order("7x", 7.0, false),
        order("8x", 8.0, false),
        order("9x", 9.0, false),
    ]
}

pub fn campbell() -> Figure {
    let critical = |rpm, hz, label: &str| Critical { rpm, hz, label: label.to_string() };
    Figure::Campbell(Campbell {
        title: "Overhung rig: Campbell diagram".to_string(),
        note: "ball bearings 6205, clearance 20 µm, linearised about static equilibrium at each speed"
            .to_string(),
        branches: branches(),
        orders: orders(),
        criticals: vec![
            critical(1502.0, 25.03, "1502 rpm B"),
            critical(1790.0, 29.8, "1790 rpm F"),
            critical(1020.0, 119.0, "7x B"),
            critical(1243.0, 145.0, "7x F"),
        ],
        max_hz: None,
    })
}

pub fn lorentz(f: f64, f0: f64, zeta: f64) -> [f64; 2] {
    let r = f / f0;
    let (a, b) = (1.0 - r * r, 2.0 * zeta * r);
    let d = a * a + b * b;
    [a / d, -b / d]
}

/// Amplitude at a speed and frequency: orders amplified by resonances, noise-excited resonances, noise floor.
pub fn amplitude(rpm: f64, hz: f64, noise: &mut Noise) -> f64 {
    let mut sum = 2e-4 * (1.0 + 0.5 * noise.next()).abs();
    let gain = |f: f64| -> f64 {
        let resonance = |f0, slope, weight: f64| {
            let [re, im] = lorentz(f, f0 + slope * rpm, 0.015);
            weight * re.hypot(im)
        };
        resonance(27.1, -0.0016, 0.4)
            + resonance(27.6, 0.0015, 0.5)
            + resonance(131.0, -0.0105, 0.6)
            + resonance(132.5, 0.0118, 0.8)
    };
    for (order, strength) in [
        (1.0, 0.05),
        (2.0, 0.012),
        (3.0, 0.006),
        (3.57, 0.01),
        (7.14, 0.02),
        (7.0, 0.015),
        (8.0, 0.02),
        (9.0, 0.02),
    ] {
        let f = order * rpm / 60.0;
        let off = (hz - f) / 0.8;
        sum += strength * (rpm / 1500.0).powf(1.2) * gain(f) * (-off * off).exp();
    }
    sum + 3e-4 * gain(hz) * (1.0 + 0.4 * noise.next())
}

pub fn spectra() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let (rpm, hz) = (linspace(20.0, 3000.0, 240), linspace(0.0, 200.0, 512));
    let mut noise = Noise(7);
    let mut values = Vec::new();
    for &r in &rpm {
        values.extend(hz.iter().map(|&f| amplitude(r, f, &mut noise)));
    }
    (rpm, hz, values)
}

pub fn decibels(values: &[f64]) -> Vec<f64> {
    values.iter().map(|v| 20.0 * v.log10()).collect()
}

pub fn spectrogram() -> Figure {
    let (rpm, hz, values) = spectra();
    Figure::Spectrogram(Spectrogram {
        title: "Overhung rig: run-up, bearing B vertical".to_string(),
        note: "STFT, Hann window 1.0 s, overlap 90 %; lines: linear Campbell diagram".to_string(),
        panels: vec![SpectrogramPanel { rpm, hz, level_db: decibels(&values).into(), ..Default::default() }],
        quantity: "acceleration level".to_string(),
        unit: "dB re 1 m/s²".to_string(),
        span_db: 70.0,
        orders: orders(),
        branches: branches()
            .into_iter()
            .filter(|b| !matches!(b.whirl[0], Whirl::Axial | Whirl::Torsion))
            .collect(),
        max_hz: None,
    })
}

pub fn waterfall() -> Figure {
    let (rpm, hz, amplitude) = spectra();
    Figure::Waterfall(Waterfall {
        title: "Overhung rig: waterfall of the run-up, bearing B vertical".to_string(),
        panels: vec![WaterfallPanel { name: String::new(), rpm, hz, amplitude }],
        unit: "m/s²".to_string(),
        orders: orders().into_iter().filter(|o| o.label != "2 BPFO").collect(),
        ..Default::default()
    })
}

pub fn order_map() -> Figure {
    let (rpm, order) = (linspace(200.0, 3000.0, 200), linspace(0.0, 12.0, 481));
    let mut noise = Noise(3);
    let mut level_db = Vec::new();
    for &r in &rpm {
        level_db.extend(order.iter().map(|&o| {
            let lines = [
                (1.0, 0.0),
                (2.0, -12.0),
                (3.57, -14.0),
                (7.0, -10.0),
                (7.14, -9.0),
                (8.0, -12.0),
                (9.0, -15.0),
            ];
            let line = |(at, db): (f64, f64)| 10f64.powf(db / 20.0) * (-((o - at) / 0.03).powi(2)).exp();
            let [re, im] = lorentz(o * r / 60.0, 131.0, 0.02);
            20.0 * (lines.into_iter().map(line).sum::<f64>() * re.hypot(im)
                + 0.002 * re.hypot(im)
                + 0.001 * (2.0 + noise.next()))
            .log10()
        }));
    }
    Figure::OrderMap(OrderMap {
        title: "Overhung rig: order map of the run-up".to_string(),
        note: "order resolution 0.05".to_string(),
        rpm,
        order,
        level_db: level_db.into(),
        quantity: "acceleration level".to_string(),
        unit: "dB re 1 m/s²".to_string(),
        span_db: 60.0,
        orders: orders(),
        ..OrderMap::default()
    })
}

pub fn order_cuts() -> Figure {
    let rpm = linspace(100.0, 3000.0, 400);
    let cut = |label: &str, order: f64, strength: f64| Curve {
        label: label.to_string(),
        y: rpm
            .iter()
            .map(|r| {
                let [a, b] = lorentz(order * r / 60.0, 27.4, 0.02);
                let [c, d] = lorentz(order * r / 60.0, 131.0 - 0.004 * r, 0.02);
                strength * (r / 1000.0).powi(2) * (0.3 * a.hypot(b) + 0.1 * c.hypot(d))
            })
            .collect(),
        x: rpm.clone(),
        points: false,
    };
    Figure::Lines(Lines {
        title: "Order cuts of the run-up, bearing B vertical".to_string(),
        note: "RMS in a band of ± 0.25 orders".to_string(),
        x_name: "shaft speed".to_string(),
        x_unit: "rpm".to_string(),
        y_name: "acceleration RMS".to_string(),
        y_unit: "m/s²".to_string(),
        curves: vec![
            cut("1x", 1.0, 0.05),
            cut("2x", 2.0, 0.02),
            cut("2 BPFO", 7.14, 0.3),
            cut("8x", 8.0, 0.2),
        ],
        from_zero: true,
        ..Default::default()
    })
}
