//! Names of orders: shaft orders, and those of the bearings of a machine.

use super::Machine;
use crate::results::OrderLine;

/// Multiples of a bearing's characteristic order that have a name.
const MOST: f64 = 5.0;

impl Machine {
    /// Order lines with labels: "2x", or for multiples of a bearing's characteristic orders "BPFO", "2 BPFI"; with the bearings
    /// that have it, "A.BPFO" or "A+B.BPFO", where others have another one.
    pub fn order_lines(&self, orders: &[f64]) -> Vec<OrderLine> {
        let bearings: Vec<(&str, [(&str, f64); 4])> = self
            .model
            .bearings
            .iter()
            .filter_map(|site| {
                let c = site.bearing.characteristic_orders()?;
                Some((
                    site.name.as_str(),
                    [("BPFO", c.bpfo), ("BPFI", c.bpfi), ("BSF", c.bsf), ("FTF", c.ftf)],
                ))
            })
            .collect();
        orders
            .iter()
            .map(|&order| {
                let label = label(order, &bearings);
                let bearing = label.is_some();
                OrderLine { label: label.unwrap_or_else(|| format!("{order}x")), order, bearing }
            })
            .collect()
    }
}

/// Name of an order after the first bearing that has it; integer orders are always shaft orders.
fn label(order: f64, bearings: &[(&str, [(&str, f64); 4])]) -> Option<String> {
    let multiple = |base: f64| {
        let n = (order / base).round();
        (n >= 1.0 && (order / base - n).abs() < 1e-6 * n).then_some(n)
    };
    if multiple(1.0).is_some() {
        return None;
    }
    let (part, n) = bearings
        .iter()
        .flat_map(|(_, named)| named)
        .enumerate()
        .find_map(|(k, (_, base))| Some((k % 4, multiple(*base).filter(|n| *n <= MOST)?)))?;
    let of: Vec<&str> = bearings
        .iter()
        .filter(|(_, named)| multiple(named[part].1) == Some(n))
        .map(|(bearing, _)| *bearing)
        .collect();
    let name = bearings[0].1[part].0;
    let name = if of.len() == bearings.len() { name.to_string() } else { format!("{}.{name}", of.join("+")) };
    Some(if n == 1.0 { name } else { format!("{n} {name}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bearings_are_named_where_their_orders_differ() {
        let of = |bpfo: f64| [("BPFO", bpfo), ("BPFI", 8.0 - bpfo), ("BSF", 2.3), ("FTF", bpfo / 8.0)];
        let [same, one] = [[("A", of(3.2)), ("B", of(3.2))].to_vec(), [("A", of(3.2))].to_vec()];
        for bearings in [&same, &one] {
            assert_eq!(label(3.2, bearings).unwrap(), "BPFO");
            assert_eq!(label(14.4, bearings).unwrap(), "3 BPFI");
        }
        let three = [("A", of(3.2)), ("B", of(3.1)), ("C", of(3.2))];
        assert_eq!(label(3.2, &three).unwrap(), "A+C.BPFO");
        assert_eq!(label(6.2, &three).unwrap(), "2 B.BPFO");
        assert_eq!(label(2.3, &three).unwrap(), "BSF");
        assert_eq!(label(2.0, &three), None);
    }
}
