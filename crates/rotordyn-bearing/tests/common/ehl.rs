//! Lubricated contacts of the EHL tests.

use rotordyn_bearing::contact::ehl::{Domain, Grid, Problem};
use rotordyn_bearing::contact::{EllipticContact, Lubricant};
use rotordyn_bearing::material::Material;

pub fn steel(young: f64) -> Material {
    let shear = young / 2.6;
    Material { name: "steel".into(), young, shear, poisson: 0.3, density: 7850.0 }
}

/// Circular contact of Moes parameters M = Q/(E′ R²) (2U)^{−3/4} and L = α E′ (2U)^{1/4}, U = η₀ u/(E′ R),
/// E′ = 2 E*: E 206 GPa, ν 0.3, R 10 mm, η₀ 0.04 Pa s, α 2.2e-8 1/Pa (so Roelands' z is 0.668).
pub fn circular(m: f64, l: f64, nodes: usize) -> Problem {
    let radius = 10e-3;
    let contact = EllipticContact::new(1.0 / radius, 1.0 / radius, [&steel(206e9), &steel(206e9)]);
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.2e-8, density: 870.0 };
    let modulus = 2.0 * contact.modulus;
    let twice_velocity = (l / (lubricant.pressure_viscosity * modulus)).powi(4);
    let speed = 0.5 * twice_velocity * modulus * radius / lubricant.viscosity;
    let load = m * modulus * radius * radius * twice_velocity.powf(0.75);
    let domain = Domain { inlet: 4.5, outlet: 1.5, side: 3.0 };
    Problem { contact, lubricant, speed, load, grid: Grid { nx: nodes, ny: nodes, domain } }
}
