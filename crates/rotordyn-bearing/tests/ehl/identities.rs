//! Elastohydrodynamic point contact: load and mass balance, symmetry, dry limit, film shape, failures.

use crate::lubricated::circular;
use rotordyn_bearing::contact::ehl::{self, EhlError, Problem, Solution};

fn solved() -> (Problem, Solution) {
    let problem = circular(20.0, 10.0, 61);
    let solution = ehl::solve(&problem, None).unwrap();
    (problem, solution)
}

#[test]
fn pressure_carries_the_load_and_is_symmetric() {
    let (problem, s) = solved();
    let (dx, dy) = (s.x[1] - s.x[0], s.y[1] - s.y[0]);
    let carried: f64 = s.pressure.iter().sum::<f64>() * dx * dy;
    assert!((carried / problem.load - 1.0).abs() < 1e-8, "{carried}");
    assert!(s.pressure.iter().all(|&p| p >= 0.0) && s.film.iter().all(|&h| h > 0.0));
    // Symmetric in y; cavitated behind the contact.
    let ny = s.y.len();
    for (p, h) in s.pressure.chunks_exact(ny).zip(s.film.chunks_exact(ny)) {
        assert!((0..ny).all(|j| p[j] == p[ny - 1 - j] && h[j] == h[ny - 1 - j]));
    }
    assert!(
        s.x.iter().zip(s.pressure.chunks_exact(ny)).any(|(&x, p)| x > 0.0 && p.iter().all(|&p| p == 0.0))
    );
}

#[test]
fn pressure_spike_and_horseshoe() {
    let (problem, s) = solved();
    let ny = s.y.len();
    let centre: Vec<f64> = s.pressure.chunks_exact(ny).map(|row| row[ny / 2]).collect();
    let peaks: Vec<usize> =
        (1..centre.len() - 1).filter(|&i| centre[i] > centre[i - 1] && centre[i] >= centre[i + 1]).collect();
    assert_eq!(peaks.len(), 2, "Hertz maximum and spike, at {peaks:?}");
    let semi_axis = problem.contact.patch(problem.load).semi_minor;
    assert!(s.x[peaks[0]].abs() < 0.3 * semi_axis && s.x[peaks[1]] > 0.5 * semi_axis);
    // The film is flat in the centre and thinnest in the two side lobes (horseshoe).
    let least = s.film.iter().position(|&h| h == s.minimum_film).unwrap();
    assert!(s.y[least % ny].abs() > 0.4 * semi_axis && s.x[least / ny] > 0.0);
    assert!(s.minimum_film < 0.75 * s.central_film);
    let inside = s.film[s.x.partition_point(|&x| x < -0.4 * semi_axis) * ny + ny / 2];
    assert!((inside / s.central_film - 1.0).abs() < 0.06, "{}", inside / s.central_film);
}

/// Mass conservation over a rectangle around the contact: fluxes by central differences and the trapezoidal
/// rule, not by the finite volumes of the solver, so that the imbalance is discretisation error.
#[test]
fn mass_is_conserved() {
    let gaps = [61, 121].map(|nodes| {
        let problem = circular(20.0, 10.0, nodes);
        mass_imbalance(&problem, &ehl::solve(&problem, None).unwrap())
    });
    assert!(gaps[1].abs() < 0.01, "{gaps:?}");
    assert!((gaps[0] / gaps[1]).log2() > 1.5, "{gaps:?}");
}

