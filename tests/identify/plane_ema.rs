//! Impact test of a model plane, 74 points, 3 accelerometers: poles compared with the published ones.
//!
//! University of Liege, MECA0062 2024 (github QUICKguils/VibTest, MIT); FRFs over 0 to 200 Hz by 0.125 Hz.

use rotordyn::identify::{Settings, identify};
use rotordyn::io::measured::read;

use crate::measured_data::measured;

/// Published natural frequencies by PolyMAX \[Hz\].
const PUBLISHED: [f64; 13] =
    [18.84, 40.18, 87.74, 89.63, 97.53, 105.19, 117.91, 125.2, 125.69, 129.74, 135.12, 143.37, 166.27];

/// All within 0.3 %, and no spurious mode, whatever the highest order: FRFs of hits between which the plane changed
/// by 0.02 % give one mode twice at high orders, 105.13 and 105.28 Hz by 80. (The second singular value of the FRFs
/// is flat there, two hundred times below the first: there is one mode.)
#[test]
fn published_poles_without_spurious_modes() {
    let Some(path) = measured("plane_ema/lab2_frf.npz") else { return };
    let frfs = read(&path).unwrap().frf_matrix().unwrap();
    assert_eq!((frfs.responses.len(), frfs.references.len(), frfs.frequencies.len()), (74, 3, 1601));
    for order in [40, 60, 80, 100] {
        let settings = Settings { band: Some([5.0, 180.0]), max_order: Some(order), ..Settings::default() };
        let found = identify(&frfs, &settings).unwrap();
        println!("order {order}, error {:.4}", found.total_error);
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
        let off = |f: f64| {
            found.modes.iter().map(|m| (m.frequency_hz() / f - 1.0).abs()).fold(f64::INFINITY, f64::min)
        };
        println!("{:?}", PUBLISHED.map(|f| format!("{:.3} %", 100.0 * off(f))));
        assert!(PUBLISHED.iter().all(|f| off(*f) < 0.003));
        assert_eq!(found.modes.len(), PUBLISHED.len());
        // 125.2 and 125.7 Hz are two modes.
        let mac = found.auto_mac();
        for (k, row) in mac.iter().enumerate().skip(1) {
            let near = found.modes[k].frequency_hz() / found.modes[k - 1].frequency_hz() < 1.01;
            assert!(!near || row[k - 1] < 0.5, "modes {k} and {}: MAC {:.3}", k + 1, row[k - 1]);
        }
    }
}
