//! Overlap detection of bearing parts, without false overlaps.

use crate::agree;
use nalgebra::{Isometry3, Vector3};
use rotordyn::bearing::BallBearing;
use rotordyn::geometry::parry::{Overlap, Part};
use rotordyn::geometry::{BearingShapes, Race};

use crate::bearing::rig_6205;

/// Elastic approaches of a bearing are a few micrometres.
const ALLOWANCE: f64 = 50e-6;

fn shapes(bearing: &BallBearing) -> BearingShapes {
    BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter)
}

fn overlaps(bearing: &BallBearing) -> Vec<Overlap> {
    let shapes = shapes(bearing);
    shapes.overlaps(&shapes.centred(0.2), ALLOWANCE)
}

fn depth(found: &[Overlap], first: Part, second: Part) -> f64 {
    found
        .iter()
        .find(|o| o.first == first && o.second == second)
        .unwrap_or_else(|| panic!("{first} and {second} not among {found:?}"))
        .depth
}

#[test]
fn rig_bearing_has_no_overlaps() {
    assert_eq!(overlaps(&rig_6205()), []);
    for contact_angle in [15f64, 25.0, 40.0] {
        let mut bearing = rig_6205();
        bearing.geometry.contact_angle = contact_angle.to_radians();
        assert_eq!(overlaps(&bearing), [], "{contact_angle}");
    }
}

#[test]
fn adjacent_balls_overlap_by_diameter_minus_chord() {
    let mut bearing = rig_6205();
    bearing.geometry.balls = 16;
    let found = overlaps(&bearing);
    let expected = 7.938e-3 - 38.5e-3 * (std::f64::consts::PI / 16.0).sin();
    let first = depth(&found, Part::Ball(0), Part::Ball(1));
    agree::absolute("depth of overlap, first pair [m]", first, expected, 1e-16);
    assert_eq!(found.iter().filter(|o| matches!(o.second, Part::Ball(_))).count(), 16);
    assert!(depth(&found, Part::Pocket(15), Part::Pocket(0)) > 0.0);
    assert!(found[0].to_string().contains("cage pocket 1 and cage pocket 2 overlap by"), "{}", found[0]);
}

#[test]
fn tight_pocket_and_interference_are_reported() {
    let mut bearing = rig_6205();
    bearing.cage_pocket_diameter = 7.9e-3;
    let found = overlaps(&bearing);
    let first = depth(&found, Part::Ball(4), Part::Cage);
    agree::absolute("depth of overlap of ball and pocket [m]", first, 0.019e-3, 1e-15);

    let mut bearing = rig_6205();
    bearing.geometry.radial_clearance = -0.4e-3;
    let found = overlaps(&bearing);
    // Clearance is shared by the rings: a quarter of the diametral one at each contact.
    let first = depth(&found, Part::Ball(0), Part::InnerRing);
    agree::absolute("depth of overlap, interference [m]", first, 0.1e-3, 1e-15);
    agree::absolute(
        "depth of ball in the outer ring [m]",
        depth(&found, Part::Ball(0), Part::OuterRing),
        0.1e-3,
        1e-15,
    );
}

#[test]
fn grooves_cutting_bore_outside_or_faces_are_reported() {
    let mut bearing = rig_6205();
    bearing.geometry.bore = 31e-3;
    bearing.geometry.outside_diameter = 46e-3;
    bearing.geometry.width = 6e-3;
    let found = overlaps(&bearing);
    // Groove bottom diameters are D_pw ∓ (D_w + P_d/2).
    let bottom = 38.5e-3 - 7.938e-3 - 5e-6;
    let first = depth(&found, Part::Groove(Race::Inner), Part::Bore);
    agree::absolute("depth of ball and cage [m]", first, 0.5 * (31e-3 - bottom), 1e-15);
    assert!(depth(&found, Part::Groove(Race::Outer), Part::OutsideSurface) > 0.2e-3);
    assert!(depth(&found, Part::Groove(Race::Inner), Part::SideFace) > 0.0);
    assert!(depth(&found, Part::Pocket(0), Part::SideFace) > 0.0);
}

#[test]
fn displaced_ring_overlaps_balls_cage_and_outer_ring() {
    let shapes = shapes(&rig_6205());
    let mut at = shapes.centred(0.0);
    at.inner = Isometry3::translation(6e-3, 0.0, 0.0);
    let found = shapes.overlaps(&at, ALLOWANCE);
    let play = shapes.outer.shoulder_radius - shapes.inner.shoulder_radius;
    agree::absolute(
        "depth of the rings [m]",
        depth(&found, Part::InnerRing, Part::OuterRing),
        6e-3 - play,
        1e-15,
    );
    assert!(depth(&found, Part::InnerRing, Part::Cage) > 4e-3);
    assert!(depth(&found, Part::Ball(0), Part::InnerRing) > 1e-3);
    // A ball fixed at the pitch radius permits an axial offset of √(e² − (e − P_d/4)²), e = r_i − D_w/2.
    let e: f64 = 0.015 * 7.938e-3;
    let play = (e * e - (e - 2.5e-6) * (e - 2.5e-6)).sqrt();
    at.inner = Isometry3::new(Vector3::new(0.0, 0.0, 0.999 * play), Vector3::zeros());
    assert_eq!(shapes.overlaps(&at, 0.0), []);
    at.inner = Isometry3::new(Vector3::new(0.0, 0.0, 1.001 * play), Vector3::zeros());
    assert_eq!(shapes.overlaps(&at, 0.0).len(), 9);
}
