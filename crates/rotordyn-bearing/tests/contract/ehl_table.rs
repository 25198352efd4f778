//! Tabulated EHL solution as a contact law: interpolation, tangents, energy, limits, storage.

use crate::lubricated::steel;
use rotordyn_bearing::contact::ehl::{EhlError, EhlLaw, Table, TableSpec, geometric};
use rotordyn_bearing::contact::{
    BallContacts, ContactLaw, EllipticContact, FilmFormula, HertzPair, Lubricant, Race,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};

fn spec() -> TableSpec {
    let contact = EllipticContact::new(160.0, 9.0, [&steel(2.07e11), &steel(2.07e11)]);
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.05, pressure_viscosity: 2e-8, density: 870.0 };
    TableSpec {
        contact,
        lubricant,
        loads: geometric(10.0, 1000.0, 4),
        speeds: vec![2.0, 5.0, 12.0],
        points: 3,
    }
}

static TABLE: LazyLock<Table> = LazyLock::new(|| spec().compute(|_, _| ()).unwrap());

fn loads() -> impl Iterator<Item = f64> {
    geometric(1e-5, 1e5, 201).into_iter()
}

#[test]
fn table_reproduces_its_nodes() {
    for (u, speed) in TABLE.speeds.iter().enumerate() {
        let curve = TABLE.at_speed(*speed);
        for (q, &load) in TABLE.loads.iter().enumerate() {
            let dry = (load / TABLE.stiffness).powf(2.0 / 3.0);
            let shift = dry - curve.approach(load)[0];
            assert!((shift / TABLE.shift[u][q] - 1.0).abs() < 1e-10);
            assert!((curve.central_film(load) / TABLE.central_film[u][q] - 1.0).abs() < 1e-10);
            // The film reduces the approach by slightly more than its thickness: the inlet wedge carries load
            // too.
            let ratio = TABLE.shift[u][q] / TABLE.central_film[u][q];
            assert!((1.0..1.8).contains(&ratio), "{ratio} at {speed} m/s, {load} N");
        }
    }
}

#[test]
fn load_inverts_approach_with_slope_and_energy() {
    for speed in [0.0, 0.01, 2.0, 3.3, 12.0, 40.0] {
        let curve = TABLE.at_speed(speed);
        for load in loads() {
            let [approach, slope] = curve.approach(load);
            let found = curve.load(approach);
            // Film and deformation cancel in δ; the load is accurate to the round-off of δ over the slope.
            let known = 1e-12 * load + 1e-15 * (approach.abs() + curve.zero_load_film()) / slope;
            assert!((found.load - load).abs() < 1e3 * known, "{speed} {load}: {}", found.load);
            assert!((found.slope * slope - 1.0).abs() < 1e-6, "{speed} {load}");
            let step = 1e-4 * (load * slope).min(approach.abs() + curve.zero_load_film());
            let [up, down] = [approach + step, approach - step].map(|a| curve.load(a));
            let difference = (up.load - down.load) / (2.0 * step);
            assert!(
                (difference / found.slope - 1.0).abs() < 1e-3,
                "{speed} {load}: {difference} {}",
                found.slope
            );
            let power = (up.energy - down.energy) / (2.0 * step);
            assert!((power / load - 1.0).abs() < 1e-3, "{speed} {load}: {power}");
        }
    }
}

#[test]
fn curves_in_series_add_approaches() {
    let (slow, fast, dry) = (TABLE.at_speed(2.0), TABLE.at_speed(12.0), TABLE.at_speed(0.0));
    for (first, second) in [(&slow, &fast), (&fast, &dry), (&dry, &slow), (&dry, &dry)] {
        let both = first.in_series(second);
        for &load in &TABLE.loads {
            let sum = first.approach(load)[0] + second.approach(load)[0];
            let scale = (load / TABLE.stiffness).powf(2.0 / 3.0);
            assert!((both.approach(load)[0] - sum).abs() < 1e-12 * scale);
        }
        let [sum, sum_slope] = [0, 1].map(|k| first.approach(77.0)[k] + second.approach(77.0)[k]);
        let [approach, slope] = both.approach(77.0);
        assert!((approach / sum - 1.0).abs() < 5e-3 && (slope / sum_slope - 1.0).abs() < 2e-2);
    }
}

#[test]
fn no_load_beyond_film_reach() {
    let curve = TABLE.at_speed(5.0);
    let reach = curve.zero_load_film();
    assert!(reach > TABLE.central_film[1][0]);
    assert_eq!(curve.load(-reach * (1.0 + 1e-12)), rotordyn_bearing::contact::ContactLoad::default());
    let just = curve.load(-reach * (1.0 - 1e-9));
    assert!(just.load > 0.0 && just.load < 1e-6 && just.slope > 0.0 && just.energy > 0.0);
    assert!(curve.load(f64::NAN).load.is_nan());
}

