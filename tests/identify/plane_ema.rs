//! Hammer test of a model plane, 74 points, 3 accelerometers: poles held to those that were published.
//!
//! University of Liege, MECA0062 2024 (github QUICKguils/VibTest, MIT); FRFs over 0 to 200 Hz by 0.125 Hz.

use rotordyn::edge::measured::read;
use rotordyn::identify::{Settings, identify};

use crate::measured_data::measured;

/// Their polyMAX \[Hz\].
const PUBLISHED: [f64; 13] =
    [18.84, 40.18, 87.74, 89.63, 97.53, 105.19, 117.91, 125.2, 125.69, 129.74, 135.12, 143.37, 166.27];

#[test]
fn published_poles_are_found() {
    let Some(path) = measured("plane_ema/lab2_frf.npz") else { return };
    let frfs = read(&path).unwrap().frf_matrix().unwrap();
    assert_eq!((frfs.responses.len(), frfs.references.len(), frfs.frequencies.len()), (74, 3, 1601));
    let start = std::time::Instant::now();
    let settings = Settings { band: Some([5.0, 180.0]), ..Settings::default() };
    let found = identify(&frfs, &settings).unwrap();
    println!("{:.2} s, error {:.4}", start.elapsed().as_secs_f64(), found.total_error);
    for m in &found.modes {
        println!(
            "{:9.4} ± {:.4} Hz  {:.4} ± {:.4} %  MPC {:.3}  F {:.0}",
            m.frequency_hz(),
            m.frequency_error,
            100.0 * m.damping_ratio(),
            100.0 * m.damping_error,
            m.collinearity,
            m.significance
        );
    }
    println!("dropped {:#?}", found.dropped);
    let off =
        |f: f64| found.modes.iter().map(|m| (m.frequency_hz() / f - 1.0).abs()).fold(f64::INFINITY, f64::min);
    let within = PUBLISHED.iter().filter(|f| off(**f) < 0.003).count();
    println!("{:?}", PUBLISHED.map(|f| format!("{:.3} %", 100.0 * off(f))));
    assert!(within >= 11, "{within} of 13 within 0.3 %");
}
