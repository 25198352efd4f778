//! The force without tangents (explicit integration) equals the force evaluated with tangents.

use crate::ball_bearing::Random;
use crate::ball_combinations::{angular, for_each_combination, lever, sample};
use crate::bearing::rig_6205;
use rotordyn_bearing::{
    BallBearing, BearingModel, Defect, DefectForm, DefectLaw, Fit, OffSize, Reaction, Rotation, Shape,
    Surface,
};

/// Compares both evaluations, which differ only in the summation order over balls.
pub fn compare(name: &str, bearing: &BallBearing, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) {
    let element = bearing.element();
    let whole = element.reaction(d, v, rotation);
    let mut alone = Reaction::default();
    element.force(d, v, rotation, &mut alone);
    // Sum of ball loads, which may cancel in the resultant, plus damping at 0.01 m/s.
    let loads: f64 =
        element.contact_loads(d, rotation).iter().map(|b| b.load.abs().max(b.outer_load.abs()) + 3.0).sum();
    for k in 0..6 {
        let error = (alone.force[k] - whole.force[k]) / lever(k);
        assert!(error.abs() < 1e-14 * loads, "{name}: force {k} {error:e} of {loads}");
    }
    let same = |what: &str, alone: f64, whole: f64, size: f64| {
        assert!((alone - whole).abs() <= 1e-13 * size, "{name}: {what} {alone:e} instead of {whole:e}");
    };
    same("energy", alone.elastic_energy, whole.elastic_energy, whole.elastic_energy.abs());
    same("power", alone.parametric_power, whole.parametric_power, 0.1 * loads);
    same("loss", alone.dissipated_power, whole.dissipated_power, 0.1 * loads);
    same("mean cos", alone.mean_cos, whole.mean_cos, 1.0);
}

#[test]
fn force_only_for_every_combination() {
    let mut random = Random(17);
    for_each_combination(|name, bearing| {
        let (d, v, rotation) = sample(&mut random);
        compare(name, bearing, &d, &v, &rotation);
    });
}

/// Rings that grow by rotation: the clearance depends on speed (2500 rad/s takes micrometres off it).
#[test]
fn force_only_with_centrifugal_growth() {
    let mut random = Random(16);
    for mut bearing in [rig_6205(), angular()] {
        bearing.fit = Fit { speed_growth: true, ..bearing.fit };
        for _ in 0..20 {
            let (d, v, rotation) = sample(&mut random);
            compare("centrifugal growth", &bearing, &d, &v, &rotation);
        }
    }
}

/// Full and partially filled SIMD lanes.
#[test]
fn force_only_for_any_number_of_balls() {
    let mut random = Random(18);
    for balls in 2..=40 {
        for mut bearing in [rig_6205(), angular()] {
            bearing.geometry.pitch_diameter = 120e-3;
            bearing.geometry.balls = balls;
            let (d, v, rotation) = sample(&mut random);
            compare(&format!("{balls} balls"), &bearing, &d, &v, &rotation);
        }
    }
}

/// Balls on and next to narrow and wide defects, for every defect law, at small steps of the cage angle.
#[test]
fn force_only_for_races_with_defects() {
    let dent = DefectForm::Dent { depth: None, shape: Shape::HalfSine };
    let bump = DefectForm::Bump { height: 3e-7, shape: Shape::Cap };
    let on = |on, start: f64, width, form| Defect { surface: on, row: None, start, width, form };
    let laws = [
        DefectLaw::Displacement,
        DefectLaw::UndampedDisplacement,
        DefectLaw::Force { stiffness: None, loaded_only: true },
    ];
    let mut random = Random(19);
    let mut seen = 0;
    for law in laws {
        for balls in [3, 9, 33] {
            for sized in [false, true] {
                let mut bearing = rig_6205();
                bearing.geometry.pitch_diameter = 120e-3;
                bearing.geometry.balls = balls;
                bearing.geometry.radial_clearance = -6e-6;
                bearing.imperfections.law = law;
                bearing.imperfections.defects = vec![
                    on(Surface::Outer, 0.0, 2e-3, bump),
                    on(Surface::Outer, 6.2, 9e-3, bump),
                    on(Surface::Inner, 0.3, 1e-3, dent),
                ];
                if sized {
                    bearing.imperfections.off_size =
                        vec![OffSize { ball: 1, diameter_difference: 1e-7, row: None }];
                }
                let perfect = {
                    let mut bearing = bearing.clone();
                    bearing.imperfections = Default::default();
                    bearing.element()
                };
                let element = bearing.element();
                for step in 0..200 {
                    let (d, v, mut rotation) = sample(&mut random);
                    let d = d.map(|d| 0.1 * d);
                    rotation.cage_angle = 0.01 * step as f64;
                    rotation.shaft_angle = 0.03 * step as f64;
                    compare(&format!("{law:?} {balls} {sized} {step}"), &bearing, &d, &v, &rotation);
                    let [defective, nominal] =
                        [&element, &perfect].map(|e| e.reaction(&d, &v, &rotation).force);
                    seen += usize::from(defective != nominal);
                }
            }
        }
    }
    assert!(seen > 1000, "{seen} with a ball on a defect");
}
