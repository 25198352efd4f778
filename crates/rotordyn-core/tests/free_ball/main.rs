//! Study of one bearing with free balls: balance with the load, settling, slip over load and speed, comparison.

#[allow(dead_code)] // the tests of the bearing crate use the rest
#[path = "../../../rotordyn-bearing/tests/free_ball/bearings.rs"]
mod bearings;

use bearings::{ball_bearing, free, geometry_6205, plastic_cage, rpm, touch};
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::free_ball::{Drag, FreeBallBearing, Guidance, Land, Pocket, SlipModel};
use rotordyn_core::model::free_ball_study::{FreeBallStudy, SkiddingMapStudy};
use rotordyn_core::results::SkiddingMap;
use rotordyn_core::study::free_ball::{FreeBallStudyError, skidding_map, steady_run};
use std::ops::ControlFlow;

/// A 6205 with a cage on the land of the outer ring, without friction there, that the lubricant holds back by a drag \[N m s/rad\].
fn bearing(drag: f64, slip: SlipModel) -> FreeBallBearing {
    let mut bearing = free(ball_bearing(geometry_6205(9, 10e-6)), 0.06, 5e-2, slip);
    bearing.damping = 2.0;
    let (radius, contact) = (21.6e-3, touch(1e6, 5.0, 0.0));
    let land = Land { race: Race::Outer, radius, clearance: 0.1e-3, width: 10e-3, contact };
    let guidance = Guidance::Land(land);
    bearing.cage = Some(plastic_cage(Pocket::Cylindrical, guidance, 0.0));
    bearing.drag = Drag { cage_moment: drag, ..Drag::default() };
    bearing
}

fn settings(force: [f64; 3], speed_rpm: f64) -> FreeBallStudy {
    FreeBallStudy { recorded_turns: 2, ..FreeBallStudy::new(force, rpm(speed_rpm)) }
}

/// The mean force balances a combined load to 0.1 %, and the power of the ring's torque is the heat: over a steady record
/// nothing is stored but what the cage speed still gains, of the order of the drift.
#[test]
fn force_balances_the_load_and_heat_the_power() {
    for slip in [SlipModel::Centre, SlipModel::default()] {
        let load = [0.0, -100.0, 150.0];
        let found = steady_run("6205", &bearing(2e-5, slip), &settings(load, 6000.0)).unwrap();
        let rest: f64 = (0..3).map(|k| (load[k] + found.force[k]).powi(2)).sum::<f64>().sqrt();
        let heat: f64 = found.losses.iter().sum();
        println!(
            "{slip:?}: slip {:.2e} after {:.3} s, force {:.3?} N, torque {:.4e} N m, heat {heat:.4} W, pockets {:.3} N",
            found.slip, found.settling_time, found.force, found.friction_torque, found.pocket_rms
        );
        assert!(rest < 1e-3 * 180.3, "{rest}");
        assert!((found.friction_torque * found.speed / heat - 1.0).abs() < 5e-3, "{heat}");
        // Every ball carries load under this thrust: no skidding, and the cage is where its pockets hold it.
        assert!(found.slip.abs() < 2e-3 && found.comparison.is_good_enough(), "{}", found.slip);
        assert!(found.balls.iter().all(|ball| ball.loads.iter().all(|load| *load > 1.0)));
        // Outer contact angles are smaller by the centrifugal force; spin axes lie between both.
        for ball in &found.balls {
            let [inner, outer] = ball.angles.map(f64::abs);
            assert!(outer < inner && inner < 0.6, "{inner} {outer}");
        }
        // Drag of the cage, c ω_c², is the drag's share of the heat.
        let drag = 2e-5 * found.cage_speed * found.cage_speed;
        assert!((found.losses[7] / drag - 1.0).abs() < 1e-2, "{drag}");
        assert!(
            found.record.cage_x.len() == found.record.time.len() && found.pocket_peak >= found.pocket_rms
        );
    }
}

fn map() -> SkiddingMap {
    let study = SkiddingMapStudy {
        point: FreeBallStudy { drift: 2e-3, ..settings([0.0, 0.0, 1.0], 1.0) },
        loads: vec![10.0, 100.0, 1000.0],
        speeds: vec![rpm(6000.0), rpm(20000.0)],
    };
    skidding_map("6205", &bearing(1e-4, SlipModel::Centre), &study, &|_| ControlFlow::Continue(())).unwrap()
}

