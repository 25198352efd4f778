//! Elastohydrodynamic point contact: order of mesh convergence, extrapolated limit compared with published
//! values.

use crate::lubricated::circular;
use rotordyn::contact::ehl;

/// Moes M = 20, L = 10 over X from −4.5 to 1.5, |Y| to 3.
///
/// Published: H_c = h_c R/a² = 0.432, 1 − Δ = 0.451, Δ = δ/δ_dry the mutual approach over the dry one
/// (δ_dry = a²/R here, so 1 − Δ is the film's shift in the same unit as H_c, and a little above it).
#[test]
fn circular_contact_converges_with_second_order() {
    let solutions: Vec<_> = [31, 61, 121]
        .map(|nodes| {
            let problem = circular(20.0, 10.0, nodes);
            let found = ehl::solve(&problem, None).unwrap();
            let patch = problem.contact.patch(problem.load);
            assert!((patch.deflection * 10e-3 / patch.semi_major.powi(2) - 1.0).abs() < 1e-12);
            [found.central_film * 10e-3 / patch.semi_major.powi(2), 1.0 - found.approach / found.dry_approach]
        })
        .into();
    for (k, (name, published)) in [("H_c", 0.432), ("1 - Delta", 0.451)].into_iter().enumerate() {
        let [coarse, mid, fine] = [0, 1, 2].map(|n: usize| solutions[n][k]);
        let order = ((mid - coarse) / (fine - mid)).log2();
        let limit = fine + (fine - mid) / 3.0;
        eprintln!("{name}: {coarse:.5} {mid:.5} {fine:.5}, order {order:.3}, limit {limit:.5}");
        // The coarsest grid has five intervals to the semi-axis: not quite asymptotic.
        assert!((order - 2.0).abs() < 0.15, "{name}: order {order}");
        assert!((limit / published - 1.0).abs() < 0.02, "{name}: {limit}");
    }
}
