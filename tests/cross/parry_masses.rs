//! Closed-form masses and inertias compared with parry's integration over triangle meshes.
//!
//! An inscribed mesh with n facets has an error of O(n⁻²): it must fall to a quarter when n doubles, and the
//! value extrapolated from two meshes must equal the closed form.

use crate::agree;
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;
use rotordyn::geometry::mesh::Mesh;
use rotordyn::geometry::{BearingShapes, RevolvedSolid};

use crate::bearing::rig_6205;

const DENSITY: f64 = 7850.0;

/// m, z_c, I_p and I_d of a mesh.
fn by_mesh(mesh: &Mesh) -> [f64; 4] {
    let vertices: Vec<Vector> = mesh.positions.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect();
    let p = MassProperties::from_trimesh(DENSITY, &vertices, &mesh.triangles);
    let inertia = p.reconstruct_inertia_matrix();
    agree::curve("principal axis of the solid", inertia.x_axis.y.abs(), inertia.x_axis.x, 1e-9);
    [p.mass(), p.local_com.z, inertia.z_axis.z, 0.5 * (inertia.x_axis.x + inertia.y_axis.y)]
}

fn check(name: &str, solid: &RevolvedSolid, mesh: impl Fn(usize) -> Mesh, tolerance: f64) {
    let exact = [solid.mass, solid.centre_z, solid.polar, solid.diametral];
    let (coarse, fine) = (by_mesh(&mesh(1)), by_mesh(&mesh(2)));
    for k in [0, 2, 3] {
        let ratio = (coarse[k] - exact[k]) / (fine[k] - exact[k]);
        let limit = (4.0 * fine[k] - coarse[k]) / 3.0;
        println!(
            "{name} {k}: {:e}, mesh limit off by {:.1e}, ratio {ratio:.4}",
            exact[k],
            limit / exact[k] - 1.0
        );
        agree::relative(format_args!("{name}: property {k}"), limit, exact[k], tolerance);
        agree::absolute(format_args!("{name}: error over half the segments, property {k}"), ratio, 4.0, 0.1);
    }
    agree::absolute(format_args!("{name}: centre [m]"), fine[1], exact[1], 1e-7);
}

/// The error after extrapolation is O(n⁻⁴): with 128 and 256 facets about (2π/128)⁴/30 = 2e-7.
#[test]
fn mass_of_balls_and_rings() {
    let mut bearing = rig_6205();
    for contact_angle in [0.0, 0.5] {
        bearing.geometry.contact_angle = contact_angle;
        let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
        let masses = shapes.masses(DENSITY, DENSITY, DENSITY);
        check("ball", &masses.ball, |n| Mesh::ball(shapes.ball_diameter, 128 * n), 1e-6);
        check("inner", &masses.inner, |n| Mesh::ring(&shapes.inner, 128 * n, 64 * n), 1e-6);
        check("outer", &masses.outer, |n| Mesh::ring(&shapes.outer, 128 * n, 64 * n), 1e-6);
    }
}

#[test]
fn mass_of_cage() {
    let bearing = rig_6205();
    let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
    let solid = shapes.masses(DENSITY, DENSITY, DENSITY).cage;
    check("cage", &solid, |n| Mesh::cage(&shapes.cage, 64 * n, 8 * n), 1e-6);
}

/// Catalogues give about 0.128 kg for a 6205. Ours lacks the rings' chamfers and recesses and has a solid
/// cage in place of a ribbon, so it is somewhat heavier.
#[test]
fn catalogue_mass_of_6205() {
    let bearing = rig_6205();
    let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
    let m = shapes.masses(7850.0, 7850.0, 7850.0);
    let total = m.inner.mass + m.outer.mass + m.cage.mass + 9.0 * m.ball.mass;
    assert!((0.128..0.15).contains(&total), "{total}");
}
