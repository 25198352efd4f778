//! The arrays of a file by their structures, and the axes that structures state.
//!
//! `rig.acc.x` belongs to the structure `rig.acc`; what the array itself states (`rig.acc.x.fs`, an attribute of a data
//! set) wins over what its structure states, and this over what the structures around it state.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

use super::array::{Array, Data};
use super::array_names::{last_name, meaning_of, structure_of};
use super::axis_names::{Meaning, Role, StatedRate, check_same, six_digits};
use super::axis_units;
use super::content_problem::ContentProblem;
use super::own_axes::OwnAxes;
use crate::budget::MAX_DEPTH;
use rotordyn_signal::record::{Axis, AxisQuantity, Points};

const UNITS: [&str; 4] = ["unit", "units", "unit_string", "y_unit_label"];

/// The arrays of a file.
pub(super) struct Structures<'a> {
    pub arrays: &'a [Array],
    /// Place of the first array of a name.
    places: HashMap<&'a str, usize>,
    /// What the arrays of a structure ("" for none) state of axes, the most definite first.
    stated: HashMap<&'a str, Vec<(Meaning, usize)>>,
    /// Place of the first unit of a structure.
    units: HashMap<&'a str, usize>,
    /// Number of numeric arrays of a structure that are records.
    records: HashMap<&'a str, usize>,
    /// Places of arrays that are no axis by their units.
    of_other_units: HashSet<usize>,
    /// Place of the unit of an array that states an axis.
    axis_units: HashMap<usize, usize>,
    /// Axes of single arrays, by names of both.
    own: OwnAxes,
    /// Places of the arrays that have been taken as axis, unit or title.
    used: RefCell<HashSet<usize>>,
    given_rate: Option<f64>,
    /// What was decided between contradictions.
    pub notes: RefCell<Vec<String>>,
}

/// A list of times or frequencies.
#[derive(Clone, Copy)]
pub(super) struct AxisList<'a> {
    pub quantity: AxisQuantity,
    pub values: &'a [f64],
    place: usize,
    meaning: Meaning,
    /// Structures further out than the record.
    pub distance: usize,
}

/// The axes that hold for the records of a structure: its own, else those of the structures around it.
#[derive(Default)]
pub(super) struct Axes<'a> {
    /// Rates, steps, starts and counts of the nearest structure that states a rate.
    rates: Vec<(StatedRate, usize)>,
    distance: usize,
    start: Option<(f64, usize)>,
    count: Option<(f64, usize)>,
    pub time: Option<AxisList<'a>>,
    pub frequency: Option<AxisList<'a>>,
}

impl<'a> Structures<'a> {
    /// `given_rate`: sampling rate \[Hz\] that holds where the file states two.
    ///
    /// # Errors
    /// The unit of an axis or a rate is not understood.
    pub fn new(arrays: &'a [Array], given_rate: Option<f64>) -> Result<Self, ContentProblem> {
        let mut found = Self {
            arrays,
            places: HashMap::new(),
            stated: HashMap::new(),
            units: HashMap::new(),
            records: HashMap::new(),
            of_other_units: HashSet::new(),
            axis_units: HashMap::new(),
            own: OwnAxes::default(),
            used: RefCell::default(),
            given_rate,
            notes: RefCell::default(),
        };
        for (place, array) in arrays.iter().enumerate() {
            found.places.entry(array.name.as_str()).or_insert(place);
            let (structure, last) = (structure_of(&array.name), last_name(&array.name));
            if let Some(meaning) = meaning_of(array, last) {
                found.stated.entry(structure).or_default().push((meaning, place));
            } else if array.as_text().is_some() && UNITS.iter().any(|unit| unit.eq_ignore_ascii_case(last)) {
                found.units.entry(structure).or_insert(place);
            } else if array.data.len() > 1 && !matches!(array.data, Data::Text(_)) {
                *found.records.entry(structure).or_default() += 1;
            }
        }
        found.own = OwnAxes::of(arrays, &found.places);
        found.convert_axes()?;
        for stated in found.stated.values_mut() {
            // Of `t` and `T` the second may be a temperature.
            let capital = |place: usize| {
                let last = last_name(&arrays[place].name);
                last.len() == 1 && last != last.to_lowercase()
            };
            stated.sort_by_key(|(meaning, place)| (meaning.rank, capital(*place), *place));
        }
        Ok(found)
    }

