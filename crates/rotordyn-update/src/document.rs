//! What is written of a model update to files.

use super::correlation::Correlation;
use super::culprits::{Culprit, CulpritSearch, ReleasedBounds};
use super::data_kind::KindFit;
use super::dependence::{Dependence, Inseparable};
use super::frf_scale::FrfScale;
use super::goodness::FitQuality;
use super::groups::{Combination, Group};
use super::parameter::FreeParameter;
use super::profile::Profile;
use super::{Outcome, Update};
use rotordyn_core::document::{Array, Document, Names, Rows, in_json, named};

/// What was found of the parameters after the fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    pub groups: Vec<Group>,
    /// If the model does not explain the data.
    pub culprits: Option<CulpritSearch>,
    pub profiles: Vec<Profile>,
    /// If all measured FRFs are the computed ones times one factor.
    pub frf_scale: Option<FrfScale>,
}

impl Update {
    /// Parameters with their identifiability, what was `more` found of them, and the model before and after;
    /// `frf_difference_db`: of the FRFs before and after, if they were fitted.
    pub fn document<'a>(
        &self,
        parameters: &[FreeParameter],
        more: &Findings,
        [before, after]: [&Correlation<'a>; 2],
        frf_difference_db: Option<[f64; 2]>,
    ) -> Document<'a> {
        let rows: Vec<_> = parameters.iter().zip(&self.outcomes).collect();
        let dependent: Vec<_> = self.dependences(parameters).collect();
        let inseparable: Vec<_> = self.inseparable(parameters).collect();
        let (count, found) = (parameters.len(), &self.identifiability);
        let square = |rows: &[Vec<f64>]| Array::real(&[count, count], "1", rows.concat());
        let of_parameters = |name: &str| named(name, format!("parameters/{name}"));
        Document::new()
            .table("parameters", parameter_rows(&rows))
            .and_if((!dependent.is_empty()).then_some(()), |document, ()| {
                document.table("dependences", dependence_rows(&dependent))
            })
            .and_if((!inseparable.is_empty()).then_some(()), |document, ()| {
                document.table("inseparable_from_fixed", inseparable_rows(&inseparable))
            })
            .numbers(of_parameters("standard_error_scale"), "1", found.scale.clone())
            .numbers(of_parameters("singular_values"), "1", found.singular_values.clone())
            .array(of_parameters("singular_vectors"), square(&found.directions))
            .array(of_parameters("correlation"), square(&found.correlation))
            .number(of_parameters("chi_squared"), "1", self.goodness.chi_squared)
            .number(of_parameters("degrees_of_freedom"), "1", self.goodness.degrees_of_freedom)
            .number(of_parameters("chi_squared_probability"), "1", self.goodness.probability())
            .text(of_parameters("fit"), self.goodness.quality().label())
            .table("fit_by_kind", kind_rows(&self.goodness.by_kind))
            .flag(of_parameters("standard_errors_valid"), self.goodness.quality() != FitQuality::NotExplained)
            .flag(of_parameters("converged"), self.converged)
            .integer(of_parameters("iterations"), self.iterations.len() - 1)
            .optional(in_json("frf_db_before"), "dB", frf_difference_db.map(|[before, _]| before))
            .optional(in_json("frf_db_after"), "dB", frf_difference_db.map(|[_, after]| after))
            .and_if(more.frf_scale, |document, scale| {
                document.number("frf_scale", "1", scale.ratio).number(
                    "frf_scale_power",
                    "1",
                    scale.power.into(),
                )
            })
            .and(groups_document(&more.groups, parameters, &of_parameters))
            .and(culprits_document(more.culprits.as_ref(), parameters))
            .and(profiles_document(&more.profiles, parameters, &of_parameters))
            .group("before", before.document())
            .group("after", after.document())
    }
}

fn groups_document<'a>(
    groups: &[Group],
    parameters: &[FreeParameter],
    place: &dyn Fn(&str) -> Names,
) -> Document<'a> {
    let combination = |found: &Combination| {
        Document::new().numbers("weights", "1", found.weights.clone()).number(
            "standard_error",
            "1",
            found.error,
        )
    };
    let one = |(k, group): (usize, &Group)| {
        let members = group.members.iter().map(|&j| &parameters[j].name);
        let content = Document::new()
            .texts("members", members)
            .group("determined", combination(&group.determined))
            .group("undetermined", combination(&group.undetermined));
        (format!("group_{}", k + 1), content)
    };
    Document::new().groups(place("groups"), "name", groups.iter().enumerate().map(one))
}

fn culprits_document<'a>(found: Option<&CulpritSearch>, parameters: &[FreeParameter]) -> Document<'a> {
    let Some(found) = found else { return Document::new() };
    Document::new()
        .and_if(found.released.as_ref(), |document, released| {
            let row = |&j: &usize| (&parameters[j], released.x[j], released);
            document.table(
                "released_bounds",
                released_rows(&released.parameters.iter().map(row).collect::<Vec<_>>()),
            )
        })
        .table("culprits", culprit_rows(&found.culprits))
        .table("culprits_together", culprit_rows(&found.together))
        .integer("culprit_candidates", found.candidates)
        .integer("culprit_candidates_with_influence", found.with_influence)
}

/// A free parameter without its bound, with its coordinate then.
type Released<'r> = (&'r FreeParameter, f64, &'r ReleasedBounds);

