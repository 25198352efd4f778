//! Names of orders: shaft orders, and those of the bearings of a machine.

use super::Machine;
use crate::results::OrderLine;
use rotordyn_bearing::Bearing;

/// Multiples of a bearing's characteristic order that have a name.
const MOST: f64 = 5.0;

/// Parts with a characteristic order, as they are counted here.
const PARTS: [&str; 4] = ["BPFO", "BPFI", "BSF", "FTF"];

impl Machine {
    /// Order lines with labels: "2x", or for multiples of a bearing's characteristic orders "BPFO", "2 BPFI"; with the bearings
    /// that have it, "A.BPFO" or "A+B.BPFO", where others have another one.
    pub fn order_lines(&self, orders: &[f64]) -> Vec<OrderLine> {
        self.order_lines_of_cages(orders, &[], 0.0).into_iter().map(|found| found.line).collect()
    }

    /// As [`Self::order_lines`] of a run whose cages turn `cages` times per turn of the shaft, one value per bearing, `None`
    /// or missing where that is unknown: a bearing's orders are then those of its cage, not of the nominal contact angle.
    ///
    /// Bearings with the same nominal order have a line each where their orders differ by more than `tolerance` then.
    pub(super) fn order_lines_of_cages(
        &self,
        orders: &[f64],
        cages: &[Option<f64>],
        tolerance: f64,
    ) -> Vec<LineOfRun> {
        let bearings: Vec<NamedOrders> = self
            .model
            .bearings
            .iter()
            .enumerate()
            .filter_map(|(site, of)| {
                let c = of.bearing.characteristic_orders()?;
                let nominal = [c.bpfo, c.bpfi, c.bsf, c.ftf];
                Some(NamedOrders { site, name: of.name.as_str(), nominal })
            })
            .collect();
        let lines = |&order: &f64| {
            let Some((part, multiple, of)) = part_of(order, &bearings) else {
                let line = OrderLine { label: format!("{order}x"), order, bearing: false };
                return vec![LineOfRun { line, of: None }];
            };
            let mut groups: Vec<(f64, Vec<&NamedOrders>)> = Vec::new();
            for bearing in of {
                let site = &self.model.bearings[bearing.site];
                let cage = cages.get(bearing.site).copied().flatten();
                let own = cage.map_or(order, |cage| multiple * order_of_part(part, cage, &site.bearing));
                match groups.iter_mut().find(|(known, _)| (known - own).abs() <= tolerance) {
                    Some((_, group)) => group.push(bearing),
                    None => groups.push((own, vec![bearing])),
                }
            }
            let line = |(order, group): (f64, Vec<&NamedOrders>)| {
                let names: Vec<&str> = group.iter().map(|bearing| bearing.name).collect();
                let label = label(part, multiple, &names, bearings.len());
                let of = Some(LineOfBearing { site: group[0].site, part, multiple });
                LineOfRun { line: OrderLine { label, order, bearing: true }, of }
            };
            groups.into_iter().map(line).collect()
        };
        orders.iter().flat_map(lines).collect()
    }
}

/// A line of a run.
pub(super) struct LineOfRun {
    pub line: OrderLine,
    /// What it is a multiple of; `None` for a shaft order.
    pub of: Option<LineOfBearing>,
}

/// A multiple of a characteristic order.
#[derive(Clone, Copy)]
pub(super) struct LineOfBearing {
    pub site: usize,
    part: usize,
    multiple: f64,
}

impl LineOfBearing {
    /// The order where the cage turns `cage` times per turn of the shaft.
    pub fn at(&self, cage: f64, bearing: &Bearing) -> f64 {
        self.multiple * order_of_part(self.part, cage, bearing)
    }
}

/// Order of a part of [`PARTS`] where the cage turns r times per turn of the shaft: Z r, Z (1 − r), and r.
///
/// A ball turns as runs take it, by the mean of rolling on both races: (D_pw/D) (γ r + ½ (1 − γ)), γ = (D/D_pw) cos α at the
/// nominal contact angle; at r = ½ (1 − γ) all are the nominal ones.
fn order_of_part(part: usize, cage: f64, bearing: &Bearing) -> f64 {
    let Some(ball) = bearing.ball() else { return f64::NAN };
    let g = &ball.geometry;
    let cos = g.contact_angle.cos();
    match part {
        0 => g.balls as f64 * cage,
        1 => g.balls as f64 * (1.0 - cage),
        2 => cos * cage + 0.5 * (g.pitch_diameter / g.ball_diameter - cos),
        _ => cage,
    }
}

/// Characteristic orders of a bearing in the sequence of [`PARTS`].
struct NamedOrders<'a> {
    site: usize,
    name: &'a str,
    nominal: [f64; 4],
}

/// The part and multiple of which an order is, and the bearings that have it; whole orders are always shaft orders.
fn part_of<'a>(
    order: f64,
    bearings: &'a [NamedOrders<'a>],
) -> Option<(usize, f64, Vec<&'a NamedOrders<'a>>)> {
    let multiple = |base: f64| {
        let n = (order / base).round();
        (n >= 1.0 && (order / base - n).abs() < 1e-6 * n).then_some(n)
    };
    if multiple(1.0).is_some() {
        return None;
    }
    let (part, n) = bearings
        .iter()
        .flat_map(|bearing| bearing.nominal)
        .enumerate()
        .find_map(|(k, base)| Some((k % PARTS.len(), multiple(base).filter(|n| *n <= MOST)?)))?;
    Some((part, n, bearings.iter().filter(|bearing| multiple(bearing.nominal[part]) == Some(n)).collect()))
}

/// "2 BPFO", or with the bearings that have it if others have not: "2 A.BPFO".
fn label(part: usize, multiple: f64, names: &[&str], bearings: usize) -> String {
    let part = PARTS[part];
    let name = if names.len() == bearings { part.to_string() } else { format!("{}.{part}", names.join("+")) };
    if multiple == 1.0 { name } else { format!("{multiple} {name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bearings_are_named_where_their_orders_differ() {
        let of = |site: usize, name: &'static str, bpfo: f64| NamedOrders {
            site,
            name,
            nominal: [bpfo, 8.0 - bpfo, 2.3, bpfo / 8.0],
        };
        let text = |order: f64, bearings: &[NamedOrders]| {
            let (part, multiple, of) = part_of(order, bearings)?;
            let names: Vec<&str> = of.iter().map(|bearing| bearing.name).collect();
            Some(label(part, multiple, &names, bearings.len()))
        };
        for bearings in [&[of(0, "A", 3.2), of(1, "B", 3.2)][..], &[of(0, "A", 3.2)]] {
            assert_eq!(text(3.2, bearings).unwrap(), "BPFO");
            assert_eq!(text(14.4, bearings).unwrap(), "3 BPFI");
        }
        let three = [of(0, "A", 3.2), of(1, "B", 3.1), of(2, "C", 3.2)];
        assert_eq!(text(3.2, &three).unwrap(), "A+C.BPFO");
        assert_eq!(text(6.2, &three).unwrap(), "2 B.BPFO");
        assert_eq!(text(2.3, &three).unwrap(), "BSF");
        assert_eq!(text(2.0, &three), None);
    }
}
