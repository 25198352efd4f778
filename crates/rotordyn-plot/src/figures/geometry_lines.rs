//! Lines that join the points of a test geometry in pictures of mode shapes.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use rotordyn_signal::record::Geometry;

/// Lines between the points of a geometry, by index: its lines and the outlines of its elements; without any, a line
/// through the measured points if they lie along a straight one, such as a shaft.
pub(super) fn lines_between_points(geometry: &Geometry, measured: &BTreeSet<usize>) -> Vec<Vec<usize>> {
    let index = |number: &i64| geometry.nodes.iter().position(|n| n.number == *number);
    let known = |numbers: &[i64]| numbers.iter().filter_map(index).collect::<Vec<_>>();
    let lines = geometry.lines.iter().flat_map(|line| line.strokes.iter().map(|stroke| known(stroke)));
    let outline = |nodes: &[i64]| {
        let mut outline = known(nodes);
        if outline.len() > 2 {
            outline.push(outline[0]);
        }
        outline
    };
    let elements = geometry.elements.iter().map(|element| outline(&element.nodes));
    let drawn: Vec<Vec<usize>> = lines.chain(elements).filter(|stroke| stroke.len() > 1).collect();
    if drawn.is_empty() { along_a_straight_line(geometry, measured).into_iter().collect() } else { drawn }
}

/// Distance of points from a straight line through them, as a fraction of its length.
const STRAIGHT: f64 = 0.05;

/// The points in their order along the straight line between the two that are farthest apart, if all lie on it.
fn along_a_straight_line(geometry: &Geometry, points: &BTreeSet<usize>) -> Option<Vec<usize>> {
    let at = |k: usize| Vector3::from(geometry.nodes[k].position);
    let farthest = |from: usize| {
        points
            .iter()
            .copied()
            .max_by(|a, b| at(*a).metric_distance(&at(from)).total_cmp(&at(*b).metric_distance(&at(from))))
    };
    // In a row of points the one farthest from any is an end.
    let start = farthest(*points.first()?)?;
    let along = at(farthest(start)?) - at(start);
    let length = along.norm();
    let distance = |k: &usize| (at(*k) - at(start)).cross(&along).norm() / length;
    if length == 0.0 || points.iter().any(|k| distance(k) > STRAIGHT * length) {
        return None;
    }
    let mut ordered: Vec<usize> = points.iter().copied().collect();
    ordered.sort_by(|a, b| (at(*a) - at(start)).dot(&along).total_cmp(&(at(*b) - at(start)).dot(&along)));
    Some(ordered)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_signal::record::{Element, Node};

    fn points(positions: &[[f64; 3]]) -> Geometry {
        let node = |(k, position): (usize, &[f64; 3])| Node {
            number: 10 + k as i64,
            position: *position,
            local_system: 0,
        };
        Geometry { nodes: positions.iter().enumerate().map(node).collect(), ..Geometry::default() }
    }

    /// Points along a shaft are joined in their order, those of a plate are not; elements give their outlines.
    #[test]
    fn points_are_joined_along_a_shaft_or_as_elements() {
        let shaft = points(&[[0.3, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, 0.01, 0.0], [0.1, 0.0, 0.0]]);
        let all = BTreeSet::from([0, 1, 2, 3]);
        assert_eq!(lines_between_points(&shaft, &all), [[1, 3, 0, 2].to_vec()]);
        let mut plate = points(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!(lines_between_points(&plate, &all).is_empty());
        plate.elements.push(Element { number: 1, descriptor: 94, nodes: vec![10, 11, 12, 13] });
        assert_eq!(lines_between_points(&plate, &all), [[0, 1, 2, 3, 0].to_vec()]);
        assert!(lines_between_points(&points(&[[0.0; 3], [0.0; 3]]), &BTreeSet::from([0, 1])).is_empty());
    }
}