#[test]
fn approach_is_monotone_and_dry_at_zero_speed() {
    for pair in loads().collect::<Vec<_>>().windows(2) {
        for speed in [0.1, 2.0, 7.0] {
            let curve = TABLE.at_speed(speed);
            assert!(curve.approach(pair[1])[0] > curve.approach(pair[0])[0]);
        }
    }
    let speeds = geometric(1e-3, 100.0, 60);
    let approaches =
        |load: f64| speeds.iter().map(move |&u| TABLE.at_speed(u).approach(load)[0]).collect::<Vec<_>>();
    for load in [1.0, 30.0, 500.0] {
        assert!(approaches(load).windows(2).all(|pair| pair[1] < pair[0]));
        let dry = (load / TABLE.stiffness).powf(2.0 / 3.0);
        assert_eq!(TABLE.at_speed(0.0).approach(load)[0], dry);
        assert!((TABLE.at_speed(1e-9).approach(load)[0] / dry - 1.0).abs() < 1e-4);
    }
    assert_eq!(TABLE.at_speed(0.0).zero_load_film(), 0.0);
}

/// Far outside the tabulated loads the film has the load exponent of Hamrock and Dowson.
#[test]
fn hamrock_dowson_exponent_outside_load_range() {
    let curve = TABLE.at_speed(5.0);
    for load in [0.1, 1e5] {
        let power = (curve.central_film(1.01 * load) / curve.central_film(load)).ln() / 1.01_f64.ln();
        assert!((power + 0.067).abs() < 1e-9, "{power}");
    }
}

#[test]
fn table_is_independent_of_threads_and_serialisation() {
    let calls = AtomicUsize::new(0);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let small = TableSpec { loads: vec![50.0, 500.0], speeds: vec![2.0, 5.0], ..spec() };
    let count = |done: usize, total: usize| {
        assert!(done <= total && total == 4);
        calls.fetch_add(1, Ordering::Relaxed);
    };
    let alone = one.install(|| small.compute(count)).unwrap();
    assert_eq!(calls.load(Ordering::Relaxed), 4);
    assert_eq!(alone, small.compute(|_, _| ()).unwrap());
    let text = serde_json::to_string(&alone).unwrap();
    assert_eq!(serde_json::from_str::<Table>(&text).unwrap(), alone);
}

#[test]
fn cache_key_depends_on_every_input() {
    let base = spec();
    let mut others = vec![base.clone(); 6];
    others[0].points += 1;
    others[1].speeds.push(20.0);
    others[2].loads[0] *= 1.0 + 1e-15;
    others[3].lubricant.viscosity *= 1.01;
    others[4].lubricant.pressure_viscosity *= 1.01;
    others[5].contact = EllipticContact::new(160.0, 9.1, [&steel(2.07e11), &steel(2.07e11)]);
    assert!(others.iter().all(|other| other.key() != base.key()));
    assert_eq!(base.key(), spec().key());
    assert_eq!(TABLE.key, base.key());
}

#[test]
fn unsorted_table_axes_are_rejected() {
    for (loads, speeds) in [(vec![10.0, 5.0], vec![1.0]), (vec![], vec![1.0]), (vec![1.0], vec![0.0, 1.0])] {
        let wrong = TableSpec { loads, speeds, ..spec() };
        assert!(matches!(wrong.compute(|_, _| ()), Err(EhlError::Input { .. })));
    }
}

/// EHL contact law with synthetic tables instead of solved ones: close to the film formula, with exponents of
/// load and speed that vary over the range.
pub fn tabulated(hertz: &HertzPair) -> ContactLaw {
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.3e-8, density: 870.0 };
    let mut law = EhlLaw {
        lubricant,
        speed_factor: 1.0,
        loads: [2.0, 2000.0],
        speeds: [0.5, 20.0],
        counts: [6, 4],
        points: 6,
        tables: None,
    };
    let tables = law.specs(hertz).map(|spec| {
        let formula = FilmFormula::new(&spec.contact, &spec.lubricant);
        let film = |factor: f64| -> Vec<Vec<f64>> {
            let at = |u: f64, q: f64| factor * formula.central(u, q) * (1.0 + 0.02 * (u * q).ln().sin());
            spec.speeds.iter().map(|&u| spec.loads.iter().map(|&q| at(u, q)).collect()).collect()
        };
        Table {
            key: spec.key(),
            stiffness: spec.contact.stiffness,
            loads: spec.loads.clone(),
            speeds: spec.speeds.clone(),
            shift: film(1.07),
            central_film: film(1.0),
            minimum_film: film(0.8),
        }
    });
    law.tables = Some(Arc::new(tables));
    ContactLaw::Ehl(law)
}

/// The approach of both contacts under one load is the sum of the single approaches.
#[test]
fn contacts_in_series_add_their_approaches() {
    let steel = crate::bearing::steel();
    let hertz = HertzPair::new(9.5e-3, 46e-3, [4.9e-3, 5.06e-3], 0.6, &steel, &steel);
    let contacts = BallContacts::new(hertz, tabulated(&hertz));
    let at = contacts.at_speed(3.0);
    for approach in [-1e-7, 1e-6, 5e-6, 3e-5] {
        let load = at.series(approach).load;
        let own = |race| {
            // Bisection on the law of the single contact.
            let (mut low, mut high) = (-1e-5, 1e-4);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if at.single(race, middle).load < load { low = middle } else { high = middle }
            }
            low
        };
        let sum = own(Race::Inner) + own(Race::Outer);
        // Cubic interpolation in logarithms is exact for the sum only at knots.
        assert!((sum - approach).abs() < 2e-3 * approach.abs() + 1e-9, "{approach:e} {sum:e}");
    }
}