/// Slip falls with load and grows with speed; a loaded bearing does not skid, a light one at high speed does.
///
/// Measured on a 120 mm angular contact bearing up to 25 000 rpm: slip in general grows with speed at a given load, up to
/// 6 % (NASA TN D-7870, Bamberger, Zaretsky & Signer 1975, abstract). Here the cage's drag is chosen, so only the trend is
/// compared.
#[test]
fn cage_skids_at_light_load_and_high_speed() {
    let found = map();
    for (k, load) in found.loads.iter().enumerate() {
        println!("{load:6} N: {:.4} {:.4}", found.slip_at(k, 0), found.slip_at(k, 1));
    }
    assert_eq!(found.failures, [""; 0]);
    for k in 0..3 {
        assert!(found.slip_at(k, 1) > found.slip_at(k, 0) - 1e-3, "{k}");
        assert!(k == 0 || (0..2).all(|j| found.slip_at(k, j) < found.slip_at(k - 1, j) + 1e-3), "{k}");
    }
    assert!(found.slip_at(2, 0).abs() < 2e-3 && found.slip_at(2, 1).abs() < 2e-3);
    assert!(found.slip_at(0, 1) > 0.1, "{}", found.slip_at(0, 1));
}

/// A map that is stopped after its first point keeps that point and says that it is not complete.
#[test]
fn stopped_map_keeps_the_points_done() {
    let study = SkiddingMapStudy {
        point: FreeBallStudy { drift: 2e-3, ..settings([0.0, 0.0, 1.0], 1.0) },
        loads: vec![1000.0],
        speeds: vec![rpm(6000.0), rpm(7000.0), rpm(8000.0)],
    };
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let after_one = |done: usize| if done < 1 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let found = one_thread
        .install(|| skidding_map("6205", &bearing(1e-4, SlipModel::Centre), &study, &after_one))
        .unwrap();
    assert!(!found.complete && found.failures.is_empty());
    assert_eq!(found.slip.iter().filter(|slip| slip.is_finite()).count(), 1, "{:?}", found.slip);
    assert!(map().complete);
}

#[test]
fn map_does_not_depend_on_the_number_of_threads() {
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(map);
    let [one, two] = [on(1), on(2)];
    assert_eq!(one.failures, [""; 0]);
    assert_eq!(one, two);
}

/// A skidding cage shifts the BPFO beyond the resolution of a record.
#[test]
fn kinematic_cage_is_refused_for_a_skidding_bearing() {
    let study = FreeBallStudy { drift: 2e-3, ..settings([0.0, 0.0, 10.0], 20000.0) };
    let found = steady_run("6205", &bearing(1e-4, SlipModel::Centre), &study).unwrap();
    let c = &found.comparison;
    println!("settled after {:.3} s", found.settling_time);
    println!("BPFO shift {:.2} Hz, limit {:.2} Hz: {}", c.shift_hz, c.limit_hz, c.assessment());
    assert!(!c.is_good_enough() && c.shift_hz < 0.0);
    assert!(
        (c.shift_hz / (c.kinematic.bpfo * rpm(20000.0) / std::f64::consts::TAU) + found.slip).abs() < 1e-12
    );
    assert!((c.bpfo / c.ftf - 9.0).abs() < 1e-12);
}

/// Parts that share space at the start are named with their overlap: balls 125 um deep in both races.
#[test]
fn overlap_at_the_start_is_refused_by_name() {
    let mut pressed = bearing(2e-5, SlipModel::Centre);
    pressed.ball.geometry.radial_clearance = -0.5e-3;
    let error = steady_run("6205", &pressed, &settings([0.0, -100.0, 0.0], 6000.0)).unwrap_err();
    println!("{error}");
    let text = error.to_string();
    assert!(matches!(error, FreeBallStudyError::Overlap { .. }), "{text}");
    assert!(text.starts_with("bearing 6205: ball ") && text.ends_with("mm at the start"), "{text}");
}

#[test]
fn runs_without_steady_state_are_refused_by_name() {
    let light = FreeBallStudy { settling_turns: 10, ..settings([0.0, 0.0, 2.0], 20000.0) };
    let error = steady_run("6205", &bearing(2e-5, SlipModel::Centre), &light).unwrap_err();
    println!("{error}");
    assert!(matches!(error, FreeBallStudyError::NotSettled { turns: 10, .. }), "{error}");
    let error = steady_run("6205", &bearing(0.0, SlipModel::Centre), &settings([0.0, -10.0, 0.0], 0.0));
    assert_eq!(
        error.unwrap_err().to_string(),
        "bearing 6205 with free balls needs a speed for its cage to turn"
    );
}
