//! What is written of a model update to files.

use super::correlation::Correlation;
use super::parameter::FreeParameter;
use super::{Outcome, Update};
use rotordyn_core::document::{Array, Document, Rows, in_json, named};

impl Update {
    /// Parameters with their identifiability, and the model before and after; `frf_difference_db`: of the FRFs before
    /// and after, if they were fitted.
    pub fn document<'a>(
        &self,
        parameters: &[FreeParameter],
        [before, after]: [&Correlation<'a>; 2],
        frf_difference_db: Option<[f64; 2]>,
    ) -> Document<'a> {
        let rows: Vec<_> = parameters.iter().zip(&self.outcomes).collect();
        let (count, found) = (parameters.len(), &self.identifiability);
        let square = |rows: &[Vec<f64>]| Array::real(&[count, count], "1", rows.concat());
        let of_parameters = |name: &str| named(name, format!("parameters/{name}"));
        Document::new()
            .table("parameters", parameter_rows(&rows))
            .numbers(of_parameters("singular_values"), "1", found.singular_values.clone())
            .array(of_parameters("singular_vectors"), square(&found.directions))
            .array(of_parameters("correlation"), square(&found.correlation))
            .number(of_parameters("chi_squared"), "1", found.chi_squared)
            .number(of_parameters("degrees_of_freedom"), "1", found.degrees_of_freedom)
            .flag(of_parameters("converged"), self.converged)
            .integer(of_parameters("iterations"), self.iterations.len() - 1)
            .optional(in_json("frf_db_before"), "dB", frf_difference_db.map(|[before, _]| before))
            .optional(in_json("frf_db_after"), "dB", frf_difference_db.map(|[_, after]| after))
            .group("before", before.document())
            .group("after", after.document())
    }
}

fn parameter_rows<'a, 'r>(
    rows: &'r [(&'r FreeParameter, &'r Outcome)],
) -> Rows<'a, 'r, (&'r FreeParameter, &'r Outcome)> {
    let unit = "in the parameter's unit";
    Rows::of(rows)
        .text("name", |(p, _)| &p.name)
        .lists("paths", |(p, _)| p.numbers.iter().map(|place| place.path.clone()).collect())
        .text("unit", |(p, _)| p.unit())
        .number("start", unit, |(p, _)| p.value(0.0))
        .number("value", unit, |(p, o)| p.value(o.x))
        .number("fitted", unit, |(p, o)| p.value(o.fitted))
        .number("standard_error", unit, |(p, o)| (o.error * p.derivative(o.fitted)).abs())
        .number("prior_variance_fraction", "1", |(_, o)| o.prior_share)
        .text("identifiability", |(_, o)| o.class.label())
}