/// Mass imbalance of the rectangle −1.8 < X < 0.3, |Y| < 1 relative to its inflow.
fn mass_imbalance(problem: &Problem, s: &Solution) -> f64 {
    let (nx, ny) = (s.x.len(), s.y.len());
    let (dx, dy) = (s.x[1] - s.x[0], s.y[1] - s.y[0]);
    let oil = &problem.lubricant;
    // Density ratio, film, and the factor of the pressure gradient in the flow.
    let at = |i: usize, j: usize| {
        let (p, h) = (s.pressure[i * ny + j], s.film[i * ny + j]);
        (oil.density_ratio(p), h, h.powi(3) / (12.0 * oil.viscosity * oil.viscosity_ratio(p)))
    };
    let along = |i: usize, j: usize| {
        let (density, h, mobility) = at(i, j);
        let slope = (s.pressure[(i + 1) * ny + j] - s.pressure[(i - 1) * ny + j]) / (2.0 * dx);
        density * (problem.speed * h - mobility * slope)
    };
    let across = |i: usize, j: usize| {
        let (density, _, mobility) = at(i, j);
        -density * mobility * (s.pressure[i * ny + j + 1] - s.pressure[i * ny + j - 1]) / (2.0 * dy)
    };
    let trapezoid = |values: Vec<f64>, step: f64| {
        step * (values.iter().sum::<f64>() - 0.5 * (values[0] + values[values.len() - 1]))
    };
    let column = |x: f64| ((x + 4.5) / 6.0 * (nx - 1) as f64).round() as usize;
    let (west, east) = (column(-1.8), column(0.3));
    let (south, north) = (ny / 2 - (ny - 1) / 6, ny / 2 + (ny - 1) / 6);
    let inflow = trapezoid((south..=north).map(|j| along(west, j)).collect(), dy);
    let outflow = trapezoid((south..=north).map(|j| along(east, j)).collect(), dy);
    let sideways = 2.0 * trapezoid((west..=east).map(|i| across(i, north)).collect(), dx);
    assert!(sideways > 0.2 * inflow, "side leakage out of the contact");
    (inflow - outflow - sideways) / inflow
}

/// The film shift falls as speed to the power of about 2/3 towards the dry contact.
#[test]
fn dry_limit_at_low_speed() {
    let shifts = [1.0, 0.5, 0.25].map(|factor| {
        let mut problem = circular(20.0, 10.0, 61);
        problem.speed *= factor;
        let s = ehl::solve(&problem, None).unwrap();
        let hertz = problem.contact.patch(problem.load).deflection;
        assert_eq!(s.dry_approach, hertz);
        assert!(s.film_shift() > 0.0);
        s.film_shift() / hertz
    });
    for pair in shifts.windows(2) {
        let exponent = (pair[0] / pair[1]).log2();
        assert!((exponent - 0.67).abs() < 0.12, "{exponent} of {shifts:?}");
    }
    assert!(shifts[2] < 0.2, "{shifts:?}");
}

#[test]
fn continuation_from_nearby_solution() {
    let (problem, s) = solved();
    let mut nearby = problem.clone();
    nearby.load *= 1.3;
    let direct = ehl::solve(&nearby, None).unwrap();
    let continued = ehl::solve(&nearby, Some(&s)).unwrap();
    assert!((direct.approach / continued.approach - 1.0).abs() < 1e-6);
    // A repeated solution is identical bit for bit.
    assert_eq!(direct, ehl::solve(&nearby, None).unwrap());
}

#[test]
fn unsolvable_contacts_are_reported() {
    let mut problem = circular(20.0, 10.0, 41);
    problem.load = -1.0;
    assert!(matches!(ehl::solve(&problem, None), Err(EhlError::Input { quantity: "load", .. })));
    let mut problem = circular(20.0, 10.0, 40);
    problem.grid.ny = 40;
    assert!(matches!(ehl::solve(&problem, None), Err(EhlError::Input { .. })));
    // A film far thinner than the grid can resolve.
    let mut problem = circular(20.0, 10.0, 41);
    problem.speed *= 1e-4;
    problem.load *= 1e3;
    let failure = ehl::solve(&problem, None).unwrap_err();
    let text = failure.to_string();
    let EhlError::NoConvergence { load, speed, residual, last, .. } = failure else { panic!("{text}") };
    assert_eq!((load, speed), (problem.load, problem.speed));
    assert!(residual > 0.0 && last.pressure.len() == 41 * 41);
    assert!(text.contains(&format!("{load:.4} N")) && text.contains("residual"), "{text}");
}
