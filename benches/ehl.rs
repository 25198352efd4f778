//! Speed of one elastohydrodynamic (EHL) contact solved from scratch, and of the tabulated contact law.
//!
//! 121 × 57 nodes over the whole domain, 29 rows solved by symmetry; three nested grids.

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::contact::ehl::{self, Domain, Grid, Problem, TableSpec};
use rotordyn::contact::{EllipticContact, Lubricant};
use std::hint::black_box;

#[path = "../crates/rotordyn-bearing/tests/common/ehl.rs"]
mod lubricated;

fn solver(c: &mut Criterion) {
    let circular = Problem {
        grid: Grid { nx: 121, ny: 57, domain: Domain { inlet: 4.5, outlet: 1.5, side: 3.0 } },
        ..lubricated::circular(20.0, 10.0, 121)
    };
    c.bench_function("circular contact M 20 L 10, 121x57", |b| {
        b.iter(|| ehl::solve(black_box(&circular), None));
    });

    // Zhang's inner race, 10 m/s, 1000 N.
    let ball = 17e-3;
    let across = 2.0 / ball - 1.0 / (0.54 * ball);
    let steel = lubricated::steel(2.07e11);
    let contact = EllipticContact::new(2.0 / ball + 2.0 / 48e-3, across, [&steel, &steel]);
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.096, pressure_viscosity: 1.82e-8, density: 870.0 };
    let (speed, load) = (10.0, 1000.0);
    let domain = Grid::flooded(&contact, &lubricant, speed, load, 6).domain;
    let grid = Grid { nx: 121, ny: 57, domain };
    let elliptic = Problem { contact, lubricant: lubricant.clone(), speed, load, grid };
    c.bench_function("elliptic contact of a ball and race, 121x57", |b| {
        b.iter(|| ehl::solve(black_box(&elliptic), None));
    });

    let spec = TableSpec {
        contact,
        lubricant,
        loads: vec![50.0, 200.0, 1000.0],
        speeds: vec![5.0, 10.0],
        points: 3,
    };
    let table = spec.compute(|_, _| ()).expect("the contact is well lubricated");
    let curve = table.at_speed(7.0);
    c.bench_function("load at an approach from a table", |b| b.iter(|| curve.load(black_box(5e-6))));
}

criterion_group! { name = benches; config = Criterion::default().sample_size(10); targets = solver }
criterion_main!(benches);
