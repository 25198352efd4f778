//! Axes that the name of an array states for another one: `fs_tacho`, `tacho_sr`, `tachoRate` and `t_tacho` of `tacho`.

use std::collections::{HashMap, HashSet};

use super::array::{Array, Data};
use super::array_names::{last_name, meaning_of, structure_of};
use super::axis_names::{Meaning, Role};

/// What arrays state for other arrays by their names.
#[derive(Default)]
pub(super) struct OwnAxes {
    /// What is stated for the array of a place, and the place of what states it.
    stated: HashMap<usize, Vec<(Meaning, usize)>>,
    /// Places of the arrays that state something.
    places: HashSet<usize>,
}

impl OwnAxes {
    /// `places`: of the first array of each name.
    pub fn of(arrays: &[Array], places: &HashMap<&str, usize>) -> Self {
        let mut found = Self::default();
        for (place, array) in arrays.iter().enumerate() {
            let (structure, last) = (structure_of(&array.name), last_name(&array.name));
            let record = |name: &str| {
                let at = match structure {
                    "" => places.get(name),
                    structure => places.get(format!("{structure}.{name}").as_str()),
                };
                at.copied().filter(|&at| {
                    let other = &arrays[at];
                    at != place && other.data.len() > 1 && !matches!(other.data, Data::Text(_))
                })
            };
            let stated = halves(last).find_map(|(channel, axis)| {
                let meaning = meaning_of(array, axis)?;
                // `ts` and `step` may state something else.
                let is_axis = match meaning.role {
                    Role::Rate => true,
                    Role::Step | Role::Start | Role::Times => !meaning.uncertain,
                    Role::Count | Role::Frequencies => false,
                };
                let of = record(channel).or_else(|| record(&lower_first(channel))).filter(|_| is_axis)?;
                let fits = meaning.role != Role::Times || arrays[of].data.len() == array.data.len();
                fits.then_some((of, meaning))
            });
            if let Some((of, meaning)) = stated {
                found.stated.entry(of).or_default().push((meaning, place));
                found.places.insert(place);
            }
        }
        found
    }

    /// Whether the array of a place states the axis of another one.
    pub fn states(&self, place: usize) -> bool {
        self.places.contains(&place)
    }

    /// What is stated of a role for the array of a place, and the place of what states it.
    pub fn stated(&self, place: usize, roles: &[Role]) -> Option<(Meaning, usize)> {
        let all = self.stated.get(&place)?;
        all.iter().filter(|(meaning, _)| roles.contains(&meaning.role)).min_by_key(|(m, _)| m.rank).copied()
    }
}

/// A name as that of a channel and what stands before or behind it, at each mark or capital between them.
fn halves(name: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut before = ' ';
    let mut cuts = Vec::new();
    for (at, c) in name.char_indices() {
        if matches!(c, '_' | '-' | ' ') {
            cuts.push((at, at + 1));
        } else if c.is_uppercase() && before.is_lowercase() {
            cuts.push((at, at));
        }
        before = c;
    }
    cuts.into_iter().flat_map(|(end, from)| {
        let (a, b) = (&name[..end], &name[from..]);
        [(a, b), (b, a)]
    })
}

fn lower_first(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}
