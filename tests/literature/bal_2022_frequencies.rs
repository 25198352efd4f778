//! Bal et al. 2022, Table A3: frequencies of the FAG 7206, all sixty entries as printed.
//!
//! All digits are reproduced with a contact angle of 40.018°, not with the stated 40°.

use crate::agree;
use rotordyn::bearing::Bearing;
use rotordyn::model;

/// rpm, cage, BSF (one contact of a ball with one race), BPFO, BPFI \[Hz\], as printed.
const TABLE: [[&str; 5]; 15] = [
    ["200", "1.4023", "7.843984", "18.229699", "25.1036"],
    ["400", "2.8046", "15.687969", "36.459398", "50.2073"],
    ["600", "4.2069", "23.531953", "54.689097", "75.3109"],
    ["800", "5.6091", "31.375938", "72.918795", "100.4145"],
    ["1000", "7.0114", "39.219922", "91.148494", "125.5182"],
    ["1200", "8.4137", "47.063907", "109.378193", "150.6218"],
    ["1400", "9.8160", "54.907891", "127.607892", "175.7254"],
    ["1600", "11.2183", "62.751876", "145.837591", "200.8291"],
    ["1800", "12.6206", "70.595860", "164.067290", "225.9327"],
    ["2000", "14.0228", "78.439845", "182.296989", "251.0363"],
    ["2200", "15.4251", "86.283829", "200.526687", "276.1400"],
    ["2400", "16.8274", "94.127814", "218.756386", "301.2436"],
    ["2600", "18.2297", "101.971798", "236.986085", "326.3472"],
    ["2800", "19.6320", "109.815783", "255.215784", "351.4509"],
    ["3000", "21.0343", "117.659767", "273.445483", "376.5545"],
];

#[test]
fn frequencies_of_table_a3() {
    let text = include_str!("../../models/bal_2022.toml");
    let model = model::load("bal_2022.toml", text, &Default::default()).unwrap().model;
    let Bearing::Ball(ball) = &model.bearings[0].bearing else { panic!("a ball bearing") };
    let orders = ball.geometry.characteristic_orders(40.018_f64.to_radians());
    for [rpm, cage, bsf, bpfo, bpfi] in TABLE {
        let turns = rpm.parse::<f64>().unwrap() / 60.0;
        // Its spin frequency, eq. A3, is D_pw/(2 D_w)(1 − γ²) times n/60.
        for (name, order, printed) in [
            ("cage", orders.ftf, cage),
            ("BSF", orders.bsf, bsf),
            ("BPFO", orders.bpfo, bpfo),
            ("BPFI", orders.bpfi, bpfi),
        ] {
            let decimals = printed.split_once('.').map_or(0, |(_, d)| d.len());
            assert_eq!(format!("{:.decimals$}", order * turns), printed, "{rpm} rpm");
            // Rounded as printed.
            let half_digit = 0.5 * 0.1_f64.powi(decimals as i32) * (1.0 + 1e-9);
            let theirs: f64 = printed.parse().unwrap();
            agree::absolute(format_args!("{name} at {rpm} rpm [Hz]"), order * turns, theirs, half_digit);
        }
    }
}
