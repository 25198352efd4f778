//! The bearing catalogue is consistent with itself and with ISO 76.

use rotordyn::model::catalogue;
use std::f64::consts::PI;

#[test]
fn rows_are_complete_and_unique() {
    let entries: Vec<_> = catalogue::entries().collect();
    assert_eq!(entries.len(), catalogue::row_count(), "a row does not parse");
    assert!(entries.len() >= 40);
    let deep_groove = entries.iter().filter(|e| e.contact_angle == 0.0).count();
    assert!(deep_groove >= 40 && entries.len() - deep_groove >= 15);
    for (k, entry) in entries.iter().enumerate() {
        assert!(entries[..k].iter().all(|e| e.designation != entry.designation), "{}", entry.designation);
        assert!(entry.origin.len() > 20, "{}", entry.designation);
    }
}

/// Bore code of ISO 15: 00 is 10 mm, 01 is 12, 02 is 15, 03 is 17, from 04 on five times the code.
#[test]
fn bores_follow_their_designation() {
    for entry in catalogue::entries() {
        let code: usize = entry.designation[2..4].parse().unwrap();
        let bore_mm = [10.0, 12.0, 15.0, 17.0].get(code).copied().unwrap_or(5.0 * code as f64);
        assert!((entry.bore * 1e3 - bore_mm).abs() < 1e-9, "{}", entry.designation);
    }
}

#[test]
fn balls_fit_on_the_pitch_circle_and_between_the_rings() {
    for e in catalogue::entries() {
        let spacing = e.pitch_diameter * (PI / e.balls as f64).sin();
        assert!(spacing > 1.05 * e.ball_diameter, "{}: no room for a cage", e.designation);
        assert!(e.pitch_diameter - e.ball_diameter > e.bore, "{}", e.designation);
        assert!(e.pitch_diameter + e.ball_diameter < e.outside_diameter, "{}", e.designation);
        assert!(e.ball_diameter < e.width, "{}", e.designation);
        assert!(e.ball_diameter < 0.7 * 0.5 * (e.outside_diameter - e.bore), "{}", e.designation);
        let [inner, outer] = e.osculation;
        assert!((0.505..0.54).contains(&inner) && (0.505..0.54).contains(&outer), "{}", e.designation);
        // CWRU states a pitch diameter 0.5 mm from the middle of the rings
        let middle = 0.5 * (e.bore + e.outside_diameter);
        assert!((e.pitch_diameter - middle).abs() < 0.6e-3, "{}", e.designation);
    }
}

/// f0 of ISO 76, table 1, over D_w cos(α)/D_pw in steps of 0.01.
const F0: [f64; 36] = [
    14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4, 15.2, 14.9,
    14.7, 14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8, 11.6, 11.4, 11.2, 10.9,
    10.7, 10.5,
];

/// C0 = f0 Z D_w² cos α within 5 %: balls come in steps of 1/64 in, and makers round ratings to three digits.
#[test]
fn static_load_ratings_follow_iso_76() {
    let mut checked = 0;
    for e in catalogue::entries() {
        let Some(quoted) = e.static_rating else { continue };
        let cos = e.contact_angle.cos();
        let x = 100.0 * e.ball_diameter * cos / e.pitch_diameter;
        let k = x as usize;
        let f0 = F0[k] + (F0[k + 1] - F0[k]) * (x - k as f64);
        let rating = f0 * e.balls as f64 * (e.ball_diameter * 1e3).powi(2) * cos;
        assert!((rating / quoted - 1.0).abs() < 0.05, "{}: {rating}, listed {quoted}", e.designation);
        checked += 1;
    }
    assert!(checked >= 55, "{checked}");
}

#[test]
fn clearance_classes_grow_with_class_and_bore() {
    let mut before = [0.0; 5];
    for bore_mm in [10.0, 12.0, 20.0, 25.0, 35.0, 45.0, 60.0, 75.0, 90.0, 110.0, 130.0] {
        let middle = catalogue::CLEARANCE_CLASSES.map(|class| {
            let [least, greatest] = catalogue::clearance(class, bore_mm / 1e3).unwrap();
            assert!(least < greatest);
            0.5 * (least + greatest)
        });
        assert!(middle.windows(2).all(|w| w[1] > w[0]), "{bore_mm}");
        assert!((0..5).all(|k| middle[k] >= before[k]), "{bore_mm}");
        before = middle;
    }
    assert_eq!(catalogue::clearance("CN", 0.025), Some([5e-6, 20e-6]));
    assert_eq!(catalogue::clearance("C3", 0.010), Some([8e-6, 23e-6]));
    assert_eq!(catalogue::clearance("C3", 0.001), None);
    assert_eq!(catalogue::clearance("C3", 0.5), None);
}