    /// Takes the units that attributes of the axes and rates state, `time.unit`, and arrays beside them, `fs_unit`.
    fn convert_axes(&mut self) -> Result<(), ContentProblem> {
        let arrays = self.arrays;
        for stated in self.stated.values_mut() {
            let mut kept = Vec::with_capacity(stated.len());
            for (mut meaning, place) in stated.drain(..) {
                let name = arrays[place].name.as_str();
                let paired = || {
                    let names = ["unit", "units", "Unit"].map(|end| format!("{name}_{end}"));
                    names.iter().find_map(|name| self.places.get(name.as_str()).copied())
                };
                let own = self.units.get(name).copied().or_else(paired);
                if let Some((at, label)) = own.and_then(|at| Some((at, arrays[at].as_text()?))) {
                    match meaning.role.factor_of_label(label, name) {
                        Ok(Some(factor)) => {
                            (meaning.numerator, meaning.divisor) = factor;
                            self.axis_units.insert(place, at);
                        }
                        Ok(None) => {
                            self.axis_units.insert(place, at);
                        }
                        // Names that may state something else, and what the given rate replaces, are no axis.
                        Err(problem) => {
                            // `f` in N is a force.
                            let is_other = last_name(name).len() == 1 && axis_units::si(label).is_some();
                            let replaced = self.given_rate.is_some() && meaning.role != Role::Frequencies;
                            if !(meaning.uncertain || is_start(meaning.role) || is_other || replaced) {
                                return Err(problem);
                            }
                            self.of_other_units.insert(place);
                            continue;
                        }
                    }
                }
                kept.push((meaning, place));
            }
            *stated = kept;
        }
        Ok(())
    }