fn released_rows<'a, 'r>(rows: &'r [Released<'r>]) -> Rows<'a, 'r, Released<'r>> {
    let unit = "in the parameter's unit";
    Rows::of(rows)
        .text("name", |(p, _, _)| &p.name)
        .number("value", unit, |(p, x, _)| p.value(*x))
        .number("chi_squared_gain", "1", |(_, _, r)| r.gain)
        .number("chi_squared", "1", |(_, _, r)| r.goodness.chi_squared)
        .flag("explains", |(_, _, r)| !r.goodness.is_rejected())
}

fn culprit_rows<'a, 'r>(rows: &'r [Culprit]) -> Rows<'a, 'r, Culprit> {
    let unit = "in the parameter's unit";
    Rows::of(rows)
        .text("name", |c| &c.parameter.name)
        .lists("paths", |c| c.parameter.numbers.iter().map(|place| place.path.clone()).collect())
        .text("unit", |c| c.parameter.unit())
        .number("start", unit, |c| c.parameter.value(c.parameter.mean))
        .number("value", unit, |c| c.parameter.value(c.x))
        .number("standard_error", unit, |c| (c.error * c.parameter.derivative(c.x)).abs())
        .number("chi_squared_gain", "1", |c| c.gain)
        .number("predicted_gain", "1", |c| c.predicted_gain)
        .number("chi_squared", "1", |c| c.goodness.chi_squared)
        .number("degrees_of_freedom", "1", |c| c.goodness.degrees_of_freedom)
        .number("chi_squared_probability", "1", |c| c.goodness.probability())
        .flag("explains", |c| !c.goodness.is_rejected())
        .lists("same_effect", |c| c.alike.clone())
}

fn profiles_document<'a>(
    profiles: &[Profile],
    parameters: &[FreeParameter],
    place: &dyn Fn(&str) -> Names,
) -> Document<'a> {
    let one = |found: &Profile| {
        let parameter = &parameters[found.parameter];
        let unit = parameter.unit();
        let values = |x: &[f64]| x.iter().map(|x| parameter.value(*x)).collect::<Vec<f64>>();
        let ends = |ends: [Option<f64>; 2]| ends.map(|x| x.map_or(f64::NAN, |x| parameter.value(x))).to_vec();
        let content = Document::new()
            .text("unit", unit)
            .numbers("value", unit, values(&found.x))
            .numbers("chi_squared", "1", found.chi_squared.clone())
            .number("best", unit, parameter.value(found.best))
            .number("least_chi_squared", "1", found.least)
            .number("scale", "1", found.scale)
            .numbers("interval_68", unit, ends(found.interval_68))
            .numbers("interval_95", unit, ends(found.interval_95));
        (parameter.name.clone(), content)
    };
    Document::new().groups(place("profiles"), "name", profiles.iter().map(one))
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

fn kind_rows<'a, 'r>(rows: &'r [KindFit]) -> Rows<'a, 'r, KindFit> {
    Rows::of(rows)
        .text("kind", |fit| fit.kind.label())
        .number("data", "1", |fit| fit.data)
        .number("chi_squared", "1", |fit| fit.chi_squared)
        .number("degrees_of_freedom", "1", |fit| fit.degrees_of_freedom)
        .number("chi_squared_probability", "1", |fit| fit.probability())
}

/// Values that depend on a parameter that is not free.
fn dependence_rows<'a, 'r>(
    rows: &'r [(&'r FreeParameter, &'r Outcome, &'r Dependence)],
) -> Rows<'a, 'r, (&'r FreeParameter, &'r Outcome, &'r Dependence)> {
    let unit = "in the parameter's unit";
    Rows::of(rows)
        .text("name", |(p, _, _)| &p.name)
        .text("depends_on", |(_, _, d)| &d.on.name)
        .number("depends_on_value", unit, |(_, _, d)| d.on.value(d.on.mean))
        .number("depends_on_predicted", unit, |(_, _, d)| d.on.value(d.on.mean + d.change))
        .number("chi_squared_gain", "1", |(_, _, d)| d.gain)
        .number("probability_by_chance", "1", |(_, _, d)| d.probability)
        .number("value_predicted", unit, |(p, o, d)| p.value(o.x + d.shift))
        .number("shift_in_standard_errors", "1", |(_, o, d)| d.shift / o.error)
}

/// Values that the data do not separate from a parameter that is not free.
fn inseparable_rows<'a, 'r>(
    rows: &'r [(&'r FreeParameter, &'r Outcome, &'r Inseparable)],
) -> Rows<'a, 'r, (&'r FreeParameter, &'r Outcome, &'r Inseparable)> {
    let unit = "in the parameter's unit";
    Rows::of(rows)
        .text("name", |(p, _, _)| &p.name)
        .text("fixed", |(_, _, i)| &i.from.name)
        .number("fixed_value", unit, |(_, _, i)| i.from.value(i.from.mean))
        .number("standard_error_if_free", unit, |(p, o, i)| (i.error * p.derivative(o.fitted)).abs())
        .number("growth_of_standard_error", "1", |(_, o, i)| i.error / o.error)
        .number("change_for_one_per_cent", unit, |(p, o, i)| {
            p.value(o.x + i.change_for_one_per_cent()) - p.value(o.x)
        })
}
