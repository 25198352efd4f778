//! Names of arrays: the structure that they belong to, and what an array states of an axis by its name.

use super::array::Array;
use super::axis_names::{Meaning, Role, StatedRate, meaning};

/// Structure of a path, `bearing` of `bearing.gs`; "" for none.
pub(super) fn structure_of(name: &str) -> &str {
    name.rsplit_once('.').map_or("", |(structure, _)| structure)
}

/// Name without the structure's path.
pub(super) fn last_name(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, last)| last)
}

/// What an array states of an axis by its name and form: a number, or a list that increases.
pub(super) fn meaning_of(array: &Array, last: &str) -> Option<Meaning> {
    if let Some((value, si)) = array.as_stated() {
        let mut meaning = meaning(last, &[Role::Rate, Role::Step, Role::Start, Role::Count])?;
        if let Some(si) = si {
            // The unit beside the number wins over that of the name.
            (meaning.numerator, meaning.divisor) = meaning.role.factor(&si)?;
        }
        let possible = match meaning.role {
            Role::Rate | Role::Step => StatedRate::of(&meaning, last, value).is_some(),
            _ => value.is_finite(),
        };
        return possible.then_some(meaning);
    }
    let list = array.as_list()?;
    let meaning = meaning(last, &[Role::Times, Role::Frequencies])?;
    list.windows(2).all(|pair| pair[0] < pair[1]).then_some(meaning)
}