    pub fn get(&self, name: &str) -> Option<&'a Array> {
        self.places.get(name).map(|&k| &self.arrays[k])
    }

    pub fn name_of(&self, list: &AxisList<'_>) -> &'a str {
        &self.arrays[list.place].name
    }

    pub fn use_array(&self, place: usize) {
        let mut used = self.used.borrow_mut();
        used.insert(place);
        used.extend(self.axis_units.get(&place));
    }

    /// As [`Self::get`], of an array that is taken as title, axis or unit.
    pub fn get_used(&self, name: &str) -> Option<&'a Array> {
        let place = *self.places.get(name)?;
        self.use_array(place);
        Some(&self.arrays[place])
    }

    pub fn is_used(&self, place: usize) -> bool {
        self.used.borrow().contains(&place)
    }

    /// Whether an array is a list of times or frequencies.
    pub fn is_axis_list(&self, place: usize) -> bool {
        let array = &self.arrays[place];
        array.data.len() > 1
            && meaning_of(array, last_name(&array.name)).is_some()
            && !self.of_other_units.contains(&place)
    }

    /// Whether the name of an array is that of another one with the name of an axis, as `fs_tacho` of `tacho`.
    pub fn is_own_axis(&self, place: usize) -> bool {
        self.own.states(place)
    }

    /// The axis that is stated for one array by the names of both, and what states it.
    pub fn own_axis(&self, array: &Array) -> Option<(Axis, String)> {
        let place = *self.places.get(array.name.as_str())?;
        let source = |at: usize| {
            self.use_array(at);
            format!("`{}`", self.arrays[at].name)
        };
        if let Some((meaning, at)) = self.own.stated(place, &[Role::Rate, Role::Step]) {
            let (value, _) = self.arrays[at].as_stated()?;
            let stated = StatedRate::of(&meaning, &self.arrays[at].name, value)?;
            let start = self.own.stated(place, &[Role::Start]).and_then(|(meaning, at)| {
                self.use_array(at);
                Some(meaning.in_si(self.arrays[at].as_stated()?.0))
            });
            let axis = Axis::uniform(AxisQuantity::Time, start.unwrap_or(0.0), stated.step);
            return Some((axis, source(at)));
        }
        let (meaning, at) = self.own.stated(place, &[Role::Times])?;
        let points = self.arrays[at].as_list()?.iter().map(|t| meaning.in_si(*t)).collect();
        Some((Axis::from_points(AxisQuantity::Time, points), source(at)))
    }

    /// What holds for the records of an array.
    pub fn axes(&self, array: &'a Array) -> Result<Axes<'a>, ContentProblem> {
        let mut found = Axes::default();
        let mut at = array.name.as_str();
        for distance in 0..=MAX_DEPTH + 1 {
            if let Some(stated) = self.stated.get(at) {
                self.add(&mut found, stated, distance)?;
            }
            if at.is_empty() {
                break;
            }
            at = structure_of(at);
        }
        Ok(found)
    }

    fn add(
        &self,
        found: &mut Axes<'a>,
        stated: &[(Meaning, usize)],
        distance: usize,
    ) -> Result<(), ContentProblem> {
        let scalar = |role: Role| {
            let of_role = stated.iter().find(|(meaning, _)| meaning.role == role);
            of_role.and_then(|(meaning, place)| {
                let (value, _) = self.arrays[*place].as_stated()?;
                Some((meaning.in_si(value), *place))
            })
        };
        if found.rates.is_empty() {
            let rates = stated.iter().filter_map(|(meaning, place)| {
                let array = &self.arrays[*place];
                let (value, _) = array.as_stated()?;
                Some((meaning, StatedRate::of(meaning, &array.name, value)?, *place))
            });
            let (uncertain, certain): (Vec<_>, Vec<_>) = rates.partition(|(meaning, ..)| meaning.uncertain);
            let instead = self.check_same(certain.iter().map(|(_, rate, _)| rate))?;
            let mut chosen: Vec<_> =
                if certain.is_empty() { uncertain.into_iter().take(1).collect() } else { certain };
            if let Some(given) = instead {
                chosen.iter_mut().for_each(|(_, rate, _)| *rate = given.clone());
            }
            found.rates = chosen.into_iter().map(|(_, rate, place)| (rate, place)).collect();
            found.distance = distance;
            found.start = if found.rates.is_empty() { None } else { scalar(Role::Start) };
        }
        found.count = found.count.or_else(|| scalar(Role::Count));
        let list = |role: Role, quantity: AxisQuantity| {
            let of_role = stated.iter().find(|(meaning, _)| meaning.role == role);
            of_role.and_then(|&(meaning, place)| {
                let values = self.arrays[place].as_list()?;
                Some(AxisList { quantity, values, place, meaning, distance })
            })
        };
        found.time = found.time.or_else(|| list(Role::Times, AxisQuantity::Time));
        found.frequency = found.frequency.or_else(|| list(Role::Frequencies, AxisQuantity::Frequency));
        Ok(())
    }

    /// The axis of a record of `count` values, and what states it.
    pub fn axis(
        &self,
        axes: &Axes<'a>,
        count: usize,
        is_time: bool,
    ) -> Result<(Axis, String), ContentProblem> {
        let frequency = axes.frequency.filter(|list| list.values.len() == count && !is_time);
        let time = axes.time.filter(|list| list.values.len() == count);
        let nearest = [frequency, time].into_iter().flatten().min_by_key(|list| list.distance);
        let rate = axes.rates.first();
        let list = match (nearest, rate) {
            (Some(list), Some(_)) if list.distance > axes.distance => None,
            (Some(list), _) => Some(list),
            (None, _) => None,
        };
        if let Some(list) = list {
            self.use_array(list.place);
            let axis = list.axis();
            let source = format!("`{}`", self.arrays[list.place].name);
            if let (AxisQuantity::Time, Points::Uniform { step, .. }) = (axis.quantity, &axis.points)
                && let Some((rate, place)) = rate
                && list.distance == axes.distance
            {
                let of_list = StatedRate { rate: 1.0 / step, step: *step, source: source.clone() };
                let instead = self.check_same([rate, &of_list])?;
                self.use_array(*place);
                if let Some(given) = instead {
                    let axis = Axis::uniform(AxisQuantity::Time, axis.start(), given.step);
                    return Ok((axis, given.source));
                }
            }
            return Ok((axis, source));
        }
        let Some((stated, _)) = rate else { return Ok((Axis::UNKNOWN, String::new())) };
        axes.rates.iter().for_each(|(_, place)| self.use_array(*place));
        let start = axes.start.map_or(0.0, |(start, place)| {
            self.use_array(place);
            start
        });
        Ok((Axis::uniform(AxisQuantity::Time, start, stated.step), stated.source.clone()))
    }

    /// Refuses rates that differ, unless the user gives one: it holds instead, and a note names both.
    fn check_same<'r>(
        &self,
        rates: impl IntoIterator<Item = &'r StatedRate>,
    ) -> Result<Option<StatedRate>, ContentProblem> {
        match (check_same(rates), self.given_rate) {
            (Ok(()), _) => Ok(None),
            (Err(problem), None) => Err(problem),
            (Err(problem), Some(rate)) => {
                let note = format!("{}: {} Hz is used, as given", problem.problem, six_digits(rate));
                let mut notes = self.notes.borrow_mut();
                if !notes.contains(&note) {
                    notes.push(note);
                }
                Ok(Some(StatedRate::given(rate)))
            }
        }
    }

    /// Number of samples that is stated for the records of a structure.
    pub fn count(&self, axes: &Axes<'a>) -> Option<(f64, &'a str)> {
        let (count, place) = axes.count?;
        self.use_array(place);
        Some((count, &self.arrays[place].name))
    }

    /// Unit stated by an attribute of an array, or beside the only record of its structure.
    pub fn unit(&self, array: &'a Array) -> Option<&'a str> {
        let structure = structure_of(&array.name);
        let alone = !structure.is_empty() && self.records.get(structure) == Some(&1);
        let own = self.units.get(array.name.as_str());
        let place = own.or_else(|| self.units.get(structure).filter(|_| alone))?;
        self.use_array(*place);
        self.arrays[*place].as_text()
    }
}

impl Axes<'_> {
    /// Whether a rate is stated no further out than that.
    pub fn states_rate_within(&self, distance: usize) -> bool {
        !self.rates.is_empty() && self.distance <= distance
    }

    pub fn are_unknown(&self) -> bool {
        self.rates.is_empty() && self.time.is_none() && self.frequency.is_none()
    }
}

impl AxisList<'_> {
    fn axis(&self) -> Axis {
        let Meaning { numerator, divisor, .. } = self.meaning;
        let si = |v: &f64| if numerator == divisor { *v } else { v * numerator / divisor };
        Axis::from_points(self.quantity, self.values.iter().map(si).collect())
    }
}

/// Whether a value is no rate and no list.
fn is_start(role: Role) -> bool {
    matches!(role, Role::Start | Role::Count)
}
