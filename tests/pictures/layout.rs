//! Ticks, ranges, label placement and clipping.

use proptest::prelude::*;
use rotordyn::plot::axes::{Frame, clip};
use rotordyn::plot::labels::place_without_overlap;
use rotordyn::plot::scale::{Range, Scale, linear_ticks, log_ticks, nice_step, power};

#[test]
fn steps_are_one_two_or_five() {
    assert_eq!(nice_step(100.0, 5.0), 20.0);
    assert_eq!(nice_step(100.0, 10.0), 10.0);
    assert_eq!(nice_step(3000.0, 7.0), 500.0);
    assert!((nice_step(0.7, 5.0) - 0.2).abs() < 1e-15);
}

#[test]
fn tick_labels_factor_out_powers_of_a_thousand() {
    let axis = Scale::linear(Range::new(0.0, 1.2e8), [0.0, 300.0], 60.0);
    assert_eq!(axis.label("stiffness", "N/m"), "stiffness [10⁶ N/m]");
    assert_eq!(axis.ticks.last().map(|t| t.label.as_str()), Some("100"));
    let axis = Scale::linear(Range::new(-2e-6, 2e-6), [0.0, 300.0], 60.0);
    assert_eq!(axis.label("x", "m"), "x [10⁻⁶ m]");
    assert_eq!(axis.ticks.iter().map(|t| t.label.as_str()).collect::<Vec<_>>(), ["−2", "−1", "0", "1", "2"]);
    let axis = Scale::linear(Range::new(0.0, 1.0), [0.0, 300.0], 60.0);
    assert_eq!(axis.label("coherence", ""), "coherence");
    assert_eq!(axis.ticks.last().map(|t| t.label.as_str()), Some("1.0"));
}

#[test]
fn logarithmic_ticks_are_powers_of_ten() {
    let (major, minor) = log_ticks(Range::new(2e-7, 3e-4), 10.0);
    assert_eq!(major.len(), 3);
    assert!(major.iter().zip([1e-6, 1e-5, 1e-4]).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
    assert!(minor.len() > 20 && minor.iter().all(|v| (2e-7..=3.001e-4).contains(v)));
    assert_eq!(power(-12), "10⁻¹²");
    // Less than a decade: linear ticks on a logarithmic axis.
    let axis = Scale::log(Range::new(2.0, 8.0), [0.0, 200.0], 50.0);
    assert!(axis.ticks.len() >= 3);
    assert!((axis.px(4.0) - 100.0).abs() < 1e-9);
}

#[test]
fn ranges_of_degenerate_data_are_valid() {
    for values in [
        vec![],
        vec![f64::NAN],
        vec![3.0],
        vec![0.0, 0.0],
        vec![f64::INFINITY, 1.0],
        vec![f64::MAX, -f64::MAX],
    ] {
        for range in [
            Range::of(values.iter().copied()),
            Range::with_zero(values.iter().copied()),
            Range::positive(values.iter().copied()),
        ] {
            assert!(
                range.lo < range.hi && range.lo.is_finite() && range.hi.is_finite(),
                "{values:?}: {range:?}"
            );
        }
    }
}

proptest! {
    #[test]
    fn ticks_are_few_uniform_and_within_the_range(lo in -1e6..1e6f64, span_log in -6.0..6.0f64, count in 2.0..12.0f64) {
        let range = Range::new(lo, lo + 10f64.powf(span_log));
        let (ticks, step) = linear_ticks(range, count);
        let slack = 1e-6 * (range.hi - range.lo) + 1e-9 * lo.abs();
        prop_assert!(ticks.len() >= 2 && ticks.len() <= 61);
        prop_assert!(ticks.iter().all(|t| *t >= range.lo - slack && *t <= range.hi + slack));
        prop_assert!(ticks.windows(2).all(|p| (p[1] - p[0] - step).abs() <= 1e-6 * step + 1e-9 * lo.abs()));
        let lead = step / 10f64.powf(step.log10().floor());
        prop_assert!([1.0, 2.0, 5.0, 10.0].iter().any(|l| (lead - l).abs() < 1e-6), "step {step}");
    }

    #[test]
    fn scale_maps_the_range_to_its_ends(lo in -1e3..1e3f64, span in 1e-3..1e3f64) {
        let axis = Scale::linear(Range::new(lo, lo + span), [10.0, 110.0], 40.0);
        prop_assert!((axis.px(lo) - 10.0).abs() < 1e-6 && (axis.px(lo + span) - 110.0).abs() < 1e-6);
    }

    #[test]
    fn spread_labels_do_not_overlap(wanted in prop::collection::vec(-50.0..350.0f64, 0..40), size in 1.0..30.0f64) {
        let sizes = vec![size; wanted.len()];
        let placed = place_without_overlap(&wanted, &sizes, 0.0, 300.0);
        let mut kept: Vec<f64> = placed.iter().flatten().copied().collect();
        prop_assert_eq!(kept.len(), wanted.len().min((300.0 / size).floor() as usize));
        kept.sort_by(f64::total_cmp);
        prop_assert!(kept.windows(2).all(|p| p[1] - p[0] >= size - 1e-9));
        prop_assert!(kept.iter().all(|c| *c >= 0.5 * size - 1e-9 && *c <= 300.0 - 0.5 * size + 1e-9));
    }

    #[test]
    fn clipped_lines_stay_in_the_frame(points in prop::collection::vec((-1e9..1e9f64, -1e3..1e3f64), 0..30)) {
        let frame = Frame { x: 10.0, y: 20.0, w: 100.0, h: 50.0 };
        let points: Vec<[f64; 2]> = points.into_iter().map(|(x, y)| [x, y]).collect();
        for p in clip(&points, frame).iter().filter(|p| !p[0].is_nan()) {
            prop_assert!((9.99..=110.01).contains(&p[0]) && (19.99..=70.01).contains(&p[1]), "{p:?}");
        }
    }
}

#[test]
fn labels_without_overlap_keep_their_position() {
    assert_eq!(place_without_overlap(&[100.0, 50.0], &[10.0, 10.0], 0.0, 200.0), [Some(100.0), Some(50.0)]);
    // Two labels at one position are shifted equally.
    assert_eq!(place_without_overlap(&[100.0, 100.0], &[10.0, 10.0], 0.0, 200.0), [Some(95.0), Some(105.0)]);
    // No room for the third: the last in the list is dropped.
    assert_eq!(place_without_overlap(&[1.0, 2.0, 3.0], &[10.0; 3], 0.0, 20.0), [Some(5.0), Some(15.0), None]);
}

#[test]
fn clipping_cuts_a_line_at_the_frame() {
    let frame = Frame { x: 0.0, y: 0.0, w: 10.0, h: 10.0 };
    assert_eq!(clip(&[[-10.0, 5.0], [20.0, 5.0]], frame), [[0.0, 5.0], [10.0, 5.0]]);
    assert!(clip(&[[-10.0, 50.0], [20.0, 50.0]], frame).is_empty());
    assert!(clip(&[[5.0, f64::NAN], [20.0, 5.0]], frame).is_empty());
}
