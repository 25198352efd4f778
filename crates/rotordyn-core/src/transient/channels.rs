//! Output channels (virtual sensors) of a system.

use nalgebra::{DMatrix, DVector};

use crate::model::Quantity;
use rotordyn_linalg::panel::Panel;

/// Coordinates, velocities and accelerations of a state.
pub type Motion<'a> = [&'a DVector<f64>; 3];

/// One output channel: row · x (or ẋ, ẍ).
#[derive(Clone, Debug)]
pub struct Channel {
    pub name: String,
    pub row: DVector<f64>,
    pub quantity: Quantity,
}

impl Channel {
    /// The channel's value.
    pub fn read(&self, motion: Motion) -> f64 {
        self.row.dot(of(self.quantity, motion))
    }

    /// Velocity and acceleration of the channel's row.
    pub fn velocity_and_acceleration(&self, [_, v, a]: Motion) -> [f64; 2] {
        [v, a].map(|motion| self.row.dot(motion))
    }
}

/// All channels of a system, read at every step: those of one quantity together.
#[derive(Clone, Debug)]
pub struct Channels {
    list: Vec<Channel>,
    groups: Vec<Group>,
}

/// The channels of one quantity, row by row.
#[derive(Clone, Debug)]
struct Group {
    quantity: Quantity,
    places: Vec<usize>,
    rows: Panel,
}

impl Channels {
    pub fn new(list: Vec<Channel>) -> Self {
        let quantities = [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration];
        let group = |quantity| {
            let places: Vec<usize> = (0..list.len()).filter(|&k| list[k].quantity == quantity).collect();
            let rows: Vec<_> = places.iter().map(|&k| list[k].row.transpose()).collect();
            (!rows.is_empty()).then(|| Group {
                quantity,
                places,
                rows: Panel::new(&[&DMatrix::from_rows(&rows)]),
            })
        };
        let groups = quantities.into_iter().filter_map(group).collect();
        Self { list, groups }
    }

    /// All of them, in order.
    pub fn list(&self) -> &[Channel] {
        &self.list
    }

    /// Appends the values to `out`, in the order of the channels.
    pub fn read(&self, motion: Motion, out: &mut Vec<f64>) {
        let first = out.len();
        let end = first + self.list.len();
        out.resize(end, 0.0);
        for Group { quantity, places, rows } in &self.groups {
            out.resize(end + places.len(), 0.0);
            let (values, own) = out[first..].split_at_mut(end - first);
            rows.mul_add(of(*quantity, motion).as_slice(), own);
            places.iter().zip(own).for_each(|(&place, value)| values[place] = *value);
            out.truncate(end);
        }
    }
}

fn of<'a>(quantity: Quantity, [x, v, a]: Motion<'a>) -> &'a DVector<f64> {
    match quantity {
        Quantity::Displacement => x,
        Quantity::Velocity => v,
        Quantity::Acceleration => a,
    }
}
