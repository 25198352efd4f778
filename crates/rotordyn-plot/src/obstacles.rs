//! Areas of a page that a label must not cover.

use super::axes::Frame;
use super::style::*;
use super::svg::{Point, Style, Svg, Text};

/// Boxes \[left, top, right, bottom\] \[px\] that are taken.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    boxes: Vec<[f64; 4]>,
    /// Those that are labels, which no leader may cross.
    labels: Vec<[f64; 4]>,
}

impl Obstacles {
    pub fn add(&mut self, area: [f64; 4]) {
        self.boxes.push(area);
    }

    /// Adds a line through page points of a half width \[px\], as small boxes along it; a point that is not finite
    /// is a gap.
    pub fn add_line(&mut self, points: &[Point], half: f64) {
        const STEP: f64 = 2.0;
        let finite = |p: &Point| p[0].is_finite() && p[1].is_finite();
        for pair in points.windows(2).filter(|pair| pair.iter().all(finite)) {
            let [a, b] = [pair[0], pair[1]];
            let steps = ((b[0] - a[0]).hypot(b[1] - a[1]) / STEP).ceil().clamp(1.0, 2000.0);
            for k in 0..=steps as usize {
                let t = k as f64 / steps;
                let [x, y] = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                self.boxes.push([x - half, y - half, x + half, y + half]);
            }
        }
    }

    /// Whether a box covers no obstacle.
    pub fn is_free(&self, [left, top, right, bottom]: [f64; 4]) -> bool {
        !self.boxes.iter().any(|o| left < o[2] && right > o[0] && top < o[3] && bottom > o[1])
    }

    /// The free box for a label of the given width \[px\] nearest to a mark, inside the frame.
    pub fn place_label(&self, mark: Point, width: f64, frame: Frame) -> Option<[f64; 4]> {
        const DIRECTIONS: usize = 16;
        let half = [0.5 * width + 1.5, 0.5 * SMALL + 1.0];
        let boxes = [7.0, 11.0, 18.0, 28.0, 40.0, 54.0, 70.0].into_iter().flat_map(|gap| {
            (0..DIRECTIONS).map(move |k| {
                // To the right first, then alternately above and below.
                let turn = k.div_ceil(2) as f64 * if k % 2 == 0 { 1.0 } else { -1.0 };
                let (sin, cos) = (std::f64::consts::TAU * turn / DIRECTIONS as f64).sin_cos();
                let center = [mark[0] + (gap + half[0]) * cos, mark[1] + (gap + half[1]) * sin];
                [center[0] - half[0], center[1] - half[1], center[0] + half[0], center[1] + half[1]]
            })
        });
        let inside =
            |b: &[f64; 4]| b[0] > frame.x && b[2] < frame.right() && b[1] > frame.y && b[3] < frame.bottom();
        let leader_free = |b: &[f64; 4]| {
            let near = [mark[0].clamp(b[0], b[2]), mark[1].clamp(b[1], b[3])];
            !self.labels.iter().any(|label| crosses(mark, near, *label))
        };
        boxes.into_iter().find(|b| inside(b) && self.is_free(*b) && leader_free(b))
    }

    /// Writes a label into its box, with a leader to a mark that is not beside it; both become obstacles.
    pub fn callout(&mut self, svg: &mut Svg, mark: Point, area: [f64; 4], label: &str) {
        let near = [mark[0].clamp(area[0], area[2]), mark[1].clamp(area[1], area[3])];
        let way = [near[0] - mark[0], near[1] - mark[1]];
        let distance = way[0].hypot(way[1]);
        if distance > 14.0 {
            let start = [mark[0] + 5.0 * way[0] / distance, mark[1] + 5.0 * way[1] / distance];
            svg.group("leader", |svg| svg.line(start, near, Style::stroke(MUTED, 0.7)));
            self.add_line(&[start, near], 0.5);
        }
        let place = [0.5 * (area[0] + area[2]), 0.5 * (area[1] + area[3]) + 0.36 * SMALL];
        svg.text(place, label, Text::new(SMALL, INK).middle().halo());
        self.add(area);
        self.labels.push(area);
    }
}

/// Whether the line from `a` to `b` passes through a box.
fn crosses(a: Point, b: Point, [left, top, right, bottom]: [f64; 4]) -> bool {
    (0..=20).any(|k| {
        let t = f64::from(k) / 20.0;
        let [x, y] = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        (left..=right).contains(&x) && (top..=bottom).contains(&y)
    })
}
